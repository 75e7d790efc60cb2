// A nonlinear program as the solver wants it; what states the problem knows no solver.
#ifndef CONTACT_PATH_MPEC_NONLINEAR_PROGRAM_H_
#define CONTACT_PATH_MPEC_NONLINEAR_PROGRAM_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

namespace contact_path {

// Of a matrix; entries at the same place add up.
using MatrixEntries = std::vector<Eigen::Triplet<double, Eigen::Index>>;

// Infinite where there is none.
struct ProgramBounds {
  Eigen::VectorXd variables;     // lower bounds; there are no upper ones
  Eigen::VectorXd lower, upper;  // of the constraints
};

// minimise f(x) subject to lower <= c(x) <= upper, x >= lower bounds. The places of the entries of Jacobian and
// Hessian, and their order, are fixed for the life of the object.
class NonlinearProgram {
 public:
  virtual ~NonlinearProgram() = default;

  virtual Eigen::Index NumVariables() const = 0;
  virtual Eigen::Index NumConstraints() const = 0;
  virtual ProgramBounds Bounds() const = 0;

  virtual double Objective(const Eigen::VectorXd& x) const = 0;
  virtual Eigen::VectorXd Gradient(const Eigen::VectorXd& x) const = 0;
  virtual Eigen::VectorXd Constraints(const Eigen::VectorXd& x) const = 0;
  virtual MatrixEntries Jacobian(const Eigen::VectorXd& x) const = 0;
  // Lower triangle of the Hessian of factor * f + multipliers . c.
  virtual MatrixEntries Hessian(const Eigen::VectorXd& x, double factor, const Eigen::VectorXd& multipliers) const = 0;
};

// A point with multipliers, from which a solve starts and in which it ends.
struct PrimalDual {
  Eigen::VectorXd x;                  // variables
  Eigen::VectorXd multipliers;        // of the constraints; empty = none known (cold start)
  Eigen::VectorXd lower_multipliers;  // of the lower bounds
};

enum class SolveStatus { kFailed, kSolved, kCancelled };

struct SolveOutcome {
  SolveStatus status = SolveStatus::kFailed;
  int iterations = 0;
};

// Seam for tests: anything that solves a nonlinear program.
class NonlinearSolver {
 public:
  virtual ~NonlinearSolver() = default;
  // From `point` to a local optimum, written back into `point` also when it fails. `barrier` > 0: the starting barrier
  // parameter of a warm start from point->multipliers; 0: a cold start from point->x.
  virtual SolveOutcome Solve(const NonlinearProgram& program, double barrier, PrimalDual* point) = 0;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_MPEC_NONLINEAR_PROGRAM_H_
