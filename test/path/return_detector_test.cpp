#include "contact_path/path/return_detector.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/traced_path.h"

namespace contact_path::return_detector_test {
namespace {

// A node on two floors in the same place, pressed on them by a constant load and held along them by a spring: the path
// is u = s / 2, and the floors share the load as they please.
Scene NodeOnTwoFloors() {
  Scene scene;
  scene.nodes = {{"p", 0.0, 0.0, false, false}, {"far", 10.0, 0.0, true, true}};
  scene.superelements = {{{"p"}, {2.0, 0.0, 0.0, 2.0}, {}}};
  scene.loads = {{"p", 1.0, 0.0, false}, {"p", 0.0, -1.0, true}};
  for (const char* name : {"floor", "same"})
    scene.obstacles.push_back({name, ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.0});
  scene.contacts = {{"p", "floor"}, {"p", "same"}};
  return scene;
}

class NodeOnTwoFloorsReturns : public testing::Test {
 protected:
  // At x along the path, with this share of the load on the first floor.
  PathPoint At(double x, double share) const {
    PathPoint point = model_.InitialPoint();
    const double load = model_.structure.Loads().Constant().norm(), pull = model_.structure.Loads().Reference().norm();
    Eigen::VectorXd force(point.u.size());
    point.u[0] += x;
    model_.structure.InternalForce(point.u, force);
    point.s = force[0] / pull;
    point.forces << share * load, 0.0, (1.0 - share) * load, 0.0;
    return point;
  }

