#include "contact_path/contact/deformable_pair.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "support/deformable_contacts.h"
#include "support/derivative_checker.h"
#include "support/kinematics.h"
#include "support/random.h"

namespace contact_path::deformable_pair_test {
namespace {

constexpr double kRounding = 1e-13;
constexpr double kRn = 0.7, kRt = -0.4;

// The reactions of a contact on all dofs, which are x and y of nodes in turn: the sum of the forces, and of their
// moments about the origin.
void ExpectBalance(const PortsAt& at, const Eigen::VectorXd& u) {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(u.size());
  at.AddForce(at[kNormal].gradient, kRn, &force);
  at.AddForce(at[kTangent].gradient, kRt * at[kTangent].factor, &force);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double moment = 0.0;
  for (Eigen::Index k = 0; k < force.size(); k += 2) {
    sum += force.segment<2>(k);
    moment += u[k] * force[k + 1] - u[k + 1] * force[k];
  }
  EXPECT_LE(sum.norm(), kRounding);
  EXPECT_NEAR(moment, 0.0, kRounding);
}

class DeformablePairs : public testing::Test {
 protected:
  struct Case {
    DeformableContact contact;
    int patch;
    std::string name;
  };

  DeformablePairs() {
    for (const bool closed : {false, true})
      for (const double radius : {0.0, 0.15})
        for (const int patch : {0, 1, 2, 4, -1, 7}) {
          if (!closed && (patch < 0 || patch > 4)) continue;
          for (const bool hold_some : {false, true}) {
            Case of = {DeformableContact(5, closed, radius, 0.3, hold_some), patch,
                       (closed ? "closed " : "open ") + std::to_string(radius) + " " + std::to_string(patch)};
            of.contact.u += random_.Vector(of.contact.u.size(), -0.05, 0.05);
            of.contact.PutBeside(patch, 0.37, 0.12);
            cases_.push_back(std::move(of));
          }
        }
  }
  static PortsAt At(const Case& of, const Eigen::VectorXd& u) {
    return KinematicsAt(*of.contact.pair, u, 0.0, of.patch);
  }
  // u with the entries q of the pair.
  static Eigen::VectorXd Moved(const Case& of, const Eigen::VectorXd& q) {
    Eigen::VectorXd u = of.contact.u;
    const LawDofs dofs = of.contact.pair->Dofs(of.patch);
    for (std::size_t k = 0; k < dofs.size(); ++k) u[dofs[k]] = q[static_cast<Eigen::Index>(k)];
    return u;
  }
  static Eigen::VectorXd Start(const Case& of) { return LocalOf(of.contact.pair->Dofs(of.patch), of.contact.u, 0.0); }
  // r_n grad u_n + r_t c grad xi.
  static LawVector Force(const PortsAt& at) {
    return kRn * at[kNormal].gradient + kRt * at[kTangent].factor * at[kTangent].gradient;
  }

