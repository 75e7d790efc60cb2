// Increments at wanted values of quantities: the ends of paths by stop criteria, and samples.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "contact_path/path/stop.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/quantity.h"
#include "contact_path/scene/scene_index.h"
#include "support/beams.h"
#include "support/parts.h"
#include "support/traced_path.h"

namespace contact_path::samples_test {
namespace {

double Value(const TracedPath& path, const std::string& quantity, const Increment& increment) {
  const ExpandedRequest expanded(path.request);
  return ValueOf(FindQuantity(quantity, SceneIndex(expanded.Get().scene)).value(), increment, path.request);
}

struct Wanted {
  std::string scene;
  StopCriterion stop;
};

class StopAtValue : public testing::TestWithParam<Wanted> {};

// By any steps the same end, to rounding.
TEST_P(StopAtValue, EndsThereWhateverTheSteps) {
  std::vector<double> loads, arcs;
  for (const Accuracy accuracy : kPresets) {
    TraceRequest request = ReadExample(GetParam().scene);
    request.options.accuracy = accuracy;
    request.options.stop = {GetParam().stop};
    const TracedPath path = TraceTo(request);
    const Increment& last = path.increments.back();
    EXPECT_EQ(last.kind, IncrementKind::kSample);
    const double value = GetParam().stop.value;
    EXPECT_NEAR(Value(path, GetParam().stop.quantity, last), value, 1e-11 * (1.0 + std::abs(value)));
    loads.push_back(last.load_factor);
  }
  for (const double load : loads) EXPECT_NEAR(load, loads[0], 1e-9 * (1.0 + std::abs(loads[0])));
}

INSTANTIATE_TEST_SUITE_P(
    Quantities, StopAtValue,
    testing::Values(Wanted{"sliding_bar", {"b.x", ">", 4.95}}, Wanted{"sliding_bar", {"load_factor", ">", 1.5}},
                    Wanted{"sliding_bar", {"b@floor.rn", ">", 1.1}}, Wanted{"rough_truss", {"apex.y", "<", 1.15}},
                    Wanted{"rough_truss", {"foot@floor.rt", "<", -0.05}}, Wanted{"rough_truss", {"left.ry", ">", 0.06}},
                    Wanted{"rough_truss", {"floor.ry", ">", 0.06}}, Wanted{"deep_arch", {"load_factor", ">", 500.0}}),
    [](const auto& of) {
      std::string name = of.param.scene + "_" + of.param.stop.quantity;
      std::replace_if(
          name.begin(), name.end(), [](char c) { return c == '.' || c == '@'; }, '_');
      return name;
    });

// A peg is pushed down onto a bar in two stages and turned about a point beside it; far from the origin.
TEST(StopAtValue, PlacesOfObstacles) {
  TraceRequest request;
  request.scene.nodes = {
      {"a", 1000.0, 0.0, true, true}, {"b", 1001.0, 0.0, false, false}, {"c", 1001.0, -1.0, true, true}};
  request.scene.bars = {{{"a", "b"}, 10.0}, {{"c", "b"}, 10.0}};
  request.scene.obstacles = {Circle("peg", 1001.0, 1.0, 0.5, 0.0)};
  request.scene.contacts = {{"b", "peg"}};
  request.program.resize(2);
  request.program[0].obstacle_motions = {{"peg", 0.0, -0.6}};
  request.program[1].obstacle_motions = {{"peg", 0.0, -0.1, 1.0, 1001.5, 0.4}};
  request.options.at = {{"peg.y", {0.6, 0.45}}};
  request.options.stop = {{"turn_peg", ">", 0.25}};
  const TracedPath path = TraceTo(request);
  const Increment& last = path.increments.back();
  EXPECT_NEAR(last.load_factor, 0.25, 1e-12);
  EXPECT_NEAR(Value(path, "peg.x", last), 1001.5 - 0.5 * std::cos(0.25), 1e-10);
  EXPECT_NEAR(Value(path, "peg.y", last), 0.4 - 0.5 * std::sin(0.25) - 0.025, 1e-10);
  std::vector<double> found;
  for (const Increment& increment : path.increments)
    if (increment.kind == IncrementKind::kSample && increment.stage == 1) found.push_back(increment.load_factor);
  ExpectNear(found, {0.4 / 0.6, 0.55 / 0.6}, 1e-10);
}

TEST(StopAtValue, InexactTakesTheNextIncrementBeyond) {
  TraceRequest request = ReadExample("sliding_bar");
  const TracedPath exact = TraceIncrements(request);
  request.options.stop[0].exact = DefaultTrue::kFalse;
  const TracedPath beyond = TraceIncrements(request);
  ASSERT_EQ(beyond.increments.size(), exact.increments.size());
  EXPECT_GT(Value(beyond, "b.x", beyond.increments.back()), 4.95 + 1e-6);
  EXPECT_NE(beyond.increments.back().kind, IncrementKind::kSample);
  for (std::size_t i = 0; i + 1 < exact.increments.size(); ++i)
    EXPECT_EQ(beyond.increments[i].positions, exact.increments[i].positions);
}

// A criterion that holds from the start on cannot be come to: the first increment ends the path.
TEST(StopAtValue, ThatHoldsFromTheStartEndsAfterOneIncrement) {
  TraceRequest request = ReadExample("sliding_bar");
  request.options.stop = {{"b.x", ">", -100.0}};
  const TracedPath path = TraceIncrements(request);
  ExpectEnd(path, EndReason::kStopCriterion);
  EXPECT_EQ(path.increments.size(), 2U);
}

// At the start the criterion is not yet met: a path that comes back to its load ends there.
TEST(StopAtValue, IsComeToFromItsOtherSideOnly) {
  TraceRequest request = ReadExample("rough_truss");
  const TracedPath path = TraceIncrements(request);
  EXPECT_EQ(IncrementsOfKind(path, IncrementKind::kSample).size(), 1U);
  EXPECT_NEAR(path.increments.back().load_factor, 1e-9, 1e-12);
}

// The load of a snap-through passes the values three times, or once.
TEST(Samples, LieWhereverThePathPassesTheValues) {
  TraceRequest request = ReadExample("von_mises");
  const TracedPath without = TraceIncrements(request);
  request.options.at = {{"load_factor", {0.1, -0.1, 0.15}}, {"apex.y", {}, 0.9, -0.9, 7}};
  const TracedPath path = TraceTo(request);
  for (const Samples& samples : request.options.at)
    for (const double value : samples.Values()) {
      SCOPED_TRACE(samples.quantity + " = " + std::to_string(value));
      std::size_t passes = 0, found = 0;
      for (std::size_t i = 0; i + 1 < without.increments.size(); ++i)
        passes += (Value(without, samples.quantity, without.increments[i]) - value) *
                      (Value(without, samples.quantity, without.increments[i + 1]) - value) <
                  0.0;
      for (const Increment& increment : path.increments)
        found += increment.kind == IncrementKind::kSample &&
                 std::abs(Value(path, samples.quantity, increment) - value) <= 1e-12;
      EXPECT_GE(passes, 1U);
      EXPECT_EQ(found, passes);
    }
  // What the path passes on its way is as without samples.
  ExpectNear(LoadsOfKind(path, IncrementKind::kSmoothLimit), LoadsOfKind(without, IncrementKind::kSmoothLimit), 1e-12);
}

TEST(Samples, OfAProgramAreInEveryStage) {
  TraceRequest request = ReadExample("stick_slip_cycle");
  const TracedPath without = TraceIncrements(request);
  const ExpandedRequest expanded(request);
  const std::string quantity = expanded.Get().scene.contacts[0].Name() + ".rt";
  request.options.at = {{quantity, {0.1}}};
  const TracedPath path = TraceIncrements(request);
  std::size_t passes = 0;
  for (std::size_t i = 0; i + 1 < without.increments.size(); ++i)
    passes += (without.increments[i].contacts[0].rt - 0.1) * (without.increments[i + 1].contacts[0].rt - 0.1) < 0.0;
  EXPECT_GE(passes, 2U);
  EXPECT_EQ(IncrementsOfKind(path, IncrementKind::kSample).size(), passes);
  for (const Increment& increment : IncrementsOfKind(path, IncrementKind::kSample))
    EXPECT_NEAR(increment.contacts[0].rt, 0.1, 1e-12);
  ExpectSameEvents(path, without, 1e-9);
}

// What a study tabulates at the end of a path is a smooth function of the friction: 40 values, second differences.
TEST(StopAtValue, FinalValuesOfAStudyAreSmooth) {
  std::vector<double> loads;
  for (int i = 0; i < 40; ++i) {
    TraceRequest request = ReadExample("sliding_bar");
    request.scene.obstacles[0].friction = 0.3 + 1e-3 * i;
    request.options.stop = {{"b.x", ">", -1.0}};
    loads.push_back(TraceIncrements(request).increments.back().load_factor);
  }
  std::vector<double> second;
  for (std::size_t i = 1; i + 1 < loads.size(); ++i) second.push_back(loads[i - 1] - 2.0 * loads[i] + loads[i + 1]);
  for (std::size_t i = 1; i < second.size(); ++i) EXPECT_NEAR(second[i], second[i - 1], 1e-8);
}

// Two halves of a slender steel arch, on a rough floor, pressed by their crown. unit: of length; 1: mm.
TraceRequest SteelArch(double unit, double friction) {
  Scene scene;
  const double span = 1000.0 / unit;
  scene.nodes = {{"crown", 0.0, span, true, true, true}, {"l", -span, 0.0}, {"r", span, 0.0}};
  for (const char* const side : {"l", "r"}) {
    scene.beams.push_back(Between(std::string(side) + "g", side, "crown", 1.05e8, 8.75e8 / (unit * unit), 10,
                                  (side[0] == 'l' ? -0.5 : 0.5) * std::acos(-1.0)));
    scene.contacts.push_back({side, "floor"});
  }
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, friction}};
  scene.support_motions = {{"crown", 0.0, -0.1 * span}};
  return RequestWithin(1000, scene);
}

