// Problems of increments of which more moves than the nodes: supports, obstacles, surfaces, strings, pins.
#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <memory>
#include <optional>
#include <set>

#include "contact_path/contact/rigid_pair.h"
#include "contact_path/contact/scene_contacts.h"
#include "contact_path/law/pin_joint.h"
#include "contact_path/law/slack_bar.h"
#include "contact_path/scene/surface.h"
#include "mpec/problem_derivatives.h"
#include "support/curved_contacts.h"
#include "support/deformable_scene.h"
#include "support/mixed_scene.h"
#include "support/points.h"

namespace contact_path::increment_kinds_test {
namespace {

// With supports and obstacles that move.
TEST(MovingProblem, DerivativesMeetDifferences) {
  const Scene scene = MovingScene();
  const Structure structure(scene);
  const ContactPairs contacts = BuildContacts(scene, structure);
  const Laws laws = LawsOf(contacts);
  ASSERT_EQ(structure.PrescribedDofs().size(), 2u);
  Random random(8);
  const PathPoint from = PointNearStart(structure, 6, 0.1, 0.3, &random);
  const IncrementProblem problem(structure, contacts, laws, from, {0, 1, 2, 3, 4, 5},
                                 {0.2, random.Vector(9, -1.0, 1.0).normalized(), 0.3, 1.7});
  EXPECT_EQ(problem.NumVariables(), 9 + 6 + 2 * 4 + 2);
  EXPECT_EQ(problem.NumConstraints(), 8 + 2 * 6 + 5 * 4 + 2);
  for (int i = 0; i < 3; ++i) {
    const Eigen::VectorXd x = random.Vector(problem.NumVariables(), 0.1, 1.0);
    ExpectDerivatives(problem, x, random.Vector(problem.NumConstraints(), -1.0, 1.0));
  }
  // Standing still, with the reactions that are there, is equilibrium at the prescribed components.
  PathPoint still = from;
  for (const PrescribedDof& prescribed : structure.PrescribedDofs())
    still.u[prescribed.dof] = prescribed.start + prescribed.rate * still.s;
  const IncrementProblem rest(structure, contacts, laws, still, {}, {0.2, Eigen::VectorXd::Unit(9, 8), 0.0, 1.0});
  const Eigen::VectorXd values = rest.Constraints(rest.StartingPoint(Eigen::VectorXd::Zero(9)));
  for (const PrescribedDof& prescribed : structure.PrescribedDofs())
    EXPECT_NEAR(values[prescribed.dof], 0.0, kRounding);
  EXPECT_LE(values.tail<2>().lpNorm<Eigen::Infinity>(), kRounding);
}

// Discs and a spiral, some of which move.
TEST(CurvedProblem, DerivativesMeetDifferences) {
  constexpr double kStep = 1e-2;
  const Scene scene = MovingScene();
  const Structure structure(scene);
  const ContactPairs contacts = CurvedContacts(structure);
  const Laws laws = LawsOf(contacts);
  Random random(8);
  const PathPoint from = PointNearStart(structure, 5, 0.02, 0.1, &random);
  const IncrementProblem problem(structure, contacts, laws, from, {0, 1, 2, 3, 4},
                                 {0.05, random.Vector(9, -1.0, 1.0).normalized(), 0.3, 1.7});
  for (int i = 0; i < 3; ++i) {
    const Eigen::VectorXd x = random.Vector(problem.NumVariables(), 0.1, 1.0);
    ExpectDerivatives(problem, x, random.Vector(problem.NumConstraints(), -1.0, 1.0), kStep);
  }
  // Slip and gaps are those of the point that the variables stand for.
  const Eigen::VectorXd x = random.Vector(problem.NumVariables(), 0.1, 1.0), values = problem.Constraints(x);
  const PathPoint point = problem.Point(x);
  EXPECT_NEAR(values[8], contacts[0]->Gap(point.u, point.s, 0) / 0.05, 1e-12);
}

// A node that stands beside the begin of its patch, so that increments lead to other patches, and one past both.
TEST(DeformableProblem, DerivativesMeetDifferences) {
  constexpr double kStep = 1e-3;
  const Scene scene = DeformableScene();
  const Structure structure(scene);
  const ContactPairs contacts = BuildContacts(scene, structure);
  const Laws laws = LawsOf(contacts);
  Random random(12);
  PathPoint from = PointNearStart(structure, 2, 0.02, 0.0, &random);
  from.modes = ModesOf({ContactState::kStick, ContactState::kClosed},
                       {contacts[0]->PatchAt(from.u, from.s), contacts[1]->PatchAt(from.u, from.s)});
  std::set<int> patches;
  for (int i = 0; i < 12; ++i) {
    const IncrementProblem problem(structure, contacts, laws, from, {0, 1},
                                   {0.3, random.Vector(10, -1.0, 1.0).normalized(), 0.3, 1.7});
    Eigen::VectorXd x = random.Vector(problem.NumVariables(), 0.1, 1.0);
    x.head(9) = random.Vector(9, -0.7, 0.7);
    ExpectDerivatives(problem, x, random.Vector(problem.NumConstraints(), -1.0, 1.0), kStep);
    patches.insert(problem.Point(x).modes[0].piece);
  }
  EXPECT_GT(patches.size(), 1u);
}

// A node on a floor, with a string that is taut at some places and slack at others.
TEST(CompliantProblem, DerivativesMeetDifferences) {
  Scene scene;
  scene.nodes = {{"a", 0.0, 0.0}};
  scene.superelements = {{{"a"}, {1.0, 0.2, 0.2, 1.0}}};
  scene.loads = {{"a", 1.0, 0.5}};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.3}};
  scene.contacts = {{"a", "floor"}};
  const Structure structure(scene);
  const ContactPairs contacts = BuildContacts(scene, structure);
  const SlackBar bar({{MovingPlace::Between(PointOfNode(-1, -1, {-1.0, 0.5}), PointOfNode(0, 1))}}, {}, 1.7, 1.1,
                     StrainMeasure::kBiot, BarSense::kTension);
  Laws laws = LawsOf(contacts);
  laws.Add(&bar);
  Random random(5);
  PathPoint from;
  from.u = structure.Start();
  from.forces = Eigen::Vector3d(1.0, 0.2, 0.3);
  from.modes = ModesOf({ContactState::kStick});
  from.modes.push_back({NumberOf(BarState::kTaut), 0});
  const IncrementProblem problem(structure, contacts, laws, from, {0, 1},
                                 {0.3, random.Vector(3, -1.0, 1.0).normalized(), 0.3, 1.7});
  for (int i = 0; i < 4; ++i) {
    Eigen::VectorXd x = random.Vector(problem.NumVariables(), 0.1, 1.0);
    x.head(3) = random.Vector(3, -0.7, 0.7);
    ExpectDerivatives(problem, x, random.Vector(problem.NumConstraints(), -1.0, 1.0));
    // The string is taut where the place says so, whatever its force.
    const PathPoint point = problem.Point(x);
    const bool taut = bar.Motion(0, point.u, point.s, 0, {}) <= 0.0;
    EXPECT_EQ(point.modes[1].state, NumberOf(taut ? BarState::kTaut : BarState::kSlack));
  }
}