  Random random_{3};
  std::vector<Case> cases_;
};

TEST_F(DeformablePairs, GradientsMeetDifferences) {
  for (const Case& of : cases_) {
    const PortsAt at = At(of, of.contact.u);
    const auto values = [&](const Eigen::VectorXd& q) {
      const PortsAt moved = At(of, Moved(of, q));
      return Eigen::Vector3d(moved[kNormal].motion, moved[kTangent].motion, moved[kTangent].factor);
    };
    Eigen::MatrixXd gradients(3, at[kNormal].gradient.size());
    gradients << at[kNormal].gradient.transpose(), at[kTangent].gradient.transpose(),
        at[kTangent].factor_gradient.transpose();
    EXPECT_TRUE(IsJacobian(values, Start(of), gradients, kDerivativeTolerance, 1e-3)) << of.name;
    EXPECT_NEAR(of.contact.pair->Gap(of.contact.u, 0.0, of.patch), at[kNormal].motion, kRounding);
    EXPECT_NEAR(at[kNormal].motion, 0.12, 1e-2) << of.name;
    EXPECT_LE(at[kNormal].gradient.norm(), of.contact.pair->LargestReachRate());
  }
}

TEST_F(DeformablePairs, HessiansMeetDifferences) {
  for (const Case& of : cases_) {
    const PortsAt at = At(of, of.contact.u);
    const auto of_gap = [&](const Eigen::VectorXd& q) {
      return Eigen::VectorXd(At(of, Moved(of, q))[kNormal].gradient);
    };
    const auto of_xi = [&](const Eigen::VectorXd& q) {
      return Eigen::VectorXd(At(of, Moved(of, q))[kTangent].gradient);
    };
    EXPECT_TRUE(IsJacobian(of_gap, Start(of), at[kNormal].hessian, kDerivativeTolerance, 1e-3)) << of.name;
    EXPECT_TRUE(IsJacobian(of_xi, Start(of), at[kTangent].hessian, kDerivativeTolerance, 1e-3)) << of.name;
  }
}

TEST_F(DeformablePairs, ChangesOfTheForceMeetDifferences) {
  for (const Case& of : cases_) {
    const PortsAt at = At(of, of.contact.u);
    const auto force = [&](const Eigen::VectorXd& q) { return Eigen::VectorXd(Force(At(of, Moved(of, q)))); };
    const Eigen::MatrixXd change = at.ForceChange({kRn, kRt}).transpose();
    EXPECT_TRUE(IsJacobian(force, Start(of), change, kDerivativeTolerance, 1e-3)) << of.name;
  }
}

TEST_F(DeformablePairs, SecondDerivativesOfTheForceMeetDifferences) {
  for (const Case& of : cases_) {
    const DeformablePair& pair = *of.contact.pair;
    const LawVector direction = random_.Vector(Start(of).size(), -1.0, 1.0);
    const auto along = [&](const Eigen::VectorXd& h) {
      const PortsAt at = At(of, Moved(of, Start(of) + h[0] * direction));
      return Eigen::VectorXd(at.ForceChange({kRn, kRt}).transpose() * direction);
    };
    const LawVector second = pair.SecondDirectional(of.contact.u, 0.0, of.patch, {kRn, kRt}, direction);
    EXPECT_TRUE(IsJacobian(along, Eigen::VectorXd::Zero(1), second, kDerivativeTolerance, 1e-3)) << of.name;
    const auto weighted = [&](const Eigen::VectorXd& q) {
      return Eigen::VectorXd(At(of, Moved(of, q)).ForceChange({kRn, kRt}) * direction);
    };
    LawMatrix hessian;
    pair.ForceHessian(of.contact.u, 0.0, of.patch, {kRn, kRt}, direction, &hessian);
    EXPECT_TRUE(IsJacobian(weighted, Start(of), hessian, kDerivativeTolerance, 1e-3)) << of.name;
  }
}

TEST_F(DeformablePairs, SlipFactorAlongACurveMeetsDifferences) {
  for (const Case& of : cases_) {
    const LawVector first = random_.Vector(Start(of).size(), -0.5, 0.5);
    const LawVector second = random_.Vector(Start(of).size(), -0.5, 0.5);
    const auto on_curve = [&](double h) { return Moved(of, Start(of) + h * first + 0.5 * h * h * second); };
    const auto rate = [&](const Eigen::VectorXd& h) {
      const PortsAt at = At(of, on_curve(h[0]));
      return Eigen::Vector2d(at[kTangent].factor, at[kTangent].factor_gradient.dot(first + h[0] * second));
    };
    const Eigen::Vector3d along = of.contact.pair->FactorAlong(kTangent, of.contact.u, 0.0, of.patch, first, second);
    EXPECT_NEAR(along[0], At(of, of.contact.u)[kTangent].factor, kRounding);
    EXPECT_TRUE(IsJacobian(rate, Eigen::VectorXd::Zero(1), along.tail<2>(), kDerivativeTolerance, 1e-3)) << of.name;
  }
}

// On the surface itself the force on the node is r_n n + r_t t.
TEST_F(DeformablePairs, OnTheSurfaceTheForceOnTheNodeIsTheReaction) {
  for (Case& of : cases_) {
    of.contact.PutBeside(of.patch, 0.6, 0.0);
    const PortsAt at = At(of, of.contact.u);
    Eigen::VectorXd force = Eigen::VectorXd::Zero(of.contact.u.size());
    at.AddForce(at[kNormal].gradient, kRn, &force);
    at.AddForce(at[kTangent].gradient, kRt * at[kTangent].factor, &force);
    const Eigen::Vector2d n = of.contact.Shape().Project(of.contact.u.tail<2>(), of.patch).normal;
    EXPECT_NEAR(at[kNormal].motion, 0.0, kRounding);
    EXPECT_LE((force.tail<2>() - kRn * n - kRt * TangentOf(n)).norm(), kRounding) << of.name;
  }
}

// Where patches meet: gap, xi, their gradients and the slip factor without a radius go on as they are.
TEST_F(DeformablePairs, GoesOnFromPatchToPatch) {
  for (const Case& of : cases_) {
    if (!of.contact.pair->HasPatch(of.patch + 1)) continue;
    DeformableContact contact(5, of.contact.boundary->Spline().Closed(), 0.0);
    contact.PutBeside(of.patch, 1.0, 0.1);
    PortsAt before = KinematicsAt(*contact.pair, contact.u, 0.0, of.patch);
    PortsAt after = KinematicsAt(*contact.pair, contact.u, 0.0, of.patch + 1);
    EXPECT_NEAR(before[kTangent].motion, contact.pair->RangeOf(of.patch).end, kRounding);
    EXPECT_NEAR(after[kTangent].motion, contact.pair->RangeOf(of.patch + 1).begin, kRounding);
    EXPECT_NEAR(before[kNormal].motion, after[kNormal].motion, kRounding);
    EXPECT_NEAR(before[kTangent].factor, after[kTangent].factor, kRounding);
    Eigen::VectorXd forces = Eigen::VectorXd::Zero(contact.u.size());
    before.AddForce(before[kNormal].gradient, kRn, &forces);
    after.AddForce(after[kNormal].gradient, -kRn, &forces);
    EXPECT_LE(forces.norm(), kRounding) << of.name;
    contact.PutBeside(of.patch, 1.0, 0.0);
    before = KinematicsAt(*contact.pair, contact.u, 0.0, of.patch);
    after = KinematicsAt(*contact.pair, contact.u, 0.0, of.patch + 1);
    before.AddForce(before[kTangent].gradient, kRt, &forces);
    after.AddForce(after[kTangent].gradient, -kRt, &forces);
    EXPECT_LE(forces.norm(), kRounding) << of.name;
  }
}

TEST_F(DeformablePairs, ForcesAndMomentsBalanceAndARigidMotionChangesNothing) {
  for (const Case& of : cases_) {
    if (of.contact.u.size() != 12) continue;  // some are held
    SCOPED_TRACE(of.name);
    ExpectBalance(At(of, of.contact.u), of.contact.u);
    const Eigen::Rotation2Dd turn(0.7);
    Eigen::VectorXd u = of.contact.u;
    for (Eigen::Index k = 0; k < u.size(); k += 2)
      u.segment<2>(k) = turn * u.segment<2>(k) + Eigen::Vector2d(0.3, -2.0);
    EXPECT_NEAR(of.contact.pair->Gap(u, 0.0, of.patch), of.contact.pair->Gap(of.contact.u, 0.0, of.patch), kRounding);
    EXPECT_NEAR(of.contact.pair->Xi(u, 0.0, of.patch), of.contact.pair->Xi(of.contact.u, 0.0, of.patch), kRounding);
    EXPECT_EQ(of.contact.pair->PatchAfter(u, 0.0, of.patch), of.patch) << of.name;
  }
}

// A node stands above a line of two nodes that is stretched to twice its length, and moves along by one quarter of it.
TEST(DeformablePair, OnAStraightLineSlipsByTheLengthOfWhatItPasses) {
  const auto line =
      std::make_shared<DeformableBoundary>(std::vector<NodePlace>{{{-1, -1}, {0.0, 0.0}}, {{0, -1}, {0.0, 0.0}}},
                                           std::vector<Eigen::Vector2d>{{0.0, 0.0}, {1.0, 0.0}}, false, 0.1);
  const DeformablePair pair(line, AdmissiblePatches(line->Spline()), {{1, 2}, Eigen::Vector2d::Zero()}, 0.3);
  const Eigen::Vector3d from(2.0, 1.2, 0.1), to(2.0, 1.7, 0.1);
  EXPECT_EQ(pair.PatchAt(from, 0.0), 1);
  EXPECT_NEAR(pair.Gap(from, 0.0, 1), 0.0, kRounding);
  EXPECT_NEAR(pair.Xi(from, 0.0, 1), 0.6, kRounding);
  EXPECT_NEAR(pair.Travel(kTangent, from, 0.0, 1, to - from, 0.0, 1), 0.5, kRounding);
  EXPECT_NEAR(pair.TravelRate(kTangent, from, 0.0, 1, Eigen::Vector3d(0.0, 1.0, 0.0), 0.0), 1.0, kRounding);
  // The line alone is stretched, and the node does not slide along where the material goes as fast.
  EXPECT_NEAR(pair.TravelRate(kTangent, from, 0.0, 1, Eigen::Vector3d(1.0, 0.6, 0.0), 0.0), 0.0, kRounding);
}

// From xi to xi on the surface at u, in chords.
double LengthInChords(const DeformableBoundary& boundary, const Eigen::VectorXd& u, double from, double to) {
  constexpr int kChords = 20000;
  const BoundaryAt shape(boundary, u, AdmissiblePatches(boundary.Spline()));
  const auto place = [&](int k) {
    const double xi = from + (to - from) * k / kChords;
    const Eigen::Vector2d foot = shape.PointAt(xi);
    const int patch = static_cast<int>(std::floor(xi / boundary.LengthPerKnot() + 0.5));
    return Eigen::Vector2d(foot + boundary.Radius() * shape.Project(foot, patch).normal);
  };
  double length = 0.0;
  for (int k = 0; k < kChords; ++k) length += (place(k + 1) - place(k)).norm();
  return to < from ? -length : length;
}

constexpr double kOfChords = 1e-8;

// Open and closed ones, of which the nodes move as well.
TEST(DeformablePair, OverSeveralBentPatchesSlipsByTheMeanLengthOnBothShapes) {
  Random random(11);
  for (const bool closed : {false, true})
    for (const double radius : {0.0, 0.15}) {
      DeformableContact contact(7, closed, radius);
      const Eigen::VectorXd start = contact.u;
      contact.u = start + random.Vector(start.size(), -0.05, 0.05);
      contact.PutBeside(1, 0.3, 0.0);
      const Eigen::VectorXd from = contact.u;
      contact.u = start + random.Vector(start.size(), -0.05, 0.05);
      contact.PutBeside(3, 0.8, 0.0);
      const Eigen::VectorXd to = contact.u;
      const DeformablePair& pair = *contact.pair;
      const double xi_from = pair.Xi(from, 0.0, 1), xi_to = pair.Xi(to, 0.0, 3);
      const double length = 0.5 * (LengthInChords(*contact.boundary, from, xi_from, xi_to) +
                                   LengthInChords(*contact.boundary, to, xi_from, xi_to));
      EXPECT_GT(length, 1.0);
      EXPECT_NEAR(pair.Travel(kTangent, from, 0.0, 1, to - from, 0.0, 3), length, kOfChords) << closed << radius;
      EXPECT_NEAR(pair.Travel(kTangent, to, 0.0, 3, from - to, 0.0, 1), -length, kOfChords) << closed << radius;
    }
}

// Past an end nothing is walked on.
TEST(DeformablePair, PastAnEndSlipsFromAndToTheEnd) {
  DeformableContact contact(5, false, 0.1);
  contact.u.head<10>() << 0.0, 0.0, 1.0, 0.0, 2.0, 0.0, 3.0, 0.0, 4.0, 0.0;
  const auto at = [&](double x) {
    contact.u.tail<2>() << x, 0.1;
    return contact.u;
  };
  const auto slip = [&](double from, int patch, double to, int patch_after) {
    return contact.pair->Travel(kTangent, at(from), 0.0, patch, at(to) - at(from), 0.0, patch_after);
  };
  EXPECT_NEAR(slip(-0.1, -1, 0.2, 0), 0.2, kRounding);
  EXPECT_NEAR(slip(0.2, 0, -0.1, -1), -0.2, kRounding);
  EXPECT_NEAR(slip(3.7, 4, 4.3, 5), 0.3, kRounding);
  EXPECT_NEAR(slip(-0.1, -1, 4.3, 5), 4.0, kRounding);
  EXPECT_NEAR(slip(-0.1, -1, -0.4, -1), 0.0, kRounding);
  EXPECT_NEAR(slip(-0.1, kNearestPatch, 1.2, kNearestPatch), 1.2, kRounding);
}

TEST(DeformablePair, PastTheEndsOfAnOpenBoundaryTheGapIsTheDistanceFromTheEnd) {
  DeformableContact contact(3, false, 0.2);
  contact.u.head<6>() << 0.0, 0.0, 1.0, 0.0, 2.0, 0.0;
  const auto put = [&](double x, double y) { contact.u.tail<2>() << x, y; };
  const DeformablePair& pair = *contact.pair;
  put(-0.3, 0.4);
  EXPECT_EQ(pair.PatchAt(contact.u, 0.0), -1);
  EXPECT_NEAR(pair.Gap(contact.u, 0.0, -1), 0.5, kRounding);
  put(2.3, 0.4);
  EXPECT_EQ(pair.PatchAt(contact.u, 0.0), 3);
  EXPECT_NEAR(pair.Gap(contact.u, 0.0, 3), 0.5, kRounding);
  put(1.0, 0.5);
  EXPECT_EQ(pair.PatchAt(contact.u, 0.0), 1);
  EXPECT_NEAR(pair.Gap(contact.u, 0.0, kNearestPatch), 0.3, kRounding);
  EXPECT_NEAR(pair.Nearest(contact.u, 0.0).distance, 0.3, kRounding);
  EXPECT_FALSE(pair.HasPatch(-1) || pair.HasPatch(3));
  EXPECT_TRUE(std::isinf(pair.RangeOf(-1).begin) && std::isinf(pair.RangeOf(3).end));
}

// A boundary that goes to the right, up, and back to the left above a node: its upper part sinks onto the node.
TEST(DeformablePair, IsOverrunByAnotherPartOfItsBoundary) {
  for (const double radius : {0.0, 0.3}) {
    DeformableContact contact(8, false, radius);
    const auto fold = [&](double upper) {
      Eigen::VectorXd u(18);
      u << 0.0, 0.0, 1.0, 0.0, 2.0, 0.0, 3.0, 0.0, 3.0, upper, 2.0, upper, 1.0, upper, 0.0, upper, 1.1, radius;
      return u;
    };
    EXPECT_NEAR(contact.pair->Gap(fold(1.0), 0.0, 1), 0.0, kRounding);
    EXPECT_FALSE(contact.pair->Overrun(fold(1.0), fold(0.7), 1));
    EXPECT_TRUE(contact.pair->Overrun(fold(0.7), fold(radius > 0.0 ? 0.5 : -0.1), 1));
    EXPECT_FALSE(contact.pair->Overrun(fold(radius > 0.0 ? 0.7 : -0.2), fold(radius > 0.0 ? 0.65 : -0.1), 1));
  }
}

// Twice round a closed boundary, one way and the other.
TEST(DeformablePair, PatchesGoRoundAClosedBoundary) {
  DeformableContact contact(8, true, 0.1);
  const double length = contact.boundary->LengthPerKnot();
  for (const double turn : {0.3, -0.3}) {
    int patch = 0;
    double last = 0.0;
    for (int i = 0; i < 42; ++i) {
      const double angle = turn * i;
      contact.u.tail<2>() << 1.3 * std::sin(angle), 1.1 * std::cos(angle);
      patch = contact.pair->PatchAfter(contact.u, 0.0, patch);
      const double xi = contact.pair->Xi(contact.u, 0.0, patch);
      if (i > 0) {
        EXPECT_GT((xi - last) / turn, 0.3) << angle;
      }
      EXPECT_NEAR(xi, 8.0 * length * angle / 6.283185307179586, 0.5 * length) << angle;
      last = xi;
    }
  }
}

// A ring of 24 nodes around the origin, of the radius 1, walked counterclockwise so that its inside is admissible; a
// node of it against the ring itself, of which two patches on either side of its own are left out.
struct OwnNode {
  explicit OwnNode(int own) {
    std::vector<NodePlace> nodes;
    std::vector<Eigen::Vector2d> start;
    for (int i = 0; i < 24; ++i) {
      const double angle = 2.0 * std::acos(-1.0) * i / 24;
      start.emplace_back(std::cos(angle), std::sin(angle));
      nodes.push_back({{2 * i, 2 * i + 1}, start.back()});
      u.conservativeResize(2 * i + 2);
      u.tail<2>() = start.back();
    }
    const AdmissiblePatches patches(start, true, 0.1, own);
    boundary = std::make_shared<DeformableBoundary>(nodes, start, true, 0.1);
    pair = std::make_unique<DeformablePair>(boundary, patches, nodes[static_cast<std::size_t>(own)], 0.3);
  }
  // y over this factor of that of the circle; all places moved at random by up to `noise`.
  Eigen::VectorXd Flattened(double factor, double noise = 0.0) const {
    Random random(7);
    Eigen::VectorXd flat = u + random.Vector(u.size(), -noise, noise);
    for (Eigen::Index k = 1; k < flat.size(); k += 2) flat[k] *= factor;
    return flat;
  }

