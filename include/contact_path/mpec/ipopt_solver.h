// Ipopt behind the solver seam. The .cpp is the only place that includes Ipopt.
#ifndef CONTACT_PATH_MPEC_IPOPT_SOLVER_H_
#define CONTACT_PATH_MPEC_IPOPT_SOLVER_H_

#include <functional>
#include <memory>

#include "contact_path/mpec/nonlinear_program.h"

namespace contact_path {

// One Ipopt application, kept for all solves: exact Hessian, MUMPS, no relaxed bounds, nothing printed, deterministic.
class IpoptSolver : public NonlinearSolver {
 public:
  // cancelled: asked at every iteration; true stops the solve. May be empty.
  // Throws std::runtime_error if Ipopt cannot be set up (a missing linear solver, say).
  explicit IpoptSolver(std::function<bool()> cancelled);
  ~IpoptSolver() override;

  // Throws std::bad_alloc where there is not enough memory, LinearSolverError where Ipopt breaks down.
  SolveOutcome Solve(const NonlinearProgram& program, double barrier, PrimalDual* point) override;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_MPEC_IPOPT_SOLVER_H_
