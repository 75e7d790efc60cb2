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

// The derivative of this order by the parameter, of the interpolation less its start.
Eigen::VectorXd DerivativeAt(const Step& step, double t, int order) {
  const Eigen::Index n = step.normal.size();
  // At the end, by the parameter.
  const double c = step.normal.dot(step.end.first.head(n)), bend = step.normal.dot(step.end.second.head(n));
  const Eigen::VectorXd first = step.end.first / c, second = (step.end.second - first * bend) / (c * c);
  std::array<Quintic, 6> basis = HermiteBasis(step.length);
  std::array<double, 6> b{};
  for (std::size_t i = 0; i < b.size(); ++i) {
    for (int k = 0; k < order; ++k) basis[i] = Derivative(basis[i]);
    b[i] = Evaluate(basis[i], t);
  }
  // The first polynomials of start and end add up to 1.
  return b[1] * step.start.first + b[2] * step.start.second + b[3] * (step.end.x - step.start.x) + b[4] * first +
         b[5] * second;
}

}  // namespace

Step MakeStep(const CurvePoint& start, const CurvePoint& end, Eigen::Index num_motion) {
  Step step{start, end, start.first.head(num_motion), 0.0};
  step.length = step.normal.dot((end.x - start.x).head(num_motion));
  return step;
}

Eigen::VectorXd Step::Point(double t) const { return DerivativeAt(*this, t, 0) + start.x; }

CurvePoint Step::At(double t) const {
  CurvePoint point = start;
  point.x = Point(t);
  point.is_limit = point.is_crossing = false;
  point.first = DerivativeAt(*this, t, 1);
  point.second = DerivativeAt(*this, t, 2);
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
  double sum = 0.0;
  for (std::size_t i = 0; i < kGauss4.points.size(); ++i)
    sum += kGauss4.weights[i] * DerivativeAt(*this, kGauss4.points[i] * length, 1).head(normal.size()).norm();
  return sum * length;
}

}  // namespace contact_path
