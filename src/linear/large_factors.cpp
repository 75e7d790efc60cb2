#include "linear/large_factors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "contact_path/linear/orderings.h"
#include "contact_path/tolerances.h"
#include "linear/ordering.h"

namespace contact_path {
namespace {

// The first equation that lacks the unknown of its number: equations of equilibrium come first, and have it.
Eigen::Index FirstWithoutDiagonal(const Eigen::SparseMatrix<double>& transposed) {
  for (Eigen::Index column = 0; column < transposed.cols(); ++column) {
    const int* const begin = transposed.innerIndexPtr() + transposed.outerIndexPtr()[column];
    const int* const end = transposed.innerIndexPtr() + transposed.outerIndexPtr()[column + 1];
    if (!std::binary_search(begin, end, static_cast<int>(column))) return column;
  }
  return transposed.cols();
}

// The system itself; the unknown that spoils the symmetry of the pattern, as a load factor, comes last.
Frame FrameOf(const Eigen::SparseMatrix<double>& transposed) {
  Frame frame;
  frame.size = static_cast<int>(transposed.rows());
  const int moved = static_cast<int>(FirstWithoutDiagonal(transposed));
  frame.unknowns.resize(static_cast<std::size_t>(frame.size));
  for (int i = 0; i < frame.size; ++i)
    frame.unknowns[static_cast<std::size_t>(i)] = i < moved ? i : i == moved ? frame.size - 1 : i - 1;
  frame.odd = (frame.size - 1 - moved) % 2 != 0;
  frame.equations.resize(static_cast<std::size_t>(transposed.cols()));
  std::iota(frame.equations.begin(), frame.equations.end(), 0);
  frame.starts.assign(transposed.outerIndexPtr(), transposed.outerIndexPtr() + transposed.cols() + 1);
  frame.entries.resize(static_cast<std::size_t>(transposed.nonZeros()));
  std::transform(transposed.innerIndexPtr(), transposed.innerIndexPtr() + transposed.nonZeros(), frame.entries.begin(),
                 [&frame](int unknown) { return frame.unknowns[static_cast<std::size_t>(unknown)]; });
  for (std::size_t k = 0; k + 1 < frame.starts.size(); ++k)
    std::sort(frame.entries.begin() + frame.starts[k], frame.entries.begin() + frame.starts[k + 1]);
  return frame;
}

}  // namespace

void LargeFactors::Free() {
  factors_.Free();
  ordering_ = nullptr;
}

bool LargeFactors::Factorize(const Eigen::SparseMatrix<double>& transposed, const Eigen::VectorXd& row,
                             const Frame* frame) {
  factors_.Free();
  along_ = 1.0;
  Frame own;
  if (frame == nullptr || !SetValues(transposed, *frame)) {
    own = FrameOf(transposed);
    own.orderings = frame != nullptr ? frame->orderings : &own_orderings_;
    frame = &own;
    SetValues(transposed, own);
  }
  Transfer(*frame, row);
  const std::shared_ptr<const Ordering> known = frame->orderings->Find(*frame, row_);
  if (known != nullptr) {
    if (AreGoodPlaces(known->places, row_))
      border_ = EntriesAt(known->places, row_);
    else if (known != ordering_)
      border_ = known->border;
    ordering_ = known;
    if (FactorizeBordered(false)) return true;
    // The border may be what made N singular, where it is not the row's own.
    if (known->places == LargestPlaces(row_)) return false;
    factors_.Free();
  }
  ordering_ = frame->orderings->Add(*frame, row_);
  border_ = ordering_->border;
  return FactorizeBordered(true);
}

void LargeFactors::Transfer(const Frame& frame, const Eigen::VectorXd& row) {
  unknowns_ = frame.unknowns;
  equations_ = frame.equations;
  odd_ = frame.odd;
  row_ = Eigen::VectorXd::Zero(frame.size);
  for (std::size_t i = 0; i < unknowns_.size(); ++i) row_[unknowns_[i]] = row[static_cast<Eigen::Index>(i)];
}

// Without the border. False if an entry has no place in the frame.
bool LargeFactors::SetValues(const Eigen::SparseMatrix<double>& transposed, const Frame& frame) {
  values_ = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(frame.entries.size()));
  int next = 0;  // equation of the frame that has not been looked at
  const auto leave_out = [&](int beyond) {
    for (; next < beyond; ++next) {
      const auto begin = frame.entries.begin() + frame.starts[static_cast<std::size_t>(next)];
      const auto end = frame.entries.begin() + frame.starts[static_cast<std::size_t>(next) + 1];
      values_[std::lower_bound(begin, end, next) - frame.entries.begin()] = 1.0;
    }
    ++next;
  };
  for (Eigen::Index column = 0; column < transposed.cols(); ++column) {
    const int equation = frame.equations[static_cast<std::size_t>(column)];
    leave_out(equation);
    const auto begin = frame.entries.begin() + frame.starts[static_cast<std::size_t>(equation)];
    const auto end = frame.entries.begin() + frame.starts[static_cast<std::size_t>(equation) + 1];
    auto at = begin;
    for (Eigen::SparseMatrix<double>::InnerIterator it(transposed, column); it; ++it) {
      const int unknown = frame.unknowns[static_cast<std::size_t>(it.row())];
      if (at == end || *at != unknown) at = std::lower_bound(begin, end, unknown);
      if (at == end || *at != unknown) return false;
      values_[at - frame.entries.begin()] = it.value();
      ++at;
    }
  }
  leave_out(frame.size - 1);
  return true;
}

