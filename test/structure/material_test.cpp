#include "contact_path/structure/material.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <string>
#include <tuple>

#include "support/derivative_checker.h"
#include "support/random.h"
#include "support/solid_grid.h"

namespace contact_path::material_test {
namespace {

// W of F in the plane and C33, from its definition in three dimensions. Linear: e33 = C33 - 1.
double EnergyInSpace(const Material& of, const Eigen::Vector4d& F, double C33) {
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
  gradient << F[0], F[1], 0.0, F[2], F[3], 0.0, 0.0, 0.0, std::sqrt(C33);
  const Eigen::Matrix3d unit = Eigen::Matrix3d::Identity();
  if (of.model == MaterialModel::kLinear) {
    gradient(2, 2) = C33;
    const Eigen::Matrix3d e = 0.5 * (gradient + gradient.transpose()) - unit;
    return 0.5 * of.lambda * e.trace() * e.trace() + of.mu * e.squaredNorm();
  }
  const Eigen::Matrix3d C = gradient.transpose() * gradient;
  const double i1 = C.trace(), i2 = 0.5 * (i1 * i1 - (C * C).trace()), i3 = C.determinant();
  switch (of.model) {
    case MaterialModel::kNeoHookean:
      return 0.5 * of.mu * (i1 - 3.0 - std::log(i3)) + 0.125 * of.lambda * std::pow(std::log(i3), 2);
    case MaterialModel::kStVenantKirchhoff: {
      const Eigen::Matrix3d E = 0.5 * (C - unit);
      return 0.5 * of.lambda * E.trace() * E.trace() + of.mu * E.squaredNorm();
    }
    default: {
      const double b = 0.5 * of.mu - of.a, d = 0.25 * of.lambda - 0.5 * of.mu + of.a;
      return of.a * (i1 - 3.0) + b * (i2 - 3.0) + d * (i3 - 1.0) - 0.5 * (0.5 * of.lambda + of.mu) * std::log(i3);
    }
  }
}

class Materials : public testing::TestWithParam<std::tuple<MaterialModel, PlaneState>> {
 protected:
  const Material material_ = LameMaterial(std::get<0>(GetParam()));
  const PlaneState plane_ = std::get<1>(GetParam());
  const PlaneMaterial law_{material_, plane_};
  Random random_{1};
  const PlaneMaterial::Gradient rest_{1.0, 0.0, 0.0, 1.0};

