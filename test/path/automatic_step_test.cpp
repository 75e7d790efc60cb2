
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "contact_path/path/model.h"
#include "contact_path/scene/expand.h"
#include "support/transformations.h"

namespace contact_path::automatic_step_test {
namespace {

double GrowthOf(const TraceRequest& request) {
  const ExpandedRequest expanded(request);
  const Scene& scene = expanded.Get().scene;
  return AutomaticStepGrowth(Model(scene, CharacteristicScales(scene)));
}

// A chain of so many free nodes.
TraceRequest Chain(int nodes) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.nodes.push_back({"n0", 0.0, 0.0, true, true});
  for (int i = 1; i <= nodes; ++i) {
    scene.nodes.push_back({"n" + std::to_string(i), 1.0 * i, 0.0, false, false, false});
    scene.bars.push_back({{scene.nodes[static_cast<std::size_t>(i) - 1].name, scene.nodes.back().name}, 1.0, 0.0});
  }
  scene.loads.push_back({"n1", 1.0, 0.0});
  return request;
}

TEST(AutomaticStepGrowth, BeginsBeyondAHundredComponents) {
  EXPECT_EQ(GrowthOf(Chain(3)), 1.0);
  EXPECT_EQ(GrowthOf(Chain(50)), 1.0);
  EXPECT_NEAR(GrowthOf(Chain(200)), 2.0, 1e-14);
}

// So the longest step per free component, all of them moving alike, does not depend on the segments.
TEST(AutomaticStepGrowth, TheInnerNodesOfABeamCountAsOneNode) {
  TraceRequest request = ReadExample("lee_frame");
  const auto squared_per_component = [&request](int segments) {
    for (Beam& beam : request.scene.beams) beam.segments = segments;
    const ExpandedRequest expanded(request);
    return std::pow(GrowthOf(request), 2) / static_cast<double>(Structure(expanded.Get().scene).NumDofs());
  };
  EXPECT_NEAR(squared_per_component(40) / squared_per_component(4), 1.0, 1e-14);
}

// A support that is moved along one axis has a prescribed component, and two in axes that are turned.
TEST(AutomaticStepGrowth, IsTheSameInAxesThatAreTurned) {
  const TraceRequest request = ReadExample("peg_in_hole");
  EXPECT_EQ(GrowthOf(Rotate(request, 0.6)), GrowthOf(request));
}

}  // namespace
}  // namespace contact_path::automatic_step_test
