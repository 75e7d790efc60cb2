// The length of a span of a tendon in numbers that carry derivatives (unsupported/Eigen/AutoDiff).
#ifndef CONTACT_PATH_SRC_STRUCTURE_SPAN_NUMBERS_H_
#define CONTACT_PATH_SRC_STRUCTURE_SPAN_NUMBERS_H_

#include <Eigen/Core>
#include <cmath>
#include <type_traits>
#include <unsupported/Eigen/AutoDiff>

#include "contact_path/geometry/rolled_span.h"

namespace contact_path {

template <typename Number>
Number AsNumber(double value) {
  if constexpr (std::is_same_v<Number, double>)
    return value;
  else
    return Number(AsNumber<typename Number::Scalar>(value));
}

// Of a span from node to node, dx and dy apart (geometry/rolled_span.h): x, y, along what is free of it; turned, beside
// a roller theta - theta_0; length, f without the arcs at the start.
template <typename Number>
struct SpanNumbers {
  SpanNumbers(const RolledSpan& rolled, const Number& dx, const Number& dy) : x(dx), y(dy) {
    using std::atan2;
    using std::sqrt;
    const Number square = dx * dx + dy * dy, delta = AsNumber<Number>(rolled.Delta());
    if (rolled.Delta() == 0.0) {
      length = sqrt(square);
    } else {
      length = sqrt(Number(square - delta * delta));
      x = Number(length * dx) + Number(delta * dy);
      y = Number(length * dy) - Number(delta * dx);
    }
    if (rolled.Delta() == 0.0 && rolled.Arcs() == 0.0) return;  // between eyes: its turn is of no use
    const Eigen::Vector2d& start = rolled.StartDirection();
    const Number start_x = AsNumber<Number>(start.x()), start_y = AsNumber<Number>(start.y());
    turned = atan2(Number(y * start_x - x * start_y), Number(x * start_x + y * start_y));
    if (rolled.Delta() != 0.0) length -= Number(delta * turned);
  }
  Number x, y, length, turned = AsNumber<Number>(0.0);
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_STRUCTURE_SPAN_NUMBERS_H_
