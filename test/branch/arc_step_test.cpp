#include "contact_path/branch/arc_step.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "branch/traced_arc.h"
#include "support/traced_path.h"

namespace contact_path::arc_step_test {
namespace {

const StepLimits kLimits = {1e-9, 1.0, 1e-3, 0.98};

TracedArc LinearArc() { return {TraceScene(ReadExample("rigid_stop").scene, 3), 1}; }
TracedArc BentArc() { return {TraceScene(ReadExample("sliding_bar").scene, 21), 20}; }

// u and s move by the same, and the wall is at the distance 0.1.
TEST(ArcStep, EndsAtTheFirstEvent) {
  TracedArc arc = LinearArc();
  const std::optional<ArcStep> at = NextStep(&arc.arc(), arc.start(), 0.5, kLimits, {});
  ASSERT_TRUE(at);
  EXPECT_EQ(at->event.kind, EventKind::kContactEvent);
  EXPECT_NEAR(at->step.length, 0.1 * std::sqrt(2.0), 1e-14);
  EXPECT_EQ(at->tried, 0.5);
  EXPECT_EQ(at->rejected, 0);
  EXPECT_NEAR(at->step.end.x[0], 1.1, 1e-14);
}

TEST(ArcStep, OfTheWantedLengthWithoutAnEvent) {
  TracedArc arc = LinearArc();
  const std::optional<ArcStep> at = NextStep(&arc.arc(), arc.start(), 0.1, kLimits, {});
  ASSERT_TRUE(at);
  EXPECT_EQ(at->event.kind, EventKind::kNone);
  EXPECT_NEAR(at->step.length, 0.1, 1e-14);
}

TEST(ArcStep, EndsAtTheTarget) {
  TracedArc arc = LinearArc();
  const std::optional<ArcStep> at = NextStep(&arc.arc(), arc.start(), 0.5, kLimits, {0.05});
  ASSERT_TRUE(at);
  EXPECT_EQ(at->event.kind, EventKind::kTarget);
  EXPECT_NEAR(arc.Load(at->step.end), 0.05, 1e-15);
}

// At the wall the gap is broken by any step towards it.
TEST(ArcStep, OfNoLengthWhereTheEventIsAtTheStart) {
  TracedArc arc = LinearArc();
  const CurvePoint start = arc.At(0.1 * std::sqrt(2.0));
  const std::optional<ArcStep> at = NextStep(&arc.arc(), start, 0.1, kLimits, {});
  ASSERT_TRUE(at);
  EXPECT_EQ(at->event.kind, EventKind::kContactEvent);
  EXPECT_EQ(at->step.length, 0.0);
}

// The half that is accepted turns by less than the limit, and twice its length turns by more.
TEST(ArcStep, IsHalvedWhileTheTangentTurnsTooFar) {
  TracedArc arc = BentArc();
  const StepLimits limits = {1e-9, 1.0, 1.0, 0.9999};
  const std::optional<ArcStep> at = NextStep(&arc.arc(), arc.start(), 0.4, limits, {});
  ASSERT_TRUE(at);
  ASSERT_GT(at->rejected, 0);
  EXPECT_EQ(at->tried, std::ldexp(0.4, -at->rejected));
  const auto cosine = [&](double t) { return arc.At(t).first.head(arc.motion()).dot(arc.normal()); };
  EXPECT_GE(cosine(at->tried), limits.cosine);
  EXPECT_LT(cosine(2.0 * at->tried), limits.cosine);
}

TEST(ArcStep, NothingBelowTheSmallest) {
  TracedArc arc = BentArc();
  EXPECT_FALSE(NextStep(&arc.arc(), arc.start(), 0.4, {0.3, 1.0, 1.0, 0.9999}, {}));
}

// Where no step meets the limit, a predictor that is further off is taken in the end.
TEST(ArcStep, InTheEndThePredictorMayBeFurtherOff) {
  TracedArc arc = BentArc();
  const std::optional<ArcStep> at = NextStep(&arc.arc(), arc.start(), 0.04, {0.01, 1.0, 1e-12, 0.98}, {});
  ASSERT_TRUE(at);
  EXPECT_EQ(at->tried, 0.04);
  EXPECT_GT(at->rejected, 0);
}

}  // namespace
}  // namespace contact_path::arc_step_test
