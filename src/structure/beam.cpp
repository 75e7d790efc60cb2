#include "contact_path/structure/beam.h"

#include <cmath>

namespace contact_path {
namespace {

// d2W by the rotations (a, b) of the ends against the chord. Of a hinged end, the rotation without moment is
// eliminated.
Eigen::Matrix2d BendingStiffness(const BeamSegment::Stiffness& stiffness, double length, bool hinged_first,
                                 bool hinged_second) {
  const double p = stiffness.GA > 0.0 ? 12.0 * stiffness.EI / (stiffness.GA * length * length) : 0.0;
  const double unit = stiffness.EI / length, near = (4.0 + p) / (1.0 + p), far = (2.0 - p) / (1.0 + p);
  const double alone = 12.0 / (4.0 + p);  // near - far^2 / near
  Eigen::Matrix2d bending = Eigen::Matrix2d::Zero();
  if (!hinged_first && !hinged_second)
    bending << near, far, far, near;
  else if (!hinged_first)
    bending(0, 0) = alone;
  else if (!hinged_second)
    bending(1, 1) = alone;
  return unit * bending;
}

}  // namespace

// Where the chord is: length and direction, and their derivatives by the span.
struct BeamSegment::Chord {
  explicit Chord(const Eigen::Vector2d& span)
      : length(span.norm()), along(span / length), across(-along[1], along[0]) {}

  Eigen::Matrix2d Mixed() const {
    const Eigen::Matrix2d mixed = along * across.transpose();
    return mixed + mixed.transpose();
  }
  // d2 l, and d3 l along v.
  Eigen::Matrix2d LengthHessian() const { return across * across.transpose() / length; }
  Eigen::Matrix2d LengthThird(const Eigen::Vector2d& v) const {
    return -(across.dot(v) * Mixed() + along.dot(v) * across * across.transpose()) / (length * length);
  }
  // d2 beta, and d3 beta along v.
  Eigen::Matrix2d DirectionHessian() const { return -Mixed() / (length * length); }
  Eigen::Matrix2d DirectionThird(const Eigen::Vector2d& v) const {
    return 2.0 * (along.dot(v) * Mixed() - across.dot(v) * (across * across.transpose() - along * along.transpose())) /
           (length * length * length);
  }

  double length;
  Eigen::Vector2d along, across;  // unit vectors; across is 90 degrees to the left
};

struct BeamSegment::At {
  At(const BeamSegment& of, const Values& x) : At(of, of.CoordinatesOf(x)) {}
  At(const BeamSegment& of, const Coordinates& at) : chord(at.head<2>()) {
    const double first = of.hinged_first_ ? at[3] : at[2], second = of.hinged_second_ ? at[2] : at[3];
    const double mean = 0.5 * (first + second);
    const double turned =
        std::atan2(of.along_[0] * chord.along[1] - of.along_[1] * chord.along[0], of.along_.dot(chord.along)) - mean;
    const double beta = mean + turned - 2.0 * M_PI * std::round(turned / (2.0 * M_PI));
    rotations << (of.hinged_first_ ? 0.0 : first - beta), (of.hinged_second_ ? 0.0 : second - beta);
    forces << of.EA_ * (chord.length - of.length_) / of.length_, of.stiffnesses_.bottomRightCorner<2, 2>() * rotations;
    const Eigen::Vector2d turn = chord.across / chord.length;  // of beta
    gradients.col(0) << chord.along, 0.0, 0.0;
    gradients.col(1) << -turn, 1.0, 0.0;
    gradients.col(2) << -turn, 0.0, 1.0;
  }

