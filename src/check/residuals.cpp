// Written from the definitions and summed in long double, so that the check is more exact than the solver.
#include "contact_path/check/residuals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "check/attached.h"
#include "check/boundary.h"
#include "check/contacts.h"
#include "check/elements.h"
#include "check/pins.h"
#include "check/plane.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/scene_index.h"

namespace contact_path {
namespace {

using check::Dot;
using check::NodePosition;
using check::Real;
using check::Vector;

// Force, of the stiffness at a node times L: the rounding of coordinates makes forces of 1e-11 of it.
constexpr Real kStiffForce = 1e-4L;

// Contacts of rigid bodies and pins in loops give way, so that reactions are unique: by this motion over L per force
// over F.
constexpr Real kGive = 1e-8L;

// Over L: a pin that has to give way by more holds its nodes together no more, as where supports pull them apart.
constexpr Real kMostGiven = 1e-6L;

// The larger of the two. What is no finite double counts as infinite, so that NaN never passes as small.
double Worst(double worst, Real value) {
  if (!(value <= static_cast<Real>(std::numeric_limits<double>::max()))) return std::numeric_limits<double>::infinity();
  return std::max(worst, static_cast<double>(value));
}

bool AllFinite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

bool AllFinite(const CheckedState& state) {
  return std::isfinite(state.load_factor) && AllFinite(state.positions) && AllFinite(state.rotations) &&
         AllFinite(state.rn) && AllFinite(state.rt) && AllFinite(state.pins);
}

void RequireSize(const std::vector<double>& values, std::size_t size, const char* name) {
  if (values.size() == size) return;
  throw std::invalid_argument(std::string(name) + " has " + std::to_string(values.size()) + " entries: must be " +
                              std::to_string(size));
}

}  // namespace

// The scene with all names resolved; vectors in the order of the scene's lists.
struct ResidualCheck::Prepared {
  struct PreparedLoad {
    std::size_t node = 0;
    Real fx = 0.0L, fy = 0.0L, moment = 0.0L;
    bool constant = false;
  };
  Prepared(const Scene& scene, const Configuration& configuration, const Scaling& scaling_in)
      : scaling(scaling_in), num_positions(configuration.start.size()), start(configuration.start) {
    check::NodeNumbers index;
    for (const Node& node : scene.nodes) {
      index.emplace(node.name, index.size());
      free.push_back(!node.fixed_x);
      free.push_back(!node.fixed_y);
    }
    attached.emplace(scene, index);
    if (HasRotations(scene)) {
      const std::vector<bool> turn = NodesThatTurn(scene);
      for (std::size_t i = 0; i < turn.size(); ++i) free.push_back(turn[i] && !scene.nodes[i].fixed_rotation);
      start.insert(start.end(), configuration.start_rotations.begin(), configuration.start_rotations.end());
    }
    elements = check::MakeElements(scene, index, configuration.reference);
    pins.emplace(scene, index, configuration.reference);
    // Coordinates are rounded relative to their size.
    Real size = scaling.length;
    for (const double coordinate : configuration.start) size = std::max<Real>(size, std::abs(coordinate));
    std::vector<Real> stiffness(scene.nodes.size(), 0.0L);
    for (const auto& element : elements)
      for (const std::size_t node : element->Nodes()) stiffness[node] += element->Stiffness();
    attached->Share(&stiffness);
    for (const Real at_node : stiffness) largest_stiffness = std::max(largest_stiffness, at_node);
    for (const Real at_node : stiffness) units.push_back(std::max<Real>(scaling.force, kStiffForce * at_node * size));
    // Summed by node, so that what cancels does so before the load factor makes it large.
    std::map<std::pair<std::size_t, bool>, std::size_t> sums;
    for (const Load& load : scene.loads) {
      const auto [at, is_new] = sums.try_emplace({index.at(load.node), load.constant}, loads.size());
      if (is_new) loads.push_back({index.at(load.node), 0.0L, 0.0L, 0.0L, load.constant});
      loads[at->second].fx += load.fx;
      loads[at->second].fy += load.fy;
      loads[at->second].moment += load.moment;
    }
    rates.resize(start.size());
    for (const SupportMotion& motion : scene.support_motions) {
      rates[2 * index.at(motion.node)] = motion.dx;
      rates[2 * index.at(motion.node) + 1] = motion.dy;
      if (motion.rotation != 0.0) rates.at(num_positions + index.at(motion.node)) = motion.rotation;
    }
    supports = SupportedNodes(scene);
    const std::vector<TouchedBoundary> touched = TouchedBoundaries(scene);
    num_touched = touched.size();
    touched_by = BoundaryOfContacts(scene, touched);
    contacts = check::MakeContacts(scene, index, configuration.slip_origins, size);
    std::vector<check::ContactPlace> places;
    for (std::size_t i = 0; i < contacts.size(); ++i) places.push_back({contacts[i]->Node(), touched_by[i]});
    contact_edges = check::ContactEdges(elements, places);
    if (std::any_of(contacts.begin(), contacts.end(), [](const auto& contact) { return contact->TouchedSurface(); }))
      boundaries = check::MakeBoundaries(scene, index);
    const std::vector<Real> of_surfaces = LargestOnSurfaces<Real>([&](std::size_t node) { return units[node]; });
    for (const auto& contact : contacts) {
      const std::optional<std::size_t> surface = contact->TouchedSurface();
      contact_units.push_back(surface ? std::max(units[contact->Node()], of_surfaces[*surface])
                                      : units[contact->Node()]);
    }
  }

