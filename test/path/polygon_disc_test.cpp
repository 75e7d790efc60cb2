// A disc as a polygon of a thousand edges with fillets: paths are those of the circle, as far as both boundaries are
// the same.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "support/curved_obstacles.h"
#include "support/parts.h"
#include "support/traced_path.h"

namespace contact_path::polygon_disc_test {
namespace {

using Eigen::Vector2d;

constexpr int kEdges = 1000;
const double kHalfTurn = M_PI / kEdges;  // of an edge, seen from the centre
constexpr double kRadius = 1.0;
constexpr double kFriction = 0.3;
constexpr double kSound = 1e-9;       // residuals, of the characteristic force
constexpr double kRounding = 1e-9;    // of what is compared
constexpr double kQuadrature = 1e-6;  // of the dissipation

Vector2d At(double angle, double distance) { return {distance * std::sin(angle), distance * std::cos(angle)}; }

// The polygon around the origin has its corners on the circle, or the middles of its edges.
struct Polygon {
  const char* name;
  bool inscribed;
  double fillet;  // of the largest one, the circle within the polygon

  double Apothem() const { return inscribed ? kRadius * std::cos(kHalfTurn) : kRadius; }
  // The boundary is nowhere farther from the circle: on an edge it is nearest to the origin in the middle; it is
  // nowhere farther than at a corner, which the fillet cuts.
  double Aside() const { return kRadius * (1.0 / std::cos(kHalfTurn) - 1.0); }
  // Angle between the normal and the line to the origin: largest where the fillet begins.
  double Turn() const { return (1.0 - fillet) * std::tan(kHalfTurn); }

  // Walked clockwise: the admissible side is outside. An edge has its middle at this angle from the top.
  Obstacle Disc(double middle) const {
    const double corner = Apothem() / std::cos(kHalfTurn);
    std::vector<double> points;
    for (int i = 0; i < kEdges; ++i) {
      const Vector2d point = At(middle + (2 * i + 1) * kHalfTurn, corner);
      points.insert(points.end(), {point.x(), point.y()});
    }
    Obstacle disc = CurveThrough(ObstacleShape::kPolyline, points, true);
    disc.fillet = fillet * Apothem();
    return disc;
  }
};

std::vector<Polygon> Polygons() {
  return {{"corners on the circle, small fillets", true, 0.05},
          {"edges on the circle, small fillets", false, 0.05},
          {"edges on the circle, arcs that nearly meet", false, 0.99}};
}

Obstacle RoundDisc() { return Circle("curve", 0.0, 0.0, kRadius, 0.0); }

// A node on two springs and the disc, where it touches at this angle from the top.
struct Springs {
  Vector2d stiffness, rest;

  Vector2d Force(const Vector2d& x) const { return stiffness.cwiseProduct(x - rest); }
};
TraceRequest NodeAt(double angle, double distance, const Springs& springs, const Obstacle& disc) {
  Scene scene;
  const Vector2d place = At(angle, distance);
  scene.nodes = {{"p", place.x(), place.y(), false, false}};
  scene.superelements = {
      {{"p"}, {springs.stiffness.x(), 0.0, 0.0, springs.stiffness.y()}, {springs.rest.x(), springs.rest.y()}}};
  scene.obstacles = {disc};
  scene.obstacles[0].friction = kFriction;
  scene.contacts = {{"p", "curve"}};
  return RequestWithin(20000, scene);
}

TracedPath TraceSound(const TraceRequest& request) {
  TracedPath path = TraceTo(request);
  ExpectSoundIncrements(path, kSound);
  return path;
}

int NumEvents(const TracedPath& path) { return static_cast<int>(EventsOf(path).size()) - 1; }  // without the start

Vector2d Place(const Increment& increment) { return {increment.positions[0], increment.positions[1]}; }
double AngleOf(const Increment& increment) { return std::atan2(increment.positions[0], increment.positions[1]); }

// ----- pulled along the disc -----

const Springs kPegSprings = {{1.3, 0.8}, {0.2, -0.3}};
const Vector2d kPull(1.0, -0.2);
constexpr double kStartAngle = -0.2;

double Cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }
// The reaction of the contact that slides clockwise, over r_n, where the normal is at this angle from the top.
Vector2d Reaction(double angle) { return At(angle, 1.0) - kFriction * Vector2d(std::cos(angle), -std::sin(angle)); }

// force(x) = s pull + r_n reaction on the circle.
struct Sliding {
  explicit Sliding(double angle)
      : force(kPegSprings.Force(At(angle, kRadius))),
        reaction(Reaction(angle)),
        s(Cross(force, reaction) / Cross(kPull, reaction)),
        rn(Cross(kPull, force) / Cross(kPull, reaction)) {}

