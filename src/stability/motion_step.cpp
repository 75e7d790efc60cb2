#include "stability/motion_step.h"

#include <algorithm>

#include "contact_path/equations/newton_loop.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr int kMostRounds = 40;  // of the active set: what takes more is done by shorter steps

}  // namespace

MachineEquation MachineEquation::Of(const Structure& structure, const Machine& machine, const PathPoint& at) {
  const Eigen::VectorXd row = machine.Row(structure);
  return {row, row.head(at.u.size()).dot(at.u) + row[at.u.size()] * at.s};
}

Eigen::VectorXd MachineEquation::Row(Eigen::Index unknowns) const {
  Eigen::VectorXd of_all = Eigen::VectorXd::Zero(unknowns);
  of_all.head(row.size()) = row;
  return of_all;
}

MotionStepSolver::MotionStepSolver(const Structure& structure, const Laws& laws, const MachineEquation& machine)
    : structure_(structure), laws_(laws), machine_(machine), system_(structure, laws) {}

PathPoint MotionStepSolver::AsOfArc(const PathPoint& point) {
  system_.SetModes(point.modes, laws_.ReferencesAt(point));
  return system_.Unpack(system_.Pack(point));
}

std::optional<MotionStep> MotionStepSolver::Solve(const PathPoint& from, const Eigen::VectorXd& drag,
                                                  const Eigen::VectorXd& anchor) {
  MotionStep step;
  step.acts_after.assign(laws_.size(), 0.0);
  Eigen::VectorXd references = laws_.ReferencesAt(from);
  PathPoint trial = from;
  for (int round = 0; round < kMostRounds; ++round) {
    system_.SetModes(trial.modes, references);
    Eigen::VectorXd x = system_.Pack(trial);
    if (!Newton(drag, anchor, &x, &step.iterations)) return std::nullopt;
    const std::vector<Change> changes = Changes(x);
    if (changes.empty()) {
      step.point = system_.Unpack(x);
      step.changed = !SameStates(step.point.modes, from.modes);
      for (std::size_t i = 0; i < laws_.size(); ++i) {
        if (step.acts_after[i] == 0.0 || laws_[i].Holonomic() || laws_[i].NumPorts() < 2) continue;
        const int piece = step.point.modes[i].piece;
        const double start = laws_[i].Motion(1, from.u, from.s, piece, {}),
                     way = laws_[i].Motion(1, step.point.u, step.point.s, piece, {}) - start;
        if (way != 0.0) step.acts_after[i] = (references[laws_.FirstPort(i) + 1] - start) / way;
      }
      return step;
    }
    for (const Change& change : changes) {
      NoteActing(from, change, x, &references, &step);
      trial.modes[change.law] = change.to;
    }
  }
  return std::nullopt;
}

void MotionStepSolver::NoteActing(const PathPoint& from, const Change& change, const Eigen::VectorXd& x,
                                  Eigen::VectorXd* references, MotionStep* step) const {
  const std::size_t i = change.law;
  const Law& law = laws_[i];
  const StateRule& acts = law.In(change.to);
  // What gives way from rest makes no impact.
  if (!law.In(from.modes[i]).idle || acts.idle || acts.ports[0].compliance != 0.0 || !law.In(system_.modes()[i]).idle)
    return;
  const double s = x[system_.NumDofs()];
  const int piece = change.to.piece;
  const double before = std::max(0.0, law.Motion(0, from.u, from.s, piece, {})), after = law.Motion(0, x, s, piece, {});
  const double share = after < 0.0 ? before / (before - after) : 1.0;
  step->acts_after[i] = share;
  if (law.Holonomic()) return;
  for (std::size_t p = 1; p < law.NumPorts(); ++p) {
    const double start = law.Motion(p, from.u, from.s, piece, {});
    (*references)[laws_.FirstPort(i) + static_cast<Eigen::Index>(p)] =
        start + share * (law.Motion(p, x, s, piece, {}) - start);
  }
}

std::vector<MotionStepSolver::Change> MotionStepSolver::Changes(const Eigen::VectorXd& x) const {
  std::vector<Change> changes;
  for (const Limit& limit : system_.mode_limits().All()) {
    const LimitRule& rule = system_.mode_limits().RuleOf(limit);
    double tolerance = tolerances::kActive * rule.unit;
    if (rule.OfForces()) tolerance *= system_.ResidualUnit();
    const double excess = -system_.Value(limit, x) / tolerance;
    if (!(excess > 1.0)) continue;
    const auto i = static_cast<std::size_t>(limit.law);
    // Of a law the worst one alone.
    if (!changes.empty() && changes.back().law == i) {
      if (changes.back().excess >= excess) continue;
      changes.pop_back();
    }
    changes.push_back({i, laws_[i].NextAt(x, x[system_.NumDofs()], system_.modes()[i], limit.id), excess});
  }
  return changes;
}

bool MotionStepSolver::Newton(const Eigen::VectorXd& drag, const Eigen::VectorXd& anchor, Eigen::VectorXd* x,
                              int* iterations) {
  const Eigen::Index nd = system_.NumDofs();
  const Eigen::VectorXd row = machine_.Row(system_.NumUnknowns());
  strains_to_ = x->head(nd + 1);
  const auto next = [&](const Eigen::VectorXd& at, bool refresh, Eigen::VectorXd* step) {
    system_.Residual(at, &residual_);
    residual_.head(nd) += drag.cwiseProduct(at.head(nd) - anchor);
    strains_from_ = strains_to_;
    strains_to_ = at.head(nd + 1);
    if (!residual_.allFinite()) return false;
    if (refresh) {
      jacobian_ =
          structure_.Mixed() ? system_.MixedJacobian(at, strains_from_, strains_to_) : system_.TransposedJacobian(at);
      for (Eigen::Index i = 0; i < drag.size(); ++i) jacobian_.coeffRef(i, i) += drag[i];
      if (!solver_.Factorize(jacobian_, row, system_.InFrame())) return false;
    }
    residual_ = -residual_;
    solver_.Solve(residual_, machine_.value - row.dot(at), step);
    return true;
  };
  NewtonLimits limits;
  limits.small = tolerances::kUnitComponent;
  limits.unit = system_.ResidualUnit();
  const NewtonCourse course = NewtonLoop(
      limits, true, next, [this](const Eigen::VectorXd& step) { return system_.Norm(step); }, x, &newton_step_);
  *iterations = course.iterations;
  return course.at_rounding;
}

}  // namespace contact_path
