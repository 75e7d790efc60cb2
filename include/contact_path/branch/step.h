// A step on a smooth arc: both ends with derivatives, and the curve between them.
#ifndef CONTACT_PATH_BRANCH_STEP_H_
#define CONTACT_PATH_BRANCH_STEP_H_

#include <Eigen/Core>
#include <array>

#include "contact_path/branch/polynomial.h"
#include "contact_path/equations/jet.h"
#include "contact_path/equations/measured.h"
#include "contact_path/tolerances.h"

namespace contact_path {

// A point of the curve with its derivatives by arc length |(du, ds)|. All vectors: unknowns of the equations.
struct CurvePoint {
  Eigen::VectorXd x;
  Eigen::VectorXd first;     // |(u, s) part| = 1
  Eigen::VectorXd second;    // orthogonal to first in (u, s)
  Eigen::Index nullity = 0;  // null directions of the equations besides the tangent
  int determinant_sign = 0;  // of the equations with the tangent as last row; 0 = singular
  int side = 0;              // determinant_sign; where it is 0, but where a curve crosses, `side` of the step's start
  double load_error = 0.0;   // of first of the load factor, where that is small: what rounding leaves of it
  // Sign of that rate; where it cannot be told from zero, the one that was told last on the arc, and at a limit point
  // the one beyond. 0: not told yet.
  int load_sense = 0;
  bool is_limit = false;     // located where the rate of the load factor is zero
  bool is_crossing = false;  // located where another curve crosses

  // The equations are singular here and not along the arc, whatever rounding says.
  void BeSingular() { determinant_sign = side = 0; }
};

// The unknowns a little farther along the curve.
inline Eigen::VectorXd Ahead(const CurvePoint& at) { return at.x + tolerances::kNextToStart * at.first; }

// Turns the point onto another curve through it.
inline void TakeCurve(const Eigen::VectorXd& first, const Eigen::VectorXd& second, Eigen::Index load,
                      CurvePoint* point) {
  point->first = first;
  point->second = second;
  point->load_sense = Measured{first[load], point->load_error}.Sign();
  point->is_limit = point->is_crossing = false;
}

// A step on an arc: both ends with derivatives, parameter t in [0, length] = the projection of (u, s) - start on the
// tangent at the start. Between the ends, quintic Hermite interpolation: error of order length^6.
struct Step {
  CurvePoint start;
  CurvePoint end;
  Eigen::VectorXd normal;  // (u, s) part of start.first
  double length = 0.0;

  // Of a function of x, from along(point): its value and its derivatives by arc length at a point of the curve.
  template <typename Along>
  Quintic Interpolate(Along along) const {
    const double c = normal.dot(end.first.head(normal.size()));
    const double bend = normal.dot(end.second.head(normal.size()));
    Jet at_end = along(end);
    at_end.first /= c;
    at_end.second = (at_end.second - at_end.first * bend) / (c * c);
    return HermiteQuintic(along(start), at_end, length);
  }
  // Of a linear function of x.
  template <typename Function>
  Quintic InterpolateLinear(Function function) const {
    return Interpolate([&function](const CurvePoint& point) {
      return Jet{function(point.x), function(point.first), function(point.second)};
    });
  }
  // All unknowns at t, and the whole point with derivatives by arc length; the rest as at the start.
  Eigen::VectorXd Point(double t) const;
  CurvePoint At(double t) const;
  // Length of the curve in (u, s), by Gauss quadrature of the interpolation.
  double ArcLength() const;
};

// Six points on the interpolation of a step, to interpolate any function of the unknowns by a quintic: a linear one
// exactly.
class QuinticNodes {
 public:
  explicit QuinticNodes(const Step& step);

  // value(x): the function.
  template <typename Value>
  Quintic Interpolate(Value value) const {
    std::array<double, 6> values{};
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = value(points_[i]);
    return QuinticThrough(values, length_);
  }

 private:
  double length_;
  std::array<Eigen::VectorXd, 6> points_;  // at QuinticNode(i, length)
};

Step MakeStep(const CurvePoint& start, const CurvePoint& end, Eigen::Index num_motion);

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_STEP_H_
