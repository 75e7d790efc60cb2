// Paths of many events: symmetric ones, contacts that touch at once, long steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "contact_path/path/branch_method.h"
#include "support/reference_cases.h"
#include "support/traced_path.h"
#include "support/transformations.h"

namespace contact_path::branch_events_test {
namespace {

std::vector<Increment> Events(const TracedPath& path) {
  std::vector<Increment> increments;
  for (const Increment& increment : path.increments)
    if (increment.kind != IncrementKind::kRegular && increment.kind != IncrementKind::kOnset &&
        increment.kind != IncrementKind::kStart && increment.kind != IncrementKind::kSample)
      increments.push_back(increment);
  return increments;
}

ContactState MirrorState(ContactState state) {
  if (state == ContactState::kSlipPlus) return ContactState::kSlipMinus;
  if (state == ContactState::kSlipMinus) return ContactState::kSlipPlus;
  return state;
}

// ----- arch19 -----

class Arch : public testing::TestWithParam<std::pair<Accuracy, double>> {
 protected:
  static TraceRequest Request(const StopCriterion& stop) {
    TraceRequest request = ReadExample("arch19");
    request.options.accuracy = GetParam().first;
    request.options.step = GetParam().second;
    request.options.max_increments = 10000;
    request.options.stop = {stop};
    return request;
  }

