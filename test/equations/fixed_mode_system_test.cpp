#include "contact_path/equations/fixed_mode_system.h"

#include <gtest/gtest.h>

#include <Eigen/SparseLU>
#include <string>

#include "contact_path/contact/scene_contacts.h"
#include "contact_path/linear/bordered_solver.h"
#include "support/contact_points.h"
#include "support/curved_contacts.h"
#include "support/derivative_checker.h"
#include "support/kinematics.h"
#include "support/mixed_scene.h"
#include "support/random.h"
#include "support/reference_cases.h"
#include "support/system_derivatives.h"

namespace contact_path::fixed_mode_system_test {
namespace {

constexpr double kRounding = 1e-14;  // of sums of a few terms of order 1

using State = ContactState;

// States that a contact can have.
std::vector<State> StatesOf(const ContactPair& contact) {
  if (contact.Frictional()) return {State::kOpen, State::kStick, State::kSlipPlus, State::kSlipMinus};
  return {State::kOpen, State::kClosed};
}

class MixedSystem : public testing::Test {
 protected:
  PathPoint RandomPoint() {
    PathPoint point;
    point.u = structure_.Start() + random_.Vector(structure_.NumDofs(), -0.15, 0.15);
    point.s = random_.Number(-1.0, 1.0);
    const Eigen::VectorXd rn = random_.Vector(6, 0.1, 1.0);
    point.forces = ByPort(rn, random_.Vector(6, -1.0, 1.0));
    return point;
  }
  void ExpectDerivatives() {
    const Eigen::VectorXd x = system_.Pack(RandomPoint()), dx = random_.Vector(system_.NumUnknowns(), -1.0, 1.0);
    EXPECT_EQ(x.size(), system_.NumUnknowns());
    ExpectDerivativesMeetDifferences(&system_, x, dx);
    // The second derivative leaves no trace in the next Jacobian.
    const Eigen::MatrixXd jacobian = system_.TransposedJacobian(x);
    EXPECT_EQ(jacobian.cols(), system_.NumEquations());
    system_.SecondDerivative(x, dx);
    EXPECT_EQ(Eigen::MatrixXd(system_.TransposedJacobian(x)), jacobian);
  }