  // By surface that contacts may touch, the largest of the values >= 0 of its nodes.
  template <typename Value, typename ValueOf>
  std::vector<Value> LargestOnSurfaces(ValueOf value_of) const {
    std::vector<Value> largest;
    for (const check::Boundary& boundary : boundaries) {
      largest.push_back(0);
      for (const check::BoundaryPatch& patch : boundary.Patches())
        for (const std::size_t node : patch.nodes) largest.back() = std::max(largest.back(), value_of(node));
    }
    return largest;
  }

  check::PlacedState Placed(const CheckedState& state) const { return {state, boundaries}; }

  // phi - T r on each component: internal forces less loads less reactions. What acts on an attached node acts on its
  // body.
  std::vector<Real> Unbalance(const CheckedState& given) const {
    const CheckedState settled = attached->Empty() ? CheckedState() : attached->Settled(given);
    const CheckedState& state = attached->Empty() ? given : settled;
    const std::vector<double> values = check::ValuesOf(state.positions, state.rotations);
    std::vector<Real> forces(values.size(), 0.0L);
    for (const auto& element : elements) element->AddForce(values, &forces);
    for (const PreparedLoad& load : loads) {
      const Real factor = load.constant ? 1.0L : static_cast<Real>(state.load_factor);
      forces[2 * load.node] -= factor * load.fx;
      forces[2 * load.node + 1] -= factor * load.fy;
      if (load.moment != 0.0L) forces.at(num_positions + load.node) -= factor * load.moment;
    }
    const check::PlacedState placed = Placed(state);
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      if (state.rn[i] == 0.0 && state.rt[i] == 0.0) continue;
      contacts[i]->AddForces(placed, state.rn[i], state.rt[i], -1.0L, &forces);
    }
    pins->TakeForces(state.pins, &forces);
    attached->GiveToBodies(values, &forces);
    return forces;
  }

  void RequireSizes(const CheckedState& state) const {
    RequireSize(state.positions, num_positions, "positions");
    RequireSize(state.rotations, start.size() - num_positions, "rotations");
    RequireSize(state.rn, contacts.size(), "rn");
    RequireSize(state.rt, contacts.size(), "rt");
    RequireSize(state.pins, 2 * pins->Count(), "pins");
  }