  // Node by node and contact by contact.
  static double Asymmetry(const TracedPath& path) {
    const std::vector<std::pair<std::string, std::string>> pairs = {
        {"d", "i"}, {"a", "g"}, {"e", "j"}, {"b", "h"}, {"f", "k"}};
    double worst = 0.0;
    for (const Increment& increment : path.increments) {
      worst = std::max(worst, std::abs(PositionX(path, increment, "c")));
      for (const auto& [right, left] : pairs)
        worst = std::max({worst, std::abs(PositionX(path, increment, right) + PositionX(path, increment, left)),
                          std::abs(PositionY(path, increment, right) - PositionY(path, increment, left))});
      for (std::size_t i = 0; i < increment.contacts.size(); i += 2) {
        const ContactRecord &a = increment.contacts[i], &b = increment.contacts[i + 1];
        EXPECT_EQ(a.state, MirrorState(b.state)) << "increment " << increment.index;
        worst = std::max({worst, std::abs(a.rn - b.rn), std::abs(a.rt + b.rt)});
      }
    }
    return worst;
  }
};

// A, B and C, as they are known from an independent computation on the half model.
TEST_P(Arch, UpToTheStop) {
  const TracedPath path = TraceIncrements(Request({"a.y", ">", 2.9}));
  EXPECT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
  ExpectSoundIncrements(path, 1e-11);
  EXPECT_LE(Asymmetry(path), 1e-9);
  EXPECT_LE(EnergyImbalance(path), 1e-9);
  // A: f and k slide inwards from the start; t = (-1, 0) on a ceiling.
  ASSERT_GT(path.increments.size(), 2U);
  EXPECT_EQ(Contact(path, path.increments[1], "f@roof_f").state, ContactState::kSlipPlus);
  EXPECT_LT(PositionX(path, path.increments[1], "f"), PositionX(path, path.increments[0], "f"));
  ASSERT_EQ(path.increments[0].event.branches.size(), 3U);  // both slide, or one of them, twice
  const std::vector<Increment> events = Events(path);
  ASSERT_EQ(events.size(), 2U);
  // B
  EXPECT_EQ(events[0].kind, IncrementKind::kSmoothLimit);
  EXPECT_NEAR(events[0].load_factor, 0.03558, 5e-6);
  EXPECT_NEAR(PositionY(path, events[0], "a"), 2.68, 5e-3);
  EXPECT_NEAR(events[0].load_factor, 0.0355808181879, 1e-12);
  EXPECT_NEAR(PositionY(path, events[0], "a"), 2.68254718989, 1e-9);
  // C: e and j touch while f still slides inwards; then the load rises again.
  EXPECT_EQ(events[1].kind, IncrementKind::kCornerLimit);
  EXPECT_NEAR(events[1].load_factor, 0.03532, 5e-6);
  EXPECT_NEAR(PositionY(path, events[1], "a"), 2.8529, 5e-5);
  EXPECT_NEAR(events[1].load_factor, 0.0353215634226, 1e-12);
  EXPECT_NEAR(Contact(path, events[1], "e@roof_e").gap, 0.0, 1e-11);
  EXPECT_NEAR(Contact(path, events[1], "j@roof_e").gap, 0.0, 1e-11);
  EXPECT_EQ(Contact(path, events[1], "f@roof_f").state, ContactState::kSlipPlus);
  EXPECT_EQ(Contact(path, path.increments.back(), "e@roof_e").state, ContactState::kSlipPlus);
  EXPECT_GT(path.increments.back().load_factor, events[1].load_factor);
}

// Beyond the stop of the scene, until it hangs mechanism. What happens, and the loads, are the same however it is
// stepped.
TEST_P(Arch, ToItsEnd) {
  const TracedPath path = TraceIncrements(Request({"a.y", ">", 30.0}));
  EXPECT_EQ(path.result.reason, EndReason::kPathEnd);
  EXPECT_NE(path.result.message.find("become a mechanism"), std::string::npos) << path.result.message;
  EXPECT_LE(Asymmetry(path), 1e-9);
  EXPECT_LE(EnergyImbalance(path), GetParam() == std::make_pair(Accuracy::kBalanced, 0.0) ? 1e-11 : 2e-8);
  for (std::size_t i = 1; i < path.increments.size(); ++i) {
    EXPECT_LE(std::max(path.increments[i].residuals.equilibrium, path.increments[i].residuals.Contact()), 1e-9)
        << "increment " << i;
    EXPECT_GE(path.increments[i].dissipation, path.increments[i - 1].dissipation);
  }
  struct Expected {
    IncrementKind kind;
    double load, arc_length, dissipation;
    const char* f;  // state of f and of e on the arc after the event
    const char* e;
  };
  const std::vector<Expected> expected = {
      {IncrementKind::kSmoothLimit, 0.0355808181879, 4.031655663, 0.001169566112, "slip+", "open"},
      {IncrementKind::kCornerLimit, 0.0353215634226, 4.276381517, 0.001192731552, "slip+", "slip+"},
      {IncrementKind::kContactEvent, 0.0854623234107, 5.452296207, 0.002879757976, "stick", "slip+"},
      {IncrementKind::kSmoothLimit, 0.0868624974956, 5.681085787, 0.002989904462, "stick", "slip+"},
      {IncrementKind::kBifurcation, 0.08686068, 5.689117, 0.00299026435, "stick", "slip+"},
      {IncrementKind::kContactEvent, 0.0868557086463, 5.696597771, 0.002990373614, "stick", "stick"},
      {IncrementKind::kContactEvent, 0.0851754325154, 5.926992041, 0.002990373614, "slip+", "stick"},
      {IncrementKind::kContactEvent, 0.0629090331819, 6.598988365, 0.003066348579, "stick", "slip-"},
      {IncrementKind::kContactEvent, 0.0475859101538, 6.725952340, 0.003647779472, "slip-", "slip-"},
      {IncrementKind::kCornerLimit, 0.0340662155164, 6.803715325, 0.003922604706, "stick", "open"},
      {IncrementKind::kBifurcation, 0.03921602, 7.528398, 0.003922604706, "stick", "open"},
      {IncrementKind::kSmoothLimit, 0.0393308238945, 7.661865485, 0.003922604706, "stick", "open"},
      {IncrementKind::kContactEvent, 0.0359270389377, 8.423959592, 0.003922604706, "slip-", "open"},
      {IncrementKind::kContactEvent, 0.0, 11.662021098, 0.005032026459, "", ""}};
  const std::vector<Increment> events = Events(path);
  ASSERT_EQ(events.size(), expected.size());
  for (std::size_t i = 0; i < events.size(); ++i) {
    SCOPED_TRACE("event " + std::to_string(i));
    const bool crossing = expected[i].kind == IncrementKind::kBifurcation;  // located by the sign of a determinant
    EXPECT_EQ(ToString(events[i].kind), ToString(expected[i].kind));
    EXPECT_NEAR(events[i].load_factor, expected[i].load, crossing ? 2e-8 : 1e-11);
    EXPECT_NEAR(events[i].arc_length, expected[i].arc_length, crossing ? 1e-5 : 1e-7);
    EXPECT_NEAR(events[i].dissipation, expected[i].dissipation, crossing ? 1e-8 : 1e-9);
    if (i + 1 == events.size()) continue;
    const Increment& next = path.increments[static_cast<std::size_t>(events[i].index) + 1];
    EXPECT_EQ(ToString(Contact(path, next, "f@roof_f").state), expected[i].f);
    EXPECT_EQ(ToString(Contact(path, next, "e@roof_e").state), expected[i].e);
  }
}

INSTANTIATE_TEST_SUITE_P(Presets, Arch,
                         testing::Values(std::make_pair(Accuracy::kFast, 0.0), std::make_pair(Accuracy::kBalanced, 0.0),
                                         std::make_pair(Accuracy::kAccurate, 0.0),
                                         std::make_pair(Accuracy::kBalanced, 0.3)));

// ----- resting on rough ground -----

// A von Mises truss with both feet on the floor and no support at all. Nothing is stressed at the start.
TraceRequest TwoFeet(double friction) {
  TraceRequest request = ReadExample("rough_truss");
  request.scene.nodes[0] = {"left", -1.0, 0.0};
  request.scene.obstacles[0].friction = friction;
  request.scene.contacts = {{"left", "floor"}, {"foot", "floor"}};
  return request;
}

// Both feet stick up to the load at which one of them would slide, if the other one were active; then both slide. Each
// may slide alone, which breaks the symmetry: two branches that are mirrors.
TEST(RestingStructure, SlidesApartOnBothFeet) {
  const TracedPath path = TraceIncrements(TwoFeet(rough_truss::kFriction));
  EXPECT_EQ(path.result.reason, EndReason::kStopCriterion);
  ExpectSoundIncrements(path, 1e-13);
  EXPECT_LE(EnergyImbalance(path), 1e-12);
  double worst = 0.0;
  for (const Increment& increment : path.increments) {
    const double left = PositionX(path, increment, "left"), right = PositionX(path, increment, "foot");
    worst = std::max({worst, std::abs(left + right), std::abs(PositionX(path, increment, "apex")),
                      std::abs(increment.contacts[0].rn - 0.5 * increment.load_factor),
                      std::abs(increment.contacts[0].rt + increment.contacts[1].rt)});
    if (increment.contacts[1].state == ContactState::kStick)
      worst = std::max(worst,
                       std::abs(increment.load_factor - rough_truss::StickingLoad(PositionY(path, increment, "apex"))));
    else  // as far apart as with one foot sliding
      worst = std::max({worst, std::abs(increment.load_factor - rough_truss::SlidingLoad(2.0 * right - 1.0)),
                        std::abs(increment.dissipation - rough_truss::Dissipation(2.0 * right - 1.0))});
    EXPECT_EQ(increment.contacts[0].state, MirrorState(increment.contacts[1].state));
  }
  EXPECT_LE(worst, 1e-12);
  const std::vector<Increment> events = Events(path);
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events[0].kind, IncrementKind::kCornerLimit);
  EXPECT_NEAR(events[0].load_factor, rough_truss::CornerLoad(), 1e-14);
  EXPECT_NEAR(path.increments.back().dissipation, rough_truss::TotalDissipation(), 1e-12);
  const std::vector<BranchRecord>& branches = events[0].event.branches;
  ASSERT_EQ(branches.size(), 3U);
  EXPECT_EQ(branches[0].states, (std::vector<ContactState>{ContactState::kSlipMinus, ContactState::kSlipPlus}));
  EXPECT_EQ(events[0].event.taken, 1);
  EXPECT_NEAR(branches[1].dissipation_rate, branches[2].dissipation_rate, 1e-12);
  EXPECT_NEAR(branches[1].load_rate, branches[2].load_rate, 1e-12);
}

// On too smooth a floor it gives way at once: there is no equilibrium, not even under the smallest load.
TEST(RestingStructure, GivesWayAtOnce) {
  for (const double friction : {0.0, 0.5, 0.8}) {  // 1 / 1.2 would hold
    const TracedPath path = TraceIncrements(TwoFeet(friction));
    EXPECT_EQ(path.result.reason, EndReason::kPathEnd);
    EXPECT_EQ(path.increments.size(), 1U);
  }
  const TracedPath holds = TraceIncrements(TwoFeet(0.84));
  EXPECT_GT(holds.increments.size(), 2U);
}

// ----- many contacts at once -----

// A strip of columns of height 1 and width 1, both diagonals in each field, its lower edge at the height 0.1 over a
// rough floor; springs (kx, ky) hold the upper nodes. fx, fy: loads on each upper node.
constexpr int kColumns = 12;

TraceRequest Strip(double friction, double kx, double ky, const std::vector<double>& fx,
                   const std::vector<double>& fy) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.name = "strip";
  const auto bar = [&scene](const std::string& a, const std::string& b) { scene.bars.push_back({{a, b}, 1.0}); };
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, friction}};
  for (int i = 0; i < kColumns; ++i) {
    const std::string b = "b" + std::to_string(i), t = "t" + std::to_string(i);
    const auto k = static_cast<std::size_t>(i);
    scene.nodes.push_back({b, static_cast<double>(i), 0.1});
    scene.nodes.push_back({t, static_cast<double>(i), 1.1});
    bar(b, t);
    if (i > 0) {
      const std::string b0 = "b" + std::to_string(i - 1), t0 = "t" + std::to_string(i - 1);
      bar(b0, b);
      bar(t0, t);
      bar(b0, t);
      bar(t0, b);
    }
    scene.superelements.push_back({{t}, {kx, 0.0, 0.0, ky}});
    scene.loads.push_back({t, fx[k], fy[k]});
    scene.contacts.push_back({b, "floor"});
  }
  return request;
}

