// What a request costs before it is traced grows with its size, not with the square of it.
#include <gtest/gtest.h>

#include <ctime>
#include <string>

#include "contact_path/path/stop.h"
#include "contact_path/scene/program.h"
#include "contact_path/scene/validate.h"
#include "contact_path/verify/verify_path.h"

namespace contact_path::large_requests_test {
namespace {

constexpr int kParts = 30000;
constexpr double kSeconds = 15.0;  // with sanitizers; the square of the parts would take minutes without

// Bars on moving supports, each with a node that may touch an obstacle of its own, which moves; all of them named by
// stop criteria.
TraceRequest LargeRequest() {
  TraceRequest request;
  Scene& scene = request.scene;
  Stage stage;
  for (int i = 0; i < kParts; ++i) {
    const std::string support = "s" + std::to_string(i), node = "n" + std::to_string(i),
                      floor = "f" + std::to_string(i);
    scene.nodes.push_back({support, 1.0 * i, 1.0, true, true});
    scene.nodes.push_back({node, 1.0 * i, 0.0, false, false});
    scene.bars.push_back({{support, node}, 1.0});
    scene.obstacles.push_back({floor, ObstacleShape::kHalfPlane, 0.0, -1.0, 0.0, 1.0, 0.3});
    scene.contacts.push_back({node, floor});
    stage.support_motions.push_back({support, 0.0, -0.1});
    stage.obstacle_motions.push_back({floor, 0.1, 0.1});
    request.options.stop.push_back({node + ".y", ">", 1.0});
  }
  request.program = {stage, stage};
  return request;
}

TEST(LargeRequests, CostNoSquareOfTheirSize) {
  const TraceRequest request = LargeRequest();
  const std::clock_t start = std::clock();
  const std::vector<Violation> violations = Validate(request);
  EXPECT_TRUE(violations.empty()) << violations.front().ToLine();
  const Scene second = StageScene(request, 1);
  EXPECT_DOUBLE_EQ(StageConfiguration(request, 1).start[5], 0.9);
  EXPECT_DOUBLE_EQ(second.obstacles[1].py, -0.9);
  EXPECT_EQ(StopTest(request, SceneIndex(request.scene)).FirstThatHolds(Increment()), nullptr);
  Increment increment;
  increment.stage = 1;
  EXPECT_FALSE(VerifyPath(request, {increment}).findings.empty());
  EXPECT_LE(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, kSeconds);
}

}  // namespace
}  // namespace contact_path::large_requests_test
