// What a path does at the end of a step: records the event there, and sets out from it.
#ifndef CONTACT_PATH_PATH_EVENT_PASSING_H_
#define CONTACT_PATH_PATH_EVENT_PASSING_H_

#include <cstddef>
#include <optional>
#include <vector>

#include "contact_path/branch/arc_step.h"
#include "contact_path/branch/branches.h"
#include "contact_path/branch/mode_arc.h"
#include "contact_path/path/branch_options.h"
#include "contact_path/path/departure.h"
#include "contact_path/path/end.h"
#include "contact_path/path/machine_limit.h"
#include "contact_path/path/model.h"
#include "contact_path/path/path_method.h"

namespace contact_path {

// What is the case where an increment ends.
struct EventFacts {
  bool contact_event = false, bifurcation = false, smooth_limit = false, sample = false, onset = false;
  bool leaves_curve = false;  // the path goes on along another curve
  bool load_turns = false;    // there
  bool stable_ahead = false;  // though the point itself has a direction without stiffness

  IncrementKind Kind() const;
};

class EventPassing {
 public:
  // All must outlive it.
  EventPassing(const Model& model, const BranchOptions& options, MachineLimit* limit, Departure* departure,
               ModeArc* arc)
      : model_(model), options_(options), limit_(limit), departure_(departure), arc_(arc), number_(options.events) {}

  // Passed so far, starts not counted; one more.
  int number() const { return number_; }
  int Count() { return ++number_; }

  struct Before {
    int increments = 0;     // given, increment 0 not counted
    bool at_start = false;  // not moved yet
  };
  // Records the event at the end of the step, and sets out from there: *current is where the path goes on. Nothing:
  // done. Otherwise why not.
  std::optional<End> Pass(const ArcStep& at, const Before& before, AcceptedPoint* increment, CurvePoint* current,
                          EventFacts* facts);

 private:
  // Under the machine, a little further on along a curve from the point on which the path parameter goes on.
  Verdict VerdictAlong(const CurveDerivatives& curve);
  // The first of the branches from a singular point of the curve on which the path parameter goes on, and which is
  // stable under the machine; their number: none is.
  std::size_t StableBranch(const std::vector<Branch>& branches);
  std::optional<End> PassBifurcation(const ArcStep& at, AcceptedPoint* increment, EventFacts* facts);
  std::optional<End> PassContactEvent(const ArcStep& at, AcceptedPoint* increment, EventFacts* facts);
  // Where branch_choices names the increment: takes a branch there. The increment keeps its kind if that is the path
  // itself.
  std::optional<End> PassChoice(const ArcStep& at, AcceptedPoint* increment, EventFacts* facts);
  // Sets out on a branch from the end of the step.
  std::optional<End> LeaveEnd(const ArcStep& at, const BranchChoice* choice, AcceptedPoint* increment);
  // The same by branch_rule; but where the path is not followed through limits and the machine does not hold that
  // branch, on the first one that it holds and on which the path parameter goes on.
  std::optional<End> LeaveStable(const ArcStep& at, AcceptedPoint* increment);
  // Whether a limit fails where the step sets out, by a rate within the tolerance.
  bool FailsByRounding(const ArcStep& at) const;
  // Whether the load factor turns at the end of the step, on the branch that was taken there. Where its first
  // derivative is zero, the second tells, and its rate a little further on where both are zero or paths cross.
  bool TurnsLoad(const ArcStep& at);
  // Whether the step ends where a law that bears comes to the end of its pieces, as a node that slides over an end of
  // its surface.
  bool SlidesOff(const ArcStep& at, const PathPoint& point) const;
  // Direction of the path that crosses at the end of the step: x0, y0, x1, ..., unit norm.
  std::vector<double> CrossingPath(const Crossing& crossing) const;

  const Model& model_;
  const BranchOptions& options_;
  MachineLimit* const limit_;
  Departure* const departure_;
  ModeArc* const arc_;
  int number_;
  Before before_;  // of the event that is passed
  CurvePoint* current_ = nullptr;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_EVENT_PASSING_H_