  Scaling scaling;
  std::size_t num_positions;  // the first values, x0, y0, x1, ...; rotations by node follow where there are beams
  std::vector<double> start;  // values at load factor 0
  std::vector<bool> free;     // the same components
  std::optional<const check::AttachedNodes> attached;
  std::vector<Real> units;        // by node: what unbalanced forces are measured in
  Real largest_stiffness = 0.0L;  // of all nodes, as LargestStiffness()
  std::vector<double> rates;      // of the fixed ones, per unit of the load factor
  std::vector<std::unique_ptr<const check::Element>> elements;
  std::optional<const check::Pins> pins;
  std::vector<PreparedLoad> loads;
  std::vector<std::unique_ptr<const check::Contact>> contacts;
  std::vector<Real> contact_units;
  std::vector<SupportedNode> supports;
  std::vector<std::size_t> touched_by;  // by contact: which of TouchedBoundaries()
  std::size_t num_touched = 0;
  std::vector<check::ContactEdge> contact_edges;
  std::vector<check::Boundary> boundaries;  // by surface of the scene; empty where no contact touches one
};

ResidualCheck::ResidualCheck(const Scene& scene)
    : ResidualCheck(scene, Configuration::Of(scene), CharacteristicScales(scene)) {}
ResidualCheck::ResidualCheck(const Scene& scene, const Configuration& configuration, const Scaling& scaling)
    : prepared_(std::make_unique<Prepared>(scene, configuration, scaling)) {}
ResidualCheck::~ResidualCheck() = default;

double Residuals::Contact() const {
  double worst = 0.0;
  for (const double residual : {penetration, tensile_reaction, complementarity, cone, friction_law}) {
    worst = Worst(worst, residual);
  }
  return worst;
}

double Residuals::Largest() const { return Worst(Worst(Contact(), equilibrium), support); }

Residuals ResidualCheck::Check(const CheckedState& before, const CheckedState& now) const {
  const Prepared& scene = *prepared_;
  scene.RequireSizes(before);
  scene.RequireSizes(now);
  if (!AllFinite(before) || !AllFinite(now)) {
    Residuals infinite;
    for (double Residuals::*const residual : Residuals::kAll)
      infinite.*residual = std::numeric_limits<double>::infinity();
    return infinite;
  }

  const Scaling& scaling = scene.scaling;
  Residuals residuals;
  const std::vector<Real> unbalance = scene.Unbalance(now);
  const std::vector<double> values = check::ValuesOf(now.positions, now.rotations);
  const check::PlacedState from = scene.Placed(before), to = scene.Placed(now);
  const Real uncertain = Uncertain(now);
  for (std::size_t i = 0; i < unbalance.size(); ++i) {
    const bool is_position = i < scene.num_positions;
    const Real length = is_position ? 1.0L : static_cast<Real>(scaling.length);  // of a moment
    if (scene.free[i]) {
      const Real unit = scene.units[is_position ? i / 2 : i - scene.num_positions];
      const Real off = std::max(std::abs(unbalance[i]) - uncertain * length, 0.0L);
      residuals.equilibrium = Worst(residuals.equilibrium, off / (unit * length));
      continue;
    }
    const Real place = scene.start[i] + static_cast<Real>(now.load_factor) * scene.rates[i];
    residuals.support = Worst(residuals.support, std::abs(values[i] - place) * length / scaling.length);
  }
  if (!scene.attached->Empty()) {
    const CheckedState settled = scene.attached->Settled(now);
    for (std::size_t i = 0; i < now.positions.size(); ++i)
      residuals.support = Worst(residuals.support,
                                std::abs(static_cast<Real>(now.positions[i]) - settled.positions[i]) / scaling.length);
    for (std::size_t i = 0; i < now.rotations.size(); ++i)
      residuals.support =
          Worst(residuals.support, std::abs(static_cast<Real>(now.rotations[i]) - settled.rotations[i]));
  }
  for (std::size_t k = 0; k < scene.pins->Count(); ++k) {
    const Vector given = static_cast<Real>(GiveOfPin(k)) * Vector{now.pins[2 * k], now.pins[2 * k + 1]};
    Vector apart = scene.pins->Apart(k, now.positions);
    if (check::Length(given) <= kMostGiven * scaling.length) apart = apart + given;
    residuals.support = Worst(residuals.support, check::Length(apart) / scaling.length);
  }
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    const check::Contact& contact = *scene.contacts[i];
    const bool without_reaction = now.rn[i] == 0.0 && now.rt[i] == 0.0;
    if (without_reaction && contact.SurelyOpen(to)) continue;
    const Real give = contact.Gives() ? kGive / scaling.force : 0.0L;
    const Real gap = contact.Gap(to) / scaling.length + give * now.rn[i];
    if (without_reaction) {  // then only a gap that is closed too far breaks a rule
      residuals.penetration = Worst(residuals.penetration, -gap);
      residuals.complementarity = Worst(residuals.complementarity, std::abs(std::min(gap, 0.0L)));
      continue;
    }
    const Real slip =
        contact.LawfulSlip(from, to) / scaling.length +
        (give > 0.0L ? give * (contact.GivesTo(to, now.rt[i]) - contact.GivesTo(from, before.rt[i])) : 0.0L);
    const Real unit = scene.contact_units[i];
    const Real rn = now.rn[i] / unit, rt = now.rt[i] / unit;
    const Real friction = contact.FrictionIn(to), bound = friction * std::max(rn, 0.0L);
    residuals.equilibrium =
        Worst(residuals.equilibrium, contact.Imbalance(to, now.rn[i], now.rt[i], scaling.length) / unit);
    residuals.penetration = Worst(residuals.penetration, -gap);
    residuals.tensile_reaction = Worst(residuals.tensile_reaction, -rn);
    const Real reaction = rn < 0.0L ? rn : std::max(rn, std::abs(rt));
    residuals.complementarity = Worst(residuals.complementarity, std::abs(std::min(gap, reaction)));
    residuals.cone = Worst(residuals.cone, std::abs(rt) - friction * rn);
    residuals.friction_law = Worst(residuals.friction_law, std::abs(rt - std::clamp(rt - slip, -bound, bound)));
  }
  return residuals;
}