  Vector2d force, reaction;
  double s, rn;
};

// Where another boundary is at the same angle, with x aside by d and the normal turned by a: the difference of both
// equations is ds pull + drn reaction' = dforce - rn (reaction' - reaction), the right side of which is no longer than
// k d + rn |reaction| 2 sin(a / 2). By Cramer's rule this bounds ds and drn.
struct Bounds {
  Bounds(const Polygon& polygon, double angle) {
    const Sliding on_circle(angle);
    const double length = on_circle.reaction.norm(), turn = polygon.Turn();
    const double right =
        kPegSprings.stiffness.maxCoeff() * polygon.Aside() + on_circle.rn * length * 2.0 * std::sin(0.5 * turn);
    const double determinant =
        std::abs(Cross(kPull, on_circle.reaction)) - kPull.norm() * length * 2.0 * std::sin(0.5 * turn);
    s = right * length / determinant;
    rn = right * kPull.norm() / determinant;
  }
  double s, rn;
};

TraceRequest Pulled(double distance, const Obstacle& disc, Accuracy accuracy) {
  TraceRequest request = NodeAt(kStartAngle, distance, kPegSprings, disc);
  request.scene.loads = {{"p", kPull.x(), kPull.y(), false}};
  request.options.stop = {{"p.y", "<", -0.1}};
  request.options.accuracy = accuracy;
  return request;
}

// Of the circle, from the start to this angle: the integral of mu r_n over the way, by Simpson's rule.
double DissipationUpTo(double angle) {
  constexpr int kParts = 2000;
  double sum = 0.0;
  for (int i = 0; i <= kParts; ++i)
    sum += (i == 0 || i == kParts ? 1.0
            : i % 2 == 0          ? 2.0
                                  : 4.0) *
           Sliding(kStartAngle + (angle - kStartAngle) * i / kParts).rn;
  return kFriction * kRadius * sum * (angle - kStartAngle) / kParts / 3.0;
}

void ExpectThePathOnTheCircle(const TracedPath& path, const Polygon& polygon, double largest_load) {
  double largest = 0.0, angle = kStartAngle, most_rn = 0.0;
  double load_bound = 0.0, rn_bound = 0.0;  // the largest
  for (const Increment& increment : path.increments) {
    largest = std::max(largest, increment.load_factor);
    EXPECT_NEAR(Place(increment).norm(), kRadius, polygon.Aside() + kRounding);
    const ContactRecord& contact = increment.contacts[0];
    if (contact.state == ContactState::kStick) {
      EXPECT_NEAR(AngleOf(increment), kStartAngle, kRounding);
      continue;
    }
    ASSERT_EQ(contact.state, ContactState::kSlipPlus) << increment.index;
    EXPECT_GE(AngleOf(increment), angle - kRounding);
    angle = AngleOf(increment);
    const Sliding on_circle(angle);
    const Bounds bounds(polygon, angle);
    EXPECT_NEAR(increment.load_factor, on_circle.s, bounds.s + kRounding) << increment.index;
    EXPECT_NEAR(contact.rn, on_circle.rn, bounds.rn + kRounding) << increment.index;
    EXPECT_NEAR(contact.rt, -kFriction * contact.rn, kRounding);
    most_rn = std::max(most_rn, on_circle.rn);
    load_bound = std::max(load_bound, bounds.s);
    rn_bound = std::max(rn_bound, bounds.rn);
  }
  EXPECT_NEAR(largest, largest_load, load_bound + kRounding);
  // Of the way, over the angle: (distance from the origin) / cos(turn of the normal).
  const double longer = (kRadius + polygon.Aside()) / std::cos(polygon.Turn()) - kRadius;
  const double bound = kFriction * (angle - kStartAngle) * (rn_bound * (kRadius + longer) + most_rn * longer);
  EXPECT_NEAR(path.increments.back().dissipation, DissipationUpTo(angle), bound + kQuadrature);
  // Each edge and each fillet on the way begins with an event.
  EXPECT_GE(NumEvents(path), static_cast<int>((angle - kStartAngle) / kHalfTurn) - 1);
}

TEST(PolygonDisc, ANodePulledRoundItTakesThePathOnTheCircle) {
  for (const Accuracy accuracy : {Accuracy::kFast, Accuracy::kAccurate}) {
    const TracedPath circle = TraceSound(Pulled(kRadius, RoundDisc(), accuracy));
    const double largest = LargestLoadFactor(circle);
    for (const Polygon& polygon : Polygons()) {
      SCOPED_TRACE(polygon.name);
      const TracedPath path = TraceSound(Pulled(polygon.Apothem(), polygon.Disc(kStartAngle), accuracy));
      ExpectThePathOnTheCircle(path, polygon, largest);
    }
  }
}

// ----- a disc that turns by a whole round under the node -----

const Springs kDrumSprings = {{1.0, 1.0}, {0.0, 0.5}};

TraceRequest Turned(double distance, const Obstacle& disc, Accuracy accuracy) {
  TraceRequest request = NodeAt(0.0, distance, kDrumSprings, disc);
  request.scene.obstacle_motions = {{"curve", 0.0, 0.0, -1.0, 0.0, 0.0}};
  request.options.stop = {{"load_factor", ">", 2.0 * M_PI + 0.5}};
  request.options.accuracy = accuracy;
  return request;
}

// The node that the disc slides under is where the force of the springs is along n + mu t: where this is zero.
double Across(double angle) {
  const Vector2d normal = At(angle, 1.0), tangent(normal.y(), -normal.x());
  return kDrumSprings.Force(At(angle, kRadius)).dot(tangent - kFriction * normal);
}

// Where another boundary has the node aside by d at the same angle, with the normal turned by a, the force is no longer
// exactly along n + mu t of the circle: Across() is then up to |n + mu t| (d + |force| 2 sin(a / 2)).
TEST(PolygonDisc, OneThatTurnsHoldsANodeAsTheCircleDoes) {
  for (const Accuracy accuracy : {Accuracy::kFast, Accuracy::kAccurate}) {
    const TracedPath circle = TraceSound(Turned(kRadius, RoundDisc(), accuracy));
    const Increment& held = circle.increments.back();
    EXPECT_NEAR(Across(AngleOf(held)), 0.0, kRounding);
    for (const Polygon& polygon : Polygons()) {
      SCOPED_TRACE(polygon.name);
      const TracedPath path = TraceSound(Turned(polygon.Apothem(), polygon.Disc(0.0), accuracy));
      const double turn = 2.0 * std::sin(0.5 * polygon.Turn());
      const double force = kDrumSprings.Force(Place(held)).norm();
      int sliding = 0;
      for (const Increment& increment : path.increments) {
        EXPECT_NEAR(Place(increment).norm(), kRadius, polygon.Aside() + kRounding);
        const ContactRecord& contact = increment.contacts[0];
        if (contact.state == ContactState::kStick) {
          EXPECT_EQ(sliding, 0) << increment.index;
          EXPECT_NEAR(AngleOf(increment), increment.load_factor, kRounding);
          continue;
        }
        ++sliding;
        ASSERT_EQ(contact.state, ContactState::kSlipMinus) << increment.index;
        const Vector2d on_circle = At(AngleOf(increment), kRadius);
        const double here = kDrumSprings.Force(on_circle).norm();
        EXPECT_NEAR(Across(AngleOf(increment)), 0.0,
                    std::hypot(1.0, kFriction) * (polygon.Aside() + here * turn) + kRounding)
            << increment.index;
        const double moved = (Place(increment) - Place(held)).norm();
        const double turned = std::abs(AngleOf(increment) - AngleOf(held)) + polygon.Turn();
        EXPECT_NEAR(contact.rn, held.contacts[0].rn, moved + force * turned + kRounding) << increment.index;
        EXPECT_NEAR(contact.rt, kFriction * contact.rn, kRounding);
      }
      EXPECT_GE(NumEvents(path), 2 * kEdges);
    }
  }
}

}  // namespace
}  // namespace contact_path::polygon_disc_test
