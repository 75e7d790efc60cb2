// Loads on nodes of bodies, nodes of bodies against surfaces, fits, and single discs.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "contact_path/scene/expand.h"
#include "contact_path/scene/scene_index.h"
#include "contact_path/scene/validate.h"
#include "support/beams.h"
#include "support/parts.h"
#include "support/solid_grid.h"
#include "support/traced_path.h"
#include "support/transformations.h"

namespace contact_path::points_of_bodies_test {
namespace {

constexpr double kExact = 1e-8;

// A rigid column of the length l on a hinge with a rotational spring k, pushed down at its top, and a little aside.
TraceRequest Column(double l, double k, double aside) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.name = "column";
  scene.bodies = {{"ground", 0.0, 0.0, true, true, true}, {"column", 0.0, 0.5 * l}};
  scene.nodes = {NodeOf("ground", "below", 0.0, 0.0), NodeOf("column", "foot", 0.0, 0.0),
                 NodeOf("column", "top", 0.0, l)};
  scene.pins = {{{"below", "foot"}, k, 0.0, "hinge"}};
  scene.loads = {{"top", aside, -1.0}};
  request.options.stop = {
      {"column.rotation", "<", -1.5}, {"column.rotation", ">", 1.5}, {"load_factor", ">", 3.0 * k / l}};
  request.options.max_increments = 400;
  return request;
}

// With a load that keeps its direction, buckling at P = k / l; with e P aside, P l (sin(t) + e cos(t)) = k t.
TEST(PointsOfBodies, ALoadKeepsItsDirection) {
  for (const double l : {0.02, 1.0, 30.0})
    for (const double k : {1e-3, 2.0, 5e3})
      for (const double aside : {0.0, 0.1}) {
        SCOPED_TRACE(testing::Message() << l << ' ' << k << ' ' << aside);
        const TracedPath path = TraceIncrements(Column(l, k, aside));
        ExpectEnd(path, EndReason::kStopCriterion);
        if (aside == 0.0) {
          EXPECT_NEAR(LoadsOfKind(path, IncrementKind::kBifurcation).at(0) * l / k, 1.0, kExact);
          continue;
        }
        for (const Increment& increment : path.increments) {
          const double t = std::asin(PositionX(path, increment, "top") / l);
          EXPECT_NEAR(increment.load_factor * l * (std::sin(t) + aside * std::cos(t)), k * t, kExact * k);
        }
        ExpectNoFindings(path);
      }
}

// A moment on a node of a body is one on the body.
TEST(PointsOfBodies, AMomentIsOneOfTheBody) {
  TraceRequest request = Column(1.0, 2.0, 0.0);
  request.scene.loads = {{"top", 0.0, 0.0, false, 1.0}};
  const TracedPath path = TraceIncrements(request);
  ExpectEnd(path, EndReason::kStopCriterion);
  const double x = PositionX(path, path.increments.back(), "top");
  EXPECT_NEAR(std::sin(path.increments.back().load_factor / 2.0), -x, kExact);
}

// The weight of a beam that is clamped to a free body, on a spring: all of it.
TEST(PointsOfBodies, TheWeightOfABeamOfABody) {
  Scene scene;
  scene.bodies = {{"carriage", 0.0, 0.0, true, false, true}};
  scene.nodes = {NodeOf("carriage", "root", 0.1, 0.0),
                 NodeOf("carriage", "back", 0.0, 0.0),
                 {"tip", 1.1, 0.0},
                 {"ceiling", 0.0, 1.0, true, true}};
  scene.bars = {{{"back", "ceiling"}, 50.0}};
  scene.beams = {Between("arm", "root", "tip", 1e4, 1.0, 0)};
  Load weight;
  weight.beam = "arm";
  weight.by = -3.0;
  scene.loads = {weight};
  const TracedPath path = TraceUntil({"load_factor", ">", 1.0}, scene);
  EXPECT_NEAR(PositionY(path, path.increments.back(), "back"), -3.0 / 50.0, 1e-9);
}

// A rigid punch with two corners on a soft block bears its load by both, in any units.
TEST(PointsOfBodies, CornersPressOnASurface) {
  TraceRequest request;
  Scene& scene = request.scene;
  for (int j = 0; j <= 2; ++j)
    for (int i = 0; i <= 8; ++i)
      scene.nodes.push_back({"n" + std::to_string(i) + "_" + std::to_string(j), 0.25 * i, 0.25 * j, j == 0, j == 0});
  scene.materials = {ElasticMaterial("rubber", 1.0, 0.3)};
  Solid block = SolidOf("rubber");
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 8; ++i)
      for (const auto& [a, b] : {std::pair(i, j), std::pair(i + 1, j), std::pair(i + 1, j + 1), std::pair(i, j + 1)})
        block.nodes.push_back("n" + std::to_string(a) + "_" + std::to_string(b));
  scene.solids = {block};
  BoundarySurface top{"top", {}};
  for (int i = 0; i <= 8; ++i) top.nodes.push_back("n" + std::to_string(i) + "_2");
  scene.surfaces = {top};
  scene.bodies = {{"punch", 1.05, 0.8}};
  scene.nodes.push_back(NodeOf("punch", "l", 0.6, 0.5));
  scene.nodes.push_back(NodeOf("punch", "r", 1.5, 0.5));
  scene.contacts = {{"l", "", "", "top", 0.3}, {"r", "", "", "top", 0.3}};
  scene.loads = {LoadOnBody("punch", 0.0, -1.0)};
  request.options.stop = {{"load_factor", ">", 0.05}};
  const TracedPath path = TraceTo(request);
  const Increment& last = path.increments.back();
  ASSERT_EQ(last.pins.size(), 2u);
  EXPECT_NEAR(last.pins[0].ry + last.pins[1].ry, -last.load_factor, kExact);
  EXPECT_GT(Contact(path, last, "l@top").rn, 0.01);
  EXPECT_GT(Contact(path, last, "r@top").rn, 0.01);
  const TracedPath other = UndoUnits(TraceIncrements(ChangeUnits(request, 10.0, 0.1)), 10.0, 0.1);
  ExpectSameEvents(other, path, 1e-7);
}

