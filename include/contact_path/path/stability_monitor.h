// The stability of the increments of a path.
#ifndef CONTACT_PATH_PATH_STABILITY_MONITOR_H_
#define CONTACT_PATH_PATH_STABILITY_MONITOR_H_

#include <Eigen/Core>

#include "contact_path/branch/smooth_arc.h"
#include "contact_path/contact/path_point.h"
#include "contact_path/path/increment.h"
#include "contact_path/path/model.h"
#include "contact_path/stability/machine.h"
#include "contact_path/stability/stability_problem.h"

namespace contact_path {

// A small system is counted on each increment. In a large one where no contact slips, n0 changes at limit points and
// crossings alone: it is counted where an arc begins, behind singular points, and where the sign of the determinant or
// the softest motion tells of a change. Where contacts slip, the verdict may change anywhere: a large system is counted
// where the arc begins, and where the parity changes.
class StabilityMonitor {
 public:
  // model must outlive the monitor.
  StabilityMonitor(const Model& model, const Machine& machine)
      : model_(model), machine_(machine), problem_(model.structure, model.contacts) {}

  // The next increment. at: the curve on which it was reached. stiffness_sign: of the determinant of the tangent at
  // fixed load factor, 0 = singular. null_directions: of the tangent at fixed load factor, columns du, where it is
  // known to be singular; else no columns. arc: with the factors of the point.
  void Note(const PathPoint& point, const SmoothArc& arc, const CurvePoint& at, int stiffness_sign,
            const Eigen::MatrixXd& null_directions);
  // Where contacts change their states or patches, behind Note(): the point as it is left, along `ahead`. A contact
  // that closes, or comes to stick, is free to do what it did where it arrives; one that opens, or comes to slip, what
  // it does where it leaves. On a kink of a surface, and where several contacts change, both sides count.
  enum class Decides { kArrival, kDeparture, kBoth };
  void NoteEvent(const PathPoint& leaves, const CurvePoint& ahead, Decides decides);
  // An equilibrium from which a path sets out, with the states of its arc. ahead: null where none leads on.
  void Start(const PathPoint& point, const CurvePoint* ahead);

  const StabilityRecord& record() const { return record_; }
  // Under the machine of the path.
  Verdict UnderMachine() const { return noted_.under_machine; }
  // The same of the arc that the last increment is inside of; not proved where it begins there.
  Verdict OnArc() const { return known_ ? arc_.under_machine : Verdict::kNotProved; }
  bool HasSlips() const { return problem_.HasSlips(); }
  // Under the machine, at a point of the arc that begins or goes on at `of`: looked for anew, and not noted.
  Verdict At(const PathPoint& point);
  // In which a disturbance grows under dead loads, (du); empty = not known.
  const Eigen::VectorXd& Direction() const { return noted_.dead.direction; }

 private:
  // Of a point under one machine after the other.
  struct Verdicts {
    Stability dead, controlled;
    Verdict under_machine = Verdict::kNotProved;
  };
  void Count(const PathPoint& point, const Eigen::MatrixXd& null_directions);
  // From the count before, and the tangent.
  void Follow(const CurvePoint& at);
  // Two modes of a symmetric structure lose their stiffness at one place, and the determinant keeps its sign. Inverse
  // iteration, one solution an increment, is drawn to modes next to zero: whether the energy of its motion is negative
  // where the count has no direction in which the loads do no work.
  bool OneMoreFalls(const SmoothArc& arc, const CurvePoint& at);
  void Write(const Verdicts& of, const CurvePoint* at);
  // k of the machine that just holds the point, scaled.
  double CriticalStiffness(const Verdicts& of, const CurvePoint* at) const;

  const Model& model_;
  const Machine machine_;
  StabilityProblem problem_;
  bool known_ = false;  // arc_ holds on this arc
  Verdicts arc_, noted_;
  Eigen::VectorXd softest_;  // motion (du) of OneMoreFalls()
  StabilityRecord record_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_STABILITY_MONITOR_H_
