// One step of the motion of the structure against drag, by implicit Euler.
#ifndef CONTACT_PATH_SRC_STABILITY_MOTION_STEP_H_
#define CONTACT_PATH_SRC_STABILITY_MOTION_STEP_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <optional>
#include <vector>

#include "contact_path/equations/fixed_mode_system.h"
#include "contact_path/law/laws.h"
#include "contact_path/linear/bordered_solver.h"
#include "contact_path/stability/machine.h"
#include "contact_path/structure/structure.h"

namespace contact_path {

// The equation that a machine with a fixed setting adds: row . (u, s) = value.
struct MachineEquation {
  Eigen::VectorXd row;  // NumDofs() + 1
  double value = 0.0;

  // s = k (Q - f . u), with the Q that the machine has at a point.
  static MachineEquation Of(const Structure& structure, const Machine& machine, const PathPoint& at);
  // By the unknowns of a fixed-mode system.
  Eigen::VectorXd Row(Eigen::Index unknowns) const;
};

struct MotionStep {
  PathPoint point;       // the end
  int iterations = 0;    // of Newton's method, with the last states
  bool changed = false;  // other states than at the start
  // By law: the share of the motion of its other ports after which it acts, where it was idle; else 0.
  std::vector<double> acts_after;
};

// Solves phi(u, s) - T r + D (u - a) = 0 with the equation of the machine and the laws: motions and forces are those of
// the end of the step, travel counts from its start, or from where an idle law begins to act. D: diagonal, a: the
// anchor of the drag, NumDofs() both. The states are found by an active set iteration around Newton's method.
class MotionStepSolver {
 public:
  // All must outlive the solver.
  MotionStepSolver(const Structure& structure, const Laws& laws, const MachineEquation& machine);

  // Nothing: Newton's method fails, or no states were found. `from` has known pieces where laws act.
  std::optional<MotionStep> Solve(const PathPoint& from, const Eigen::VectorXd& drag, const Eigen::VectorXd& anchor);
  // The point as an arc through it has it.
  PathPoint AsOfArc(const PathPoint& point);

 private:
  struct Change {
    std::size_t law;
    Mode to;
    double excess;  // of the limit, over its tolerance
  };

  // From the values of *x.
  bool Newton(const Eigen::VectorXd& drag, const Eigen::VectorXd& anchor, Eigen::VectorXd* x, int* iterations);
  std::vector<Change> Changes(const Eigen::VectorXd& x) const;
  // Other ports of a law that begins to act are measured from where its first motion is zero: by linear interpolation
  // of the step.
  void NoteActing(const PathPoint& from, const Change& change, const Eigen::VectorXd& x, Eigen::VectorXd* references,
                  MotionStep* step) const;

  const Structure& structure_;
  const Laws& laws_;
  const MachineEquation& machine_;
  FixedModeSystem system_;
  BorderedSolver solver_;
  Eigen::SparseMatrix<double> jacobian_;
  Eigen::VectorXd residual_, newton_step_;
  Eigen::VectorXd strains_from_, strains_to_;  // for Structure::MixedTangent(), (u, s)
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_STABILITY_MOTION_STEP_H_
