// What solves for paths, branches, verdicts and jumps takes a bar that bears tension alone as it takes a contact.
#include "contact_path/law/slack_bar.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "contact_path/branch/branches.h"
#include "contact_path/branch/event_functions.h"
#include "contact_path/branch/mode_arc.h"
#include "contact_path/branch/rate_complementarity.h"
#include "contact_path/stability/jump.h"
#include "contact_path/stability/stability_problem.h"
#include "contact_path/structure/bar.h"
#include "support/derivative_checker.h"
#include "support/points.h"
#include "support/random.h"
#include "support/system_derivatives.h"

namespace contact_path::slack_bar_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kEA = 2.0, kRight = 0.9;  // rest length of the string on the right
constexpr double kExact = 1e-12;
const FixedPoint kNode = PointOfNode(0, 1), kLeftEnd = PointOfNode(-1, -1, {-1.0, 0.0}),
                 kRightEnd = PointOfNode(-1, -1, {1.0, 0.0});
constexpr Mode kTaut = {static_cast<int>(BarState::kTaut), 0}, kSlack = {static_cast<int>(BarState::kSlack), 0};

SlackBar String(const FixedPoint& a, const FixedPoint& b, double rest_length) {
  return {{{MovingPlace::Between(a, b)}}, {}, kEA, rest_length, StrainMeasure::kBiot, BarSense::kTension};
}

// A node at the origin on springs, between strings to (-1, 0), of the length 1, and to (1, 0), of the length 0.9: both
// pull. A load s along x; at x = 0.1 the string on the right goes slack.
class NodeOnTwoStrings : public testing::Test {
 protected:
  explicit NodeOnTwoStrings(double stiffness = 0.5)
      : stiffness_(stiffness),
        structure_(MakeScene(stiffness)),
        left_(String(kLeftEnd, kNode, 1.0)),
        right_(String(kNode, kRightEnd, kRight)) {
    laws_.Add(&left_);
    laws_.Add(&right_);
  }
  static Scene MakeScene(double stiffness) {
    Scene scene;
    scene.nodes = {{"p", 0.0, 0.0}};
    scene.superelements = {{{"p"}, {stiffness, 0.0, 0.0, 1.0}}};
    scene.loads = {{"p", 1.0, 0.0}};
    return scene;
  }
  static double Left(double x) { return std::max(0.0, kEA * x); }
  static double Right(double x) { return std::max(0.0, kEA * (1.0 - x - kRight) / kRight); }
  PathPoint At(double x) const {
    PathPoint point;
    point.u = Vector2d(x, 0.0);
    point.s = stiffness_ * x + Left(x) - Right(x);
    point.forces = Vector2d(Left(x), Right(x));
    point.modes = {x >= 0.0 ? kTaut : kSlack, x <= 1.0 - kRight ? kTaut : kSlack};
    return point;
  }
  // From x along the path by `length` of x.
  Step StepFrom(ModeArc* arc, const PathPoint& point, double length) const {
    arc->SetModes(point);
    CurvePoint start, end;
    const VectorXd towards = Vector3d(length > 0.0 ? 1.0 : -1.0, 0.0, 0.0);
    EXPECT_TRUE(arc->Derivatives(arc->system().Pack(point), towards, &start));
    const VectorXd normal = start.first.head(3);
    const VectorXd ahead = start.x + std::abs(length) / std::abs(start.first[0]) * start.first;
    const Correction correction = arc->CorrectOnPlane(ahead, normal);
    EXPECT_TRUE(correction.converged && arc->Derivatives(correction.x, normal, &end));
    return MakeStep(start, end, 3);
  }

  const double stiffness_;
  const Structure structure_;
  const SlackBar left_, right_;
  Laws laws_;
};

TEST_F(NodeOnTwoStrings, DerivativesMeetDifferences) {
  Random random(1);
  FixedModeSystem system(structure_, laws_);
  for (const Modes& modes : {Modes{kTaut, kTaut}, Modes{kTaut, kSlack}, Modes{kSlack, kSlack}}) {
    system.SetModes(modes);
    EXPECT_EQ(system.NumUnknowns(), system.NumEquations() + 1);
    VectorXd x = random.Vector(system.NumUnknowns(), 0.1, 0.4);
    const VectorXd dx = random.Vector(system.NumUnknowns(), -1.0, 1.0);
    ExpectDerivativesMeetDifferences(&system, x, dx);
    for (const Limit& limit : system.mode_limits().All()) {
      const auto value = [&](const VectorXd& at) { return VectorXd::Constant(1, system.Value(limit, at)); };
      EXPECT_TRUE(IsJacobian(value, x, system.Gradient(limit, x).transpose()));
    }
  }
}

