#include "contact_path/structure/structure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <utility>

#include "support/derivative_checker.h"
#include "support/mixed_scene.h"
#include "support/random.h"

namespace contact_path::structure_test {
namespace {

constexpr double kRounding = 1e-14;  // of sums of a few terms of order 1

class MixedStructure : public testing::Test {
 protected:
  Eigen::VectorXd Force(const Eigen::VectorXd& u) const {
    Eigen::VectorXd force(structure_.NumDofs());
    structure_.InternalForce(u, force);
    return force;
  }
  Eigen::MatrixXd Tangent(const Eigen::VectorXd& u) const {
    Eigen::SparseMatrix<double> tangent = structure_.TangentPattern();
    structure_.Tangent(u, &tangent);
    return tangent;
  }
  Eigen::MatrixXd TangentDerivative(const Eigen::VectorXd& u, const Eigen::VectorXd& v) const {
    Eigen::SparseMatrix<double> derivative = structure_.TangentPattern();
    structure_.TangentDerivative(u, v, &derivative);
    return derivative;
  }
  // Near the initial positions: no bar comes near zero length.
  Eigen::VectorXd Configuration() { return structure_.Start() + random_.Vector(6, -0.15, 0.15); }

  const Structure structure_{MixedScene()};
  Random random_{3};
};

TEST_F(MixedStructure, NumbersTheFreeComponentsInNodeOrder) {
  EXPECT_EQ(structure_.NumDofs(), 6);
  const int expected[5][2] = {{-1, -1}, {0, 1}, {-1, 2}, {3, 4}, {5, -1}};
  for (int node = 0; node < 5; ++node)
    for (int axis = 0; axis < 2; ++axis) EXPECT_EQ(structure_.Dof(node, axis), expected[node][axis]);
  Eigen::VectorXd initial(6);
  initial << 1.1, 0.3, 1.2, 0.2, 1.3, 0.7;
  EXPECT_EQ(structure_.Start(), initial);
}

TEST_F(MixedStructure, AllValuesHoldTheFixedComponents) {
  Eigen::VectorXd u(6), full(10);
  u << 10.0, 11.0, 12.0, 13.0, 14.0, 15.0;
  full << 0.0, 0.1, 10.0, 11.0, 1.4, 12.0, 13.0, 14.0, 15.0, 0.9;
  EXPECT_EQ(structure_.AllValues(u), full);
}

TEST_F(MixedStructure, LoadsAddUpAndThoseOnSupportsAreLeftOut) {
  Eigen::VectorXd reference(6), constant(6);
  reference << 0.5, -0.2, 0.0, 0.0, 0.0, 0.0;
  constant << 0.0, 0.0, 0.7, 0.1, 0.0, 0.0;
  EXPECT_EQ(structure_.Loads().Reference(), reference);
  EXPECT_EQ(structure_.Loads().Constant(), constant);
}

TEST_F(MixedStructure, DerivativesMeetDifferences) {
  for (int i = 0; i < 10; ++i) {
    const Eigen::VectorXd u = Configuration(), v = random_.Vector(6, -1.0, 1.0);
    const auto energy = [&](const Eigen::VectorXd& at) { return Eigen::VectorXd::Constant(1, structure_.Energy(at)); };
    EXPECT_TRUE(IsJacobian(energy, u, Force(u).transpose()));
    EXPECT_TRUE(IsJacobian([&](const Eigen::VectorXd& at) { return Force(at); }, u, Tangent(u)));
    EXPECT_TRUE(IsJacobian([&](const Eigen::VectorXd& at) { return Eigen::VectorXd(Tangent(at) * v); }, u,
                           TangentDerivative(u, v)));
    const auto along = [&](const Eigen::VectorXd& h) { return Entries(Tangent(u + h[0] * v)); };
    EXPECT_TRUE(IsJacobian(along, Eigen::VectorXd::Zero(1), Entries(TangentDerivative(u, v))));
  }
}

TEST_F(MixedStructure, TangentAndItsDerivativeAreSymmetric) {
  const Eigen::VectorXd u = Configuration(), v = random_.Vector(6, -1.0, 1.0);
  EXPECT_LE((Tangent(u) - Tangent(u).transpose()).cwiseAbs().maxCoeff(), kRounding);
  EXPECT_LE((TangentDerivative(u, v) - TangentDerivative(u, v).transpose()).cwiseAbs().maxCoeff(), kRounding);
}

// Which free components share an element, and the diagonal: read off the scene. Component order b.x b.y c.y d.x d.y
// e.x.
std::set<std::pair<int, int>> CoupledComponents() {
  const std::vector<std::vector<int>> cliques = {{0, 1, 2}, {2, 3, 4}, {3, 4, 5}};  // b-c, c-d, d-e
  std::set<std::pair<int, int>> coupled;
  for (const std::vector<int>& clique : cliques)
    for (const int i : clique)
      for (const int j : clique) coupled.emplace(i, j);
  return coupled;
}

TEST_F(MixedStructure, PatternIsWhatElementsCouple) {
  const Eigen::SparseMatrix<double>& pattern = structure_.TangentPattern();
  EXPECT_TRUE(pattern.isCompressed());
  std::set<std::pair<int, int>> entries;
  for (int column = 0; column < pattern.cols(); ++column) {
    int last = -1;
    for (Eigen::SparseMatrix<double>::InnerIterator it(pattern, column); it; ++it) {
      EXPECT_GT(it.row(), last);
      last = static_cast<int>(it.row());
      entries.emplace(last, column);
    }
  }
  EXPECT_EQ(entries, CoupledComponents());
}

TEST_F(MixedStructure, EveryEntryOfThePatternIsUsedAndNoOther) {
  const Eigen::VectorXd u = Configuration(), v = random_.Vector(6, -1.0, 1.0);
  const Eigen::MatrixXd differences = DifferenceJacobian([&](const Eigen::VectorXd& at) { return Force(at); }, u);
  const Eigen::MatrixXd tangent = Tangent(u), derivative = TangentDerivative(u, v);
  const std::set<std::pair<int, int>> coupled = CoupledComponents();
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      const bool expected = coupled.count({i, j}) > 0;
      EXPECT_EQ(differences(i, j) != 0.0, expected) << i << ", " << j;
      EXPECT_EQ(tangent(i, j) != 0.0, expected) << i << ", " << j;
      EXPECT_EQ(derivative(i, j) != 0.0, expected) << i << ", " << j;
    }
  }
}

