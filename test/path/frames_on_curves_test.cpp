// Random frames that an obstacle is driven against: the same events by every accuracy.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "support/beams.h"
#include "support/parts.h"
#include "support/random.h"
#include "support/seeds.h"
#include "support/traced_path.h"

namespace contact_path::frames_on_curves_test {
namespace {

const unsigned kSeeds = Seeds(100);
constexpr int kMostIncrements = 1500;
// A disc, or a polygon with fillets, or a closed spline.
Obstacle Indenter(Random* random, double x, double y) {
  Obstacle obstacle;
  obstacle.name = "o";
  obstacle.friction = random->Number(0.0, 1.0) < 0.3 ? 0.0 : random->Number(0.1, 0.8);
  if (random->Number(0.0, 1.0) < 0.3) {
    const double radius = random->Number(0.08, 0.3);
    return Circle("o", x, y, radius, obstacle.friction);
  }
  obstacle.shape = random->Number(0.0, 1.0) < 0.5 ? ObstacleShape::kPolyline : ObstacleShape::kSpline;
  obstacle.closed = true;
  const int corners = 3 + static_cast<int>(random->Number(0.0, 3.99));
  const double first = random->Number(0.0, 2.0 * M_PI);
  for (int i = 0; i < corners; ++i) {
    const double radius = random->Number(0.18, 0.3), angle = first - 2.0 * M_PI * i / corners;
    obstacle.points.insert(obstacle.points.end(), {x + radius * std::cos(angle), y + radius * std::sin(angle)});
  }
  return obstacle;
}

// An arch of two beams, or a post with an arm, and an obstacle that comes down on it.
TraceRequest RandomFrame(unsigned seed) {
  Random random(seed);
  const bool arch = random.Number(0.0, 1.0) < 0.5;
  const double EA = std::pow(10.0, random.Number(2.5, 4.5));
  const int segments = 4 + 2 * static_cast<int>(random.Number(0.0, 2.99));
  TraceRequest request;
  Scene& scene = request.scene;
  scene.name = "frame_" + std::to_string(seed);
  Node a{"a", arch ? -1.0 : 0.0, 0.0, true, true}, b{"b", 1.0, arch ? 0.0 : random.Number(0.8, 1.3), arch, arch};
  a.fixed_rotation = true;
  b.fixed_rotation = arch && random.Number(0.0, 1.0) < 0.5;
  const Node c =
      arch ? Node{"c", random.Number(-0.2, 0.2), random.Number(0.2, 0.6)} : Node{"c", random.Number(-0.1, 0.1), 1.0};
  scene.nodes = {a, c, b};
  const auto bend = [&] { return arch ? random.Number(-0.6, 0.6) : 0.0; };
  scene.beams = {Between("left", "a", "c", EA, 1.0, segments, bend()),
                 Between("right", "c", "b", EA, 1.0, segments, bend())};
  Group chain{"chain", {}};
  for (const char* beam : {"left", "right"})
    for (int i = 1; i < segments && (arch || beam[0] == 'r'); ++i)
      chain.nodes.push_back(std::string(beam) + "/" + std::to_string(i));
  scene.groups = {chain};
  scene.obstacles = {arch ? Indenter(&random, random.Number(-0.4, 0.4), random.Number(1.0, 1.2))
                          : Indenter(&random, random.Number(0.1, 0.7), random.Number(1.5, 1.9))};
  scene.contacts = {{"", "o", "chain"}};
  request.program.resize(1);
  request.program[0].obstacle_motions = {{"o", random.Number(-0.7, 0.7), random.Number(-1.2, -0.6)}};
  request.options.max_increments = kMostIncrements;
  return request;
}

TEST(RandomFramesOnCurves, HaveTheSameEventsByEveryAccuracy) {
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    TraceRequest request = RandomFrame(seed);
    request.options.accuracy = Accuracy::kBalanced;
    const TracedPath path = TraceIncrements(request);
    for (const Accuracy accuracy : {Accuracy::kFast, Accuracy::kAccurate}) {
      request.options.accuracy = accuracy;
      const TracedPath other = TraceIncrements(request);
      const std::vector<const Increment*> events = EventsOf(path), others = EventsOf(other);
      // Where one path was cut short, the other one may have more.
      const bool whole =
          path.result.reason != EndReason::kMaxIncrements && other.result.reason != EndReason::kMaxIncrements;
      if (whole) {
        EXPECT_EQ(others.size(), events.size());
      }
      for (std::size_t i = 0; i < std::min(events.size(), others.size()); ++i) {
        EXPECT_EQ(ToString(others[i]->kind), ToString(events[i]->kind)) << i;
        EXPECT_NEAR(others[i]->load_factor, events[i]->load_factor, 1e-8) << i;
      }
    }
  }
}

}  // namespace
}  // namespace contact_path::frames_on_curves_test
