#include "contact_path/structure/beam.h"

#include <array>
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

  // d2 l, and d3 l along v.
  Eigen::Matrix2d LengthHessian() const { return across * across.transpose() / length; }
  Eigen::Matrix2d LengthThird(const Eigen::Vector2d& v) const {
    const Eigen::Matrix2d mixed = along * across.transpose();
    return -(across.dot(v) * (mixed + mixed.transpose()) + along.dot(v) * across * across.transpose()) /
           (length * length);
  }
  // d2 beta, and d3 beta along v.
  Eigen::Matrix2d DirectionHessian() const {
    const Eigen::Matrix2d mixed = along * across.transpose();
    return -(mixed + mixed.transpose()) / (length * length);
  }
  Eigen::Matrix2d DirectionThird(const Eigen::Vector2d& v) const {
    const Eigen::Matrix2d mixed = along * across.transpose();
    return 2.0 *
           (along.dot(v) * (mixed + mixed.transpose()) -
            across.dot(v) * (across * across.transpose() - along * along.transpose())) /
           (length * length * length);
  }

  double length;
  Eigen::Vector2d along, across;  // unit vectors; across is 90 degrees to the left
};

BeamSegment::BeamSegment(const Stiffness& stiffness, const Eigen::Vector2d& chord, bool hinged_first,
                         bool hinged_second)
    : EA_(stiffness.EA),
      length_(chord.norm()),
      bending_(BendingStiffness(stiffness, length_, hinged_first, hinged_second)),
      along_(Chord(chord).along),
      hinged_first_(hinged_first),
      hinged_second_(hinged_second) {
  for (const int node : {0, 1}) {
    for (int component = 0; component < kPositionComponents; ++component)
      dofs_.push_back({node, Field::kPosition, component});
    if (!(node == 0 ? hinged_first : hinged_second)) dofs_.push_back({node, Field::kRotation, 0});
  }
}

BeamSegment::Coordinates BeamSegment::CoordinatesOf(const Eigen::Ref<const Eigen::VectorXd>& x) const {
  const Eigen::Index second = hinged_first_ ? 2 : 3;
  Coordinates at;
  at << x.segment<2>(second) - x.head<2>(), hinged_first_ ? 0.0 : x[2], hinged_second_ ? 0.0 : x[second + 2];
  return at;
}

// a and b; 0 at a hinge.
Eigen::Vector2d BeamSegment::EndRotations(const Chord& chord, const Coordinates& at) const {
  const double first = hinged_first_ ? at[3] : at[2], second = hinged_second_ ? at[2] : at[3];
  const double mean = 0.5 * (first + second);
  const double turned =
      std::atan2(along_[0] * chord.along[1] - along_[1] * chord.along[0], along_.dot(chord.along)) - mean;
  const double beta = mean + turned - 2.0 * M_PI * std::round(turned / (2.0 * M_PI));
  return {hinged_first_ ? 0.0 : first - beta, hinged_second_ ? 0.0 : second - beta};
}

Eigen::Matrix<double, 4, 3> BeamSegment::Gradients(const Chord& chord) const {
  const Eigen::Vector2d turn = chord.across / chord.length;  // of beta
  Eigen::Matrix<double, 4, 3> gradients = Eigen::Matrix<double, 4, 3>::Zero();
  gradients.col(0).head<2>() = chord.along;
  gradients.col(1) << -turn, 1.0, 0.0;
  gradients.col(2) << -turn, 0.0, 1.0;
  return gradients;
}

Eigen::Vector3d BeamSegment::Forces(const Chord& chord, const Coordinates& at) const {
  Eigen::Vector3d forces;
  forces << EA_ * (chord.length - length_) / length_, bending_ * EndRotations(chord, at);
  return forces;
}

Eigen::Matrix3d BeamSegment::Stiffnesses() const {
  Eigen::Matrix3d stiffnesses = Eigen::Matrix3d::Zero();
  stiffnesses(0, 0) = EA_ / length_;
  stiffnesses.bottomRightCorner<2, 2>() = bending_;
  return stiffnesses;
}

double BeamSegment::Energy(const Eigen::Ref<const Eigen::VectorXd>& x) const {
  const Coordinates at = CoordinatesOf(x);
  const Chord chord(at.head<2>());
  const Eigen::Vector2d rotations = EndRotations(chord, at);
  const double stretch = chord.length - length_;
  return 0.5 * (EA_ / length_ * stretch * stretch + rotations.dot(bending_ * rotations));
}

