#include "contact_path/path/event_passing.h"

#include <algorithm>

#include "contact_path/branch/bifurcation_branches.h"
#include "contact_path/path/sentences.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

// Of the wanted step: where a branch, or a load that is level, is looked at again. A branch up to this length, too.
constexpr double kAhead = 0.1;

}  // namespace

IncrementKind EventFacts::Kind() const {
  if (leaves_curve && load_turns) return IncrementKind::kCornerLimit;
  if (contact_event) return IncrementKind::kContactEvent;
  if (smooth_limit && !leaves_curve) return IncrementKind::kSmoothLimit;
  if (bifurcation) return IncrementKind::kBifurcation;
  if (sample) return IncrementKind::kSample;
  return onset ? IncrementKind::kOnset : IncrementKind::kRegular;
}

std::optional<End> EventPassing::Pass(const ArcStep& at, const Before& before, AcceptedPoint* increment,
                                      CurvePoint* current, EventFacts* facts) {
  before_ = before;
  current_ = current;
  const EventKind kind = at.event.Kind();
  if (kind == EventKind::kBifurcation) return PassBifurcation(at, increment, facts);
  if (kind == EventKind::kContactEvent) return PassContactEvent(at, increment, facts);
  facts->sample = kind == EventKind::kSample;
  facts->smooth_limit = kind == EventKind::kLimitPoint;
  if (facts->smooth_limit && at.event.crossing) {
    increment->event.null_vector = CrossingPath(*at.event.crossing);
    if (!limit_->IsFollowed()) return PassBifurcation(at, increment, facts);
  }
  return options_.ChoiceAt(before_.increments, 0) == nullptr ? std::nullopt : PassChoice(at, increment, facts);
}

Verdict EventPassing::VerdictAlong(const CurveDerivatives& curve) {
  const Eigen::Index n = arc_->NumMotion();
  // Stiffness grows with the square of the distance: near the point, stiff parts may hide it.
  for (double length = kAhead * options_.step; length <= std::max(kAhead, options_.step); length *= 2.0) {
    const Eigen::VectorXd ahead = current_->x + length * curve.first + 0.5 * length * length * curve.second;
    const Correction there = arc_->CorrectOnPlane(ahead, curve.first.head(n));
    if (!there.converged || !(limit_->parameter().Rate(there.x - current_->x, n) > 0.0)) return Verdict::kNotProved;
    if (limit_->monitor() == nullptr) return Verdict::kStable;
    const Verdict verdict = limit_->monitor()->At(arc_->system().Unpack(there.x)).verdict;
    if (verdict != Verdict::kNotProved) return verdict;
  }
  return Verdict::kNotProved;
}

std::size_t EventPassing::StableBranch(const std::vector<Branch>& branches) {
  const auto leads_on = [&](const Branch& branch) {
    return limit_->parameter().Sense(branch.first, branch.second, arc_->NumMotion(), tolerances::kRate) >= 0 &&
           VerdictAlong({branch.first, branch.second}) == Verdict::kStable;
  };
  return static_cast<std::size_t>(std::find_if(branches.begin(), branches.end(), leads_on) - branches.begin());
}

std::optional<End> EventPassing::LeaveStable(const ArcStep& at, AcceptedPoint* increment) {
  std::optional<End> end = LeaveEnd(at, nullptr, increment);
  const auto unstable = [&] { return VerdictAlong({current_->first, current_->second}) == Verdict::kUnstable; };
  if (end || limit_->IsFollowed() || limit_->monitor() == nullptr || !unstable()) return end;
  const int taken = increment->event.taken;
  BranchChoice choice;
  for (const BranchRecord& branch : std::vector<BranchRecord>(increment->event.branches)) {
    if (++choice.branch == taken || !(branch.parameter_rate > tolerances::kRate)) continue;
    if (!LeaveEnd(at, &choice, increment) && VerdictAlong({current_->first, current_->second}) == Verdict::kStable)
      return std::nullopt;
  }
  choice.branch = taken;
  return LeaveEnd(at, &choice, increment);
}

std::optional<End> EventPassing::PassBifurcation(const ArcStep& at, AcceptedPoint* increment, EventFacts* facts) {
  EventRecord* record = &increment->event;
  facts->bifurcation = true;
  record->complete = at.event.crossing->across.size() == 1;
  record->null_vector = CrossingPath(*at.event.crossing);
  record->number = Count();
  const std::vector<Branch> branches = BifurcationBranches(*arc_, *at.event.crossing, limit_->parameter());
  RecordBranches(model_, branches, record);
  const std::size_t stable = limit_->IsFollowed() ? branches.size() : StableBranch(branches);
  facts->stable_ahead = limit_->monitor() != nullptr && stable < branches.size();
  const auto goes_on = [&](const Branch& branch) {
    return limit_->parameter().Sense(branch.first, arc_->NumMotion(), current_->load_error) > 0;
  };
  // Where none is known to be stable, the path itself goes on if it can.
  std::size_t best = stable;
  if (best == branches.size() && !limit_->IsFollowed())
    best = static_cast<std::size_t>(std::find_if(branches.begin(), branches.end(), goes_on) - branches.begin());
  End end_here;
  const std::optional<std::size_t> taken =
      ChosenOf(branches, options_.ChoiceAt(before_.increments, number_), best < branches.size() ? best : 0, &end_here);
  if (!taken) return end_here;
  record->taken = static_cast<int>(*taken) + 1;
  if (*taken == 0) return std::nullopt;
  TakeCurve(branches[*taken].first, branches[*taken].second, arc_->LoadFactor(), current_);
  facts->leaves_curve = true;
  facts->load_turns = TurnsLoad(at);
  if (facts->load_turns) record->null_vector.clear();
  return std::nullopt;
}