  Chord chord;
  Eigen::Vector2d rotations;              // a and b; 0 at a hinge
  Eigen::Vector3d forces;                 // derivatives of W by l, a and b
  Eigen::Matrix<double, 4, 3> gradients;  // of l, a and b, one in each column
};

BeamSegment::BeamSegment(const Stiffness& stiffness, const Eigen::Vector2d& chord, bool hinged_first,
                         bool hinged_second)
    : EA_(stiffness.EA),
      length_(chord.norm()),
      stiffnesses_(Eigen::Matrix3d::Zero()),
      along_(Chord(chord).along),
      hinged_first_(hinged_first),
      hinged_second_(hinged_second) {
  stiffnesses_(0, 0) = EA_ / length_;
  stiffnesses_.bottomRightCorner<2, 2>() = BendingStiffness(stiffness, length_, hinged_first, hinged_second);
  for (const int node : {0, 1}) {
    for (int component = 0; component < kPositionComponents; ++component) {
      dofs_.push_back({node, Field::kPosition, component});
      shares_.push_back({component, node == 0 ? -1.0 : 1.0});
    }
    if (node == 0 ? hinged_first : hinged_second) continue;
    dofs_.push_back({node, Field::kRotation, 0});
    shares_.push_back({kPositionComponents + node, 1.0});
  }
}

BeamSegment::Coordinates BeamSegment::CoordinatesOf(const Values& x) const {
  Coordinates at = Coordinates::Zero();
  for (std::size_t i = 0; i < shares_.size(); ++i)
    at[shares_[i].coordinate] += shares_[i].sign * x[static_cast<Eigen::Index>(i)];
  return at;
}

double BeamSegment::Energy(const Values& x) const {
  const At at(*this, x);
  const double stretch = at.chord.length - length_;
  return 0.5 *
         (EA_ / length_ * stretch * stretch + at.rotations.dot(stiffnesses_.bottomRightCorner<2, 2>() * at.rotations));
}

void BeamSegment::Force(const Values& x, Eigen::Ref<Eigen::VectorXd> force) const {
  const At at(*this, x);
  const Coordinates of = at.gradients * at.forces;
  for (std::size_t i = 0; i < shares_.size(); ++i)
    force[static_cast<Eigen::Index>(i)] = shares_[i].sign * of[shares_[i].coordinate];
}

void BeamSegment::Tangent(const Values& x, Eigen::Ref<Eigen::MatrixXd> tangent) const {
  const At at(*this, x);
  Spread(TangentOf(at, at.forces), tangent);
}

void BeamSegment::MixedTangent(const Values& x, const Values& from, const Values& to,
                               Eigen::Ref<Eigen::MatrixXd> tangent) const {
  const At at(*this, x);
  const Coordinates before = CoordinatesOf(from);
  const Chord last(before.head<2>());
  const Eigen::Vector2d change = (CoordinatesOf(to) - before).head<2>();
  Eigen::Vector3d forces = at.forces;
  forces[0] = EA_ * (last.length - length_ + last.along.dot(change)) / length_;
  Spread(TangentOf(at, forces), tangent);
}

BeamSegment::Square BeamSegment::TangentOf(const At& at, const Eigen::Vector3d& forces) const {
  const Square product = at.gradients * stiffnesses_ * at.gradients.transpose();
  Square square = 0.5 * (product + product.transpose());  // symmetric to the last digit
  square.topLeftCorner<2, 2>() +=
      forces[0] * at.chord.LengthHessian() - (forces[1] + forces[2]) * at.chord.DirectionHessian();
  return square;
}

void BeamSegment::TangentDerivative(const Values& x, const Values& v, Eigen::Ref<Eigen::MatrixXd> derivative) const {
  const At at(*this, x);
  const Coordinates along = CoordinatesOf(v);
  const Eigen::Vector2d span = along.head<2>();
  const Eigen::Vector3d rates = stiffnesses_ * (at.gradients.transpose() * along);
  const Eigen::Matrix2d of_length = at.chord.LengthHessian(), of_direction = at.chord.DirectionHessian();
  // Change of the gradients along v.
  Eigen::Matrix<double, 4, 3> change = Eigen::Matrix<double, 4, 3>::Zero();
  change.col(0).head<2>() = of_length * span;
  change.col(1).head<2>() = change.col(2).head<2>() = -of_direction * span;
  const Square product = change * stiffnesses_ * at.gradients.transpose();
  Square square = product + product.transpose();
  square.topLeftCorner<2, 2>() += rates[0] * of_length + at.forces[0] * at.chord.LengthThird(span) -
                                  (rates[1] + rates[2]) * of_direction -
                                  (at.forces[1] + at.forces[2]) * at.chord.DirectionThird(span);
  Spread(square, derivative);
}

void BeamSegment::Spread(const Square& of_coordinates, Eigen::Ref<Eigen::MatrixXd> out) const {
  for (std::size_t j = 0; j < shares_.size(); ++j)
    for (std::size_t i = 0; i < shares_.size(); ++i)
      out(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          shares_[i].sign * shares_[j].sign * of_coordinates(shares_[i].coordinate, shares_[j].coordinate);
}

}  // namespace contact_path
