// Gap, knot and slip of a node beside a patch of a spline, in numbers that carry their derivatives along.
#ifndef CONTACT_PATH_SRC_CONTACT_SPLINE_CONTACT_H_
#define CONTACT_PATH_SRC_CONTACT_SPLINE_CONTACT_H_

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <unsupported/Eigen/AutoDiff>

#include "contact_path/geometry/nodal_spline.h"

namespace contact_path::spline_contact {

// x and y of the node, then of the control nodes; and whatever there is of each of these.
using Place = Eigen::Matrix<double, 8, 1>;
template <typename T>
using Places = std::array<T, Place::SizeAtCompileTime>;

// Numbers that carry derivatives along: by all places, the same twice, and twice along one curve.
using ByPlaces = Eigen::AutoDiffScalar<Place>;
using TwiceByPlaces = Eigen::AutoDiffScalar<Eigen::Matrix<ByPlaces, Place::SizeAtCompileTime, 1>>;
using Along = Eigen::AutoDiffScalar<Eigen::Matrix<double, 1, 1>>;
using TwiceAlong = Eigen::AutoDiffScalar<Eigen::Matrix<Along, 1, 1>>;

template <typename T>
T Constant(double value) {
  return T(typename T::Scalar(value));
}

template <typename T>
struct Plane {
  T x, y;
};

template <typename T>
T Dot(const Plane<T>& a, const Plane<T>& b) {
  return T(a.x * b.x + a.y * b.y);
}

// Along a parabola from one foot: where the node is, and what follows.
template <typename T>
struct Foot {
  // tau: of the foot, or near it.
  Foot(const SplinePatch& patch, const Places<T>& z, const T& tau) {
    second = {Constant<T>(0.0), Constant<T>(0.0)};
    first = second;
    away = {z[0], z[1]};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      const T constant = Constant<T>(patch.weights(row, 0)), linear = Constant<T>(patch.weights(row, 1)),
              square = Constant<T>(patch.weights(row, 2)), twice = Constant<T>(2.0 * patch.weights(row, 2));
      const Plane<T> at = {z[2 * k + 2], z[2 * k + 3]};
      weights[k] = T(T(T(square * tau) + linear) * tau) + constant;
      slopes[k] = T(twice * tau) + linear;
      away = {T(away.x - weights[k] * at.x), T(away.y - weights[k] * at.y)};
      first = {T(first.x + slopes[k] * at.x), T(first.y + slopes[k] * at.y)};
      second = {T(second.x + twice * at.x), T(second.y + twice * at.y)};
    }
  }
  // Minus the derivative of away . first by tau.
  T Bend() const { return T(Dot(first, first) - Dot(away, second)); }

  std::array<T, 3> weights, slopes;  // N_k and N_k'
  Plane<T> away, first, second;      // p, y', y''
};

// Gap without the radius, knot from the begin of the patch, slip per knot, and gradients of the first two by the
// places, all of them to `order` derivatives.
template <typename T>
struct Values {
  Values(const SplinePatch& patch, const Places<T>& z, double foot, double radius, int order) {
    // Each step of Newton's method from the foot doubles the order to which derivatives are right.
    knot = Constant<T>(foot);
    for (int i = 0; i < order; ++i) {
      const Foot<T> at(patch, z, knot);
      knot = T(knot + T(Dot(at.away, at.first)) / at.Bend());
    }
    const Foot<T> at(patch, z, knot);
    using std::sqrt;
    const T square = Dot(at.first, at.first), speed = T(sqrt(square)), bend = at.Bend();
    const Plane<T> normal = {T(Constant<T>(0.0) - at.first.y) / speed, T(at.first.x / speed)};
    gap = Dot(at.away, normal);
    const T cross = T(at.first.x * at.second.y - at.first.y * at.second.x);
    slip = T(speed - T(Constant<T>(radius) * cross) / square);
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const T &n = axis == 0 ? normal.x : normal.y, &first = axis == 0 ? at.first.x : at.first.y,
              &away = axis == 0 ? at.away.x : at.away.y;
      gap_gradient[axis] = n;
      knot_gradient[axis] = T(first / bend);
      for (std::size_t k = 0; k < 3; ++k) {
        gap_gradient[2 * k + 2 + axis] = T(Constant<T>(0.0) - at.weights[k] * n);
        knot_gradient[2 * k + 2 + axis] = T(T(at.slopes[k] * away - at.weights[k] * first) / bend);
      }
    }
  }

  T gap, knot, slip;
  Places<T> gap_gradient, knot_gradient;
};

}  // namespace contact_path::spline_contact

#endif  // CONTACT_PATH_SRC_CONTACT_SPLINE_CONTACT_H_
