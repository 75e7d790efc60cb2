#include "contact_path/ros/node_parameters.h"

#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

namespace contact_path::limits_test {
namespace {

namespace msgs = contact_path_msgs;

TraceLimits SmallLimits() {
  TraceLimits limits;
  limits.max_nodes = 2;
  limits.max_elements = 3;
  limits.max_contacts = 4;
  limits.max_increments = 5;
  return limits;
}

// Everything as large as the limits admit.
msgs::TraceRequest LargestRequest() {
  msgs::TraceRequest request;
  request.scene.nodes.resize(2);
  request.scene.bars.resize(3);
  for (auto& bar : request.scene.bars) bar.nodes.resize(2);
  request.scene.superelements.resize(2);
  request.scene.superelements[0].stiffness.resize(2);
  request.scene.superelements[1].stiffness.resize(1);
  request.scene.superelements[0].rest_positions.resize(3);
  request.scene.loads.resize(3);
  request.scene.support_motions.resize(3);
  request.scene.obstacle_motions.resize(4);
  request.scene.obstacles.resize(4);
  request.scene.contacts.resize(4);
  request.options.stop.resize(4);
  request.options.branch_choices.resize(4);
  request.options.max_increments = 5;
  return request;
}

// The limit that the request exceeds, in a line; empty where it is admitted.
std::string Exceeded(const msgs::TraceRequest& request, const TraceLimits& limits = SmallLimits()) {
  try {
    CheckLimits(request, limits);
    return "";
  } catch (const LimitExceeded& exceeded) {
    return exceeded.what();
  }
}

TEST(LimitsTest, AdmitsWhatReachesEveryLimit) { EXPECT_EQ(Exceeded(LargestRequest()), ""); }

TEST(LimitsTest, NamesWhatIsTooLargeAndTheLimit) {
  struct Increment {
    void (*enlarge)(msgs::TraceRequest& request);
    const char* line;
  };
  const Increment increments[] = {
      {[](auto& request) { request.scene.nodes.resize(3); }, "scene.nodes: 3, but the node admits 2 (~max_nodes)"},
      {[](auto& request) { request.scene.bars.resize(4); }, "scene.bars: 4, but the node admits 3 (~max_elements)"},
      {[](auto& request) { request.scene.superelements.resize(4); },
       "scene.superelements: 4, but the node admits 3 (~max_elements)"},
      {[](auto& request) { request.scene.superelements[1].stiffness.resize(2); },
       "stiffness entries of scene.superelements: 4, but the node admits 3 (~max_elements)"},
      {[](auto& request) { request.scene.superelements[0].rest_positions.resize(4); },
       "rest_positions entries of scene.superelements: 4, but the node admits 3 (~max_elements)"},
      {[](auto& request) { request.scene.superelements[0].nodes.resize(6); },
       "nodes entries of scene.superelements: 4, but the node admits 3 (~max_elements)"},
      {[](auto& request) { request.scene.support_motions.resize(4); },
       "scene.support_motions: 4, but the node admits 3 (~max_elements)"},
      {[](auto& request) { request.scene.obstacle_motions.resize(5); },
       "scene.obstacle_motions: 5, but the node admits 4 (~max_contacts)"},
      {[](auto& request) { request.scene.loads.resize(4); }, "scene.loads: 4, but the node admits 3 (~max_elements)"},
      {[](auto& request) { request.scene.obstacles.resize(5); },
       "scene.obstacles: 5, but the node admits 4 (~max_contacts)"},
      {[](auto& request) { request.scene.contacts.resize(5); },
       "scene.contacts: 5, but the node admits 4 (~max_contacts)"},
      {[](auto& request) { request.options.stop.resize(5); }, "options.stop: 5, but the node admits 4 (~max_contacts)"},
      {[](auto& request) { request.options.branch_choices.resize(5); },
       "options.branch_choices: 5, but the node admits 4 (~max_contacts)"},
      {[](auto& request) { request.options.max_increments = 6; },
       "options.max_increments: 6, but the node admits 5 (~max_increments)"},
  };
  msgs::TraceRequest named = LargestRequest();
  named.scene.name = std::string(131073, 'x');
  EXPECT_EQ(Exceeded(named), "scene.name: 131073 bytes, but the node admits 131072");
  for (const Increment& increment : increments) {
    msgs::TraceRequest request = LargestRequest();
    increment.enlarge(request);
    EXPECT_EQ(Exceeded(request), increment.line);
  }
}

// Stages take what is in them, and what they carry along.
TEST(LimitsTest, NamesWhatIsTooLargeInAProgram) {
  msgs::TraceRequest largest;
  largest.scene.loads.resize(1);
  largest.scene.obstacles.resize(2);
  largest.program.resize(2);
  largest.program[0].loads.resize(1);  // 2 in this stage, 2 in the next
  TraceLimits limits;
  limits.max_elements = 4;
  const auto exceeded = [&](const msgs::TraceRequest& request) { return Exceeded(request, limits); };
  EXPECT_EQ(exceeded(largest), "");

  for (const auto enlarge : {+[](msgs::Stage* stage) { stage->support_motions.resize(2); },
                             +[](msgs::Stage* stage) { stage->obstacle_motions.resize(2); }}) {
    msgs::TraceRequest request = largest;
    enlarge(&request.program[1]);
    EXPECT_EQ(exceeded(request), "loads and motions of program: 5, but the node admits 4 (~max_elements)");
  }
  msgs::TraceRequest request = largest;
  request.program[1].loads.resize(1);
  EXPECT_EQ(exceeded(request), "loads of all stages of program: 5, but the node admits 4 (~max_elements)");
  request = largest;
  request.scene.obstacles.resize(3);
  EXPECT_EQ(exceeded(request), "obstacles of all stages of program: 6, but the node admits 4 (~max_elements)");
}

TEST(LimitsTest, CountsTheDefaultNumberOfIncrements) {
  msgs::TraceRequest request = LargestRequest();
  request.options.max_increments = 0;
  EXPECT_EQ(Exceeded(request), "options.max_increments: 1000, but the node admits 5 (~max_increments)");
}

TEST(LimitsTest, LeavesANegativeNumberOfIncrementsToTheRulesOfRequests) {
  msgs::TraceRequest request = LargestRequest();
  request.options.max_increments = -1;
  EXPECT_EQ(Exceeded(request), "");
}

TEST(LimitsTest, RefusesLimitsThatMakeNoSense) {
  EXPECT_NO_THROW(TraceLimits().Validate());
  for (int TraceLimits::*const limit : {&TraceLimits::max_nodes, &TraceLimits::max_elements, &TraceLimits::max_contacts,
                                        &TraceLimits::max_increments, &TraceLimits::keep_free}) {
    TraceLimits limits;
    limits.*limit = 0;
    EXPECT_THROW(limits.Validate(), std::invalid_argument);
  }
  TraceLimits limits;
  limits.max_memory = -1;
  EXPECT_THROW(limits.Validate(), std::invalid_argument);
  limits.max_memory = 0;
  limits.max_seconds = 0.0;
  EXPECT_NO_THROW(limits.Validate());
  for (const double seconds :
       {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    limits.max_seconds = seconds;
    EXPECT_THROW(limits.Validate(), std::invalid_argument);
  }
}

}  // namespace
}  // namespace contact_path::limits_test
