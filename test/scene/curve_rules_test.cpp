#include <gtest/gtest.h>

#include "contact_path/scene/validate.h"
#include "support/broken_rule.h"
#include "support/curved_obstacles.h"

namespace contact_path::curve_rules_test {
namespace {

// A bar from a pinned node a down to b, with a load.
TraceRequest SoundRequest() {
  TraceRequest request;
  request.scene.nodes = {{"a", 0.0, 5.0, true, true}, {"b", -5.0, 0.0}};
  request.scene.bars = {{{"a", "b"}, 14.0}};
  request.scene.loads = {{"b", 1.0, 0.0}};
  return request;
}

// Adds it to the scene with a contact of b, which is at (-5, 0).
void AddCurve(TraceRequest* request, const Obstacle& obstacle) {
  request->scene.obstacles.push_back(obstacle);
  request->scene.contacts.push_back({"b", obstacle.name});
}

Obstacle Disc(double x, double y, double radius, bool inside) {
  Obstacle obstacle = CurveThrough(ObstacleShape::kCircle, {});
  obstacle.px = x;
  obstacle.py = y;
  obstacle.radius = radius;
  obstacle.inside = inside;
  return obstacle;
}

constexpr ObstacleShape kPolyline = ObstacleShape::kPolyline, kSpline = ObstacleShape::kSpline;

Obstacle Groove(ObstacleShape shape) {
  Obstacle groove = CurveThrough(shape, {-9.0, 9.0, 0.0, 0.0, 9.0, 9.0});
  if (shape == ObstacleShape::kPolyline) groove.fillet = 1.0;
  return groove;
}

Obstacle Corner(double fillet) {
  Obstacle corner = CurveThrough(kPolyline, {-9.0, -1.0, 0.0, -1.0, 0.0, -3.0});
  corner.fillet = fillet;
  return corner;
}

using Change = std::function<void(TraceRequest&)>;

Change WithCurve(const Obstacle& obstacle) {
  return [=](TraceRequest& request) { AddCurve(&request, obstacle); };
}

// A disc about (0, 8) of this radius that may roll on the curve.
Change WithDisc(double radius, const Obstacle& curve) {
  return [=](TraceRequest& request) {
    Obstacle rim = Disc(0.0, 8.0, radius, false), floor = curve;
    rim.name = "rim";
    rim.body = "disc";
    floor.name = "floor";
    request.scene.bodies = {{"disc", 0.0, 8.0}};
    request.scene.obstacles = {rim, floor};
    request.scene.contacts = {{"", "", "", "", 0.0, {"rim", "floor"}}};
  };
}

const BrokenRule kRules[] = {
    {WithDisc(1.0, Groove(kPolyline)), "scene.contacts[0].obstacles[0]", "rim",
     "its radius 1 must be less than the fillet 1 of the hollow of floor at point 2: where it does not fit it touches "
     "twice"},
    {WithDisc(3.5, Groove(kSpline)), "scene.contacts[0].obstacles[0]", "rim",
     "its radius 3.5 must be less than the radius of curvature 3"},
    {WithDisc(1.0, CurveThrough(kPolyline, {-9.0, 7.25, 9.0, 7.25})), "scene.contacts[0]", "rim@floor",
     "the circle penetrates the obstacle at the start by 0.25"},
    {WithCurve(Disc(0.0, 9.0, 0.0, false)), "scene.obstacles[0].radius", "0", "must be > 0 where the shape is circle"},
    {WithCurve(CurveThrough(kPolyline, {-9.0, -1.0, 9.0})), "scene.obstacles[0].points", "3 numbers",
     "must have x and y in turn"},
    {WithCurve(CurveThrough(kSpline, {-9.0, -1.0})), "scene.obstacles[0].points", "1 point", "must be at least two"},
    {WithCurve(CurveThrough(kSpline, {-9.0, -1.0, 1.0, 1.0}, true)), "scene.obstacles[0].points", "2 points",
     "must be at least three where the curve is closed"},
    {WithCurve(CurveThrough(kSpline, {-9.0, -1.0, 0.0, -1.0, 0.0, -1.0, 5.0, 2.0})), "scene.obstacles[0].points",
     "[0, -1]", "neighbours must differ: point 2 is point 3"},
    {WithCurve(CurveThrough(kPolyline, {3.0, 1.0, 9.0, 1.0, 9.0, 5.0, 3.0, 1.0}, true)), "scene.obstacles[0].points",
     "[3, 1]", "neighbours must differ: point 4 is point 1"},
    {WithCurve(CurveThrough(kPolyline, {3.0, 1.0, 9.0, 5.0, 9.0, 1.0, 3.0, 5.0}, true)), "scene.obstacles[0].points",
     "[9, 1]", "a closed polyline must not cross itself: the edge from point 1 meets the edge from point 3"},
    {WithCurve(CurveThrough(kPolyline, {-9.0, -1.0, 9.0, -1.0, 3.0, -1.0})), "scene.obstacles[0].points", "a corner",
     "an edge must not lead straight back"},
    {WithCurve(Corner(2.5)), "scene.obstacles[0].fillet", "2.5",
     "must be at most 2: the edges have no room for larger fillets"},
    {WithCurve(Corner(-0.1)), "scene.obstacles[0].fillet", "-0.1", "must be"},
    {WithCurve(CurveThrough(kSpline, {-9.0, kNaN, 9.0, 1.0})), "scene.obstacles[0].points[1]", ".nan",
     "must be finite"},
    {WithCurve(Disc(-5.0, -1.0, 1.25, false)), "scene.contacts[0]", "b@curve",
     "initial position penetrates the obstacle by 0.25"},
    {WithCurve(Disc(-5.0, 2.0, 1.5, true)), "scene.contacts[0]", "b@curve",
     "initial position penetrates the obstacle by 0.5"},
    {WithCurve(CurveThrough(kSpline, {-9.0, 0.5, 9.0, 0.5})), "scene.contacts[0]", "b@curve",
     "initial position penetrates the obstacle by 0.5"},
    {WithCurve(CurveThrough(kPolyline, {-9.0, 0.5, 0.0, 0.5, 0.0, -3.0})), "scene.contacts[0]", "b@curve",
     "initial position penetrates the obstacle by 0.5"},
    {[](auto& r) {
       AddCurve(&r, Disc(-5.0, -2.0, 2.0, false));
       r.scene.obstacle_motions = {{"curve", 0.0, 0.0, kInfinity}};
     },
     "scene.obstacle_motions[0].turn", ".inf", "must be finite"},
};

TEST(CurveRulesTest, BrokenRulesAreReportedAlone) {
  for (const BrokenRule& rule : kRules) ExpectBrokenAlone(rule, SoundRequest());
}

TEST(CurveRules, ThoseThatKeepTheirRulesAreSound) {
  TraceRequest request = SoundRequest();
  Obstacle curve = Disc(-5.0, -2.0, 2.0, false);
  AddCurve(&request, curve);
  curve = Corner(2.0);
  curve.name = "polyline";
  AddCurve(&request, curve);
  curve = CurveThrough(kSpline, {9.0, 3.0, 0.0, 2.0, -9.0, 3.0});  // walked to the left: the admissible side is below
  curve.name = "spline";
  AddCurve(&request, curve);
  // Past the end of an open curve a node is not behind it.
  curve = CurveThrough(kPolyline, {-4.0, 1.0, 0.0, 1.0});
  curve.name = "short";
  AddCurve(&request, curve);
  request.scene.obstacle_motions = {{"curve", 0.0, 0.0, 0.5, 1.0, 1.0}};
  for (const Violation& violation : Validate(request)) ADD_FAILURE() << violation.ToLine();
}

}  // namespace
}  // namespace contact_path::curve_rules_test