  const Scene scene_ = MixedScene();
  const Structure structure_{scene_};
  const ContactPairs contacts_ = BuildContacts(scene_, structure_);
  const Eigen::VectorXd reference_ = Eigen::VectorXd::LinSpaced(6, -0.4, 0.7);
  const Laws laws_ = LawsOf(contacts_);
  FixedModeSystem system_{structure_, laws_};
  Random random_{4};
};

TEST_F(MixedSystem, StartsWithEverythingOpen) {
  EXPECT_EQ(system_.NumUnknowns(), structure_.NumDofs() + 1);
  EXPECT_EQ(system_.NumEquations(), structure_.NumDofs());
  EXPECT_EQ(ContactStatesOf(system_.modes()), std::vector<State>(6, State::kOpen));
}

TEST_F(MixedSystem, CountsUnknownsAndEquations) {
  const std::vector<State> states = {State::kStick,     State::kClosed, State::kSlipPlus,
                                     State::kSlipMinus, State::kOpen,   State::kOpen};
  system_.SetModes(ModesOf(states), ByPort(reference_));
  // One r_n and one gap each of the four that touch, one r_t and one u_t of the one that sticks.
  EXPECT_EQ(system_.NumUnknowns(), 6 + 1 + 4 + 1);
  EXPECT_EQ(system_.NumEquations(), 6 + 4 + 1);
  system_.FixLoadFactor(0.5);
  EXPECT_EQ(system_.NumEquations(), system_.NumUnknowns());
  system_.SetActive({{0, NumberOf(ContactLimit::kConeMinus)}, {3, NumberOf(ContactLimit::kSlip)}});
  EXPECT_EQ(system_.NumEquations(), 6 + 4 + 1 + 1 + 2);
  system_.SetModes(ModesOf(states), ByPort(reference_));
  EXPECT_EQ(system_.NumEquations(), 6 + 4 + 1);
}

TEST_F(MixedSystem, DerivativesMeetDifferencesInEveryCombinationOfStates) {
  // All states of each contact with the others random: 18 states, and pins on all inequalities they have.
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    for (const State state : StatesOf(*contacts_[i])) {
      std::vector<State> states;
      for (const auto& contact : contacts_) {
        const std::vector<State> possible = StatesOf(*contact);
        states.push_back(
            possible[static_cast<std::size_t>(random_.Number(0.0, 1.0) * static_cast<double>(possible.size()))]);
      }
      states[i] = state;
      SCOPED_TRACE("contact " + std::to_string(i) + " " + std::string(ToString(state)));
      system_.SetModes(ModesOf(states), ByPort(reference_));
      ExpectDerivatives();
      system_.SetActive(system_.mode_limits().All());
      ExpectDerivatives();
      system_.FixLoadFactor(0.3);
      ExpectDerivatives();
    }
  }
}

// With supports and obstacles that move.
TEST(MovingSystem, DerivativesMeetDifferences) {
  const Scene scene = MovingScene();
  const Structure structure(scene);
  const ContactPairs contacts = BuildContacts(scene, structure);
  const Laws laws = LawsOf(contacts);
  FixedModeSystem system(structure, laws);
  Random random(5);
  const std::vector<State> states = {State::kStick,     State::kClosed, State::kSlipPlus,
                                     State::kSlipMinus, State::kStick,  State::kOpen};
  system.SetModes(ModesOf(states), ByPort(random.Vector(6, -0.4, 0.7)));
  EXPECT_EQ(system.NumUnknowns(), 8 + 1 + 5 + 2 + 2);
  EXPECT_EQ(system.NumEquations(), 8 + 5 + 2 + 2);
  const Eigen::VectorXd x = random.Vector(system.NumUnknowns(), 0.1, 1.0);
  const Eigen::VectorXd along = random.Vector(system.NumUnknowns(), -1.0, 1.0);
  ExpectDerivativesMeetDifferences(&system, x, along);
  for (const Limit& limit : system.mode_limits().All()) {
    const auto value = [&](const Eigen::VectorXd& at) { return Eigen::VectorXd::Constant(1, system.Value(limit, at)); };
    EXPECT_TRUE(IsJacobian(value, x, system.Gradient(limit, x).transpose()));
    EXPECT_NEAR(system.mode_limits().Rate(limit, x, along), system.Gradient(limit, x).dot(along), kRounding);
  }
  // The power of supports and obstacles: that of the reactions on the nodes less what friction takes.
  const PathPoint point = system.Unpack(x);
  Eigen::VectorXd dx = Eigen::VectorXd::Zero(system.NumUnknowns());
  for (const PrescribedDof& prescribed : structure.PrescribedDofs()) dx[prescribed.dof] = prescribed.rate;
  double moved = 0.0, friction = 0.0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const double rn = NormalReaction(point, i), rt = TangentialReaction(point, i);
    const PortsAt at = KinematicsAt(*contacts[i], point.u, point.s);
    moved += rn * at.Rate(at[kNormal].gradient, dx, 0.0) + rt * at.Rate(at[kTangent].gradient, dx, 0.0);
    friction += rn * at.Rate(at[kNormal].gradient, dx, 1.0) + rt * at.Rate(at[kTangent].gradient, dx, 1.0);
  }
  double supports = 0.0;
  for (std::size_t k = 0; k < structure.PrescribedDofs().size(); ++k)
    supports += structure.PrescribedDofs()[k].rate * x[x.size() - 2 + static_cast<Eigen::Index>(k)];
  EXPECT_NEAR(system.DrivingForceAlong(x, x, x).value, supports + moved - friction, kRounding * 10.0);
}

// Discs and a spiral, some of which move.
class CurvedSystem : public testing::Test {
 protected:
  Eigen::VectorXd RandomUnknowns() {
    Eigen::VectorXd x = random_.Vector(system_.NumUnknowns(), 0.1, 1.0);
    x.head(structure_.NumDofs()) = structure_.Start() + random_.Vector(structure_.NumDofs(), -0.03, 0.03);
    x[structure_.NumDofs()] = 0.1;
    return x;
  }

  static constexpr double kStep = 1e-3;  // of differences: the curvature changes over about 1
  const Scene scene_ = MovingScene();
  const Structure structure_{scene_};
  const ContactPairs contacts_ = CurvedContacts(structure_);
  const Laws laws_ = LawsOf(contacts_);
  FixedModeSystem system_{structure_, laws_};
  Random random_{9};
};

