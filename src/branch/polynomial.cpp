#include "contact_path/branch/polynomial.h"

#include <algorithm>
#include <cmath>

namespace contact_path {
namespace {

// Root of `polynomial` between a and b, where it has opposite signs: bisection and secant in turn, to rounding.
double Bracketed(const Quintic& polynomial, double a, double b) {
  double fa = Evaluate(polynomial, a), fb = Evaluate(polynomial, b);
  for (int i = 0; i < 200 && fb != 0.0; ++i) {
    const double secant = b - fb * (b - a) / (fb - fa);
    const double middle = 0.5 * (a + b);
    const double t = i % 2 == 0 && secant > std::min(a, b) && secant < std::max(a, b) ? secant : middle;
    if (middle == a || middle == b) break;
    const double ft = Evaluate(polynomial, t);
    if ((ft < 0.0) == (fa < 0.0)) {
      a = t;
      fa = ft;
    } else {
      b = t;
      fb = ft;
    }
  }
  return b;
}

// Roots in (0, length) of a polynomial of the given degree, between the roots of its derivative.
int RootsOfDegree(const Quintic& polynomial, int degree, double length, std::array<double, 5>* roots) {
  int count = 0;
  if (degree == 0) return 0;
  std::array<double, 5> turning{};
  const int turns = RootsOfDegree(Derivative(polynomial), degree - 1, length, &turning);
  double a = 0.0;
  for (int i = 0; i <= turns; ++i) {
    const double b = i < turns ? turning[static_cast<std::size_t>(i)] : length;
    const double fa = Evaluate(polynomial, a), fb = Evaluate(polynomial, b);
    if ((fa < 0.0 && fb >= 0.0) || (fa > 0.0 && fb <= 0.0))
      (*roots)[static_cast<std::size_t>(count++)] = Bracketed(polynomial, a, b);
    a = b;
  }
  return count;
}

}  // namespace

Quintic HermiteQuintic(const Jet& start, const Jet& end, double length) {
  const double h = length;
  // With p = start.value + start.first t + start.second t^2 / 2 + t^3 q(t), q a quadratic fitted at the end.
  const double value = end.value - (start.value + h * start.first + 0.5 * h * h * start.second);
  const double first = (end.first - (start.first + h * start.second)) * h;
  const double second = (end.second - start.second) * h * h;
  const double h3 = h * h * h;
  return {start.value,
          start.first,
          0.5 * start.second,
          (10.0 * value - 4.0 * first + 0.5 * second) / h3,
          (-15.0 * value + 7.0 * first - second) / (h3 * h),
          (6.0 * value - 3.0 * first + 0.5 * second) / (h3 * h * h)};
}

double QuinticNode(std::size_t i, double length) {
  return 0.5 * length * (1.0 - std::cos(std::acos(-1.0) * static_cast<double>(i) / 5.0));
}

Quintic QuinticThrough(const std::array<double, 6>& values, double length) {
  // By divided differences on [0, 1], then as a sum of powers.
  std::array<double, 6> at{}, difference = values;
  for (std::size_t i = 0; i < at.size(); ++i) at[i] = QuinticNode(i, 1.0);
  for (std::size_t order = 1; order < at.size(); ++order)
    for (std::size_t i = at.size() - 1; i >= order; --i)
      difference[i] = (difference[i] - difference[i - 1]) / (at[i] - at[i - order]);
  Quintic sum{};
  for (std::size_t i = at.size(); i-- > 0;) {
    for (std::size_t k = sum.size() - 1; k > 0; --k) sum[k] = sum[k - 1] - at[i] * sum[k];
    sum[0] = difference[i] - at[i] * sum[0];
  }
  double power = 1.0;
  for (double& coefficient : sum) {
    coefficient /= power;
    power *= length;
  }
  return sum;
}

double Evaluate(const Quintic& polynomial, double t) {
  double value = 0.0;
  for (std::size_t i = polynomial.size(); i-- > 0;) value = value * t + polynomial[i];
  return value;
}

Quintic Derivative(const Quintic& polynomial) {
  Quintic result{};
  for (std::size_t i = 1; i < polynomial.size(); ++i) result[i - 1] = static_cast<double>(i) * polynomial[i];
  return result;
}

std::array<double, 5> Roots(const Quintic& polynomial, double length, int* count) {
  std::array<double, 5> roots{};
  *count = RootsOfDegree(polynomial, 5, length, &roots);
  return roots;
}

std::optional<double> FirstNegative(const Quintic& polynomial, double length, double tolerance) {
  Quintic reduced = polynomial;
  double power = 1.0, largest = 0.0;
  for (const double coefficient : polynomial) {
    largest = std::max(largest, std::abs(coefficient) * power);
    power *= length;
  }
  if (largest <= tolerance) return std::nullopt;  // zero throughout
  // Divide by t as long as the start is zero: the sign for t > 0 is that of the quotient.
  double scale = 1.0;
  for (int order = 0; order < 3 && std::abs(reduced[0]) <= tolerance * scale; ++order) {
    for (std::size_t i = 1; i < reduced.size(); ++i) reduced[i - 1] = reduced[i];
    reduced[5] = 0.0;
    scale /= length;
  }
  int count = 0;
  const std::array<double, 5> roots = Roots(reduced, length, &count);
  if (reduced[0] >= 0.0) return count > 0 ? std::optional<double>(roots[0]) : std::nullopt;
  // Negative at once. A dip that rounding hides, as of a value that touches zero next to the start, does not count.
  double where = 0.0;
  if (Minimum(polynomial, count > 0 ? roots[0] : length, &where) < -tolerance) return 0.0;
  return count > 1 ? std::optional<double>(roots[1]) : std::nullopt;
}

double Minimum(const Quintic& polynomial, double length, double* where) {
  int count = 0;
  const std::array<double, 5> turning = Roots(Derivative(polynomial), length, &count);
  double smallest = Evaluate(polynomial, 0.0);
  *where = 0.0;
  const auto consider = [&](double t) {
    if (const double value = Evaluate(polynomial, t); value < smallest) {
      smallest = value;
      *where = t;
    }
  };
  for (int i = 0; i < count; ++i) consider(turning[static_cast<std::size_t>(i)]);
  consider(length);
  return smallest;
}

}  // namespace contact_path
