// Bars that bear in one sense alone, as scenes have them: taut and slack in closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "contact_path/path/earlier_trace.h"
#include "contact_path/verify/verify_path.h"
#include "support/parts.h"
#include "support/traced_path.h"
#include "support/transformations.h"

namespace contact_path::slack_bars_test {
namespace {

constexpr double kExact = 1e-11;

std::vector<const Increment*> ContactEventsOf(const TracedPath& path) {
  std::vector<const Increment*> events;
  for (const Increment* event : EventsOf(path))
    if (event->kind == IncrementKind::kContactEvent || event->kind == IncrementKind::kCornerLimit)
      events.push_back(event);
  return events;
}

Bar String(const std::string& from, const std::string& to, double EA, double rest_length, const std::string& name = "",
           StrainMeasure strain = StrainMeasure::kBiot) {
  return {{from, to}, EA, rest_length, strain, BarSense::kTension, name};
}

// A node at the origin on springs, between strings to (-1, 0), of the length 1, and to (1, 0), of the length 0.9.
TraceRequest TwoStrings(double EA, double stiffness) {
  Scene scene;
  scene.name = "two_strings";
  scene.nodes = {{"a", -1.0, 0.0, true, true}, {"b", 1.0, 0.0, true, true}, {"p", 0.0, 0.0, false, false}};
  scene.bars = {String("a", "p", EA, 0.0, "left"), String("p", "b", EA, 0.9, "right")};
  scene.superelements = {{{"p"}, {stiffness, 0.0, 0.0, stiffness}}};
  scene.loads = {{"p", EA + stiffness, 0.0, false}};
  return RequestUntil({"p.x", ">", 0.3}, scene);
}

// The load is (EA + k) s = k x + EA x - EA (0.1 - x) / 0.9 until the string on the right is slack at x = 0.1, and k x +
// EA x beyond; whatever the stiffness of the strings is to that of the springs.
TEST(SlackBars, AStringThatGoesSlackPullsNoMore) {
  for (const double ratio : {1e-6, 1e-3, 0.5, 1.0, 10.0}) {
    SCOPED_TRACE(ratio);
    const double EA = 2.0, k = ratio * EA;
    const TracedPath path = TraceTo(TwoStrings(EA, k));
    for (const Increment& increment : path.increments) {
      const double x = increment.positions[4], right = std::max(0.0, (0.1 - x) / 0.9);
      EXPECT_NEAR(increment.load_factor, x - right / (1.0 + ratio), kExact);
      EXPECT_NEAR(increment.strain_energy, 0.5 * EA * (ratio * x * x + x * x + 0.9 * right * right),
                  kExact * EA * (1.0 + ratio));
      EXPECT_EQ(increment.bars[0], BarState::kTaut);
      EXPECT_EQ(increment.bars[1], increment.load_factor <= 0.1 + kExact ? BarState::kTaut : BarState::kSlack);
    }
    const std::vector<const Increment*> events = ContactEventsOf(path);
    ASSERT_EQ(events.size(), 1U);
    EXPECT_NEAR(events[0]->positions[4], 0.1, kExact);
  }
}

TEST(SlackBars, AreTheSameInOtherWords) {
  const TraceRequest request = TwoStrings(2.0, 1.0);
  const TracedPath path = TraceIncrements(request);
  ExpectSamePath(UndoUnits(TraceIncrements(ChangeUnits(request, 1e-3, 1e6)), 1e-3, 1e6), path, 1e-10);
  ExpectSamePath(UndoReversal(TraceIncrements(Reverse(request))), path, 1e-10);
}

// A prop below a node bears compression alone: pulled up, the node leaves it, and pressed down it stands on it.
TEST(SlackBars, APropBearsNoPull) {
  Scene scene;
  scene.nodes = {{"foot", 0.0, -1.0, true, true}, {"p", 0.0, 0.0, true, false}};
  scene.bars = {{{"foot", "p"}, 3.0, 0.0, StrainMeasure::kGreenLagrange, BarSense::kCompression, ""}};
  scene.superelements = {{{"p"}, {1.0, 0.0, 0.0, 1.0}}};
  const TracedPath path =
      TraceTo(RequestOf(scene, {LoadingStage({{"p", 0.0, 0.5}}), LoadingStage({{"p", 0.0, -1.0}})}));
  for (const Increment& increment : path.increments) {
    const double y = increment.positions[3], strain = 0.5 * ((1.0 + y) * (1.0 + y) - 1.0);
    const double load = increment.stage == 1 ? 0.5 * increment.load_factor : 0.5 - increment.load_factor;
    EXPECT_NEAR(load, y + 3.0 * std::min(0.0, strain) * (1.0 + y), kExact);
  }
  EXPECT_EQ(path.increments.back().bars[0], BarState::kTaut);
}

// A shallow truss of two bars snaps through, EA = 1, rise 0.5 over the half span 1, until a rope above its apex, of the
// length 1.3, is taut at y = -0.7; without the rope it would go on.
TEST(SlackBars, ARopeStopsASnap) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.nodes = {{"left", -1.0, 0.0, true, true},
                 {"right", 1.0, 0.0, true, true},
                 {"apex", 0.0, 0.5, false, false},
                 {"hook", 0.0, 0.6, true, true}};
  scene.bars = {{{"left", "apex"}, 1.0}, {{"apex", "right"}, 1.0}, String("hook", "apex", 10.0, 1.3)};
  scene.loads = {{"apex", 0.0, -1.0, false}};
  request.options.stop = {{"apex.y", "<", -0.72}};
  const double l0 = std::hypot(1.0, 0.5);
  for (const AtLimit at_limit : {AtLimit::kFollow, AtLimit::kJump}) {
    request.options.at_limit = at_limit;
    const TracedPath path = TraceTo(request);
    for (const Increment& increment : path.increments) {
      const double y = increment.positions[5], l = std::hypot(1.0, y), rope = std::max(0.0, -0.7 - y) / 1.3;
      EXPECT_NEAR(increment.load_factor, -2.0 * (l / l0 - 1.0) * y / l + 10.0 * rope, kExact);
      if (std::abs(y + 0.7) > 1e-9) {
        EXPECT_EQ(increment.bars[0], y < -0.7 ? BarState::kTaut : BarState::kSlack) << y;
      }
    }
  }
}

// A rope of 1.1 between a hand, which moves away from 1, and a block on a rough floor: taut at 0.1, and the block
// slides where the rope pulls with mu N = 0.4: 0.1 + 0.4 l0 / EA = 0.21 (the spring of the block is loose until it
// slides).
TEST(SlackBars, ARopeDragsABlockByASupportThatMoves) {
  Scene scene;
  scene.nodes = {{"block", 0.0, 0.0, false, false}, {"hand", 1.0, 0.0, true, true}};
  scene.superelements = {{{"block"}, {0.1, 0.0, 0.0, 5.0}}};
  scene.bars = {String("block", "hand", 4.0, 1.1)};
  scene.loads = {{"block", 0.0, -1.0, true}};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.4}};
  scene.contacts = {{"block", "floor"}};
  const TracedPath path =
      TraceTo(RequestOf(scene, {MovingStage({{"hand", 1.0, 0.0}}, 0.6), MovingStage({{"hand", -1.0, 0.0}}, 0.6)}));
  const std::vector<const Increment*> events = ContactEventsOf(path);
  ASSERT_EQ(events.size(), 3U);
  EXPECT_NEAR(events[0]->load_factor, 0.1, kExact);
  EXPECT_NEAR(events[1]->load_factor, 0.1 + 0.4 * 1.1 / 4.0, kExact);
  // It slides until the rope has 0.4 + 0.1 x; slack again where the hand has come back by what that stretched it.
  const double x = events[2]->positions[0], force = 0.4 + 0.1 * x;
  EXPECT_NEAR(events[2]->load_factor, force * 1.1 / 4.0, kExact);
  EXPECT_NEAR(1.6 - x, 1.1 * (1.0 + force / 4.0), kExact);
}