TEST_F(CurvedSystem, DerivativesMeetDifferencesInEveryState) {
  for (const State state : {State::kOpen, State::kStick, State::kSlipPlus, State::kSlipMinus}) {
    const State other = state == State::kStick ? State::kSlipPlus : State::kStick;
    system_.SetModes(ModesOf({state, other, state, other, state == State::kOpen ? State::kOpen : State::kClosed}),
                     ByPort(random_.Vector(5, -0.3, 0.3)));
    for (const bool active : {false, true}) {
      if (active) system_.SetActive(system_.mode_limits().All());
      const Eigen::VectorXd x = RandomUnknowns(), dx = random_.Vector(system_.NumUnknowns(), -1.0, 1.0);
      SCOPED_TRACE(ToString(state));
      ExpectDerivativesMeetDifferences(&system_, x, dx, kStep);
    }
  }
}

TEST_F(CurvedSystem, ValuesAlongACurveMeetDifferences) {
  system_.SetModes(ModesOf({State::kSlipPlus, State::kStick, State::kSlipMinus, State::kSlipPlus, State::kOpen}),
                   ByPort(random_.Vector(5, -0.3, 0.3)));
  const Eigen::VectorXd x = RandomUnknowns(), first = random_.Vector(system_.NumUnknowns(), -1.0, 1.0),
                        second = random_.Vector(system_.NumUnknowns(), -1.0, 1.0);
  const auto on_curve = [&](double h) { return Eigen::VectorXd(x + h * first + 0.5 * h * h * second); };
  const auto velocity = [&](double h) { return Eigen::VectorXd(first + h * second); };
  for (const Limit& limit : system_.mode_limits().All()) {
    const auto value = [&](const Eigen::VectorXd& at) {
      return Eigen::VectorXd::Constant(1, system_.Value(limit, at));
    };
    EXPECT_TRUE(IsJacobian(value, x, system_.Gradient(limit, x).transpose(), kDerivativeTolerance, kStep));
    EXPECT_NEAR(system_.mode_limits().Rate(limit, x, first), system_.Gradient(limit, x).dot(first), 10.0 * kRounding);
    const auto along = [&](const Eigen::VectorXd& h) {
      return Eigen::VectorXd::Constant(1, system_.mode_limits().Rate(limit, on_curve(h[0]), velocity(h[0])));
    };
    const Jet jet = system_.ValueAlong(limit, x, first, second);
    EXPECT_EQ(jet.value, system_.Value(limit, x));
    EXPECT_EQ(jet.first, system_.mode_limits().Rate(limit, x, first));
    EXPECT_TRUE(IsJacobian(along, Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Constant(1, 1, jet.second),
                           kDerivativeTolerance, kStep));
  }
  const auto force = [&](const Eigen::VectorXd& h) {
    const Jet jet = system_.DrivingForceAlong(on_curve(h[0]), velocity(h[0]), second);
    return Eigen::Vector2d(jet.value, jet.first);
  };
  const Jet jet = system_.DrivingForceAlong(x, first, second);
  EXPECT_TRUE(
      IsJacobian(force, Eigen::VectorXd::Zero(1), Eigen::Vector2d(jet.first, jet.second), kDerivativeTolerance, kStep));
}

TEST_F(MixedSystem, PatternStaysTheSameBetweenEvaluations) {
  system_.SetModes(
      ModesOf({State::kStick, State::kClosed, State::kSlipPlus, State::kSlipMinus, State::kStick, State::kClosed}),
      ByPort(reference_));
  const Eigen::SparseMatrix<double> first = system_.TransposedJacobian(system_.Pack(RandomPoint()));
  const Eigen::SparseMatrix<double>& second = system_.TransposedJacobian(system_.Pack(RandomPoint()));
  ASSERT_EQ(first.nonZeros(), second.nonZeros());
  EXPECT_TRUE(first.isCompressed());
  for (Eigen::Index k = 0; k < first.nonZeros(); ++k) EXPECT_EQ(first.innerIndexPtr()[k], second.innerIndexPtr()[k]);
}

