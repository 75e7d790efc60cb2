#include "contact_path/path/earlier_trace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/traced_path.h"

namespace contact_path::restored_states_test {
namespace {

double DifferenceOf(const Increment& a, const Increment& b) {
  double worst = LargestDifference(a, b);
  for (std::size_t i = 0; i < a.contacts.size(); ++i)
    worst = std::max(worst, std::abs(a.contacts[i].gap - b.contacts[i].gap));
  return worst;
}

TEST(RestoreStates, OfAllExamples) {
  for (const char* name : {"sliding_bar", "von_mises", "rough_truss", "two_dof_friction", "rigid_stop",
                           "stick_slip_cycle", "press_slide_lift", "gripper"})
    for (const int every : {4, 1000}) {
      SCOPED_TRACE(std::string(name) + " with every " + std::to_string(every));
      const TracedPath path = TraceIncrements(ReadExample(name));
      std::vector<Increment> increments = Thinned(path, every);
      EXPECT_EQ(RestoreStates(path.request, &increments), increments.size());
      double worst = 0.0;
      for (std::size_t i = 0; i < increments.size(); ++i)
        worst = std::max(worst, DifferenceOf(increments[i], path.increments[i]));
      EXPECT_LE(worst, 1e-9);
    }
}

TEST(RestoreStates, OfMpec) {
  TraceRequest request = ReadExample("sliding_bar");
  request.options.method = Method::kMpec;
  const TracedPath path = TraceIncrements(request);
  std::vector<Increment> increments = Thinned(path, 5);
  EXPECT_EQ(RestoreStates(path.request, &increments), increments.size());
  for (std::size_t i = 0; i < increments.size(); ++i)
    EXPECT_LE(DifferenceOf(increments[i], path.increments[i]), 1e-9) << i;
}

// An increment that does not lie where it says is not invented.
TEST(RestoreStates, StopsAtAnIncrementThatIsNotOnThePath) {
  const TracedPath path = TraceIncrements(ReadExample("sliding_bar"));
  std::vector<Increment> increments = Thinned(path, 4);
  increments[9].load_factor *= 1.001;
  EXPECT_EQ(RestoreStates(path.request, &increments), 9U);
  EXPECT_TRUE(increments[9].positions.empty());
}

}  // namespace
}  // namespace contact_path::restored_states_test
