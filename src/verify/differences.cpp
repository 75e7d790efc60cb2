#include "verify/differences.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact_path/scene/expand.h"

namespace contact_path {
namespace {

constexpr std::size_t kMostComponents = 400;  // eigenvalues take time with their third power
constexpr double kBeside = 1e-6;              // of the length of the scene
constexpr double kKink = 1e-3;                // of the stiffness: what differs on both sides
constexpr double kSoftest = 1e-6;             // of the largest stiffness, below which rounding bends
constexpr double kNoStiffness = 1e-13;        // of the largest one: rounding

Eigen::VectorXd AsVector(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

std::vector<bool> Touching(const Increment& increment) {
  std::vector<bool> touching;
  for (const ContactRecord& contact : increment.contacts) touching.push_back(contact.state != ContactState::kOpen);
  return touching;
}

// The largest entry of each row of the stiffness becomes about 1.
void Equilibrate(DisturbedIncrement* found) {
  Disturbed& of = found->disturbed;
  const double largest = of.stiffness.cwiseAbs().maxCoeff();
  const Eigen::VectorXd rows = of.stiffness.cwiseAbs().rowwise().maxCoeff();
  found->units = (rows.array() > kNoStiffness * largest).select(rows, 1.0).cwiseSqrt().cwiseInverse();
  const auto scale = found->units.asDiagonal();
  for (Eigen::MatrixXd* const matrix : {&of.stiffness, &of.change}) *matrix = (scale * *matrix * scale).eval();
  of.held = (scale * of.held).eval();
  found->load = (scale * found->load).eval();
  for (Sliding& sliding : of.sliding)
    for (Eigen::VectorXd* const by : {&sliding.by_place, &sliding.change})
      if (by->size() > 0) *by = (scale * *by).eval();
}

}  // namespace

Differences::Differences(const VerifiedStage& stage) : stage_(stage), turns_(NodesThatTurn(stage.scene)) {}

std::vector<std::size_t> Differences::FreeComponents() const {
  const std::vector<Node>& nodes = stage_.scene.nodes;
  std::vector<std::size_t> free;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (IsAttached(nodes[i])) continue;
    if (!nodes[i].fixed_x) free.push_back(2 * i);
    if (!nodes[i].fixed_y) free.push_back(2 * i + 1);
  }
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (turns_[i] && !nodes[i].fixed_rotation && !IsAttached(nodes[i])) free.push_back(2 * nodes.size() + i);
  return free;
}

std::size_t Differences::NodeOf(std::size_t component) const {
  const std::size_t positions = 2 * stage_.scene.nodes.size();
  return component < positions ? component / 2 : component - positions;
}

double Differences::UnitOf(std::size_t component) const {
  return component < 2 * stage_.scene.nodes.size() ? stage_.scaling.length : 1.0;
}

Differences::Change Differences::ChangeBy(const CheckedState& at, const std::vector<std::size_t>& components,
                                          double step) const {
  const std::size_t positions = at.positions.size();
  Change change;
  change.motions.resize(components.size());
  Eigen::VectorXd sides[2];
  for (const int side : {0, 1}) {
    CheckedState state = at;
    for (std::size_t i = 0; i < components.size(); ++i) {
      const std::size_t component = components[i];
      double& value = component < positions ? state.positions[component] : state.rotations[component - positions];
      value += (side == 0 ? -step : step) * UnitOf(component);
      change.motions[i] += side == 0 ? -value : value;
    }
    sides[side] = AsVector(stage_.check.Unbalance(state));
  }
  change.forces = sides[1] - sides[0];
  change.bend = sides[1] + sides[0] - 2.0 * AsVector(stage_.check.Unbalance(at));
  return change;
}

Eigen::VectorXd Differences::ForcesBy(const CheckedState& at, double* (*number)(CheckedState*, std::size_t),
                                      std::size_t place, double step) const {
  CheckedState less = at, more = at;
  *number(&less, place) -= step;
  *number(&more, place) += step;
  return (AsVector(stage_.check.Unbalance(less)) - AsVector(stage_.check.Unbalance(more))) /
         (*number(&more, place) - *number(&less, place));
}

void Differences::FindCouplings(const Increment& increment, double step) {
  const std::size_t nodes = stage_.scene.nodes.size(), all = increment.positions.size() + increment.rotations.size();
  bars_of_groups_ = increment.bars;
  touching_in_groups_ = Touching(increment);
  // Beside the increment, and with reactions, where no entry is zero by chance.
  CheckedState beside = StateOf(increment);
  const auto generic = [](std::size_t i) { return std::sin(static_cast<double>(i + 1)); };
  for (std::size_t i = 0; i < beside.positions.size(); ++i)
    beside.positions[i] += kBeside * stage_.scaling.length * generic(i);
  for (std::size_t i = 0; i < beside.rotations.size(); ++i) beside.rotations[i] += kBeside * generic(i);
  for (std::size_t i = 0; i < beside.rn.size(); ++i) {
    if (!touching_in_groups_[i]) continue;
    beside.rn[i] += stage_.scaling.force * (2.0 + generic(i));
    beside.rt[i] += stage_.scaling.force * (2.0 - generic(i));
  }
  for (std::size_t i = 0; i < beside.pins.size(); ++i) beside.pins[i] += stage_.scaling.force * (2.0 + generic(i));
  coupled_.assign(nodes, {});
  for (std::size_t component = 0; component < all; ++component) {
    const Eigen::VectorXd forces = ChangeBy(beside, {component}, step).forces;
    for (std::size_t k = 0; k < all; ++k)
      if (forces[static_cast<Eigen::Index>(k)] != 0.0) coupled_[NodeOf(component)].insert(NodeOf(k));
  }
  // A foot goes from patch to patch.
  for (std::size_t i = 0; i < stage_.contacts.size(); ++i) {
    if (!touching_in_groups_[i] || !stage_.scene.contacts[i].OnSurface()) continue;
    std::vector<std::size_t> pair = {stage_.contacts[i].node};
    for (const BoundarySurface& surface : stage_.scene.surfaces)
      if (surface.name == stage_.scene.contacts[i].surface)
        for (const std::string& node : surface.nodes) pair.push_back(stage_.index.Node(node));
    for (const std::size_t node : pair) coupled_[node].insert(pair.begin(), pair.end());
  }
  MakeGroups();
}

void Differences::MakeGroups() {
  groups_.clear();
  std::vector<std::set<std::size_t>> reached;  // by group
  for (std::size_t node = 0; node < coupled_.size(); ++node) {
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

Eigen::MatrixXd Differences::Stiffness(const CheckedState& at, const std::vector<std::size_t>& components, double step,
                                       Eigen::MatrixXd* bend) const {
  const std::size_t positions = at.positions.size(), all = positions + at.rotations.size();
  const double energy = stage_.Energy();
  std::vector<Eigen::Index> place(all, -1);
  for (std::size_t k = 0; k < components.size(); ++k) place[components[k]] = static_cast<Eigen::Index>(k);
  const auto component_of = [&](std::size_t node, std::size_t axis) {
    return axis < 2 ? 2 * node + axis : positions + node;
  };
  const std::size_t axes = all > positions ? 3 : 2;
  const auto size = static_cast<Eigen::Index>(components.size());
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(size, size);
  if (bend != nullptr) *bend = stiffness;
  for (const std::vector<std::size_t>& group : groups_)
    for (std::size_t axis = 0; axis < axes; ++axis) {
      std::vector<std::size_t> moved;
      for (const std::size_t node : group)
        if (place[component_of(node, axis)] >= 0) moved.push_back(component_of(node, axis));
      if (moved.empty()) continue;
      const Change change = ChangeBy(at, moved, step);
      for (std::size_t i = 0; i < moved.size(); ++i)
        for (const std::size_t node : coupled_[NodeOf(moved[i])])
          for (std::size_t of = 0; of < axes; ++of) {
            const std::size_t row = component_of(node, of);
            if (place[row] < 0) continue;
            const double unit = UnitOf(row) * UnitOf(moved[i]) / (change.motions[i] * energy);
            stiffness(place[row], place[moved[i]]) = unit * change.forces[static_cast<Eigen::Index>(row)];
            if (bend != nullptr)
              (*bend)(place[row], place[moved[i]]) = unit * change.bend[static_cast<Eigen::Index>(row)];
          }
    }
  return stiffness;
}

Eigen::VectorXd Differences::FrictionByPlace(std::size_t contact, const CheckedState& at,
                                             const std::vector<std::size_t>& components, double step) const {
  const std::size_t positions = at.positions.size();
  Eigen::VectorXd change(static_cast<Eigen::Index>(components.size()));
  for (std::size_t k = 0; k < components.size(); ++k) {
    const std::size_t component = components[k];
    double sides[2];
    for (const int side : {0, 1}) {
      CheckedState state = at;
      double& value = component < positions ? state.positions[component] : state.rotations[component - positions];
      value += (side == 0 ? -step : step) * UnitOf(component);
      state.rn[contact] = *stage_.check.NormalByPlace(contact, state);
      sides[side] = stage_.check.SlidingForce(contact, state);
    }
    change[static_cast<Eigen::Index>(k)] = (sides[1] - sides[0]) / (2.0 * step * stage_.scaling.force);
  }
  return change;
}

void Differences::AddReactions(const Increment& increment, const CheckedState& at, double step,
                               DisturbedIncrement* found) const {
  const double force = stage_.scaling.force, give = force / stage_.scaling.length;
  std::vector<Eigen::VectorXd> columns;
  std::vector<double> gives;
  const auto add = [&](const Eigen::VectorXd& forces, double gives_way) {
    Eigen::VectorXd& column = columns.emplace_back(static_cast<Eigen::Index>(found->components.size()));
    for (Eigen::Index k = 0; k < column.size(); ++k) {
      const std::size_t component = found->components[static_cast<std::size_t>(k)];
      column[k] = forces[static_cast<Eigen::Index>(component)] * UnitOf(component) / stage_.scaling.length;
    }
    gives.push_back(gives_way * give);
    return static_cast<Eigen::Index>(columns.size()) - 1;
  };
  for (std::size_t i = 0; i < increment.contacts.size(); ++i) {
    const ContactState state = increment.contacts[i].state;
    if (state == ContactState::kOpen) continue;
    Sliding sliding;
    double stretch = 1.0;
    if (!stage_.check.NormalByPlace(i, at)) {
      sliding.across = add(ForcesBy(
                               at, [](CheckedState* of, std::size_t k) { return &of->rn[k]; }, i, force),
                           stage_.check.Give(i));
    } else if (const double bound = stage_.check.Friction(i, at) * at.rn[i]; bound > 0.0) {
      stretch = stage_.check.SlidingForce(i, at) / bound;
    }
    if (state == ContactState::kClosed) continue;
    sliding.along = add(ForcesBy(
                            at, [](CheckedState* of, std::size_t k) { return &of->rt[k]; }, i, force) /
                            stretch,
                        stage_.check.Give(i));
    if (!Slips(state)) continue;
    sliding.sense = state == ContactState::kSlipPlus ? 1.0 : -1.0;
    sliding.friction = stage_.check.Friction(i, at);
    if (!sliding.across) {
      sliding.by_place = FrictionByPlace(i, at, found->components, step);
      sliding.change = FrictionByPlace(i, at, found->components, 2.0 * step) - sliding.by_place;
    }
    found->disturbed.sliding.push_back(std::move(sliding));
  }
  for (std::size_t k = 0; k < at.pins.size(); ++k)
    add(ForcesBy(
            at, [](CheckedState* of, std::size_t place) { return &of->pins[place]; }, k, force),
        stage_.check.GiveOfPin(k / 2));
  found->disturbed.held.resize(static_cast<Eigen::Index>(found->components.size()),
                               static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) found->disturbed.held.col(static_cast<Eigen::Index>(k)) = columns[k];
  found->disturbed.give = AsVector(gives);
}

void Differences::KeepMoving(DisturbedIncrement* found) const {
  Disturbed& of = found->disturbed;
  std::vector<Eigen::Index> moving;
  std::vector<std::size_t> components;
  for (Eigen::Index k = 0; k < found->load.size(); ++k) {
    const std::size_t component = found->components[static_cast<std::size_t>(k)];
    if (of.stiffness.col(k).isZero(0.0) && of.held.row(k).isZero(0.0) && !IsBody(stage_.scene.nodes[NodeOf(component)]))
      continue;
    moving.push_back(k);
    components.push_back(component);
  }
  for (Eigen::MatrixXd* const matrix : {&of.stiffness, &of.change}) *matrix = (*matrix)(moving, moving).eval();
  of.held = of.held(moving, Eigen::all).eval();
  found->load = found->load(moving).eval();
  for (Sliding& sliding : of.sliding)
    for (Eigen::VectorXd* const by : {&sliding.by_place, &sliding.change})
      if (by->size() > 0) *by = (*by)(moving).eval();
  found->components = std::move(components);
}

std::optional<DisturbedIncrement> Differences::At(const Increment& increment) {
  DisturbedIncrement found;
  Disturbed& of = found.disturbed;
  found.components = FreeComponents();
  if (found.components.empty() || found.components.size() > kMostComponents) return std::nullopt;
  const CheckedState at = StateOf(increment);
  // What touches without force may move apart, or not.
  if (TouchesWithoutForce(increment, stage_.scaling)) return std::nullopt;
  // By two steps, which tell how far differences are to be trusted.
  const double step = std::cbrt(std::numeric_limits<double>::epsilon());
  if (groups_.empty() || increment.bars != bars_of_groups_ || Touching(increment) != touching_in_groups_)
    FindCouplings(increment, step);
  Eigen::MatrixXd bend;
  of.stiffness = Stiffness(at, found.components, step, &bend);
  of.change = Stiffness(at, found.components, 2.0 * step, nullptr) - of.stiffness;
  // Where a string goes slack or a piece of a boundary ends next to the place, differences tell nothing.
  const Eigen::MatrixXd sizes = of.stiffness.cwiseAbs();
  const Eigen::VectorXd rows = sizes.rowwise().maxCoeff().cwiseMax(kSoftest * sizes.maxCoeff()).cwiseSqrt();
  if ((bend.cwiseAbs().array() > kKink * (rows * rows.transpose()).array()).any()) return std::nullopt;
  AddReactions(increment, at, step, &found);
  if (!of.sliding.empty() && stage_.configuration.HasTotalLaw()) return std::nullopt;
  const Eigen::VectorXd by_load = ForcesBy(
      at, [](CheckedState* state, std::size_t) { return &state->load_factor; }, 0, step * stage_.scaling.load_factor);
  found.load.resize(of.stiffness.rows());
  for (Eigen::Index k = 0; k < found.load.size(); ++k) {
    const std::size_t component = found.components[static_cast<std::size_t>(k)];
    found.load[k] = by_load[static_cast<Eigen::Index>(component)] * UnitOf(component) / stage_.Energy();
  }
  KeepMoving(&found);
  if (found.components.empty()) return std::nullopt;
  if (!of.stiffness.allFinite() || !of.change.allFinite() || !of.held.allFinite() || !found.load.allFinite())
    return std::nullopt;
  Equilibrate(&found);
  return found;
}

}  // namespace contact_path
