// Written from the definitions and summed in long double, so that the check is more exact than the solver.
#include "contact_path/check/residuals.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "check/elements.h"
#include "check/plane.h"
#include "check/surfaces.h"
#include "contact_path/scene/expand.h"

namespace contact_path {
namespace {

using check::Dot;
using check::NodePosition;
using check::Real;
using check::Vector;

// Force, of the stiffness at a node times L: the rounding of coordinates makes forces of 1e-11 of it.
constexpr Real kStiffForce = 1e-4L;

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
         AllFinite(state.rn) && AllFinite(state.rt);
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
  struct PreparedContact {
    // The node as the obstacle sees it.
    Vector Position(const CheckedState& state) const {
      const Vector moved =
          NodePosition(state.positions, node) - Vector{state.load_factor * motion.x, state.load_factor * motion.y};
      if (turn == 0.0L) return moved;
      const Vector back = Turned(moved - about, -turn * state.load_factor);
      return {about.x + back.x, about.y + back.y};
    }
    // Towards the admissible side, where the obstacle is now.
    Vector Normal(const CheckedState& state) const {
      const Vector normal = surface->Normal(Position(state));
      return turn == 0.0L ? normal : Turned(normal, turn * state.load_factor);
    }
    // Of what is fixed to the obstacle and is where the node is, per unit of the load factor.
    Vector Velocity(const CheckedState& state) const {
      if (turn == 0.0L) return motion;
      const Vector arm = NodePosition(state.positions, node) - about -
                         Vector{state.load_factor * motion.x, state.load_factor * motion.y};
      return {motion.x - turn * arm.y, motion.y + turn * arm.x};
    }
    static Vector Turned(const Vector& v, Real angle) {
      const Real c = std::cos(angle), s = std::sin(angle);
      return {c * v.x - s * v.y, s * v.x + c * v.y};
    }

    std::size_t node = 0;
    std::shared_ptr<const check::Surface> surface;
    Vector motion;     // of the obstacle, per unit of the load factor
    Real turn = 0.0L;  // before that, about a point
    Vector about;
    Real friction = 0.0L;
    std::optional<Vector> slip_origin = {};  // of the total law of friction, as the obstacle sees it
  };

  Prepared(const Scene& scene, const Configuration& configuration, const Scaling& scaling_in)
      : scaling(scaling_in), num_positions(configuration.start.size()), start(configuration.start) {
    check::NodeNumbers index;
    for (const Node& node : scene.nodes) {
      index.emplace(node.name, index.size());
      free.push_back(!node.fixed_x);
      free.push_back(!node.fixed_y);
    }
    if (!scene.beams.empty()) {
      const std::vector<bool> turn = NodesThatTurn(scene);
      for (std::size_t i = 0; i < turn.size(); ++i) free.push_back(turn[i] && !scene.nodes[i].fixed_rotation);
      start.insert(start.end(), configuration.start_rotations.begin(), configuration.start_rotations.end());
    }
    elements = check::MakeElements(scene, index, configuration.reference);
    std::vector<Real> stiffness(scene.nodes.size(), 0.0L);
    for (const auto& element : elements)
      for (const std::size_t node : element->Nodes()) stiffness[node] += element->Stiffness();
    for (const Real at_node : stiffness)
      units.push_back(std::max<Real>(scaling.force, kStiffForce * at_node * scaling.length));
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
    std::unordered_map<std::string_view, PreparedContact> obstacles;
    for (const Obstacle& obstacle : scene.obstacles)
      obstacles.emplace(obstacle.name,
                        PreparedContact{0, check::MakeSurface(obstacle), {}, 0.0L, {}, obstacle.friction});
    for (const ObstacleMotion& motion : scene.obstacle_motions) {
      PreparedContact& moved = obstacles.at(motion.obstacle);
      moved.motion = {motion.dx, motion.dy};
      moved.turn = motion.turn;
      moved.about = {motion.about_x, motion.about_y};
    }
    for (const ContactCandidate& contact : scene.contacts) {
      const auto obstacle = obstacles.find(contact.obstacle);
      if (obstacle == obstacles.end()) throw std::invalid_argument("no obstacle has the name " + contact.obstacle);
      const std::size_t k = 2 * contacts.size();
      contacts.push_back(obstacle->second);
      if (!configuration.slip_origins.empty())
        contacts.back().slip_origin = Vector{configuration.slip_origins.at(k), configuration.slip_origins.at(k + 1)};
      contacts.back().node = index.at(contact.node);
    }
  }

