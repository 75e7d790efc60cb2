#include "contact_path/mpec/increment_problem.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "contact_path/contact/scene_contacts.h"
#include "mpec/problem_derivatives.h"
#include "support/mixed_scene.h"
#include "support/reference_cases.h"

namespace contact_path::increment_problem_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::set<std::pair<Eigen::Index, Eigen::Index>> PlacesOf(const MatrixEntries& entries) {
  std::set<std::pair<Eigen::Index, Eigen::Index>> places;
  for (const auto& entry : entries) places.emplace(entry.row(), entry.col());
  return places;
}

// Contacts of MixedScene() that take part; 0, 2, 3, 4 are frictional, 1 and 5 are not.
using WorkingSet = std::vector<int>;

class MixedProblem : public testing::TestWithParam<WorkingSet> {
 protected:
  MixedProblem() {
    from_ = PointNearStart(structure_, 6, 0.1, 0.3, &random_);
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

TEST_P(MixedProblem, DerivativesMeetDifferences) {
  const IncrementProblem problem = Problem();
  for (int i = 0; i < 3; ++i) {
    const Eigen::VectorXd x = RandomVariables(problem);
    const auto objective = [&](const Eigen::VectorXd& at) {
      return Eigen::VectorXd::Constant(1, problem.Objective(at));
    };
    EXPECT_TRUE(IsJacobian(objective, x, problem.Gradient(x).transpose()));
    ExpectDerivatives(problem, x, random_.Vector(problem.NumConstraints(), -1.0, 1.0));
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
  const auto in_jacobian = PlacesOf(problem.Jacobian(x));
  for (int i = 0; i < jacobian.rows(); ++i)
    for (int j = 0; j < jacobian.cols(); ++j)
      EXPECT_EQ(in_jacobian.count({i, j}) > 0, std::abs(jacobian(i, j)) > noise) << i << ", " << j;
  const auto in_hessian = PlacesOf(problem.Hessian(x, 1.0, multipliers));
  for (int i = 0; i < hessian.rows(); ++i)
    for (int j = 0; j <= i; ++j)
      EXPECT_EQ(in_hessian.count({i, j}) > 0, std::abs(hessian(i, j)) > noise) << i << ", " << j;
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