TEST_F(MixedSystem, UnpackGivesEveryContactItsReactions) {
  const std::vector<State> states = {State::kStick,     State::kClosed, State::kSlipPlus,
                                     State::kSlipMinus, State::kOpen,   State::kOpen};
  system_.SetModes(ModesOf(states), ByPort(reference_));
  const PathPoint in = RandomPoint();
  const PathPoint out = system_.Unpack(system_.Pack(in));
  EXPECT_EQ(out.u, in.u);
  EXPECT_EQ(out.s, in.s);
  EXPECT_EQ(out.modes, ModesOf(states));
  const Eigen::MatrixXd of_in = ReactionsOf(in);
  Eigen::MatrixXd reactions(6, 2);
  reactions << of_in(0, 0), of_in(0, 1), of_in(1, 0), 0.0, of_in(2, 0), -0.3 * of_in(2, 0), of_in(3, 0),
      0.6 * of_in(3, 0), 0.0, 0.0, 0.0, 0.0;  // slip+: -mu r_n, slip-: +mu r_n
  EXPECT_EQ(Eigen::MatrixXd(ReactionsOf(out)), reactions);
}

TEST_F(MixedSystem, InequalitiesOfEachStateAndTheirValues) {
  system_.SetModes(
      ModesOf({State::kStick, State::kClosed, State::kSlipPlus, State::kSlipMinus, State::kOpen, State::kOpen}),
      ByPort(reference_));
  const PathPoint point = RandomPoint();
  const Eigen::VectorXd x = system_.Pack(point);
  const auto slip = [&](std::size_t i) {
    return contacts_[i]->Xi(point.u, point.s, 0) - reference_[static_cast<Eigen::Index>(i)];
  };
  struct Expected {
    int contact;
    ContactLimit limit;
    double value;
  };
  const std::vector<Expected> expected = {
      {0, ContactLimit::kNormalReaction, NormalReaction(point, 0)},
      {0, ContactLimit::kConePlus, 0.3 * NormalReaction(point, 0) + TangentialReaction(point, 0)},
      {0, ContactLimit::kConeMinus, 0.3 * NormalReaction(point, 0) - TangentialReaction(point, 0)},
      {1, ContactLimit::kNormalReaction, NormalReaction(point, 1)},
      {2, ContactLimit::kNormalReaction, NormalReaction(point, 2)},
      {2, ContactLimit::kSlip, slip(2)},
      {3, ContactLimit::kNormalReaction, NormalReaction(point, 3)},
      {3, ContactLimit::kSlip, -slip(3)},
      {4, ContactLimit::kGap, contacts_[4]->Gap(point.u, point.s, 0)},
      {5, ContactLimit::kGap, contacts_[5]->Gap(point.u, point.s, 0)}};
  const std::vector<Limit> limits = system_.mode_limits().All();
  ASSERT_EQ(limits.size(), expected.size());
  for (std::size_t k = 0; k < limits.size(); ++k) {
    EXPECT_EQ(limits[k].law, expected[k].contact) << k;
    EXPECT_EQ(limits[k].id, NumberOf(expected[k].limit)) << k;
    EXPECT_NEAR(system_.Value(limits[k], x), expected[k].value, kRounding) << k;
  }
}

TEST_F(MixedSystem, PinnedInequalitiesAreTheLastEquations) {
  system_.SetModes(
      ModesOf({State::kStick, State::kClosed, State::kSlipPlus, State::kSlipMinus, State::kOpen, State::kOpen}),
      ByPort(reference_));
  const std::vector<Limit> limits = system_.mode_limits().All();
  const Eigen::VectorXd x = system_.Pack(RandomPoint());
  system_.SetActive(limits);
  system_.FixLoadFactor(0.25);
  Eigen::VectorXd residual;
  system_.Residual(x, &residual);
  const Eigen::Index first = residual.size() - 1 - static_cast<Eigen::Index>(limits.size());
  for (std::size_t k = 0; k < limits.size(); ++k)
    EXPECT_NEAR(residual[first + static_cast<Eigen::Index>(k)], system_.Value(limits[k], x), kRounding);
  EXPECT_NEAR(residual[residual.size() - 1], x[structure_.NumDofs()] - 0.25, kRounding);
}

TEST_F(MixedSystem, SingularElementGivesWhatIsNotFinite) {
  PathPoint point = RandomPoint();
  point.u.head<2>() = Eigen::Vector2d(0.0, 0.1);  // b on a
  Eigen::VectorXd residual;
  system_.Residual(system_.Pack(point), &residual);
  EXPECT_FALSE(residual.allFinite());
}