  // phi - T r on each component: internal forces less loads less reactions.
  std::vector<Real> Unbalance(const CheckedState& state) const {
    const std::vector<double> values = check::ValuesOf(state.positions, state.rotations);
    std::vector<Real> forces(values.size(), 0.0L);
    for (const auto& element : elements) element->AddForce(values, &forces);
    for (const PreparedLoad& load : loads) {
      const Real factor = load.constant ? 1.0L : static_cast<Real>(state.load_factor);
      forces[2 * load.node] -= factor * load.fx;
      forces[2 * load.node + 1] -= factor * load.fy;
      if (load.moment != 0.0L) forces.at(num_positions + load.node) -= factor * load.moment;
    }
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      if (state.rn[i] == 0.0 && state.rt[i] == 0.0) continue;
      const PreparedContact& contact = contacts[i];
      const Vector normal = contact.Normal(state), tangent{normal.y, -normal.x};
      forces[2 * contact.node] -= state.rn[i] * normal.x + state.rt[i] * tangent.x;
      forces[2 * contact.node + 1] -= state.rn[i] * normal.y + state.rt[i] * tangent.y;
    }
    return forces;
  }

  void RequireSizes(const CheckedState& state) const {
    RequireSize(state.positions, num_positions, "positions");
    RequireSize(state.rotations, start.size() - num_positions, "rotations");
    RequireSize(state.rn, contacts.size(), "rn");
    RequireSize(state.rt, contacts.size(), "rt");
  }

  Scaling scaling;
  std::size_t num_positions;  // the first values, x0, y0, x1, ...; rotations by node follow where there are beams
  std::vector<double> start;  // values at load factor 0
  std::vector<bool> free;     // the same components
  std::vector<Real> units;    // by node: what unbalanced forces are measured in
  std::vector<double> rates;  // of the fixed ones, per unit of the load factor
  std::vector<std::unique_ptr<const check::Element>> elements;
  std::vector<PreparedLoad> loads;
  std::vector<PreparedContact> contacts;
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
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return {kInfinity, kInfinity, kInfinity, kInfinity, kInfinity, kInfinity, kInfinity};
  }

  const Scaling& scaling = scene.scaling;
  Residuals residuals;
  const std::vector<Real> unbalance = scene.Unbalance(now);
  const std::vector<double> values = check::ValuesOf(now.positions, now.rotations);
  for (std::size_t i = 0; i < unbalance.size(); ++i) {
    const bool is_position = i < scene.num_positions;
    const Real length = is_position ? 1.0L : static_cast<Real>(scaling.length);  // of a moment
    if (scene.free[i]) {
      const Real unit = scene.units[is_position ? i / 2 : i - scene.num_positions];
      residuals.equilibrium = Worst(residuals.equilibrium, std::abs(unbalance[i]) / (unit * length));
      continue;
    }
    const Real place = scene.start[i] + static_cast<Real>(now.load_factor) * scene.rates[i];
    residuals.support = Worst(residuals.support, std::abs(values[i] - place) * length / scaling.length);
  }
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    const Prepared::PreparedContact& contact = scene.contacts[i];
    const bool without_reaction = now.rn[i] == 0.0 && now.rt[i] == 0.0;
    const Vector place = contact.Position(now);
    if (without_reaction && contact.surface->SurelyOpen(place)) continue;
    const Real gap = contact.surface->Gap(place) / scaling.length;
    if (without_reaction) {  // then only a gap that is closed too far breaks a rule
      residuals.penetration = Worst(residuals.penetration, -gap);
      residuals.complementarity = Worst(residuals.complementarity, std::abs(std::min(gap, 0.0L)));
      continue;
    }
    const Vector origin = contact.slip_origin ? *contact.slip_origin : contact.Position(before);
    const Real slip = contact.surface->Slip(origin, place) / scaling.length;
    const Real unit = scene.units[contact.node];
    const Real rn = now.rn[i] / unit, rt = now.rt[i] / unit;
    const Real bound = contact.friction * std::max(rn, 0.0L);
    residuals.penetration = Worst(residuals.penetration, -gap);
    residuals.tensile_reaction = Worst(residuals.tensile_reaction, -rn);
    residuals.complementarity = Worst(residuals.complementarity, std::abs(std::min(gap, rn)));
    residuals.cone = Worst(residuals.cone, std::abs(rt) - contact.friction * rn);
    residuals.friction_law = Worst(residuals.friction_law, std::abs(rt - std::clamp(rt - slip, -bound, bound)));
  }
  return residuals;
}