std::vector<double> Constant(double value) { return std::vector<double>(kColumns, value); }

// All columns sink alike: the springs bear s each, and all nodes touch at s = 0.1 ky. There are 4^12 combinations of
// states.
TEST(Strip, TwelveNodesTouchAtOnce) {
  for (const double friction : {0.0, 0.05, 0.3}) {
    SCOPED_TRACE("mu " + std::to_string(friction));
    TraceRequest request = Strip(friction, 1.0, 0.5, Constant(0.0), Constant(-1.0));
    request.options.stop = {{"load_factor", ">", 0.3}};
    const TracedPath path = TraceIncrements(request);
    EXPECT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
    ExpectSoundIncrements(path, 1e-12);
    EXPECT_LE(EnergyImbalance(path), 1e-11);
    const std::vector<Increment> events = Events(path);
    ASSERT_FALSE(events.empty());
    const Increment& touch = events[0];
    EXPECT_NEAR(touch.load_factor, 0.05, 1e-13);
    EXPECT_EQ(touch.event.weakly_active, kColumns);
    // Frictionless rates are a convex quadratic program: one solution, though the states have 2^12 combinations.
    EXPECT_EQ(touch.event.complete, friction == 0.0);
    EXPECT_EQ(touch.event.complete_by, friction == 0.0 ? "only_solution" : "");
    const Increment& next = path.increments[static_cast<std::size_t>(touch.index) + 1];
    for (std::size_t i = 0; i < kColumns; ++i) {
      EXPECT_NEAR(touch.contacts[i].gap, 0.0, 1e-13);
      EXPECT_NE(next.contacts[i].state, ContactState::kOpen);
      EXPECT_GT(next.contacts[i].rn, 0.0);
      if (friction == 0.3) {
        EXPECT_EQ(next.contacts[i].state, ContactState::kStick);
      }
    }
    if (friction == 0.05) {  // the ends slide outwards
      EXPECT_EQ(next.contacts[0].state, ContactState::kSlipMinus);
      EXPECT_EQ(next.contacts[kColumns - 1].state, ContactState::kSlipPlus);
    }
    double asymmetry = 0.0;
    for (const Increment& increment : path.increments) {
      for (std::size_t i = 0; i < kColumns; ++i) {
        const ContactRecord &a = increment.contacts[i], &b = increment.contacts[kColumns - 1 - i];
        EXPECT_EQ(a.state, MirrorState(b.state));
        asymmetry = std::max({asymmetry, std::abs(a.rn - b.rn), std::abs(a.rt + b.rt)});
      }
    }
    EXPECT_LE(asymmetry, 1e-11);
  }
}

