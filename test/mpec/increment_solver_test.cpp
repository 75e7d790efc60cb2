#include "contact_path/mpec/increment_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "contact_path/check/residuals.h"
#include "contact_path/contact/scene_contacts.h"
#include "contact_path/mpec/ipopt_solver.h"
#include "support/contact_points.h"
#include "support/random.h"
#include "support/reference_cases.h"

namespace contact_path::increment_solver_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Newton's method on lengths and forces of order 10 ends at rounding; measured up to 4e-15.
constexpr double kRounding = 1e-13;

// Does whatever a test tells it to, and keeps a record of what it was asked.
class FakeSolver : public NonlinearSolver {
 public:
  struct Call {
    Eigen::Index variables, constraints;
    double eps;  // largest finite upper bound: of the products
    double barrier;
    bool has_multipliers;
  };
  using Behaviour = std::function<SolveOutcome(const NonlinearProgram&, double barrier, PrimalDual*)>;

  explicit FakeSolver(Behaviour behaviour) : behaviour_(std::move(behaviour)) {}
  SolveOutcome Solve(const NonlinearProgram& program, double barrier, PrimalDual* point) override {
    double eps = 0.0;
    const Eigen::VectorXd upper = program.Bounds().upper;
    for (Eigen::Index i = 0; i < upper.size(); ++i)
      if (upper[i] < kInfinity) eps = std::max(eps, upper[i]);
    calls_.push_back({program.NumVariables(), program.NumConstraints(), eps, barrier, point->multipliers.size() > 0});
    return behaviour_(program, barrier, point);
  }
  const std::vector<Call>& calls() const { return calls_; }

 private:
  Behaviour behaviour_;
  std::vector<Call> calls_;
};

SolveOutcome Outcome(SolveStatus status, int iterations) {
  SolveOutcome outcome;
  outcome.status = status;
  outcome.iterations = iterations;
  return outcome;
}

// The sliding bar at x = -3 with a frictionless ceiling far above, which no increment of the goal's length can reach.
class SlidingBarIncrement : public testing::Test {
 protected:
  SlidingBarIncrement() {
    from_.u = Eigen::Vector2d(-3.0, 0.0);
    from_.s = sliding_bar::LoadFactor(-3.0);
    const double rn = sliding_bar::NormalReaction(-3.0);
    from_.forces = Eigen::Vector4d(rn, -sliding_bar::kFriction * rn, 0.0, 0.0);
    from_.modes = ModesOf({ContactState::kSlipPlus, ContactState::kOpen});
    goal_.length = 0.1;
    goal_.direction = Eigen::Vector3d(1.0, 0.0, sliding_bar::LoadFactorSlope(-3.0)).normalized();
    goal_.dissipation = 0.2;
    schedule_.initial = 1e-2;
    schedule_.factor = 1e-2;
    schedule_.minimum = 1e-8;
  }

  static Scene MakeScene() {
    Scene scene = sliding_bar::MakeScene();
    scene.obstacles.push_back({"ceiling", ObstacleShape::kHalfPlane, 0.0, 1.0, 0.0, -1.0, 0.0});
    scene.contacts.push_back({"b", "ceiling"});
    return scene;
  }
  IncrementTrial SolveWith(NonlinearSolver* solver) {
    return IncrementSolver(structure_, contacts_, laws_, solver).Solve(from_, goal_, schedule_);
  }
  // Of the point as the check sees it, reached from from_: equilibrium and contact.
  double WorstResidual(const PathPoint& point) const {
    const auto state = [this](const PathPoint& at) {
      CheckedState checked;
      checked.load_factor = at.s;
      const Eigen::VectorXd full = structure_.AllValues(at.u);
      checked.positions.assign(full.data(), full.data() + full.size());
      for (std::size_t i = 0; i < contacts_.size(); ++i) {
        checked.rn.push_back(NormalReaction(at, i));
        checked.rt.push_back(TangentialReaction(at, i));
      }
      return checked;
    };
    const Residuals residuals = ResidualCheck(scene_).Check(state(from_), state(point));
    return std::max(residuals.equilibrium, residuals.Contact());
  }

  const Scene scene_ = MakeScene();
  const Structure structure_{scene_};
  const ContactPairs contacts_ = BuildContacts(scene_, structure_);
  const Laws laws_ = LawsOf(contacts_);
  PathPoint from_;
  IncrementGoal goal_;
  RegularisationSchedule schedule_;
};

