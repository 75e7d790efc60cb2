// The stability of the increments of a path.
#ifndef CONTACT_PATH_PATH_STABILITY_MONITOR_H_
#define CONTACT_PATH_PATH_STABILITY_MONITOR_H_

#include <Eigen/Core>
#include <optional>

#include "contact_path/branch/step.h"
#include "contact_path/law/path_point.h"
#include "contact_path/path/increment.h"
#include "contact_path/path/model.h"
#include "contact_path/stability/machine.h"
#include "contact_path/stability/stability_problem.h"

namespace contact_path {

class StabilityMonitor {
 public:
  // model must outlive the monitor.
  StabilityMonitor(const Model& model, const Machine& machine)
      : model_(model), machine_(machine), problem_(model.structure, model.laws) {}

  // The next increment. at: the curve on which it was reached. null_directions: of the tangent at fixed load factor,
  // columns du, where it is known to be singular; else no columns. falls: n0, where the factors of the arc tell.
  void Note(const PathPoint& point, const CurvePoint& at, const Eigen::MatrixXd& null_directions,
            std::optional<Eigen::Index> falls);
  // Where contacts change their states or patches, behind Note(): the point as it is left, along `ahead`. A contact
  // that closes, or comes to stick, is free to do what it did where it arrives; one that opens, or comes to slip, what
  // it does where it leaves. On a kink of a surface, and where several contacts change, both sides count.
  enum class Decides { kArrival, kDeparture, kBoth };
  // next: to it on that curve.
  void NoteEvent(const PathPoint& leaves, const CurvePoint& ahead, const PathPoint& next, Decides decides);
  // An equilibrium from which a path sets out, with the states of its arc. ahead, next: null where none leads on.
  void Start(const PathPoint& point, const CurvePoint* ahead, const PathPoint* next);

  const StabilityRecord& record() const { return record_; }
  // Under the machine of the path.
  const Stability& UnderMachine() const { return noted_.under_machine; }
  // Whether the machine is known to hold the arc that the last increment is inside of.
  bool HeldOnArc() const { return known_ && arc_.under_machine.verdict == Verdict::kStable; }
  bool HasSlips() const { return problem_.HasSlips(); }
  // Under the machine, at a point of the arc that the last increment is inside of: looked for anew, and not noted.
  Stability At(const PathPoint& point);

 private:
  // Of a point under one machine after the other.
  struct Verdicts {
    Stability dead, controlled, under_machine;
  };
  void Count(const PathPoint& point, const Eigen::MatrixXd& null_directions, const PathPoint* next = nullptr);
  // With n0, where no contact slides.
  void Follow(const CurvePoint& at, int falls);
  void Write(const Verdicts& of, const Eigen::VectorXd& u, const CurvePoint* at);
  // k of the machine that just holds the point, scaled.
  double CriticalStiffness(const Verdicts& of, const CurvePoint* at) const;

  const Model& model_;
  const Machine machine_;
  StabilityProblem problem_;
  bool known_ = false;  // arc_ holds on this arc
  Verdicts arc_, noted_;
  StabilityRecord record_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_STABILITY_MONITOR_H_
