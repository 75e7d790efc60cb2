#include "contact_path/contact/rigid_pair.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "contact_path/geometry/point_curves.h"
#include "support/curved_contacts.h"
#include "support/curved_obstacles.h"
#include "support/derivative_checker.h"
#include "support/kinematics.h"
#include "support/points.h"
#include "support/random.h"

namespace contact_path::rigid_pair_test {
namespace {

constexpr double kRounding = 1e-13;

// The pairs of CurvedContacts(), and more with obstacles that turn, or have patches.
class RigidPairs : public testing::Test {
 protected:
  struct Case {
    const ContactPair* pair;
    int patch;
    Eigen::VectorXd q;  // a place beside the patch
  };

  RigidPairs() {
    for (const auto& pair : contacts_)
      cases_.push_back({pair.get(), 0, LocalOf(pair->Dofs(0), structure_.Start(), 0.3)});
    const Eigen::Vector2d velocity(0.3, -0.2), about(0.4, 0.9);
    const Eigen::Vector3d q(0.7, 0.6, 0.3);
    Add(std::make_shared<HalfPlane>(Eigen::Vector2d(0.0, 0.1), Eigen::Vector2d(-0.2, 1.0)), velocity, 1.3, about, q, 0);
    Add(std::make_shared<Spiral>(0.3, -0.4, 0.5), velocity, -0.9, about, q, 0);
    for (const bool inside : {false, true})
      for (const int patch : {0, 1, -3}) {
        const std::shared_ptr<const Surface> round = MakeCircle({0.2, -0.3}, 0.8, inside);
        Add(round, velocity, 0.7, about, q, patch);
      }
    const std::shared_ptr<const Surface> spline = MakeSpline({{-1.0, 0.2}, {0.1, 0.4}, {0.8, 0.1}, {2.0, 0.5}}, false);
    for (const double turn : {0.0, 0.4})
      for (const int patch : {-1, 0, 1, 2, 3}) Add(spline, velocity, turn, about, q, patch);
    // A node that is held in x.
    const MovingPlace held = MovingPlace::SeenFrom(MovedFrame(velocity, 0.8, about), PointOfNode(-1, 1, {0.7, 0.0}));
    more_.push_back(std::make_unique<RigidPair>(spline, held, 0.3));
    cases_.push_back({more_.back().get(), 1, Eigen::Vector2d(0.6, 0.3)});
  }
  void Add(const std::shared_ptr<const Surface>& surface, const Eigen::Vector2d& velocity, double turn,
           const Eigen::Vector2d& about, const Eigen::VectorXd& q, int patch) {
    const MovingPlace motion = MovingPlace::SeenFrom(MovedFrame(velocity, turn, about), PointOfNode(0, 1));
    more_.push_back(std::make_unique<RigidPair>(surface, motion, 0.3));
    cases_.push_back({more_.back().get(), patch, q});
  }
  // u and s with the entries q of a pair.
  Eigen::VectorXd At(const ContactPair& pair, const Eigen::VectorXd& q) const {
    Eigen::VectorXd x(structure_.NumDofs() + 1);
    x << structure_.Start(), 0.0;
    const LawDofs dofs = pair.Dofs(0);
    for (std::size_t k = 0; k < dofs.size(); ++k) x[dofs[k]] = q[static_cast<Eigen::Index>(k)];
    x[structure_.NumDofs()] = q[q.size() - 1];
    return x;
  }
  PortsAt Evaluate(const Case& of, const Eigen::VectorXd& q) const {
    const Eigen::VectorXd x = At(*of.pair, q);
    return KinematicsAt(*of.pair, x, x[structure_.NumDofs()], of.patch);
  }

