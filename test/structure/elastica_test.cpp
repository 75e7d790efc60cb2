// Cantilevers of beam segments against the elastica: large displacements and rotations.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "contact_path/structure/beam.h"
#include "contact_path/structure/structure.h"

namespace contact_path::elastica_test {
namespace {

constexpr double kPi = 3.141592653589793;

// Of length 1 along x, clamped at the origin; EI = 1.
class Cantilever {
 public:
  // EA: large, so that the axis does not stretch.
  Cantilever(int segments, double EA) : structure_(Make(segments, EA)), u_(structure_.Start()) {
    const DofMap& dofs = structure_.Dofs();
    for (Eigen::Index i = 0; i < structure_.NumDofs(); ++i)
      if (i != dofs.Dof(0, Field::kRotation, 0)) free_.push_back(static_cast<int>(i));
    tip_ = {dofs.Dof(segments, Field::kPosition, 0), dofs.Dof(segments, Field::kPosition, 1),
            dofs.Dof(segments, Field::kRotation, 0)};
  }

  // Brings the force along y and the moment at the tip there in so many equal steps, each by Newton's method.
  void Load(double force, double moment, int steps) {
    const double from_force = force_, from_moment = moment_;
    for (int step = 1; step <= steps; ++step) {
      force_ = from_force + (force - from_force) * step / steps;
      moment_ = from_moment + (moment - from_moment) * step / steps;
      ASSERT_TRUE(Solve()) << step;
    }
  }

  double TipX() const { return u_[tip_[0]]; }
  double TipY() const { return u_[tip_[1]]; }
  double TipRotation() const { return u_[tip_[2]]; }
  const Structure& structure() const { return structure_; }
  const Eigen::VectorXd& u() const { return u_; }

 private:
  static Structure Make(int segments, double EA) {
    Scene scene;
    for (int i = 0; i <= segments; ++i)
      scene.nodes.push_back({"n" + std::to_string(i), static_cast<double>(i) / segments, 0.0, i == 0, i == 0});
    std::vector<PlacedElement> elements;
    for (int i = 0; i < segments; ++i)
      elements.push_back({std::make_unique<BeamSegment>(BeamSegment::Stiffness{EA, 1.0, 0.0},
                                                        Eigen::Vector2d(1.0 / segments, 0.0), false, false),
                          {i, i + 1}});
    return {scene, SceneIndex(scene), Configuration::Of(scene), std::move(elements)};
  }

  bool Solve() {
    Eigen::VectorXd force(structure_.NumDofs());
    Eigen::SparseMatrix<double> tangent = structure_.TangentPattern();
    for (int iteration = 0; iteration < 50; ++iteration) {
      structure_.InternalForce(u_, force);
      force[tip_[1]] -= force_;
      force[tip_[2]] -= moment_;
      structure_.Tangent(u_, &tangent);
      const Eigen::MatrixXd dense = Eigen::MatrixXd(tangent)(free_, free_);
      const Eigen::VectorXd change = dense.partialPivLu().solve(force(free_));
      for (std::size_t k = 0; k < free_.size(); ++k) u_[free_[k]] -= change[static_cast<Eigen::Index>(k)];
      if (change.norm() < 1e-11) return true;
    }
    return false;
  }

  Structure structure_;
  Eigen::VectorXd u_;
  std::vector<int> free_;
  std::array<int, 3> tip_{};
  double force_ = 0.0, moment_ = 0.0;
};

// Closed form of the elastica: how far the tip comes back, and how far it moves across, over L, for P L^2 / EI.
struct DeadLoad {
  double load, back, across;
};

class CantileverUnderADeadLoad : public testing::TestWithParam<DeadLoad> {};

INSTANTIATE_TEST_SUITE_P(Loads, CantileverUnderADeadLoad,
                         testing::Values(DeadLoad{1.0, 0.056433, 0.301721}, DeadLoad{2.0, 0.160642, 0.493457},
                                         DeadLoad{5.0, 0.387628, 0.713792}, DeadLoad{10.0, 0.554996, 0.810609}),
                         [](const auto& instance) { return std::to_string(static_cast<int>(instance.param.load)); });

TEST_P(CantileverUnderADeadLoad, ConvergesToTheElastica) {
  const auto tip = [](int segments) {
    Cantilever beam(segments, 1e7);
    beam.Load(GetParam().load, 0.0, 10);
    return Eigen::Vector2d(1.0 - beam.TipX(), beam.TipY());
  };
  const Eigen::Vector2d exact(GetParam().back, GetParam().across);
  const Eigen::Vector2d coarse = tip(10), middle = tip(20), fine = tip(40);
  // Second order in the length of a segment.
  const double order = std::log2((coarse - middle).norm() / (middle - fine).norm());
  EXPECT_NEAR(order, 2.0, 0.05);
  EXPECT_LE((fine - exact).norm(), 2e-3 * exact.norm());
  EXPECT_LE((fine + (fine - middle) / 3.0 - exact).norm(), 2e-6);  // six digits are given, and the axis stretches a bit
}

// Pure bending: chords of one length, each turned by the same angle against the last one.
TEST(CantileverUnderAnEndMoment, RollsUp) {
  const int segments = 20;
  for (const int turns : {1, 2}) {
    Cantilever beam(segments, 1e6);
    beam.Load(0.0, 2.0 * kPi * turns, 20 * turns);
    EXPECT_NEAR(beam.TipX(), 0.0, 1e-9) << turns;
    EXPECT_NEAR(beam.TipY(), 0.0, 1e-9) << turns;
    EXPECT_NEAR(beam.TipRotation(), 2.0 * kPi * turns, 1e-9) << turns;
    const double half = kPi * turns / segments;  // half of the angle between chords
    const double radius = 0.5 / (segments * std::sin(half));
    // The circle through the nodes touches the first chord's neighbourhood: its centre is on the bisector there.
    const Eigen::Vector2d first(beam.u()[beam.structure().Dof(1, 0)], beam.u()[beam.structure().Dof(1, 1)]);
    const Eigen::Vector2d normal(-first[1], first[0]);
    const Eigen::Vector2d centre = 0.5 * first + normal / normal.norm() * radius * std::cos(half);
    for (int i = 1; i <= segments; ++i) {
      const Eigen::Vector2d at(beam.u()[beam.structure().Dof(i, 0)], beam.u()[beam.structure().Dof(i, 1)]);
      EXPECT_NEAR((at - centre).norm(), radius, 1e-9) << turns << ", " << i;
    }
  }
}

}  // namespace
}  // namespace contact_path::elastica_test
