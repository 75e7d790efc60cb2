// Random pairs of deformable bodies: every increment is proved, other steps give the same events, and method mpec the
// same states at the ends of the stages.
//
// CONTACT_PATH_BODIES=FROM:TO: other seeds, TO not included.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "contact_path/path/mpec_method.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/program.h"
#include "contact_path/scene/validate.h"
#include "support/random_bodies.h"
#include "support/seeds.h"
#include "support/traced_path.h"

namespace contact_path::deformable_random_paths_test {
namespace {

constexpr double kSmallerStep = 0.01;
constexpr const char* kChosen = "CONTACT_PATH_BODIES";
constexpr unsigned kByMpecToo = 25;     // one of so many seeds: an increment takes Ipopt as long as a path takes branch
constexpr unsigned kAccuratelyToo = 5;  // one of so many seeds: the other ones by longer steps
constexpr int kMostIncrements = 10000;
// Of the seeds below: a little fewer than there are.
constexpr std::size_t kLeastEvents = 400, kLeastComplete = 95, kLeastCompared = 8;
constexpr double kSameLoad = 1e-7;    // of the load factor of an event
constexpr double kSamePlace = 2e-3;   // of a node by mpec, scaled: corners are cut
constexpr double kTurnedBack = -0.5;  // load factor of stages to 1

struct SeedRange {
  unsigned from = 1, to = Seeds(100) + 1;
};

SeedRange ChosenSeeds() {
  SeedRange seeds;
  const char* const chosen = std::getenv(kChosen);
  if (chosen != nullptr && std::sscanf(chosen, "%u:%u", &seeds.from, &seeds.to) != 2)
    throw std::invalid_argument(std::string(kChosen) + " must be FROM:TO");
  return seeds;
}

// Until the end of the program, or until the load of a stage has turned far back: where that dissipates most, the path
// goes there, and how far is of no interest.
TracedPath TraceBodies(TraceRequest request) {
  TracedPath path;
  request.options.max_increments = kMostIncrements;
  path.request = std::move(request);
  bool done = false;
  TraceControl control;
  control.on_increment = [&](const Increment& increment) {
    path.increments.push_back(increment);
    done = increment.load_factor < kTurnedBack;
  };
  control.cancelled = [&] { return done; };
  control.mpec = MakeMpecMethod;
  path.result = Trace(path.request, control);
  return path;
}

// By no fault of the method: no quasi-static path leads on, or a node goes round the end of a surface.
bool EndsByName(const TracedPath& path) {
  const EndReason reason = path.result.reason;
  return reason == EndReason::kStopCriterion || reason == EndReason::kPathEnd || reason == EndReason::kCancelled ||
         path.result.message.find("the node has come past an end of the surface") != std::string::npos;
}

// Without what is past the load at which it is given up.
TracedPath Compared(TracedPath path) {
  while (!path.increments.empty() && path.increments.back().load_factor < kTurnedBack) path.increments.pop_back();
  return path;
}

// The last increment of each stage that came to its target, by stage.
std::map<int, const Increment*> EndsOfStages(const TracedPath& path) {
  std::map<int, const Increment*> ends;
  for (const Increment& increment : path.increments)
    if (std::abs(increment.load_factor - 1.0) <= 1e-9) ends[increment.stage] = &increment;
  return ends;
}

// The farthest that a node is from where the path has it, scaled: at the end of each stage to which both came.
std::vector<double> DistancesAtEnds(const TracedPath& path, const TracedPath& other) {
  const double length = StageScales(ExpandedRequest(path.request).Get(), 0).length;
  const auto ends = EndsOfStages(path), others = EndsOfStages(other);
  std::vector<double> distances;
  for (const auto& [stage, end] : others) {
    if (ends.count(stage) == 0) continue;
    double distance = 0.0;
    for (std::size_t i = 0; i < end->positions.size(); ++i)
      distance = std::max(distance, std::abs(end->positions[i] - ends.at(stage)->positions[i]) / length);
    distances.push_back(distance);
  }
  return distances;
}

TEST(RandomBodies, AreProvedAndTheSameForOtherStepsAndByBothMethods) {
  const SeedRange seeds = ChosenSeeds();
  std::map<std::string, int> ends;
  std::size_t events = 0, complete = 0, compared = 0;
  for (unsigned seed = seeds.from; seed < seeds.to; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    TraceRequest request = RandomBodies(seed);
    for (const Violation& violation : Validate(request)) FAIL() << violation.ToLine();
    const TracedPath path = TraceBodies(request);
    EXPECT_TRUE(EndsByName(path)) << path.result.message;
    ExpectNoFindings(path);
    ++ends[path.result.message.substr(0, 60)];
    for (const Increment* const event : EventsOf(path))
      if (event->kind != IncrementKind::kStart) ++events;
    if (path.result.reason == EndReason::kStopCriterion) ++complete;
    request.options.accuracy = seed % kAccuratelyToo == 0 ? Accuracy::kAccurate : Accuracy::kFast;
    ExpectSameEvents(Compared(path), Compared(TraceBodies(request)), kSameLoad);
    if (seed % kByMpecToo != 0) continue;
    request.options.accuracy = Accuracy::kBalanced;
    request.options.method = Method::kMpec;
    TracedPath other = TraceBodies(request);
    // Of a short path mpec says that it is to be trusted with a smaller step only.
    if (!EndsByName(other) && other.result.message.find("only with a smaller step") != std::string::npos) {
      request.options.step = kSmallerStep;
      other = TraceBodies(request);
    }
    EXPECT_TRUE(EndsByName(other)) << "mpec: " << other.result.message;
    ExpectNoFindings(other);
    ++ends["mpec: " + other.result.message.substr(0, 60)];
    for (const double distance : DistancesAtEnds(path, other)) {
      EXPECT_LE(distance, kSamePlace);
      ++compared;
    }
  }
  for (const auto& [end, count] : ends) std::cout << count << ": " << end << "\n";
  std::cout << seeds.to - seeds.from << " pairs of bodies, " << events << " events, " << compared
            << " ends of stages by both methods\n";
  if (std::getenv(kChosen) != nullptr) return;
  EXPECT_GE(events, AtLeast(kLeastEvents));
  EXPECT_GE(complete, AtLeast(kLeastComplete));
  EXPECT_GE(compared, AtLeast(kLeastCompared));
}

}  // namespace
}  // namespace contact_path::deformable_random_paths_test
