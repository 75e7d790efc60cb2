// The engine of arcs, steps and events on equations of a few unknowns, whose answers are known.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "branch/toy_equations.h"
#include "contact_path/branch/arc_step.h"
#include "contact_path/branch/bordered_jacobian.h"
#include "contact_path/branch/plane_tangents.h"
#include "contact_path/equations/measured.h"
#include "contact_path/path/model.h"
#include "support/random_scene.h"
#include "support/seeds.h"
#include "support/traced_path.h"

namespace contact_path::toys_test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;
using Unknowns = ToyEquations::Unknowns;

const StepLimits kLimits = {1e-9, 0.1, 1e-3, 0.98};

// A walk along the curve of a toy.
class Walk {
 public:
  Walk(ToyEquations toy, const VectorXd& x, const VectorXd& towards) : toy_(std::move(toy)), arc_(&toy_) {
    arc_.Begin(false);
    EXPECT_TRUE(arc_.Derivatives(x, towards, &at_));
  }

  // Steps until one ends with an event other than a near touch, or as many steps were made: the last one.
  ArcStep ToEvent(int most = 100, const StepEnds& ends = {}, const StepLimits& limits = kLimits) {
    ArcStep last;
    for (int i = 0; i < most; ++i) {
      std::optional<ArcStep> step = NextStep(&arc_, at_, limits.largest, limits, ends);
      EXPECT_TRUE(step);
      if (!step) return last;
      at_ = step->step.end;
      last = *std::move(step);
      const EventKind kind = last.event.Kind();
      if (kind != EventKind::kNone && kind != EventKind::kNearTouch) return last;
    }
    return last;
  }
  const CurvePoint& at() const { return at_; }
  SmoothArc& arc() { return arc_; }

 private:
  ToyEquations toy_;
  SmoothArc arc_;
  CurvePoint at_;
};

ToyEquations Fold() {
  return {2, [](const Unknowns& x) { return Unknowns{x[0] * x[0] + x[1]}; }};
}
// n times x^3 - x s = 0; difference: of the places of one copy and the next.
ToyEquations Pitchforks(std::size_t n, double difference = 0.0) {
  return {static_cast<Eigen::Index>(n) + 1, [=](const Unknowns& x) {
            Unknowns F;
            for (std::size_t i = 0; i < n; ++i)
              F.push_back(x[i] * (x[i] * x[i] - x[n] + difference * static_cast<double>(i)));
            return F;
          }};
}
// x = s, with limits.
ToyEquations Line(std::vector<ToyEquations::Watched> limits) {
  return {2, [](const Unknowns& x) { return Unknowns{x[0] - x[1]}; }, std::move(limits)};
}

TEST(Toys, TheSignOfALeadingTerm) {
  EXPECT_EQ(LeadingSign({{1e-9, 1e-8}, {-2.0, 1.0}, {3.0, 0.0}}), -1);
  EXPECT_EQ(LeadingSign({{1e-9, 1e-10}, {-2.0, 1.0}}), 1);
  EXPECT_EQ(LeadingSign({{1.0, 1.0}, {-1.0, 1.0}}), 0);
}

TEST(Toys, AFold) {
  Walk walk(Fold(), Vector2d(-1.0, -1.0), Vector2d(1.0, 2.0));
  const ArcStep step = walk.ToEvent();
  EXPECT_EQ(step.event.Kind(), EventKind::kLimitPoint);
  EXPECT_TRUE(walk.at().is_limit);
  EXPECT_NEAR(walk.at().x[0], 0.0, 2e-15);
  EXPECT_NEAR(walk.at().x[1], 0.0, 1e-15);
  // One direction goes on: the load falls.
  const ArcStep behind = walk.ToEvent(5);
  EXPECT_EQ(behind.event.Kind(), EventKind::kNone);
  EXPECT_GT(walk.at().x[0], 0.1);
  EXPECT_LT(walk.at().first[1], 0.0);
}

