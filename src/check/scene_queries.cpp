// What the check tells of a state besides residuals: forces, answers, gaps, slips, energies and bounds.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "check/prepared_scene.h"

namespace contact_path {
namespace {

using check::Dot;
using check::Real;
using check::Vector;

}  // namespace

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
    const Vector normal = contact.Normal(placed), velocity = contact.Velocity(placed);
    force += state.rn[i] * Dot(normal, velocity) + state.rt[i] * Dot(Right(normal), velocity);
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
  return prepared_->contacts[contact]->Gives() ? prepared_->Give() : 0.0;
}

double ResidualCheck::GiveOfPin(std::size_t pin) const { return prepared_->pins[pin].gives ? prepared_->Give() : 0.0; }

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

double ResidualCheck::SlidingForce(std::size_t contact, const CheckedState& given) const {
  const CheckedState state = prepared_->attached->Settled(given);
  const double rn = state.rn[contact];
  return Friction(contact, state) * rn * static_cast<double>(prepared_->contacts[contact]->Stretch(rn));
}

std::optional<double> ResidualCheck::NormalByPlace(std::size_t contact, const CheckedState& given) const {
  const CheckedState state = prepared_->attached->Settled(given);
  const std::optional<Real> normal = prepared_->contacts[contact]->NormalByPlace(prepared_->Placed(state));
  return normal ? std::optional(static_cast<double>(*normal)) : std::nullopt;
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
  check::RequireSize(positions, prepared_->num_positions, "positions");
  check::RequireSize(rotations, prepared_->start.size() - prepared_->num_positions, "rotations");
  const std::vector<double> values = check::ValuesOf(positions, rotations);
  Real energy = 0.0L;
  for (const auto& element : prepared_->elements) element->AddEnergy(values, &energy);
  return static_cast<double>(energy);
}

}  // namespace contact_path