std::vector<double> ResidualCheck::Unbalance(const CheckedState& state) const {
  prepared_->RequireSizes(state);
  const std::vector<Real> unbalance = prepared_->Unbalance(state);
  return {unbalance.begin(), unbalance.end()};
}

CheckedForces ResidualCheck::Forces(const CheckedState& state) const {
  const Prepared& scene = *prepared_;
  scene.RequireSizes(state);
  const std::vector<Real> unbalance = scene.Unbalance(state);
  CheckedForces forces;
  for (const SupportedNode& support : scene.supports) {
    std::array<double, 3>& of = forces.supports.emplace_back();
    if (support.x) of[0] = static_cast<double>(unbalance[2 * support.node]);
    if (support.y) of[1] = static_cast<double>(unbalance[2 * support.node + 1]);
    if (support.rotation) of[2] = static_cast<double>(unbalance[scene.num_positions + support.node]);
  }
  std::vector<std::array<Real, 3>> sums(scene.num_touched);
  const check::PlacedState placed = scene.Placed(state);
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    if ((state.rn[i] == 0.0 && state.rt[i] == 0.0) || scene.touched_by[i] == scene.num_touched) continue;
    const check::Contact::OnNode on_node = scene.contacts[i]->ForceOnNode(placed, state.rn[i], state.rt[i]);
    std::array<Real, 3>& sum = sums[scene.touched_by[i]];
    sum[0] += on_node.force.x;
    sum[1] += on_node.force.y;
    sum[2] += on_node.moment;
  }
  for (const std::array<Real, 3>& sum : sums)
    forces.boundaries.push_back(
        {static_cast<double>(sum[0]), static_cast<double>(sum[1]), static_cast<double>(sum[2])});
  return forces;
}

