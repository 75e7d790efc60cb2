// Where paths of rigid parts turn: rims that roll on without end, arches of rigid links that snap through aslant.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "support/parts.h"
#include "support/traced_path.h"
#include "support/transformations.h"

namespace contact_path::turns_of_rigid_parts_test {
namespace {

// A disc of the weight W and the radius R, whose weight acts e below its middle, on a floor. It bears a moment up to
// W e; under more it rolls on without end: each turn brings it to a place that holds it no better.
TEST(TurnsOfRigidParts, AnEccentricDiscRollsOn) {
  for (const double radius : {0.01, 1.0, 300.0})
    for (const double share : {0.05, 0.3, 0.9})
      for (const double angle : {0.0, 0.6}) {
        SCOPED_TRACE(testing::Message() << radius << ' ' << share << ' ' << angle);
        Scene scene;
        scene.bodies = {{"disc", 0.0, (1.0 - share) * radius}};
        scene.obstacles = {Circle("rim", 0.0, radius, radius, 0.0, "disc"),
                           {"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.6}};
        scene.contacts = {Rolls("rim", "floor")};
        scene.loads = {LoadOnBody("disc", 0.0, -2.0, true), LoadOnBody("disc", 0.0, 0.0, false, radius)};
        TraceRequest request;
        request.scene = scene;
        request.options.at_limit = AtLimit::kJump;
        const TracedPath path = TraceTo(Rotate(request, angle), EndReason::kNoLanding);
        EXPECT_NEAR(path.increments.back().load_factor, 2.0 * share, 1e-12);
        EXPECT_TRUE(IncrementsOfKind(path, IncrementKind::kJump).empty());
      }
}

// Links of equal turn on an arc of the radius 1 and the angle 2 to 1 side each, with rotational springs between them;
// the right foot pushes on a bar. load_right: at the middle, the load acts on the right one of the links there.
TraceRequest Arch(int links, double spring, bool load_right) {
  TraceRequest request;
  Scene& scene = request.scene;
  const auto x = [&](int i) { return std::sin(-1.0 + 2.0 * i / links) + std::sin(1.0); };
  const auto y = [&](int i) { return std::cos(-1.0 + 2.0 * i / links) - std::cos(1.0); };
  scene.bodies = {{"ground", 0.0, 0.0, true, true, true}};
  scene.nodes = {{"foot", x(links), 0.0, false, true}, {"wall", x(links) + 1.0, 0.0, true, true}};
  for (int i = 0; i < links; ++i) {
    const std::string number = std::to_string(i), link = "link" + number;
    scene.bodies.push_back({link, 0.5 * (x(i) + x(i + 1)), 0.5 * (y(i) + y(i + 1))});
    scene.nodes.push_back(NodeOf(link, "l" + number, x(i), y(i)));
    scene.nodes.push_back(NodeOf(link, "r" + number, x(i + 1), y(i + 1)));
    if (i > 0) scene.pins.push_back({{"r" + std::to_string(i - 1), "l" + number}, spring});
  }
  scene.pins.push_back({{"ground", "l0"}});
  scene.pins.push_back({{"foot", "r" + std::to_string(links - 1)}});
  scene.bars = {{{"foot", "wall"}, 20.0}};
  const std::string left = "r" + std::to_string(links / 2 - 1), right = "l" + std::to_string(links / 2);
  scene.loads = {{load_right ? right : left, 0.0, -1.0}};
  request.options.at_limit = AtLimit::kJump;
  request.options.machine_stiffness = std::numeric_limits<double>::infinity();
  request.options.stop = {{left + ".y", "<", -y(links / 2)}};
  return request;
}

// A machine drives the arch through. It leaves its symmetric path where it leans, and comes back to it where it leans
// no more; pins give way by 1e-8, and do so on one side of the load.
TEST(TurnsOfRigidParts, AnArchOfLinksLeansAndStandsUp) {
  for (const double spring : {1e-3, 0.05})
    for (const bool load_right : {false, true}) {
      SCOPED_TRACE(testing::Message() << spring << ' ' << load_right);
      const TraceRequest request = Arch(4, spring, load_right);
      const TracedPath path = TraceProved(request);
      EXPECT_TRUE(IncrementsOfKind(path, IncrementKind::kJump).empty());
      EXPECT_EQ(LoadsOfKind(path, IncrementKind::kCornerLimit).size(), 2U);
      double lean = 0.0;
      for (const Increment& increment : path.increments) {
        const double middle = 0.5 * PositionX(path, increment, "foot");
        lean = std::max(lean, std::abs(PositionX(path, increment, "r1") - middle));
      }
      for (const Increment& turn : IncrementsOfKind(path, IncrementKind::kCornerLimit))
        EXPECT_NEAR(PositionX(path, turn, "r1"), 0.5 * PositionX(path, turn, "foot"), 1e-6);
      EXPECT_GT(lean, 0.1);
      EXPECT_NEAR(PositionX(path, path.increments.back(), "r1"), 0.5 * PositionX(path, path.increments.back(), "foot"),
                  1e-6);
      ExpectSameEvents(TraceIncrements(ChangeUnits(request, 1e3, 1e-2)), path, 1e-7);
    }
}

}  // namespace
}  // namespace contact_path::turns_of_rigid_parts_test
