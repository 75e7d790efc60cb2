// Where on a step the equilibrium ceases to be stable under the machine.
#ifndef CONTACT_PATH_PATH_ONSET_H_
#define CONTACT_PATH_PATH_ONSET_H_

#include <Eigen/Core>
#include <optional>

#include "contact_path/branch/arc_step.h"
#include "contact_path/branch/mode_arc.h"
#include "contact_path/path/machine_limit.h"
#include "contact_path/path/model.h"

namespace contact_path {

// The exact point of the arc on the plane at t of the step, where Newton's method finds it, by an arc of its own, so
// that the steps of the path are the same with and without the point.
std::optional<PathPoint> PointApart(const Model& model, const ModeArc& of, const Step& step, double t);

struct Onset {
  CurvePoint place;
  std::optional<Crossing> crossing;  // where parts buckle at one place, of so many curves
};

class OnsetFinder {
 public:
  // All must outlive it.
  OnsetFinder(const Model& model, MachineLimit* limit, ModeArc* arc) : model_(model), limit_(limit), arc_(arc) {}

  // The place at which the equilibrium ceases to be stable: the setting of the machine turns on it, what slides lets
  // go, or several parts buckle at one place. end: the point at the end of the step, whose verdict is noted.
  std::optional<Onset> Find(const ArcStep& at, const PathPoint& end);
  // The verdict of a point inside the arc; null_directions: of the tangent at fixed load factor, du, where it is
  // singular.
  void Note(const CurvePoint& end, const PathPoint& point, const Eigen::MatrixXd& null_directions);
  // Of the arc that begins, at `current`, at the event at the end of the step.
  void NoteBehind(const ArcStep& at, const PathPoint& point, const CurvePoint& current);
  Eigen::MatrixXd NullDirections(const ArcStep& at) const;

 private:
  // Before the parameter `after`, by bisection on the verdict. falls: the directions at `after`.
  std::optional<CurvePoint> OnsetOn(const Step& step, double after, int falls, std::optional<Crossing>* crossing);

  const Model& model_;
  MachineLimit* const limit_;
  ModeArc* const arc_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_ONSET_H_
