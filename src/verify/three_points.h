// Integrals over an increment by the quadratics through three recorded states.
#ifndef CONTACT_PATH_SRC_VERIFY_THREE_POINTS_H_
#define CONTACT_PATH_SRC_VERIFY_THREE_POINTS_H_

#include <algorithm>
#include <array>
#include <cmath>

namespace contact_path {

// Of a quantity: at the begin of the increment, at its end, and at a third state of the same arc.
using ThreeValues = std::array<double, 3>;

// A sum of integrals.
struct Integral {
  double value = 0.0;
  double open = 0.0;   // what the quadratics add to the trapezoids, or what the trapezoids leave open
  double force = 0.0;  // sum of the sizes of the forces

  void Add(const Integral& other) {
    value += other.value;
    open += other.open;
    force += other.force;
  }

  // Of two rules for one integral: the value of the first, and the larger error of both.
  void Take(const Integral& other, bool first) {
    const double larger = first ? other.open : std::max(open, other.open);
    if (first) *this = other;
    open = larger;
  }
};

// With a third state at the parameter t, which is 0 at the begin and 1 at the end; t = 0: there is none, and quantities
// are linear. With t = 1/2 the rule is Simpson's.
class ThreePoints {
 public:
  explicit ThreePoints(double t) : t_(t) {}

  double t() const { return t_; }
  bool HasThird() const { return t_ != 0.0; }

  // Of f dx. A quantity is f0 + (f1 - f0) t + F t (1 - t); the bulge adds up the parts that F has, each by its size,
  // for they may cancel.
  Integral Of(const ThreeValues& f, const ThreeValues& x) const {
    const double df = f[1] - f[0], dx = x[1] - x[0], bend_f = Bend(f), bend_x = Bend(x);
    const double mean = 0.5 * (f[0] + f[1]);
    if (!HasThird()) return {mean * dx, 0.5 * std::abs(df * dx)};
    return {mean * dx + (bend_f * dx - bend_x * df) / 6.0,
            (std::abs(bend_f * dx) + std::abs(bend_x * df) + std::abs(bend_f * bend_x)) / 6.0};
  }

 private:
  double Bend(const ThreeValues& f) const {
    return HasThird() ? (f[2] - f[0] - t_ * (f[1] - f[0])) / (t_ * (1.0 - t_)) : 0.0;
  }

  double t_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_VERIFY_THREE_POINTS_H_