// The force of a bar of each measure, with its tangent and its second derivative; against the element of a bar that
// bears both.
TEST(SlackBar, IsTheElementWhereItIsTaut) {
  Random random(3);
  for (const StrainMeasure strain : {StrainMeasure::kBiot, StrainMeasure::kGreenLagrange, StrainMeasure::kLogarithmic})
    for (const BarSense sense : {BarSense::kTension, BarSense::kCompression}) {
      const SlackBar law({{MovingPlace::Between(PointOfNode(0, 1), PointOfNode(2, 3))}}, {}, 1.7, 0.8, strain, sense);
      const BarElement element(1.7, 0.8, strain);
      const double length = sense == BarSense::kTension ? 1.1 : 0.6, angle = random.Number(0.0, 6.0);
      VectorXd u(4), force(4), v = random.Vector(4, -1.0, 1.0);
      u << 0.3, -0.2, 0.3 + length * std::cos(angle), -0.2 + length * std::sin(angle);
      element.Force(u, force);
      const PortReals forces = law.CompliantForces(u, 0.0, kTaut);
      EXPECT_GT(forces[0], 0.0);
      PortsAt at;
      law.Evaluate(u, 0.0, 0, {}, &at);
      EXPECT_LE((at[0].gradient.head(4) * forces[0] + force).norm(), 1e-15);
      EXPECT_NEAR(law.EnergyAt(u, 0.0, kTaut, forces), element.Energy(u), 1e-15);
      Eigen::MatrixXd tangent(4, 4), derivative(4, 4);
      element.Tangent(u, tangent);
      const Eigen::MatrixXd of_law = 1.7 / 0.8 * at[0].gradient.head(4) * at[0].gradient.head(4).transpose() -
                                     forces[0] * at[0].hessian.topLeftCorner(4, 4);
      EXPECT_LE((of_law - tangent).norm(), 1e-14);
      LawVector along(5);
      along << v, 0.0;
      LawMatrix change;
      law.ForceHessian(u, 0.0, 0, forces, along, &change);
      const auto hessian_along = [&](const VectorXd& h) {
        PortsAt moved;
        law.Evaluate(u + h[0] * v, 0.0, 0, {}, &moved);
        return VectorXd((forces[0] * moved[0].hessian).reshaped());
      };
      EXPECT_TRUE(IsJacobian(hessian_along, VectorXd::Zero(1), change.reshaped()));
    }
}

// Nodes that nothing but strings holds, at two ends: all terms of the equations come from laws.
TEST(SlackBar, ChainOfStringsMeetsDifferences) {
  Scene scene;
  scene.nodes = {{"p", -0.3, 0.1}, {"q", 0.4, -0.1}};
  scene.loads = {{"q", 1.0, 0.3}};
  scene.bars = {{{"p", "q"}, kEA, 0.0, StrainMeasure::kBiot, BarSense::kTension, ""}};
  const Structure structure(scene);
  const FixedPoint p = PointOfNode(0, 1), q = PointOfNode(2, 3);
  const SlackBar left = String(kLeftEnd, p, 0.6), middle = String(q, p, 0.6), right = String(q, kRightEnd, 0.5);
  Laws laws;
  for (const SlackBar* bar : {&left, &middle, &right}) laws.Add(bar);
  FixedModeSystem system(structure, laws);
  system.SetModes({kTaut, kTaut, kTaut});
  Random random(5);
  const VectorXd x = random.Vector(system.NumUnknowns(), 0.1, 0.4) + VectorXd::Unit(system.NumUnknowns(), 2),
                 dx = random.Vector(system.NumUnknowns(), -1.0, 1.0);
  ExpectDerivativesMeetDifferences(&system, x, dx);
}

