#include "contact_path/verify/verify_path.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "verify/verified.h"

namespace contact_path::verify_path_test {
namespace {

TEST(VerifyPath, ProvesWhatBothMethodsTrace) {
  for (const char* scene : {"sliding_bar", "von_mises", "rough_truss", "two_dof_friction", "rigid_stop", "arch19"})
    for (const Method method : {Method::kBranch, Method::kMpec}) {
      SCOPED_TRACE(scene);
      const TracedPath path = Traced(scene, method);
      const Verification verification = VerifyPath(path.request, path.increments);
      EXPECT_TRUE(verification.findings.empty()) << Listed(verification);
      EXPECT_EQ(verification.increments, static_cast<int>(path.increments.size()));
      EXPECT_EQ(verification.full_increments, verification.increments);
      EXPECT_EQ(verification.exact_increments, verification.increments);
      EXPECT_LE(verification.exact.equilibrium, 1e-12);
      EXPECT_LE(verification.exact.Contact(), 1e-11);
      EXPECT_GT(verification.work, 0.0);
    }
}

// Where a node cannot move along an obstacle, there is no friction, whatever its coefficient.
TEST(VerifyPath, ProvesContactsThatCannotSlide) {
  TraceRequest request = ReadExample("rigid_stop");
  for (Obstacle& obstacle : request.scene.obstacles) obstacle.friction = 0.3;
  const TracedPath path = TraceIncrements(request);
  EXPECT_EQ(path.increments.back().contacts[0].state, ContactState::kClosed);
  ExpectNoFindings(path);
}

TEST(VerifyPath, LongIncrementsThatCutCornersAreProved) {
  TraceRequest request = ReadExample("sliding_bar");
  request.options.method = Method::kMpec;
  request.options.step = 0.2;
  const TracedPath path = TraceIncrements(request);
  ExpectNoFindings(path);
}

TEST(VerifyPath, FarFromTheOriginIsRounding) {
  for (const char* scene : {"sliding_bar", "von_mises"}) {
    TraceRequest request = ReadExample(scene);
    for (Node& node : request.scene.nodes) node.x += 1e5;
    for (Obstacle& obstacle : request.scene.obstacles) obstacle.px += 1e5;
    request.options.stop.clear();
    request.options.max_increments = 60;
    const TracedPath path = TraceIncrements(request);
    ASSERT_EQ(path.increments.size(), 61U);
    ExpectNoFindings(path);
  }
}

// Paths that are right, whatever rounding or long increments make of single figures.
class RightPathIsProved : public ::testing::TestWithParam<const char*> {};

TEST_P(RightPathIsProved, FromFile) {
  const TracedPath path = TraceIncrements(ReadData(GetParam()));
  ASSERT_TRUE(path.result.reason == EndReason::kMaxIncrements || path.result.reason == EndReason::kStopCriterion)
      << path.result.message;
  ExpectNoFindings(path);
}

INSTANTIATE_TEST_SUITE_P(VerifyPath, RightPathIsProved,
                         ::testing::Values("held_on_stiff_solid", "over_the_end_of_a_thick_surface",
                                           "touching_but_for_rounding", "drag_in_one_increment", "slot_on_stiff_bars",
                                           "strained_to_second_order", "slip_between_two_zeros",
                                           "largest_friction_within", "large_stored_energy", "soft_motion_in_place",
                                           "load_turns_on_soft_parts", "load_turns_in_rounding", "load_is_a_cubic",
                                           "very_rough_contact_opens", "presses_to_second_order",
                                           "very_rough_contact_leaves", "begins_to_press", "presses_and_lets_go",
                                           "over_a_bulge", "slips_forth_and_back"),
                         [](const auto& instance) { return std::string(instance.param); });

// A solid that rounding of its places stresses by more than the bars beside bear: the path ends by name, or is right.
TEST(VerifyPath, StiffSolidAmongSoftBarsIsProvedAsFarAsItGoes) {
  const TracedPath path = TraceIncrements(ReadData("stiff_solid_among_soft_bars"));
  EXPECT_TRUE(path.result.reason == EndReason::kMaxIncrements || path.result.reason == EndReason::kStepTooSmall ||
              path.result.reason == EndReason::kNotDetermined)
      << path.result.message;
  ExpectNoFindings(path);
}

// Work and dissipation are changed alike, so that the energies still balance: their trapezoids tell. The bars beside
// the contact are 100 times as stiff as F over L.
TEST(VerifyPath, DissipationThatIsBalancedByWorkIsFound) {
  for (const double factor : {0.0, 0.5, 1.5, 3.0})
    for (const double step : {0.0, 0.05, 0.1}) {
      SCOPED_TRACE(std::to_string(factor) + " of the dissipation, step " + std::to_string(step));
      TraceRequest request = ReadData("driven_through_a_stiff_bar");
      request.options.step = step;
      TracedPath path = TraceIncrements(request);
      ExpectNoFindings(path);
      ASSERT_GT(path.increments.back().dissipation, 0.0);
      for (Increment& increment : path.increments) {
        increment.external_work += (factor - 1.0) * increment.dissipation;
        increment.dissipation *= factor;
      }
      EXPECT_FALSE(VerifyPath(path.request, path.increments).findings.empty());
    }
}

// Pressed with 5e-12 of F and lifted: residuals over F see nothing of the reaction.
class SoftContact : public testing::Test {
 protected:
  void SetUp() override {
    path_ = TraceIncrements(ReadData("soft_across_stiff_along"));
    ASSERT_EQ(path_.result.reason, EndReason::kStopCriterion) << path_.result.message;
    pressed_ = path_.increments.size();
    for (const Increment& increment : path_.increments)
      if (increment.stage == 2 && increment.contacts[0].rn > 1e-12)
        pressed_ = static_cast<std::size_t>(increment.index);
    ASSERT_LT(pressed_, path_.increments.size());
  }

  std::string FindingsWith(double rn) {
    path_.increments[pressed_].contacts[0].rn = rn;
    return Listed(VerifyPath(path_.request, path_.increments));
  }

  TracedPath path_;
  std::size_t pressed_ = 0;
};

TEST_F(SoftContact, IsProved) {
  const Verification verification = VerifyPath(path_.request, path_.increments);
  EXPECT_TRUE(verification.findings.empty()) << Listed(verification);
}

TEST_F(SoftContact, MustNotPull) {
  EXPECT_NE(FindingsWith(-1e-12).find("pulls"), std::string::npos) << FindingsWith(-1e-12);
}

TEST_F(SoftContact, MustBeInEquilibrium) {
  const double rn = path_.increments[pressed_].contacts[0].rn;
  EXPECT_NE(FindingsWith(1.1 * rn).find("equilibrium residual across"), std::string::npos) << FindingsWith(1.1 * rn);
}

}  // namespace
}  // namespace contact_path::verify_path_test