  PlaneMaterial::Gradient Deformed() { return rest_ + random_.Vector(4, -0.3, 0.3); }
};

std::string KindName(const testing::TestParamInfo<std::tuple<MaterialModel, PlaneState>>& instance) {
  std::string name;
  for (const char c : std::string(ToString(std::get<0>(instance.param))))
    if (c != '_') name += c;
  return name + "Plane" + std::string(ToString(std::get<1>(instance.param)));
}

INSTANTIATE_TEST_SUITE_P(Laws, Materials,
                         testing::Combine(testing::Values(MaterialModel::kNeoHookean, MaterialModel::kStVenantKirchhoff,
                                                          MaterialModel::kCiarletGeymonat, MaterialModel::kLinear),
                                          testing::Values(PlaneState::kStrain, PlaneState::kStress)),
                         KindName);

TEST_P(Materials, StressIsTheGradientOfTheEnergy) {
  for (int i = 0; i < 20; ++i) {
    const PlaneMaterial::Gradient F = Deformed();
    const auto energy = [&](const Eigen::VectorXd& at) { return Eigen::VectorXd::Constant(1, law_.Energy(at)); };
    EXPECT_TRUE(IsJacobian(energy, F, law_.Stress(F).transpose()));
  }
}

TEST_P(Materials, TangentIsTheDerivativeOfTheStress) {
  for (int i = 0; i < 20; ++i) {
    const PlaneMaterial::Gradient F = Deformed();
    EXPECT_TRUE(IsJacobian([&](const Eigen::VectorXd& at) { return law_.Stress(at); }, F, law_.Tangent(F)));
  }
}

TEST_P(Materials, TangentDerivativeIsTheDerivativeOfTheTangentAlongADirection) {
  for (int i = 0; i < 20; ++i) {
    const PlaneMaterial::Gradient F = Deformed(), V = random_.Vector(4, -1.0, 1.0);
    const auto along = [&](const Eigen::VectorXd& h) { return Entries(law_.Tangent(F + h[0] * V)); };
    EXPECT_TRUE(IsJacobian(along, Eigen::VectorXd::Zero(1), Entries(law_.TangentDerivative(F, V))));
  }
}

// Of all thicknesses, that of plane stress makes the energy of three dimensions least; that of plane strain is the
// initial one.
TEST_P(Materials, EnergyIsThatOfThreeDimensions) {
  for (int i = 0; i < 20; ++i) {
    const PlaneMaterial::Gradient F = Deformed();
    double C33 = 1.0, step = plane_ == PlaneState::kStrain ? 0.0 : 0.1;
    double least = EnergyInSpace(material_, F, C33);
    while (step > 1e-9) {
      const double before = least;
      for (const double sign : {1.0, -1.0}) {
        const double energy = EnergyInSpace(material_, F, C33 + sign * step);
        if (!(energy < least)) continue;
        least = energy;
        C33 += sign * step;
        break;
      }
      if (least == before) step *= 0.5;
    }
    EXPECT_NEAR(law_.Energy(F), least, 1e-14);
  }
}

// Rotations leave it at rest, except that of the linear law.
TEST_P(Materials, RestTakesNoEnergyAndNoStress) {
  EXPECT_EQ(law_.Energy(rest_), 0.0);
  EXPECT_LE(law_.Stress(rest_).lpNorm<Eigen::Infinity>(), 1e-15);
  if (law_.Linear()) return;
  for (int i = 0; i < 20; ++i) {
    const double angle = random_.Number(-10.0, 10.0), c = std::cos(angle), s = std::sin(angle);
    EXPECT_LE(std::abs(law_.Energy({c, -s, s, c})), 1e-30);
    EXPECT_LE(law_.Stress({c, -s, s, c}).lpNorm<Eigen::Infinity>(), 2e-15);
  }
}

// At rest all laws have Hooke's tangent: lambda, mu, and in plane stress E / (1 - nu^2).
TEST_P(Materials, HookesTangentAtRest) {
  const double lambda = plane_ == PlaneState::kStrain ? 1.5 : 2.0 * 1.5 / (1.5 + 2.0);
  PlaneMaterial::Square expected = PlaneMaterial::Square::Zero();
  expected(0, 0) = expected(3, 3) = lambda + 2.0;
  expected(0, 3) = expected(3, 0) = lambda;
  expected.block<2, 2>(1, 1).setOnes();
  EXPECT_LE((law_.Tangent(rest_) - expected).lpNorm<Eigen::Infinity>(), 1e-14);
}

// The linear law knows no area.
TEST_P(Materials, NoValueInsideOut) {
  for (const PlaneMaterial::Gradient& F :
       {PlaneMaterial::Gradient(-0.5, 0.0, 0.0, 1.0), PlaneMaterial::Gradient(0.0, 0.0, 0.0, 1.0)}) {
    EXPECT_EQ(std::isfinite(law_.Energy(F)), law_.Linear());
    EXPECT_EQ(law_.Stress(F).allFinite(), law_.Linear());
    EXPECT_EQ(law_.Tangent(F).allFinite(), law_.Linear());
  }
}

// Uniaxial stress in plane stress is that of a bar: of the neo-Hookean bar with the stretch l and the lateral stretch
// k, mu (k^2 - 1) + lambda ln(l k^2) = 0 and P = (mu (l^2 - 1) + lambda ln(l k^2)) / l.
TEST(MaterialClosedForms, UniaxialNeoHookean) {
  const PlaneMaterial law(LameMaterial(MaterialModel::kNeoHookean), PlaneState::kStress);
  for (const double l : {0.3, 0.7, 1.0, 1.5, 4.0}) {
    double k = 1.0;
    for (int i = 0; i < 100; ++i) k -= (k * k - 1.0 + 1.5 * std::log(l * k * k)) / (2.0 * k + 3.0 / k);
    const PlaneMaterial::Gradient P = law.Stress({l, 0.0, 0.0, k});
    EXPECT_NEAR(P[0], (l * l - 1.0 + 1.5 * std::log(l * k * k)) / l, 1e-14 * (1.0 + l));
    EXPECT_NEAR(P[3], 0.0, 1e-14);
  }
}

// Simple shear g keeps areas: W = mu g^2 / 2 and P12 = mu g of the neo-Hookean and the Ciarlet-Geymonat material in
// plane strain; W = mu g^2 / 2 + (lambda / 8 + mu / 4) g^4 of the St. Venant-Kirchhoff material.
TEST(MaterialClosedForms, SimpleShear) {
  const double g = 0.7;
  for (const MaterialModel model : {MaterialModel::kNeoHookean, MaterialModel::kCiarletGeymonat}) {
    const PlaneMaterial law(LameMaterial(model), PlaneState::kStrain);
    EXPECT_NEAR(law.Energy({1.0, g, 0.0, 1.0}), 0.5 * g * g, 1e-15);
    EXPECT_NEAR(law.Stress({1.0, g, 0.0, 1.0})[1], g, 1e-15);
  }
  const PlaneMaterial law(LameMaterial(MaterialModel::kStVenantKirchhoff), PlaneState::kStrain);
  EXPECT_NEAR(law.Energy({1.0, g, 0.0, 1.0}), 0.5 * g * g + (1.5 / 8.0 + 0.25) * g * g * g * g, 1e-15);
}

// Plane stress far from rest, of materials that bulge and that hardly do, and of negative nu.
TEST(MaterialClosedForms, PlaneStressFarFromRest) {
  for (const double nu : {-0.3, 0.0, 0.3, 0.4999}) {
    Material material;
    material.E = 1.0;
    material.nu = nu;
    const PlaneMaterial law(material, PlaneState::kStress);
    for (const double l : {0.05, 0.5, 0.9, 1.1, 3.0, 30.0}) {
      if (nu < 0.0 && l < 0.9) continue;  // no thickness is without stress
      const double P = law.Stress({l, 0.0, 0.0, l})[0];
      EXPECT_EQ(P > 0.0, l > 1.0) << nu << " " << l;
      EXPECT_EQ(P < 0.0, l < 1.0) << nu << " " << l;
    }
  }
}

TEST(Elasticity, BothPairsOfConstants) {
  Material material;
  material.E = 2.6;
  material.nu = 0.3;
  const Lame lame = LameOf(material);
  EXPECT_NEAR(lame.mu, 1.0, 1e-15);
  EXPECT_NEAR(lame.lambda, 1.5, 1e-15);
  EXPECT_NEAR(YoungModulus(lame), 2.6, 1e-15);
  EXPECT_NEAR(PoissonRatio(lame), 0.3, 1e-15);
}

}  // namespace
}  // namespace contact_path::material_test