std::optional<End> EventPassing::PassContactEvent(const ArcStep& at, AcceptedPoint* increment, EventFacts* facts) {
  facts->contact_event = facts->leaves_curve = true;
  increment->event.number = Count();
  if (SlidesOff(at, increment->point)) {
    const ContactCandidate& lost = model_.scene.contacts[static_cast<std::size_t>(at.event.fails->law)];
    return End{EndReason::kPathEnd,
               {{lost.OnSurface() ? sentences::kSlidesOffSurface : sentences::kSlidesOffObstacle, lost.Name()}}};
  }
  const BranchChoice* const choice = options_.ChoiceAt(before_.increments, number_);
  std::optional<End> end = choice == nullptr ? LeaveStable(at, increment) : LeaveEnd(at, choice, increment);
  facts->load_turns = !end && TurnsLoad(at);
  return end;
}

std::optional<End> EventPassing::PassChoice(const ArcStep& at, AcceptedPoint* increment, EventFacts* facts) {
  const Modes modes = arc_->system().modes();
  if (std::optional<End> end = LeaveEnd(at, options_.ChoiceAt(before_.increments, 0), increment)) return end;
  const bool goes_on = SameStates(arc_->system().modes(), modes) &&
                       arc_->system().Norm(current_->first - at.step.end.first) <= tolerances::kSameTangent;
  if (goes_on) {
    if (!departure_->ChangesReactions()) *current_ = at.step.end;
    return std::nullopt;
  }
  facts->contact_event = facts->leaves_curve = true;
  facts->load_turns = TurnsLoad(at);
  increment->event.null_vector.clear();
  return std::nullopt;
}

std::optional<End> EventPassing::LeaveEnd(const ArcStep& at, const BranchChoice* choice, AcceptedPoint* increment) {
  Arrival arrival;
  arrival.direction = at.step.end.first.head(arc_->NumMotion());
  arrival.singular = at.event.crossing.has_value();
  if (before_.at_start) arrival = departure_->StartArrival();
  if (FailsByRounding(at)) arrival.failed = at.event.fails;
  return departure_->Leave(increment->point, arrival, choice, arc_, current_, &increment->event);
}

bool EventPassing::FailsByRounding(const ArcStep& at) const {
  if (at.event.Kind() != EventKind::kContactEvent || at.step.length > 0.0) return false;
  const Limit& limit = *at.event.fails;
  const double rate = arc_->system().mode_limits().Rate(limit, at.step.end.x, at.step.end.first);
  return rate < 0.0 && rate >= -tolerances::kRate * arc_->system().UnitOf(limit);
}

bool EventPassing::TurnsLoad(const ArcStep& at) {
  const auto rate = [](double value) { return Measured{value, tolerances::kRate}; };
  const Eigen::Index s = arc_->LoadFactor();
  const int arrives = LeadingSign({rate(at.step.end.first[s]), rate(-at.step.end.second[s])});
  int leaves = LeadingSign({rate(current_->first[s]), rate(current_->second[s])});
  // A load that is level to second order may yet rise or fall; and where paths cross, a second derivative may be
  // nothing but the distance of the located point from the crossing.
  if (rate(current_->first[s]).Sign() == 0 && arrives != 0 && (leaves == 0 || at.event.crossing)) {
    const Eigen::VectorXd normal = current_->first.head(s + 1);
    const Correction there = arc_->CorrectOnPlane(current_->x + kAhead * options_.step * current_->first, normal);
    CurvePoint point;
    const bool found = there.converged && arc_->Derivatives(there.x, normal, &point);
    const int beyond = found ? rate(point.first[s]).Sign() : leaves;
    if (leaves == 0 || beyond == 0) leaves = beyond;
  }
  return arrives * leaves < 0;
}

bool EventPassing::SlidesOff(const ArcStep& at, const PathPoint& point) const {
  if (at.event.Kind() != EventKind::kContactEvent) return false;
  const auto i = static_cast<std::size_t>(at.event.fails->law);
  const Law& law = model_.laws[i];
  if (!law.Rule(point.modes[i].state, at.event.fails->id).OfPiece() ||
      law.Exists(law.Next(point.modes[i], at.event.fails->id)))
    return false;
  // Where it bears, its limit of forces is not at zero.
  const Modes modes = model_.laws.ModesAt(point, i, departure_->ToleranceAt(point));
  return std::none_of(modes.begin(), modes.end(), [&](const Mode& mode) { return law.In(mode).idle; });
}

std::vector<double> EventPassing::CrossingPath(const Crossing& crossing) const {
  const Eigen::Index motion = arc_->NumMotion();
  const auto along = crossing.along.first.head(motion), across = crossing.across.front().first.head(motion);
  return model_.ComponentsOf(crossing.x, (across - across.dot(along) * along).normalized());
}

}  // namespace contact_path