// The rate of s is zero once, and does not change its sign.
TEST(Toys, ACubicDoesNotTurn) {
  for (const double x : {-0.5, -0.4, -0.37}) {
    Walk walk({2, [](const Unknowns& at) { return Unknowns{at[0] * at[0] * at[0] - at[1]}; }}, Vector2d(x, x * x * x),
              Vector2d(1.0, 0.0));
    EXPECT_EQ(walk.ToEvent(60).event.Kind(), EventKind::kNone) << x;
    EXPECT_GT(walk.at().x[1], 0.2);
  }
}

TEST(Toys, APitchfork) {
  Walk walk(Pitchforks(1), Vector2d(0.0, -0.55), Vector2d(0.0, 1.0));
  const int before = walk.at().determinant_sign;
  const ArcStep step = walk.ToEvent();
  ASSERT_EQ(step.event.Kind(), EventKind::kBifurcation);
  const Crossing& crossing = *step.event.crossing;
  EXPECT_NEAR(crossing.x.norm(), 0.0, 1e-15);
  EXPECT_NEAR(crossing.along.first[1], 1.0, 1e-14);
  ASSERT_EQ(crossing.across.size(), 1U);
  EXPECT_NEAR(crossing.across[0].first[0], 1.0, 1e-14);
  EXPECT_NEAR(crossing.across[0].second[1], 2.0, 1e-9);  // s = x^2
  EXPECT_EQ(walk.ToEvent(3).step.end.determinant_sign, -before);
}

// Steps of 1/8 end on it.
TEST(Toys, APitchforkAtTheEndOfAStep) {
  const StepLimits limits = {1e-9, 0.125, 1e-3, 0.98};
  Walk walk(Pitchforks(1), Vector2d(0.0, -0.5), Vector2d(0.0, 1.0));
  ASSERT_EQ(walk.ToEvent(10, {}, limits).event.Kind(), EventKind::kBifurcation);
  EXPECT_NEAR(walk.at().x.norm(), 0.0, 1e-15);
  EXPECT_EQ(walk.ToEvent(3, {}, limits).event.Kind(), EventKind::kNone);
}

TEST(Toys, SeveralPitchforksAtOnePoint) {
  for (const std::size_t n : {2U, 3U, 4U, 7U}) {
    SCOPED_TRACE(n);
    const auto size = static_cast<Eigen::Index>(n) + 1;
    const VectorXd along = VectorXd::Unit(size, size - 1);
    Walk walk(Pitchforks(n), -0.55 * along, along);
    std::optional<Crossing> found;
    if (n % 2 == 1) {
      const ArcStep step = walk.ToEvent();
      ASSERT_EQ(step.event.Kind(), EventKind::kBifurcation);
      found = step.event.crossing;
    } else {  // the determinant keeps its sign, and a count has to ask
      while (walk.at().x[size - 1] < -0.06) walk.ToEvent(1);
      const ArcStep step = walk.ToEvent(1);
      bool broken = false;
      for (const Eigen::Index k : {Eigen::Index{0}, size - 1}) {
        const std::optional<LocatedCrossing> on = CrossingOn(&walk.arc(), step.step, 0.0, step.step.length, k, &broken);
        ASSERT_TRUE(on) << k;
        found = on->at;
      }
    }
    EXPECT_NEAR(found->x.norm(), 0.0, 1e-14);
    // Each alone, and all together.
    ASSERT_EQ(found->across.size(), n + 1);
    for (std::size_t j = 0; j < n; ++j) EXPECT_NEAR(found->across[j].first.cwiseAbs().maxCoeff(), 1.0, 1e-12);
    EXPECT_NEAR(found->across[n].first.cwiseAbs().maxCoeff(), 1.0 / std::sqrt(static_cast<double>(n)), 1e-12);
  }
}

