// What the tracer asks of a method: the next accepted increment of the path.
#ifndef CONTACT_PATH_PATH_PATH_METHOD_H_
#define CONTACT_PATH_PATH_PATH_METHOD_H_

#include <cmath>
#include <optional>
#include <vector>

#include "contact_path/law/path_point.h"
#include "contact_path/path/end.h"
#include "contact_path/path/increment.h"
#include "contact_path/path/work.h"
#include "contact_path/tolerances.h"

namespace contact_path {

// A point that passed the check.
struct AcceptedPoint : IncrementFindings {  // solve: without time
  PathPoint point;
  double arc_length = 0.0;         // of the increment, scaled norm
  Work work;                       // of the increment
  std::optional<PathPoint> inner;  // at the middle of its step, where it is wanted
  // Branch: of det of the tangent at fixed load, contacts in their states; 0 = singular, or not known.
  int stiffness_sign = 0;
  std::vector<int> at_criteria;  // of options.stop: whose value the point has, exactly
};

// Whether a load factor is, to rounding, at a target that a method has located.
inline bool IsAtTarget(double load_factor, double target) {
  return std::abs(load_factor - target) <= tolerances::kEqual * std::abs(target);
}

struct Advance {
  std::optional<AcceptedPoint> increment;  // may be there also where the path ended, and need not where it goes on
  std::optional<End> end;                  // nothing: the path goes on
};

inline Advance Ended(End end) { return {{}, std::move(end)}; }

// An increment of an earlier path to go on from, one that is no event.
struct ResumePoint {
  PathPoint before;   // of the last increment before it that has its state on record
  PathPoint point;    // its own
  SolveRecord solve;  // recorded of it
};

class PathMethod {
 public:
  virtual ~PathMethod() = default;

  // Sets out from the initial point, once, before the first Next(). `found`: event and stability. Nothing: done.
  // Otherwise the path ends where it begins.
  virtual std::optional<End> Start(const PathPoint& from, IncrementFindings* found) = 0;
  // Goes on in place of Start(). False: that is not possible here.
  virtual bool Resume(const ResumePoint& at) = 0;

  // The next increment after `from`, which is the last accepted point: the initial point, or the last increment that
  // this method gave.
  virtual Advance Next(const PathPoint& from) = 0;
  // Events passed so far, those before this path included; 0 for a method that does not number them.
  virtual int NumEvents() const { return 0; }
  // What else the user should know when the trace has ended.
  virtual Causes Remarks() const { return {}; }
};

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_PATH_METHOD_H_