  const Scene scene_ = MovingScene();
  const Structure structure_{scene_};
  const ContactPairs contacts_ = CurvedContacts(structure_);
  ContactPairs more_;
  std::vector<Case> cases_;
  Random random_{2};
};

TEST_F(RigidPairs, GradientsMeetDifferencesAndTheirSparsityIsDeclared) {
  for (const Case& of : cases_) {
    const ContactPair& pair = *of.pair;
    const PortsAt at = Evaluate(of, of.q);
    const auto values = [&](const Eigen::VectorXd& to) {
      const PortsAt kinematics = Evaluate(of, to);
      return Eigen::Vector2d(kinematics[kNormal].motion, kinematics[kTangent].motion);
    };
    Eigen::MatrixXd gradients(2, of.q.size());
    gradients << at[kNormal].gradient.transpose(), at[kTangent].gradient.transpose();
    EXPECT_TRUE(IsJacobian(values, of.q, gradients, kDerivativeTolerance, 1e-3));
    for (std::size_t k = 0; k <= at.dofs.size(); ++k) {
      EXPECT_EQ(pair.Moves(kNormal, k), at[kNormal].gradient[static_cast<Eigen::Index>(k)] != 0.0);
      EXPECT_EQ(pair.Moves(kTangent, k), at[kTangent].gradient[static_cast<Eigen::Index>(k)] != 0.0);
    }
    const Eigen::VectorXd x = At(pair, of.q);
    if (pair.HasPatch(of.patch)) {
      EXPECT_NEAR(pair.Gap(x, 0.3, of.patch), at[kNormal].motion, kRounding);
    }
    EXPECT_LE(at[kNormal].gradient.norm(), pair.LargestReachRate());
  }
}

TEST_F(RigidPairs, HessiansMeetDifferences) {
  for (const Case& of : cases_) {
    if (!of.pair->Curved()) continue;
    const PortsAt at = Evaluate(of, of.q);
    const auto of_gap = [&](const Eigen::VectorXd& to) { return Eigen::VectorXd(Evaluate(of, to)[kNormal].gradient); };
    const auto of_xi = [&](const Eigen::VectorXd& to) { return Eigen::VectorXd(Evaluate(of, to)[kTangent].gradient); };
    EXPECT_TRUE(IsJacobian(of_gap, of.q, at[kNormal].hessian, kDerivativeTolerance, 1e-3));
    EXPECT_TRUE(IsJacobian(of_xi, of.q, at[kTangent].hessian, kDerivativeTolerance, 1e-3));
  }
}

TEST_F(RigidPairs, DerivativesOfHessiansMeetDifferences) {
  constexpr double kRn = 0.7, kRt = -0.4;
  for (const Case& of : cases_) {
    if (!of.pair->Curved()) continue;
    const Eigen::VectorXd x = At(*of.pair, of.q);
    const LawVector direction = random_.Vector(of.q.size(), -1.0, 1.0);
    const auto hessian = [&](const Eigen::VectorXd& h) {
      const PortsAt at = Evaluate(of, of.q + h[0] * direction);
      return Entries(kRn * at[kNormal].hessian + kRt * at[kTangent].hessian);
    };
    LawMatrix derivative;
    of.pair->ForceHessian(x, 0.3, of.patch, {kRn, kRt}, direction, &derivative);
    EXPECT_TRUE(IsJacobian(hessian, Eigen::VectorXd::Zero(1), Entries(derivative), kDerivativeTolerance, 1e-3));
  }
}

// Where friction changes with s: factor, force and its first two derivatives, and what a force works along.
TEST_F(RigidPairs, ForcesOfFrictionThatChangesMeetDifferences) {
  constexpr double kRn = 0.7, kRt = -0.4, kFriction = 0.3, kRate = 0.2;
  const Eigen::Vector2d velocity(0.3, -0.2), about(0.4, 0.9);
  const Eigen::Vector3d q(0.7, 0.6, 0.3);
  const std::shared_ptr<const Surface> spline = MakeSpline({{-1.0, 0.2}, {0.1, 0.4}, {0.8, 0.1}, {2.0, 0.5}}, false);
  const std::shared_ptr<const Surface> plane =
      std::make_shared<HalfPlane>(Eigen::Vector2d(0.0, 0.1), Eigen::Vector2d(-0.2, 1.0));
  for (const auto& surface : {plane, spline})
    for (const double turn : {0.0, 0.8}) {
      const RigidPair pair(surface, MovingPlace::SeenFrom(MovedFrame(velocity, turn, about), PointOfNode(0, 1)),
                           kFriction, Eigen::VectorXd(), std::nullopt, 0.0, {}, kRate);
      const int patch = surface == plane ? 0 : 1;
      const auto evaluate = [&](const Eigen::VectorXd& at) { return KinematicsAt(pair, at, at[2], patch); };
      const auto force = [&](const Eigen::VectorXd& at) {
        const PortsAt ports = evaluate(at);
        return Eigen::VectorXd(kRn * ports[kNormal].gradient + kRt * ports[kTangent].factor * ports[kTangent].gradient);
      };
      const auto change = [&](const Eigen::VectorXd& at) { return evaluate(at).ForceChange({kRn, kRt}); };
      const Eigen::VectorXd direction = random_.Vector(3, -1.0, 1.0), bend = random_.Vector(3, -1.0, 1.0);
      EXPECT_NEAR(evaluate(q)[kTangent].factor, 1.0 + kRate * q[2] / kFriction, kRounding);
      EXPECT_NEAR(pair.OnRecord(q, q[2], kRt), kRt * evaluate(q)[kTangent].factor, kRounding);
      EXPECT_NEAR(pair.FromRecord(q, q[2], pair.OnRecord(q, q[2], kRt)), kRt, kRounding);
      EXPECT_TRUE(IsJacobian(force, q, change(q).transpose(), kDerivativeTolerance, 1e-3));
      LawMatrix hessian;
      pair.ForceHessian(q, q[2], patch, {kRn, kRt}, direction, &hessian);
      const auto weighted = [&](const Eigen::VectorXd& at) { return Eigen::VectorXd(change(at) * direction); };
      EXPECT_TRUE(IsJacobian(weighted, q, hessian, kDerivativeTolerance, 1e-3));
      const auto along = [&](const Eigen::VectorXd& h) {
        return Eigen::VectorXd(change(q + h[0] * direction).transpose() * direction);
      };
      const LawVector second = pair.SecondDirectional(q, q[2], patch, {kRn, kRt}, direction);
      EXPECT_TRUE(IsJacobian(along, Eigen::VectorXd::Zero(1), second, kDerivativeTolerance, 1e-3));
      const Eigen::Vector3d factor = pair.FactorAlong(kTangent, q, q[2], patch, direction, bend);
      const auto rate = [&](const Eigen::VectorXd& h) {
        const PortsAt at = evaluate(q + h[0] * direction + 0.5 * h[0] * h[0] * bend);
        return Eigen::Vector2d(at[kTangent].factor, at[kTangent].factor_gradient.dot(direction + h[0] * bend));
      };
      EXPECT_NEAR(factor[0], evaluate(q)[kTangent].factor, kRounding);
      EXPECT_TRUE(IsJacobian(rate, Eigen::VectorXd::Zero(1), factor.tail<2>(), kDerivativeTolerance, 1e-3));
      const double step = 1e-4, ds = step * direction[2];
      EXPECT_NEAR(pair.Travel(kTangent, q, q[2], patch, step * direction.head(2), ds, patch) / step,
                  pair.TravelRate(kTangent, q, q[2], patch, direction.head(2), direction[2]), 10.0 * step);
    }
}

// A node that turns with its obstacle stays where it is on the surface.
TEST_F(RigidPairs, WhatTurnsAndMovesWithTheObstacleStaysOnItsSurface) {
  const Eigen::Vector2d velocity(0.3, -0.2), about(0.4, 0.9), place(0.7, 0.6);
  const std::shared_ptr<const Surface> spline = MakeSpline({{-1.0, 0.2}, {0.1, 0.4}, {0.8, 0.1}, {2.0, 0.5}}, false);
  const RigidPair pair(spline, MovingPlace::SeenFrom(MovedFrame(velocity, 0.5, about), PointOfNode(0, 1)), 0.3);
  const int patch = pair.PatchAt(place, 0.0);
  for (const double s : {-3.0, 1.0, 20.0}) {
    const Eigen::Vector2d arm = place - about;
    const double c = std::cos(0.5 * s), r = std::sin(0.5 * s);
    const Eigen::VectorXd u =
        about + Eigen::Vector2d(c * arm.x() - r * arm.y(), r * arm.x() + c * arm.y()) + s * velocity;
    EXPECT_EQ(pair.PatchAt(u, s), patch);
    EXPECT_NEAR(pair.Gap(u, s, patch), pair.Gap(place, 0.0, patch), kRounding);
    EXPECT_NEAR(pair.Xi(u, s, patch), pair.Xi(place, 0.0, patch), kRounding);
  }
}

// Before the first patch and after the last one there is nothing to touch, and the end is what is near.
TEST_F(RigidPairs, PastTheEndsOfAnOpenSurfaceTheGapIsTheDistanceFromTheEnd) {
  const std::shared_ptr<const Surface> line = RoundedPolyline({{0.0, 0.0}, {1.0, 0.0}, {3.0, 1.0}}, false, 0.2);
  const RigidPair pair(line, MovingPlace(PointOfNode(0, 1)), 0.3);
  EXPECT_TRUE(pair.HasPatches());
  const Eigen::VectorXd before = Eigen::Vector2d(-0.3, 0.4), on = Eigen::Vector2d(0.3, 0.4),
                        past = Eigen::Vector2d(3.3, 1.4);
  EXPECT_EQ(pair.PatchAt(before, 0.0), -1);
  EXPECT_EQ(pair.PatchAt(on, 0.0), 0);
  EXPECT_EQ(pair.PatchAt(past, 0.0), 3);
  EXPECT_FALSE(pair.HasPatch(-1) || pair.HasPatch(3));
  EXPECT_NEAR(pair.Gap(before, 0.0, -1), 0.5, kRounding);
  EXPECT_NEAR(pair.Gap(on, 0.0, 0), 0.4, kRounding);
  EXPECT_NEAR(pair.Gap(past, 0.0, 3), 0.5, kRounding);
  EXPECT_NEAR(pair.Xi(before, 0.0, -1), -0.3, kRounding);
  EXPECT_EQ(pair.RangeOf(-1).end, pair.RangeOf(0).begin);
  EXPECT_EQ(pair.RangeOf(3).begin, pair.RangeOf(2).end);
  EXPECT_TRUE(std::isinf(pair.RangeOf(-1).begin) && std::isinf(pair.RangeOf(3).end));
}

TEST_F(RigidPairs, SlipRunsOnOverPatches) {
  const std::shared_ptr<const Surface> line = RoundedPolyline({{0.0, 0.0}, {1.0, 0.0}, {3.0, 1.0}}, false, 0.2);
  const RigidPair pair(line, MovingPlace(PointOfNode(0, 1)), 0.3);
  const Eigen::VectorXd from = Eigen::Vector2d(0.2, 0.0), to = Eigen::Vector2d(2.0, 0.5);
  const double turn = std::atan(0.5), cut = 0.2 * std::tan(0.5 * turn);
  EXPECT_NEAR(pair.Travel(kTangent, from, 0.0, 0, to - from, 0.0, 2),
              0.8 + std::hypot(1.0, 0.5) - 2.0 * cut + 0.2 * turn, kRounding);
}

// A node that slides on a disc from its top by a quarter of a circle at the distance g.
TEST(RigidPair, OfADiscHasTheClosedForm) {
  const auto disc = std::make_shared<DiscOutside>(Eigen::Vector2d(1.0, 2.0), 0.5);
  const RigidPair pair(disc, MovingPlace(PointOfNode(0, 1)), 0.3);
  const Eigen::VectorXd top = Eigen::Vector2d(1.0, 2.75), right = Eigen::Vector2d(1.75, 2.0);
  EXPECT_NEAR(pair.Gap(top, 0.0, 0), 0.25, kRounding);
  EXPECT_NEAR(pair.Gap(right, 0.0, 0), 0.25, kRounding);
  EXPECT_NEAR(pair.Travel(kTangent, top, 0.0, 0, right - top, 0.0, 0), 0.5 * std::acos(-1.0) / 2.0, kRounding);
  // The foot moves slower than the node, by the ratio of the radii.
  EXPECT_NEAR(pair.TravelRate(kTangent, top, 0.0, 0, Eigen::Vector2d(1.0, 0.0), 0.0), 0.5 / 0.75, kRounding);
}

// Twice round a circle, one way and the other: xi grows by the way along it.
TEST(RigidPair, PatchesGoRoundAClosedSurface) {
  constexpr double kRadius = 0.5;
  const std::shared_ptr<const Surface> circle = MakeCircle({1.0, 2.0}, kRadius, false);
  const RigidPair pair(circle, MovingPlace(PointOfNode(0, 1)), 0.3);
  for (const double turn : {0.3, -0.3}) {
    int patch = 0;
    for (int i = 0; i < 42; ++i) {
      const double angle = turn * i;
      const Eigen::VectorXd x = Eigen::Vector2d(1.0 + 0.6 * std::sin(angle), 2.0 + 0.6 * std::cos(angle));
      patch = pair.PatchAfter(x, 0.0, patch);
      EXPECT_NEAR(pair.Xi(x, 0.0, patch), kRadius * angle, 20.0 * kRounding) << angle;
    }
  }
}

TEST(RigidPair, XiIsMeasuredFromTheReference) {
  const RigidPair pair(std::make_shared<HalfPlane>(Eigen::Vector2d(0.0, 1.0), Eigen::Vector2d(0.0, 2.0)),
                       MovingPlace(PointOfNode(0, -1, {7.0, 1.25})), 0.3);
  PortsAt at;
  pair.Evaluate(Eigen::VectorXd::Constant(1, 3.0), 0.0, 0, {0.0, 2.5}, &at);
  EXPECT_EQ(at[kTangent].motion, 0.5);
  EXPECT_EQ(at[kNormal].motion, 0.25);
  EXPECT_EQ(std::vector<int>(at.dofs.begin(), at.dofs.end()), std::vector<int>{0});
}

// On a circle, where less than half a round tells in which sense.
TEST(RigidPair, HasSlippedFromItsOriginByTheTotalLawOnly) {
  constexpr double kRadius = 0.5;
  const std::shared_ptr<const Surface> circle = MakeCircle({1.0, 2.0}, kRadius, false);
  const auto at = [](double angle) {
    return Eigen::Vector2d(1.0 + 0.6 * std::sin(angle), 2.0 + 0.6 * std::cos(angle));
  };
  const MovingPlace motion(PointOfNode(0, 1));
  const RigidPair total(circle, motion, 0.3, Eigen::VectorXd(), at(3.0)), incremental(circle, motion, 0.3);
  for (const double angle : {0.5, 2.9, 3.0, 3.3, 6.0}) {
    const Eigen::VectorXd x = at(angle);
    EXPECT_NEAR(total.Slipped(x, 0.0, kNearestPatch), kRadius * (angle - 3.0), 20.0 * kRounding) << angle;
    EXPECT_EQ(incremental.Slipped(x, 0.0, kNearestPatch), 0.0);
  }
}

}  // namespace
}  // namespace contact_path::rigid_pair_test
