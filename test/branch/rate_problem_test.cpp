#include "contact_path/branch/rate_problem.h"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "contact_path/equations/rigid_modes.h"
#include "contact_path/linear/minimum_norm.h"
#include "contact_path/path/model.h"
#include "lattice.h"
#include "support/dense.h"
#include "support/kinematics.h"
#include "support/random.h"

namespace contact_path::rate_problem_test {
namespace {

using States = std::vector<ContactState>;

constexpr double kExact = 1e-10;

// A lattice that stands on five nodes, nothing else holds it; without reactions yet.
class RestingColumn : public testing::Test {
 protected:
  RestingColumn() : model_(MakeScene(), CharacteristicScales(MakeScene())), point_(model_.InitialPoint()) {}

  static Scene MakeScene() {
    LatticeOptions options;
    options.columns = 4;
    options.rows = 2;
    Scene scene = LatticeRequest(options).scene;
    scene.loads.push_back({"n1_1", 0.3, -0.4, false});
    return scene;
  }

  RateProblem Condense(const States& states, const std::vector<int>& weakly_active) const {
    return Condense(states, weakly_active,
                    Eigen::VectorXd::Unit(model_.structure.NumDofs() + 1, model_.structure.NumDofs()));
  }
  RateProblem Condense(const States& states, const std::vector<int>& weakly_active,
                       const Eigen::VectorXd& arrival) const {
    return {model_.structure, model_.contacts, point_, states, weakly_active, arrival};
  }

  // Load and motions and reactions of the weakly_active contacts, of each column of unknowns.
  Eigen::MatrixXd WeaklyActive(const FixedStateSystem& system, const std::vector<int>& weakly_active,
                               const Eigen::MatrixXd& unknowns) const {
    Eigen::MatrixXd rates(1 + 4 * static_cast<Eigen::Index>(weakly_active.size()), unknowns.cols());
    for (Eigen::Index j = 0; j < unknowns.cols(); ++j) {
      const PathPoint change = system.Unpack(unknowns.col(j));
      rates(0, j) = change.s;
      for (std::size_t k = 0; k < weakly_active.size(); ++k) {
        const ContactPair& contact = *model_.contacts[static_cast<std::size_t>(weakly_active[k])];
        rates.col(j).segment<4>(1 + 4 * static_cast<Eigen::Index>(k))
            << GapRate(contact, point_.u, point_.s, change.u, change.s),
            contact.SlipRate(point_.u, point_.s, 0, change.u, change.s), change.rn[weakly_active[k]],
            change.rt[weakly_active[k]];
      }
    }
    return rates;
  }

  // Where the null space has several dimensions: a member of it, without rigid modes, of unit length.
  void ExpectShortestMember(const FixedStateSystem& system, const std::vector<int>& weakly_active,
                            const Eigen::MatrixXd& null_space, const CondensedRates& rates) const {
    const Eigen::Index motion = system.NumDofs() + 1;
    Eigen::VectorXd wanted(1 + 4 * rates.gap.size());
    wanted[0] = rates.load;
    for (Eigen::Index k = 0; k < rates.gap.size(); ++k)
      wanted.segment<4>(1 + 4 * k) << rates.gap[k], rates.slip[k], rates.rn[k], rates.rt[k];
    const Eigen::MatrixXd seen = WeaklyActive(system, weakly_active, null_space);
    const Eigen::VectorXd member = null_space * ShortestSolution(seen, wanted);
    EXPECT_LE((WeaklyActive(system, weakly_active, member) - wanted).norm(), kExact);
    EXPECT_NEAR(member.head(motion).norm(), 1.0, kExact);
    const Eigen::MatrixXd forces = null_space.bottomRows(null_space.rows() - motion + 1);
    const SingularValueDecomposition dense = Decompose(forces);
    const Eigen::Index rank = dense.values[0] > 1e-9 ? dense.Rank(1e-9) : 0;
    if (rank == 0 || rank == forces.cols()) return;
    const Eigen::MatrixXd rigid = null_space * dense.v.rightCols(forces.cols() - rank);
    EXPECT_LE((rigid.topRows(motion).transpose() * member.head(motion)).norm(), kExact);
  }

