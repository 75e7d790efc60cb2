#include "verify/checks.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "contact_path/scene/expand.h"

namespace contact_path {
namespace {

constexpr std::size_t kMostComponents = 400;  // eigenvalues take time with their third power
constexpr double kBeside = 1e-6;              // of the length of the scene

// Of a symmetric matrix.
struct Inertia {
  int negative = 0;
  double smallest = 0.0;  // eigenvalue in magnitude, over the largest
  double largest = 0.0;
};

Inertia InertiaOf(const Eigen::MatrixXd& matrix) {
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
  const double largest = values.cwiseAbs().maxCoeff();
  return {static_cast<int>((values.array() < 0.0).count()), values.cwiseAbs().minCoeff() / largest, largest};
}

}  // namespace

StabilityChecks::StabilityChecks(const VerifiedStage& stage, Findings* findings, Verification* result)
    : stage_(stage), findings_(*findings), result_(*result) {
  for (const ContactCandidate& contact : stage.scene.contacts) of_surfaces_.push_back(contact.OnSurface());
}

std::optional<std::vector<std::size_t>> StabilityChecks::FreeComponents(const Increment& increment) const {
  if (!stage_.scene.pins.empty()) return std::nullopt;
  const std::vector<Node>& nodes = stage_.scene.nodes;
  std::vector<bool> pinned(nodes.size());
  for (std::size_t i = 0; i < increment.contacts.size(); ++i) {
    const ContactState state = increment.contacts[i].state;
    if (state == ContactState::kOpen) continue;
    if (state != ContactState::kStick || of_surfaces_[i] || stage_.check.Give(i) > 0.0) return std::nullopt;
    pinned[stage_.contacts[i].node] = true;
  }
  std::vector<std::size_t> free;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (IsAttached(nodes[i])) continue;
    if (!pinned[i] && !nodes[i].fixed_x) free.push_back(2 * i);
    if (!pinned[i] && !nodes[i].fixed_y) free.push_back(2 * i + 1);
  }
  for (std::size_t i = 0; i < increment.rotations.size(); ++i)
    if (!nodes[i].fixed_rotation && !IsAttached(nodes[i])) free.push_back(2 * nodes.size() + i);
  if (free.size() > kMostComponents) return std::nullopt;
  return free;
}

StabilityChecks::Change StabilityChecks::ChangeBy(const Increment& increment,
                                                  const std::vector<std::size_t>& components, double step) const {
  const std::size_t positions = increment.positions.size(), all = positions + increment.rotations.size();
  Change change;
  change.motions.resize(components.size());
  std::vector<double> sides[2];
  for (const int side : {0, 1}) {
    CheckedState state = StateOf(increment);
    for (std::size_t i = 0; i < components.size(); ++i) {
      const std::size_t component = components[i];
      const double unit = component < positions ? stage_.scaling.length
                          : component < all     ? 1.0
                                                : stage_.scaling.load_factor;
      double& value = component < positions ? state.positions[component]
                      : component < all     ? state.rotations[component - positions]
                                            : state.load_factor;
      value += (side == 0 ? -step : step) * unit;
      change.motions[i] += side == 0 ? -value : value;
    }
    sides[side] = stage_.check.Unbalance(state);
  }
  const auto size = static_cast<Eigen::Index>(sides[0].size());
  change.forces = Eigen::Map<const Eigen::VectorXd>(sides[1].data(), size) -
                  Eigen::Map<const Eigen::VectorXd>(sides[0].data(), size);
  return change;
}

std::size_t StabilityChecks::NodeOf(std::size_t component) const {
  const std::size_t positions = 2 * stage_.scene.nodes.size();
  return component < positions ? component / 2 : component - positions;
}

