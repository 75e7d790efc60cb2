#include "contact_path/structure/solid.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SparseLU>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "contact_path/scene/configuration.h"
#include "contact_path/structure/structure.h"
#include "support/derivative_checker.h"
#include "support/random.h"
#include "support/solid_grid.h"

namespace contact_path::solid_test {
namespace {

constexpr double kThickness = 0.7;

// Distorted elements, those of six and eight nodes with bent sides.
Eigen::VectorXd Shape(int nodes) {
  Eigen::VectorXd x(2 * nodes);
  switch (nodes) {
    case 3: x << 0.0, 0.1, 1.2, -0.1, 0.3, 0.9; break;
    case 4: x << 0.0, 0.1, 1.2, -0.1, 1.0, 0.9, -0.2, 1.1; break;
    case 6: x << 0.0, 0.1, 1.2, -0.1, 0.3, 0.9, 0.6, 0.05, 0.8, 0.45, 0.1, 0.5; break;
    default: x << 0.0, 0.1, 1.2, -0.1, 1.0, 0.9, -0.2, 1.1, 0.6, 0.05, 1.15, 0.4, 0.4, 1.05, -0.05, 0.6; break;
  }
  return x;
}

std::vector<double> AsList(const Eigen::VectorXd& x) { return {x.begin(), x.end()}; }

Eigen::VectorXd Force(const Element& element, const Eigen::VectorXd& x) {
  Eigen::VectorXd force(x.size());
  element.Force(x, force);
  return force;
}

Eigen::MatrixXd Tangent(const Element& element, const Eigen::VectorXd& x) {
  Eigen::MatrixXd tangent(x.size(), x.size());
  element.Tangent(x, tangent);
  return tangent;
}

Eigen::MatrixXd TangentDerivative(const Element& element, const Eigen::VectorXd& x, const Eigen::VectorXd& v) {
  Eigen::MatrixXd derivative(x.size(), x.size());
  element.TangentDerivative(x, v, derivative);
  return derivative;
}

using Kind = std::tuple<int, MaterialModel, PlaneState>;

class Solids : public testing::TestWithParam<Kind> {
 protected:
  const int nodes_ = std::get<0>(GetParam());
  const Material material_ = LameMaterial(std::get<1>(GetParam()));
  const PlaneState plane_ = std::get<2>(GetParam());
  const PlaneMaterial law_{material_, plane_};
  const Eigen::VectorXd rest_ = Shape(nodes_);
  const std::unique_ptr<const Element> element_ = MakeSolidElement(law_, kThickness, AsList(rest_));
  Random random_{1};