void BeamSegment::Force(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> force) const {
  const Coordinates at = CoordinatesOf(x);
  const Chord chord(at.head<2>());
  const Coordinates of = Gradients(chord) * Forces(chord, at);
  const Eigen::Index second = hinged_first_ ? 2 : 3;
  force.head<2>() = -of.head<2>();
  force.segment<2>(second) = of.head<2>();
  if (!hinged_first_) force[2] = of[2];
  if (!hinged_second_) force[second + 2] = of[3];
}

void BeamSegment::Tangent(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::MatrixXd> tangent) const {
  const Coordinates at = CoordinatesOf(x);
  const Chord chord(at.head<2>());
  Spread(TangentOf(chord, Forces(chord, at)), tangent);
}

void BeamSegment::MixedTangent(const Eigen::Ref<const Eigen::VectorXd>& x,
                               const Eigen::Ref<const Eigen::VectorXd>& from,
                               const Eigen::Ref<const Eigen::VectorXd>& to, Eigen::Ref<Eigen::MatrixXd> tangent) const {
  const Coordinates at = CoordinatesOf(x), before = CoordinatesOf(from);
  const Chord chord(at.head<2>()), last(before.head<2>());
  const Eigen::Vector2d change = (CoordinatesOf(to) - before).head<2>();
  Eigen::Vector3d forces = Forces(chord, at);
  forces[0] = EA_ * (last.length - length_ + last.along.dot(change)) / length_;
  Spread(TangentOf(chord, forces), tangent);
}

BeamSegment::Square BeamSegment::TangentOf(const Chord& chord, const Eigen::Vector3d& forces) const {
  const Eigen::Matrix<double, 4, 3> gradients = Gradients(chord);
  const Square product = gradients * Stiffnesses() * gradients.transpose();
  Square square = 0.5 * (product + product.transpose());  // symmetric to the last digit
  square.topLeftCorner<2, 2>() +=
      forces[0] * chord.LengthHessian() - (forces[1] + forces[2]) * chord.DirectionHessian();
  return square;
}

void BeamSegment::TangentDerivative(const Eigen::Ref<const Eigen::VectorXd>& x,
                                    const Eigen::Ref<const Eigen::VectorXd>& v,
                                    Eigen::Ref<Eigen::MatrixXd> derivative) const {
  const Coordinates at = CoordinatesOf(x), along = CoordinatesOf(v);
  const Eigen::Vector2d span = along.head<2>();
  const Chord chord(at.head<2>());
  const Eigen::Matrix<double, 4, 3> gradients = Gradients(chord);
  const Eigen::Vector3d forces = Forces(chord, at);
  const Eigen::Vector3d rates = Stiffnesses() * (gradients.transpose() * along);
  const Eigen::Matrix2d of_length = chord.LengthHessian(), of_direction = chord.DirectionHessian();
  // Change of the gradients along v.
  Eigen::Matrix<double, 4, 3> change = Eigen::Matrix<double, 4, 3>::Zero();
  change.col(0).head<2>() = of_length * span;
  change.col(1).head<2>() = change.col(2).head<2>() = -of_direction * span;
  const Square product = change * Stiffnesses() * gradients.transpose();
  Square square = product + product.transpose();
  square.topLeftCorner<2, 2>() += rates[0] * of_length + forces[0] * chord.LengthThird(span) -
                                  (rates[1] + rates[2]) * of_direction -
                                  (forces[1] + forces[2]) * chord.DirectionThird(span);
  Spread(square, derivative);
}

void BeamSegment::Spread(const Square& of_coordinates, Eigen::Ref<Eigen::MatrixXd> out) const {
  // Of each local dof: its coordinate, and the sign with which it enters.
  const std::size_t size = dofs_.size();
  std::array<Eigen::Index, 6> coordinate{};
  std::array<double, 6> sign{};
  for (std::size_t i = 0; i < size; ++i) {
    const bool rotation = dofs_[i].field == Field::kRotation;
    coordinate[i] = rotation ? 2 + dofs_[i].node : dofs_[i].component;
    sign[i] = rotation || dofs_[i].node == 1 ? 1.0 : -1.0;
  }
  for (std::size_t j = 0; j < size; ++j)
    for (std::size_t i = 0; i < size; ++i)
      out(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          sign[i] * sign[j] * of_coordinates(coordinate[i], coordinate[j]);
}

}  // namespace contact_path
