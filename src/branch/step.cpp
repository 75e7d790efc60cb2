#include "contact_path/branch/step.h"

#include <array>

#include "contact_path/branch/gauss_rule.h"

namespace contact_path {
namespace {

// The six quintic Hermite basis polynomials: value, first, second at the start, then at the end.
std::array<Quintic, 6> HermiteBasis(double length) {
  std::array<Quintic, 6> basis{};
  for (std::size_t i = 0; i < 6; ++i) {
    std::array<Jet, 2> ends{};
    Jet& jet = ends[i / 3];
    (i % 3 == 0 ? jet.value : i % 3 == 1 ? jet.first : jet.second) = 1.0;
    basis[i] = HermiteQuintic(ends[0], ends[1], length);
  }
  return basis;
}

// Derivatives at the end of a step by its parameter.
void EndDerivatives(const Step& step, Eigen::VectorXd* first, Eigen::VectorXd* second) {
  const Eigen::Index n = step.normal.size();
  const double c = step.normal.dot(step.end.first.head(n));
  const double bend = step.normal.dot(step.end.second.head(n));
  *first = step.end.first / c;
  *second = (step.end.second - *first * bend) / (c * c);
}

// Of the interpolation less its start, with these values of the basis polynomials, of which the first ones of start and
// end add up to 1. first, second: EndDerivatives().
Eigen::VectorXd Combination(const Step& step, const std::array<double, 6>& basis, const Eigen::VectorXd& first,
                            const Eigen::VectorXd& second) {
  return basis[1] * step.start.first + basis[2] * step.start.second + basis[3] * (step.end.x - step.start.x) +
         basis[4] * first + basis[5] * second;
}

}  // namespace

Step MakeStep(const CurvePoint& start, const CurvePoint& end, Eigen::Index num_motion) {
  Step step{start, end, start.first.head(num_motion), 0.0};
  step.length = step.normal.dot((end.x - start.x).head(num_motion));
  return step;
}

Eigen::VectorXd Step::Point(double t) const {
  Eigen::VectorXd first, second;
  EndDerivatives(*this, &first, &second);
  const std::array<Quintic, 6> basis = HermiteBasis(length);
  std::array<double, 6> b{};
  for (std::size_t i = 0; i < b.size(); ++i) b[i] = Evaluate(basis[i], t);
  return Combination(*this, b, first, second) + start.x;
}

CurvePoint Step::At(double t) const {
  Eigen::VectorXd first, second;
  EndDerivatives(*this, &first, &second);
  const std::array<Quintic, 6> basis = HermiteBasis(length);
  // Derivative of the given order by t.
  const auto combine = [&](int order) {
    std::array<double, 6> b{};
    for (std::size_t i = 0; i < 6; ++i) {
      Quintic polynomial = basis[i];
      for (int k = 0; k < order; ++k) polynomial = Derivative(polynomial);
      b[i] = Evaluate(polynomial, t);
    }
    return Combination(*this, b, first, second);
  };
  CurvePoint point = start;
  point.x = Point(t);
  point.is_limit = point.is_crossing = false;
  point.first = combine(1);
  point.second = combine(2);
  // From derivatives by t to derivatives by arc length.
  const Eigen::Index n = normal.size();
  const double speed = point.first.head(n).norm();
  point.first /= speed;
  point.second -= point.first.head(n).dot(point.second.head(n)) * point.first;
  point.second /= speed * speed;
  return point;
}

QuinticNodes::QuinticNodes(const Step& step) : length_(step.length) {
  points_.front() = step.start.x;
  points_.back() = step.end.x;
  for (std::size_t i = 1; i + 1 < points_.size(); ++i) points_[i] = step.Point(QuinticNode(i, length_));
}

double Step::ArcLength() const {
  const Eigen::Index n = normal.size();
  Eigen::VectorXd first, second;
  EndDerivatives(*this, &first, &second);
  const Eigen::VectorXd change = (end.x - start.x).head(n);
  const std::array<Quintic, 6> basis = HermiteBasis(length);
  double sum = 0.0;
  for (std::size_t i = 0; i < kGauss4.points.size(); ++i) {
    std::array<double, 6> b{};
    for (std::size_t k = 0; k < 6; ++k) b[k] = Evaluate(Derivative(basis[k]), kGauss4.points[i] * length);
    sum += kGauss4.weights[i] * (b[1] * start.first.head(n) + b[2] * start.second.head(n) + b[3] * change +
                                 b[4] * first.head(n) + b[5] * second.head(n))
                                    .norm();
  }
  return sum * length;
}

}  // namespace contact_path
