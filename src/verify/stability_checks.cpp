#include "verify/stability_checks.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace contact_path {
namespace {

constexpr std::size_t kMostComponents = 60;  // second differences take time with their square

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
  const std::vector<Node>& nodes = stage_.scene.nodes;
  std::vector<bool> pinned(nodes.size());
  for (std::size_t i = 0; i < increment.contacts.size(); ++i) {
    const ContactState state = increment.contacts[i].state;
    if (state == ContactState::kOpen) continue;
    if (state != ContactState::kStick || of_surfaces_[i]) return std::nullopt;
    pinned[stage_.contacts[i].node] = true;
  }
  std::vector<std::size_t> free;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!pinned[i] && !nodes[i].fixed_x) free.push_back(2 * i);
    if (!pinned[i] && !nodes[i].fixed_y) free.push_back(2 * i + 1);
  }
  for (std::size_t i = 0; i < increment.rotations.size(); ++i)
    if (!nodes[i].fixed_rotation) free.push_back(2 * nodes.size() + i);
  if (free.size() > kMostComponents) return std::nullopt;
  return free;
}

Eigen::VectorXd StabilityChecks::Derivative(const Increment& increment, std::size_t component, double step) const {
  const std::size_t positions = increment.positions.size(), all = positions + increment.rotations.size();
  const double unit = component < positions ? stage_.scaling.length
                      : component < all     ? 1.0
                                            : stage_.scaling.load_factor;
  std::vector<double> sides[2];
  double difference = 0.0;
  for (const int side : {0, 1}) {
    CheckedState state = StateOf(increment);
    double& value = component < positions ? state.positions[component]
                    : component < all     ? state.rotations[component - positions]
                                          : state.load_factor;
    value += (side == 0 ? -step : step) * unit;
    difference += side == 0 ? -value : value;
    sides[side] = stage_.check.Unbalance(state);
  }
  const auto size = static_cast<Eigen::Index>(sides[0].size());
  return (Eigen::Map<const Eigen::VectorXd>(sides[1].data(), size) -
          Eigen::Map<const Eigen::VectorXd>(sides[0].data(), size)) /
         difference;
}

void StabilityChecks::Check(const Increment& increment) {
  const StabilityRecord& recorded = increment.stability;
  const bool inside = increment.kind == IncrementKind::kRegular && increment.event.branches.empty();
  if (!inside || recorded.stability == Verdict::kNotAsked || recorded.stability == Verdict::kNotProved) return;
  std::optional<std::vector<std::size_t>> components = FreeComponents(increment);
  if (!components) return;
  // By two steps, which tell how far differences are to be trusted.
  const double step = std::cbrt(std::numeric_limits<double>::epsilon());
  std::vector<Eigen::VectorXd> columns, by_longer;
  for (auto component = components->begin(); component != components->end();) {
    Eigen::VectorXd column = Derivative(increment, *component, step);
    // What no element moves with is no unknown, as the rotation of a node that no beam turns.
    if (column.isZero(0.0)) {
      component = components->erase(component);
    } else {
      columns.push_back(std::move(column));
      by_longer.push_back(Derivative(increment, *component, 2.0 * step));
      ++component;
    }
  }
  const auto size = static_cast<Eigen::Index>(components->size());
  if (size == 0) return;
  const auto of_components = [&](const Eigen::VectorXd& all) {
    Eigen::VectorXd own(size);
    for (Eigen::Index i = 0; i < size; ++i)
      own[i] = all[static_cast<Eigen::Index>((*components)[static_cast<std::size_t>(i)])];
    return own;
  };
  Eigen::MatrixXd stiffness(size, size), change(size, size);
  for (Eigen::Index k = 0; k < size; ++k) {
    stiffness.col(k) = of_components(columns[static_cast<std::size_t>(k)]);
    change.col(k) = of_components(by_longer[static_cast<std::size_t>(k)]) - stiffness.col(k);
  }
  Eigen::VectorXd load =
      -of_components(Derivative(increment, increment.positions.size() + increment.rotations.size(), step));
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
  // A prescribed displacement of the loads: its multiplier makes one eigenvalue negative.
  Eigen::MatrixXd bordered(size + 1, size + 1);
  const Eigen::VectorXd border = dead.largest / load.norm() * load;
  bordered << stiffness, border, border.transpose(), 0.0;
  const Inertia controlled = InertiaOf(bordered);
  if (!(controlled.smallest > kSingular + off)) return;
  const Verdict held = controlled.negative == 1 ? Verdict::kStable : Verdict::kUnstable;
  if (recorded.stability_controlled != Verdict::kNotProved && recorded.stability_controlled != held)
    findings_.Report("under displacement control it is recorded as ", ToString(recorded.stability_controlled),
                     ", but is ", ToString(held));
  if (dead.negative != 1 || held != Verdict::kStable || recorded.critical_stiffness < 0.0) return;
  const Eigen::VectorXd by_force = stiffness.fullPivLu().solve(load);
  const double critical = -1.0 / load.dot(by_force);
  // Residuals of kExact leave the place open by their share of the softest direction, and the stiffness follows the
  // place.
  const double open =
      (off + kExact + kExact / dead.smallest) * dead.largest * by_force.squaredNorm() * critical * critical;
  const double unit = std::pow(stage_.driving.size, 2);
  if (!(std::abs(recorded.critical_stiffness - critical * unit) <= open * unit))
    findings_.Report("the critical stiffness is recorded as ", recorded.critical_stiffness, ", but is ",
                     critical * unit);
}

}  // namespace contact_path
