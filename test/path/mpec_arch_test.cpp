// The arch of 19 bars under rough ceilings by Algorithm 3.2, against independent results.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "support/traced_path.h"

namespace contact_path::mpec_arch_test {
namespace {

TraceRequest Arch() {
  TraceRequest request = ReadExample("arch19");
  request.options.method = Method::kMpec;
  request.options.step = 0.05;
  return request;
}

class Arch19 : public testing::Test {
 protected:
  static const TracedPath& Path() {
    static const TracedPath path = TraceIncrements(Arch());
    return path;
  }
  static double Rise(const Increment& increment) { return PositionY(Path(), increment, "a"); }
};

// It once fell off its ceilings here: a mechanism is no start.
TEST(Arch19Fast, IsHeldByItsCeilingsToTheSmoothLimitPoint) {
  TraceRequest request = Arch();
  request.options.accuracy = Accuracy::kFast;
  request.options.max_increments = 30;
  const TracedPath path = TraceIncrements(request);
  ASSERT_EQ(path.increments.size(), 31U);
  for (std::size_t i = 1; i < path.increments.size(); ++i)
    EXPECT_GT(path.increments[i].load_factor, path.increments[i - 1].load_factor) << "increment " << i;
}

TEST_F(Arch19, ReachesItsEndWithSoundIncrements) {
  EXPECT_EQ(Path().result.reason, EndReason::kStopCriterion);
  ExpectSoundIncrements(Path(), 1e-9);
}

TEST_F(Arch19, StaysSymmetric) {
  constexpr double kSymmetry = 1e-10;  // of lengths of order 1; measured 6e-13
  const char* const mirrored[][2] = {{"a", "g"}, {"b", "h"}, {"d", "i"}, {"e", "j"}, {"f", "k"}, {"c", "c"}};
  const char* const contacts[][2] = {{"f@roof_f", "k@roof_f"}, {"e@roof_e", "j@roof_e"}, {"d@roof_d", "i@roof_d"}};
  for (const Increment& increment : Path().increments) {
    for (const auto& [right, left] : mirrored) {
      SCOPED_TRACE(testing::Message() << increment.index << " " << right);
      EXPECT_NEAR(PositionX(Path(), increment, right), -PositionX(Path(), increment, left), kSymmetry);
      EXPECT_NEAR(PositionY(Path(), increment, right), PositionY(Path(), increment, left), kSymmetry);
    }
    for (const auto& [right, left] : contacts) {
      SCOPED_TRACE(testing::Message() << increment.index << " " << right);
      const ContactRecord &r = Contact(Path(), increment, right), &l = Contact(Path(), increment, left);
      EXPECT_NEAR(r.rn, l.rn, kSymmetry);
      EXPECT_NEAR(r.rt, -l.rt, kSymmetry);
      EXPECT_EQ(r.state == ContactState::kSlipPlus, l.state == ContactState::kSlipMinus);
      EXPECT_EQ(r.state == ContactState::kSlipMinus, l.state == ContactState::kSlipPlus);
    }
  }
}

TEST_F(Arch19, HeldFromTheStartAndFSlidesInwards) {
  // Never the trivial solution in which the arch falls away; towards -x is towards +t under a ceiling, t = (-1, 0).
  for (std::size_t i = 1; i < Path().increments.size(); ++i) {
    const Increment& increment = Path().increments[i];
    EXPECT_GT(increment.load_factor, 0.0);
    EXPECT_GT(Contact(Path(), increment, "f@roof_f").rn, 0.0);
    EXPECT_EQ(Contact(Path(), increment, "f@roof_f").state, ContactState::kSlipPlus) << i;
    EXPECT_LT(PositionX(Path(), increment, "f"), PositionX(Path(), Path().increments[i - 1], "f")) << i;
    EXPECT_EQ(Contact(Path(), increment, "d@roof_d").state, ContactState::kOpen) << i;
  }
}

TEST_F(Arch19, LimitPointB) {
  // The largest load before e touches, by the parabola through the three increments around it.
  std::size_t top = 1;
  for (std::size_t i = 1; i + 1 < Path().increments.size(); ++i) {
    if (Contact(Path(), Path().increments[i + 1], "e@roof_e").state != ContactState::kOpen) break;
    if (Path().increments[i].load_factor > Path().increments[top].load_factor) top = i;
  }
  const auto point = [&](std::size_t i) {
    return std::pair(Rise(Path().increments[i]), Path().increments[i].load_factor);
  };
  const auto [x0, y0] = point(top - 1);
  const auto [x1, y1] = point(top);
  const auto [x2, y2] = point(top + 1);
  const double d01 = (y1 - y0) / (x1 - x0), d12 = (y2 - y1) / (x2 - x1), curvature = (d12 - d01) / (x2 - x0);
  const double rise = 0.5 * (x0 + x1) - 0.5 * d01 / curvature;
  const double load = y0 + d01 * (rise - x0) + curvature * (rise - x0) * (rise - x1);
  EXPECT_NEAR(rise, 2.68, 0.01);  // known to its digits
  EXPECT_NEAR(load, 0.03558, 0.00001);
  EXPECT_TRUE(std::any_of(Path().increments.begin(), Path().increments.end(), [&](const Increment& increment) {
    return increment.kind == IncrementKind::kSmoothLimit && std::abs(Rise(increment) - 2.68) < 0.1;
  }));
}

TEST_F(Arch19, CornerC) {
  const std::vector<Increment>& increments = Path().increments;
  std::size_t touch = 1;
  while (touch < increments.size() && Contact(Path(), increments[touch], "e@roof_e").state == ContactState::kOpen)
    ++touch;
  ASSERT_LT(touch + 1, increments.size());
  // It lies between two increments, which are close together there.
  const double known = 0.00005;
  EXPECT_LE(Rise(increments[touch - 1]), 2.8529 + known);
  EXPECT_GE(Rise(increments[touch]), 2.8529 - known);
  EXPECT_LE(increments[touch].arc_length - increments[touch - 1].arc_length, 0.01);
  const double lowest = std::min(increments[touch - 1].load_factor, increments[touch].load_factor);
  EXPECT_NEAR(lowest, 0.03532, 0.0001);
  // Falling before, rising after, named as a corner, with f sliding inwards throughout.
  EXPECT_LT(increments[touch - 1].load_factor, increments[touch - 2].load_factor);
  EXPECT_GT(increments[touch + 1].load_factor, increments[touch].load_factor);
  EXPECT_TRUE(increments[touch].kind == IncrementKind::kCornerLimit ||
              increments[touch + 1].kind == IncrementKind::kCornerLimit);
  EXPECT_GT(increments.back().load_factor, 0.036);
}

}  // namespace
}  // namespace contact_path::mpec_arch_test
