// The machine of a stage with its setting, and what a path does where the machine that loads the structure can go no
// further on a stable path.
#ifndef CONTACT_PATH_PATH_MACHINE_LIMIT_H_
#define CONTACT_PATH_PATH_MACHINE_LIMIT_H_

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>

#include "contact_path/branch/path_parameter.h"
#include "contact_path/branch/step.h"
#include "contact_path/law/active_set_tolerance.h"
#include "contact_path/path/branch_options.h"
#include "contact_path/path/model.h"
#include "contact_path/path/path_method.h"
#include "contact_path/path/stability_monitor.h"
#include "contact_path/stability/machine.h"

namespace contact_path {

// X = f . (u - u_0) / |f| + s |f| / K, the setting of the machine of TraceOptions in a stage that begins at u_0.
class MachineSetting {
 public:
  // stiffness: K of TraceOptions. Where it is 0, or the load factor scales no loads, there is no machine: the load
  // factor is what goes on, and the setting stays 0.
  MachineSetting(const Model& model, double stiffness);

  const Machine& machine() const { return machine_; }  // scaled
  // sense: +-1, in which the path is wanted to go.
  PathParameter Parameter(double sense) const;
  // From where it is `value` [length; rad where moments alone load] at the point, (u, s) scaled.
  void Begin(const PathPoint& point, double value) { origin_ += At(point.u, point.s) - value; }
  double At(const Eigen::VectorXd& u, double s) const;

 private:
  Machine machine_;
  Eigen::VectorXd row_;  // (du, ds); empty: no machine
  double unit_ = 1.0;
  double origin_ = 0.0;
};

// The machine of a path, the verdicts under it, and TraceOptions::at_limit: a path is followed through such a limit,
// stops at it, or jumps from it.
class MachineLimit {
 public:
  // model must outlive it. cancelled may be empty.
  MachineLimit(const Model& model, const BranchOptions& options, std::function<bool()> cancelled);

  const Machine& machine() const { return setting_.machine(); }
  const PathParameter& parameter() const { return parameter_; }
  bool IsFollowed() const { return at_limit_ == AtLimit::kFollow; }
  StabilityMonitor* monitor() const { return monitor_.get(); }  // null: verdicts are not asked for
  bool IsUnstable() const { return monitor_ && monitor_->UnderMachine().verdict == Verdict::kUnstable; }
  // Whether the next increment is a jump.
  bool Leaves() const { return leaving_.has_value(); }

  // Where a path sets out. end: of the path where no branch leads on; a jump takes its place.
  void NoteStart(const PathPoint& point, const ActiveSetTolerance& tolerance, std::optional<End>* end);
  // Where an increment ends.
  struct Place {
    const PathPoint& point;
    const CurvePoint& arrives;        // on the curve on which it was reached
    const CurvePoint& leaves;         // on the one on which the path goes on, if it does
    Eigen::MatrixXd null_directions;  // of the tangent at fixed load factor, columns du, where it is singular
    bool contact_event = false, crossing = false;
    bool stable_ahead = false;  // though the point itself has a direction without stiffness
    ActiveSetTolerance tolerance;
  };
  // As at_limit wants it: no branch leads on, which *end tells, the path parameter turns, or the equilibrium is
  // unstable under the machine. Whether directions without stiffness leave that to what is right behind the point.
  bool Note(const Place& place, StabilityRecord* record, std::optional<End>* end);

  // How the motion went while the machine rests.
  struct Outcome {
    enum class Kind {
      kLands,
      kEnds,         // nowhere
      kSetsOutAnew,  // back, from an event: what rests may set out on any branch, also on that of arrival, which the
                     // list of the event leaves out
      kGoesOn,       // back, where a disturbance sets out too slowly to be followed: it does so right behind
    };
    Kind kind = Kind::kEnds;
    AcceptedPoint landing = {};
    std::optional<End> end = {};  // kSetsOutAnew: if no branch leads on
  };
  // From the last increment, which has this number.
  Outcome TakeJump(const PathPoint& from, int number);
  // Where the path sets out from its landing: a part at its limit there moves on the same way.
  void NoteLanding(const PathPoint& from, const PathPoint& landing, const ActiveSetTolerance& tolerance,
                   std::optional<End>* end);

 private:
  // No branch on which the parameter goes on leads on from an event, the parameter turns on the curve, or the
  // equilibrium is unstable.
  enum class Why { kAtEvent, kTurns, kUnstable };
  // A jump that comes next. end: of the path where nothing moves; nothing: kNoLanding.
  struct Leaving {
    Eigen::VectorXd push;  // du
    Why why = Why::kUnstable;
    std::optional<End> end = {};
  };
  // The direction (du) in which the structure leaves an equilibrium that is not held, contacts that may let go let go.
  // along: to which it is turned, and where none is found.
  Eigen::VectorXd Push(const PathPoint& point, const Eigen::VectorXd& along, const ActiveSetTolerance& tolerance) const;

  const Model& model_;
  const std::function<bool()> cancelled_;
  const AtLimit at_limit_;
  const bool landing_checks_;
  const MachineSetting setting_;
  const PathParameter parameter_;
  const std::unique_ptr<StabilityMonitor> monitor_;
  std::optional<Leaving> leaving_;
  bool came_back_ = false;  // a jump from the increment before did
};

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_MACHINE_LIMIT_H_