  Eigen::VectorXd Deformed() { return rest_ + random_.Vector(rest_.size(), -0.08, 0.08); }
};

std::string KindName(const testing::TestParamInfo<Kind>& instance) {
  std::string name = "Nodes" + std::to_string(std::get<0>(instance.param));
  for (const char c : std::string(ToString(std::get<1>(instance.param))))
    if (c != '_') name += c;
  return name + "Plane" + std::string(ToString(std::get<2>(instance.param)));
}

INSTANTIATE_TEST_SUITE_P(Kinds, Solids,
                         testing::Combine(testing::Values(3, 4, 6, 8),
                                          testing::Values(MaterialModel::kNeoHookean, MaterialModel::kStVenantKirchhoff,
                                                          MaterialModel::kCiarletGeymonat, MaterialModel::kLinear),
                                          testing::Values(PlaneState::kStrain, PlaneState::kStress)),
                         KindName);

TEST_P(Solids, ForceIsTheGradientOfTheEnergy) {
  for (int i = 0; i < 5; ++i) {
    const Eigen::VectorXd x = Deformed();
    const auto energy = [&](const Eigen::VectorXd& at) { return Eigen::VectorXd::Constant(1, element_->Energy(at)); };
    EXPECT_TRUE(IsJacobian(energy, x, Force(*element_, x).transpose()));
  }
}

TEST_P(Solids, TangentIsTheDerivativeOfTheForce) {
  for (int i = 0; i < 5; ++i) {
    const Eigen::VectorXd x = Deformed();
    EXPECT_TRUE(IsJacobian([&](const Eigen::VectorXd& at) { return Force(*element_, at); }, x, Tangent(*element_, x)));
    EXPECT_EQ(Tangent(*element_, x), Tangent(*element_, x).transpose());
  }
}

TEST_P(Solids, TangentDerivativeIsTheDerivativeOfTheTangentAlongADirection) {
  for (int i = 0; i < 5; ++i) {
    const Eigen::VectorXd x = Deformed(), v = random_.Vector(x.size(), -1.0, 1.0);
    const auto along = [&](const Eigen::VectorXd& h) { return Entries(Tangent(*element_, x + h[0] * v)); };
    EXPECT_TRUE(IsJacobian(along, Eigen::VectorXd::Zero(1), Entries(TangentDerivative(*element_, x, v))));
    EXPECT_EQ(TangentDerivative(*element_, x, v), TangentDerivative(*element_, x, v).transpose());
  }
}

// Of any size. The linear law knows translations alone, and rotations by their tangent.
TEST_P(Solids, RigidMotionsTakeNoEnergyAndNoForce) {
  for (int i = 0; i < 20; ++i) {
    Eigen::VectorXd x = rest_;
    const Eigen::Vector2d by = random_.Vector(2, -100.0, 100.0);
    const double angle = random_.Number(-30.0, 30.0);
    for (Eigen::Index k = 0; k < x.size(); k += 2) {
      Eigen::Vector2d at = x.segment<2>(k);
      if (!element_->Linear()) at = Eigen::Rotation2Dd(angle) * at;
      x.segment<2>(k) = at + by;
    }
    // Positions of the order of 100 are exact to 1e-14.
    EXPECT_LE(std::abs(element_->Energy(x)), 1e-26);
    EXPECT_LE(Force(*element_, x).lpNorm<Eigen::Infinity>(), 2e-13);
  }
  Eigen::VectorXd turn(rest_.size());
  for (Eigen::Index k = 0; k < turn.size(); k += 2) turn.segment<2>(k) << -rest_[k + 1], rest_[k];
  EXPECT_LE((Tangent(*element_, rest_) * turn).lpNorm<Eigen::Infinity>(), 1e-14);
}

// All of its tangent but the three rigid motions: no mode without stiffness. Eight nodes with reduced integration have
// one more, which a second element takes away.
TEST_P(Solids, ModesWithoutStiffness) {
  const Eigen::VectorXd values =
      Eigen::MatrixXd(Tangent(*element_, rest_)).selfadjointView<Eigen::Lower>().eigenvalues();
  Eigen::Index without = 0;
  for (const double value : values) without += std::abs(value) < 1e-13 ? 1 : 0;
  EXPECT_GE(values.minCoeff(), -1e-13);
  EXPECT_EQ(without, nodes_ == 8 ? 4 : 3);
}

// A mesh of distorted elements under a linear field: uniform strain, and no force on the nodes inside.
TEST_P(Solids, PatchTest) {
  Scene scene;
  scene.materials = {material_};
  Solid solid;
  solid.material = "m";
  solid.thickness = kThickness;
  solid.plane = plane_;
  solid.nodes_per_element = nodes_;
  AddGrid(
      &scene, 3, 3,
      [&](double x, double y) {
        const bool inside = x > 0.0 && x < 1.0 && y > 0.0 && y < 1.0;
        return inside ? Eigen::Vector2d(Eigen::Vector2d(x, y) + random_.Vector(2, -0.03, 0.03)) : Eigen::Vector2d(x, y);
      },
      solid);
  const Structure structure(scene);
  PlaneMaterial::Gradient F(1.1, 0.2, -0.15, 0.9);
  Eigen::VectorXd u(structure.NumDofs()), force(structure.NumDofs());
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    u[structure.Dof(static_cast<int>(i), 0)] = F[0] * node.x + F[1] * node.y;
    u[structure.Dof(static_cast<int>(i), 1)] = F[2] * node.x + F[3] * node.y;
  }
  EXPECT_NEAR(structure.Energy(u), kThickness * law_.Energy(F), 1e-15);
  structure.InternalForce(u, force);
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    const Eigen::Vector2d at(force[structure.Dof(static_cast<int>(i), 0)],
                             force[structure.Dof(static_cast<int>(i), 1)]);
    if (node.x > 0.0 && node.x < 1.0 && node.y > 0.0 && node.y < 1.0) {
      EXPECT_LE(at.lpNorm<Eigen::Infinity>(), 5e-15);
    } else if (node.x == 1.0 && node.y > 0.0 && node.y < 1.0) {
      right += at;
    }
  }
  // Traction P n on the right side; its corners take the rest.
  const PlaneMaterial::Gradient P = law_.Stress(F);
  const double share = nodes_ <= 4 ? 2.0 / 3.0 : 8.0 / 9.0;
  EXPECT_LE((right - share * kThickness * Eigen::Vector2d(P[0], P[2])).lpNorm<Eigen::Infinity>(), 5e-15);
}

