// The exact path: smooth arcs between located events, the branch chosen by the dissipation rate.
#ifndef CONTACT_PATH_PATH_BRANCH_METHOD_H_
#define CONTACT_PATH_PATH_BRANCH_METHOD_H_

#include <functional>
#include <optional>

#include "contact_path/branch/branches.h"
#include "contact_path/branch/mode_arc.h"
#include "contact_path/path/branch_options.h"
#include "contact_path/path/departure.h"
#include "contact_path/path/event_passing.h"
#include "contact_path/path/machine_limit.h"
#include "contact_path/path/model.h"
#include "contact_path/path/onset.h"
#include "contact_path/path/path_method.h"

namespace contact_path {

struct BalancedStep;

// Located events and smooth arcs between them.
class BranchMethod : public PathMethod {
 public:
  // model must outlive the method. cancelled may be empty.
  BranchMethod(const Model& model, const BranchOptions& options, std::function<bool()> cancelled);

  std::optional<End> Start(const PathPoint& from, IncrementFindings* found) override;
  bool Resume(const ResumePoint& at) override;
  // `from` must be the point that was given last.
  Advance Next(const PathPoint& from) override;
  int NumEvents() const override { return events_.number(); }
  Causes Remarks() const override;

 private:
  // An increment in which nothing moves: the reactions with which the branch begins.
  Advance ChangeReactions(const PathPoint& from);
  // An increment that ends at the point, and one that ends with the step, as far as both are known before the event is
  // passed.
  AcceptedPoint IncrementAt(PathPoint point, const PathPoint& from) const;
  AcceptedPoint IncrementOf(const ArcStep& step, const PathPoint& from) const;
  // The exact point of the arc on the plane at half of the step, where the options want it and Newton's method finds
  // it.
  std::optional<PathPoint> InnerPoint(const Step& step, const PathPoint& from) const;
  // Where the path comes back to an earlier increment on the step: its number, and the step ends there. Not where a
  // branch is to be chosen farther on: then a path that comes back need not repeat.
  std::optional<int> EndAtReturn(const PathPoint& from, ArcStep* at);
  // Shortens the step to where the equilibrium ceases to be stable under the machine: the setting of the machine turns
  // on it, contacts that slip let go, or several parts buckle at one place. Whether there is such a place; increment:
  // of the step, made anew then.
  bool EndAtOnset(const PathPoint& from, BalancedStep* next, AcceptedPoint* increment);
  // Sets out from an equilibrium with all contact states that are open to it.
  std::optional<End> SetOut(const PathPoint& from, IncrementFindings* found);
  // The motion from the last increment while the machine rests, in an increment of its own, and the path from where it
  // lands. Where it comes back to an event, the increment in place has the branches of what rests there on record.
  Advance TakeJump(const PathPoint& from);
  int StiffnessSign(const CurvePoint& point) const;
  // Where no step is accepted.
  End NoStep(const PathPoint& from);

  const Model& model_;
  BranchOptions options_;
  const std::function<bool()> cancelled_;
  MachineLimit limit_;
  Departure departure_;
  ModeArc arc_;
  EventPassing events_;
  OnsetFinder onsets_;
  StepEnds ends_;
  CurvePoint current_;
  double step_length_;
  int increments_;                // given so far, increment 0 not counted
  int events_in_place_ = 0;       // passed without moving
  bool at_start_ = true;          // not moved yet
  std::optional<double> stored_;  // strain energy at current_, where it is known [force length]
};

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_BRANCH_METHOD_H_
