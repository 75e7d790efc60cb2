#include "contact_path/branch/smooth_arc.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "branch/traced_arc.h"
#include "contact_path/path/model.h"
#include "support/reference_cases.h"
#include "support/traced_path.h"

namespace contact_path::smooth_arc_test {
namespace {

using Eigen::VectorXd;

TracedPath Trace(const std::string& scene, int increments) {
  TraceRequest request = ReadExample(scene);
  request.options.max_increments = increments;
  return TraceIncrements(request);
}

// Arcs with slip, stick, a free structure, rigid modes, and many unknowns.
std::vector<std::pair<std::string, std::size_t>> Arcs() {
  return {{"sliding_bar", 20}, {"sliding_bar", 60}, {"rough_truss", 5}, {"von_mises", 10},
          {"von_mises", 50},   {"arch19", 40},      {"arch19", 150}};
}

constexpr int kIncrements = 160;

TEST(SmoothArc, DerivativesAreTheUnitTangentAndTheCurvature) {
  for (const auto& [scene, index] : Arcs()) {
    SCOPED_TRACE(scene + " increment " + std::to_string(index));
    TracedArc traced(Trace(scene, kIncrements), index);
    const CurvePoint& start = traced.start();
    const Eigen::Index n = traced.motion();
    EXPECT_NEAR(start.first.head(n).norm(), 1.0, 1e-14);
    EXPECT_NEAR(start.first.head(n).dot(start.second.head(n)), 0.0, 1e-13 * (1.0 + start.second.norm()));
    // By differences of points of the curve: the parameter of the plane is arc length up to the third order.
    for (const auto order : {1, 2}) {
      VectorXd previous, best;
      double change = 1e9;
      for (double h = 0.016; h > 1e-3; h *= 0.5) {  // Richardson: O(h^4)
        const auto difference = [&](double step) {
          if (order == 1) return VectorXd((traced.At(step).x - traced.At(-step).x) / (2.0 * step));
          return VectorXd((traced.At(step).x - 2.0 * start.x + traced.At(-step).x) / (step * step));
        };
        const VectorXd estimate = (4.0 * difference(0.5 * h) - difference(h)) / 3.0;
        if (previous.size() > 0 && (estimate - previous).norm() < change) {
          change = (estimate - previous).norm();
          best = estimate;
        }
        previous = estimate;
      }
      const VectorXd& given = order == 1 ? start.first : start.second;
      EXPECT_LE((best - given).norm() / (1.0 + given.norm()), order == 1 ? 1e-9 : 1e-6) << "order " << order;
    }
  }
}

TEST(SmoothArc, DirectionIsTheOneAskedFor) {
  TracedArc traced(Trace("sliding_bar", kIncrements), 20);
  CurvePoint back;
  ASSERT_TRUE(traced.arc().Derivatives(traced.start().x, -traced.normal(), &back));
  EXPECT_LE((back.first + traced.start().first).norm(), 1e-14);
  EXPECT_LE((back.second - traced.start().second).norm(), 1e-12);  // by arc length squared
  EXPECT_EQ(back.determinant_sign, -traced.start().determinant_sign);
  // No direction along what is orthogonal to the curve.
  VectorXd across = VectorXd::Zero(traced.motion());
  across[0] = traced.normal()[2];
  across[2] = -traced.normal()[0];
  CurvePoint none;
  EXPECT_FALSE(traced.arc().Derivatives(traced.start().x, across, &none));
}

TEST(SmoothArc, KeepsTheClosedFormOfTheSlidingBar) {
  TracedArc traced(Trace("sliding_bar", kIncrements), 20);
  const Scaling scaling = CharacteristicScales(sliding_bar::MakeScene());
  double worst = 0.0;
  for (double t = -0.2; t <= 0.2; t += 0.02) {
    const VectorXd x = traced.At(t).x;
    const double position = x[0] * scaling.length;
    worst = std::max({worst, std::abs(x[1]), std::abs(x[2] * scaling.load_factor - sliding_bar::LoadFactor(position)),
                      std::abs(x[3] * scaling.force - sliding_bar::NormalReaction(position))});
    // ds/dx of the tangent.
    CurvePoint point;
    ASSERT_TRUE(traced.arc().Derivatives(x, traced.normal(), &point));
    worst = std::max(worst, std::abs(point.first[2] * scaling.load_factor / (point.first[0] * scaling.length) -
                                     sliding_bar::LoadFactorSlope(position)));
  }
  EXPECT_LE(worst, 1e-13);
}

// Errors e of Newton's method: e(k+1) <= C e(k)^2 while the factorisation is renewed, then at least 1e-4 of the last.
TEST(SmoothArc, NewtonConvergesQuadratically) {
  for (const auto& [scene, index] : Arcs()) {
    SCOPED_TRACE(scene + " increment " + std::to_string(index));
    TracedArc traced(Trace(scene, kIncrements), index);
    std::vector<double> constants;
    for (const double t : {0.12, 0.08, 0.05, 0.03}) {
      const Eigen::VectorXd guess = traced.start().x + t * traced.start().first;
      Eigen::VectorXd row = Eigen::VectorXd::Zero(guess.size());
      row.head(traced.normal().size()) = traced.normal();
      const Correction correction = traced.arc().Correct(guess, row, row.dot(guess));
      ASSERT_TRUE(correction.converged);
      ASSERT_GE(correction.steps.size(), 3U);
      EXPECT_EQ(correction.iterations, static_cast<int>(correction.steps.size()));
      EXPECT_EQ(correction.first_step, correction.steps[0]);
      EXPECT_EQ(correction.contraction, correction.steps[1] / correction.steps[0]);
      EXPECT_LE(correction.steps.back(), 1e-13);
      EXPECT_LE(correction.iterations, 6);
      for (std::size_t k = 0; k + 1 < correction.steps.size() && correction.steps[k] > 1e-5; ++k)
        constants.push_back(correction.steps[k + 1] / (correction.steps[k] * correction.steps[k]));
      for (std::size_t k = 0; k + 1 < correction.steps.size(); ++k)
        EXPECT_LE(correction.steps[k + 1], std::max(0.2 * correction.steps[k], 1e-15 * correction.x.norm()));
    }
    // The constant is that of the curve, whatever the size of the first error.
    ASSERT_GE(constants.size(), 4U);
    const auto [smallest, largest] = std::minmax_element(constants.begin(), constants.end());
    EXPECT_LE(*largest, 30.0 * *smallest + 1e-3);
    EXPECT_LE(*largest, 100.0);
  }
}

TEST(SmoothArc, CorrectionStaysOnTheGivenPlane) {
  TracedArc traced(Trace("arch19", kIncrements), 40);
  const VectorXd guess = traced.start().x + 0.05 * traced.start().first;
  const Correction correction = traced.arc().CorrectOnPlane(guess, traced.normal());
  ASSERT_TRUE(correction.converged);
  EXPECT_NEAR(traced.normal().dot((correction.x - guess).head(traced.motion())), 0.0, 1e-14);
  // Any other row: here the load factor is prescribed.
  VectorXd row = VectorXd::Unit(guess.size(), traced.motion() - 1);
  const Correction at_load = traced.arc().Correct(guess, row, 0.031);
  ASSERT_TRUE(at_load.converged);
  EXPECT_NEAR(at_load.x[traced.motion() - 1], 0.031, 1e-15);
}

TEST(SmoothArc, NotConvergedWhereThereIsNoPoint) {
  // Rest at the stop: the node does not move, whatever the load.
  const TracedPath path = Trace("rigid_stop", kIncrements);
  TracedArc traced(path, path.increments.size() - 1);
  VectorXd guess = traced.start().x;
  const VectorXd row = VectorXd::Unit(guess.size(), 0);
  EXPECT_TRUE(traced.arc().Correct(guess, row, guess[0]).converged);
  EXPECT_FALSE(traced.arc().Correct(guess, row, guess[0] + 0.01).converged);
}

TEST(Step, EndsAreItsPoints) {
  for (const auto& [scene, index] : Arcs()) {
    SCOPED_TRACE(scene);
    TracedArc traced(Trace(scene, kIncrements), index);
    const Step step = traced.Between(0.0, 0.05);
    EXPECT_NEAR(step.length, 0.05, 1e-14);
    EXPECT_LE((step.Point(0.0) - step.start.x).norm(), 1e-15);
    EXPECT_LE((step.Point(step.length) - step.end.x).norm(), 1e-14);
    for (const double t : {0.0, step.length}) {
      const CurvePoint point = step.At(t);
      const CurvePoint& exact = t == 0.0 ? step.start : step.end;
      EXPECT_LE((point.first - exact.first).norm(), 1e-12);
      EXPECT_LE((point.second - exact.second).norm(), 1e-9 * (1.0 + exact.second.norm()));
    }
    const CurvePoint middle = step.At(0.02);
    EXPECT_NEAR(middle.first.head(traced.motion()).norm(), 1.0, 1e-14);
    EXPECT_NEAR(middle.first.head(traced.motion()).dot(middle.second.head(traced.motion())), 0.0, 1e-12);
  }
}

// Positions, load and reactions between the ends: error of order length^6; tangents length^5, curvatures length^4.
TEST(Step, InterpolatesWithOrderSix) {
  for (const auto& [scene, index] : Arcs()) {
    SCOPED_TRACE(scene + " increment " + std::to_string(index));
    TracedArc traced(Trace(scene, kIncrements), index);
    const auto errors = [&](double length) {
      const Step step = traced.Between(0.0, length);
      Eigen::Vector3d worst = Eigen::Vector3d::Zero();
      for (const double share : {0.3, 0.5, 0.7}) {
        const CurvePoint exact = traced.At(share * length), given = step.At(share * length);
        worst = worst.cwiseMax(Eigen::Vector3d((given.x - exact.x).norm(), (given.first - exact.first).norm(),
                                               (given.second - exact.second).norm()));
      }
      return worst;
    };
    const double length = 0.08;
    const Eigen::Vector3d coarse = errors(length), fine = errors(0.5 * length);
    for (const int order : {6, 5, 4}) {
      const Eigen::Index k = 6 - order;
      if (fine[k] < (k == 0 ? 1e-13 : 1e-12)) continue;  // rounding; derivatives solve linear systems
      EXPECT_NEAR(std::log2(coarse[k] / fine[k]), order, 0.6) << coarse[k] << " " << fine[k];
    }
    EXPECT_LE(errors(0.02)[0], 1e-10);
  }
}

TEST(Step, InterpolatesFunctionsThatAreLinearInX) {
  TracedArc traced(Trace("sliding_bar", kIncrements), 20);
  const Step step = traced.Between(0.0, 0.04);
  const auto load = [&](const VectorXd& x) { return x[traced.motion() - 1]; };
  const Quintic polynomial = step.InterpolateLinear(load);
  for (double t = 0.0; t <= step.length; t += 0.004) EXPECT_NEAR(Evaluate(polynomial, t), load(step.Point(t)), 1e-15);
}

TEST(Step, ArcLengthIsThatOfTheCurve) {
  for (const auto& [scene, index] : Arcs()) {
    SCOPED_TRACE(scene);
    TracedArc traced(Trace(scene, kIncrements), index);
    // Chords with Richardson's extrapolation: their sum has an error of h^2, h^4, ...
    const auto exact = [&](double length) {
      const auto chords = [&](int count) {
        double sum = 0.0;
        VectorXd before = traced.start().x;
        for (int i = 1; i <= count; ++i) {
          const VectorXd now = traced.At(length * i / count).x;
          sum += (now - before).head(traced.motion()).norm();
          before = now;
        }
        return sum;
      };
      const double c1 = chords(8), c2 = chords(16), c3 = chords(32);
      const double r1 = (4.0 * c2 - c1) / 3.0, r2 = (4.0 * c3 - c2) / 3.0;
      return (16.0 * r2 - r1) / 15.0;
    };
    EXPECT_NEAR(traced.Between(0.0, 0.08).ArcLength(), exact(0.08), 1e-8);
    EXPECT_NEAR(traced.Between(0.0, 0.02).ArcLength(), exact(0.02), 1e-12);
    EXPECT_GE(traced.Between(0.0, 0.08).ArcLength(), 0.08);
  }
}

// Each step of a traced path, made again in two halves, ends at the same point.
TEST(SmoothArc, TwoHalvesEndWhereTheWholeStepDoes) {
  double worst = 0.0;
  int arcs = 0;
  for (const char* scene : {"sliding_bar", "rough_truss", "two_dof_friction", "von_mises", "rigid_stop", "arch19"}) {
    const TracedPath path = Trace(scene, 1000);
    for (std::size_t i = 1; i < path.increments.size(); ++i) {
      TracedArc traced(path, i);
      const double length = traced.normal().dot((traced.end() - traced.start().x).head(traced.motion()));
      const CurvePoint half = traced.At(0.5 * length);
      VectorXd row = VectorXd::Zero(half.x.size());
      row.head(traced.motion()) = traced.normal();
      const Correction rest = traced.arc().Correct(
          half.x + 0.5 * length * half.first + 0.125 * length * length * half.second, row, row.dot(traced.end()));
      ASSERT_TRUE(rest.converged) << scene << " increment " << i;
      worst = std::max(worst, (rest.x - traced.end()).norm() / (1.0 + traced.end().norm()));
      ++arcs;
    }
  }
  EXPECT_LE(worst, 1e-12);
  EXPECT_GE(arcs, 500);
}

TEST(SmoothArc, CountsNullDirections) {
  // A bar on a hinge: one rigid mode that neither load nor reactions know of.
  Scene scene;
  scene.nodes = {{"a", 0.0, 0.0, true, true},
                 {"b", 1.0, 0.0, false, false},
                 {"c", 0.5, 1.0, true, true},
                 {"d", 1.5, 1.0, false, true}};
  scene.bars = {{{"a", "b"}, 1.0, 0.0, StrainMeasure::kBiot}, {{"c", "d"}, 1.0, 0.0, StrainMeasure::kBiot}};
  scene.loads = {{"d", 1.0, 0.0, false}};
  const Model model(scene, CharacteristicScales(scene));
  SmoothArc arc(model.structure, model.contacts);
  const PathPoint start = model.InitialPoint();
  arc.SetStates(start.states, start);
  CurvePoint point;
  ASSERT_TRUE(arc.Derivatives(arc.system().Pack(start), Eigen::Vector4d(0.0, 0.0, 0.0, 1.0), &point));
  EXPECT_EQ(point.nullity, 1);
  EXPECT_EQ(point.determinant_sign, 0);
  // The shortest motion leaves b where it is.
  EXPECT_LE((point.first - Eigen::Vector4d(0.0, 0.0, 1.0, 1.0).normalized()).norm(), 1e-14);
}

}  // namespace
}  // namespace contact_path::smooth_arc_test
