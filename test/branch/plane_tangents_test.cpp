#include "contact_path/branch/plane_tangents.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

#include "contact_path/linear/minimum_norm.h"
#include "contact_path/path/model.h"

namespace contact_path::plane_tangents_test {
namespace {

constexpr double kSingularRank = 1e-6;

// Two von Mises trusses (half span 1, rise 1, EA 1) side by side. Their load is largest where the cosine of the bars'
// slope is the cube root of what it was at the start.
Scene TwoTrusses(double constant_on_second) {
  Scene scene;
  scene.name = "two";
  for (const double middle : {0.0, 3.0}) {
    const std::string k = middle == 0.0 ? "1" : "2";
    scene.nodes.push_back({"a" + k, middle - 1.0, 0.0, true, true});
    scene.nodes.push_back({"n" + k, middle, 1.0, false, false});
    scene.nodes.push_back({"b" + k, middle + 1.0, 0.0, true, true});
    scene.bars.push_back({{"a" + k, "n" + k}, 1.0});
    scene.bars.push_back({{"n" + k, "b" + k}, 1.0});
    scene.loads.push_back({"n" + k, 0.0, -1.0, false});
  }
  scene.loads.push_back({"n2", 0.0, constant_on_second, true});
  return scene;
}

const double kLimitHeight = std::sqrt(std::pow(2.0, 1.0 / 3.0) - 1.0);
const double kLimitLoad = 2.0 * std::pow(1.0 - std::pow(0.5, 1.0 / 3.0), 1.5);

// With the apexes at y1, y2 and the load factor kLimitLoad.
PlaneTangents TangentsAt(const Scene& scene, double y1, double y2) {
  const Model model(scene, CharacteristicScales(scene));
  PathPoint point = model.InitialPoint();
  const double length = model.scaling.length;
  point.u[model.structure.Dof(1, 1)] = y1 / length;
  point.u[model.structure.Dof(4, 1)] = y2 / length;
  point.s = kLimitLoad / model.scaling.load_factor;
  FixedStateSystem system(model.structure, model.contacts);
  const Eigen::VectorXd x = system.Pack(point);
  Eigen::VectorXd residual;
  system.Residual(x, &residual);
  EXPECT_LE(residual.norm(), 1e-13);
  MinimumNormSolver solver;
  EXPECT_TRUE(solver.Factorize(system.TransposedJacobian(x), kSingularRank));
  const Eigen::MatrixXd plane = solver.NullSpace();
  EXPECT_EQ(plane.cols(), 2);
  return TangentsInPlane(&system, x, plane, solver.LeftNullSpace());
}

// s = P - a y1^2 = P - a y2^2 to second order: both go on, or one of them turns back.
TEST(PlaneTangents, TwoCurvesThatCross) {
  const PlaneTangents tangents = TangentsAt(TwoTrusses(0.0), kLimitHeight, kLimitHeight);
  ASSERT_TRUE(tangents.determined);
  ASSERT_EQ(tangents.directions.size(), 2U);
  double products = 0.0;
  for (const Eigen::VectorXd& direction : tangents.directions) {
    EXPECT_NEAR(std::abs(direction[1]), std::sqrt(0.5), 1e-9);
    EXPECT_NEAR(std::abs(direction[3]), std::sqrt(0.5), 1e-9);
    products += direction[1] * direction[3];
  }
  EXPECT_NEAR(products, 0.0, 1e-9);
}

// s = P - a y1^2 = P + a y2^2: no curve leaves the point.
TEST(PlaneTangents, AnIsolatedPoint) {
  const PlaneTangents tangents = TangentsAt(TwoTrusses(2.0 * kLimitLoad), kLimitHeight, -kLimitHeight);
  EXPECT_TRUE(tangents.determined);
  EXPECT_TRUE(tangents.directions.empty());
}

// Without second derivatives nothing chooses.
TEST(PlaneTangents, LinearPartsLeaveASurface) {
  Scene scene;
  scene.name = "linear";
  scene.nodes = {{"a", 0.0, 0.0, false, false}, {"b", 1.0, 0.0, false, false}};
  scene.superelements = {{{"a", "b"}, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1}}};
  scene.loads = {{"a", 1.0, 0.0, false}};
  const Model model(scene, CharacteristicScales(scene));
  FixedStateSystem system(model.structure, model.contacts);
  const Eigen::VectorXd x = system.Pack(model.InitialPoint());
  MinimumNormSolver solver;
  ASSERT_TRUE(solver.Factorize(system.TransposedJacobian(x)));
  ASSERT_EQ(solver.NullSpace().cols(), 2);
  EXPECT_FALSE(TangentsInPlane(&system, x, solver.NullSpace(), solver.LeftNullSpace()).determined);
}

}  // namespace
}  // namespace contact_path::plane_tangents_test