// any_border: also with one that is nearly orthogonal to the null vector of J.
bool LargeFactors::FactorizeBordered(bool any_border) {
  const Eigen::Index before = static_cast<Eigen::Index>(ordering_->analysis.Entries().size()) - border_.size();
  values_.conservativeResize(before + border_.size());
  values_.tail(border_.size()) = border_;
  along_ = 1.0;
  if (!factors_.Factorize(ordering_->analysis, values_)) return false;
  right_ = Eigen::VectorXd::Unit(row_.size(), row_.size() - 1);
  direction_.resize(row_.size());
  factors_.SolveTransposed(right_.data(), direction_.data());
  along_ = row_.dot(direction_);  // its sign is of use also where N is singular but for rounding
  const double length = direction_.norm();
  if (!(PivotRatio() > tolerances::kSingularPivot)) return false;
  if (!any_border && !(border_.norm() * length < 1.0 / tolerances::kNearlyParallel)) return false;
  return std::abs(along_) > tolerances::kSingularPivot * row_.norm() * length;
}

void LargeFactors::Solve(double* x, Eigen::Index columns) {
  const std::size_t equations = equations_.size();
  solution_.resize(row_.size());
  for (Eigen::Index k = 0; k < columns; ++k) {
    double* const column = x + k * static_cast<Eigen::Index>(unknowns_.size());
    right_.setZero();
    for (std::size_t e = 0; e < equations; ++e) right_[equations_[e]] = column[e];
    factors_.SolveTransposed(right_.data(), solution_.data());
    solution_ += (column[equations] - row_.dot(solution_)) / along_ * direction_;
    for (std::size_t i = 0; i < unknowns_.size(); ++i) column[i] = solution_[unknowns_[i]];
  }
}

void LargeFactors::SolveTransposed(double* y) {
  const Eigen::Index last = row_.size() - 1;
  right_.setZero();
  for (std::size_t i = 0; i < unknowns_.size(); ++i) right_[unknowns_[i]] = y[i];
  Eigen::VectorXd z(row_.size()), q(row_.size());
  factors_.Solve(right_.data(), z.data());
  right_ = row_;
  for (std::size_t k = 0; k < ordering_->places.size(); ++k)
    right_[ordering_->places[k]] -= border_[static_cast<Eigen::Index>(k)];
  factors_.Solve(right_.data(), q.data());
  z -= z[last] / along_ * q;
  for (std::size_t e = 0; e < equations_.size(); ++e) y[e] = z[equations_[e]];
  y[equations_.size()] = z[last];
}

std::optional<Eigen::Index> LargeFactors::NegativeEigenvalues(Eigen::Index symmetric) const {
  if (unknowns_[static_cast<std::size_t>(symmetric)] + 1 != static_cast<int>(row_.size())) return std::nullopt;
  std::vector<bool> turned(static_cast<std::size_t>(row_.size()), false);
  const auto constraints = static_cast<Eigen::Index>(equations_.size()) - symmetric;
  for (auto k = equations_.begin() + symmetric; k != equations_.end(); ++k) turned[static_cast<std::size_t>(*k)] = true;
  const std::optional<Eigen::Index> negative = factors_.NegativeEigenvalues(turned);
  return negative && *negative >= constraints ? std::optional(*negative - constraints) : std::nullopt;
}

int LargeFactors::DeterminantSign() const {
  return odd_ == (along_ < 0.0) ? factors_.DeterminantSign() : -factors_.DeterminantSign();
}

}  // namespace contact_path