// What turns with an unknown, and gives way where it touches: a node of it, its rim with friction that changes, and
// pins.
class GivingProblem : public testing::Test {
 protected:
  GivingProblem() {
    scene_.nodes = {{"a", 0.0, 0.0}, {"b", 0.4, -0.3}};
    scene_.superelements = {
        {{"a", "b"}, {2.0, 0.2, 0.1, 0.3, 0.2, 1.0, 0.4, 0.1, 0.1, 0.4, 3.0, 0.2, 0.3, 0.1, 0.2, 1.5}}};
    scene_.loads = {{"a", 1.0, 0.5}};
    structure_ = std::make_unique<const Structure>(scene_);
    const MovingFrame frame = {{Coordinate{0}, Coordinate{1}}, Coordinate{2}};
    const FixedPoint tip = {frame, {0.3, -0.4}};
    const Obstacle floor = {"floor", ObstacleShape::kHalfPlane, 0.0, -0.5, 0.1, 1.0, 0.3},
                   drum = {"drum", ObstacleShape::kCircle, 0.2, 1.9, 0.0, 0.0, 0.4, 1.2};
    contacts_.push_back(
        std::make_unique<RigidPair>(MakeSurface(floor), MovingPlace(tip), 0.3, Eigen::VectorXd(), std::nullopt, 0.2));
    contacts_.push_back(std::make_unique<RigidPair>(MakeSurface(drum), MovingPlace(FixedPoint{frame}), 0.4,
                                                    Eigen::VectorXd(), std::nullopt, 0.3,
                                                    Rolling{0.5, frame.angle, Coordinate{}}, 0.2));
    laws_ = LawsOf(contacts_);
    pins_.emplace_back(MovingPlace::Between(PointOfNode(2, 3), tip), Eigen::Vector2d(0.1, 0.2), 0.25);
    pins_.emplace_back(MovingPlace::Between(PointOfNode(0, 1), PointOfNode(2, 3)), Eigen::Vector2d(0.4, -0.3), 0.0);
    for (const PinJoint& pin : pins_) laws_.Add(&pin);
    from_.u = structure_->Start();
    from_.s = 0.1;
    from_.forces = (Eigen::VectorXd(8) << 1.0, 0.2, 0.5, -0.1, -0.3, 0.4, 0.6, -0.7).finished();
    from_.modes = ModesOf({ContactState::kStick, ContactState::kSlipPlus});
    from_.modes.resize(4);
  }

