#include "contact_path/mpec/ipopt_solver.h"

#include <IpIpoptApplication.hpp>
#include <IpTNLP.hpp>

#include <algorithm>
#include <cmath>
#include <new>
#include <stdexcept>
#include <utility>

#include "contact_path/linear/linear_solver_error.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

using Ipopt::Number;

constexpr Number kIpoptInfinity = 2e19;  // beyond Ipopt's nlp_upper_bound_inf

Number Bound(double value) { return std::isinf(value) ? std::copysign(kIpoptInfinity, value) : value; }

// Hands one program to Ipopt and takes back the point in which Ipopt ends. Only delegates.
class Adapter : public Ipopt::TNLP {
 public:
  Adapter(const NonlinearProgram& program, bool warm, const std::function<bool()>& cancelled, PrimalDual* point)
      : program_(program), warm_(warm), cancelled_(cancelled), point_(point) {}

  bool was_cancelled() const { return was_cancelled_; }
  int iterations() const { return iterations_; }

  bool get_nlp_info(Ipopt::Index& n, Ipopt::Index& m, Ipopt::Index& nnz_jac, Ipopt::Index& nnz_hessian,
                    IndexStyleEnum& index_style) override {
    n = static_cast<Ipopt::Index>(program_.NumVariables());
    m = static_cast<Ipopt::Index>(program_.NumConstraints());
    jacobian_ = program_.Jacobian(point_->x);
    hessian_ = program_.Hessian(point_->x, 1.0, Eigen::VectorXd::Zero(program_.NumConstraints()));
    nnz_jac = static_cast<Ipopt::Index>(jacobian_.size());
    nnz_hessian = static_cast<Ipopt::Index>(hessian_.size());
    index_style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Ipopt::Index n, Number* lower, Number* upper, Ipopt::Index m, Number* g_lower,
                       Number* g_upper) override {
    const ProgramBounds bounds = program_.Bounds();
    std::transform(bounds.variables.data(), bounds.variables.data() + n, lower, Bound);
    std::fill_n(upper, n, kIpoptInfinity);
    std::transform(bounds.lower.data(), bounds.lower.data() + m, g_lower, Bound);
    std::transform(bounds.upper.data(), bounds.upper.data() + m, g_upper, Bound);
    return true;
  }

  bool get_starting_point(Ipopt::Index n, bool, Number* x, bool init_z, Number* z_lower, Number* z_upper,
                          Ipopt::Index m, bool init_lambda, Number* lambda) override {
    std::copy_n(point_->x.data(), n, x);
    if (init_z) {
      if (!warm_) return false;
      std::copy_n(point_->lower_multipliers.data(), n, z_lower);
      std::fill_n(z_upper, n, 0.0);
    }
    if (init_lambda) {
      if (!warm_) return false;
      std::copy_n(point_->multipliers.data(), m, lambda);
    }
    return true;
  }

  bool eval_f(Ipopt::Index n, const Number* x, bool, Number& value) override {
    value = program_.Objective(Copy(x, n));
    return std::isfinite(value);
  }

  bool eval_grad_f(Ipopt::Index n, const Number* x, bool, Number* gradient) override {
    return Give(program_.Gradient(Copy(x, n)), gradient);
  }

  bool eval_g(Ipopt::Index n, const Number* x, bool, Ipopt::Index, Number* g) override {
    return Give(program_.Constraints(Copy(x, n)), g);
  }

  bool eval_jac_g(Ipopt::Index n, const Number* x, bool, Ipopt::Index, Ipopt::Index, Ipopt::Index* rows,
                  Ipopt::Index* columns, Number* values) override {
    if (values != nullptr) jacobian_ = program_.Jacobian(Copy(x, n));
    return Give(jacobian_, rows, columns, values);
  }

  bool eval_h(Ipopt::Index n, const Number* x, bool, Number factor, Ipopt::Index m, const Number* lambda, bool,
              Ipopt::Index, Ipopt::Index* rows, Ipopt::Index* columns, Number* values) override {
    if (values != nullptr) hessian_ = program_.Hessian(Copy(x, n), factor, Copy(lambda, m));
    return Give(hessian_, rows, columns, values);
  }

  bool intermediate_callback(Ipopt::AlgorithmMode, Ipopt::Index iteration, Number, Number, Number, Number, Number,
                             Number, Number, Number, Ipopt::Index, const Ipopt::IpoptData*,
                             Ipopt::IpoptCalculatedQuantities*) override {
    iterations_ = iteration;
    was_cancelled_ = cancelled_ && cancelled_();
    return !was_cancelled_;
  }

