// Random trusses on curves: every increment is proved, other steps give the same events, and method mpec the same path.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <string>

#include "support/curved_obstacles.h"
#include "support/random_scene.h"
#include "support/seeds.h"
#include "support/traced_path.h"

namespace contact_path::curved_random_paths_test {
namespace {

const unsigned kSeeds = Seeds(120);
constexpr double kArcLength = 1.2;

bool Reached(const TracedPath& path) {
  return !path.increments.empty() && path.increments.back().arc_length > kArcLength;
}

// A proper end: none of the method's own.
bool EndsByName(const TracedPath& path) {
  return Reached(path) || path.result.reason == EndReason::kPathEnd || path.result.reason == EndReason::kClosedPath;
}

// Without its last piece, where one path has an event that another one does not come to.
TracedPath Compared(TracedPath path) {
  while (!path.increments.empty() && path.increments.back().arc_length >= kArcLength - 1e-3) path.increments.pop_back();
  return path;
}

// Whether nothing resists some motion: where a part is then depends on the steps, which is no error.
bool MovesFreely(const TracedPath& path) {
  return std::any_of(path.increments.begin(), path.increments.end(),
                     [](const Increment& increment) { return increment.solve.nullity > 0; });
}

TEST(RandomPathsOnCurves, AreProvedAndTheSameForOtherSteps) {
  std::map<std::string, int> ends;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    TraceRequest request = OnCurves(RandomRequest(seed), seed);
    const TracedPath path = TraceArc(request, kArcLength);
    if (path.increments.empty()) {  // no start
      EXPECT_EQ(path.result.message.rfind("while the constant loads were brought on: ", 0), 0u) << path.result.message;
      ++ends["no start"];
      continue;
    }
    ++ends[Reached(path) ? "reached" : path.result.message.substr(0, 60)];
    EXPECT_TRUE(EndsByName(path)) << path.result.message;
    ExpectNoFindings(path);
    request.options.accuracy = Accuracy::kAccurate;
    ExpectSameEvents(Compared(path), Compared(TraceArc(request, kArcLength)), MovesFreely(path) ? 1e-6 : 1e-7);
  }
  for (const auto& [end, count] : ends) std::cout << count << ": " << end << "\n";
}

}  // namespace
}  // namespace contact_path::curved_random_paths_test
