// Elements on rigid bodies: forces are gradients, and derivatives are those of what they derive.
#include "contact_path/structure/attached_element.h"

#include <gtest/gtest.h>

#include "contact_path/scene/expand.h"
#include "contact_path/structure/structure.h"
#include "support/derivative_checker.h"
#include "support/random.h"

namespace contact_path::attached_element_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Two bodies, one of them held in y: all kinds of elements join them to each other and to nodes of their own.
Scene SceneOfBodies() {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.bodies = {{"A", 0.1, 0.2}, {"B", 2.0, 0.3, false, true}};
  scene.nodes = {{"p", 0.4, 0.7}, {"q", 0.9, -0.1}, {"r", 1.7, 0.1}, {"s", 2.2, 1.1}, {"free", 1.2, 1.0}};
  for (const auto& [node, body] : {std::pair(0, "A"), std::pair(1, "A"), std::pair(2, "B"), std::pair(3, "B")})
    scene.nodes[static_cast<std::size_t>(node)].body = body;
  scene.bars = {{{"p", "free"}, 1.3}, {{"q", "r"}, 0.7, 0.5, StrainMeasure::kLogarithmic}, {{"A", "s"}, 0.4}};
  scene.superelements = {
      {{"q", "free"}, {1.0, 0.1, -0.5, 0.0, 0.1, 2.0, 0.3, -1.0, -0.5, 0.3, 1.5, 0.2, 0.0, -1.0, 0.2, 1.1}}};
  scene.beams = {{"leg", {"p", "free"}, 3.0, 0.2, 0.0, 2}, {"arm", {"q", "s"}, 2.0, 0.3, 1.0, 1, 0.0, {true, false}}};
  scene.materials = {{"rubber", MaterialModel::kNeoHookean, 2.0, 0.3}};
  scene.solids = {{"pad", "rubber", 0.0, PlaneState::kStrain, 3, {"q", "r", "free"}}};
  scene.loads = {{"free", 1.0, 0.0}};
  return Expand(request).request.scene;
}

TEST(AttachedElement, HasTheDerivativesOfItsEnergy) {
  const Scene scene = SceneOfBodies();
  const Structure structure(scene);
  Random random(7);
  for (int turn = 0; turn < 5; ++turn) {
    const VectorXd u = structure.Start() + random.Vector(structure.NumDofs(), -0.08, 0.08);
    const VectorXd v = random.Vector(structure.NumDofs(), -1.0, 1.0);
    const auto energy = [&](const VectorXd& at) { return VectorXd::Constant(1, structure.Energy(at)); };
    const auto force = [&](const VectorXd& at) {
      VectorXd of(structure.NumDofs());
      structure.InternalForce(at, of);
      return of;
    };
    const auto tangent = [&](const VectorXd& at) {
      Eigen::SparseMatrix<double> of = structure.TangentPattern();
      structure.Tangent(at, &of);
      return MatrixXd(of);
    };
    Eigen::SparseMatrix<double> third = structure.TangentPattern();
    structure.TangentDerivative(u, v, &third);
    EXPECT_TRUE(IsJacobian(energy, u, force(u).transpose()));
    EXPECT_TRUE(IsJacobian(force, u, tangent(u)));
    EXPECT_TRUE(IsJacobian([&](const VectorXd& at) { return VectorXd(tangent(at) * v); }, u, MatrixXd(third)));
  }
}

}  // namespace
}  // namespace contact_path::attached_element_test
