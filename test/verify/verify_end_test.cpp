#include "contact_path/verify/verify_path.h"

#include <gtest/gtest.h>

#include <vector>

#include "support/traced_path.h"

namespace contact_path::verify_end_test {
namespace {

std::vector<Increment> First(const TracedPath& path, std::size_t count) {
  return {path.increments.begin(), path.increments.begin() + static_cast<std::ptrdiff_t>(count)};
}

TEST(VerifyEnd, OfWholeTracesIsNotContradicted) {
  for (const char* scene : {"sliding_bar", "rough_truss", "gripper", "stick_slip_cycle"})
    for (const Method method : {Method::kBranch, Method::kMpec}) {
      TraceRequest request = ReadExample(scene);
      request.options.method = method;
      const TracedPath path = TraceIncrements(request);
      EXPECT_EQ(EndContradicted(request, path.increments, ToString(path.result.reason)), "") << scene;
    }
}

TEST(VerifyEnd, OfATraceThatWasCutShortIs) {
  const TracedPath path = TraceIncrements(ReadExample("sliding_bar"));
  const std::vector<Increment> cut = First(path, 20);
  EXPECT_EQ(EndContradicted(path.request, cut, "stop_criterion"),
            "the result says stop_criterion, but none holds in the last increment");
  EXPECT_EQ(EndContradicted(path.request, cut, "max_increments"),
            "the result says max_increments, but the request wants 1000 increments");
  EXPECT_EQ(EndContradicted(path.request, cut, "path_end"),
            "the result says path_end, but the path goes on from the last increment");
  EXPECT_EQ(EndContradicted(path.request, cut, "closed_path"),
            "the result says closed_path, but no earlier increment has the state of the last one");
  EXPECT_EQ(EndContradicted(path.request, cut, "cancelled"), "");
}

TEST(VerifyEnd, OfMaxIncrements) {
  TraceRequest request = ReadExample("sliding_bar");
  request.options.max_increments = 12;
  const TracedPath path = TraceIncrements(request);
  EXPECT_EQ(EndContradicted(request, path.increments, "max_increments"), "");
  EXPECT_NE(EndContradicted(request, First(path, 12), "max_increments"), "");
}

TEST(VerifyEnd, OfALimitOfTheMachine) {
  TraceRequest request = ReadExample("von_mises");
  request.options.at_limit = AtLimit::kStop;
  const TracedPath path = TraceIncrements(request);
  ASSERT_EQ(path.result.reason, EndReason::kAtLimit) << path.result.message;
  EXPECT_EQ(EndContradicted(request, path.increments, "at_limit"), "");
  EXPECT_EQ(EndContradicted(request, path.increments, "no_landing"),
            "the result says no_landing, but at_limit is stop");
  request.options.at_limit = AtLimit::kJump;
  EXPECT_EQ(EndContradicted(request, path.increments, "no_landing"), "");
}

// A normal that was turned round: no branch leads from the start.
TEST(VerifyEnd, OfAPath) {
  TraceRequest request = ReadExample("sliding_bar");
  request.scene.obstacles[0].ny = -1.0;
  const TracedPath path = TraceIncrements(request);
  ASSERT_EQ(path.result.reason, EndReason::kPathEnd);
  EXPECT_EQ(EndContradicted(request, path.increments, "path_end"), "");
  request.options.method = Method::kMpec;
  EXPECT_EQ(EndContradicted(request, path.increments, "path_end"),
            "the result says path_end, but increments by Ipopt cannot tell the end of a path");
  // Where a branch is taken from an event, the path goes on.
  const TracedPath slides = TraceIncrements(ReadExample("rough_truss"));
  for (std::size_t i = 1; i + 1 < slides.increments.size(); ++i)
    if (slides.increments[i].event.taken >= 1) {
      EXPECT_NE(EndContradicted(slides.request, First(slides, i + 1), "path_end"), "");
    }
}

TEST(VerifyEnd, OfAClosedPath) {
  TraceRequest request = ReadExample("sliding_bar");
  request.options.stop.clear();
  const TracedPath path = TraceIncrements(request);
  ASSERT_EQ(path.result.reason, EndReason::kClosedPath);
  EXPECT_EQ(EndContradicted(request, path.increments, "closed_path"), "");
  for (const int change : {0, 1, 2, 3}) {
    std::vector<Increment> other = path.increments;
    Increment& last = other.back();
    if (change == 0) last.contacts[0].rn += 1e-4;
    if (change == 1) last.contacts[0].state = ContactState::kStick;
    if (change == 2) last.positions[2] += 1e-4;
    if (change == 3) last.load_factor += 1e-4;
    EXPECT_NE(EndContradicted(request, other, "closed_path"), "") << change;
  }
}

}  // namespace
}  // namespace contact_path::verify_end_test
