// The check of solids against the elements of the solvers, with which it shares the scene and no mechanics.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include "contact_path/check/residuals.h"
#include "contact_path/structure/structure.h"
#include "support/random.h"
#include "support/solid_grid.h"

namespace contact_path::solid_residuals_test {
namespace {

Scene GridOf(MaterialModel model, PlaneState plane, int nodes, Random* random) {
  Scene scene;
  scene.materials = {ElasticMaterial("m", 2.6, 0.3, model)};
  Solid solid;
  solid.material = "m";
  solid.thickness = 0.7;
  solid.plane = plane;
  solid.nodes_per_element = nodes;
  AddGrid(
      &scene, 2, 2,
      [&](double x, double y) { return Eigen::Vector2d(Eigen::Vector2d(x, y) + random->Vector(2, -0.04, 0.04)); },
      solid);
  return scene;
}

TEST(SolidResiduals, EnergyAndForcesAreThoseOfTheStructure) {
  Random random(1);
  for (const MaterialModel model : {MaterialModel::kNeoHookean, MaterialModel::kStVenantKirchhoff,
                                    MaterialModel::kCiarletGeymonat, MaterialModel::kLinear})
    for (const PlaneState plane : {PlaneState::kStrain, PlaneState::kStress})
      for (const int nodes : {3, 4, 6, 8}) {
        SCOPED_TRACE(std::string(ToString(model)) + ", plane " + std::string(ToString(plane)) + ", nodes " +
                     std::to_string(nodes));
        const Scene scene = GridOf(model, plane, nodes, &random);
        const Structure structure(scene);
        const ResidualCheck check(scene);
        Eigen::VectorXd u = structure.Start() + random.Vector(structure.NumDofs(), -0.02, 0.02);
        u = 1.1 * u + random.Vector(1, -50.0, 50.0).replicate(u.size(), 1);
        Eigen::VectorXd force(structure.NumDofs());
        structure.InternalForce(u, force);
        CheckedState state;
        state.positions = {u.begin(), u.end()};
        const std::vector<double> checked = check.Unbalance(state);
        // Positions of the order of 50 are exact to 1e-14.
        EXPECT_NEAR(check.StrainEnergy(state.positions), structure.Energy(u), 1e-12);
        for (std::size_t i = 0; i < checked.size(); ++i)
          EXPECT_NEAR(checked[i], force[static_cast<Eigen::Index>(i)], 1e-12);

        for (std::size_t i = 0; i < state.positions.size(); i += 2) state.positions[i] *= -1.0;
        EXPECT_EQ(std::isfinite(check.StrainEnergy(state.positions)), model == MaterialModel::kLinear);
        EXPECT_EQ(std::isfinite(check.Unbalance(state)[0]), model == MaterialModel::kLinear);
      }
}

// Plane stress far from rest.
TEST(SolidResiduals, PlaneStressFarFromRest) {
  Random random(2);
  for (const double nu : {-0.3, 0.0, 0.3, 0.4999})
    for (const MaterialModel model : {MaterialModel::kNeoHookean, MaterialModel::kCiarletGeymonat})
      for (const double stretch : {0.05, 0.9, 3.0, 20.0}) {
        if (nu < 0.0 && (stretch < 0.9 || model != MaterialModel::kNeoHookean))
          continue;  // no thickness without stress
        Scene scene = GridOf(model, PlaneState::kStress, 4, &random);
        scene.materials[0].nu = nu;
        if (model == MaterialModel::kCiarletGeymonat) scene.materials[0].a = 0.5 * 2.6 / (2.0 * (1.0 + nu));
        const Structure structure(scene);
        const Eigen::VectorXd u = stretch * structure.Start();
        Eigen::VectorXd force(structure.NumDofs());
        structure.InternalForce(u, force);
        CheckedState state;
        state.positions = {u.begin(), u.end()};
        const std::vector<double> checked = ResidualCheck(scene).Unbalance(state);
        for (std::size_t i = 0; i < checked.size(); ++i)
          EXPECT_NEAR(checked[i], force[static_cast<Eigen::Index>(i)], 1e-12 * force.lpNorm<Eigen::Infinity>() + 1e-14)
              << nu << " " << stretch;
      }
}

}  // namespace
}  // namespace contact_path::solid_residuals_test