// Nodes that nothing but strings holds hang on what their tension makes.
TEST(SlackBars, AChainOfStringsHangs) {
  Scene scene;
  constexpr int kPieces = 6;
  for (int i = 0; i <= kPieces; ++i) {
    const bool end = i == 0 || i == kPieces;
    scene.nodes.push_back({"n" + std::to_string(i), 0.5 * i, end ? 0.0 : 0.02 * std::sin(i), end, end});
    if (!end) scene.loads.push_back({scene.nodes.back().name, 0.0, -0.1, true});
    if (i > 0) scene.bars.push_back(String("n" + std::to_string(i - 1), "n" + std::to_string(i), 20.0, 0.48));
  }
  scene.loads.push_back({"n3", 1.0, 0.0, false});
  const TracedPath path = TraceUntil({"n3.x", ">", 1.75}, scene);
  for (const Increment& increment : path.increments)
    EXPECT_EQ(increment.stability.stability, Verdict::kStable) << increment.index;
}

TEST(SlackBars, GoOnFromAnIncrementAsIfNothingHadBeen) {
  const TraceRequest request = TwoStrings(2.0, 1.0);
  const TracedPath path = TraceIncrements(request);
  const std::vector<Increment> all = ResumeAfter(6, path).increments;
  ASSERT_EQ(all.size(), path.increments.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].positions, path.increments[i].positions) << i;
    EXPECT_EQ(all[i].bars, path.increments[i].bars) << i;
  }
}

