#include "contact_path/mpec/increment_problem.h"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "contact_path/contact/rigid_pair.h"
#include "contact_path/contact/scene_contacts.h"
#include "contact_path/law/pin_joint.h"
#include "contact_path/law/slack_bar.h"
#include "contact_path/scene/surface.h"
#include "support/contact_points.h"
#include "support/curved_contacts.h"
#include "support/deformable_scene.h"
#include "support/derivative_checker.h"
#include "support/mixed_scene.h"
#include "support/points.h"
#include "support/random.h"
#include "support/reference_cases.h"

namespace contact_path::increment_problem_test {
namespace {

constexpr double kRounding = 1e-14;  // of sums of a few terms of order 1
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Eigen::MatrixXd JacobianOf(const IncrementProblem& problem, const Eigen::VectorXd& x) {
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(problem.NumConstraints(), problem.NumVariables());
  for (const auto& entry : problem.Jacobian(x)) jacobian(entry.row(), entry.col()) += entry.value();
  return jacobian;
}

Eigen::MatrixXd HessianOf(const IncrementProblem& problem, const Eigen::VectorXd& x, double factor,
                          const Eigen::VectorXd& multipliers) {
  Eigen::MatrixXd lower = Eigen::MatrixXd::Zero(problem.NumVariables(), problem.NumVariables());
  for (const auto& entry : problem.Hessian(x, factor, multipliers)) {
    EXPECT_GE(entry.row(), entry.col());
    lower(entry.row(), entry.col()) += entry.value();
  }
  return lower.selfadjointView<Eigen::Lower>();
}

// At x, with these multipliers: Jacobian and Hessian are those of what they derive.
void ExpectDerivatives(const IncrementProblem& problem, const Eigen::VectorXd& x, const Eigen::VectorXd& multipliers,
                       double step = kDifferenceStep) {
  const auto constraints = [&](const Eigen::VectorXd& at) { return problem.Constraints(at); };
  const auto gradient = [&](const Eigen::VectorXd& at) {
    return Eigen::VectorXd(0.8 * problem.Gradient(at) + JacobianOf(problem, at).transpose() * multipliers);
  };
  EXPECT_TRUE(IsJacobian(constraints, x, JacobianOf(problem, x), kDerivativeTolerance, step));
  EXPECT_TRUE(IsJacobian(gradient, x, HessianOf(problem, x, 0.8, multipliers), kDerivativeTolerance, step));
}

using Places = std::set<std::pair<Eigen::Index, Eigen::Index>>;

Places PlacesOf(const MatrixEntries& entries) {
  Places places;
  for (const auto& entry : entries) places.emplace(entry.row(), entry.col());
  return places;
}

// Contacts of MixedScene() that take part; 0, 2, 3, 4 are frictional, 1 and 5 are not.
using WorkingSet = std::vector<int>;

class MixedProblem : public testing::TestWithParam<WorkingSet> {
 protected:
  MixedProblem() {
    from_.u = structure_.Start() + random_.Vector(6, -0.1, 0.1);
    from_.s = 0.3;
    const Eigen::VectorXd rn = random_.Vector(6, 0.1, 1.0);
    from_.forces = ByPort(rn, random_.Vector(6, -1.0, 1.0));
    from_.modes.resize(6);
    goal_.length = 0.2;
    goal_.direction = random_.Vector(7, -1.0, 1.0).normalized();
    goal_.dissipation = 0.3;
    goal_.gamma2_factor = 1.7;
  }
  IncrementProblem Problem() const { return IncrementProblem(structure_, contacts_, laws_, from_, GetParam(), goal_); }
  Eigen::VectorXd RandomVariables(const IncrementProblem& problem) {
    return random_.Vector(problem.NumVariables(), 0.1, 1.0);
  }

