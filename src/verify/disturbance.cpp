#include "verify/disturbance.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace contact_path {
namespace {

// Over the size of the stiffness: what a rigid reaction gives way, and the springs of motions that others follow.
constexpr double kRigid = 1e-13;
constexpr double kStiffSpring = 1e4;
constexpr double kSkew = 1e-9;          // of the largest eigenvalue: what differences leave of a symmetric matrix
constexpr double kRoundingOfH = 1e-13;  // of the terms that an entry is the sum of
constexpr Eigen::Index kMostSlides = 10;

double SizeOf(const Eigen::MatrixXd& stiffness) {
  const double largest = stiffness.size() == 0 ? 0.0 : stiffness.cwiseAbs().maxCoeff();
  return largest > 0.0 ? largest : 1.0;
}

using Places = std::vector<Eigen::Index>;

Places PlacesIn(std::uint32_t set, Eigen::Index size) {
  Places places;
  for (Eigen::Index i = 0; i < size; ++i)
    if ((set >> i & 1U) != 0) places.push_back(i);
  return places;
}

// The sum of the signs of det H_I over the sets I that slide in the solutions of w = H z + q, w . z = 0, for a q > 0;
// nothing where a sign is lost.
std::optional<int> DegreeOf(const Eigen::MatrixXd& H) {
  const Eigen::Index size = H.rows();
  Eigen::VectorXd q(size);
  for (Eigen::Index i = 0; i < size; ++i) q[i] = 1.0 + 0.37 * std::sin(2.3 * static_cast<double>(i + 1));
  int degree = 1;  // nothing slides
  for (std::uint32_t set = 1; set < 1U << size; ++set) {
    const Places in = PlacesIn(set, size), rest = PlacesIn(~set, size);
    const Eigen::FullPivLU<Eigen::MatrixXd> factors(H(in, in));
    if (!factors.isInvertible()) return std::nullopt;
    const Eigen::VectorXd z = factors.solve(-q(in));
    if (!(z.minCoeff() > 0.0)) continue;
    if (!rest.empty() && !((H(rest, in) * z + q(rest)).minCoeff() > 0.0)) continue;
    degree += factors.determinant() > 0.0 ? 1 : -1;
  }
  return degree;
}

// w = H z, with the rounding of each entry.
struct OfSlides {
  Eigen::MatrixXd H, rounding;
};

// changed: by differences of twice the step.
OfSlides CondensedOn(const Disturbed& of, bool changed) {
  const Eigen::MatrixXd stiffness = changed ? Eigen::MatrixXd(of.stiffness + of.change) : of.stiffness;
  const Eigen::Index n = stiffness.rows(), m = of.held.cols(), count = static_cast<Eigen::Index>(of.sliding.size());
  const double rigid = kRigid / SizeOf(stiffness);
  Eigen::MatrixXd equations(n + m, n + m), moved = Eigen::MatrixXd::Zero(n + m, count);
  equations << stiffness, -of.held, of.held.transpose(), Eigen::MatrixXd(of.give.cwiseMax(rigid).asDiagonal());
  for (Eigen::Index k = 0; k < count; ++k) {
    const Sliding& by = of.sliding[static_cast<std::size_t>(k)];
    moved(n + by.along, k) = by.sense;
  }
  const Eigen::MatrixXd by_slides = equations.fullPivLu().solve(moved);
  const Eigen::RowVectorXd sizes = by_slides.topRows(n).colwise().norm();
  OfSlides found{Eigen::MatrixXd(count, count), Eigen::MatrixXd(count, count)};
  for (Eigen::Index k = 0; k < count; ++k) {
    const Sliding& at = of.sliding[static_cast<std::size_t>(k)];
    const Eigen::RowVectorXd along = at.sense * by_slides.row(n + at.along);
    Eigen::RowVectorXd across = Eigen::RowVectorXd::Zero(count);
    if (at.across) across = at.friction * by_slides.row(n + *at.across);
    if (at.by_place.size() > 0)
      across += (changed ? at.by_place + at.change : at.by_place).transpose() * by_slides.topRows(n);
    found.H.row(k) = along + across;
    found.rounding.row(k) =
        kRoundingOfH * (along.cwiseAbs() + across.cwiseAbs() + SizeOf(stiffness) * sizes[k] * sizes);
  }
  return found;
}

}  // namespace