void StabilityChecks::FindCouplings(const Increment& increment, double step) {
  const std::size_t nodes = stage_.scene.nodes.size(), all = increment.positions.size() + increment.rotations.size();
  // Beside the increment, where no entry is zero by chance.
  Increment beside = increment;
  for (std::size_t i = 0; i < beside.positions.size(); ++i)
    beside.positions[i] += kBeside * stage_.scaling.length * std::sin(static_cast<double>(i + 1));
  coupled_.assign(nodes, {});
  for (std::size_t component = 0; component < all; ++component) {
    const Eigen::VectorXd forces = ChangeBy(beside, {component}, step).forces;
    for (std::size_t k = 0; k < all; ++k)
      if (forces[static_cast<Eigen::Index>(k)] != 0.0) coupled_[NodeOf(component)].insert(NodeOf(k));
  }
  groups_.clear();
  bars_of_groups_ = increment.bars;
  std::vector<std::set<std::size_t>> reached;  // by group
  for (std::size_t node = 0; node < nodes; ++node) {
    const auto apart = [&](const std::set<std::size_t>& by_others) {
      return std::none_of(coupled_[node].begin(), coupled_[node].end(),
                          [&](std::size_t other) { return by_others.count(other) > 0; });
    };
    const auto group = static_cast<std::size_t>(std::find_if(reached.begin(), reached.end(), apart) - reached.begin());
    if (group == reached.size()) {
      reached.emplace_back();
      groups_.emplace_back();
    }
    reached[group].insert(coupled_[node].begin(), coupled_[node].end());
    groups_[group].push_back(node);
  }
}

Eigen::MatrixXd StabilityChecks::Stiffness(const Increment& increment, const std::vector<std::size_t>& components,
                                           double step) const {
  const std::size_t positions = increment.positions.size(), all = positions + increment.rotations.size();
  std::vector<Eigen::Index> place(all, -1);
  for (std::size_t k = 0; k < components.size(); ++k) place[components[k]] = static_cast<Eigen::Index>(k);
  const auto component_of = [&](std::size_t node, std::size_t axis) {
    return axis < 2 ? 2 * node + axis : positions + node;
  };
  const std::size_t axes = all > positions ? 3 : 2, size = components.size();
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(size), static_cast<Eigen::Index>(size));
  for (const std::vector<std::size_t>& group : groups_)
    for (std::size_t axis = 0; axis < axes; ++axis) {
      std::vector<std::size_t> moved;
      for (const std::size_t node : group)
        if (place[component_of(node, axis)] >= 0) moved.push_back(component_of(node, axis));
      const Change change = ChangeBy(increment, moved, step);
      for (std::size_t i = 0; i < moved.size(); ++i)
        for (const std::size_t node : coupled_[NodeOf(moved[i])])
          for (std::size_t of = 0; of < axes; ++of) {
            const std::size_t row = component_of(node, of);
            if (place[row] >= 0)
              stiffness(place[row], place[moved[i]]) =
                  change.forces[static_cast<Eigen::Index>(row)] / change.motions[i];
          }
    }
  return stiffness;
}