// Parts that differ are several points, however near.
TEST(Toys, PitchforksNextToEachOther) {
  for (const double difference : {1e-2, 1e-4}) {
    SCOPED_TRACE(difference);
    ToyEquations toy = Pitchforks(3, difference);
    EXPECT_FALSE(FindCrossing(&toy, -0.01 * VectorXd::Unit(4, 3), VectorXd::Unit(4, 3), 3));
    Walk walk(toy, -1.05 * difference * VectorXd::Unit(4, 3), VectorXd::Unit(4, 3));
    const StepLimits shorter = {1e-9, 0.6 * difference, 1e-3, 0.98};
    for (int i = 0; i < 3; ++i) {
      const ArcStep step = walk.ToEvent(100, {}, shorter);
      ASSERT_EQ(step.event.Kind(), EventKind::kBifurcation) << i;
      EXPECT_EQ(step.event.crossing->across.size(), 1U);
      EXPECT_NEAR(walk.at().x[3], difference * i, 1e-14);
    }
  }
}

// Two limits fail at one place, next to each other within what counts as zero at an event, or one after the other.
TEST(Toys, TwoCorners) {
  for (const auto& [apart, active] : std::vector<std::pair<double, int>>{{0.0, 2}, {1e-12, 2}, {1e-6, 1}}) {
    SCOPED_TRACE(apart);
    const double second = 0.55 + apart;
    Walk walk(
        Line({{[](const Unknowns& x) { return 0.55 - x[0]; }}, {[=](const Unknowns& x) { return second - x[0]; }}}),
        Vector2d(0.0, 0.0), Vector2d(1.0, 1.0));
    const ArcStep step = walk.ToEvent();
    ASSERT_EQ(step.event.Kind(), EventKind::kContactEvent);
    EXPECT_NEAR(walk.at().x[0], 0.55, 1e-15);
    int zero = 0;
    for (const int i : {0, 1}) zero += walk.arc().equations().Value({i, 0}, walk.at().x) <= tolerances::kActive ? 1 : 0;
    EXPECT_EQ(zero, active);
  }
}

// Broken and mended within a step, by little and by less; or nearly.
TEST(Toys, ALimitThatGrazesZero) {
  for (const double depth : {1e-3, 1e-6, 1e-8}) {
    Walk walk(Line({{[=](const Unknowns& x) { return x[0] * x[0] - depth; }}}), Vector2d(-0.5, -0.5),
              Vector2d(1.0, 1.0));
    ASSERT_EQ(walk.ToEvent().event.Kind(), EventKind::kContactEvent) << depth;
    EXPECT_NEAR(walk.at().x[0], -std::sqrt(depth), 1e-11);
  }
  Walk touches(Line({{[](const Unknowns& x) { return x[0] * x[0] + 1e-3; }}}), Vector2d(-0.5, -0.5),
               Vector2d(1.0, 1.0));
  EXPECT_EQ(touches.ToEvent(20).event.Kind(), EventKind::kNone);
}

TEST(Toys, ALimitThatIsZeroAtTheStart) {
  const ToyEquations::Watched left = {[](const Unknowns& x) { return x[0]; }};
  Walk leaves(Line({left}), Vector2d(0.0, 0.0), Vector2d(1.0, 1.0));
  EXPECT_EQ(leaves.ToEvent(3).event.Kind(), EventKind::kNone);
  Walk breaks(Line({left}), Vector2d(0.0, 0.0), Vector2d(-1.0, -1.0));
  const ArcStep step = breaks.ToEvent(3);
  EXPECT_EQ(step.event.Kind(), EventKind::kContactEvent);
  EXPECT_EQ(step.step.length, 0.0);
}

// Of the first step, which is from -kHalf to kHalf, the ends do not show a term bump (kHalf^2 - x^2)^3.
const double kHalf = 0.05 / std::sqrt(2.0);
ToyEquations::Watched WithBump(double offset, double bump) {
  return {[=](const Unknowns& x) {
    const Along inside = kHalf * kHalf - x[0] * x[0];
    return x[0] * x[0] + offset + bump * (inside * inside * inside);
  }};
}
Walk FirstStepOver(std::vector<ToyEquations::Watched> limits) {
  return {Line(std::move(limits)), Vector2d(-kHalf, -kHalf), Vector2d(1.0, 1.0)};
}