// A rigid plug, wider than the place between two springs by 2 d, is pulled out at 2 mu N.
TraceRequest PressFit(double d, double friction) {
  Scene scene;
  scene.name = "press_fit";
  scene.bodies = {{"plug", 0.0, 0.5}};
  scene.nodes = {{"l", -1.0, 0.5, false, true},
                 {"r", 1.0, 0.5, false, true},
                 {"lw", -2.0, 0.5, true, true},
                 {"rw", 2.0, 0.5, true, true},
                 NodeOf("plug", "head", 0.0, 0.9)};
  scene.bars = {{{"lw", "l"}, 10.0}, {{"rw", "r"}, 10.0}};
  Obstacle left{"left", ObstacleShape::kPolyline}, right{"right", ObstacleShape::kPolyline};
  left.points = {-1.0 - d, -2.0, -1.0 - d, 3.0};
  right.points = {1.0 + d, 3.0, 1.0 + d, -2.0};
  left.body = right.body = "plug";
  left.friction = right.friction = friction;
  scene.obstacles = {left, right};
  scene.contacts = {{"l", "left"}, {"r", "right"}};
  scene.loads = {{"head", 0.0, 1.0}};
  return RequestUpToALimit(scene);
}

TEST(PointsOfBodies, APressFitIsPulledOut) {
  for (const double d : {1e-6, 0.02, 0.2})
    for (const double friction : {0.1, 0.6}) {
      SCOPED_TRACE(testing::Message() << d << ' ' << friction);
      TraceRequest request = PressFit(d, friction);
      EXPECT_NE(Validate(request).size(), 0u);  // an overlap that nobody has spoken of
      for (ContactCandidate& contact : request.scene.contacts) contact.overlap = Overlap::kBringOn;
      const TracedPath path = TraceVerified(request);
      ASSERT_FALSE(path.increments.empty()) << path.result.message;
      const double N = 10.0 * d;
      EXPECT_NEAR(Contact(path, path.increments[0], "l@left").rn, N, kExact * (1.0 + N));
      EXPECT_NEAR(Contact(path, path.increments[0], "l@left").gap, 0.0, 2.0 * kExact * N);
      EXPECT_NEAR(LargestLoadFactor(path), 2.0 * friction * N, 2.0 * kExact * (1.0 + N));
    }
}

// A ring of beams that is put on a peg, larger by d of the radius: a polygon of 48 sides with the tension EA d, of
// which each corner presses with 2 sin(pi / 48).
TEST(PointsOfBodies, ARingIsPutOnAPeg) {
  for (const double EA : {100.0, 1e5})
    for (const double d : {1e-4, 0.05}) {
      SCOPED_TRACE(testing::Message() << EA << ' ' << d);
      constexpr int kBeams = 24;
      Scene scene;
      const auto name = [](int i) { return "n" + std::to_string(i % kBeams); };
      for (int i = 0; i < kBeams; ++i) {
        const double angle = 2.0 * M_PI * i / kBeams;
        scene.nodes.push_back({name(i), std::cos(angle), std::sin(angle)});
        scene.beams.push_back(
            Between("arc" + std::to_string(i), name(i), name(i + 1), EA, 1e-3 * EA, 2, 2.0 * M_PI / kBeams));
        ContactCandidate contact;
        contact.obstacle = "peg";
        contact.overlap = Overlap::kBringOn;
        for (const std::string& node : {name(i), "arc" + std::to_string(i) + "/1"}) {
          contact.node = node;
          scene.contacts.push_back(contact);
        }
      }
      scene.obstacles = {Circle("peg", 0.0, 0.0, 1.0 + d, 0.2)};
      scene.loads = {{"n0", 0.0, 1.0}};
      const TracedPath path = TraceVerified(RequestWithin(3, scene));
      ASSERT_FALSE(path.increments.empty()) << path.result.message;
      EXPECT_NEAR(SumOfNormals(path.increments[0]) / (96.0 * std::sin(M_PI / 48.0) * EA * d), 1.0, kExact);
    }
}