void StabilityChecks::Check(const Increment& increment, double machine_stiffness) {
  const StabilityRecord& recorded = increment.stability;
  if (recorded.stability == Verdict::kNotAsked || recorded.stability == Verdict::kNotProved) return;
  ++result_.open_verdicts;
  const bool inside = increment.kind == IncrementKind::kRegular && increment.event.branches.empty();
  if (!inside || increment.positions.empty()) return;
  std::optional<std::vector<std::size_t>> components = FreeComponents(increment);
  if (!components) return;
  // By two steps, which tell how far differences are to be trusted.
  const double step = std::cbrt(std::numeric_limits<double>::epsilon());
  if (groups_.empty() || increment.bars != bars_of_groups_) FindCouplings(increment, step);
  Eigen::MatrixXd stiffness = Stiffness(increment, *components, step);
  // What no element moves with is no unknown, as the rotation of a node that no beam turns.
  std::vector<std::size_t> moving;
  for (std::size_t k = 0; k < components->size(); ++k)
    if (!stiffness.col(static_cast<Eigen::Index>(k)).isZero(0.0)) moving.push_back((*components)[k]);
  if (moving.empty()) return;
  if (moving.size() < components->size()) stiffness = Stiffness(increment, moving, step);
  components->swap(moving);
  Eigen::MatrixXd change = Stiffness(increment, *components, 2.0 * step) - stiffness;
  const Eigen::Index size = stiffness.rows();
  const Change by_load = ChangeBy(increment, {increment.positions.size() + increment.rotations.size()}, step);
  Eigen::VectorXd load(size);
  for (Eigen::Index i = 0; i < size; ++i)
    load[i] = -by_load.forces[static_cast<Eigen::Index>((*components)[static_cast<std::size_t>(i)])] /
              by_load.motions.front();
  stiffness = 0.5 * (stiffness + stiffness.transpose()).eval();
  // Turns times the length of the scene are motions.
  for (Eigen::Index i = 0; i < size; ++i) {
    if ((*components)[static_cast<std::size_t>(i)] < increment.positions.size()) continue;
    for (Eigen::MatrixXd* const matrix : {&stiffness, &change}) {
      matrix->row(i) /= stage_.scaling.length;
      matrix->col(i) /= stage_.scaling.length;
    }
    load[i] /= stage_.scaling.length;
  }
  const Inertia dead = InertiaOf(stiffness);
  // An error that grows as the step shrinks, as at a kink of the forces, is twice the change; a smooth one is a third.
  const double off = 2.0 * change.norm() / dead.largest;
  if (!(dead.smallest > kSingular + off)) return;  // next to a singular point differences do not tell
  ++result_.proved_verdicts;
  --result_.open_verdicts;
  const Verdict verdict = dead.negative == 0 ? Verdict::kStable : Verdict::kUnstable;
  if (recorded.stability != verdict)
    findings_.Report("is recorded as ", ToString(recorded.stability), ", but is ", ToString(verdict));
  if (recorded.unstable_directions != dead.negative)
    findings_.Report("unstable directions are recorded as ", recorded.unstable_directions, ", but are ", dead.negative);
  const auto nodes = static_cast<Eigen::Index>(increment.positions.size());
  if (static_cast<Eigen::Index>(recorded.unstable_direction.size()) == nodes) {
    Eigen::VectorXd direction = Eigen::VectorXd::Zero(size);
    for (Eigen::Index i = 0; i < size; ++i)
      if ((*components)[static_cast<std::size_t>(i)] < increment.positions.size())
        direction[i] = recorded.unstable_direction[(*components)[static_cast<std::size_t>(i)]];
    // Rotations are not recorded: they follow.
    if (increment.rotations.empty() &&
        !(direction.dot(stiffness * direction) < kSingular * dead.largest * direction.squaredNorm()))
      findings_.Report("the strain energy less the work of the loads does not fall along the unstable direction");
  }
  if (stage_.Driven() || load.isZero(0.0)) return;
  // The bordered matrix has minus the compliance of the machine in its corner, none for a prescribed displacement of
  // the loads: its multiplier makes one eigenvalue negative.
  const double unit = std::pow(stage_.driving.size, 2), border = dead.largest / load.norm();
  const double compliance = machine_stiffness > 0.0 ? border * border * unit / machine_stiffness : 0.0;
  Eigen::MatrixXd bordered(size + 1, size + 1);
  bordered << stiffness, border * load, border * load.transpose(), -compliance;
  const Inertia controlled = InertiaOf(bordered);
  if (!(controlled.smallest > kSingular + off)) return;
  const Verdict held = controlled.negative == 1 ? Verdict::kStable : Verdict::kUnstable;
  if (recorded.stability_controlled != Verdict::kNotProved && recorded.stability_controlled != held)
    findings_.Report("under the machine it is recorded as ", ToString(recorded.stability_controlled), ", but is ",
                     ToString(held));
  if (dead.negative != 1 || !(recorded.critical_stiffness > 0.0) || std::isinf(recorded.critical_stiffness)) return;
  const Eigen::VectorXd by_force = stiffness.fullPivLu().solve(load);
  const double critical = -1.0 / load.dot(by_force);
  // Residuals of kExact leave the place open by their share of the softest direction, and the stiffness follows the
  // place.
  const double open =
      (off + kExact + kExact / dead.smallest) * dead.largest * by_force.squaredNorm() * critical * critical;
  if (!(std::abs(recorded.critical_stiffness - critical * unit) <= open * unit))
    findings_.Report("the critical stiffness is recorded as ", recorded.critical_stiffness, ", but is ",
                     critical * unit);
}

}  // namespace contact_path