  Scene scene_;
  std::unique_ptr<const Structure> structure_;
  ContactPairs contacts_;
  std::deque<PinJoint> pins_;
  Laws laws_;
  PathPoint from_;
};

TEST_F(GivingProblem, DerivativesMeetDifferences) {
  constexpr double kStep = 1e-2;
  Random random(7);
  const IncrementProblem problem(*structure_, contacts_, laws_, from_, {0, 1, 2, 3},
                                 {0.05, random.Vector(5, -1.0, 1.0).normalized(), 0.3, 1.7});
  EXPECT_EQ(problem.NumVariables(), 5 + 2 * 3 + 2 * 2);
  EXPECT_EQ(problem.NumConstraints(), 4 + 2 * 7 + 2 * 2);
  for (int i = 0; i < 4; ++i) {
    const Eigen::VectorXd x = random.Vector(problem.NumVariables(), 0.1, 1.0);
    ExpectDerivatives(problem, x, random.Vector(problem.NumConstraints(), -1.0, 1.0), kStep);
  }
}

// Equations have no other state, and forces of any sign; what has not moved gives way by no more than before.
TEST_F(GivingProblem, StandingStillKeepsWhatGivesWay) {
  const IncrementProblem problem(*structure_, contacts_, laws_, from_, {0, 1, 2, 3},
                                 {0.05, Eigen::VectorXd::Unit(5, 4), 0.3, 1.7});
  const Eigen::VectorXd start = problem.StartingPoint(Eigen::VectorXd::Zero(5)), values = problem.Constraints(start);
  const auto [of_variables, lower, upper] = problem.Bounds();
  for (const Eigen::Index row : {4, 11}) {  // gap, gap r_n, lambda -+ slip of both contacts
    EXPECT_NEAR(values[row], 0.0, 10.0 * kRounding);
    EXPECT_NEAR(values[row + 2], 0.0, 10.0 * kRounding);
    EXPECT_NEAR(values[row + 3], 0.0, 10.0 * kRounding);
  }
  for (Eigen::Index row = 18; row < 22; ++row) EXPECT_TRUE(lower[row] == 0.0 && upper[row] == 0.0) << row;
  const double tip = 0.3 * std::cos(0.4) + 0.4 * std::sin(0.4);            // turned by what is the unknown 2
  EXPECT_NEAR(values[18], (tip - 0.4 - 0.1 + 0.25 * -0.3) / 0.05, 1e-12);  // x_1 - x_2 - (X_1 - X_2) + c r
  EXPECT_EQ((of_variables.array() == 0.0).count(), 2);
  const PathPoint point = problem.Point(start);
  EXPECT_LE((point.forces - from_.forces).lpNorm<Eigen::Infinity>(), kRounding);
  EXPECT_EQ(point.modes[2].state, 0);
}

// A belt that moves under a node which rests dissipates as a node that slides over a floor does.
TEST(MovingProblem, DissipationCountsTheMotionOfTheObstacle) {
  Scene scene;
  scene.nodes = {{"a", 0.0, 0.0}};
  scene.superelements = {{{"a"}, {1.0, 0.0, 0.0, 1.0}}};
  scene.obstacles = {{"belt", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.3}};
  scene.contacts = {{"a", "belt"}};
  scene.obstacle_motions = {{"belt", 2.0, 0.0}};
  const Structure structure(scene);
  const ContactPairs contacts = BuildContacts(scene, structure);
  const Laws laws = LawsOf(contacts);
  PathPoint from;
  from.u = structure.Start();
  from.forces = Eigen::Vector2d(1.0, 0.3);
  from.modes = ModesOf({ContactState::kSlipMinus});
  const IncrementProblem problem(structure, contacts, laws, from, {0}, {0.1, Eigen::Vector3d(0.0, 0.0, 1.0), 1.0, 1.0});
  // xi' = u_x' - 2 s': the dissipation grows most along (-1, 0, 2).
  const Eigen::VectorXd wanted = problem.UnconstrainedMinimiser();
  EXPECT_LE((wanted - 0.1 / std::sqrt(5.0) * Eigen::Vector3d(-1.0, 0.0, 2.0)).norm(), kRounding);
}

}  // namespace
}  // namespace contact_path::increment_kinds_test
