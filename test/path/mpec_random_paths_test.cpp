// Random scenes by Algorithm 3.2, against their exact paths.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include "support/curved_obstacles.h"
#include "support/random_scene.h"
#include "support/traced_path.h"

namespace contact_path::mpec_random_paths_test {
namespace {

constexpr double kArc = 0.16, kPolygon = 1e-6, kCorner = 5e-4;  // scaled
constexpr double kLongArc = 1.0, kLimitLoad = 0.02;             // arc scaled, load relative to the largest
constexpr char kScenes[] = "CONTACT_PATH_MPEC_SCENES";          // how many, in place of those that find regressions

unsigned Seeds(unsigned few) {
  const char* const wanted = std::getenv(kScenes);
  return wanted == nullptr ? few : static_cast<unsigned>(std::stoul(wanted));
}

// Increments follow the path: on it between events, next to it after one, as near as a corner may be cut.
struct Comparison {
  // The seeds 1 to `seeds`. make: the request of one.
  template <typename Make>
  Comparison(unsigned seeds, Make make) {
    for (unsigned seed = 1; seed <= seeds; ++seed) Compare(make(seed), "seed " + std::to_string(seed));
    std::cout << increments << " increments; on the path in " << on_the_path
              << " scenes, not farther with shorter increments in " << nearer << " of " << scenes << "; " << ended
              << " of " << traces << " paths end early\n";
  }

  void Compare(TraceRequest request, const std::string& name) {
    request.options.step = 0.001;
    const TracedPath exact = TraceArc(request, 2.0 * kArc);
    if (exact.increments.empty()) return;
    ++scenes;
    request.options.method = Method::kMpec;
    std::vector<double> farthest;
    for (const double step : {0.04, 0.02}) {
      request.options.step = step;
      const TracedPath path = TraceArc(request, kArc);
      ++traces;
      const bool ends_early = path.result.reason == EndReason::kStepTooSmall;
      if (ends_early && exact.increments.back().arc_length > 2.0 * kArc) {
        ++ended;
        std::cout << name << ", step " << step << ": " << path.result.message << "\n";
      }
      double worst = 0.0, place = 0.0;
      for (const Increment& increment : path.increments) {
        const double distance = DistanceFromPath(increment, exact, &place);
        worst = std::max(worst, distance);
        EXPECT_LE(distance, kCorner) << name << " at " << place;
        ++increments;
      }
      farthest.push_back(worst);
    }
    std::cout << name << ": at most " << farthest[0] << " and, with shorter increments, " << farthest[1]
              << " from the path\n";
    if (farthest[1] <= kPolygon) ++on_the_path;
    if (farthest[1] <= 1.1 * farthest[0] + kPolygon) ++nearer;
  }

  int scenes = 0, traces = 0, ended = 0, nearer = 0, on_the_path = 0, increments = 0;
};

TEST(RandomPathsByMpec, FollowTheExactPath) {
  const Comparison found(Seeds(8), [](unsigned seed) { return RandomRequest(seed); });
  EXPECT_GE(2 * found.on_the_path, found.scenes);
  EXPECT_EQ(found.nearer, found.scenes);
}

TEST(RandomPathsByMpec, FollowTheExactPathOnCurves) {
  const Comparison found(Seeds(4), [](unsigned seed) { return OnCurves(RandomRequest(seed), seed); });
  EXPECT_GE(2 * found.on_the_path, found.scenes);
}

// The loads of limit points up to this arc length, and the largest load of all.
std::vector<double> LimitLoads(const TracedPath& path, double arc, double* largest) {
  std::vector<double> loads;
  for (const Increment& increment : path.increments) {
    if (increment.arc_length > arc) break;
    *largest = std::max(*largest, std::abs(increment.load_factor));
    if (increment.kind == IncrementKind::kSmoothLimit || increment.kind == IncrementKind::kCornerLimit)
      loads.push_back(increment.load_factor);
  }
  return loads;
}

// As far as mpec comes, each limit load of either path is one of the other's, or the path ends by name.
TEST(RandomPathsByMpec, LimitLoadsAreThoseOfMethodBranch) {
  int compared = 0, loads = 0, ended = 0, other = 0;
  for (unsigned seed = 1; seed <= Seeds(10); ++seed) {
    TraceRequest request = RandomRequest(seed);
    const TracedPath branch = TraceArc(request, kLongArc);
    request.options.method = Method::kMpec;
    const TracedPath mpec = TraceArc(request, kLongArc);
    if (branch.increments.size() < 2 || mpec.increments.size() < 2) continue;
    ++compared;
    const double arc = std::min(branch.increments.back().arc_length, mpec.increments.back().arc_length);
    if (mpec.result.reason == EndReason::kStepTooSmall && branch.increments.back().arc_length > 1.01 * arc) {
      ++ended;
      std::cout << "seed " << seed << ": " << mpec.result.message << "\n";
    }
    double largest = 0.0;
    // What one path has next to the end of the common part may lie beyond that of the other.
    const std::vector<double> all[] = {LimitLoads(branch, 1.05 * arc, &largest),
                                       LimitLoads(mpec, 1.05 * arc, &largest)};
    const std::vector<double> sure[] = {LimitLoads(branch, 0.95 * arc, &largest),
                                        LimitLoads(mpec, 0.95 * arc, &largest)};
    for (int i = 0; i < 2; ++i)
      for (const double load : sure[i]) {
        ++loads;
        const bool known = std::any_of(all[1 - i].begin(), all[1 - i].end(), [&](double of_other) {
          return std::abs(of_other - load) <= kLimitLoad * largest;
        });
        if (!known) ++other;
        EXPECT_TRUE(known) << "seed " << seed << ": only " << (i == 0 ? "branch" : "mpec") << " has a limit load of "
                           << load << " at an arc length up to " << 0.95 * arc << ", largest " << largest;
      }
  }
  std::cout << compared << " scenes, " << loads << " limit loads, " << other << " of one path alone, " << ended
            << " paths of mpec end early\n";
}

}  // namespace
}  // namespace contact_path::mpec_random_paths_test