CheckedAnswers ResidualCheck::Answers(const CheckedState& state) const {
  const Prepared& scene = *prepared_;
  scene.RequireSizes(state);
  const std::vector<double> values = check::ValuesOf(state.positions, state.rotations);
  CheckedAnswers answers;
  answers.sections = check::Sections(scene.elements, values, scene.num_positions);
  for (const auto& element : scene.elements)
    if (const std::optional<check::MeanStress> of = element->Stress(values)) {
      // Von Mises, by the deviator.
      const Real mean = (of->xx + of->yy + of->zz) / 3.0L, a = of->xx - mean, b = of->yy - mean, c = of->zz - mean;
      const Real mises = std::sqrt(1.5L * (a * a + b * b + c * c + 2.0L * of->xy * of->xy));
      std::array<double, 6>& stress = answers.stresses.emplace_back();
      std::size_t i = 0;
      for (const Real number : {of->xx, of->yy, of->xy, of->zz, mises, of->energy})
        stress[i++] = static_cast<double>(number);
      answers.stress_per_motion.push_back(static_cast<double>(of->per_motion));
    }
  answers.boundaries = scene.touched_by;
  answers.lengths = check::ContactLengths(scene.contact_edges, scene.contacts.size(), state.positions);
  return answers;
}

double ResidualCheck::DrivingForce(const CheckedState& state) const {
  const Prepared& scene = *prepared_;
  scene.RequireSizes(state);
  const std::vector<Real> unbalance = scene.Unbalance(state);
  Real force = 0.0L;
  for (std::size_t i = 0; i < unbalance.size(); ++i) force += scene.rates[i] * unbalance[i];
  const check::PlacedState placed = scene.Placed(state);
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    const check::Contact& contact = *scene.contacts[i];
    if (contact.TouchedSurface()) continue;  // nothing but nodes moves it
    const Vector normal = contact.Normal(placed), tangent{normal.y, -normal.x}, velocity = contact.Velocity(placed);
    force += state.rn[i] * Dot(normal, velocity) + state.rt[i] * Dot(tangent, velocity);
  }
  return static_cast<double>(force);
}

double ResidualCheck::Gap(std::size_t contact, const CheckedState& state) const {
  return static_cast<double>(prepared_->contacts[contact]->Gap(prepared_->Placed(state)));
}

double ResidualCheck::GapPastEnd(std::size_t contact, const CheckedState& state) const {
  return static_cast<double>(prepared_->contacts[contact]->GapPastEnd(prepared_->Placed(state)));
}

double ResidualCheck::Give(std::size_t contact) const {
  const Scaling& scaling = prepared_->scaling;
  return prepared_->contacts[contact]->Gives() ? static_cast<double>(kGive) * scaling.length / scaling.force : 0.0;
}

double ResidualCheck::GiveOfPin(std::size_t pin) const {
  const Scaling& scaling = prepared_->scaling;
  return prepared_->pins->Gives(pin) ? static_cast<double>(kGive) * scaling.length / scaling.force : 0.0;
}

double ResidualCheck::Uncertain(const CheckedState& state) const {
  const check::PlacedState placed = prepared_->Placed(state);
  Real sum = 0.0L;
  for (std::size_t i = 0; i < prepared_->contacts.size(); ++i)
    sum += prepared_->contacts[i]->Uncertain(placed, state.rt[i]);
  return static_cast<double>(sum);
}

double ResidualCheck::Slip(std::size_t contact, const CheckedState& from, const CheckedState& to) const {
  return static_cast<double>(prepared_->contacts[contact]->Slip(prepared_->Placed(from), prepared_->Placed(to)));
}

double ResidualCheck::Friction(std::size_t contact, const CheckedState& state) const {
  return static_cast<double>(prepared_->contacts[contact]->FrictionIn(prepared_->Placed(state)));
}

double ResidualCheck::SlidingForce(std::size_t contact, const CheckedState& state) const {
  const check::Contact& of = *prepared_->contacts[contact];
  const double rn = state.rn[contact];
  return Friction(contact, state) * rn * static_cast<double>(of.Stretch(rn));
}

