// Random pairs of deformable bodies: every increment is proved, other steps give the same events, and method mpec the
// same states at the ends of the stages.
//
// CONTACT_PATH_BODIES=FROM:TO: other seeds, TO not included.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "contact_path/scene/expand.h"
#include "contact_path/scene/program.h"
#include "contact_path/scene/validate.h"
#include "contact_path/verify/verify_path.h"
#include "support/random_bodies.h"
#include "support/traced_path.h"

namespace contact_path {
namespace {

constexpr unsigned kByMpecToo = 25;     // one of so many seeds: an increment takes Ipopt as long as a path takes branch
constexpr unsigned kAccuratelyToo = 5;  // one of so many seeds: the other ones by longer steps
constexpr int kMostIncrements = 10000;
constexpr double kSameLoad = 1e-7;    // of the load factor of an event
constexpr double kSamePlace = 2e-3;   // of a node by mpec, scaled: corners are cut
constexpr double kTurnedBack = -0.5;  // load factor of stages to 1

struct Seeds {
  unsigned from = 1, to = 101;
};

Seeds ChosenSeeds() {
  Seeds seeds;
  const char* const chosen = std::getenv("CONTACT_PATH_BODIES");
  if (chosen != nullptr && std::sscanf(chosen, "%u:%u", &seeds.from, &seeds.to) != 2)
    throw std::invalid_argument("CONTACT_PATH_BODIES must be FROM:TO");
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
  path.result = Trace(path.request, control);
  return path;
}

// By no fault of the method: no quasi-static path leads on, or a node goes round the end of a surface.
bool EndsByName(const TracedPath& path) {
  const EndReason reason = path.result.reason;
  return reason == EndReason::kStopCriterion || reason == EndReason::kPathEnd || reason == EndReason::kCancelled ||
         path.result.message.find("the node has come past an end of the surface") != std::string::npos;
}

std::vector<const Increment*> Events(const TracedPath& path) {
  std::vector<const Increment*> events;
  for (const Increment& increment : path.increments)
    if (increment.kind != IncrementKind::kRegular && increment.load_factor >= kTurnedBack) events.push_back(&increment);
  return events;
}

void ExpectProved(const TracedPath& path) {
  EXPECT_TRUE(EndsByName(path)) << path.result.message;
  for (const Finding& finding : VerifyPath(path.request, path.increments).findings)
    ADD_FAILURE() << "increment " << finding.increment << ": " << finding.what;
}

void ExpectSameEvents(const TracedPath& path, const TracedPath& other) {
  EXPECT_EQ(ToString(other.result.reason), ToString(path.result.reason)) << other.result.message;
  const auto events = Events(path), others = Events(other);
  EXPECT_EQ(others.size(), events.size());
  for (std::size_t i = 0; i < std::min(events.size(), others.size()); ++i) {
    EXPECT_EQ(others[i]->stage, events[i]->stage) << i;
    EXPECT_EQ(ToString(others[i]->kind), ToString(events[i]->kind)) << i;
    EXPECT_NEAR(others[i]->load_factor, events[i]->load_factor, kSameLoad) << i;
  }
}

// The last increment of each stage that came to its target, by stage.
std::map<int, const Increment*> EndsOfStages(const TracedPath& path) {
  std::map<int, const Increment*> ends;
  for (const Increment& increment : path.increments)
    if (std::abs(increment.load_factor - 1.0) <= 1e-9) ends[increment.stage] = &increment;
  return ends;
}

// The farthest that a node is from where the path has it, at the ends of stages to which both came; scaled.
double Difference(const TracedPath& path, const TracedPath& other) {
  const double length = StageScales(ExpandedRequest(path.request).Get(), 0).length;
  const auto ends = EndsOfStages(path), others = EndsOfStages(other);
  double difference = 0.0;
  for (const auto& [stage, end] : others) {
    if (ends.count(stage) == 0) continue;
    for (std::size_t i = 0; i < end->positions.size(); ++i)
      difference = std::max(difference, std::abs(end->positions[i] - ends.at(stage)->positions[i]) / length);
  }
  return difference;
}

TEST(RandomBodies, AreProvedAndTheSameForOtherStepsAndByBothMethods) {
  const Seeds seeds = ChosenSeeds();
  std::map<std::string, int> ends;
  std::size_t events = 0;
  for (unsigned seed = seeds.from; seed < seeds.to; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    TraceRequest request = RandomBodies(seed);
    for (const Violation& violation : Validate(request)) FAIL() << violation.ToLine();
    const TracedPath path = TraceBodies(request);
    ExpectProved(path);
    ++ends[path.result.message.substr(0, 60)];
    events += Events(path).size();
    request.options.accuracy = seed % kAccuratelyToo == 0 ? Accuracy::kAccurate : Accuracy::kFast;
    ExpectSameEvents(path, TraceBodies(request));
    if (seed % kByMpecToo != 0) continue;
    request.options.accuracy = Accuracy::kBalanced;
    request.options.method = Method::kMpec;
    const TracedPath other = TraceBodies(request);
    for (const Finding& finding : VerifyPath(other.request, other.increments).findings)
      ADD_FAILURE() << "mpec, increment " << finding.increment << ": " << finding.what;
    ++ends["mpec: " + other.result.message.substr(0, 60)];
    EXPECT_LE(Difference(path, other), kSamePlace);
  }
  for (const auto& [end, count] : ends) std::cout << count << ": " << end << "\n";
  std::cout << seeds.to - seeds.from << " pairs of bodies, " << events << " events\n";
}

}  // namespace
}  // namespace contact_path
