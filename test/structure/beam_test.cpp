#include "contact_path/structure/beam.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <string>
#include <tuple>

#include "support/derivative_checker.h"
#include "support/random.h"

namespace contact_path::beam_test {
namespace {

constexpr double kTurn = 6.283185307179586;

const Eigen::Vector2d kChord(1.2, -0.5);  // length 1.3

Eigen::Index Size(const BeamSegment& beam) { return static_cast<Eigen::Index>(beam.Dofs().size()); }

Eigen::VectorXd Force(const BeamSegment& beam, const Eigen::VectorXd& x) {
  Eigen::VectorXd force(Size(beam));
  beam.Force(x, force);
  return force;
}

Eigen::MatrixXd Tangent(const BeamSegment& beam, const Eigen::VectorXd& x) {
  Eigen::MatrixXd tangent(Size(beam), Size(beam));
  beam.Tangent(x, tangent);
  return tangent;
}

Eigen::MatrixXd TangentDerivative(const BeamSegment& beam, const Eigen::VectorXd& x, const Eigen::VectorXd& v) {
  Eigen::MatrixXd derivative(Size(beam), Size(beam));
  beam.TangentDerivative(x, v, derivative);
  return derivative;
}

// Shear deformation, hinged first end, hinged second end.
class Beam : public testing::TestWithParam<std::tuple<bool, bool, bool>> {
 protected:
  static BeamSegment Make() {
    const auto& [shear, first, second] = GetParam();
    return {{20.0, 3.0, shear ? 4.0 : 0.0}, kChord, first, second};
  }
  // The element at its start, moved and turned rigidly.
  static Eigen::VectorXd Moved(const BeamSegment& beam, const Eigen::Vector2d& by, double angle) {
    const Eigen::Vector2d chord = Eigen::Rotation2Dd(angle) * kChord;
    Eigen::VectorXd x(Size(beam));
    Eigen::Index k = 0;
    for (const LocalDof& dof : beam.Dofs())
      x[k++] = dof.field == Field::kRotation ? angle : by[dof.component] + (dof.node == 1 ? chord[dof.component] : 0.0);
    return x;
  }
  Eigen::VectorXd Deformed(const BeamSegment& beam) {
    return Moved(beam, random_.Vector(2, -3.0, 3.0), random_.Number(-4.0, 4.0) * kTurn) +
           random_.Vector(Size(beam), -0.3, 0.3);
  }

