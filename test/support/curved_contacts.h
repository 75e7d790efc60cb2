// Curved surfaces, and contacts with them, for the tests of everything that is derived from gap and xi.
#ifndef CONTACT_PATH_TEST_SUPPORT_CURVED_CONTACTS_H_
#define CONTACT_PATH_TEST_SUPPORT_CURVED_CONTACTS_H_

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <memory>

#include "contact_path/contact/contact_pair.h"
#include "contact_path/contact/rigid_pair.h"
#include "contact_path/scene/scene_index.h"
#include "contact_path/scene/surface.h"
#include "contact_path/structure/structure.h"
#include "support/mixed_scene.h"

namespace contact_path {

// The outside of a disc: xi from its top, clockwise.
class Disc : public Surface {
 public:
  Disc(const Eigen::Vector2d& centre, double radius) : centre_(centre), radius_(radius) {}

  bool Flat() const override { return false; }
  Projection Project(const Eigen::Vector2d& x) const override {
    const double distance = (x - centre_).norm();
    Projection projection;
    projection.normal = (x - centre_) / distance;
    projection.gap = distance - radius_;
    projection.xi = radius_ * std::atan2(projection.normal.x(), projection.normal.y());
    projection.curvature = -1.0 / radius_;
    return projection;
  }

 private:
  Eigen::Vector2d centre_;
  double radius_;
};

// A curve from the origin along +x with the curvature a + b xi + c xi^2. For points near to it, with |xi| < 3.
class Spiral : public Surface {
 public:
  Spiral(double a, double b, double c) : a_(a), b_(b), c_(c) {}

  bool Flat() const override { return false; }
  Eigen::Vector2d PointAt(double xi) const {
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
  Projection Project(const Eigen::Vector2d& x) const override {
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

// MovingScene() with contacts of its own, in this order:
//   b   on a disc below it, mu = 0.3, the disc moves        d   on a spiral, mu = 0.5
//   c   on a disc beside it, c slides along y only, mu = 0.4   e   on a flat floor, mu = 0.2, the floor moves
//   b   on a disc above it, frictionless
// All gaps are between 0 and 0.6 at the start.
inline ContactPairs CurvedContacts(const Structure& structure) {
  const Scene scene = MovingScene();
  const SceneIndex index(scene);
  ContactPairs contacts;
  const auto add = [&](const char* name, std::shared_ptr<const Surface> surface, const Eigen::Vector2d& velocity,
                       double friction) {
    const auto node = static_cast<int>(index.Node(name));
    const NodeMotion motion = {
        {structure.Dof(node, 0), structure.Dof(node, 1)}, structure.StartPosition(node), velocity};
    contacts.push_back(std::make_unique<RigidPair>(std::move(surface), motion, friction));
  };
  const Eigen::Vector2d at_rest = Eigen::Vector2d::Zero();
  add("b", std::make_shared<Disc>(Eigen::Vector2d(1.4, -0.9), 1.0), {0.3, -0.2}, 0.3);
  add("d", std::make_shared<Spiral>(0.3, -0.4, 0.5), at_rest, 0.5);
  add("c", std::make_shared<Disc>(Eigen::Vector2d(2.3, 0.7), 0.7), at_rest, 0.4);
  add("e", std::make_shared<HalfPlane>(Eigen::Vector2d(0.0, 0.7), Eigen::Vector2d(0.1, 1.0)), {0.2, 0.1}, 0.2);
  add("b", std::make_shared<Disc>(Eigen::Vector2d(0.8, 1.3), 0.6), at_rest, 0.0);
  return contacts;
}

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SUPPORT_CURVED_CONTACTS_H_