TEST_F(MixedStructure, DiagonalIsInThePatternOfANodeThatNothingHolds) {
  Scene scene = MixedScene();
  scene.nodes.push_back({"lonely", 5.0, 5.0});
  const Structure structure(scene);
  EXPECT_EQ(structure.TangentPattern().nonZeros(), static_cast<Eigen::Index>(CoupledComponents().size()) + 2);
}

TEST_F(MixedStructure, EvaluationsDoNotAddToWhatWasThere) {
  const Eigen::VectorXd u = Configuration(), v = random_.Vector(6, -1.0, 1.0);
  Eigen::SparseMatrix<double> used = structure_.TangentPattern();
  structure_.Tangent(Configuration(), &used);
  structure_.Tangent(u, &used);
  EXPECT_EQ(Eigen::MatrixXd(used), Tangent(u));
  structure_.TangentDerivative(u, v, &used);
  EXPECT_EQ(Eigen::MatrixXd(used), TangentDerivative(u, v));
  Eigen::VectorXd force = Eigen::VectorXd::Constant(structure_.NumDofs(), 3.0);
  structure_.InternalForce(u, force);
  EXPECT_EQ(force, Force(u));
}

// Two bars of length 1 in a line, the middle node pulled out by h: energy 2 EA (sqrt(1 + h^2) - 1)^2 / 2.
TEST(Structure, EnergyOfTwoBarsInALine) {
  Scene scene;
  scene.nodes = {{"l", -1.0, 0.0, true, true}, {"m", 0.0, 0.0, true, false}, {"r", 1.0, 0.0, true, true}};
  scene.bars = {{{"l", "m"}, 3.0}, {{"r", "m"}, 3.0}};
  const Structure structure(scene);
  const Eigen::VectorXd u = Eigen::VectorXd::Constant(1, 0.75);  // length 1.25
  EXPECT_NEAR(structure.Energy(u), 3.0 * 0.0625, kRounding);
  Eigen::VectorXd force(1);
  structure.InternalForce(u, force);
  EXPECT_NEAR(force[0], 2.0 * 3.0 * 0.25 * 0.75 / 1.25, kRounding);
}