// The sliding bar of Kanno & Martins 2005, Example 4.1, against its closed form.
class SlidingBarSystem : public testing::Test {
 protected:
  PathPoint ClosedForm(double x) const {
    PathPoint point;
    point.u = Eigen::Vector2d(x, 0.0);
    point.s = sliding_bar::LoadFactor(x);
    point.forces = sliding_bar::NormalReaction(x) * Eigen::Vector2d(1.0, -sliding_bar::kFriction);
    return point;
  }
  double LargestResidual(State state, double x, double reference) {
    system_.SetModes(ModesOf({state}), Eigen::Vector2d(0.0, reference));
    Eigen::VectorXd residual;
    system_.Residual(system_.Pack(ClosedForm(x)), &residual);
    return residual.lpNorm<Eigen::Infinity>();
  }

  const Scene scene_ = sliding_bar::MakeScene();
  const Structure structure_{scene_};
  const ContactPairs contacts_ = BuildContacts(scene_, structure_);
  const Laws laws_ = LawsOf(contacts_);
  FixedModeSystem system_{structure_, laws_};
};

TEST_F(SlidingBarSystem, ClosedFormSolvesSlipTowardsPlus) {
  for (double x = -4.5; x < 5.0; x += 0.5) {
    EXPECT_LE(LargestResidual(State::kSlipPlus, x, -5.0), kRounding) << x;
    EXPECT_LE(LargestResidual(State::kStick, x, x), kRounding) << x;  // every point may stick
  }
}

TEST_F(SlidingBarSystem, ClosedFormSolvesNoOtherState) {
  for (double x = -4.5; x < 4.6; x += 0.5) {
    EXPECT_GT(LargestResidual(State::kSlipMinus, x, -5.0), 1e-2) << x;
    EXPECT_GT(LargestResidual(State::kOpen, x, -5.0), 1e-2) << x;
    EXPECT_GT(LargestResidual(State::kStick, x, x - 0.25), 1e-2) << x;
  }
}

// With a square lattice of so many nodes along each side, braced, that hangs on the node c and on one that is fixed.
Scene WithLattice(Scene scene, int side) {
  const auto name = [](int i, int j) { return "g" + std::to_string(i) + "_" + std::to_string(j); };
  scene.nodes.push_back({"fixed", 1.0, 2.0, true, true});
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      scene.nodes.push_back({name(i, j), 1.5 + 0.1 * i, 1.9 + 0.1 * j});
      if (i > 0) scene.bars.push_back({{name(i - 1, j), name(i, j)}, 1.0});
      if (j > 0) scene.bars.push_back({{name(i, j - 1), name(i, j)}, 1.0});
      if (i > 0 && j > 0) scene.bars.push_back({{name(i - 1, j - 1), name(i, j)}, 0.7});
    }
  scene.bars.push_back({{"c", name(0, 0)}, 1.0});
  scene.bars.push_back({{"c", name(1, 0)}, 1.0});
  scene.bars.push_back({{"fixed", name(0, 1)}, 1.0});
  scene.bars.push_back({{"fixed", name(0, 3)}, 1.0});
  return scene;
}

