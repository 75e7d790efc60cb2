#include "stability/motion_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "contact_path/equations/newton_loop.h"
#include "contact_path/equations/transitions.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr int kMostRounds = 40;     // of the active set: what takes more is done by shorter steps
constexpr int kRoundsTogether = 6;  // contacts change their states together, from then on one by one

// Of a contact that has been on `patch`.
int PatchOfOpen(const ContactPair& pair, int patch) { return pair.HasPatches() ? kNearestPatch : patch; }

int PatchOfClosing(const ContactPair& pair, const Eigen::VectorXd& x, double s) {
  const int patch = pair.PatchAt(x, s);
  if (!pair.HasPatches() || pair.HasPatch(patch)) return patch;
  return pair.HasPatch(patch + 1) ? patch + 1 : patch - 1;
}

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

MotionStepSolver::MotionStepSolver(const Structure& structure, const ContactPairs& contacts,
                                   const MachineEquation& machine)
    : structure_(structure), contacts_(contacts), machine_(machine), system_(structure, contacts) {}

PathPoint MotionStepSolver::WithPatches(const PathPoint& point) {
  system_.SetStates(point.states, SlipReferences(contacts_, point), point.patches);
  return system_.Unpack(system_.Pack(point));
}

std::optional<MotionStep> MotionStepSolver::Solve(const PathPoint& from, const Eigen::VectorXd& drag,
                                                  const Eigen::VectorXd& anchor) {
  MotionStep step;
  step.closed_after.assign(contacts_.size(), 0.0);
  Eigen::VectorXd references = SlipReferences(contacts_, from);
  PathPoint trial = from;
  for (std::size_t i = 0; i < trial.patches.size(); ++i)
    if (from.states[i] != ContactState::kOpen)
      trial.patches[i] = contacts_[i]->PatchNow(from.u, from.s, from.patches[i]);
  std::set<std::pair<std::vector<ContactState>, std::vector<int>>> tried;
  for (; step.rounds < kMostRounds; ++step.rounds) {
    system_.SetStates(trial.states, references, trial.patches);
    Eigen::VectorXd x = system_.Pack(trial);
    if (!Newton(drag, anchor, &x, &step.iterations)) return std::nullopt;
    std::vector<Change> changes = Changes(x);
    if (changes.empty()) {
      step.point = system_.Unpack(x);
      step.determinant_sign = solver_.DeterminantSign();
      step.changed = step.point.states != from.states;
      for (std::size_t i = 0; i < contacts_.size(); ++i) {
        if (step.closed_after[i] == 0.0 || contacts_[i]->HasTotalLaw()) continue;
        const int patch = step.point.Patch(i);
        const double start = contacts_[i]->Xi(from.u, from.s, patch),
                     way = contacts_[i]->Xi(step.point.u, step.point.s, patch) - start;
        if (way != 0.0) step.closed_after[i] = (references[static_cast<Eigen::Index>(i)] - start) / way;
      }
      return step;
    }
    const bool again = !tried.emplace(trial.states, trial.patches).second;
    if (again || step.rounds >= kRoundsTogether) {
      std::iter_swap(changes.begin(),
                     std::max_element(changes.begin(), changes.end(),
                                      [](const Change& a, const Change& b) { return a.excess < b.excess; }));
      changes.resize(1);
    }
    for (const Change& change : changes) {
      NoteClosing(from, change, x, &references, &step);
      trial.states[change.contact] = change.to.state;
      if (!trial.patches.empty()) trial.patches[change.contact] = change.to.patch;
    }
  }
  return std::nullopt;
}

void MotionStepSolver::NoteClosing(const PathPoint& from, const Change& change, const Eigen::VectorXd& x,
                                   Eigen::VectorXd* references, MotionStep* step) const {
  const std::size_t i = change.contact;
  const bool closes = from.states[i] == ContactState::kOpen && change.to.state != ContactState::kOpen;
  if (!closes || system_.states()[i] != ContactState::kOpen) return;
  const ContactPair& pair = *contacts_[i];
  const double s = x[system_.NumDofs()];
  const double before = std::max(0.0, pair.Gap(from.u, from.s, change.to.patch)),
               after = pair.Gap(x, s, change.to.patch);
  const double share = after < 0.0 ? before / (before - after) : 1.0;
  step->closed_after[i] = share;
  if (pair.HasTotalLaw()) return;
  const double start = pair.Xi(from.u, from.s, change.to.patch);
  (*references)[static_cast<Eigen::Index>(i)] = start + share * (pair.Xi(x, s, change.to.patch) - start);
}

std::vector<MotionStepSolver::Change> MotionStepSolver::Changes(const Eigen::VectorXd& x) const {
  std::vector<Change> changes;
  for (const Constraint& constraint : system_.Inequalities()) {
    double tolerance = tolerances::kActive * system_.UnitOf(constraint);
    if (!IsMotion(constraint.inequality)) tolerance *= system_.ResidualUnit();
    const double excess = -system_.Value(constraint, x) / tolerance;
    if (!(excess > 1.0)) continue;
    const auto contact = static_cast<std::size_t>(constraint.contact);
    // Of a contact the worst one alone.
    if (!changes.empty() && changes.back().contact == contact) {
      if (changes.back().excess >= excess) continue;
      changes.pop_back();
    }
    changes.push_back({contact, Next(constraint, x), excess});
  }
  return changes;
}

ContactMode MotionStepSolver::Next(const Constraint& violated, const Eigen::VectorXd& x) const {
  const auto i = static_cast<std::size_t>(violated.contact);
  const ContactPair& pair = *contacts_[i];
  const int patch = system_.patches()[i];
  ContactMode next = NextMode(pair, violated.inequality, {system_.states()[i], patch});
  if (violated.inequality == Inequality::kGap) next.patch = PatchOfClosing(pair, x, x[system_.NumDofs()]);
  if (KeepsPatch(violated.inequality) && !pair.HasPatch(next.patch)) next.state = ContactState::kOpen;
  if (next.state == ContactState::kOpen) next.patch = PatchOfOpen(pair, patch);
  return next;
}

bool MotionStepSolver::Factorize(const Eigen::VectorXd& x, const Eigen::VectorXd& drag, const Eigen::VectorXd& row) {
  jacobian_ = structure_.Mixed() ? system_.MixedJacobian(x, strains_from_, strains_to_) : system_.TransposedJacobian(x);
  for (Eigen::Index i = 0; i < drag.size(); ++i) jacobian_.coeffRef(i, i) += drag[i];
  return solver_.Factorize(jacobian_, row, system_.InFrame());
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
    if (!residual_.allFinite() || (refresh && !Factorize(at, drag, row))) return false;
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

int MotionStepSolver::DeterminantSign(const PathPoint& point, const Eigen::VectorXd& drag) {
  system_.SetStates(point.states, SlipReferences(contacts_, point), point.patches);
  const Eigen::VectorXd x = system_.Pack(point);
  strains_from_ = strains_to_ = x.head(system_.NumDofs() + 1);
  return Factorize(x, drag, machine_.Row(system_.NumUnknowns())) ? solver_.DeterminantSign() : 0;
}

}  // namespace contact_path