TEST(Structure, RestLengthOtherThanTheDistanceStressesTheStart) {
  Scene scene;
  scene.nodes = {{"a", 0.0, 0.0, true, true}, {"b", 2.0, 0.0}};
  scene.bars = {{{"a", "b"}, 3.0, 1.6, StrainMeasure::kBiot}};
  const Structure stretched(scene);
  Eigen::VectorXd force(2);
  stretched.InternalForce(stretched.Start(), force);
  EXPECT_NEAR(force[0], 0.75, kRounding);
  scene.bars[0].rest_length = 0.0;
  const Structure relaxed(scene);
  relaxed.InternalForce(relaxed.Start(), force);
  EXPECT_EQ(force.norm(), 0.0);
}

TEST(Structure, StiffnessSymmetricToRoundingIsMadeSymmetric) {
  Scene scene;
  scene.nodes = {{"p", 0.0, 0.0}};
  scene.superelements = {{{"p"}, {1.0, 0.5, 0.5 + 1e-10, 2.0}}};
  const Structure structure(scene);
  Eigen::SparseMatrix<double> tangent = structure.TangentPattern();
  structure.Tangent(structure.Start(), &tangent);
  EXPECT_EQ(tangent.coeff(0, 1), tangent.coeff(1, 0));
  EXPECT_NEAR(tangent.coeff(0, 1), 0.5 + 0.5e-10, 1e-15);
}

// A rod from its first node to its second one, with a rotation at the second: W = EA (l - l0)^2 / 2 + K sin^2(phi -
// angle of the rod).
class RodWithRotation : public Element {
 public:
  const std::vector<LocalDof>& Dofs() const override {
    static const std::vector<LocalDof> dofs = {{0, Field::kPosition, 0},
                                               {0, Field::kPosition, 1},
                                               {1, Field::kPosition, 0},
                                               {1, Field::kPosition, 1},
                                               {1, Field::kRotation, 0}};
    return dofs;
  }
  double Energy(const Eigen::Ref<const Eigen::VectorXd>& x) const override {
    const Eigen::Vector2d span = x.segment<2>(2) - x.segment<2>(0);
    const double across = span.x() * std::sin(x[4]) - span.y() * std::cos(x[4]);
    return 0.5 * std::pow(span.squaredNorm() - 1.0, 2) + 0.8 * across * across;
  }
  void Force(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> force) const override {
    const auto energy = [this](const Eigen::VectorXd& at) { return Eigen::VectorXd::Constant(1, Energy(at)); };
    force = DifferenceJacobian(energy, x).transpose();
  }
  void Tangent(const Eigen::Ref<const Eigen::VectorXd>&, Eigen::Ref<Eigen::MatrixXd> tangent) const override {
    tangent.setOnes();
  }
  void TangentDerivative(const Eigen::Ref<const Eigen::VectorXd>&, const Eigen::Ref<const Eigen::VectorXd>&,
                         Eigen::Ref<Eigen::MatrixXd> derivative) const override {
    derivative.setZero();
  }
};

