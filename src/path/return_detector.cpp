#include "contact_path/path/return_detector.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "contact_path/path/sentences.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr double kReach = 2.0;  // of the chord: a point on the increment is no farther from its end
constexpr std::size_t kMostReferences = 32;

}  // namespace

ReturnDetector::ReturnDetector(const Model& model, int every, const LargestReactionSoFar& largest_reaction)
    : spacing_(every), arc_(model.structure, model.laws), laws_(model.laws), largest_reaction_(largest_reaction) {}

void ReturnDetector::Add(int increment, const PathPoint& from, const PathPoint& to) {
  if (!first_) first_ = from;
  extent_ = std::max(extent_, Distance(*first_, to));
  const double length = Distance(from, to);
  if (increment % spacing_ != 0 || !(length > 0.0) || !SameStates(to.modes, from.modes)) return;
  if (references_.size() == kMostReferences) {
    spacing_ *= 2;
    const auto between = [&](const Reference& reference) { return reference.increment % spacing_ != 0; };
    references_.erase(std::remove_if(references_.begin(), references_.end(), between), references_.end());
    if (increment % spacing_ != 0) return;
  }
  references_.push_back({increment, to, Chord(from, to) / length});
}

std::optional<ReturnDetector::Return> ReturnDetector::Find(const PathPoint& from, const PathPoint& to) {
  const double reach = kReach * Distance(from, to);
  for (const Reference& reference : references_) {
    const PathPoint& point = reference.point;
    if (std::abs(point.s - to.s) > reach || !SameStates(point.modes, to.modes) || Distance(point, to) > reach) continue;
    std::optional<PathPoint> crossing = CrossingOf(reference, from, to);
    if (!crossing || !IsSame(*crossing, point)) continue;
    const Eigen::VectorXd now = TangentAt(*crossing, Chord(from, to));
    const Eigen::VectorXd then = TangentAt(point, reference.direction);
    if (now.size() == 0 || then.size() == 0 || !((now - then).norm() <= tolerances::kSameTangent)) continue;
    return Return{reference.increment, std::move(*crossing)};
  }
  return std::nullopt;
}

std::optional<PathPoint> ReturnDetector::CrossingOf(const Reference& reference, const PathPoint& from,
                                                    const PathPoint& to) {
  const double before = reference.direction.dot(Chord(reference.point, from));
  const double beyond = reference.direction.dot(Chord(reference.point, to));
  const double slack = tolerances::kSamePoint * Distance(from, to);
  if (!(before < -slack) || !(beyond >= -slack)) return std::nullopt;
  PathPoint begin = from;
  TakeStates(to.modes, &begin);
  arc_.SetModes(begin);
  const FixedModeSystem& system = arc_.system();
  const double share = std::min(1.0, before / (before - beyond));
  Eigen::VectorXd row = Eigen::VectorXd::Zero(system.NumUnknowns());
  row.head(arc_.NumMotion()) = reference.direction;
  const Correction correction = arc_.Correct((1.0 - share) * system.Pack(from) + share * system.Pack(to), row,
                                             row.dot(system.Pack(reference.point)));
  if (!correction.converged) return std::nullopt;
  PathPoint crossing = system.Unpack(correction.x);
  const Eigen::VectorXd chord = Chord(from, to);
  const double place = chord.dot(Chord(from, crossing)) / chord.squaredNorm();
  if (!(place > 0.0) || !(place <= 1.0 + tolerances::kSamePoint)) return std::nullopt;
  return crossing;
}

bool ReturnDetector::IsSame(const PathPoint& a, const PathPoint& b) const {
  if (!(Distance(a, b) <= tolerances::kSamePoint * extent_)) return false;
  PathPoint difference;
  difference.forces = a.forces - b.forces;
  return laws_.LargestForce(difference) <=
         tolerances::kUnitComponent + tolerances::kSamePoint * largest_reaction_.of_stage;
}

Eigen::VectorXd ReturnDetector::TangentAt(const PathPoint& point, const Eigen::VectorXd& towards) {
  arc_.SetModes(point);
  CurvePoint derivatives;
  if (!arc_.Derivatives(arc_.system().Pack(point), towards, &derivatives)) return {};
  return derivatives.first.head(arc_.NumMotion());
}

End ClosedPath(int increment) { return {EndReason::kClosedPath, {{sentences::kClosedPath, {}, increment}}}; }

}  // namespace contact_path