// A plate that is dragged over two springs by a face that it carries: the path ends where the first one comes to the
// end of the face, 0.7 of the length from where it was.
TEST(PointsOfBodies, AFaceOfABodyComesToItsEnd) {
  for (const double friction : {0.0, 0.3})
    for (const double length : {1e-3, 1.0, 1e3})
      for (const double angle : {0.0, 0.7}) {
        SCOPED_TRACE(testing::Message() << friction << ' ' << length << ' ' << angle);
        Scene scene;
        RigidBody plate{"plate", 0.0, 0.2};
        plate.fixed_rotation = true;
        scene.bodies = {plate};
        scene.nodes = {{"g", -0.3, 0.0}, {"h", 0.4, 0.0}, NodeOf("plate", "c", 0.0, 0.2), {"w", -2.0, 0.2, true, true}};
        scene.bars = {{{"w", "c"}, 1.0}};
        scene.superelements = {{{"g"}, {40.0, 0.0, 0.0, 100.0}}, {{"h"}, {60.0, 0.0, 0.0, 100.0}}};
        Obstacle face{"face", ObstacleShape::kPolyline};
        face.points = {1.0, 0.0, -1.0, 0.0};
        face.body = "plate";
        face.friction = friction;
        scene.obstacles = {face};
        scene.contacts = {{"g", "face"}, {"h", "face"}};
        scene.loads = {LoadOnBody("plate", 0.0, -1.0, true), LoadOnBody("plate", 1.5, 0.0)};
        const TraceRequest request = Rotate(ChangeUnits(RequestWithin(400, scene), length, 1.0), angle);
        const TracedPath path = TraceTo(request, EndReason::kPathEnd);
        const Increment& last = path.increments.back();
        EXPECT_NEAR(std::hypot(PositionX(path, last, "g") - PositionX(path, last, "c"),
                               PositionY(path, last, "g") - PositionY(path, last, "c")) /
                        length,
                    std::hypot(1.0, 0.2), 1e-7);
        EXPECT_NE(path.result.message.find("g@face"), std::string::npos) << path.result.message;
      }
}

// A disc of the weight W and the radius R in a right angle turns at M = mu sqrt(2) / (1 + mu^2) W R.
TEST(PointsOfBodies, ADiscTurnsInARightAngle) {
  for (const double radius : {1e-3, 1.0, 200.0})
    for (const double friction : {0.1, 0.3, 0.8}) {
      SCOPED_TRACE(testing::Message() << radius << ' ' << friction);
      TraceRequest request;
      request.scene = DiscInARightAngle(radius, friction, 1.0);
      request.options.at_limit = AtLimit::kStop;
      const TracedPath path = TraceVerified(request);
      ASSERT_FALSE(path.increments.empty()) << path.result.message;
      EXPECT_NEAR(path.increments.back().load_factor, friction * std::sqrt(2.0) / (1.0 + friction * friction),
                  5.0 * kExact)
          << path.result.message;
    }
}

// Contacts of discs that open and slide within what they give way by: the energies balance from step to step.
TEST(PointsOfBodies, DiscsInABinWhoseWallMovesOut) {
  for (const char* name : {"five_discs_in_a_bin", "discs_in_a_bin", "more_discs_in_a_bin"}) {
    SCOPED_TRACE(name);
    const TracedPath path = TraceIncrements(ReadData(name));
    EXPECT_TRUE(path.result.reached) << path.result.message;
    EXPECT_GT(path.increments.back().load_factor, 0.1);
    ExpectNoFindings(path);
  }
}

// Most contacts have neither a force nor a motion at first: those that bear are found, and bear the weight.
TEST(PointsOfBodies, FiftyDiscsComeToRestInABin) {
  const TraceRequest request = ReadData("piles/fifty_discs_in_a_bin");
  const TracedPath path = TraceVerified(request);
  ASSERT_FALSE(path.increments.empty()) << path.result.message;
  double weight = 0.0, borne = 0.0, across = 0.0;
  for (const Load& load : request.scene.loads) weight -= load.by;
  const TraceRequest expanded = Expand(request).request;
  const SceneIndex index(expanded.scene);
  for (const char* name : {"floor", "left", "right"}) {
    const Resultant& of = path.increments.front().boundaries[index.FindBoundary(name).value()];
    borne += of.ry;
    across += of.rx;
  }
  EXPECT_NEAR(borne, weight, kExact * weight);
  EXPECT_NEAR(across, 0.0, kExact * weight);
}

// Its last step under the weight is shorter than what rounding leaves of a point.
TEST(PointsOfBodies, TwentyDiscsYieldAsTheWallGivesWay) {
  const TracedPath path = TraceIncrements(ReadData("piles/twenty_discs_in_a_bin"));
  ASSERT_FALSE(path.increments.empty()) << path.result.message;
  EXPECT_TRUE(path.result.reached) << path.result.message;
  EXPECT_GT(path.increments.back().load_factor, 0.8);
  ExpectNoFindings(path);
}

}  // namespace
}  // namespace contact_path::points_of_bodies_test