// Forces of slender beams are known to rounding of their stiffness. Values that both sides come to at once, and values
// at which the path ends, are there once.
TEST(Samples, OfForcesOfStiffPartsAreThereOnce) {
  for (const double unit : {1.0, 1000.0})
    for (const double friction : {0.1, 0.4}) {
      SCOPED_TRACE(testing::Message() << "unit " << unit << ", friction " << friction);
      TraceRequest request = SteelArch(unit, friction);
      request.options.stop = {{"load_factor", ">", 1.0}};
      const TracedPath whole = TraceProved(request);
      EXPECT_EQ(whole.increments.back().load_factor, 1.0);
      const double half = 0.5 * whole.increments.back().contacts[0].rn, last = whole.increments.back().supports[0].ry;
      request.options.at = {{"l@floor.rn", {half, 1.5 * half}},
                            {"r@floor.rn", {half, 1.5 * half}},
                            {"crown.ry", {0.5 * last, 0.7 * last}},
                            {"lg.3.N", {-half, -1.2 * half}},
                            {"rg.3.N", {-half, -1.2 * half}}};
      const TracedPath path = TraceProved(request);
      EXPECT_EQ(path.increments.back().load_factor, 1.0);
      for (std::size_t i = 1; i < path.increments.size(); ++i)
        EXPECT_GT(path.increments[i].load_factor, path.increments[i - 1].load_factor + 1e-9) << i;
      // Each force grows from 0 to its last value, and comes to what lies between.
      for (const auto& [quantity, value] : {std::pair("l@floor.rn", half),
                                            {"l@floor.rn", 1.5 * half},
                                            {"r@floor.rn", half},
                                            {"r@floor.rn", 1.5 * half},
                                            {"crown.ry", 0.5 * last},
                                            {"crown.ry", 0.7 * last}}) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const Increment& increment : path.increments)
          nearest = std::min(nearest, std::abs(Value(path, quantity, increment) - value));
        EXPECT_LE(nearest, 1e-10 * half) << quantity << " = " << value;
      }
      // A force as the criterion: there, and not at the next increment.
      request.options.at.clear();
      for (const double share : {0.11, 0.37, 0.52, 0.83}) {
        request.options.stop = {{"crown.ry", "<", share * last}, {"crown.ry", ">", -share * last}};
        const TracedPath ends = TraceProved(request);
        EXPECT_NEAR(std::abs(ends.increments.back().supports[0].ry), share * std::abs(last), 1e-10 * std::abs(last));
      }
    }
}

}  // namespace
}  // namespace contact_path::samples_test