// The unknowns follow from what elements ask for: c gets a rotation, after its positions.
TEST(StructureWithRotation, ElementsSayWhichUnknownsThereAre) {
  Scene scene = MixedScene();
  scene.bars.clear();
  scene.superelements.clear();
  const Configuration configuration = Configuration::Of(scene);
  std::vector<PlacedElement> elements;
  elements.push_back({std::make_unique<RodWithRotation>(), {1, 2}});
  const Structure structure(scene, SceneIndex(scene), configuration, std::move(elements));
  EXPECT_EQ(structure.NumDofs(), 7);
  EXPECT_EQ(structure.Dofs().Dof(2, Field::kRotation, 0), 3);  // after b.x, b.y, c.y
  EXPECT_EQ(structure.Dof(3, 0), 4);
  EXPECT_EQ(structure.Start()[3], 0.0);
  EXPECT_EQ(UnitOf(Field::kRotation, 5.0), 1.0);

  Eigen::VectorXd u = structure.Start();
  u[3] = 0.4;
  const Eigen::VectorXd values = structure.AllValues(u);
  ASSERT_EQ(values.size(), 11);
  EXPECT_EQ(values[6], 0.4);
  EXPECT_EQ(values.segment<2>(4), Eigen::Vector2d(1.4, 1.2));
  const double across = 0.3 * std::sin(0.4) - 0.9 * std::cos(0.4);
  EXPECT_NEAR(structure.Energy(u), 0.5 * std::pow(0.3 * 0.3 + 0.9 * 0.9 - 1.0, 2) + 0.8 * across * across, kRounding);
  Eigen::VectorXd force(7);
  structure.InternalForce(u, force);
  EXPECT_NEAR(force[3], 1.6 * across * (0.3 * std::cos(0.4) + 0.9 * std::sin(0.4)), 1e-9);  // the moment
  EXPECT_EQ(force.tail<3>(), Eigen::Vector3d::Zero());
  EXPECT_EQ(structure.TangentPattern().nonZeros(), 4 * 4 + 3);
}

// Held components and the start come from the start, rest lengths from the reference.
TEST(StructureConfiguration, StartAndReferenceAreApart) {
  Scene scene;
  scene.nodes = {{"a", 0.0, 0.0, true, true}, {"b", 1.0, 0.0}};
  scene.bars = {{{"a", "b"}, 1.0}};
  Configuration configuration = Configuration::Of(scene);
  configuration.start[0] = -1.0;  // the support has been moved: the bar is twice as long as it wants to be
  const Structure structure(scene, SceneIndex(scene), configuration);
  EXPECT_EQ(structure.StartPosition(0), Eigen::Vector2d(-1.0, 0.0));
  EXPECT_NEAR(structure.Energy(structure.Start()), 0.5, kRounding);
}

// A support that has been moved through the element: rounding of residuals is measured by the other elements alone.
TEST(StructureConfiguration, AnElementThatIsInsideOutAtTheStart) {
  for (const bool first : {true, false}) {
    Scene scene;
    scene.nodes = {
        {"a", 0.0, 0.0, true, true}, {"b", 1.0, 0.0}, {"c", 0.0, 1.0, true, true}, {"d", 2.0, 0.0, true, true}};
    scene.bars = {{{"b", "d"}, 3.0}};
    Material material;
    material.name = "m";
    material.mu = 1.0;
    material.lambda = 1.0;
    scene.materials = {material};
    Solid solid;
    solid.name = "s";
    solid.material = "m";
    solid.nodes = {"a", "b", "c"};
    scene.solids = {solid};
    if (first) std::reverse(scene.nodes.begin(), scene.nodes.end());
    const SceneIndex index(scene);
    Configuration configuration = Configuration::Of(scene);
    configuration.start[2 * index.Node("c") + 1] = -1.0;
    const Structure structure(scene, index, configuration);
    EXPECT_TRUE(structure.ResidualUnits().allFinite()) << structure.ResidualUnits().transpose();
  }
}

}  // namespace
}  // namespace contact_path::structure_test