TEST(Toys, AZeroThatTheCurveDoesNotHaveIsNoEvent) {
  Walk walk = FirstStepOver({WithBump(-1e-4, 1e5)});
  EXPECT_NE(walk.ToEvent(1).event.Kind(), EventKind::kContactEvent);
}

// The step up to the first limit that is seen shows another one before it.
TEST(Toys, AnEventBeforeTheOneThatTheStepShows) {
  Walk walk = FirstStepOver({WithBump(1e-4, -1e5), {[](const Unknowns& x) { return 0.01 - x[0]; }}});
  const ArcStep step = walk.ToEvent();
  ASSERT_EQ(step.event.Kind(), EventKind::kContactEvent);
  EXPECT_EQ(step.event.fails->law, 0);
  EXPECT_LT(walk.at().x[0], 0.0);
}

// A step ends a little beyond.
TEST(Toys, AFunctionAtWhoseZeroAnIncrementIsWanted) {
  Walk walk(Line({{[](const Unknowns& x) { return 0.02 - x[0]; }, false, true}}), Vector2d(0.0, 0.0),
            Vector2d(1.0, 1.0));
  EXPECT_EQ(walk.ToEvent(1).event.Kind(), EventKind::kNearTouch);
  EXPECT_GT(walk.at().x[0], 0.02);
  EXPECT_LT(walk.at().x[0], 0.02 + 1e-8);
}

// A shorter step sees the limit that the first one leapt over.
TEST(Toys, ALimitThatIsOutOfSightAtTheStart) {
  Walk walk(Line({{[](const Unknowns& x) { return 0.05 - x[0]; }, false, false, 0.03}}), Vector2d(0.0, 0.0),
            Vector2d(1.0, 1.0));
  ASSERT_EQ(walk.ToEvent().event.Kind(), EventKind::kContactEvent);
  EXPECT_NEAR(walk.at().x[0], 0.05, 1e-12);
}

// A limit that fails next to where the load turns is what to act on.
TEST(Toys, ALimitNextToAFold) {
  ToyEquations toy(2, [](const Unknowns& x) { return Unknowns{x[0] * x[0] + x[1]}; },
                   {{[](const Unknowns& x) { return 1e-13 - x[0]; }}});
  Walk walk(toy, Vector2d(-1.0, -1.0), Vector2d(1.0, 2.0));
  EXPECT_EQ(walk.ToEvent().event.Kind(), EventKind::kContactEvent);
}

// Two straight curves: the one of arrival is the path, whichever it is.
TEST(Toys, CurvesThatCrossAreNamedByTheArrival) {
  const auto two = [](const Unknowns& x) { return Unknowns{(x[0] - x[1]) * (x[0] + 0.4 * x[1])}; };
  for (const double slope : {1.0, -0.4})
    for (const double sense : {1.0, -1.0}) {
      const Vector2d along = sense * Vector2d(slope, 1.0).normalized();
      Walk walk({2, two}, -0.55 * along, along);
      const ArcStep step = walk.ToEvent();
      ASSERT_EQ(step.event.Kind(), EventKind::kBifurcation) << slope;
      EXPECT_NEAR(walk.at().x.norm(), 0.0, 1e-12);
      EXPECT_NEAR(step.event.crossing->along.first.dot(along), 1.0, 1e-12);
    }
}

// x (x^2 - s) = e: the curve bends off, however sharply, and no step goes on straight to the other one.
TEST(Toys, APitchforkThatAnImperfectionHasBroken) {
  for (const double e : {1e-2, 1e-6, 1e-9, 1e-11}) {
    SCOPED_TRACE(e);
    const auto toy = [=](const Unknowns& x) { return Unknowns{x[0] * (x[0] * x[0] - x[1]) - e}; };
    Walk walk({2, toy}, Vector2d(e / 0.55, e * e / (0.55 * 0.55) - 0.55), Vector2d(0.0, 1.0));
    while (walk.at().x[1] < 0.3) ASSERT_EQ(walk.ToEvent(1).event.Kind(), EventKind::kNone);
    EXPECT_GT(walk.at().x[0], 0.5);
  }
}