FreeMotions::FreeMotions(const Disturbed& of) {
  const Eigen::Index n = of.stiffness.rows();
  const double size = SizeOf(of.stiffness);
  Eigen::MatrixXd axes = Eigen::MatrixXd::Identity(n, n);
  Eigen::VectorXd springs = Eigen::VectorXd::Zero(n);
  if (of.held.cols() > 0) {
    const Eigen::VectorXd roots = of.give.cwiseMax(kRigid / size).cwiseSqrt().cwiseInverse();
    const Eigen::BDCSVD<Eigen::MatrixXd> svd(of.held * roots.asDiagonal(), Eigen::ComputeFullU);
    axes = svd.matrixU();
    springs.head(svd.singularValues().size()) = svd.singularValues().cwiseAbs2();
  }
  const auto stiff = (springs.array() > kStiffSpring * size).count();
  const Eigen::MatrixXd left = axes.rightCols(n - stiff);
  stiff_ = axes.leftCols(stiff);
  of_stiff_ =
      (Eigen::MatrixXd(springs.head(stiff).asDiagonal()) + stiff_.transpose() * of.stiffness * stiff_).inverse();
  motions_ = left - stiff_ * (of_stiff_ * (stiff_.transpose() * of.stiffness * left));
  stiffness_ = left.transpose() * of.stiffness * motions_;
  stiffness_.diagonal() += springs.tail(n - stiff);
  if (stiffness_.rows() == 0) return;
  const Eigen::MatrixXd skew = stiffness_ - stiffness_.transpose();
  stiffness_ -= 0.5 * skew;
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(stiffness_, Eigen::EigenvaluesOnly).eigenvalues();
  falling_ = static_cast<int>((values.array() < 0.0).count());
  largest_ = std::max(values.cwiseAbs().maxCoeff(), size);
  smallest_ = values.cwiseAbs().minCoeff() / largest_;
  // An error that grows as the step shrinks, as at a kink of the forces, is twice the change; a smooth one is a third.
  off_ = 2.0 * (left.transpose() * of.change * left).norm() / largest_;
  symmetric_ = skew.norm() <= (kSkew + off_) * largest_;
}

double FreeMotions::Compliance(const Eigen::VectorXd& force) const {
  const Eigen::VectorXd left = Of(force), held = stiff_.transpose() * force;
  return held.dot(of_stiff_ * held) + left.dot(stiffness_.fullPivLu().solve(left));
}

bool PositiveOnCone(const Eigen::MatrixXd& H) {
  const Eigen::MatrixXd symmetric = 0.5 * (H + H.transpose());
  if (Eigen::LLT<Eigen::MatrixXd>(symmetric).info() == Eigen::Success) return true;
  for (std::uint32_t set = 1; set < 1U << H.rows(); ++set) {
    const Places in = PlacesIn(set, H.rows());
    const auto size = static_cast<Eigen::Index>(in.size());
    const Eigen::FullPivLU<Eigen::MatrixXd> factors(symmetric(in, in));
    if (!factors.isInvertible()) return false;
    if (factors.solve(Eigen::VectorXd::Unit(size, size - 1)).maxCoeff() < 0.0) return false;
  }
  return true;
}

std::optional<Verdict> VerdictOf(const Disturbed& of, const FreeMotions& free) {
  if (!free.Told()) return std::nullopt;
  if (of.sliding.empty()) {
    if (free.Falling() == 0) return Verdict::kStable;
    return free.Symmetric() ? std::optional(Verdict::kUnstable) : std::nullopt;
  }
  const OfSlides found = CondensedOn(of, false), other = CondensedOn(of, true);
  const Eigen::Index count = found.H.rows();
  if (!found.H.allFinite() || !other.H.allFinite()) return std::nullopt;
  // No energy opposes a slip of which only rounding is left.
  if ((found.H.diagonal().cwiseAbs().array() <= found.rounding.diagonal().array()).any()) return std::nullopt;
  const double largest = found.H.cwiseAbs().maxCoeff();
  const Eigen::VectorXd unit = found.H.diagonal().cwiseAbs().cwiseMax(1e-8 * largest).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd H = unit.asDiagonal() * found.H * unit.asDiagonal();
  const double off =
      (unit.asDiagonal() * (found.rounding + 2.0 * (other.H - found.H).cwiseAbs()) * unit.asDiagonal()).norm();
  const Eigen::MatrixXd error = off * Eigen::MatrixXd::Identity(count, count);
  if (count > kMostSlides) {
    const Eigen::MatrixXd least = 0.5 * (H + H.transpose()) - error;
    const bool positive = Eigen::LLT<Eigen::MatrixXd>(least).info() == Eigen::Success;
    return positive && free.Falling() == 0 ? std::optional(Verdict::kStable) : std::nullopt;
  }
  if (free.Falling() == 0 && PositiveOnCone(H - error)) return Verdict::kStable;
  if (free.Falling() == 0 && PositiveOnCone(H + error)) return std::nullopt;
  if (!free.Symmetric()) return std::nullopt;
  if (free.Falling() > 0 && count == 1) return Verdict::kUnstable;
  const std::optional<int> degree = DegreeOf(H);
  if (!degree || DegreeOf(H - error) != degree || DegreeOf(H + error) != degree) return std::nullopt;
  return (free.Falling() % 2 == 0 ? 1 : -1) * *degree == 1 ? Verdict::kNotProved : Verdict::kUnstable;
}

}  // namespace contact_path
