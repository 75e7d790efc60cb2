#include "contact_path/path/departure.h"

#include <algorithm>
#include <utility>

#include "contact_path/path/branch_options.h"
#include "contact_path/path/diagnosis.h"
#include "contact_path/path/sentences.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

// Gaps of one size are all active or none: a tolerance that lies among them is widened to the largest.
double CoverGaps(const ContactPairs& contacts, const PathPoint& point, double tolerance) {
  std::vector<double> beyond;
  bool among = false;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const double gap = contacts[i]->Gap(point.u, point.s, point.Patch(i));
    among = among || (gap > 0.5 * tolerance && gap <= tolerance);
    if (gap > tolerance && gap <= 0.5 * tolerances::kTouching) beyond.push_back(gap);
  }
  if (!among) return tolerance;
  std::sort(beyond.begin(), beyond.end());
  for (const double gap : beyond) {
    if (gap > 2.0 * tolerance) break;
    tolerance = gap;
  }
  return tolerance;
}

Cause NoBranch(const BranchSet& on) {
  if (on.rigid_modes > 0)
    return {on.rigid_modes == 1 ? sentences::kOneFreeMotion : sentences::kFreeMotions, {}, on.rigid_modes};
  return {on.complete_by == Completeness::kNone ? sentences::kNoBranchFound : sentences::kNoBranch};
}

std::string_view SignOfRate(Inequality inequality) {
  switch (inequality) {
    case Inequality::kGap: return sentences::kGapRateSign;
    case Inequality::kNormalReaction: return sentences::kReactionRateSign;
    case Inequality::kConePlus:
    case Inequality::kConeMinus: return sentences::kMarginRateSign;
    case Inequality::kSlip:
    case Inequality::kTotalSlip: return sentences::kSlipRateSign;
    case Inequality::kPatchBegin:
    case Inequality::kPatchEnd: break;
  }
  return sentences::kPatchRateSign;
}

}  // namespace

void RecordBranches(const std::vector<Branch>& branches, EventRecord* record) {
  for (const Branch& branch : branches)
    record->branches.push_back(
        {branch.states, branch.load_rate, branch.parameter_rate, branch.dissipation_rate, branch.turn});
}

std::optional<std::size_t> ChosenOf(const std::vector<Branch>& branches, const BranchChoice* choice,
                                    std::size_t preferred, End* end) {
  if (choice == nullptr) return preferred;
  const auto chosen = static_cast<std::size_t>(std::max(choice->branch, 1) - 1);
  if (chosen < branches.size()) return chosen;
  *end = {EndReason::kNoSuchBranch,
          {{sentences::kNoSuchBranch, PlaceOf(*choice), choice->branch, static_cast<long>(branches.size())}}};
  return std::nullopt;
}

Departure::Departure(const Model& model, const DepartureOptions& options, std::function<bool()> cancelled)
    : model_(model),
      options_(options),
      cancelled_(std::move(cancelled)),
      largest_reaction_(options.largest_reaction == nullptr ? &own_ : options.largest_reaction) {}

void Departure::NoteReactions(const PathPoint& point) { largest_reaction_->Note(model_.contacts, point); }

ActiveSetTolerance Departure::ToleranceAt(const PathPoint& point) const {
  return ActiveSetTolerance::For(largest_reaction_->of_stage, point.s);
}

Arrival Departure::StartArrival() const {
  Arrival arrival;
  arrival.is_start = true;
  const Eigen::Index n = model_.structure.NumDofs() + 1;
  arrival.direction = options_.parameter.WantedSense() * Eigen::VectorXd::Unit(n, n - 1);
  return arrival;
}

std::optional<End> Departure::Leave(const PathPoint& point, Arrival arrival, const BranchChoice* choice,
                                    ContactArc* arc, CurvePoint* current, EventRecord* record) {
  if (!arrival.is_start) arrival.before = moved_;
  arrival.parameter = options_.parameter;
  arrival.forward = options_.forward && options_.parameter.Sense(arrival.direction, arrival.direction.size()) >= 0;
  ActiveSetTolerance tolerance = ToleranceAt(point);
  tolerance.gap = CoverGaps(model_.contacts, point, tolerance.gap);
  const BranchSet on = FindBranches(model_.structure, model_.contacts, point, arrival, tolerance, cancelled_);
  if (on.cancelled) return End{EndReason::kCancelled, {{sentences::kCancelled}}};
  record->weakly_active = on.weakly_active;
  record->complete = on.complete_by != Completeness::kNone;
  record->complete_by = ToString(on.complete_by);
  RecordBranches(on.branches, record);
  if (on.branches.empty() && arrival.failed) return UnknownRate(*arrival.failed, arc->system(), *current);
  if (on.branches.empty()) {
    End end{EndReason::kPathEnd, {NoBranch(on)}};
    Append(StandsAtEnd(model_, point), &end.causes);
    at_ends_.clear();
    return end;
  }
  if (at_ends_.empty()) at_ends_ = StandsAtEnd(model_, point);
  End end;
  const std::optional<std::size_t> taken = ChosenOf(on.branches, choice, 0, &end);
  if (!taken) return end;
  const Branch& branch = on.branches[*taken];
  if (branch.mechanism) return End{EndReason::kPathEnd, {{sentences::kBecameMechanism}}};
  const bool goes_back = arrival.forward && branch.sense < 0 && choice == nullptr && !options_.ends_at_limit;
  if (goes_back && !record->complete) return End{EndReason::kNotDetermined, {{sentences::kMayGoOn}}};
  record->taken = static_cast<int>(*taken) + 1;
  other_reactions_ = other_reactions_ || branch.other_reactions;
  if (!branch.rests)
    moved_.reset();
  else if (!moved_ && !arrival.is_start)
    moved_ = arrival.direction;
  begin_ = branch.begin;
  if (!SetOut(begin_ ? *begin_ : point, branch, arc, current))
    return End{EndReason::kNumericalFailure, {{sentences::kBranchLost}}};
  return std::nullopt;
}

// Where the path arrives at an inequality that fails by a rate within the tolerance.
End Departure::UnknownRate(const Constraint& constraint, const FixedStateSystem& system, const CurvePoint& at) const {
  const double unit = IsMotion(constraint.inequality) ? model_.scaling.length : model_.scaling.force;
  return {
      EndReason::kNotDetermined,
      {{SignOfRate(constraint.inequality), model_.scene.contacts[static_cast<std::size_t>(constraint.contact)].Name(),
        unit * system.Rate(constraint, at.x, at.first), unit * tolerances::kRate * system.UnitOf(constraint)}}};
}

// Sets out on a branch from `point`. False: it cannot be followed.
bool Departure::SetOut(const PathPoint& point, const Branch& branch, ContactArc* arc, CurvePoint* current) const {
  PathPoint begin = point;
  begin.patches = branch.patches;
  arc->SetStates(branch.states, begin, branch.singular);
  const bool regular = arc->Derivatives(arc->system().Pack(point), branch.direction, current) &&
                       arc->system().Norm(current->first - branch.first) <= tolerances::kSameTangent;
  if (regular) return true;
  // Another path crosses here, or the structure has rigid modes: the branch itself tells where to go.
  current->x = arc->system().Pack(point);
  current->load_error = tolerances::kRate * arc->system().ResidualUnit();
  TakeCurve(branch.first, branch.second, arc->NumMotion() - 1, current);
  current->BeSingular();
  return current->second.allFinite();
}

}  // namespace contact_path