TEST_F(SlidingBarIncrement, IpoptGivesAnExactPointOfTheClosedForm) {
  IpoptSolver ipopt(nullptr);
  const IncrementTrial trial = SolveWith(&ipopt);
  ASSERT_EQ(trial.status, SolveStatus::kSolved);
  EXPECT_TRUE(trial.exact);
  EXPECT_GT(trial.iterations, 0);
  const double x = trial.point.u[0];
  EXPECT_NEAR(trial.point.s, sliding_bar::LoadFactor(x), kRounding);
  EXPECT_NEAR(NormalReaction(trial.point, 0), sliding_bar::NormalReaction(x), kRounding);
  EXPECT_EQ(TangentialReaction(trial.point, 0), -sliding_bar::kFriction * NormalReaction(trial.point, 0));
  EXPECT_EQ(ContactStatesOf(trial.point.modes),
            (std::vector<ContactState>{ContactState::kSlipPlus, ContactState::kOpen}));
  // The tangent is the direction: the length is the wanted one, less the share of dissipation across it.
  EXPECT_NEAR(Distance(from_, trial.point), goal_.length, 0.1 * goal_.length);
}

TEST_F(SlidingBarIncrement, CandidateOutOfReachLeavesTheProblemAsItIsWithoutIt) {
  IpoptSolver ipopt(nullptr);
  const IncrementTrial trial = SolveWith(&ipopt);
  EXPECT_EQ(trial.variables, 2 + 1 + 3);
  EXPECT_EQ(trial.constraints, 2 + 7);
}

TEST_F(SlidingBarIncrement, CandidateInReachTakesPart) {
  IpoptSolver ipopt(nullptr);
  goal_.length = 1.01 / IncrementSolver::kLongestIncrement;  // of the gap 1
  const IncrementTrial trial = SolveWith(&ipopt);
  EXPECT_EQ(trial.variables, 2 + 1 + 3 + 1);
  EXPECT_EQ(trial.constraints, 2 + 7 + 2);
}

TEST_F(SlidingBarIncrement, CandidateReachedAgainstExpectationIsTakenInAndTheIncrementSolvedAgain) {
  IpoptSolver ipopt(nullptr);
  FakeSolver solver([&](const NonlinearProgram& program, double barrier, PrimalDual* point) {
    if (program.NumVariables() == 7) return ipopt.Solve(program, barrier, point);
    point->x[1] = 1.5 / goal_.length;  // through the ceiling
    return Outcome(SolveStatus::kSolved, 7);
  });
  const IncrementTrial trial = SolveWith(&solver);
  const auto first = std::count_if(solver.calls().begin(), solver.calls().end(),
                                   [](const FakeSolver::Call& call) { return call.variables == 6; });
  EXPECT_GT(first, 0);
  EXPECT_EQ(solver.calls().size(), static_cast<std::size_t>(2 * first));  // the schedule twice
  EXPECT_EQ(trial.variables, 7);
  EXPECT_EQ(trial.constraints, 11);
  EXPECT_EQ(trial.status, SolveStatus::kSolved);
  EXPECT_TRUE(trial.exact);
  EXPECT_GT(trial.iterations, 7 * first);
  EXPECT_NEAR(trial.point.s, sliding_bar::LoadFactor(trial.point.u[0]), kRounding);
}

TEST_F(SlidingBarIncrement, NoEpsIsSolvedForTwice) {
  FakeSolver solver([](const NonlinearProgram&, double, PrimalDual*) { return Outcome(SolveStatus::kSolved, 1); });
  SolveWith(&solver);  // the powers of 1e-2 are rounded
  ASSERT_EQ(solver.calls().size(), 4u);
  for (std::size_t i = 1; i < solver.calls().size(); ++i)
    EXPECT_NEAR(solver.calls()[i].eps, 1e-2 * solver.calls()[i - 1].eps, 1e-6 * solver.calls()[i].eps);
}

TEST_F(SlidingBarIncrement, ScheduleGoesDownToItsMinimumWithWarmStarts) {
  FakeSolver solver([](const NonlinearProgram& program, double, PrimalDual* point) {
    point->multipliers = Eigen::VectorXd::Zero(program.NumConstraints());
    return Outcome(SolveStatus::kSolved, 1);
  });
  schedule_.initial = 1e-1;
  schedule_.factor = 1e-2;
  schedule_.minimum = 1e-6;
  const IncrementTrial trial = SolveWith(&solver);
  const std::vector<double> expected = {1e-1, 1e-3, 1e-5, 1e-6};
  ASSERT_EQ(solver.calls().size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(solver.calls()[i].eps, expected[i], 1e-15 * expected[i] * 10.0) << i;
    EXPECT_GT(solver.calls()[i].barrier, 0.0) << i;
    EXPECT_LT(solver.calls()[i].barrier, solver.calls()[i].eps) << i;
    EXPECT_EQ(solver.calls()[i].has_multipliers, i > 0) << i;
  }
  EXPECT_EQ(trial.iterations, 4);
  EXPECT_NEAR(trial.regularisation, 1e-6 * goal_.length * goal_.length, 1e-20);
}

