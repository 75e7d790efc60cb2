// Vectors of the plane in extended precision: the check is more exact than the solvers.
#ifndef CONTACT_PATH_SRC_CHECK_PLANE_H_
#define CONTACT_PATH_SRC_CHECK_PLANE_H_

#include <cmath>
#include <cstddef>
#include <vector>

namespace contact_path::check {

using Real = long double;

constexpr Real kPi = 3.14159265358979323846264338327950288L;

// Number: Real, or one with derivatives.
template <typename Number>
struct VectorOf {
  Number x{}, y{};

  VectorOf& operator+=(const VectorOf& other) {
    x += other.x;
    y += other.y;
    return *this;
  }
};
using Vector = VectorOf<Real>;

template <typename Number>
VectorOf<Number> operator+(const VectorOf<Number>& a, const VectorOf<Number>& b) {
  return {a.x + b.x, a.y + b.y};
}
template <typename Number>
VectorOf<Number> operator-(const VectorOf<Number>& a, const VectorOf<Number>& b) {
  return {a.x - b.x, a.y - b.y};
}
template <typename Number>
VectorOf<Number> operator*(const Number& factor, const VectorOf<Number>& v) {
  return {factor * v.x, factor * v.y};
}
template <typename Number>
Number Dot(const VectorOf<Number>& a, const VectorOf<Number>& b) {
  return a.x * b.x + a.y * b.y;
}
template <typename Number>
Number Cross(const VectorOf<Number>& a, const VectorOf<Number>& b) {
  return a.x * b.y - a.y * b.x;
}
// The left of a direction, and its right.
inline Vector Left(const Vector& v) { return {-v.y, v.x}; }
inline Vector Right(const Vector& v) { return {v.y, -v.x}; }
// From a direction to another [rad].
inline Real AngleBetween(const Vector& a, const Vector& b) { return std::atan2(Cross(a, b), Dot(a, b)); }
// Of long double squares, which neither overflow nor vanish for finite doubles.
inline Real Length(const Vector& v) { return std::sqrt(v.x * v.x + v.y * v.y); }

inline Vector Turned(const Vector& v, Real angle) {
  const Real c = std::cos(angle), s = std::sin(angle);
  return {c * v.x - s * v.y, s * v.x + c * v.y};
}

// Length of a part of a curve by Gauss's rule of three points. half: of the range of the parameter about its middle.
// derivative: of the place by the parameter.
template <typename Derivative>
Real GaussLength(Real middle, Real half, Derivative derivative) {
  const Real offset = half * std::sqrt(0.6L);
  const auto speed = [&](Real at) { return Length(derivative(at)); };
  return half * (5.0L * speed(middle - offset) + 8.0L * speed(middle) + 5.0L * speed(middle + offset)) / 9.0L;
}

// positions, forces: x0, y0, x1, ...
inline Vector NodePosition(const std::vector<double>& positions, std::size_t node) {
  return {positions[2 * node], positions[2 * node + 1]};
}
inline void AddTo(std::vector<Real>* forces, std::size_t node, const Vector& force) {
  (*forces)[2 * node] += force.x;
  (*forces)[2 * node + 1] += force.y;
}

}  // namespace contact_path::check

#endif  // CONTACT_PATH_SRC_CHECK_PLANE_H_