// y = s - s^3 / 3 has to grow.
TEST(Toys, ARateThatMayNotTurn) {
  const auto curve = [](const Unknowns& x) { return Unknowns{x[0] - x[1] + x[1] * x[1] * x[1] * (1.0 / 3.0)}; };
  Walk walk({2, curve, {{[](const Unknowns& x) { return x[0]; }, true}}}, Vector2d(0.0, 0.0), Vector2d(1.0, 1.0));
  ASSERT_EQ(walk.ToEvent().event.Kind(), EventKind::kContactEvent);
  EXPECT_NEAR(walk.at().x[0], 2.0 / 3.0, 1e-14);
  EXPECT_NEAR(walk.at().x[1], 1.0, 1e-12);
}

// y = 0.3 + 1.8e-6 s: of short steps rounding has a larger share in the differences of y.
TEST(Toys, RoundingTurnsNoRateOnShortSteps) {
  Walk walk(Line({{[](const Unknowns& x) { return Along(0.3) + Along(1.8e-6) * x[0]; }, true}}), Vector2d(0.1, 0.1),
            Vector2d(1.0, 1.0));
  EXPECT_EQ(walk.ToEvent(100, {}, {2e-11, 3e-11, 1e-3, 0.98}).event.Kind(), EventKind::kNone);
  EXPECT_GT(walk.at().x[1], 0.1 + 1e-9);
}

// A limit that counts as zero where the curve sets out is no event as it rises, and is one at once as it falls.
TEST(Toys, WhatIsZeroAtTheStartMayRise) {
  for (const double sense : {1.0, -1.0}) {
    const auto limit = [=](const Unknowns& x) { return Along(-5e-11) + Along(1e-8 * sense) * (x[0] - Along(0.1)); };
    Walk walk(Line({{limit}}), Vector2d(0.1, 0.1), Vector2d(1.0, 1.0));
    const ArcStep step = walk.ToEvent(3);
    EXPECT_EQ(step.event.Kind(), sense > 0.0 ? EventKind::kNone : EventKind::kContactEvent);
    EXPECT_EQ(step.step.length > 0.0, sense > 0.0);
  }
}

// x + 1e6 - (1e6 + 0.1) grows, and has no digits for steps as short as this.
TEST(Toys, ATargetNextToTheStart) {
  StepEnds ends;
  ends.load_factor = 0.1 + 2e-11;
  const auto grows = [](const Unknowns& x) { return (x[0] + Along(1e6)) - Along(1e6 + 0.1); };
  Walk walk(Line({{grows}}), Vector2d(0.1, 0.1), Vector2d(1.0, 1.0));
  EXPECT_EQ(walk.ToEvent(1, ends).event.Kind(), EventKind::kTarget);
  EXPECT_EQ(walk.at().x[1], *ends.load_factor);
}

TEST(Toys, TargetsAndSamples) {
  StepEnds ends;
  ends.load_factor = -0.3;
  ends.functions = {{[](const VectorXd& x) { return x[0] * x[0]; }, {0.5}, 1e-12, 0.0, -1, -1}};
  Walk walk(Fold(), Vector2d(-1.0, -1.0), Vector2d(1.0, 2.0));
  ASSERT_EQ(walk.ToEvent(100, ends).event.Kind(), EventKind::kSample);
  EXPECT_NEAR(walk.at().x[0], -std::sqrt(0.5), 1e-12);
  ASSERT_EQ(walk.ToEvent(100, ends).event.Kind(), EventKind::kTarget);
  EXPECT_NEAR(walk.at().x[1], -0.3, 1e-15);
}

