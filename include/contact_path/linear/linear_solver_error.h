// A linear solver that gives up: trouble of the computation, and no statement about the structure.
#ifndef CONTACT_PATH_LINEAR_LINEAR_SOLVER_ERROR_H_
#define CONTACT_PATH_LINEAR_LINEAR_SOLVER_ERROR_H_

#include <stdexcept>
#include <string>

namespace contact_path {

// Neither a singular matrix, which is a result, nor lack of memory, which is std::bad_alloc.
class LinearSolverError : public std::runtime_error {
 public:
  // status: as the solver has it.
  LinearSolverError(const std::string& solver, int status)
      : std::runtime_error("the linear solver " + solver + " failed (status " + std::to_string(status) + ")") {}
};

}  // namespace contact_path

#endif  // CONTACT_PATH_LINEAR_LINEAR_SOLVER_ERROR_H_