// The lower edge is not quite straight: nodes that touch one soon after the other end up as those that touch at once.
class UnevenStrip : public testing::TestWithParam<double> {
 public:
  static TracedPath Trace(double unevenness) {
    TraceRequest request = Strip(0.3, 1.0, 0.5, Constant(0.0), Constant(-1.0));
    for (int i = 0; i < kColumns; ++i)
      request.scene.nodes[static_cast<std::size_t>(2 * i)].y += unevenness * std::sin(1.0 + 2.3 * i);
    request.options.stop = {{"load_factor", ">", 0.3}};
    return TraceIncrements(request);
  }
};

TEST_P(UnevenStrip, TouchesAlmostAtOnce) {
  const TracedPath even = Trace(0.0), path = Trace(GetParam());
  // Known limit: gaps that differ by just the tolerance, some within and some beyond. The trace ends there, by name.
  if (GetParam() == 1e-10 && path.result.reason == EndReason::kStepTooSmall) return;
  ASSERT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
  const Increment &a = path.increments.back(), &b = even.increments.back();
  for (std::size_t i = 0; i < kColumns; ++i) {
    EXPECT_EQ(a.contacts[i].state, ContactState::kStick) << i;
    // Per unit of load: the last increments are not at the same load.
    const double rate_a = a.contacts[i].rn / (a.load_factor - 0.05), rate_b = b.contacts[i].rn / (b.load_factor - 0.05);
    EXPECT_NEAR(rate_a, rate_b, 2e-3 + 100.0 * GetParam()) << i;
  }
  EXPECT_LE(EnergyImbalance(path), 1e-10);
}