  void finalize_solution(Ipopt::SolverReturn, Ipopt::Index n, const Number* x, const Number* z_lower, const Number*,
                         Ipopt::Index m, const Number*, const Number* lambda, Number, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    *point_ = {Copy(x, n), Copy(lambda, m), Copy(z_lower, n)};
  }

 private:
  static Eigen::VectorXd Copy(const Number* numbers, Ipopt::Index count) {
    return Eigen::Map<const Eigen::VectorXd>(numbers, count);
  }
  static bool Give(const Eigen::VectorXd& values, Number* out) {
    std::copy_n(values.data(), values.size(), out);
    return values.allFinite();
  }
  // values: null where Ipopt asks for the places.
  static bool Give(const MatrixEntries& entries, Ipopt::Index* rows, Ipopt::Index* columns, Number* values) {
    bool finite = true;
    for (const auto& entry : entries) {
      if (values == nullptr) {
        *rows++ = static_cast<Ipopt::Index>(entry.row());
        *columns++ = static_cast<Ipopt::Index>(entry.col());
      } else {
        finite = std::isfinite(*values++ = entry.value()) && finite;
      }
    }
    return finite;
  }

  const NonlinearProgram& program_;
  bool warm_;
  const std::function<bool()>& cancelled_;
  PrimalDual* point_;
  bool was_cancelled_ = false;
  int iterations_ = 0;
  MatrixEntries jacobian_, hessian_;  // of the last point
};

}  // namespace

struct IpoptSolver::Implementation {
  std::function<bool()> cancelled;
  Ipopt::SmartPtr<Ipopt::IpoptApplication> application;
};

IpoptSolver::IpoptSolver(std::function<bool()> cancelled) : implementation_(std::make_unique<Implementation>()) {
  implementation_->cancelled = std::move(cancelled);
  implementation_->application = new Ipopt::IpoptApplication(/*create_console_out=*/false);
  Ipopt::IpoptApplication& application = *implementation_->application;
  Ipopt::OptionsList& options = *application.Options();
  options.SetStringValue("linear_solver", "mumps");
  // AMD: of what MUMPS offers the fastest by far on equations that are nearly all zero on the diagonal (8 times faster
  // than its own choice for a wall of 2,000 dofs, 1.5 to 4 times faster than METIS; no difference for small scenes).
  options.SetIntegerValue("mumps_pivot_order", 0);
  options.SetIntegerValue("print_level", 0);
  options.SetStringValue("sb", "yes");
  options.SetNumericValue("tol", tolerances::kAccepted);
  options.SetNumericValue("bound_relax_factor", 0.0);
  options.SetStringValue("honor_original_bounds", "yes");
  options.SetIntegerValue("max_iter", 300);
  options.SetIntegerValue("acceptable_iter", 0);  // solved, or not solved
  options.SetStringValue("mu_strategy", "monotone");
  options.SetStringValue("fixed_variable_treatment", "make_constraint");
  // An options file in the working directory must not change results.
  if (application.Initialize("") != Ipopt::Solve_Succeeded) throw std::runtime_error("Ipopt cannot be initialised");
}

IpoptSolver::~IpoptSolver() = default;

SolveOutcome IpoptSolver::Solve(const NonlinearProgram& program, double barrier, PrimalDual* point) {
  const bool warm = barrier > 0.0 && point->multipliers.size() == program.NumConstraints();
  Ipopt::OptionsList& options = *implementation_->application->Options();
  options.SetStringValue("warm_start_init_point", warm ? "yes" : "no");
  options.SetNumericValue("mu_init", warm ? barrier : 1e-2);
  const double push = warm ? 1e-4 * barrier : 1e-3;
  for (const char* name :
       {"warm_start_bound_push", "warm_start_bound_frac", "warm_start_slack_bound_push", "warm_start_slack_bound_frac",
        "warm_start_mult_bound_push", "bound_push", "bound_frac", "slack_bound_push", "slack_bound_frac"})
    options.SetNumericValue(name, push);

  Adapter* adapter = new Adapter(program, warm, implementation_->cancelled, point);
  const Ipopt::SmartPtr<Ipopt::TNLP> owner = adapter;
  const Ipopt::ApplicationReturnStatus status = implementation_->application->OptimizeTNLP(owner);
  // Neither is a statement about the program.
  if (status == Ipopt::Insufficient_Memory) throw std::bad_alloc();
  if (status == Ipopt::Unrecoverable_Exception || status == Ipopt::NonIpopt_Exception_Thrown)
    throw LinearSolverError("of Ipopt", status);
  SolveOutcome outcome;
  outcome.iterations = adapter->iterations();
  if (adapter->was_cancelled())
    outcome.status = SolveStatus::kCancelled;
  else if (status == Ipopt::Solve_Succeeded)
    outcome.status = SolveStatus::kSolved;
  return outcome;
}

}  // namespace contact_path
