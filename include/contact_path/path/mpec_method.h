// Algorithm 3.2 of Kanno & Martins 2005 as a path method: increments, their acceptance and their length.
#ifndef CONTACT_PATH_PATH_MPEC_METHOD_H_
#define CONTACT_PATH_PATH_MPEC_METHOD_H_

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "contact_path/branch/trial_step.h"
#include "contact_path/mpec/increment_solver.h"
#include "contact_path/mpec/ipopt_solver.h"
#include "contact_path/path/sentences.h"
#include "contact_path/path/trace.h"

namespace contact_path {

// All lengths in the scaled norm.
struct MpecOptions {
  double step = 0.02;          // wanted increment length, > 0
  double smallest_step = 0.0;  // below this the path ends, > 0
  // Where a contact changes its state, two half increments must agree with the whole one to this length, and the bend
  // between them be no larger: it bounds how far the path is cut short at a corner.
  double corner_tolerance = 5e-4;
  RegularisationSchedule regularisation;
  double direction = 1.0;       // sign of the first change of the load factor
  std::vector<double> targets;  // load factors at which the path is to end, in an increment of its own
  TrialObserver on_trial = {};
  ReturnDetector* returns = nullptr;  // tells whether the path has come back to where it was; null: that is no end

  // growth: AutomaticStepGrowth() of the scene.
  static MpecOptions For(const TraceOptions& options, double growth);
};

class MpecMethod : public PathMethod {
 public:
  // model must outlive the method. cancelled may be empty.
  MpecMethod(const Model& model, const MpecOptions& options, std::function<bool()> cancelled);

  // Nothing to do: the first increment finds its own way.
  std::optional<End> Start(const PathPoint&, IncrementFindings*) override { return std::nullopt; }
  bool Resume(const ResumePoint& at) override;
  Advance Next(const PathPoint& from) override;
  Causes Remarks() const override;

 private:
  struct Trial {
    sentences::Sentence verdict = sentences::kNotSolved;  // kAccepted, or why not
    IncrementTrial increment;
    Residuals residuals;
  };
  // Sets residuals and verdict of a trial that was solved for.
  void Judge(const PathPoint& from, const Eigen::VectorXd& direction, double length, Trial* result) const;

  // One increment, judged by itself. dissipation: share of that term in the minimiser; gamma_1 of eq. (4) is what is
  // left of 1, over this share. predicted: where the solution from the predicted point is refused, another one is
  // looked for.
  Trial Try(const PathPoint& from, const Eigen::VectorXd& direction, double length, double dissipation = 0.6,
            bool predicted = true);
  // For the first increment, which has no direction of a last increment: improves the direction until the increment is
  // as long as wanted.
  Trial TryFirst(const PathPoint& from, double length);
  // The target between both points that is nearest to `from`.
  std::optional<double> TargetBetween(const PathPoint& from, const PathPoint& to) const;
  // Whether the load factor turns back on the increment, and may have been past a target and back.
  bool MayMissTarget(const PathPoint& from, const PathPoint& to) const;
  // Replaces the point of a trial beyond the target by the exact point at the target, with the contact modes of the
  // trial or of `from`. False: there is no such point.
  bool EndAtTarget(const PathPoint& from, double target, Trial* trial) const;
  // Where the path comes back to an earlier increment on the increment: its number, and the trial ends there.
  std::optional<int> EndAtReturn(const PathPoint& from, Trial* trial) const;
  bool ConfirmedByHalves(const PathPoint& from, const Eigen::VectorXd& direction, double length, const Trial& whole);

  const Model& model_;
  MpecOptions options_;
  std::function<bool()> cancelled_;
  IpoptSolver ipopt_;
  IncrementSolver solver_;
  double step_length_;
  double gamma2_factor_ = 1.0;
  double length_ = 0.0;  // of the path so far
  bool started_ = false;
  bool bent_ = false;  // a contact changed its state in the last increment: its direction is a chord over the bend
  Eigen::VectorXd direction_;  // of the last accepted increment
  Eigen::VectorXd onward_;     // of the last one that lies between events
  double last_length_ = 0.0;   // of it
  int iterations_ = 0;         // since the last accepted increment
};

// For TraceControl::mpec.
std::unique_ptr<PathMethod> MakeMpecMethod(const MethodTask& task);

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_MPEC_METHOD_H_