  std::shared_ptr<const DeformableBoundary> boundary;
  std::unique_ptr<const DeformablePair> pair;
  Eigen::VectorXd u;
};

TEST(DeformablePairOfItsOwnBoundary, TouchesWhatIsFarFromItAlongTheBoundary) {
  const OwnNode top(6);
  const Eigen::VectorXd flat = top.Flattened(0.2);
  EXPECT_EQ(top.pair->PatchAt(flat, 0.0), 18);
  EXPECT_TRUE(top.pair->HasPatch(18) && top.pair->HasPatch(9) && top.pair->HasPatch(3) && top.pair->HasPatch(-15));
  for (const int patch : {4, 5, 6, 7, 8, 28, -16}) EXPECT_FALSE(top.pair->HasPatch(patch)) << patch;
  // The spline passes a node at an eighth of the second difference.
  const double opposite = -0.2 * (0.75 + 0.25 * std::cos(std::acos(-1.0) / 12.0));
  EXPECT_NEAR(top.pair->Gap(flat, 0.0, 18), 0.2 - opposite - 0.1, kRounding);
  EXPECT_NEAR(top.pair->Nearest(flat, 0.0).distance, 0.2 - opposite - 0.1, kRounding);
}

// The places where patches are left out are ends: of a node between them the gap is a distance from one of them.
TEST(DeformablePairOfItsOwnBoundary, IsPastAnEndBesideItself) {
  const OwnNode own(6);
  const auto middle = [&](const Eigen::VectorXd& u, int before) {
    return Eigen::Vector2d(0.5 * (u.segment<2>(2 * before) + u.segment<2>(2 * before + 2)));
  };
  for (const int nearer : {3, 8}) {  // the node before the border
    Eigen::VectorXd u = own.u;
    u.segment<2>(12) += 0.05 * (middle(u, nearer) - u.segment<2>(12));
    const int patch = own.pair->PatchAt(u, 0.0);
    EXPECT_EQ(patch, nearer == 3 ? 4 : 8);
    EXPECT_FALSE(own.pair->HasPatch(patch));
    EXPECT_NEAR(own.pair->Gap(u, 0.0, patch), (u.segment<2>(12) - middle(u, nearer)).norm(), kRounding);
    EXPECT_EQ(own.pair->PatchAfter(u, 0.0, 33), patch + 24);
    const XiRange range = own.pair->RangeOf(patch);
    EXPECT_EQ(std::isinf(range.begin), nearer == 8);
    EXPECT_EQ(std::isinf(range.end), nearer == 3);
    // Its foot on the prolonged curve is beyond the border.
    const double xi = own.pair->Xi(u, 0.0, patch);
    EXPECT_TRUE(xi > range.begin && xi < range.end);
    EXPECT_EQ(own.pair->Dofs(patch).size(), 8u);
  }
}

// From where its foot is past one of them, on to the third patch beyond.
TEST(DeformablePairOfItsOwnBoundary, SlipsFromTheEndBesideItself) {
  const OwnNode own(6);
  const DeformableBoundary& boundary = *own.boundary;
  for (const int sense : {-1, 1}) {
    const int past = sense < 0 ? 4 : 8, patch = past + 3 * sense;
    const XiRange border = own.pair->RangeOf(past + sense), range = own.pair->RangeOf(patch);
    const double xi = 0.5 * (range.begin + range.end), end = sense < 0 ? border.end : border.begin;
    const BoundaryAt shape(boundary, own.u, AdmissiblePatches(boundary.Spline()));
    Eigen::VectorXd from = own.u, to = own.u;
    from.segment<2>(12) = shape.PointAt(end) + 0.05 * (own.u.segment<2>(12) - shape.PointAt(end));
    const Eigen::Vector2d foot = shape.PointAt(xi);
    to.segment<2>(12) = foot + 0.1 * shape.Project(foot, patch).normal;
    EXPECT_EQ(own.pair->PatchAt(from, 0.0), past);
    EXPECT_EQ(own.pair->PatchAt(to, 0.0), patch);
    // The node is not one of those that carry what is walked on.
    const double length = LengthInChords(boundary, own.u, end, xi);
    EXPECT_NEAR(own.pair->Travel(kTangent, from, 0.0, past, to - from, 0.0, patch), length, kOfChords);
    EXPECT_NEAR(own.pair->Travel(kTangent, to, 0.0, patch, from - to, 0.0, past), -length, kOfChords);
  }
}

TEST(DeformablePairOfItsOwnBoundary, HasForcesThatBalance) {
  const OwnNode own(6);
  const Eigen::VectorXd u = own.Flattened(0.1, 0.02);
  const int patch = own.pair->PatchAt(u, 0.0);
  ASSERT_TRUE(own.pair->HasPatch(patch));
  const PortsAt at = KinematicsAt(*own.pair, u, 0.0, patch);
  EXPECT_EQ(at.dofs.size(), 8u);
  const auto values = [&](const Eigen::VectorXd& moved) {
    const PortsAt after = KinematicsAt(*own.pair, moved, 0.0, patch);
    return Eigen::Vector2d(after[kNormal].motion, after[kTangent].motion);
  };
  Eigen::MatrixXd gradients = Eigen::MatrixXd::Zero(2, u.size());
  for (std::size_t k = 0; k < at.dofs.size(); ++k) {
    gradients(0, at.dofs[k]) = at[kNormal].gradient[static_cast<Eigen::Index>(k)];
    gradients(1, at.dofs[k]) = at[kTangent].gradient[static_cast<Eigen::Index>(k)];
  }
  EXPECT_TRUE(IsJacobian(values, u, gradients, kDerivativeTolerance, 1e-3));
  ExpectBalance(at, u);
}

}  // namespace
}  // namespace contact_path::deformable_pair_test