// Solutions and signs of 24 contact states of the first six contacts, in their frame, are those of the system alone.
void ExpectSolvedInFrame(const Scene& scene) {
  const Structure structure(scene);
  const ContactPairs contacts = BuildContacts(scene, structure);
  const Laws laws = LawsOf(contacts);
  FixedModeSystem system(structure, laws);
  Random random(8);
  BorderedSolver framed;
  int other_signs = 0, before = 0;
  for (int i = 0; i < 24; ++i) {
    std::vector<State> states;
    for (std::size_t k = 0; k < 6; ++k) {
      const std::vector<State> options = StatesOf(*contacts[k]);
      states.push_back(
          options[static_cast<std::size_t>(random.Number(0.0, 0.999) * static_cast<double>(options.size()))]);
    }
    // Not both of two conditions for c, which moves along one axis.
    if (states[2] != State::kOpen) states[5] = State::kOpen;
    if (states[2] == State::kStick) states[2] = State::kSlipPlus;
    if (states[4] == State::kStick) states[4] = State::kSlipMinus;
    if (states[0] == State::kStick) states[1] = State::kOpen;
    if (states[0] != State::kOpen && states[1] != State::kOpen) states[1] = State::kOpen;
    if (states[3] == State::kStick) states[3] = State::kSlipPlus;
    states.resize(contacts.size(), State::kOpen);
    const auto all = static_cast<Eigen::Index>(contacts.size());
    system.SetModes(ModesOf(states));
    PathPoint point;
    point.u = structure.Start() + random.Vector(structure.NumDofs(), -0.01, 0.01);
    point.s = 0.3;
    point.forces = Eigen::VectorXd::Zero(2 * all);
    const Eigen::VectorXd rn = random.Vector(6, 0.1, 1.0);
    point.forces.head(12) = ByPort(rn, random.Vector(6, -1.0, 1.0));
    const Eigen::VectorXd x = system.Pack(point);
    const Eigen::SparseMatrix<double> transposed = system.TransposedJacobian(x);
    // A tangent, and a row with one entry where the border has none.
    Eigen::VectorXd row = Eigen::VectorXd::Unit(system.NumUnknowns(), system.NumDofs());
    if (i % 3 != 0) row.head(system.NumDofs() + 1) = random.Vector(system.NumDofs() + 1, -1.0, 1.0);
    ASSERT_NE(system.InFrame(), nullptr);
    ASSERT_TRUE(framed.FactorizeRegular(transposed, row, 0.0, system.InFrame())) << i;

    Eigen::SparseMatrix<double> matrix(system.NumUnknowns(), system.NumUnknowns());
    matrix.leftCols(transposed.cols()) = transposed;
    matrix.rightCols(1) = row.sparseView();
    Eigen::SparseLU<Eigen::SparseMatrix<double>> whole(matrix);
    ASSERT_EQ(whole.info(), Eigen::Success);
    const int sign = whole.signDeterminant() > 0.0 ? 1 : -1;
    EXPECT_EQ(framed.DeterminantSign(), sign) << i;
    if (i > 0 && sign != before) ++other_signs;
    before = sign;
    const Eigen::VectorXd b = random.Vector(system.NumEquations(), -1.0, 1.0);
    const Eigen::VectorXd solution = framed.Solve(b, 0.4);
    Eigen::VectorXd right(system.NumUnknowns());
    right << b, 0.4;
    EXPECT_LE((matrix.transpose() * solution - right).norm(), 1e-12 * solution.norm()) << i;
  }
  EXPECT_GE(other_signs, 4);
}

// A support that moves by (0.3, 0.4): of the force on it the share along that direction counts. In a frame along the
// motion it is the only unknown.
TEST(FixedModeSystem, NormDoesNotDependOnTheAxesOfASupport) {
  Scene scene;
  scene.nodes = {{"a", 0.0, 0.0, true, true}, {"b", 1.0, 0.5}};
  scene.bars = {{{"a", "b"}, 1.0}};
  const auto norm = [&](const SupportMotion& motion, const Eigen::VectorXd& change) {
    scene.support_motions = {motion};
    const Structure structure(scene);
    const Laws none;
    const FixedModeSystem system(structure, none);
    EXPECT_EQ(system.NumUnknowns(), change.size());
    return system.Norm(change);
  };
  Eigen::VectorXd oblique(7), along(5);
  oblique << 0.6, 0.8, 0.0, 2.0, 3.0, 0.6 * 4.0 - 0.8 * 100.0, 0.8 * 4.0 + 0.6 * 100.0;
  along << 1.0, 0.0, 2.0, 3.0, 4.0;
  EXPECT_EQ(norm({"a", 0.5, 0.0}, along), along.norm());
  EXPECT_NEAR(norm({"a", 0.3, 0.4}, oblique), along.norm(), kRounding * oblique.norm());
}

TEST(FixedModeSystem, LargeSystemsInTheirFrame) { ExpectSolvedInFrame(WithLattice(MovingScene(), 40)); }

// More candidates than fit a frame: it has places for those that touch.
TEST(FixedModeSystem, LargeSystemsInTheirFrameWithManyCandidates) {
  Scene scene = WithLattice(MovingScene(), 40);
  scene.obstacles.push_back({"far", ObstacleShape::kHalfPlane, 0.0, -100.0, 0.0, 1.0, 0.3});
  for (const Node& node : scene.nodes)
    if (node.name[0] == 'g') scene.contacts.push_back({node.name, "far"});
  ExpectSolvedInFrame(scene);
}

}  // namespace
}  // namespace contact_path::fixed_mode_system_test