  Random random_{1};
};

std::string KindName(const testing::TestParamInfo<std::tuple<bool, bool, bool>>& instance) {
  const auto& [shear, first, second] = instance.param;
  return std::string(shear ? "Shear" : "NoShear") + (first ? "HingedFirst" : "") + (second ? "HingedSecond" : "");
}

INSTANTIATE_TEST_SUITE_P(Kinds, Beam, testing::Combine(testing::Bool(), testing::Bool(), testing::Bool()), KindName);

TEST_P(Beam, HasARotationWhereItIsNotHinged) {
  const bool first = std::get<1>(GetParam()), second = std::get<2>(GetParam());
  EXPECT_EQ(Size(Make()), 4 + (first ? 0 : 1) + (second ? 0 : 1));
}

TEST_P(Beam, ForceIsTheGradientOfTheEnergy) {
  const BeamSegment beam = Make();
  for (int i = 0; i < 20; ++i) {
    const Eigen::VectorXd x = Deformed(beam);
    const auto energy = [&](const Eigen::VectorXd& at) { return Eigen::VectorXd::Constant(1, beam.Energy(at)); };
    EXPECT_TRUE(IsJacobian(energy, x, Force(beam, x).transpose()));
  }
}

TEST_P(Beam, TangentIsTheDerivativeOfTheForce) {
  const BeamSegment beam = Make();
  for (int i = 0; i < 20; ++i) {
    const Eigen::VectorXd x = Deformed(beam);
    EXPECT_TRUE(IsJacobian([&](const Eigen::VectorXd& at) { return Force(beam, at); }, x, Tangent(beam, x)));
    EXPECT_EQ(Tangent(beam, x), Tangent(beam, x).transpose());
  }
}

// With the axial force of another point, and the change of length along its chord.
TEST_P(Beam, MixedTangentHasTheLinearisedAxialForce) {
  const BeamSegment beam = Make();
  const Eigen::Index second = beam.Dofs()[2].field == Field::kRotation ? 3 : 2;
  const auto span = [&](const Eigen::VectorXd& at) { return Eigen::Vector2d(at.segment<2>(second) - at.head<2>()); };
  const auto of_length = [&](const Eigen::VectorXd& at) {
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(Size(beam));
    gradient.segment<2>(second) = span(at).normalized();
    gradient.head<2>() = -span(at).normalized();
    return gradient;
  };
  for (int i = 0; i < 20; ++i) {
    const Eigen::VectorXd x = Deformed(beam), from = Deformed(beam), to = Deformed(beam);
    Eigen::MatrixXd mixed(Size(beam), Size(beam));
    beam.MixedTangent(x, x, x, mixed);
    EXPECT_EQ(mixed, Tangent(beam, x));
    beam.MixedTangent(x, from, to, mixed);
    const double longer = span(from).norm() + span(from).normalized().dot(span(to) - span(from)) - span(x).norm();
    const auto forces = [&](const Eigen::VectorXd& at) {
      return Eigen::VectorXd(20.0 / kChord.norm() * longer * of_length(at));
    };
    EXPECT_TRUE(IsJacobian(forces, x, mixed - Tangent(beam, x)));
  }
}

TEST_P(Beam, TangentDerivativeIsTheDerivativeOfTheTangentAlongADirection) {
  const BeamSegment beam = Make();
  for (int i = 0; i < 20; ++i) {
    const Eigen::VectorXd x = Deformed(beam), v = random_.Vector(Size(beam), -1.0, 1.0);
    const auto along = [&](const Eigen::VectorXd& h) { return Entries(Tangent(beam, x + h[0] * v)); };
    EXPECT_TRUE(IsJacobian(along, Eigen::VectorXd::Zero(1), Entries(TangentDerivative(beam, x, v))));
  }
}

// Turns of any number included.
TEST_P(Beam, RigidMotionsTakeNoEnergyAndNoForce) {
  const BeamSegment beam = Make();
  for (int i = 0; i < 50; ++i) {
    const Eigen::VectorXd x = Moved(beam, random_.Vector(2, -3.0, 3.0), random_.Number(-5.0, 5.0) * kTurn);
    EXPECT_LE(std::abs(beam.Energy(x)), 1e-26);
    EXPECT_LE(Force(beam, x).lpNorm<Eigen::Infinity>(), 1e-12);
  }
}

// The linear beam: w = P L^3 / (3 EI) + P L / GA at the tip of a cantilever, u = N L / EA.
TEST(BeamStiffness, Cantilever) {
  for (const double GA : {0.0, 4.0}) {
    const double EA = 20.0, EI = 3.0, L = 1.3;
    const BeamSegment beam({EA, EI, GA}, Eigen::Vector2d(L, 0.0), false, false);
    Eigen::VectorXd x(6);
    x << 0.0, 0.0, 0.0, L, 0.0, 0.0;
    const Eigen::Vector3d moved = Tangent(beam, x).bottomRightCorner<3, 3>().lu().solve(Eigen::Vector3d(2.0, 1.0, 0.0));
    EXPECT_NEAR(moved[0], 2.0 * L / EA, 1e-14);
    EXPECT_NEAR(moved[1], L * L * L / (3.0 * EI) + (GA > 0.0 ? L / GA : 0.0), 1e-14);
    EXPECT_NEAR(moved[2], L * L / (2.0 * EI), 1e-14);
    // Propped by a hinge: w = P L^3 / (3 EI) without the rotation of that end.
    const BeamSegment hinged({EA, EI, GA}, Eigen::Vector2d(L, 0.0), false, true);
    Eigen::VectorXd y(5);
    y << 0.0, 0.0, 0.0, L, 0.0;
    EXPECT_NEAR(1.0 / Tangent(hinged, y)(4, 4), L * L * L / (3.0 * EI) + (GA > 0.0 ? L / GA : 0.0), 1e-14);
  }
}

}  // namespace
}  // namespace contact_path::beam_test