// Far below and far above the tolerance of 1e-10 within which a contact counts as touching.
INSTANTIATE_TEST_SUITE_P(Unevenness, UnevenStrip,
                         testing::Values(1e-14, 1e-12, 1e-11, 3e-11, 3e-10, 1e-9, 1e-8, 1e-7, 1e-5));

// Next to the tolerance some nodes count as touching and others do not, and the tracer may not find a branch between: a
// known limit. Then it says so (step_too_small) where they touch, and no increment before that is wrong.
TEST(UnevenStripNextToTheTolerance, EndsHonestlyOrPasses) {
  for (const double unevenness : {5e-11, 7e-11, 8.5e-11, 1e-10, 1.2e-10, 1.5e-10, 2e-10}) {
    SCOPED_TRACE("unevenness " + std::to_string(unevenness * 1e12) + "e-12");
    const TracedPath path = UnevenStrip::Trace(unevenness);
    ASSERT_FALSE(path.increments.empty());
    for (const Increment& increment : path.increments)
      EXPECT_LE(std::max(increment.residuals.equilibrium, increment.residuals.Contact()), 1e-9)
          << "increment " << increment.index;
    if (path.result.reason == EndReason::kStopCriterion) {
      for (const ContactRecord& contact : path.increments.back().contacts)
        EXPECT_EQ(contact.state, ContactState::kStick);
      continue;
    }
    EXPECT_EQ(path.result.reason, EndReason::kStepTooSmall) << path.result.message;
    EXPECT_NEAR(path.increments.back().load_factor, 0.05, 1e-9);
  }
}

// Pressed down more at one end and pushed sideways: nodes touch one after the other, and slip one after the other.
class PushedStrip : public testing::Test {
 protected:
  static TraceRequest Request() {
    std::vector<double> fx, fy;
    for (int i = 0; i < kColumns; ++i) {
      fx.push_back(0.1 + 0.05 * std::sin(1.7 * i));
      fy.push_back(-1.0 + 0.06 * i);
    }
    TraceRequest request = Strip(0.2, 0.3, 0.5, fx, fy);
    request.options.stop = {{"load_factor", ">", 0.6}};
    request.options.max_increments = 5000;
    return request;
  }
};

TEST_F(PushedStrip, SlipsNodeByNode) {
  const TracedPath path = TraceIncrements(Request());
  EXPECT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
  ExpectSoundIncrements(path, 1e-12);
  EXPECT_LE(EnergyImbalance(path), 1e-10);
  const std::vector<Increment> events = Events(path);
  EXPECT_GE(events.size(), 14U);
  int touching = 0, slipping = 0;
  for (const ContactRecord& contact : path.increments.back().contacts) {
    touching += contact.state != ContactState::kOpen ? 1 : 0;
    slipping += contact.state == ContactState::kSlipPlus || contact.state == ContactState::kSlipMinus ? 1 : 0;
  }
  EXPECT_GE(touching, 10);
  EXPECT_GE(slipping, 4);
  EXPECT_GT(path.increments.back().dissipation, 0.0);
}