// The load is k x + EA x - EA (0.1 - x) / 0.9 until x = 0.1, and k x + EA x beyond; and back.
TEST_F(NodeOnTwoStrings, GoesSlackAndComesBackTaut) {
  for (const bool away : {true, false}) {
    ModeArc arc(structure_, laws_);
    const Step step = StepFrom(&arc, At(away ? 0.05 : 0.15), away ? 0.1 : -0.1);
    const StepEvent event = FirstEvent(&arc, step);
    ASSERT_EQ(event.Kind(), EventKind::kContactEvent) << away;
    EXPECT_EQ(event.fails->law, 1);
    const std::optional<CurvePoint> located = Locate(&arc, step, event);
    ASSERT_TRUE(located);
    EXPECT_NEAR(located->x[0], 0.1, kExact);
    EXPECT_NEAR(located->x[2], (stiffness_ + kEA) * 0.1, kExact);
    const PathPoint point = arc.system().Unpack(located->x);
    Arrival arrival;
    arrival.direction = located->first.head(3);
    const BranchSet set = FindBranches(structure_, laws_, point, arrival, ActiveSetTolerance());
    ASSERT_EQ(set.branches.size(), 1U);
    EXPECT_EQ(set.branches[0].modes, (Modes{kTaut, away ? kSlack : kTaut}));
    EXPECT_EQ(set.branches[0].dissipation_rate, 0.0);
    const double slope = stiffness_ + kEA + (away ? 0.0 : kEA / kRight);
    EXPECT_NEAR(set.branches[0].load_rate / set.branches[0].direction[0], slope, 1e-9);
    PathPoint beyond = point;
    beyond.modes = set.branches[0].modes;
    const double x = away ? 0.2 : 0.02;
    const PathPoint there = arc.system().Unpack(StepFrom(&arc, beyond, x - 0.1).end.x);
    EXPECT_NEAR(there.s, At(there.u[0]).s, kExact);
    EXPECT_NEAR(there.forces[1], Right(there.u[0]), kExact);
    EXPECT_NEAR(laws_.Energy(there),
                0.5 * Left(there.u[0]) * Left(there.u[0]) / kEA + 0.5 * kRight * std::pow(Right(there.u[0]), 2) / kEA,
                kExact);
  }
}

// The pair of a bar is its force and its slack, of which one is zero.
TEST_F(NodeOnTwoStrings, RatesAreOneComplementarityProblem) {
  PathPoint point = At(0.1);
  std::vector<Modes> options;
  for (std::size_t i = 0; i < laws_.size(); ++i) options.push_back(laws_.ModesAt(point, i, ActiveSetTolerance()));
  EXPECT_EQ(options[0].size(), 1U);
  EXPECT_EQ(options[1].size(), 2U);
  const std::vector<int> weakly_active = {1};
  const RateProblem rates(structure_, laws_, point, point.modes, weakly_active, Vector3d(1.0, 0.0, 1.0).normalized());
  ASSERT_TRUE(rates.regular());
  const RatePairs pairs(laws_, options, weakly_active);
  const RateComplementarity problem(pairs, rates);
  EXPECT_TRUE(problem.exists() && problem.unique());
  for (const double sense : {1.0, -1.0}) {
    const std::vector<States> solutions = problem.Solve(sense);
    ASSERT_EQ(solutions.size(), 1U);
    EXPECT_EQ(solutions[0], (States{kTaut.state, (sense > 0.0 ? kSlack : kTaut).state}));
  }
}

// Springs that push away from the middle: strings that are taut hold the node, slack ones do not.
class NodePushedAway : public NodeOnTwoStrings {
 protected:
  NodePushedAway() : NodeOnTwoStrings(-1.0) {}
};

TEST_F(NodePushedAway, IsStableWhereStringsHoldIt) {
  StabilityProblem problem(structure_, laws_);
  for (const bool taut : {true, false}) {
    PathPoint point = At(0.15);
    if (!taut) point.modes[0] = kSlack;
    problem.Set(point, {});
    const Stability found = problem.Under(INFINITY);
    EXPECT_EQ(found.verdict, taut ? Verdict::kStable : Verdict::kUnstable);
    EXPECT_EQ(found.directions, taut ? 0 : 1);
  }
}

// Without a load and in the middle of slack strings it leaves, and the next string stops it: -x + EA (x - 0.2) / 1.2 =
// 0 with EA = 2 where a string of the length 1.2 is taut.
TEST_F(NodePushedAway, JumpsUntilAStringIsTaut) {
  const SlackBar left = String(kLeftEnd, kNode, 1.2), right = String(kNode, kRightEnd, 1.2);
  Laws laws;
  laws.Add(&left);
  laws.Add(&right);
  PathPoint from = At(0.0);
  from.s = 0.0;
  from.forces.setZero();
  from.modes = {kSlack, kSlack};
  for (const double sign : {1.0, -1.0}) {
    const JumpResult jump = Jump(structure_, laws, from, Vector2d(sign, 0.0), {}, true, nullptr);
    ASSERT_TRUE(jump.landing) << sign;
    const double x = sign * 0.2 * kEA / (kEA - 1.2);
    EXPECT_NEAR(jump.landing->point.u[0], x, 1e-9);
    EXPECT_EQ(jump.landing->point.modes, (sign > 0.0 ? Modes{kTaut, kSlack} : Modes{kSlack, kTaut}));
    EXPECT_NEAR(jump.landing->stored, -0.5 * x * x + 0.5 * kEA / 1.2 * std::pow(std::abs(x) - 0.2, 2), 1e-9);
  }
}

}  // namespace
}  // namespace contact_path::slack_bar_test