TEST(Toys, StepsAreHalvedWhereTheCurveBends) {
  const auto circle = [](const Unknowns& x) { return Unknowns{x[0] * x[0] + x[1] * x[1] - 1e-2}; };
  Walk walk({2, circle}, Vector2d(0.1, 0.0), Vector2d(0.0, 1.0));
  const ArcStep step = walk.ToEvent(1);
  EXPECT_GT(step.rejected, 0);
  EXPECT_GE(step.step.end.first.dot(step.step.normal), kLimits.cosine);
  EXPECT_NEAR(walk.at().x.norm(), 0.1, 1e-14);
  EXPECT_FALSE(NextStep(&walk.arc(), walk.at(), 0.1, {0.05, 0.1, 1e-3, 0.98}, {}));
}

TEST(Toys, TheInterpolationOfAStepIsOfOrderSix) {
  Walk walk(Fold(), Vector2d(-1.0, -1.0), Vector2d(1.0, 2.0));
  const CurvePoint start = walk.at();
  const auto error = [&](double length) {
    const Correction there = walk.arc().CorrectOnPlane(start.x + length * start.first, start.first);
    CurvePoint end;
    EXPECT_TRUE(there.converged && walk.arc().Derivatives(there.x, start.first, &end));
    const Step step = MakeStep(start, end, 2);
    const VectorXd middle = step.Point(0.4 * step.length);
    return std::abs(middle[0] * middle[0] + middle[1]);
  };
  EXPECT_NEAR(std::log2(error(0.2) / error(0.1)), 6.0, 0.6);
}

// s = a y1^2 = b y2^2: two curves, none, or a plane of them.
TEST(Toys, TangentsOfANullPlane) {
  const auto directions = [](double a, double b) {
    ToyEquations toy(3, [=](const Unknowns& x) { return Unknowns{x[2] - a * x[0] * x[0], x[2] - b * x[1] * x[1]}; });
    MatrixXd plane = MatrixXd::Identity(3, 2);
    return TangentsInPlane(&toy, VectorXd::Zero(3), plane, Vector2d(1.0, -1.0));
  };
  EXPECT_EQ(directions(1.0, 1.0).directions.size(), 2U);
  EXPECT_TRUE(directions(1.0, -1.0).determined);
  EXPECT_TRUE(directions(1.0, -1.0).directions.empty());
  EXPECT_FALSE(directions(0.0, 0.0).determined);
}

// sign det [J; t'] by LU and by the borders, on the increments of random paths.
TEST(Toys, TheSignOfTheDeterminantIsThatOfSigmaRandom) {
  int looked_at = 0;
  for (unsigned seed = 1; seed <= Seeds(300); ++seed) {
    const TracedPath path = TraceIncrements(RandomRequest(seed));
    const Model model(path.request.scene, CharacteristicScales(path.request.scene));
    FixedModeSystem system(model.structure, model.laws);
    for (std::size_t i = 1; i < path.increments.size(); ++i) {
      if (path.increments[i].kind != IncrementKind::kRegular || path.increments[i].solve.determinant_sign == 0)
        continue;
      const PathPoint from = model.FromIncrement(path.increments[i - 1]), to = model.FromIncrement(path.increments[i]);
      PathPoint begin = from;
      TakeStates(to.modes, &begin);
      system.SetModesFrom(begin);
      const VectorXd chord = Chord(from, to).normalized();
      BorderedJacobian at(&system, chord);
      const VectorXd x = system.Pack(to);
      if (!at.ChooseBorders(x, 1) || !at.Factorize(x)) continue;
      EXPECT_EQ(path.increments[i].solve.determinant_sign, -at.determinant_sign * (at.sigma(0, 0) > 0.0 ? 1 : -1))
          << "seed " << seed << ", increment " << i;
      ++looked_at;
    }
  }
  EXPECT_GT(looked_at, static_cast<int>(Seeds(5000)));
}

}  // namespace
}  // namespace contact_path::toys_test