  const Scene scene_ = NodeOnTwoFloors();
  const Model model_{scene_, CharacteristicScales(scene_)};
  LargestReactionSoFar largest_reaction_;
  ReturnDetector detector_{model_, 1, largest_reaction_};
};

TEST_F(NodeOnTwoFloorsReturns, OnlyWithTheSameReactions) {
  detector_.Add(1, At(0.0, 0.25), At(0.1, 0.25));
  detector_.Add(2, At(0.1, 0.25), At(0.2, 0.25));
  const std::optional<ReturnDetector::Return> found = detector_.Find(At(0.05, 0.25), At(0.13, 0.25));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->increment, 1);
  EXPECT_LE(Distance(found->point, At(0.1, 0.25)), 1e-14);
  EXPECT_FALSE(detector_.Find(At(0.05, 0.75), At(0.13, 0.75)));
  EXPECT_FALSE(detector_.Find(At(0.05, 0.2500001), At(0.13, 0.2500001)));
}

TEST_F(NodeOnTwoFloorsReturns, OnlyInTheSameDirection) {
  detector_.Add(1, At(0.0, 0.5), At(0.1, 0.5));
  EXPECT_FALSE(detector_.Find(At(0.13, 0.5), At(0.05, 0.5)));
  EXPECT_TRUE(detector_.Find(At(0.05, 0.5), At(0.13, 0.5)));
  EXPECT_FALSE(detector_.Find(At(0.05, 0.5), At(0.09, 0.5)));  // not there yet
}

TEST_F(NodeOnTwoFloorsReturns, OnlyWithTheSameStates) {
  detector_.Add(1, At(0.0, 1.0), At(0.1, 1.0));
  PathPoint from = At(0.05, 1.0), to = At(0.13, 1.0);
  from.modes[1].state = to.modes[1].state = NumberOf(ContactState::kOpen);
  EXPECT_FALSE(detector_.Find(from, to));
}

TEST_F(NodeOnTwoFloorsReturns, RemembersAFewOfManyIncrements) {
  constexpr int kIncrements = 1000;
  for (int i = 1; i <= kIncrements; ++i) detector_.Add(i, At(0.01 * (i - 1), 0.5), At(0.01 * i, 0.5));
  int found = 0;
  for (int i = 1; i <= kIncrements; ++i)
    if (const auto back = detector_.Find(At(0.01 * i - 0.004, 0.5), At(0.01 * i + 0.003, 0.5))) {
      EXPECT_EQ(back->increment, i);
      ++found;
    }
  EXPECT_GE(found, 15);
  EXPECT_LE(found, 32);
}

// The bar slides through, lifts off, swings round above the floor and lands where it began.
TraceRequest RoundAndRound() {
  TraceRequest request = ReadExample("sliding_bar");
  request.options.stop.clear();
  return request;
}

// The number in "... come back to increment 16 and ...".
int IncrementNamed(const TracedPath& path) {
  const std::string before = "has come back to increment ";
  const std::size_t at = path.result.message.find(before);
  return at == std::string::npos ? -1 : std::stoi(path.result.message.substr(at + before.size()));
}

void ExpectClosed(const TracedPath& path, double tolerance) {
  ASSERT_EQ(path.result.reason, EndReason::kClosedPath) << path.result.message;
  const int named = IncrementNamed(path);
  ASSERT_GT(named, 0) << path.result.message;
  const Increment &first = path.increments.at(static_cast<std::size_t>(named)), &last = path.increments.back();
  ASSERT_LT(first.index, last.index);
  EXPECT_LE(LargestDifference(first, last), tolerance);
  ExpectNoFindings(path);
}

TEST(ClosedPath, OfTheBarThatGoesRound) {
  for (const Accuracy accuracy : kPresets) {
    TraceRequest request = RoundAndRound();
    request.options.accuracy = accuracy;
    request.options.max_increments = 4000;
    const TracedPath path = TraceIncrements(request);
    ExpectClosed(path, 1e-9);
    // Once round, and no more than a tenth of that again.
    const std::vector<Increment> events = IncrementsOfKind(path, IncrementKind::kContactEvent);
    ASSERT_EQ(events.size(), 2U);  // takes off and lands
    const double round = events[1].arc_length;
    EXPECT_LE(path.increments.back().arc_length, 1.1 * round);
    EXPECT_NE(path.result.message.find("no stop criterion was given"), std::string::npos) << path.result.message;
  }
}

TEST(ClosedPath, OfTheBarThatGoesRoundByMpec) {
  TraceRequest request = RoundAndRound();
  request.options.method = Method::kMpec;
  request.options.step = 0.05;
  ExpectClosed(TraceIncrements(request), 1e-9);
}

TEST(ClosedPath, InAStageThatNeverComesToItsTarget) {
  TraceRequest request = RoundAndRound();
  Stage stage;
  stage.loads = request.scene.loads;
  stage.target = 5.0;
  request.scene.loads.clear();
  request.program = {stage, stage};
  const TracedPath path = TraceIncrements(request);
  ExpectClosed(path, 1e-9);
  EXPECT_NE(path.result.message.find("the target of stage 1 of 2 was not reached"), std::string::npos)
      << path.result.message;
}

// A choice farther on may lead elsewhere.
TEST(ClosedPath, IsNoneBeforeAllChoicesAreMade) {
  TraceRequest request = RoundAndRound();
  request.options.branch_choices = {{6, 0, 1}};  // beside taking off and landing, two bifurcations a round
  const TracedPath path = TraceIncrements(request);
  ExpectClosed(path, 1e-9);
  EXPECT_GE(path.increments[static_cast<std::size_t>(path.result.increments) - 1].arc_length,
            2.0 * IncrementsOfKind(path, IncrementKind::kContactEvent).at(0).arc_length);
  EXPECT_EQ(IncrementsOfKind(path, IncrementKind::kContactEvent).size(), 3U);  // takes off once more
}

// Unloading goes back over the same points, the other way, and through the start.
TEST(ClosedPath, IsNotOneThatGoesBackOverItself) {
  TraceRequest request = ReadExample("von_mises");
  request.options.stop.clear();
  request.options.max_increments = 300;
  request.options.branch_choices = {{0, 10, 1}};
  EXPECT_EQ(TraceIncrements(request).result.reason, EndReason::kMaxIncrements);
  request = ReadExample("stick_slip_cycle");
  EXPECT_EQ(TraceIncrements(request).result.reason, EndReason::kStopCriterion);
}

}  // namespace
}  // namespace contact_path::return_detector_test