double ResidualCheck::GivesTo(std::size_t contact, const CheckedState& state) const {
  return static_cast<double>(prepared_->contacts[contact]->GivesTo(prepared_->Placed(state), state.rt[contact]));
}

double ResidualCheck::TotalSlip(std::size_t contact, const CheckedState& state) const {
  const std::optional<Real> slip = prepared_->contacts[contact]->TotalSlip(prepared_->Placed(state));
  if (!slip) throw std::invalid_argument("the law of friction is not total");
  return static_cast<double>(*slip);
}

std::array<double, 2> ResidualCheck::Normal(std::size_t contact, const CheckedState& state) const {
  const Vector normal = prepared_->contacts[contact]->Normal(prepared_->Placed(state));
  return {static_cast<double>(normal.x), static_cast<double>(normal.y)};
}

std::vector<ContactForceBound> ResidualCheck::BoundContactForces(double length, double load_factor) const {
  const Prepared& scene = *prepared_;
  std::vector<check::StiffnessBound> bounds =
      check::BoundStiffness(scene.elements, scene.start, scene.num_positions / 2);
  for (check::StiffnessBound& bound : bounds)
    for (double* const part : {&bound.x, &bound.y, &bound.any}) *part *= length;
  for (const Prepared::PreparedLoad& load : scene.loads) {
    const Real factor = load.constant ? 1.0L : static_cast<Real>(load_factor);
    bounds[load.node].x += static_cast<double>(std::abs(factor * load.fx));
    bounds[load.node].y += static_cast<double>(std::abs(factor * load.fy));
  }
  scene.attached->Share(&bounds);
  CheckedState start;
  const auto rotations = scene.start.begin() + static_cast<std::ptrdiff_t>(scene.num_positions);
  start.positions.assign(scene.start.begin(), rotations);
  start.rotations.assign(rotations, scene.start.end());
  const check::PlacedState placed = scene.Placed(start);
  const std::vector<double> of_surfaces = scene.LargestOnSurfaces<double>(
      [&](std::size_t node) { return bounds[node].any + bounds[node].x + bounds[node].y; });
  std::vector<ContactForceBound> forces;
  std::vector<double> at_node(bounds.size(), 0.0);  // the largest of its contacts
  for (const auto& contact : scene.contacts) {
    const check::StiffnessBound& bound = bounds[contact->Node()];
    const Vector normal = contact->Normal(placed);
    ContactForceBound force;
    force.on_node = bound.any + std::abs(static_cast<double>(normal.x)) * bound.x +
                    std::abs(static_cast<double>(normal.y)) * bound.y;
    const double of_surface = contact->TouchedSurface() ? of_surfaces[*contact->TouchedSurface()] : 0.0;
    // A node that is held bears what the surface presses with, however soft its own parts are.
    if (!scene.free[2 * contact->Node()] || !scene.free[2 * contact->Node() + 1])
      force.on_node = std::max(force.on_node, of_surface);
    double& largest = at_node[contact->Node()];
    largest = std::max({largest, force.on_node, of_surface});
    forces.push_back(force);
  }
  for (std::size_t i = 0; i < forces.size(); ++i) forces[i].of_all_parts = at_node[scene.contacts[i]->Node()];
  return forces;
}

double ResidualCheck::LargestStiffness() const { return static_cast<double>(prepared_->largest_stiffness); }

double ResidualCheck::StrainEnergy(const std::vector<double>& positions, const std::vector<double>& rotations) const {
  RequireSize(positions, prepared_->num_positions, "positions");
  RequireSize(rotations, prepared_->start.size() - prepared_->num_positions, "rotations");
  const std::vector<double> values = check::ValuesOf(positions, rotations);
  Real energy = 0.0L;
  for (const auto& element : prepared_->elements) element->AddEnergy(values, &energy);
  return static_cast<double>(energy);
}

}  // namespace contact_path