// Of a bag that has the state of every fourth increment alone.
TEST(SlackBars, StatesBetweenAreFoundAnew) {
  const TraceRequest request = TwoStrings(2.0, 1.0);
  const TracedPath path = TraceIncrements(request);
  std::vector<Increment> thinned = Thinned(path, 4);
  ASSERT_EQ(RestoreStates(request, &thinned), thinned.size());
  for (std::size_t i = 0; i < thinned.size(); ++i) {
    EXPECT_NEAR(thinned[i].positions[4], path.increments[i].positions[4], kExact) << i;
    EXPECT_EQ(thinned[i].bars, path.increments[i].bars) << i;
  }
}

TEST(SlackBars, HaveTheirStateInsideOfIncrements) {
  TraceRequest request = TwoStrings(2.0, 1.0);
  request.options.record.emplace_back("inner");
  const TracedPath path = TraceVerified(request);
  EXPECT_TRUE(std::any_of(path.increments.begin(), path.increments.end(),
                          [](const Increment& increment) { return !increment.inner.positions.empty(); }));
}

// Its end is pushed to the other one, where it has no length, and on until it is taut on the other side.
TEST(SlackBars, ASlackStringMayHaveNoLength) {
  for (const StrainMeasure strain :
       {StrainMeasure::kBiot, StrainMeasure::kGreenLagrange, StrainMeasure::kLogarithmic}) {
    SCOPED_TRACE(static_cast<int>(strain));
    Scene scene;
    scene.nodes = {{"a", 0.0, 0.0, true, true}, {"p", 1.0, 0.0, false, false}};
    scene.bars = {String("a", "p", 1.0, 1.5, "", strain)};
    scene.superelements = {{{"p"}, {1.0, 0.0, 0.0, 1.0}}};
    TracedPath path =
        TraceIncrements(RequestOf(scene, {LoadingStage({{"p", -1.0, 0.0}}), LoadingStage({{"p", -2.0, 0.0}})}));
    EXPECT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
    EXPECT_EQ(path.increments.back().bars[0], BarState::kTaut);
    int without_length = 0;
    for (Increment& increment : path.increments)
      if (std::abs(increment.positions[2]) < kExact) {
        increment.positions[2] = increment.positions[3] = 0.0;
        ++without_length;
      }
    EXPECT_EQ(without_length, 2);  // where the first stage ends and the second begins
    ExpectNoFindings(path);
  }
}

