// Vectors of the plane in extended precision: the check is more exact than the solvers.
#ifndef CONTACT_PATH_SRC_CHECK_PLANE_H_
#define CONTACT_PATH_SRC_CHECK_PLANE_H_

#include <cmath>
#include <cstddef>
#include <vector>

namespace contact_path::check {

using Real = long double;

constexpr Real kPi = 3.14159265358979323846264338327950288L;

struct Vector {
  Real x = 0.0L;
  Real y = 0.0L;
};

inline Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y}; }
inline Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y}; }
inline Vector operator*(Real factor, const Vector& v) { return {factor * v.x, factor * v.y}; }
inline Real Dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y; }
inline Real Cross(const Vector& a, const Vector& b) { return a.x * b.y - a.y * b.x; }
// The left of a direction.
inline Vector Left(const Vector& v) { return {-v.y, v.x}; }
// Of long double squares, which neither overflow nor vanish for finite doubles.
inline Real Length(const Vector& v) { return std::sqrt(v.x * v.x + v.y * v.y); }

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
