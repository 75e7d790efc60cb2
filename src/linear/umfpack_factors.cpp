#include "linear/umfpack_factors.h"

#include <umfpack.h>

#include <algorithm>
#include <array>
#include <new>
#include <utility>

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

Eigen::VectorXd Control() {
  Eigen::VectorXd control(UMFPACK_CONTROL);
  umfpack_di_defaults(control.data());
  control[UMFPACK_ORDERING] = UMFPACK_ORDERING_METIS;
  control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
  // Taking them out first, as the conditions of contacts across an axis, spoils the symmetry of what is left.
  control[UMFPACK_SINGLETONS] = 0.0;
  control[UMFPACK_IRSTEP] = 0.0;  // whoever solves iterates himself where it matters
  return control;
}

}  // namespace

UmfpackAnalysis::UmfpackAnalysis(std::vector<int> starts, std::vector<int> entries)
    : starts_(std::move(starts)), entries_(std::move(entries)) {
  Eigen::VectorXd control = Control();
  Info info{};
  Require(umfpack_di_symbolic(Size(), Size(), starts_.data(), entries_.data(), nullptr, &symbolic_, control.data(),
                              info.data()));
  std::vector<int> rows(static_cast<std::size_t>(Size())), order = rows;
  Require(umfpack_di_get_symbolic(nullptr, nullptr, nullptr, nullptr, nullptr, rows.data(), order.data(), nullptr,
                                  nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, symbolic_));
  umfpack_di_free_symbolic(&symbolic_);
  const auto last = std::find(order.begin(), order.end(), Size() - 1);
  std::rotate(last, last + 1, order.end());
  control[UMFPACK_ORDERING] = UMFPACK_ORDERING_GIVEN;
  Require(umfpack_di_qsymbolic(Size(), Size(), starts_.data(), entries_.data(), nullptr, order.data(), &symbolic_,
                               control.data(), info.data()));
}

UmfpackAnalysis::~UmfpackAnalysis() { umfpack_di_free_symbolic(&symbolic_); }

UmfpackFactors::UmfpackFactors() : control_(Control()) {}

UmfpackFactors::~UmfpackFactors() { umfpack_di_free_numeric(&numeric_); }

bool UmfpackFactors::Factorize(const UmfpackAnalysis& analysis, const Eigen::VectorXd& values) {
  Info info{};
  const bool regular = Require(umfpack_di_numeric(analysis.Starts().data(), analysis.Entries().data(), values.data(),
                                                  analysis.Symbolic(), &numeric_, control_.data(), info.data()));
  pivot_ratio_ = info[UMFPACK_RCOND];
  integers_.resize(analysis.Size());
  numbers_.resize(analysis.Size());
  return regular;
}

int UmfpackFactors::DeterminantSign() const {
  double mantissa = 0.0, exponent = 0.0;
  Require(umfpack_di_get_determinant(&mantissa, &exponent, numeric_, nullptr));
  return mantissa > 0.0 ? 1 : mantissa < 0.0 ? -1 : 0;
}

std::optional<Eigen::Index> UmfpackFactors::NegativeEigenvalues(const std::vector<bool>& turned) const {
  const std::size_t last = turned.size() - 1;
  std::vector<int> rows(turned.size()), columns(turned.size());
  std::vector<double> pivots(turned.size());
  int inverse = 0;
  Require(umfpack_di_get_numeric(nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, rows.data(), columns.data(),
                                 pivots.data(), &inverse, nullptr, numeric_));
  const auto sign = [&](std::size_t k) { return (pivots[k] < 0.0) != turned[static_cast<std::size_t>(columns[k])]; };
  Eigen::Index negative = 0;
  std::size_t k = 0;
  for (; k < last; ++k) {
    if (rows[k] == columns[k]) {
      negative += sign(k) ? 1 : 0;
      continue;
    }
    // Two by two, beside the diagonal: of different signs, if their determinant is negative.
    if (rows[k] != columns[k + 1] || columns[k] != rows[k + 1] || sign(k) != sign(k + 1)) return std::nullopt;
    ++negative;
    ++k;
  }
  return k == last ? std::optional(negative) : std::nullopt;
}

void UmfpackFactors::SolveTransposed(const double* b, double* x) { Solve(UMFPACK_At, b, x); }

void UmfpackFactors::Solve(const double* b, double* x) { Solve(UMFPACK_A, b, x); }

void UmfpackFactors::Solve(int system, const double* b, double* x) {
  Info info{};
  // Without refinement the matrix itself is not looked at.
  const int none = 0;
  const double nothing = 0.0;
  Require(umfpack_di_wsolve(system, &none, &none, &nothing, x, b, numeric_, control_.data(), info.data(),
                            integers_.data(), numbers_.data()));
}

}  // namespace contact_path