// A node that is pushed down between two strings, which become taut together at y = -0.2, and that tends to go aside
// with the stiffness -1.5; a taut string adds EA / l0^3 = 1 against it. So with both it stays, and with one of them
// alone it goes aside, where the other one is slack.
TEST(SlackBars, TellBranchesApart) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.nodes = {{"left", -1.0, 1.0, true, true}, {"right", 1.0, 1.0, true, true}, {"p", 0.0, 0.0, false, false}};
  const double l0 = std::hypot(1.0, 1.2), EA = l0 * l0 * l0;
  scene.bars = {String("left", "p", EA, l0), String("p", "right", EA, l0)};
  scene.superelements = {{{"p"}, {-1.5, 0.0, 0.0, 1.0}}};
  scene.loads = {{"p", 0.0, -1.0, false}};
  request.options.stop = {{"p.y", "<", -0.22}};
  std::vector<std::vector<BarState>> found;
  for (int branch = 1; branch <= 3; ++branch) {
    SCOPED_TRACE(branch);
    request.options.branch_choices = {{1, 0, branch}};
    TracedPath path = TraceIncrements(request);
    EXPECT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
    const std::size_t at = static_cast<std::size_t>(
        FirstThat(path, [](const Increment& increment) { return increment.event.number == 1; }).index);
    Increment &event = path.increments[at], &next = path.increments[at + 1];
    EXPECT_NEAR(event.positions[5], -0.2, kExact);
    ASSERT_EQ(event.event.branches.size(), 3U);
    BranchRecord& taken = event.event.branches[static_cast<std::size_t>(branch) - 1];
    found.push_back(taken.bars);
    EXPECT_EQ(next.bars, taken.bars);
    const double aside = next.positions[4];
    EXPECT_EQ(taken.bars, (std::vector<BarState>{aside > -kExact ? BarState::kTaut : BarState::kSlack,
                                                 aside < kExact ? BarState::kTaut : BarState::kSlack}));
    ExpectNoFindings(path);
    std::reverse(taken.bars.begin(), taken.bars.end());
    taken.bars[0] = taken.bars[0] == taken.bars[1] ? BarState::kSlack : taken.bars[0];
    EXPECT_FALSE(VerifyPath(path.request, path.increments).findings.empty());
    taken.bars.clear();
    EXPECT_FALSE(VerifyPath(path.request, path.increments).findings.empty());
  }
  std::sort(found.begin(), found.end());
  EXPECT_EQ(std::unique(found.begin(), found.end()), found.end());
}

// A square of four bars, with a string in each diagonal: `longer` than its place, or shorter and so under tension.
TraceRequest BracedFrame(double longer) {
  Scene scene;
  scene.name = "braced";
  scene.nodes = {{"a", 0.0, 0.0, true, true},
                 {"b", 1.0, 0.0, true, true},
                 {"c", 0.0, 1.0, false, false},
                 {"d", 1.0, 1.0, false, false}};
  scene.bars = {{{"a", "c"}, 20.0}, {{"b", "d"}, 20.0}, {{"c", "d"}, 20.0}};
  for (const auto& [from, to] : {std::pair("a", "d"), std::pair("b", "c")})
    scene.bars.push_back(String(from, to, 4.0, (1.0 + longer) * std::sqrt(2.0)));
  scene.superelements = {{{"c"}, {0.2, 0.0, 0.0, 0.2}}};
  return RequestOf(scene, {LoadingStage({{"c", 0.2, 0.0, false}, {"d", 0.1, -0.1, false}}),
                           LoadingStage({{"c", -0.5, 0.05, false}}), LoadingStage({{"c", 0.3, 0.0, false}})});
}

