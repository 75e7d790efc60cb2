// Circles of bodies that roll and slide on polylines and splines, in closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "contact_path/geometry/curve.h"
#include "contact_path/scene/surface.h"
#include "support/curved_obstacles.h"
#include "support/parts.h"
#include "support/traced_path.h"
#include "support/transformations.h"

namespace contact_path::rolling_curves_test {
namespace {

using Eigen::Vector2d;

constexpr double kExact = 1e-7;  // contacts of bodies give way by 1e-8 of their forces, over the radius of the curve

Load OfBody(double fx, double fy, bool constant) { return LoadOnBody("disc", fx, fy, constant); }

Load Moment(double moment) { return LoadOnBody("disc", 0.0, 0.0, false, moment); }

Obstacle Polyline(const std::vector<double>& points, double fillet, double friction) {
  Obstacle floor = CurveThrough(ObstacleShape::kPolyline, points);
  floor.name = "floor";
  floor.fillet = fillet;
  floor.friction = friction;
  return floor;
}

// A disc with its rim, which touches the floor.
TraceRequest OnFloor(const Vector2d& centre, double radius, const Obstacle& floor, std::vector<Load> loads) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.name = "rolling_on_curve";
  scene.bodies = {{"disc", centre.x(), centre.y()}};
  scene.obstacles = {Circle("rim", centre.x(), centre.y(), radius, 0.0, "disc"), floor};
  scene.contacts = {Rolls("rim", "floor")};
  scene.loads = std::move(loads);
  return request;
}

// The only body comes last.
Vector2d Centre(const Increment& increment) {
  return {increment.positions[increment.positions.size() - 2], increment.positions.back()};
}

// The disc is drawn by a spring along a floor that is at rest, moves or is carried by a body on a spring of its own.
TraceRequest DrawnDisc(const Obstacle& floor, bool moves, bool carried) {
  TraceRequest request = OnFloor({0.2, 0.5}, 0.5, floor, {OfBody(0.1, -1.0, true), Moment(-0.5)});
  Scene& scene = request.scene;
  scene.nodes = {NodeOf("disc", "hub", 0.2, 0.5), NodeOf("slab", "block", 0.0, -1.0)};
  scene.bodies.push_back({"slab", 0.0, -0.5, false, true, true});
  scene.superelements = {{{"hub"}, {2.0, 0.0, 0.0, 0.0}}, {{"block"}, {3.0, 0.0, 0.0, 1.0}}};
  if (carried) scene.obstacles.back().body = "slab";
  if (moves) scene.obstacle_motions = {{"floor", 0.3, 0.05, 0.2, 0.1, -0.1}};
  request.options.max_increments = 40;
  return request;
}

// The disc bears its weight and hangs on a spring along x, of which the other end is moved to the right.
constexpr double kDrive = 20.0;
TraceRequest Driven(const Vector2d& centre, double radius, const Obstacle& floor) {
  TraceRequest request = OnFloor(centre, radius, floor, {OfBody(0.0, -1.0, true)});
  request.scene.nodes = {NodeOf("disc", "hub", centre.x(), centre.y()),
                         {"drives", centre.x() + 1.0, centre.y(), true, true}};
  std::vector<double> stiffness(16, 0.0);
  stiffness[0] = stiffness[10] = kDrive;
  stiffness[2] = stiffness[8] = -kDrive;
  request.scene.superelements = {{{"hub", "drives"}, stiffness}};
  request.scene.support_motions = {{"drives", 1.0, 0.0}};
  request.options.max_increments = 400;
  return request;
}

TEST(RollingOnCurves, AFlatPolylineIsAHalfPlane) {
  for (const auto& [moves, carried] : {std::pair(false, false), std::pair(true, false), std::pair(false, true)})
    for (const double friction : {0.2, 0.6}) {
      SCOPED_TRACE(testing::Message() << "moves " << moves << ", carried " << carried << ", mu " << friction);
      const Obstacle plane{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, friction};
      const TracedPath expected = TraceIncrements(DrawnDisc(plane, moves, carried));
      ASSERT_GT(expected.increments.size(), 5U) << expected.result.message;
      for (const bool spline : {false, true}) {
        Obstacle floor = Polyline({-40.0, 0.0, 50.0, 0.0}, 0.0, friction);
        if (spline) floor.shape = ObstacleShape::kSpline;
        const TracedPath path = TraceVerified(DrawnDisc(floor, moves, carried));
        ExpectSamePath(path, expected, 1e-10);
        EXPECT_EQ(path.result.reason, expected.result.reason) << path.result.message;
      }
    }
}

// In a groove whose bottom is an arc, by a moment M: at the slope phi the weight is borne by W cos phi and W sin phi =
// M / R. The disc slips where tan phi = mu, or comes to the flank, where M rests and it rolls up.
TEST(RollingOnCurves, ADiscInAGrooveSlipsOrClimbsTheFlank) {
  const double flank = 0.5, length = 10.0;
  for (const double radius : {1e-2, 1.0, 30.0})
    for (const double ratio : {1.2, 4.0})
      for (const double friction : {0.1, 0.4, 0.9}) {
        SCOPED_TRACE(testing::Message() << "radius " << radius << ", fillet over it " << ratio << ", mu " << friction);
        const double fillet = ratio * radius, depth = fillet / std::cos(flank) - fillet, run = length * radius;
        // The bottom of the arc is the origin.
        const Obstacle groove = Polyline(
            {-run, run * std::tan(flank) - depth, 0.0, -depth, run, run * std::tan(flank) - depth}, fillet, friction);
        TraceRequest request = OnFloor({0.0, radius}, radius, groove, {OfBody(0.0, -1.0, true), Moment(-radius)});
        request.options.max_increments = 200;
        request.options.stop = {{"disc.x", ">", 0.9 * run * std::cos(flank)}};
        const TracedPath path = TraceVerified(request);
        const double steepest = std::min(flank, std::atan(friction));
        double largest = 0.0, farthest = 0.0;
        for (const Increment& increment : path.increments) {
          largest = std::max(largest, increment.load_factor);
          const ContactRecord& contact = increment.contacts[0];
          EXPECT_NEAR(std::hypot(contact.rn, contact.rt), 1.0, kExact);
          EXPECT_NEAR(contact.rt, increment.load_factor, kExact);
          if (contact.state != ContactState::kStick) break;
          const Vector2d centre = Centre(increment);
          const double phi = std::atan2(contact.rt, contact.rn), of_arc = std::min(phi, flank);
          const double up = std::hypot(centre.x() - (fillet - radius) * std::sin(of_arc),
                                       centre.y() - fillet + (fillet - radius) * std::cos(of_arc));
          EXPECT_NEAR(phi, std::min(phi, flank), 1e-7);
          EXPECT_NEAR(increment.rotations.back(), -((fillet - radius) * of_arc + up) / radius, 1e-6);
          farthest = std::max(farthest, centre.x());
        }
        EXPECT_NEAR(largest, std::sin(steepest), kExact) << path.result.message;
        if (steepest == flank) {
          EXPECT_GT(farthest, 1.1 * (fillet - radius) * std::sin(flank));
        }
      }
}

// Pulled at its centre over a step: off the floor the reaction goes through the centre, so that F = W tan phi with the
// slope phi of the rounded edge, whatever the friction, and the disc turns by the way of its centre over its radius.
// The other obstacle is the floor, since a disc that touches both touches twice.
TEST(RollingOnCurves, ADiscRollsOverARoundedStep) {
  const double friction = 2.0;
  for (const double radius : {1e-3, 1.0, 200.0})
    for (const double share : {0.05, 0.5, 2.0}) {
      SCOPED_TRACE(testing::Message() << "radius " << radius << ", fillet over it " << share);
      const double fillet = share * radius, height = 0.3 * radius, about = radius + fillet;
      const double start = std::acos((radius + fillet - height) / about);  // its height above the centre of the edge
      // The edge is in the origin of the sketch; its arc has its centre at (fillet, -fillet) from there.
      const double depth = 3.0 * (radius + fillet), run = 20.0 * (radius + fillet);
      Obstacle step = Polyline({0.0, height - depth, 0.0, height, run, height}, fillet, friction);
      const Vector2d centre(fillet - about * std::sin(start), radius);
      TraceRequest request = OnFloor(centre, radius, step, {OfBody(0.0, -1.0, true), OfBody(1.0, 0.0, false)});
      request.scene.obstacles.push_back({"ground", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0});
      request.scene.contacts.push_back(Rolls("rim", "ground"));
      request.options.max_increments = 200;
      request.options.stop = {{"disc.x", ">", fillet + 0.2 * radius}};
      const TracedPath path = TraceVerified(request);
      for (const Increment& increment : path.increments) {
        const Vector2d at = Centre(increment);
        if (increment.contacts[1].state != ContactState::kOpen) continue;
        const double phi = std::atan2(fillet - at.x(), at.y() - height + fillet), of_edge = std::max(phi, 0.0);
        EXPECT_NEAR(increment.load_factor, std::tan(of_edge), kExact);
        EXPECT_NEAR(increment.rotations.back(), -(about * (start - of_edge) + std::max(0.0, at.x() - fillet)) / radius,
                    1e-7);
      }
      EXPECT_NEAR(LargestLoadFactor(path), std::tan(start), kExact) << path.result.message;
      EXPECT_GT(Centre(path.increments.back()).x(), fillet) << path.result.message;
    }
}

// A disc that does not turn slides up a ramp with rounded corners: F = W tan(phi + atan mu) at each slope.
TEST(RollingOnCurves, ADiscThatDoesNotTurnSlidesUpARamp) {
  const double radius = 0.7, slope = 0.4, fillet = 1.5;
  for (const double friction : {0.0, 0.3}) {
    SCOPED_TRACE(testing::Message() << "mu " << friction);
    const double foot = 4.0, top = foot + 5.0;
    const Obstacle ramp =
        Polyline({-5.0, 0.0, foot, 0.0, top, 5.0 * std::tan(slope), 20.0, 5.0 * std::tan(slope)}, fillet, friction);
    TraceRequest request = OnFloor({3.2, radius}, radius, ramp, {OfBody(0.0, -1.0, true), OfBody(1.0, 0.0, false)});
    request.scene.bodies[0].fixed_rotation = true;
    request.scene.nodes = {NodeOf("disc", "hub", 3.2, radius)};
    request.scene.superelements = {{{"hub"}, {0.1, 0.0, 0.0, 0.0}}};  // the flat resists, too
    request.options.max_increments = 200;
    request.options.stop = {{"disc.x", ">", top + 1.0}};
    const TracedPath path = TraceVerified(request);
    ASSERT_GT(Centre(path.increments.back()).x(), top) << path.result.message;
    const std::unique_ptr<const Surface> surface = MakeSurface(ramp);
    double steepest = 0.0;
    for (const Increment& increment : path.increments) {
      if (friction > 0.0 && increment.contacts[0].state != ContactState::kSlipPlus) continue;
      const Vector2d centre = Centre(increment), n = surface->ProjectOnNearest(centre).normal;
      const double phi = std::atan2(-n.x(), n.y());
      EXPECT_NEAR(increment.load_factor - 0.1 * (centre.x() - 3.2), std::tan(phi + std::atan(friction)), 1e-6);
      steepest = std::max(steepest, phi);
    }
    EXPECT_NEAR(steepest, slope, 1e-9);
  }
}

// Over the bumps of a spline from one valley to the next and beyond: no friction force, F = W tan phi, and the rotation
// is the way of the centre over the radius, which is what the foot goes less the radius times the turn of the tangent.
TEST(RollingOnCurves, ADiscRollsOverBumps) {
  for (const double size : {1e-2, 1.0, 50.0}) {
    SCOPED_TRACE(testing::Message() << "size " << size);
    std::vector<double> points;
    for (int i = -5; i <= 5; ++i) {
      points.push_back(size * i);
      points.push_back(size * (i % 2 == 0 ? 0.0 : 0.25));
    }
    Obstacle bumps = Polyline(points, 0.0, 0.8);
    bumps.shape = ObstacleShape::kSpline;
    const double radius = 0.3 * size;
    TraceRequest request = OnFloor({0.0, radius}, radius, bumps, {OfBody(0.0, -1.0, true), OfBody(1.0, 0.0, false)});
    request.options.max_increments = 400;
    request.options.stop = {{"disc.x", ">", 2.2 * size}};
    const TracedPath path = TraceVerified(request);
    ASSERT_GT(Centre(path.increments.back()).x(), 2.0 * size) << path.result.message;
    const std::unique_ptr<const Surface> surface = MakeSurface(bumps);
    const double from = surface->ProjectOnNearest({0.0, radius}).xi;
    for (const Increment& increment : path.increments) {
      const Projection at = surface->ProjectOnNearest(Centre(increment));
      const double phi = std::atan2(-at.normal.x(), at.normal.y());
      EXPECT_NEAR(increment.load_factor, std::tan(phi), 1e-7);
      EXPECT_NEAR(increment.contacts[0].rt, 0.0, kExact);
      EXPECT_NEAR(increment.rotations.back(), -((at.xi - from) / radius - phi), 1e-7);
    }
  }
}

// The same path in other units, stiffness over six decades, and turned.
TEST(RollingOnCurves, ThePathIsTheSameInOtherUnitsAndTurned) {
  const Obstacle ramp = Polyline({-5.0, 0.0, 1.0, 0.0, 4.0, 1.5, 20.0, 1.5}, 1.5, 0.4);
  TraceRequest request = OnFloor({0.0, 0.7}, 0.7, ramp, {OfBody(0.0, -1.0, true), OfBody(2.0, 0.0, false)});
  request.scene.nodes = {NodeOf("disc", "hub", 0.0, 0.7), {"wall", -3.0, 0.9, true, true}};
  request.scene.bars = {{{"wall", "hub"}, 1.5}};
  request.options.stop = {{"load_factor", ">", 0.8}};
  const TracedPath path = TraceProved(request);
  ASSERT_GT(Centre(path.increments.back()).x(), 1.0) << path.result.message;
  for (const double force : {1e-3, 1.0, 1e3})
    for (const double length : {0.125, 40.0})
      ExpectSamePath(UndoUnits(TraceProved(ChangeUnits(request, length, force)), length, force), path, 1e-8);
  for (const double angle : {0.6, 2.5})
    ExpectSamePath(UndoRotation(TraceProved(Rotate(request, angle)), angle), path, 1e-8);
  ExpectSamePath(UndoMirror(TraceProved(Mirror(request))), path, 1e-8);
}

// Round the end of an open floor, which is a corner without a radius: held back by F = W tan phi.
TEST(RollingOnCurves, TheEndOfAFloorIsACorner) {
  const double radius = 0.4, edge = 1.0;
  for (const bool spline : {false, true}) {
    Obstacle floor = Polyline({-5.0, 0.0, edge, 0.0}, 0.0, 1.5);
    if (spline) floor.shape = ObstacleShape::kSpline;
    TraceRequest request = Driven({0.5, radius}, radius, floor);
    request.options.stop = {{"disc.x", ">", edge + radius * std::sin(0.9)}};
    const TracedPath path = TraceVerified(request);
    ASSERT_GT(Centre(path.increments.back()).x(), edge + radius * std::sin(0.8)) << path.result.message;
    for (const Increment& increment : path.increments) {
      const Vector2d at = Centre(increment);
      const double phi = std::atan2(std::max(0.0, at.x() - edge), at.y());
      EXPECT_NEAR(increment.rotations.back(), -((std::min(at.x(), edge) - 0.5) / radius + phi), 1e-7);
      EXPECT_NEAR(kDrive * (increment.load_factor - (at.x() - 0.5)), -std::tan(phi), 1e-7);
    }
  }
}

// Into a neck that is narrower than its diameter a disc cannot roll: it comes to touch both shoulders.
TEST(RollingOnCurves, WhatTouchesTwiceEndsByName) {
  const double radius = 0.7;
  Obstacle neck = Polyline({-5.0, 0.0, -0.6, 0.0, -3.0, -4.0, 3.0, -4.0, 0.6, 0.0, 5.0, 0.0}, 0.0, 1.5);
  neck.fillets = {0.1, 0.1, 0.8, 0.8, 0.1, 0.1};
  const TracedPath path = TraceVerified(Driven({-1.0, radius}, radius, neck));
  EXPECT_NE(path.result.message.find("contact rim@floor: the circle comes upon another part of the obstacle"),
            std::string::npos)
      << path.result.message;
  // As it would lie in the neck, by symmetry in the middle.
  EXPECT_NEAR(Centre(path.increments.back()).x(), 0.0, 0.1);
}

}  // namespace
}  // namespace contact_path::rolling_curves_test