  const Scene scene_ = MixedScene();
  const Structure structure_{scene_};
  const ContactPairs contacts_ = BuildContacts(scene_, structure_);
  const Laws laws_ = LawsOf(contacts_);
  Random random_{6};
  PathPoint from_;
  IncrementGoal goal_;
};

INSTANTIATE_TEST_SUITE_P(WorkingSets, MixedProblem,
                         testing::Values(WorkingSet{}, WorkingSet{1}, WorkingSet{0}, WorkingSet{2}, WorkingSet{0, 3, 4},
                                         WorkingSet{1, 5}, WorkingSet{0, 1, 2, 3, 4, 5}));

TEST_P(MixedProblem, GradientMeetsDifferences) {
  const IncrementProblem problem = Problem();
  for (int i = 0; i < 3; ++i) {
    const Eigen::VectorXd x = RandomVariables(problem);
    const auto objective = [&](const Eigen::VectorXd& at) {
      return Eigen::VectorXd::Constant(1, problem.Objective(at));
    };
    EXPECT_TRUE(IsJacobian(objective, x, problem.Gradient(x).transpose()));
  }
}

TEST_P(MixedProblem, JacobianMeetsDifferences) {
  const IncrementProblem problem = Problem();
  for (int i = 0; i < 3; ++i) {
    const Eigen::VectorXd x = RandomVariables(problem);
    const auto constraints = [&](const Eigen::VectorXd& at) { return problem.Constraints(at); };
    EXPECT_TRUE(IsJacobian(constraints, x, JacobianOf(problem, x)));
  }
}

TEST_P(MixedProblem, HessianMeetsDifferences) {
  const IncrementProblem problem = Problem();
  for (int i = 0; i < 3; ++i) {
    const Eigen::VectorXd x = RandomVariables(problem);
    const Eigen::VectorXd multipliers = random_.Vector(problem.NumConstraints(), -1.0, 1.0);
    for (const double factor : {0.0, 0.8}) {
      const auto gradient = [&](const Eigen::VectorXd& at) {
        return Eigen::VectorXd(factor * problem.Gradient(at) + JacobianOf(problem, at).transpose() * multipliers);
      };
      EXPECT_TRUE(IsJacobian(gradient, x, HessianOf(problem, x, factor, multipliers)));
    }
  }
}

TEST_P(MixedProblem, StructuresHoldEveryEntryThatCanBeOtherThanZeroAndNoOther) {
  const IncrementProblem problem = Problem();
  const Eigen::VectorXd x = RandomVariables(problem);
  const Eigen::VectorXd multipliers = random_.Vector(problem.NumConstraints(), 0.1, 1.0);
  const auto constraints = [&](const Eigen::VectorXd& at) { return problem.Constraints(at); };
  const Eigen::MatrixXd jacobian = DifferenceJacobian(constraints, x);
  const auto gradient = [&](const Eigen::VectorXd& at) {
    return Eigen::VectorXd(problem.Gradient(at) + JacobianOf(problem, at).transpose() * multipliers);
  };
  const Eigen::MatrixXd hessian = DifferenceJacobian(gradient, x);

  // Differences of what does not depend on a variable are exactly zero or rounding.
  const double noise = 1e-10;
  const Places in_jacobian = PlacesOf(problem.Jacobian(x));
  for (int i = 0; i < jacobian.rows(); ++i)
    for (int j = 0; j < jacobian.cols(); ++j)
      EXPECT_EQ(in_jacobian.count({i, j}) > 0, std::abs(jacobian(i, j)) > noise) << i << ", " << j;
  const Places in_hessian = PlacesOf(problem.Hessian(x, 1.0, multipliers));
  for (int i = 0; i < hessian.rows(); ++i)
    for (int j = 0; j <= i; ++j)
      EXPECT_EQ(in_hessian.count({i, j}) > 0, std::abs(hessian(i, j)) > noise) << i << ", " << j;
}

// With supports and obstacles that move.
TEST(MovingProblem, DerivativesMeetDifferences) {
  const Scene scene = MovingScene();
  const Structure structure(scene);
  const ContactPairs contacts = BuildContacts(scene, structure);
  const Laws laws = LawsOf(contacts);
  ASSERT_EQ(structure.PrescribedDofs().size(), 2u);
  Random random(8);
  PathPoint from;
  from.u = structure.Start() + random.Vector(8, -0.1, 0.1);
  from.s = 0.3;
  const Eigen::VectorXd rn = random.Vector(6, 0.1, 1.0);
  from.forces = ByPort(rn, random.Vector(6, -1.0, 1.0));
  from.modes.resize(6);
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
  PathPoint from;
  from.u = structure.Start() + random.Vector(8, -0.02, 0.02);
  from.s = 0.1;
  const Eigen::VectorXd rn = random.Vector(5, 0.1, 1.0);
  from.forces = ByPort(rn, random.Vector(5, -1.0, 1.0));
  from.modes.resize(5);
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
  PathPoint from;
  from.u = structure.Start() + random.Vector(9, -0.02, 0.02);
  const Eigen::VectorXd rn = random.Vector(2, 0.1, 1.0);
  from.forces = ByPort(rn, random.Vector(2, -1.0, 1.0));
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

TEST_P(MixedProblem, StructuresNameEachPlaceOnce) {
  const IncrementProblem problem = Problem();
  const Eigen::VectorXd x = RandomVariables(problem);
  const MatrixEntries jacobian = problem.Jacobian(x);
  const MatrixEntries hessian = problem.Hessian(x, 1.0, random_.Vector(problem.NumConstraints(), 0.1, 1.0));
  EXPECT_EQ(PlacesOf(jacobian).size(), jacobian.size());
  EXPECT_EQ(PlacesOf(hessian).size(), hessian.size());
}

TEST_P(MixedProblem, CountsVariablesAndConstraints) {
  const IncrementProblem problem = Problem();
  Eigen::Index variables = structure_.NumDofs() + 1, constraints = structure_.NumDofs();
  for (const int contact : GetParam()) {
    const bool frictional = contact != 1 && contact != 5;
    variables += frictional ? 3 : 1;
    constraints += frictional ? 7 : 2;
  }
  EXPECT_EQ(problem.NumVariables(), variables);
  EXPECT_EQ(problem.NumConstraints(), constraints);
  EXPECT_EQ(problem.Bounds().variables.size(), variables);
  EXPECT_EQ(problem.Bounds().lower.size(), constraints);
  EXPECT_EQ(problem.Bounds().upper.size(), constraints);
}

TEST_P(MixedProblem, RegularisationRelaxesOneProductAFrictionlessAndTwoAFrictionalContact) {
  IncrementProblem problem = Problem();
  Eigen::Index products = 0;
  for (const int contact : GetParam()) products += contact != 1 && contact != 5 ? 2 : 1;
  problem.SetRegularisation(0.125);
  EXPECT_EQ((problem.Bounds().upper.array() == 0.125).count(), products);
  problem.SetRegularisation(0.0);
  EXPECT_EQ((problem.Bounds().upper.array() == 0.125).count(), 0);
  // Products are bounded above only, inequalities below only, equilibrium is an equation.
  const auto [of_variables, lower, upper] = problem.Bounds();
  EXPECT_EQ((lower.array() == -kInfinity).count(), products);
  EXPECT_EQ(((lower.array() == 0.0) && (upper.array() == 0.0)).count(), structure_.NumDofs());
  EXPECT_EQ((of_variables.array() == 0.0).count(), static_cast<Eigen::Index>(GetParam().size()));
}

TEST_P(MixedProblem, StandingStillKeepsTheFrictionLaw) {
  const IncrementProblem problem = Problem();
  const Eigen::VectorXd start = problem.StartingPoint(Eigen::VectorXd::Zero(7));
  const Eigen::VectorXd values = problem.Constraints(start);
  // lambda = du_t = 0: of each frictional contact's five rows, only the cone is other than zero.
  Eigen::Index row = 6;
  for (const int contact : GetParam()) {
    const ContactPair& pair = *contacts_[static_cast<std::size_t>(contact)];
    const double gap = pair.Gap(from_.u, from_.s, 0) / goal_.length,
                 rn = NormalReaction(from_, static_cast<std::size_t>(contact)) / goal_.length;
    EXPECT_NEAR(values[row], gap, 10.0 * kRounding);
    EXPECT_NEAR(values[row + 1], gap * rn, 100.0 * kRounding);
    row += 2;
    if (!pair.Frictional()) continue;
    const double rt = TangentialReaction(from_, static_cast<std::size_t>(contact)) / goal_.length;
    EXPECT_EQ(values[row], 0.0);
    EXPECT_EQ(values[row + 1], 0.0);
    EXPECT_NEAR(values[row + 2], pair.Friction() * rn - rt, 10.0 * kRounding);
    EXPECT_NEAR(values[row + 3], pair.Friction() * rn + rt, 10.0 * kRounding);
    EXPECT_EQ(values[row + 4], 0.0);
    row += 5;
  }
  EXPECT_EQ(row, values.size());
}

TEST_P(MixedProblem, UnconstrainedMinimiserIsNoFartherThanWanted) {
  for (const double share : {0.0, 0.2, 0.6, 1.0}) {
    goal_.dissipation = share;
    goal_.gamma2_factor = 1.0;
    const IncrementProblem problem = Problem();
    const Eigen::VectorXd minimiser = problem.UnconstrainedMinimiser();
    Eigen::VectorXd x = Eigen::VectorXd::Zero(problem.NumVariables());
    x.head(6) = (minimiser.head(6) - from_.u) / goal_.length;
    x[6] = (minimiser[6] - from_.s) / goal_.length;
    EXPECT_LE(problem.Gradient(x).norm(), kRounding);
    EXPECT_GT(problem.Gradient(1.1 * x).norm(), 1e-3);
    EXPECT_LE(x.norm(), 1.0 + kRounding);
    EXPECT_LT(problem.Objective(x), problem.Objective(1.1 * x));
    EXPECT_LT(problem.Objective(x), problem.Objective(0.9 * x));
  }
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

TEST_P(MixedProblem, Gamma2FactorShortensTheMinimiserAndDissipationTurnsItAgainstTheReaction) {
  goal_.dissipation = 0.0;
  goal_.gamma2_factor = 2.0;
  const Eigen::VectorXd along = Problem().UnconstrainedMinimiser();
  EXPECT_LE((along.head(6) - from_.u - 0.5 * goal_.length * goal_.direction.head(6)).norm(), kRounding);
  EXPECT_NEAR(along[6], from_.s + 0.5 * goal_.length * goal_.direction[6], kRounding);
  goal_.dissipation = 1.0;
  const Eigen::VectorXd against = Problem().UnconstrainedMinimiser();
  double power = 0.0, friction = 0.0;
  for (const int contact : GetParam()) {
    const ContactPair& pair = *contacts_[static_cast<std::size_t>(contact)];
    if (!pair.Frictional()) continue;
    power += TangentialReaction(from_, static_cast<std::size_t>(contact)) *
             pair.Travel(kTangent, from_.u, from_.s, 0, against.head(6) - from_.u, 0.0, 0);
    friction += std::abs(TangentialReaction(from_, static_cast<std::size_t>(contact)));
  }
  if (friction > 0.0) {
    EXPECT_LT(power, 0.0);
    EXPECT_EQ(against[6], from_.s);
  } else {
    EXPECT_LE((against - along).norm(), kRounding);  // nothing can dissipate: the direction is all there is
  }
}

// The contact of the sliding bar, whose states are read from the variables y_x, y_y, y_s, r_n, r_t, lambda.
class SlidingBarProblem : public testing::Test {
 protected:
  SlidingBarProblem() {
    from_.u = Eigen::Vector2d(-3.0, 0.0);
    from_.s = sliding_bar::LoadFactor(-3.0);
    from_.forces = sliding_bar::NormalReaction(-3.0) * Eigen::Vector2d(1.0, -sliding_bar::kFriction);
    from_.modes = ModesOf({ContactState::kSlipPlus});
    goal_.length = 0.5;
    goal_.direction = Eigen::Vector3d(1.0, 0.0, 0.0);
  }
  IncrementProblem Problem() const { return IncrementProblem(structure_, contacts_, laws_, from_, {0}, goal_); }

  const Scene scene_ = sliding_bar::MakeScene();
  const Structure structure_{scene_};
  const ContactPairs contacts_ = BuildContacts(scene_, structure_);
  const Laws laws_ = LawsOf(contacts_);
  PathPoint from_;
  IncrementGoal goal_;
};

TEST_F(SlidingBarProblem, StateIsTheLargerSideOfEachPair) {
  const IncrementProblem problem = Problem();
  const auto state = [&](double slip, double gap, double rn, double rt) {
    Eigen::VectorXd x(6);
    x << slip, gap, 0.0, rn, rt, std::abs(slip);
    return StateOf(problem.Point(x), 0);
  };
  EXPECT_EQ(state(0.5, 0.3, 1e-6, 0.0), ContactState::kOpen);
  EXPECT_EQ(state(0.0, 1e-6, 0.3, 0.0), ContactState::kStick);
  EXPECT_EQ(state(1e-6, 0.0, 1.0, 0.1), ContactState::kStick);
  EXPECT_EQ(state(0.5, 0.0, 1.0, -0.3 + 1e-6), ContactState::kSlipPlus);
  EXPECT_EQ(state(-0.5, 0.0, 1.0, 0.3 - 1e-6), ContactState::kSlipMinus);
  // At a corner there is no motion to speak of: the reaction tells which way it is about to slip.
  EXPECT_EQ(state(-1e-7, 0.0, 1.0, -0.3), ContactState::kSlipPlus);
  EXPECT_EQ(state(1e-7, 0.0, 1.0, 0.3), ContactState::kSlipMinus);
  // A reaction that is next to nothing tells nothing about a motion: that is told by the slip.
  EXPECT_EQ(state(0.5, 0.0, 1e-7, 1e-8), ContactState::kSlipPlus);
  EXPECT_EQ(state(-0.5, 0.0, 1e-7, -1e-8), ContactState::kSlipMinus);
  EXPECT_EQ(state(0.5, -1e-6, 1e-7, 2.9e-8), ContactState::kSlipPlus);
  EXPECT_EQ(state(0.5, 1e-6, 1e-7, 2.9e-8), ContactState::kOpen);
}

}  // namespace
}  // namespace contact_path::increment_problem_test