// A block on a rough floor in a cross of four strings, of which those to one side are taut together; pushed to and fro.
TraceRequest BlockInACross(double longer) {
  Scene scene;
  scene.name = "cross";
  scene.nodes = {{"p", 0.0, 0.0, false, false}};
  scene.superelements = {{{"p"}, {0.5, 0.0, 0.0, 2.0}}};
  for (const double x : {-1.0, 1.0})
    for (const double y : {0.6, -0.4}) {
      scene.nodes.push_back({"n" + std::to_string(scene.nodes.size()), x, y, true, true});
      scene.bars.push_back(String(scene.nodes.back().name, "p", 1.0, (1.0 + longer) * std::hypot(x, y), "",
                                  StrainMeasure::kGreenLagrange));
    }
  scene.loads = {{"p", 0.0, -1.0, true}};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.3}};
  scene.contacts = {{"p", "floor"}};
  return RequestOf(scene, {LoadingStage({{"p", 0.9, 0.0, false}}), LoadingStage({{"p", -1.8, 0.0, false}}),
                           LoadingStage({{"p", 0.9, 1.5, false}})});
}

TEST(SlackBars, BothMethodsFindThePath) {
  constexpr double kCorners = 1e-3;  // by mpec, friction on an increment over a corner is that of its chord
  std::vector<std::pair<TraceRequest, double>> scenes;
  for (const double ratio : {1e-3, 1.0, 10.0}) {
    TraceRequest request = TwoStrings(2.0, 2.0 * ratio);
    request.program = {LoadingStage({{"p", 0.3 * (2.0 + 2.0 * ratio), 0.0, false}}),
                       LoadingStage({{"p", -0.5 * (2.0 + 2.0 * ratio), 0.1, false}})};
    request.scene.loads.clear();
    request.options.stop.clear();
    scenes.emplace_back(request, 1e-9);
  }
  for (const double longer : {-0.02, 0.01}) scenes.emplace_back(BracedFrame(longer), 1e-9);
  for (const double longer : {-0.02, 0.03}) scenes.emplace_back(BlockInACross(longer), kCorners);
  for (auto& [request, tolerance] : scenes) {
    request.options.branch_rule = BranchRule::kDissipation;
    SCOPED_TRACE(request.scene.name + ", " + std::to_string(request.scene.bars.back().rest_length));
    const TracedPath path = TraceTo(request);
    request.options.method = Method::kMpec;
    const TracedPath other = TraceTo(request);
    std::set<BarState> seen;
    for (int stage = 1; stage <= static_cast<int>(request.program.size()); ++stage) {
      const Increment &end = LastOfStage(path, stage), &end_other = LastOfStage(other, stage);
      EXPECT_EQ(end.bars, end_other.bars) << stage;
      seen.insert(end.bars.begin(), end.bars.end());
      for (std::size_t i = 0; i < end.positions.size(); ++i)
        EXPECT_NEAR(end.positions[i], end_other.positions[i], tolerance) << stage;
      for (std::size_t i = 0; i < end.contacts.size(); ++i)
        EXPECT_EQ(end.contacts[i].state, end_other.contacts[i].state) << stage;
    }
    EXPECT_EQ(seen.size(), 2U);
  }
}

TEST(SlackBars, AreRefusedByNameWhereTheyCannotBe) {
  TraceRequest request = TwoStrings(2.0, 1.0);
  const auto expect_refused = [](const TraceRequest& of, const std::string& why) {
    try {
      Trace(of, {});
      ADD_FAILURE() << "was not refused: " << why;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
  };
  request.scene.bars[1].name = "left";
  expect_refused(request, "scene.bars[1].name = left");
  request.scene.bars[1].name = "bar1";
  expect_refused(request, "scene.bars[1].name = bar1: must not be that of the place of another bar");
}

}  // namespace
}  // namespace contact_path::slack_bars_test
