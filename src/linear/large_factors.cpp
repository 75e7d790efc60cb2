#include "linear/large_factors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "contact_path/linear/large_system.h"
#include "contact_path/tolerances.h"
#include "linear/ordering.h"

namespace contact_path {
namespace {

constexpr std::size_t kMostMoved = 32;  // of all matrices that one has served

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
  made_ = nullptr;
  ordering_ = nullptr;
}

bool LargeFactors::Factorize(const Eigen::SparseMatrix<double>& transposed, const Eigen::VectorXd& row,
                             const Frame* frame) {
  Frame own;
  if (frame == nullptr || !SetValues(transposed, *frame)) {
    own = FrameOf(transposed);
    own.orderings = frame != nullptr ? frame->orderings : &own_orderings_;
    frame = &own;
    SetValues(transposed, own);
  }
  unknowns_ = frame->unknowns;
  equations_ = frame->equations;
  odd_ = frame->odd;
  row_.resize(frame->size);
  SetRow(row);
  if (Update(*frame)) return true;
  made_ = nullptr;
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
  }
  ordering_ = frame->orderings->Add(*frame, row_);
  border_ = ordering_->border;
  return FactorizeBordered(true);
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

bool LargeFactors::FactorizeBordered(bool any_border) {
  update_.Clear();
  made_ = nullptr;
  made_ = std::make_shared<OrderedFactors>();
  made_->ordering = ordering_;
  made_->values.resize(values_.size() + border_.size());
  made_->values << values_, border_;
  along_ = 1.0;
  if (!made_->factors.Factorize(ordering_->analysis, made_->values)) return false;
  right_ = Eigen::VectorXd::Unit(row_.size(), row_.size() - 1);
  made_->along.resize(row_.size());
  made_->factors.SolveTransposed(right_.data(), made_->along.data());
  direction_ = made_->along;
  if (!IsRegular(any_border)) return false;
  std::vector<std::weak_ptr<OrderedFactors>>& made = ordering_->made;
  made.erase(std::remove_if(made.begin(), made.end(), [](const auto& factors) { return factors.expired(); }),
             made.end());
  made.push_back(made_);
  return true;
}

bool LargeFactors::Update(const Frame& frame) {
  const std::shared_ptr<const Ordering> ordering = frame.orderings->Find(frame, row_);
  if (ordering == nullptr) return false;
  // The places where N differs from the matrix of these factors; nothing where it differs too much.
  const auto changed_from = [&](const OrderedFactors& factors) -> std::optional<std::vector<int>> {
    std::vector<int> changed;
    for (std::size_t k = 0; k + 1 < frame.starts.size(); ++k) {
      const int begin = frame.starts[k], count = frame.starts[k + 1] - begin;
      if (values_.segment(begin, count) == factors.values.segment(begin, count)) continue;
      if (changed.size() == kMostChanged) return std::nullopt;
      changed.push_back(static_cast<int>(k));
    }
    return changed;
  };
  std::shared_ptr<OrderedFactors> made;
  for (const std::weak_ptr<OrderedFactors>& any : ordering->made) {
    std::shared_ptr<OrderedFactors> factors = any.lock();
    if (factors == nullptr) continue;
    std::optional<std::vector<int>> changed = changed_from(*factors);
    if (!changed || (made != nullptr && changed->size() > changed_.size())) continue;
    changed_ = *std::move(changed);
    made = std::move(factors);
  }
  if (made == nullptr) return false;
  made_ = std::move(made);
  ordering_ = made_->ordering;
  border_ = made_->values.tail(static_cast<Eigen::Index>(ordering_->places.size()));
  direction_ = made_->along;
  update_.Clear();
  return (changed_.empty() || TakeDifferences()) && IsRegular(false);
}

bool LargeFactors::TakeDifferences() {
  const std::vector<int>&starts = ordering_->analysis.Starts(), &entries = ordering_->analysis.Entries();
  Eigen::MatrixXd moved(row_.size(), static_cast<Eigen::Index>(changed_.size()));
  std::vector<Eigen::Triplet<double>> differences;
  for (Eigen::Index j = 0; j < moved.cols(); ++j) {
    const int equation = changed_[static_cast<std::size_t>(j)];
    const auto k = static_cast<std::size_t>(equation);
    auto found = made_->moved.find(equation);
    if (found == made_->moved.end()) {
      if (made_->moved.size() == kMostMoved) return false;
      right_ = Eigen::VectorXd::Unit(row_.size(), equation);
      found = made_->moved.emplace(equation, row_.size()).first;
      made_->factors.SolveTransposed(right_.data(), found->second.data());
    }
    moved.col(j) = found->second;
    for (int at = starts[k]; at < starts[k + 1]; ++at)
      differences.emplace_back(j, entries[static_cast<std::size_t>(at)], values_[at] - made_->values[at]);
  }
  LowRankUpdate::Differences of_rows(moved.cols(), moved.rows());
  of_rows.setFromTriplets(differences.begin(), differences.end());
  if (!update_.Set(std::move(moved), of_rows)) return false;
  update_.Correct(direction_);
  return true;
}

bool LargeFactors::ReplaceRow(const Eigen::VectorXd& row) {
  SetRow(row);
  return IsRegular(true);
}

void LargeFactors::SetRow(const Eigen::VectorXd& row) {
  row_.setZero();
  for (std::size_t i = 0; i < unknowns_.size(); ++i) row_[unknowns_[i]] = row[static_cast<Eigen::Index>(i)];
}

bool LargeFactors::IsRegular(bool any_border) {
  const double length = direction_.norm();
  along_ = row_.dot(direction_);  // its sign is of use also where N is singular but for rounding
  if (!(PivotRatio() > tolerances::kSingularPivot)) return false;
  if (!any_border && !(border_.norm() * length < 1.0 / tolerances::kNearlyParallel)) return false;
  return std::abs(along_) > tolerances::kSingularPivot * row_.norm() * length;
}

void LargeFactors::Solve(double* x, Eigen::Index columns) {
  const std::size_t equations = equations_.size();
  solution_.resize(row_.size());
  for (Eigen::Index k = 0; k < columns; ++k) {
    double* const column = x + k * static_cast<Eigen::Index>(unknowns_.size());
    right_.setZero(row_.size());
    for (std::size_t e = 0; e < equations; ++e) right_[equations_[e]] = column[e];
    if (right_.isZero(0.0)) {
      solution_.setZero();
    } else {
      made_->factors.SolveTransposed(right_.data(), solution_.data());
      update_.Correct(solution_);
    }
    solution_ += (column[equations] - row_.dot(solution_)) / along_ * direction_;
    for (std::size_t i = 0; i < unknowns_.size(); ++i) column[i] = solution_[unknowns_[i]];
  }
}

void LargeFactors::SolveTransposed(double* y) {
  right_.setZero(row_.size());
  for (std::size_t i = 0; i < unknowns_.size(); ++i) right_[unknowns_[i]] = y[i];
  const double last = direction_.dot(right_) / along_;
  right_ -= last * row_;
  for (std::size_t k = 0; k < ordering_->places.size(); ++k)
    right_[ordering_->places[k]] += last * border_[static_cast<Eigen::Index>(k)];
  update_.PrepareTransposed(&right_);
  solution_.resize(row_.size());
  made_->factors.Solve(right_.data(), solution_.data());
  for (std::size_t e = 0; e < equations_.size(); ++e) y[e] = solution_[equations_[e]];
  y[equations_.size()] = last;
}

std::optional<Eigen::Index> LargeFactors::NegativeEigenvalues(Eigen::Index symmetric) const {
  const bool last = unknowns_[static_cast<std::size_t>(symmetric)] + 1 == static_cast<int>(row_.size());
  if (!last || !update_.IsEmpty()) return std::nullopt;
  std::vector<bool> turned(static_cast<std::size_t>(row_.size()), false);
  const auto constraints = static_cast<Eigen::Index>(equations_.size()) - symmetric;
  for (auto k = equations_.begin() + symmetric; k != equations_.end(); ++k) turned[static_cast<std::size_t>(*k)] = true;
  const std::optional<Eigen::Index> negative = made_->factors.NegativeEigenvalues(turned);
  return negative && *negative >= constraints ? std::optional(*negative - constraints) : std::nullopt;
}

int LargeFactors::DeterminantSign() const {
  const bool turned = (odd_ != (along_ < 0.0)) != update_.TurnsDeterminant();
  return turned ? -made_->factors.DeterminantSign() : made_->factors.DeterminantSign();
}

}  // namespace contact_path
