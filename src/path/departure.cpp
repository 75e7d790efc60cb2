#include "contact_path/path/departure.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "contact_path/path/diagnosis.h"
#include "contact_path/path/sentences.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

// Motions of one size are all active or none: a tolerance that lies among them is widened to the largest.
double CoverMotions(const Laws& laws, const PathPoint& point, double tolerance) {
  std::vector<double> beyond;
  bool among = false;
  for (std::size_t i = 0; i < laws.size(); ++i) {
    if (!laws[i].CanBeIdle()) continue;
    const double motion = laws[i].Motion(0, point.u, point.s, point.modes[i].piece, {});
    among = among || (motion > 0.5 * tolerance && motion <= tolerance);
    if (motion > tolerance && motion <= 0.5 * tolerances::kTouching) beyond.push_back(motion);
  }
  if (!among) return tolerance;
  std::sort(beyond.begin(), beyond.end());
  for (const double motion : beyond) {
    if (motion > 2.0 * tolerance) break;
    tolerance = motion;
  }
  return tolerance;
}

Cause NoBranch(const BranchSet& on) {
  if (on.rigid_modes > 0)
    return {on.rigid_modes == 1 ? sentences::kOneFreeMotion : sentences::kFreeMotions, {}, on.rigid_modes};
  return {on.complete_by == Completeness::kNone ? sentences::kNoBranchFound : sentences::kNoBranch};
}

std::string_view SignOfRate(ContactLimit limit) {
  switch (limit) {
    case ContactLimit::kGap: return sentences::kGapRateSign;
    case ContactLimit::kNormalReaction: return sentences::kReactionRateSign;
    case ContactLimit::kConePlus:
    case ContactLimit::kConeMinus: return sentences::kMarginRateSign;
    case ContactLimit::kSlip:
    case ContactLimit::kTotalSlip: return sentences::kSlipRateSign;
    case ContactLimit::kPatchBegin:
    case ContactLimit::kPatchEnd: break;
  }
  return sentences::kPatchRateSign;
}

// Where the path arrives, along `at`, at a limit that fails by a rate within the tolerance.
End UnknownRate(const Model& model, const Limit& limit, const FixedModeSystem& system, const CurvePoint& at) {
  const double unit = system.mode_limits().RuleOf(limit).OfForces() ? model.scaling.force : model.scaling.length;
  const double rate = unit * system.mode_limits().Rate(limit, at.x, at.first);
  const double tolerance = unit * tolerances::kRate * system.UnitOf(limit);
  // Pins have no limits.
  const auto i = static_cast<std::size_t>(limit.law);
  const bool of_bar = i >= model.LawOfBar(0);
  return {EndReason::kNotDetermined,
          {{of_bar ? sentences::kBarRateSign : SignOfRate(static_cast<ContactLimit>(limit.id)), model.NameOfLaw(i),
            rate, tolerance}}};
}

}  // namespace

void RecordBranches(const Model& model, const std::vector<Branch>& branches, EventRecord* record) {
  record->branches.clear();
  for (const Branch& branch : branches)
    record->branches.push_back({ContactStatesOf(branch.modes, model.contacts.size()), branch.load_rate,
                                branch.parameter_rate, branch.dissipation_rate, branch.turn,
                                model.BarStatesIn(branch.modes)});
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

Departure::Departure(const Model& model, const BranchOptions& options, const PathParameter& parameter,
                     std::function<bool()> cancelled)
    : model_(model),
      options_(options),
      parameter_(parameter),
      cancelled_(std::move(cancelled)),
      largest_reaction_(options.largest_reaction == nullptr ? &own_ : options.largest_reaction) {}

void Departure::NoteReactions(const PathPoint& point) { largest_reaction_->Note(model_.laws, point); }

ActiveSetTolerance Departure::ToleranceAt(const PathPoint& point) const {
  return ActiveSetTolerance::For(largest_reaction_->of_stage, point.s);
}

Arrival Departure::StartArrival() const {
  Arrival arrival;
  arrival.is_start = true;
  const Eigen::Index n = model_.structure.NumDofs() + 1;
  arrival.direction = parameter_.WantedSense() * Eigen::VectorXd::Unit(n, n - 1);
  return arrival;
}

std::optional<End> Departure::Leave(const PathPoint& point, Arrival arrival, const BranchChoice* choice, ModeArc* arc,
                                    CurvePoint* current, EventRecord* record) {
  if (!arrival.is_start) arrival.before = moved_;
  arrival.parameter = parameter_;
  arrival.forward = options_.forward && parameter_.Sense(arrival.direction, arrival.direction.size()) >= 0;
  ActiveSetTolerance tolerance = ToleranceAt(point);
  tolerance.motion = CoverMotions(model_.laws, point, tolerance.motion);
  const BranchSet on = FindBranches(model_.structure, model_.laws, point, arrival, tolerance, cancelled_);
  if (on.cancelled) return End{EndReason::kCancelled, {{sentences::kCancelled}}};
  record->weakly_active = on.weakly_active;
  record->complete = on.complete_by != Completeness::kNone;
  record->complete_by = ToString(on.complete_by);
  RecordBranches(model_, on.branches, record);
  if (on.branches.empty() && arrival.failed) return UnknownRate(model_, *arrival.failed, arc->system(), *current);
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
  const bool goes_back =
      arrival.forward && branch.sense < 0 && choice == nullptr && options_.at_limit == AtLimit::kFollow;
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

// Sets out on a branch from `point`. False: it cannot be followed.
bool Departure::SetOut(const PathPoint& point, const Branch& branch, ModeArc* arc, CurvePoint* current) const {
  PathPoint begin = point;
  begin.modes = branch.modes;
  arc->SetModes(begin, branch.singular);
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
