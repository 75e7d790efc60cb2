#include "linear/umfpack_factors.h"

#include <umfpack.h>

#include <array>
#include <new>

#include "contact_path/linear/linear_solver_error.h"

namespace contact_path {
namespace {

using Info = std::array<double, UMFPACK_INFO>;

// Whether the factors exist and are regular.
bool Require(int status) {
  if (status == UMFPACK_ERROR_out_of_memory || status == UMFPACK_ERROR_n_nonpositive) throw std::bad_alloc();
  if (status < 0) throw LinearSolverError("UMFPACK", status);
  return status == UMFPACK_OK;
}

}  // namespace

UmfpackFactors::UmfpackFactors() : control_(UMFPACK_CONTROL) {
  umfpack_di_defaults(control_.data());
  control_[UMFPACK_ORDERING] = UMFPACK_ORDERING_METIS;
  control_[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
  // Taking them out first, as the conditions of contacts across an axis, spoils the symmetry of what is left.
  control_[UMFPACK_SINGLETONS] = 0.0;
  control_[UMFPACK_IRSTEP] = 0.0;  // whoever solves iterates himself where it matters
}

void UmfpackFactors::Free() {
  FreeNumeric();
  umfpack_di_free_symbolic(&symbolic_);
}

void UmfpackFactors::FreeNumeric() { umfpack_di_free_numeric(&numeric_); }

bool UmfpackFactors::Factorize(const Eigen::SparseMatrix<double>& matrix, bool same_pattern) {
  FreeNumeric();
  const auto n = static_cast<int>(matrix.rows());
  const int *outer = matrix.outerIndexPtr(), *inner = matrix.innerIndexPtr();
  const double* const values = matrix.valuePtr();
  Info info{};
  if (!same_pattern || symbolic_ == nullptr) {
    umfpack_di_free_symbolic(&symbolic_);
    Require(umfpack_di_symbolic(n, n, outer, inner, values, &symbolic_, control_.data(), info.data()));
  }
  const bool regular =
      Require(umfpack_di_numeric(outer, inner, values, symbolic_, &numeric_, control_.data(), info.data()));
  pivot_ratio_ = info[UMFPACK_RCOND];
  integers_.resize(n);
  numbers_.resize(n);
  return regular;
}

int UmfpackFactors::DeterminantSign() const {
  double mantissa = 0.0, exponent = 0.0;
  Require(umfpack_di_get_determinant(&mantissa, &exponent, numeric_, nullptr));
  return mantissa > 0.0 ? 1 : mantissa < 0.0 ? -1 : 0;
}

void UmfpackFactors::SolveTransposed(const double* b, double* x) {
  Info info{};
  // Without refinement the matrix itself is not looked at.
  const int none = 0;
  const double nothing = 0.0;
  Require(umfpack_di_wsolve(UMFPACK_At, &none, &none, &nothing, x, b, numeric_, control_.data(), info.data(),
                            integers_.data(), numbers_.data()));
}

}  // namespace contact_path
