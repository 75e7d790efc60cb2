// Curved surfaces for tests, written apart from those of the core.
#ifndef CONTACT_PATH_TEST_SUPPORT_CURVED_SURFACES_H_
#define CONTACT_PATH_TEST_SUPPORT_CURVED_SURFACES_H_

#include <Eigen/Core>
#include <cmath>

#include "contact_path/geometry/surface.h"

namespace contact_path {

// The outside of a disc: xi from its top, clockwise.
class DiscOutside : public Surface {
 public:
  DiscOutside(const Eigen::Vector2d& centre, double radius) : centre_(centre), radius_(radius) {}

  Projection Project(const Eigen::Vector2d& x, int /*patch*/) const override {
    const double distance = (x - centre_).norm();
    Projection projection;
    projection.normal = (x - centre_) / distance;
    projection.gap = distance - radius_;
    projection.xi = radius_ * std::atan2(projection.normal.x(), projection.normal.y());
    projection.curvature = -1.0 / radius_;
    return projection;
  }
  Eigen::Vector2d PointAt(double xi) const override {
    return centre_ + radius_ * Eigen::Vector2d(std::sin(xi / radius_), std::cos(xi / radius_));
  }

 private:
  Eigen::Vector2d centre_;
  double radius_;
};

// A curve from the origin along +x with the curvature a + b xi + c xi^2. For points near to it, with |xi| < 3.
class Spiral : public Surface {
 public:
  Spiral(double a, double b, double c) : a_(a), b_(b), c_(c) {}

  Eigen::Vector2d PointAt(double xi) const override {
    Eigen::Vector2d point = Eigen::Vector2d::Zero();
    constexpr int kPieces = 40;
    const double h = xi / kPieces;
    for (int i = 0; i < kPieces; ++i)  // Gauss, three points on each piece
      for (const int k : {-1, 0, 1}) {
        const double at = h * (i + 0.5 + 0.5 * k * std::sqrt(0.6));
        point += h * (k == 0 ? 8.0 : 5.0) / 18.0 * TangentAt(at);
      }
    return point;
  }
  Projection Project(const Eigen::Vector2d& x, int /*patch*/) const override {
    double xi = x.x();
    for (int i = 0; i < 60; ++i) {
      const Eigen::Vector2d away = x - PointAt(xi), t = TangentAt(xi), n(-t.y(), t.x());
      const double move = away.dot(t) / (1.0 - CurvatureAt(xi) * away.dot(n));
      xi += move;
      if (std::abs(move) < 1e-15) break;
    }
    const Eigen::Vector2d t = TangentAt(xi);
    Projection projection;
    projection.normal = {-t.y(), t.x()};
    projection.gap = (x - PointAt(xi)).dot(projection.normal);
    projection.xi = xi;
    projection.curvature = CurvatureAt(xi);
    projection.curvature_first = b_ + 2.0 * c_ * xi;
    projection.curvature_second = 2.0 * c_;
    return projection;
  }

 private:
  double CurvatureAt(double xi) const { return a_ + xi * (b_ + xi * c_); }
  Eigen::Vector2d TangentAt(double xi) const {
    const double angle = xi * (a_ + xi * (b_ / 2.0 + xi * c_ / 3.0));
    return {std::cos(angle), std::sin(angle)};
  }

  double a_, b_, c_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SUPPORT_CURVED_SURFACES_H_