TEST_P(Solids, TellsWhereItIsInsideOut) {
  EXPECT_NEAR(element_->AreaRatio(rest_), 1.0, 1e-15);
  Eigen::VectorXd turned = rest_;
  for (Eigen::Index k = 0; k < turned.size(); k += 2) turned[k] *= -0.5;
  if (element_->Linear()) {
    EXPECT_EQ(element_->AreaRatio(turned), 1.0);
    EXPECT_TRUE(std::isfinite(element_->Energy(turned)));
    return;
  }
  EXPECT_NEAR(element_->AreaRatio(turned), -0.5, 1e-14);
  EXPECT_FALSE(std::isfinite(element_->Energy(turned)));
  EXPECT_FALSE(Force(*element_, turned).allFinite());
  EXPECT_FALSE(Tangent(*element_, turned).allFinite());
}

// Cook's membrane: a trapezoid (0, 0), (48, 44), (48, 60), (0, 44), held on its left side, sheared on its right one by
// a load of 1 in all. What the middle of its right side moves upwards.
struct Membrane {
  double nu = 1.0 / 3.0;
  PlaneState plane = PlaneState::kStress;
  int nodes = 4;
};

double TipOfMembrane(const Membrane& of, int cells) {
  Scene scene;
  Material material;
  material.name = "m";
  material.model = MaterialModel::kLinear;
  material.E = 1.0;
  material.nu = of.nu;
  scene.materials = {material};
  Solid solid;
  solid.material = "m";
  solid.plane = of.plane;
  solid.nodes_per_element = of.nodes;
  AddGrid(
      &scene, cells, cells,
      [](double x, double y) { return Eigen::Vector2d(48.0 * x, 44.0 * x + y * (44.0 - 28.0 * x)); }, solid);
  for (Node& node : scene.nodes) node.fixed_x = node.fixed_y = node.x == 0.0;
  // Consistent loads of a constant traction.
  for (int cell = 0; cell < cells; ++cell)
    for (int k = 0; k < 3; ++k) {
      const bool quadratic = of.nodes > 4, middle = k == 1;
      if (middle && !quadratic) continue;
      const double share = quadratic ? (middle ? 4.0 : 1.0) / 6.0 : 0.5;
      scene.loads.push_back({GridNode(&scene, 2 * cells, 2 * cell + k).name, 0.0, share / cells});
    }
  const Structure structure(scene);
  Eigen::SparseMatrix<double> tangent = structure.TangentPattern();
  structure.Tangent(structure.Start(), &tangent);
  Eigen::SparseLU<Eigen::SparseMatrix<double>> factors(tangent);
  const Eigen::VectorXd moved = factors.solve(structure.Loads().Reference());
  const SceneIndex index(scene);
  const auto tip = static_cast<int>(index.Node(GridNode(&scene, 2 * cells, cells).name));
  return moved[structure.Dof(tip, 1)];
}

// 23.96 where refined. The corner at the upper left, where the stress is singular, bounds the order of convergence
// below two.
TEST(CooksMembrane, ConvergesToItsTip) {
  for (const int nodes : {3, 4, 6, 8}) {
    const int finest = nodes <= 4 ? 64 : 32;
    const double coarse = TipOfMembrane({1.0 / 3.0, PlaneState::kStress, nodes}, finest / 4);
    const double middle = TipOfMembrane({1.0 / 3.0, PlaneState::kStress, nodes}, finest / 2);
    const double fine = TipOfMembrane({1.0 / 3.0, PlaneState::kStress, nodes}, finest);
    EXPECT_NEAR(fine, 23.96, nodes == 3 ? 0.3 : nodes == 4 ? 0.06 : 0.02) << nodes;
    const double order = std::log2(std::abs((middle - coarse) / (fine - middle)));
    EXPECT_GE(order, 1.2) << nodes;
  }
}

// Nearly incompressible in plane strain: on the same mesh the element of eight nodes keeps nearly all of its motion,
// and the element of four nodes loses much of it.
TEST(CooksMembrane, EightNodesDoNotLock) {
  const double reference = TipOfMembrane({0.4999, PlaneState::kStrain, 8}, 32);
  const double eight = TipOfMembrane({0.4999, PlaneState::kStrain, 8}, 8);
  const double four = TipOfMembrane({0.4999, PlaneState::kStrain, 4}, 16);  // as many unknowns
  EXPECT_NEAR(eight, reference, 0.05 * reference);
  EXPECT_LT(four, 0.4 * reference);
}

}  // namespace
}  // namespace contact_path::solid_test