std::vector<double> ResidualCheck::Unbalance(const CheckedState& state) const {
  prepared_->RequireSizes(state);
  const std::vector<Real> unbalance = prepared_->Unbalance(state);
  return {unbalance.begin(), unbalance.end()};
}

double ResidualCheck::DrivingForce(const CheckedState& state) const {
  const Prepared& scene = *prepared_;
  scene.RequireSizes(state);
  const std::vector<Real> unbalance = scene.Unbalance(state);
  Real force = 0.0L;
  for (std::size_t i = 0; i < unbalance.size(); ++i) force += scene.rates[i] * unbalance[i];
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    const Prepared::PreparedContact& contact = scene.contacts[i];
    const Vector normal = contact.Normal(state), tangent{normal.y, -normal.x}, velocity = contact.Velocity(state);
    force += state.rn[i] * Dot(normal, velocity) + state.rt[i] * Dot(tangent, velocity);
  }
  return static_cast<double>(force);
}

double ResidualCheck::Gap(std::size_t contact, const CheckedState& state) const {
  const Prepared::PreparedContact& prepared = prepared_->contacts[contact];
  return static_cast<double>(prepared.surface->Gap(prepared.Position(state)));
}

double ResidualCheck::Slip(std::size_t contact, const CheckedState& from, const CheckedState& to) const {
  const Prepared::PreparedContact& prepared = prepared_->contacts[contact];
  return static_cast<double>(prepared.surface->Slip(prepared.Position(from), prepared.Position(to)));
}

double ResidualCheck::TotalSlip(std::size_t contact, const CheckedState& state) const {
  const Prepared::PreparedContact& prepared = prepared_->contacts[contact];
  if (!prepared.slip_origin) throw std::invalid_argument("the law of friction is not total");
  return static_cast<double>(prepared.surface->Slip(*prepared.slip_origin, prepared.Position(state)));
}

std::array<double, 2> ResidualCheck::Normal(std::size_t contact, const CheckedState& state) const {
  const Prepared::PreparedContact& prepared = prepared_->contacts[contact];
  const Vector normal = prepared.Normal(state);
  return {static_cast<double>(normal.x), static_cast<double>(normal.y)};
}

std::vector<double> ResidualCheck::ForcesAcross(double length, double load_factor) const {
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
  std::vector<double> across;
  for (const Prepared::PreparedContact& contact : scene.contacts) {
    const check::StiffnessBound& bound = bounds[contact.node];
    const Vector normal = contact.surface->Normal(NodePosition(scene.start, contact.node));
    across.push_back(bound.any + std::abs(static_cast<double>(normal.x)) * bound.x +
                     std::abs(static_cast<double>(normal.y)) * bound.y);
  }
  return across;
}

double ResidualCheck::StrainEnergy(const std::vector<double>& positions, const std::vector<double>& rotations) const {
  RequireSize(positions, prepared_->num_positions, "positions");
  RequireSize(rotations, prepared_->start.size() - prepared_->num_positions, "rotations");
  const std::vector<double> values = check::ValuesOf(positions, rotations);
  Real energy = 0.0L;
  for (const auto& element : prepared_->elements) element->AddEnergy(values, &energy);
  return static_cast<double>(energy);
}

}  // namespace contact_path
