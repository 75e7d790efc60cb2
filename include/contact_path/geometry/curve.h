// Curves that are put together from lines, arcs of circles and cubics.
#ifndef CONTACT_PATH_GEOMETRY_CURVE_H_
#define CONTACT_PATH_GEOMETRY_CURVE_H_

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "contact_path/geometry/capsule_tree.h"
#include "contact_path/geometry/surface.h"

namespace contact_path {

// A smooth curve of finite length, prolonged beyond both ends.
class CurvePiece {
 public:
  virtual ~CurvePiece() = default;

  // xi at both ends. Where xi is 0, it is the most exact.
  virtual XiRange Range() const = 0;
  virtual Projection Project(const Eigen::Vector2d& x) const = 0;
  virtual Eigen::Vector2d PointAt(double xi) const = 0;

  double Length() const { return Range().end - Range().begin; }
};

// Straight. direction: of length 1.
class LinePiece : public CurvePiece {
 public:
  LinePiece(const Eigen::Vector2d& begin, const Eigen::Vector2d& direction, double length)
      : begin_(begin), direction_(direction), length_(length) {}

  XiRange Range() const override { return {0.0, length_}; }
  Projection Project(const Eigen::Vector2d& x) const override;
  Eigen::Vector2d PointAt(double xi) const override { return begin_ + xi * direction_; }

 private:
  Eigen::Vector2d begin_, direction_;
  double length_;
};

// Arc of a circle of up to half a turn. The gap is exact to rounding of itself, however large the circle, and so is xi,
// which is 0 in the middle.
class ArcPiece : public CurvePiece {
 public:
  enum class Side {
    kOutside,  // admissible outside of the circle: the arc turns to the right
    kInside,   // admissible inside: the arc turns to the left
  };
  // middle: direction from the centre to the middle of the arc, of length 1. turn: of the arc [rad], > 0 and <= pi.
  ArcPiece(const Eigen::Vector2d& centre, double radius, const Eigen::Vector2d& middle, double turn, Side side)
      : centre_(centre), radius_(radius), middle_(middle), turn_(turn), sign_(side == Side::kInside ? 1.0 : -1.0) {}

  XiRange Range() const override { return {-0.5 * radius_ * turn_, 0.5 * radius_ * turn_}; }
  Projection Project(const Eigen::Vector2d& x) const override;
  Eigen::Vector2d PointAt(double xi) const override;

 private:
  Eigen::Vector2d centre_;
  double radius_;
  Eigen::Vector2d middle_;
  double turn_;
  double sign_;  // of the curvature
};

// A cubic p(tau), tau from 0 to 1, that nowhere stands still, or the curve at a distance on its left. Prolonged, it is
// the same cubic: near to its ends alone it is of use. Arc length is the integral of |dp/dtau| by Gauss quadrature, on
// so many parts that it is exact to rounding, less the distance times the turn to the left.
class CubicPiece : public CurvePiece {
 public:
  // p(tau) = begin + tau (first + tau (second + tau third)). distance: LargestCurvature() times it is less than 1.
  CubicPiece(const Eigen::Vector2d& begin, const Eigen::Vector2d& first, const Eigen::Vector2d& second,
             const Eigen::Vector2d& third, double distance = 0.0);

  XiRange Range() const override { return {0.0, lengths_.back()}; }
  Projection Project(const Eigen::Vector2d& x) const override;
  Eigen::Vector2d PointAt(double xi) const override;

  // Of the cubic itself, in a hollow, from tau 0 to 1; 0: there is none.
  double LargestCurvature() const;

 private:
  struct Derivatives {
    Eigen::Vector2d first, second;
  };

  Eigen::Vector2d Offset(double tau) const { return tau * (first_ + tau * (second_ + tau * third_)); }
  Derivatives At(double tau) const;
  double CurvatureAt(double tau) const;           // of the cubic
  double TurnOf(double from, double to) const;    // to the left, of less than half a round
  double Integral(double from, double to) const;  // of the speed
  void Divide(double from, double to, double integral, int depth);
  double ArcLength(double tau) const;
  double FootOf(const Eigen::Vector2d& from_begin) const;  // tau

  Eigen::Vector2d begin_, first_, second_, third_;
  double distance_;
  double scale_ = 0.0;                            // [length]
  std::vector<double> taus_{0.0}, lengths_{0.0};  // where parts meet, and the arc length there
};

// The patches are the pieces, each of which begins where the one before it ends, in the same direction. Where a curve
// is closed, the first piece begins where the last one ends.
class Curve : public Surface {
 public:
  // At least one piece. xi: of the begin of the first piece. seamless: the pieces are of one smooth curve.
  Curve(std::vector<std::unique_ptr<const CurvePiece>> pieces, bool closed, double xi = 0.0, bool seamless = false);

  bool Closed() const override { return closed_; }
  bool Seamless() const override { return seamless_; }
  int NumPatches() const override { return static_cast<int>(pieces_.size()); }
  XiRange RangeOf(int patch) const override;
  NearestFoot Nearest(const Eigen::Vector2d& x) const override;
  NearestFoot NearestFrom(const Eigen::Vector2d& x, int near) const override;
  Projection Project(const Eigen::Vector2d& x, int patch) const override;
  Eigen::Vector2d PointAt(double xi) const override;

  double Length() const { return begins_.back() - begins_.front(); }

 private:
  struct Place {
    std::size_t piece;
    double offset;  // xi of the curve where xi of the piece is 0
  };
  Place PlaceOf(int patch) const;

  std::vector<std::unique_ptr<const CurvePiece>> pieces_;
  CapsuleTree tree_;            // of the pieces
  std::vector<double> begins_;  // xi of the pieces, and of the end of the last one
  bool closed_, seamless_;
};

// A whole circle. Its admissible side is outside, or inside. Two patches, half a turn each; xi = 0 where the normal is
// (0, 1), in the middle of patch 0.
std::unique_ptr<const Curve> MakeCircle(const Eigen::Vector2d& centre, double radius, bool inside);

}  // namespace contact_path

#endif  // CONTACT_PATH_GEOMETRY_CURVE_H_