TEST_F(PushedStrip, SameForAllStepsAndInOtherFrames) {
  const TracedPath path = TraceIncrements(Request());
  const std::vector<Increment> expected = Events(path);
  for (const double step : {0.004, 0.1}) {
    SCOPED_TRACE("step " + std::to_string(step));
    TraceRequest request = Request();
    request.options.step = step;
    const std::vector<Increment> actual = Events(TraceIncrements(request));
    // The increments stop at different loads: one may have seen an event more.
    ASSERT_NEAR(static_cast<double>(actual.size()), static_cast<double>(expected.size()), 1.0);
    for (std::size_t i = 0; i < std::min(actual.size(), expected.size()); ++i) {
      EXPECT_EQ(ToString(actual[i].kind), ToString(expected[i].kind)) << i;
      EXPECT_NEAR(actual[i].load_factor, expected[i].load_factor, 1e-10) << i;
      EXPECT_NEAR(actual[i].dissipation, expected[i].dissipation, 1e-9) << i;
      for (std::size_t k = 0; k < kColumns; ++k) EXPECT_EQ(actual[i].contacts[k].state, expected[i].contacts[k].state);
    }
  }
  ExpectSamePath(UndoMirror(TraceIncrements(Mirror(Request()))), path, 1e-9);
  ExpectSamePath(UndoReversal(TraceIncrements(Reverse(Request()))), path, 1e-9);
  ExpectSamePath(UndoUnits(TraceIncrements(ChangeUnits(Request(), 1e-3, 1e6)), 1e-3, 1e6), path, 1e-9);
  ExpectSamePath(UndoRotation(TraceIncrements(Rotate(Request(), 0.65)), 0.65), path, 1e-9);
}

// A Green-Lagrange bar whose linear stiffness a linear part takes away: s = ((1 + u)^3 - (1 + u)) / 2 - u = 3/2 u^2 +
// ..., so that the start is a smooth limit point, from which the load can only rise, to both sides.
TraceRequest StartAtLimit(double direction) {
  TraceRequest request;
  request.scene.nodes = {{"a", 0.0, 0.0, true, true}, {"p", 1.0, 0.0, false, true}};
  request.scene.bars = {{{"a", "p"}, 1.0, 0.0, StrainMeasure::kGreenLagrange}};
  request.scene.superelements = {{{"p"}, {-1.0, 0.0, 0.0, 0.0}, {}}};
  request.scene.loads = {{"p", 1.0, 0.0}};
  request.options.direction = direction;
  request.options.max_increments = 30;
  return request;
}

TEST(Branches, StartAtASmoothLimitPoint) {
  for (const int branch : {1, 2}) {
    TraceRequest request = StartAtLimit(1.0);
    request.options.branch_choices = {{0, 0, branch}};
    const TracedPath path = TraceIncrements(request);
    EXPECT_EQ(path.result.reason, EndReason::kMaxIncrements) << path.result.message;
    ASSERT_EQ(path.increments[0].event.branches.size(), 2U);
    double worst = 0.0;
    for (std::size_t i = 1; i < path.increments.size(); ++i) {
      const double length = PositionX(path, path.increments[i], "p");
      worst = std::max(worst, std::abs(path.increments[i].load_factor -
                                       (0.5 * (length * length * length - length) - (length - 1.0))));
      EXPECT_GT(path.increments[i].load_factor, path.increments[i - 1].load_factor);
    }
    EXPECT_LE(worst, 1e-12);
    const double first = PositionX(path, path.increments[1], "p") - 1.0;
    const double other = PositionX(path, path.increments.back(), "p") - 1.0;
    EXPECT_GT(first * other, 0.0);
  }
  EXPECT_EQ(TraceIncrements(StartAtLimit(-1.0)).result.reason, EndReason::kPathEnd);
}

}  // namespace
}  // namespace contact_path::branch_events_test