  // Against the null vector of all equations.
  void ExpectRatesOfTheWhole(const RateProblem& problem, const States& states, const std::vector<int>& weakly_active,
                             int* compared) {
    FixedStateSystem system(model_.structure, model_.contacts);
    system.SetStates(states, Eigen::VectorXd::Zero(static_cast<Eigen::Index>(states.size())));
    const Eigen::VectorXd x = system.Pack(point_);
    MinimumNormSolver solver;
    ASSERT_TRUE(solver.Factorize(system.TransposedJacobian(x)));
    const Eigen::MatrixXd null_space = solver.NullSpace();
    const std::optional<CondensedRates> rates = problem.Rates(states);
    // Where the structure can move as a rigid body, the condensed problem does not tell.
    const bool free = RigidModes(model_.structure).At(point_.u, system.TransposedJacobian(x)).cols() > 0;
    ASSERT_EQ(rates.has_value(), !free);
    if (free) return;
    ++*compared;
    if (null_space.cols() > 1) return ExpectShortestMember(system, weakly_active, null_space, *rates);
    const Eigen::Index motion = system.NumDofs() + 1;
    Eigen::VectorXd tangent = null_space.col(0) / null_space.col(0).head(motion).norm();
    // The sign is free, and the load may rest.
    double same = tangent[motion - 1] * rates->load;
    for (std::size_t k = 0; k < weakly_active.size(); ++k) {
      const ContactPair& contact = *model_.contacts[static_cast<std::size_t>(weakly_active[k])];
      same += rates->gap[static_cast<Eigen::Index>(k)] * GapRate(contact, point_.u, point_.s, tangent, 0.0) +
              rates->slip[static_cast<Eigen::Index>(k)] * contact.SlipRate(point_.u, point_.s, 0, tangent, 0.0);
    }
    if (same < 0.0) tangent = -tangent;
    const PathPoint change = system.Unpack(tangent);
    EXPECT_NEAR(rates->load, change.s, kExact);
    EXPECT_NEAR(rates->along, change.s, kExact);
    for (std::size_t k = 0; k < weakly_active.size(); ++k) {
      const auto i = static_cast<std::size_t>(weakly_active[k]);
      const auto e = static_cast<Eigen::Index>(k), c = static_cast<Eigen::Index>(i);
      EXPECT_NEAR(rates->gap[e], GapRate(*model_.contacts[i], point_.u, point_.s, change.u, change.s), kExact);
      EXPECT_NEAR(rates->slip[e], model_.contacts[i]->SlipRate(point_.u, point_.s, 0, change.u, change.s), kExact);
      EXPECT_NEAR(rates->rn[e], change.rn[c], kExact);
      EXPECT_NEAR(rates->rt[e], change.rt[c], kExact);
    }
  }

