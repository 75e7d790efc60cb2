// Closed forms, on every increment, for all presets and for short and long steps.
#include "contact_path/path/branch_method.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "branch/example_scenes.h"
#include "support/reference_cases.h"
#include "support/traced_path.h"

namespace contact_path::branch_method_test {
namespace {

struct Setting {
  Accuracy accuracy = Accuracy::kBalanced;
  double step = 0.0;
};

std::string Name(const testing::TestParamInfo<Setting>& info) {
  const std::string step = info.param.step == 0.0 ? "" : info.param.step < 0.02 ? "ShortSteps" : "LongSteps";
  return std::string(ToString(info.param.accuracy)) + step;
}

// Zero of a function near x by the secant method.
double Root(const std::function<double(double)>& function, double x0, double x1) {
  double f0 = function(x0), f1 = function(x1);
  for (int i = 0; i < 60 && f1 != 0.0 && f1 != f0; ++i) {
    const double x2 = x1 - f1 * (x1 - x0) / (f1 - f0);
    x0 = x1;
    f0 = f1;
    x1 = x2;
    f1 = function(x1);
  }
  return x1;
}

class ClosedForm : public testing::TestWithParam<Setting> {
 protected:
  // residual: of the increments. Where other paths cross, the equations are singular and an increment is less exact.
  TracedPath Trace(TraceRequest request, double residual = 1e-13) const {
    request.options.accuracy = GetParam().accuracy;
    request.options.step = GetParam().step;
    request.options.max_increments = 20000;
    const TracedPath path = TraceIncrements(request);
    ExpectSoundIncrements(path, residual);
    // Work is integrated along the interpolation of a step: the longest steps are the worst.
    EXPECT_LE(EnergyImbalance(path), GetParam().accuracy == Accuracy::kFast ? 5e-9 : 1e-9);
    return path;
  }
  TracedPath TraceExample(const std::string& name) const { return Trace(ReadExample(name)); }
  TracedPath TraceScene(const Scene& scene, const std::vector<StopCriterion>& stop, double residual = 1e-13) const {
    TraceRequest request;
    request.scene = scene;
    request.options.stop = stop;
    return Trace(request, residual);
  }
};

constexpr double kExact = 2e-13;     // of loads, reactions and positions
constexpr double kCrossing = 1e-12;  // of residuals where other paths cross

// Rounding of points next to where another path crosses grows with the inverse of the distance from there.
double ExactTo(const TracedPath& path, const Increment& increment) {
  double bound = kExact;
  for (const Increment& crossing : IncrementsOfKind(path, IncrementKind::kBifurcation)) {
    const double distance = std::abs(increment.arc_length - crossing.arc_length);
    if (distance > 0.0) bound = std::max(bound, 0.1 * kExact / distance);
  }
  return bound;
}
constexpr double kDissipation = 1e-9;

TEST_P(ClosedForm, SlidingBar) {
  namespace bar = sliding_bar;
  const TracedPath path = TraceExample("sliding_bar");
  EXPECT_EQ(path.result.reason, EndReason::kStopCriterion);
  double worst = 0.0, dissipated = 0.0;
  for (const Increment& increment : path.increments) {
    const double x = PositionX(path, increment, "b");
    const ContactRecord& contact = Contact(path, increment, "b@floor");
    worst = std::max({worst, std::abs(increment.load_factor - bar::LoadFactor(x)),
                      std::abs(contact.rn - bar::NormalReaction(x)), std::abs(contact.rt + bar::kFriction * contact.rn),
                      std::abs(PositionY(path, increment, "b"))});
    dissipated = std::max(dissipated, std::abs(increment.dissipation - bar::Dissipation(x)));
    if (increment.index > 0) {
      EXPECT_EQ(contact.state, ContactState::kSlipPlus);
    }
  }
  EXPECT_LE(worst, kExact);
  EXPECT_LE(dissipated, kDissipation);

  const std::vector<Increment> limits = IncrementsOfKind(path, IncrementKind::kSmoothLimit);
  ASSERT_EQ(limits.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const double x = Root(bar::LoadFactorSlope, i == 0 ? -2.0 : 3.2, i == 0 ? -1.9 : 3.3);
    EXPECT_NEAR(x, i == 0 ? bar::kFirstLimitX : bar::kSecondLimitX, 1e-12);
    EXPECT_NEAR(limits[i].load_factor, bar::LoadFactor(x), 1e-13);
    EXPECT_NEAR(PositionX(path, limits[i], "b"), x, 1e-10);
  }
  // No other kinds of increments, but the last one, at the value of the stop criterion.
  const std::size_t last = path.increments.back().kind == IncrementKind::kSample ? 1 : 0;
  EXPECT_EQ(IncrementsOfKind(path, IncrementKind::kRegular).size() + 3 + last, path.increments.size());
}

// The reaction vanishes where the bar has its initial length again, and load and bar force with it.
TEST_P(ClosedForm, SlidingBarUntilItBecomesAMechanism) {
  TraceRequest request = ReadExample("sliding_bar");
  request.options.stop = {{"b.x", ">", 5.5}};
  const TracedPath path = Trace(request);
  const std::vector<Increment> events = IncrementsOfKind(path, IncrementKind::kContactEvent);
  ASSERT_GE(events.size(), 1U);
  EXPECT_NEAR(PositionX(path, events[0], "b"), 5.0, kExact);
  EXPECT_NEAR(events[0].load_factor, 0.0, kExact);
  EXPECT_NEAR(events[0].dissipation, sliding_bar::Dissipation(5.0), kDissipation);
}

TEST_P(ClosedForm, RoughTruss) {
  namespace truss = rough_truss;
  const TracedPath path = TraceExample("rough_truss");
  EXPECT_EQ(path.result.reason, EndReason::kStopCriterion);
  double worst = 0.0, dissipated = 0.0;
  for (const Increment& increment : path.increments) {
    const ContactRecord& foot = Contact(path, increment, "foot@floor");
    const double x = PositionX(path, increment, "foot"), y = PositionY(path, increment, "apex");
    worst = std::max({worst, std::abs(PositionY(path, increment, "foot")),
                      std::abs(PositionX(path, increment, "apex") - 0.5 * (x - 1.0)),
                      std::abs(foot.rn - 0.5 * increment.load_factor)});
    if (foot.state == ContactState::kStick) {
      worst = std::max({worst, std::abs(x - 1.0), std::abs(increment.load_factor - truss::StickingLoad(y)),
                        std::abs(foot.rt + 0.5 * increment.load_factor / y)});
      EXPECT_EQ(increment.dissipation, 0.0);
    } else {
      ASSERT_EQ(foot.state, ContactState::kSlipPlus);
      worst = std::max({worst, std::abs(increment.load_factor - truss::SlidingLoad(x)), std::abs(y - 0.5 * (x + 1.0))});
      dissipated = std::max(dissipated, std::abs(increment.dissipation - truss::Dissipation(x)));
    }
  }
  EXPECT_LE(worst, kExact);
  EXPECT_LE(dissipated, kDissipation);
  const std::vector<Increment> corners = IncrementsOfKind(path, IncrementKind::kCornerLimit);
  ASSERT_EQ(corners.size(), 1U);
  EXPECT_NEAR(corners[0].load_factor, truss::CornerLoad(), 1e-14);
  EXPECT_TRUE(IncrementsOfKind(path, IncrementKind::kSmoothLimit).empty());
  // Where the load is gone, all that was stored has been dissipated.
  EXPECT_NEAR(path.increments.back().load_factor, 1e-9, 1e-14);
  EXPECT_NEAR(path.increments.back().dissipation, truss::TotalDissipation(), kDissipation);
}

TEST_P(ClosedForm, TwoDofFriction) {
  const TracedPath path = TraceExample("two_dof_friction");
  double worst = 0.0, dissipated = 0.0;
  for (const Increment& increment : path.increments) {
    const double x = PositionX(path, increment, "p"), y = PositionY(path, increment, "p"), s = increment.load_factor;
    const ContactRecord& contact = Contact(path, increment, "p@floor");
    // s, y, rn, rt of the three arcs; while it slips the work of friction is the integral of 1 - 1.5 x.
    double work = 0.0;
    if (contact.state == ContactState::kStick) {
      worst = std::max({worst, std::abs(x), std::abs(y), std::abs(contact.rn - 1.0), std::abs(contact.rt + s)});
    } else if (contact.state == ContactState::kSlipPlus) {
      worst = std::max({worst, std::abs(s - (1.0 - 0.5 * x)), std::abs(y), std::abs(contact.rn - (1.0 - 1.5 * x)),
                        std::abs(contact.rt + contact.rn)});
      work = x - 0.75 * x * x;
    } else {
      worst = std::max({worst, std::abs(x - (4.0 * s - 1.5) / 1.75), std::abs(y - (1.5 * s - 1.0) / 1.75), contact.rn});
      work = 1.0 / 3.0;
    }
    dissipated = std::max(dissipated, std::abs(increment.dissipation - work));
  }
  EXPECT_LE(worst, kExact);
  EXPECT_LE(dissipated, 1e-13);
  const std::vector<Increment> corners = IncrementsOfKind(path, IncrementKind::kCornerLimit);
  ASSERT_EQ(corners.size(), 2U);
  EXPECT_NEAR(corners[0].load_factor, 1.0, 1e-14);
  EXPECT_NEAR(corners[1].load_factor, 2.0 / 3.0, 1e-14);
  EXPECT_NEAR(PositionX(path, corners[1], "p"), 2.0 / 3.0, 1e-14);
}

TEST_P(ClosedForm, VonMisesTruss) {
  struct Case {
    StrainMeasure strain;
    std::function<double(double)> tension;  // by l / l0, EA = 1
  };
  const std::vector<Case> cases = {
      {StrainMeasure::kBiot, [](double stretch) { return stretch - 1.0; }},
      {StrainMeasure::kGreenLagrange, [](double stretch) { return 0.5 * (stretch * stretch - 1.0) * stretch; }},
      {StrainMeasure::kLogarithmic, [](double stretch) { return std::log(stretch) / stretch; }}};
  for (const Case& form : cases) {
    for (const double rise : {0.3, 1.0}) {
      SCOPED_TRACE(std::string(ToString(form.strain)) + ", rise " + std::to_string(rise));
      TraceRequest request = ReadExample("von_mises");
      request.scene.nodes[1].y = rise;
      for (Bar& bar : request.scene.bars) bar.strain = form.strain;
      request.options.stop = {{"apex.y", "<", -1.2 * rise}};
      const TracedPath path = Trace(request);
      EXPECT_EQ(path.result.reason, EndReason::kStopCriterion);
      const double rest = std::hypot(1.0, rise);
      const auto load = [&](double y) {
        return -2.0 * form.tension(std::hypot(1.0, y) / rest) * y / std::hypot(1.0, y);
      };
      double worst = 0.0;
      for (const Increment& increment : path.increments)
        worst = std::max({worst, std::abs(PositionX(path, increment, "apex")),
                          std::abs(increment.load_factor - load(PositionY(path, increment, "apex")))});
      EXPECT_LE(worst, kExact);
      const std::vector<Increment> limits = IncrementsOfKind(path, IncrementKind::kSmoothLimit);
      ASSERT_EQ(limits.size(), 2U);
      const auto slope = [&](double y) { return (load(y + 1e-5) - load(y - 1e-5)) / 2e-5; };
      const double y = Root(slope, 0.5 * rise, 0.6 * rise);
      double limit = load(y);
      if (form.strain == StrainMeasure::kBiot) limit = von_mises::BiotLimit(1.0, rise);
      if (form.strain == StrainMeasure::kGreenLagrange) limit = von_mises::GreenLagrangeLimit(1.0, rise);
      EXPECT_NEAR(limits[0].load_factor, limit, 1e-14);
      EXPECT_NEAR(limits[1].load_factor, -limit, 1e-14);
      EXPECT_NEAR(PositionY(path, limits[0], "apex"), -PositionY(path, limits[1], "apex"), 1e-10);
    }
  }
}

TEST_P(ClosedForm, RigidStop) {
  const TracedPath path = TraceExample("rigid_stop");
  double worst = 0.0;
  for (const Increment& increment : path.increments) {
    const ContactRecord& contact = Contact(path, increment, "b@wall");
    worst = std::max({worst, std::abs(PositionX(path, increment, "b") - std::min(1.1, 1.0 + increment.load_factor)),
                      std::abs(contact.rn - std::max(0.0, increment.load_factor - 0.1)),
                      std::abs(contact.gap - std::max(0.0, 0.1 - increment.load_factor))});
  }
  EXPECT_LE(worst, 1e-14);
  const std::vector<Increment> events = IncrementsOfKind(path, IncrementKind::kContactEvent);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_NEAR(events[0].load_factor, 0.1, 1e-15);
}

// The block sticks until its bars pull with mu, slides in while the load falls, and stops at the end of its path.
TEST_P(ClosedForm, SnapBlock) {
  const TracedPath path = TraceScene(snap_block::MakeScene(), {}, kCrossing);
  EXPECT_EQ(path.result.reason, EndReason::kPathEnd) << path.result.message;
  for (const Increment& increment : path.increments) {
    const ContactRecord& contact = Contact(path, increment, "p@floor");
    const double w = PositionX(path, increment, "p"), y = PositionY(path, increment, "up");
    // w is given by y only to the square root of rounding where the path ends.
    const double load =
        contact.state == ContactState::kStick ? snap_block::StickingLoad(y) : (0.8 - 1.0 / snap_block::Length(w)) * y;
    const double height =
        contact.state == ContactState::kStick ? 0.0 : y * y - snap_block::Length(w) * snap_block::Length(w) + w * w;
    const double error = std::max({std::abs(increment.load_factor - load), std::abs(height),
                                   std::abs(y + PositionY(path, increment, "down")), std::abs(contact.rn - 1.0),
                                   std::abs(increment.dissipation - snap_block::Dissipation(w))});
    EXPECT_LE(error, ExactTo(path, increment)) << "increment " << increment.index;
  }
  const std::vector<Increment> corners = IncrementsOfKind(path, IncrementKind::kCornerLimit);
  ASSERT_EQ(corners.size(), 1U);
  EXPECT_NEAR(corners[0].load_factor, snap_block::StickingLoad(std::sqrt(1.0 / 0.49 - 1.0)), 1e-14);
  // Where the two nodes may part from each other: (0.8 - 1 / l) + y^2 / l^3 = 0.
  const std::vector<Increment> crossings = IncrementsOfKind(path, IncrementKind::kBifurcation);
  ASSERT_EQ(crossings.size(), 1U);
  const auto stiffness = [](double w) {
    const double l = snap_block::Length(w), y = snap_block::Height(w);
    return 0.8 - 1.0 / l + y * y / (l * l * l);
  };
  EXPECT_NEAR(PositionX(path, crossings[0], "p"), Root(stiffness, 0.8, 0.75), 1e-6);
  const Increment& last = path.increments.back();
  EXPECT_NEAR(PositionX(path, last, "p"), snap_block::kEndX, 1e-13);
  EXPECT_NEAR(PositionY(path, last, "up"), 0.0, 1e-11);
  EXPECT_NEAR(last.load_factor, 0.0, 1e-11);
  EXPECT_TRUE(last.event.branches.empty());
  EXPECT_EQ(last.event.taken, 0);
  EXPECT_EQ(last.event.weakly_active, 1);
}

// A node beside a von Mises truss that comes to a ceiling from below, slides along it and leaves it, for ceilings that
// cut the circle by much and by next to nothing.
TEST_P(ClosedForm, TouchAndLeave) {
  for (const double clearance : {-1e-2, -1e-3, -1e-6, -1e-9}) {
    for (const double friction : {0.0, 0.5}) {
      SCOPED_TRACE(std::to_string(clearance * 1e9) + "e-9, mu " + std::to_string(friction));
      const TracedPath path = TraceScene(swing::MakeScene(clearance, friction), {{"apex.y", "<", 0.7}});
      EXPECT_EQ(path.result.reason, EndReason::kStopCriterion);
      const std::vector<Increment> events = IncrementsOfKind(path, IncrementKind::kContactEvent);
      ASSERT_EQ(events.size(), 2U);
      const double theta = swing::TouchingAngle(clearance);
      for (const double side : {1.0, -1.0}) {  // it touches at +theta, and leaves without reaction at -theta
        const Increment& event = events[side > 0.0 ? 0 : 1];
        EXPECT_NEAR(event.load_factor, swing::Load(side * theta), 1e-10);
        EXPECT_NEAR(PositionX(path, event, "q"), swing::kCentreX + side * swing::kRadius * std::sin(theta), 1e-9);
        EXPECT_NEAR(PositionY(path, event, "apex"), swing::ApexY(side * theta), 1e-9);
      }
      for (const Increment& increment : path.increments) {
        const bool between = increment.index > events[0].index && increment.index <= events[1].index;
        const ContactState touching = friction > 0.0 ? ContactState::kSlipPlus : ContactState::kClosed;  // towards -x
        EXPECT_EQ(Contact(path, increment, "q@ceiling").state, between ? touching : ContactState::kOpen);
        if (between) continue;
        // Else it is on the circle, and the truss does not know of it.
        EXPECT_NEAR(increment.load_factor, von_mises::BiotLoad(1.0, 1.0, PositionY(path, increment, "apex")), kExact);
        EXPECT_NEAR(std::hypot(PositionX(path, increment, "q") - swing::kCentreX,
                               PositionY(path, increment, "q") - swing::kCentreY),
                    swing::kRadius, kExact);
      }
    }
  }
}

// The same with a ceiling that the circle does not reach, by little.
TEST_P(ClosedForm, MissByALittle) {
  for (const double clearance : {1e-9, 1e-6, 1e-3}) {
    for (const double friction : {0.0, 0.5}) {
      SCOPED_TRACE(std::to_string(clearance * 1e9) + "e-9, mu " + std::to_string(friction));
      const TracedPath path = TraceScene(swing::MakeScene(clearance, friction), {{"apex.y", "<", 0.7}});
      EXPECT_EQ(path.result.reason, EndReason::kStopCriterion);
      for (const Increment& increment : path.increments) {
        EXPECT_NEAR(increment.load_factor, von_mises::BiotLoad(1.0, 1.0, PositionY(path, increment, "apex")), kExact);
        EXPECT_EQ(increment.contacts[0].state, ContactState::kOpen);
        EXPECT_TRUE(increment.index == 0 || increment.kind == IncrementKind::kRegular ||
                    increment.kind == IncrementKind::kSample);
      }
    }
  }
}

// A ceiling that the circle touches in one point, without pressing: whatever it is called next to there, nothing comes
// of it.
TEST_P(ClosedForm, Graze) {
  for (const double friction : {0.0, 0.5}) {
    SCOPED_TRACE("mu " + std::to_string(friction));
    TraceRequest request;
    request.scene = swing::MakeScene(0.0, friction);
    request.options.accuracy = GetParam().accuracy;
    request.options.step = GetParam().step;
    request.options.stop = {{"apex.y", "<", 0.7}};
    request.options.max_increments = 20000;
    const TracedPath path = TraceIncrements(request);
    EXPECT_EQ(path.result.reason, EndReason::kStopCriterion);
    EXPECT_LE(EnergyImbalance(path), 1e-9);
    for (const Increment& increment : path.increments) {
      const ContactRecord& contact = Contact(path, increment, "q@ceiling");
      EXPECT_NEAR(increment.load_factor, von_mises::BiotLoad(1.0, 1.0, PositionY(path, increment, "apex")), 1e-11);
      EXPECT_NEAR(contact.rn, 0.0, 1e-11);
      EXPECT_LE(increment.residuals.Contact(), 1e-11);
      const double from_top = std::abs(PositionX(path, increment, "q") - swing::kCentreX);
      EXPECT_TRUE(contact.state == ContactState::kOpen || from_top < 1e-5) << from_top;
      EXPECT_TRUE(increment.index == 0 || increment.kind == IncrementKind::kRegular ||
                  increment.kind == IncrementKind::kContactEvent || increment.kind == IncrementKind::kSample);
    }
    EXPECT_EQ(Contact(path, path.increments.back(), "q@ceiling").state, ContactState::kOpen);
    EXPECT_LE(path.increments.back().dissipation, 1e-12);
  }
}

TEST_P(ClosedForm, Bifurcation) {
  const TracedPath path = TraceScene(tall_truss::MakeScene(), {{"apex.y", "<", 0.8}}, kCrossing);
  EXPECT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
  for (const Increment& increment : path.increments) {
    const double load = von_mises::BiotLoad(1.0, tall_truss::kRise, PositionY(path, increment, "apex"));
    const double error = std::max(std::abs(PositionX(path, increment, "apex")), std::abs(increment.load_factor - load));
    EXPECT_LE(error, ExactTo(path, increment)) << "increment " << increment.index;
  }
  // The sideways stiffness vanishes twice: y^2 l0 = l^3.
  const std::vector<Increment> crossings = IncrementsOfKind(path, IncrementKind::kBifurcation);
  ASSERT_EQ(crossings.size(), 2U);
  EXPECT_NEAR(PositionY(path, crossings[0], "apex"), tall_truss::BifurcationY(), 1e-7);
  for (const Increment& increment : crossings) {
    const double y = PositionY(path, increment, "apex"), l = std::hypot(1.0, y);
    EXPECT_NEAR(y * y * tall_truss::kRestLength, l * l * l, 1e-6);
    EXPECT_EQ(increment.solve.determinant_sign, 0);
    // The apex gives way to the side.
    ASSERT_EQ(increment.event.null_vector.size(), 6U);
    EXPECT_NEAR(std::abs(increment.event.null_vector[2]), 1.0, 1e-9);
    EXPECT_NEAR(increment.event.null_vector[3], 0.0, 1e-6);
  }
  const std::vector<Increment> limits = IncrementsOfKind(path, IncrementKind::kSmoothLimit);
  ASSERT_EQ(limits.size(), 1U);
  EXPECT_NEAR(limits[0].load_factor, von_mises::BiotLimit(1.0, tall_truss::kRise), 1e-13);
  // Sideways between the crossings, and down behind the limit point.
  for (const Increment& increment : path.increments) {
    if (increment.index == 0 || increment.kind != IncrementKind::kRegular) continue;
    const double y = PositionY(path, increment, "apex");
    const bool between = y < PositionY(path, crossings[0], "apex") && y > PositionY(path, crossings[1], "apex");
    const bool falling = increment.index > limits[0].index;
    EXPECT_EQ(increment.stability.unstable_directions, (between ? 1 : 0) + (falling ? 1 : 0)) << increment.index;
  }
}

INSTANTIATE_TEST_SUITE_P(Presets, ClosedForm,
                         testing::Values(Setting{Accuracy::kFast, 0.0}, Setting{Accuracy::kBalanced, 0.0},
                                         Setting{Accuracy::kAccurate, 0.0}, Setting{Accuracy::kBalanced, 0.003},
                                         Setting{Accuracy::kBalanced, 0.3}),
                         Name);

// ----- friction that holds always, or never -----

TEST(BranchMethod, FrictionThatAlwaysHolds) {
  TraceRequest request = ReadExample("rough_truss");
  request.scene.obstacles[0].friction = 1e6;
  request.options.stop = {{"apex.y", "<", 0.05}};
  const TracedPath truss = TraceIncrements(request);
  EXPECT_EQ(truss.result.reason, EndReason::kStopCriterion);
  ExpectSoundIncrements(truss, 1e-10);  // of 1e6 r_n
  double worst = 0.0;
  for (const Increment& increment : truss.increments) {
    EXPECT_EQ(increment.contacts[0].state, ContactState::kStick);
    worst = std::max(worst,
                     std::abs(increment.load_factor - rough_truss::StickingLoad(PositionY(truss, increment, "apex"))));
  }
  EXPECT_LE(worst, kExact);
  const std::vector<Increment> limits = IncrementsOfKind(truss, IncrementKind::kSmoothLimit);
  ASSERT_EQ(limits.size(), 1U);
  EXPECT_NEAR(limits[0].load_factor, von_mises::BiotLimit(1.0, 1.2), 1e-14);

  request = ReadExample("two_dof_friction");
  request.scene.obstacles[0].friction = 1e6;
  request.options.stop = {{"load_factor", ">", 10.0}};
  const TracedPath block = TraceIncrements(request);
  EXPECT_EQ(block.result.reason, EndReason::kStopCriterion);
  for (const Increment& increment : block.increments) EXPECT_EQ(PositionX(block, increment, "p"), 0.0);
}

TEST(BranchMethod, NoFriction) {
  TraceRequest request = ReadExample("sliding_bar");
  request.scene.obstacles[0].friction = 0.0;
  const TracedPath path = TraceIncrements(request);
  EXPECT_EQ(path.result.reason, EndReason::kStopCriterion);
  ExpectSoundIncrements(path, 1e-13);
  double worst = 0.0;
  for (const Increment& increment : path.increments) {
    const double x = PositionX(path, increment, "b"), q = sliding_bar::NormalReaction(x) / sliding_bar::kHeight;
    worst = std::max({worst, std::abs(increment.load_factor + q * x),
                      std::abs(increment.contacts[0].rn - sliding_bar::NormalReaction(x))});
    EXPECT_EQ(increment.contacts[0].rt, 0.0);
    EXPECT_EQ(increment.dissipation, 0.0);
  }
  EXPECT_LE(worst, kExact);
  EXPECT_EQ(IncrementsOfKind(path, IncrementKind::kSmoothLimit).size(), 2U);

  // A truss whose foot nothing holds bears nothing: its path ends at the start.
  request = ReadExample("rough_truss");
  request.scene.obstacles[0].friction = 0.0;
  const TracedPath none = TraceIncrements(request);
  EXPECT_EQ(none.result.reason, EndReason::kPathEnd);
  EXPECT_EQ(none.increments.size(), 1U);
}

}  // namespace
}  // namespace contact_path::branch_method_test
