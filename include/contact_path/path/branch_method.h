// The exact path: smooth arcs between located events, the branch chosen by the dissipation rate.
#ifndef CONTACT_PATH_PATH_BRANCH_METHOD_H_
#define CONTACT_PATH_PATH_BRANCH_METHOD_H_

#include <functional>
#include <optional>
#include <vector>

#include "contact_path/branch/branches.h"
#include "contact_path/branch/mode_arc.h"
#include "contact_path/path/balanced_step.h"
#include "contact_path/path/branch_options.h"
#include "contact_path/path/departure.h"
#include "contact_path/path/machine_limit.h"
#include "contact_path/path/model.h"
#include "contact_path/path/path_method.h"

namespace contact_path {

// Located events and smooth arcs between them.
class BranchMethod : public PathMethod {
 public:
  // model must outlive the method. cancelled may be empty.
  BranchMethod(const Model& model, const BranchOptions& options, std::function<bool()> cancelled);

  std::optional<End> Start(const PathPoint& from, StartRecord* found) override;
  bool Resume(const ResumePoint& at) override;
  // `from` must be the point that was given last.
  Advance Next(const PathPoint& from) override;
  int NumEvents() const override { return events_; }
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
  // The same at t, by an arc of its own, so that the steps of the path are the same with and without the point.
  std::optional<PathPoint> PointApart(const Step& step, double t) const;
  // Where the path comes back to an earlier increment on the step: its number, and the step ends there. Not where a
  // branch is to be chosen farther on: then a path that comes back need not repeat.
  std::optional<int> EndAtReturn(const PathPoint& from, ArcStep* at);
  // Shortens the step to where the equilibrium ceases to be stable under the machine: the setting of the machine turns
  // on it, contacts that slip let go, or several parts buckle at one place. Whether there is such a place; increment:
  // of the step, made anew then.
  bool EndAtOnset(const PathPoint& from, BalancedStep* next, AcceptedPoint* increment);
  // The place on the step at which it becomes unstable, before the parameter `after`, by bisection on the verdict;
  // where parts buckle at one place, *crossing of so many curves. falls: the directions at `after`.
  std::optional<CurvePoint> OnsetOn(const Step& step, double after, int falls, std::optional<Crossing>* crossing);
  // Of a point inside the arc; null_directions: of the tangent at fixed load factor, du, where it is singular.
  void NoteStability(const CurvePoint& end, const AcceptedPoint& increment, const Eigen::MatrixXd& null_directions);
  // Of the arc that begins at the event at the end of the step.
  void NoteStabilityBehind(const ArcStep& at, const AcceptedPoint& increment);
  Eigen::MatrixXd NullDirections(const ArcStep& at) const;
  // What is the case where an increment ends.
  struct Facts {
    bool contact_event = false, bifurcation = false, smooth_limit = false, sample = false, onset = false;
    bool leaves_curve = false;  // the path goes on along another curve
    bool load_turns = false;    // there
    bool stable_ahead = false;  // though the point itself has a direction without stiffness

    IncrementKind Kind() const;
  };
  // Sets out from an equilibrium with all contact states that are open to it.
  std::optional<End> SetOut(const PathPoint& from, StartRecord* found);
  // The motion from the last increment while the machine rests, in an increment of its own, and the path from where it
  // lands. Where it comes back to an event, the increment in place has the branches of what rests there on record.
  Advance TakeJump(const PathPoint& from);
  // The first of the branches from a singular point of the curve on which the path parameter goes on, and which is
  // stable under the machine; their number: none is.
  std::size_t StableBranch(const std::vector<Branch>& branches);
  // Records the event at the end of the step, and sets out from there. Nothing: done. Otherwise why not.
  std::optional<End> PassEnd(const ArcStep& at, AcceptedPoint* increment, Facts* facts);
  std::optional<End> PassBifurcation(const ArcStep& at, AcceptedPoint* increment, Facts* facts);
  std::optional<End> PassContactEvent(const ArcStep& at, AcceptedPoint* increment, Facts* facts);
  // Where branch_choices names the increment: takes a branch there. The increment keeps its kind if that is the path
  // itself.
  std::optional<End> PassChoice(const ArcStep& at, AcceptedPoint* increment, Facts* facts);
  // Sets out on a branch from the end of the step.
  std::optional<End> LeaveEnd(const ArcStep& at, const BranchChoice* choice, AcceptedPoint* increment);
  // Whether an inequality fails where the step sets out, by a rate within the tolerance.
  bool FailsByRounding(const ArcStep& at) const;
  // Whether the load factor turns at the end of the step, on the branch that was taken there. Where its first
  // derivative is zero, the second tells, and its rate a little further on where both are zero or paths cross.
  bool TurnsLoad(const ArcStep& at);
  // Whether the step ends where a node that is pressed onto an open surface slides over an end of it.
  bool SlidesOff(const ArcStep& at, const PathPoint& point) const;
  // Direction of the path that crosses at the end of the step: x0, y0, x1, ..., unit norm.
  std::vector<double> CrossingPath(const Crossing& crossing) const;
  int StiffnessSign(const CurvePoint& point) const;
  // Where no step is accepted.
  End NoStep(const PathPoint& from);

  const Model& model_;
  BranchOptions options_;
  const std::function<bool()> cancelled_;
  MachineLimit limit_;
  Departure departure_;
  ModeArc arc_;
  StepEnds ends_;
  CurvePoint current_;
  double step_length_;
  int increments_;                // given so far, increment 0 not counted
  int events_;                    // passed so far, starts not counted
  int events_in_place_ = 0;       // passed without moving
  bool at_start_ = true;          // not moved yet
  std::optional<double> stored_;  // strain energy at current_, where it is known [force length]
};

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_BRANCH_METHOD_H_