  const Model model_;
  const PathPoint point_;
};

TEST_F(RestingColumn, RatesAreThoseOfTheWholeStructure) {
  const States all_states = {ContactState::kOpen, ContactState::kStick, ContactState::kSlipPlus,
                             ContactState::kSlipMinus};
  const std::vector<int> weakly_active = {0, 1, 2, 3, 4};
  const RateProblem problem = Condense(point_.states, weakly_active);
  ASSERT_TRUE(problem.regular());
  Random random(3);
  int compared = 0;
  for (int trial = 0; trial < 200; ++trial) {
    States states;
    for (int i = 0; i < 5; ++i) states.push_back(all_states[static_cast<std::size_t>(random.Number(0.0, 3.999))]);
    ExpectRatesOfTheWhole(problem, states, weakly_active, &compared);
  }
  EXPECT_GT(compared, 150);
}

TEST_F(RestingColumn, OtherContactsKeepTheirStates) {
  const std::vector<int> weakly_active = {1, 3};
  States states = {ContactState::kStick, ContactState::kOpen, ContactState::kSlipPlus, ContactState::kStick,
                   ContactState::kOpen};
  const RateProblem problem = Condense(states, weakly_active);
  ASSERT_TRUE(problem.regular());
  int compared = 0;
  for (const ContactState a : {ContactState::kOpen, ContactState::kStick, ContactState::kSlipMinus})
    for (const ContactState b : {ContactState::kOpen, ContactState::kStick, ContactState::kSlipPlus}) {
      states[1] = a;
      states[3] = b;
      ExpectRatesOfTheWhole(problem, states, weakly_active, &compared);
    }
  EXPECT_GT(compared, 5);
}

TEST_F(RestingColumn, UniqueRatesMayBeOrthogonalToTheArrival) {
  const std::vector<int> weakly_active = {0, 1, 2, 3, 4};
  const States states = {ContactState::kStick, ContactState::kSlipPlus, ContactState::kStick, ContactState::kOpen,
                         ContactState::kSlipPlus};
  FixedStateSystem system(model_.structure, model_.contacts);
  system.SetStates(states, Eigen::VectorXd::Zero(5));
  MinimumNormSolver solver;
  ASSERT_TRUE(solver.Factorize(system.TransposedJacobian(system.Pack(point_))));
  ASSERT_EQ(solver.NullSpace().cols(), 1);
  const Eigen::VectorXd motion = solver.NullSpace().col(0).head(model_.structure.NumDofs() + 1).normalized();
  Random random(4);
  Eigen::VectorXd arrival = random.Vector(motion.size(), -1.0, 1.0);
  arrival -= arrival.dot(motion) * motion;
  arrival.normalize();

  const std::optional<CondensedRates> expected = Condense(states, weakly_active).UniqueRates(states);
  const std::optional<CondensedRates> rates = Condense(states, weakly_active, arrival).UniqueRates(states);
  ASSERT_TRUE(expected && rates);
  EXPECT_NEAR(rates->along, 0.0, kExact);
  const double sign = rates->load * expected->load > 0.0 ? 1.0 : -1.0;
  EXPECT_NEAR(sign * rates->load, expected->load, kExact);
  EXPECT_LE((sign * rates->slip - expected->slip).norm(), kExact);
  EXPECT_LE((sign * rates->rn - expected->rn).norm(), kExact);
}

TEST_F(RestingColumn, NamesWhatIsBroken) {
  const std::vector<int> weakly_active = {0, 4};
  const States states(5, ContactState::kStick);
  const RateProblem problem = Condense(states, weakly_active);
  CondensedRates rates;
  rates.gap = rates.slip = Eigen::VectorXd::Zero(2);
  rates.rn = Eigen::Vector2d(1.0, -0.5);
  rates.rt = Eigen::Vector2d(0.5, 0.0);  // mu = 0.3
  std::vector<Constraint> all;
  const std::optional<Constraint> first = problem.Broken(states, rates, 1.0, {}, 1e-9, &all);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->contact, 0);
  EXPECT_EQ(first->inequality, Inequality::kConeMinus);
  ASSERT_EQ(all.size(), 4U);  // and of the other one: the reaction, and both sides of its cone
  EXPECT_EQ(all[1].contact, 4);
  EXPECT_EQ(all[1].inequality, Inequality::kNormalReaction);
  rates.rn[1] = 0.5;
  rates.rt[0] = 0.3;  // on the cone
  EXPECT_FALSE(problem.Broken(states, rates, 1.0, {}, 1e-9, nullptr));
  EXPECT_TRUE(problem.Broken(states, rates, -1.0, {}, 1e-9, nullptr));
}

TEST_F(RestingColumn, SingularWhereNothingHoldsTheStructure) {
  EXPECT_FALSE(Condense(States(5, ContactState::kOpen), {2}).regular());
}

}  // namespace
}  // namespace contact_path::rate_problem_test