TEST_F(SlidingBarIncrement, WithoutCandidatesThereIsNothingToRegularise) {
  const ContactPairs none;
  from_.forces = Eigen::VectorXd();
  from_.modes.clear();
  FakeSolver solver([](const NonlinearProgram&, double, PrimalDual*) { return Outcome(SolveStatus::kSolved, 1); });
  const IncrementTrial trial = IncrementSolver(structure_, none, {}, &solver).Solve(from_, goal_, schedule_);
  ASSERT_EQ(solver.calls().size(), 1u);
  EXPECT_EQ(solver.calls()[0].variables, 3);
  EXPECT_EQ(solver.calls()[0].constraints, 2);
  EXPECT_EQ(solver.calls()[0].barrier, 0.0);
  EXPECT_EQ(trial.regularisation, 0.0);
}

TEST_F(SlidingBarIncrement, FailureIsAFailureAtWhateverEps) {
  for (const std::size_t fails_at : {1u, 2u, 4u}) {
    std::size_t calls = 0;
    FakeSolver solver([&](const NonlinearProgram&, double, PrimalDual*) {
      return Outcome(++calls < fails_at ? SolveStatus::kSolved : SolveStatus::kFailed, 3);
    });
    const IncrementTrial trial = SolveWith(&solver);
    EXPECT_EQ(trial.status, SolveStatus::kFailed);
    EXPECT_FALSE(trial.exact);
    EXPECT_EQ(solver.calls().size(), fails_at);
    EXPECT_EQ(trial.iterations, static_cast<int>(3 * fails_at));
  }
}

TEST_F(SlidingBarIncrement, CancellationPassesThrough) {
  std::size_t calls = 0;
  FakeSolver solver([&](const NonlinearProgram&, double, PrimalDual*) {
    return Outcome(++calls < 2 ? SolveStatus::kSolved : SolveStatus::kCancelled, 1);
  });
  const IncrementTrial trial = SolveWith(&solver);
  EXPECT_EQ(trial.status, SolveStatus::kCancelled);
  EXPECT_FALSE(trial.exact);
  EXPECT_EQ(solver.calls().size(), 2u);
}

TEST_F(SlidingBarIncrement, WhatIsNotFiniteIsNeverExactAndDoesNotPassTheCheck) {
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    for (Eigen::Index i = 0; i < 5; ++i) {  // all but lambda, which no point has
      FakeSolver solver([&](const NonlinearProgram&, double, PrimalDual* point) {
        point->x[i] = bad;
        return Outcome(SolveStatus::kSolved, 1);
      });
      const IncrementTrial trial = SolveWith(&solver);
      // A bad reaction may be put right by the exact equations; then the point is one that the check accepts.
      if (trial.exact)
        EXPECT_LE(WorstResidual(trial.point), 1e-12) << i << " = " << bad;
      else
        EXPECT_GT(WorstResidual(trial.point), 1e-3) << i << " = " << bad;
      EXPECT_TRUE(!trial.exact || i > 2) << i << " = " << bad;
    }
  }
}

TEST_F(SlidingBarIncrement, GarbageThatClaimsToBeSolvedIsExactOnlyWhereItIsRight) {
  Random random(7);
  int exact = 0, refused = 0;
  for (int i = 0; i < 300; ++i) {
    FakeSolver solver([&](const NonlinearProgram& program, double, PrimalDual* point) {
      // Positions within two lengths, reactions of up to twice the right size.
      point->x = random.Vector(program.NumVariables(), -2.0, 2.0);
      point->x.tail(program.NumVariables() - 3) *= 100.0;
      return Outcome(SolveStatus::kSolved, 1);
    });
    const IncrementTrial trial = SolveWith(&solver);
    if (trial.exact) {
      ++exact;
      EXPECT_LE(WorstResidual(trial.point), 1e-12);
    } else {
      ++refused;
      EXPECT_GT(WorstResidual(trial.point), 1e-3);
    }
  }
  EXPECT_EQ(exact + refused, 300);
  EXPECT_GT(refused, 270);  // random points hardly ever lie on the path
}

}  // namespace
}  // namespace contact_path::increment_solver_test
