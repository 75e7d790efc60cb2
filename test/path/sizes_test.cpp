// Scenes with lengths and forces of very different sizes, against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "support/reference_cases.h"
#include "support/traced_path.h"

namespace contact_path::sizes_test {
namespace {

TracedPath TraceData(const std::string& name, Method method, Accuracy accuracy) {
  TraceRequest request = ReadData(name);
  request.options.method = method;
  request.options.accuracy = accuracy;
  request.options.max_increments = 5000;
  return TraceIncrements(request);
}

// By each method with each accuracy, traced to its stop criterion.
void ForEachPath(const std::string& name, const std::function<void(const TracedPath&)>& expect) {
  for (const Method method : kMethods)
    for (const Accuracy accuracy : kPresets) {
      SCOPED_TRACE(std::string(ToString(method)) + ' ' + std::string(ToString(accuracy)));
      const TracedPath path = TraceData(name, method, accuracy);
      EXPECT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
      ExpectNoFindings(path);
      expect(path);
    }
}

// Of an exact increment, or of one whose residuals are of the order of the root of the smallest eps.
double Tolerance(const Increment& increment, double exact) { return increment.solve.exact ? exact : 1e-4; }

TEST(Sizes, CoordinatesFarFromTheOrigin) {
  constexpr double kAway = 1e6;
  ForEachPath("far_from_origin", [](const TracedPath& path) {
    for (const Increment& increment : path.increments) {
      const double x = PositionX(path, increment, "b") - kAway;
      const double tolerance = Tolerance(increment, 1e-9);  // positions are recorded to 1e-10
      EXPECT_NEAR(increment.load_factor, increment.index == 0 ? 0.0 : sliding_bar::LoadFactor(x), tolerance);
      EXPECT_NEAR(PositionY(path, increment, "b"), -kAway, tolerance);
      EXPECT_NEAR(increment.contacts[0].rn, sliding_bar::NormalReaction(x), tolerance);
    }
  });
}

TEST(Sizes, LimitLoadFarFromTheOrigin) {
  for (const Accuracy accuracy : kPresets) {
    const TracedPath path = TraceData("far_from_origin", Method::kBranch, accuracy);
    EXPECT_NEAR(LargestLoadFactor(path), 2.191505308, 1e-9);
  }
}

TEST(Sizes, GapsAtTheTolerance) {
  ForEachPath("gaps_at_tolerance", [](const TracedPath& path) {
    for (const Increment& increment : path.increments) {
      const double s = increment.load_factor, tolerance = Tolerance(increment, 2e-10);
      for (std::size_t i = 0; i < increment.contacts.size(); ++i) {
        const Node& node = path.request.scene.nodes[2 + i];
        const double pressed = std::max(s - node.y, 0.0);
        EXPECT_NEAR(increment.contacts[i].gap, std::max(node.y - s, 0.0), tolerance);
        EXPECT_NEAR(increment.contacts[i].rn, pressed, tolerance);
        EXPECT_NEAR(PositionX(path, increment, node.name), node.x + 0.5 * s - 0.3 * pressed, tolerance);
      }
    }
  });
}

TEST(Sizes, VeryRoughFloor) {
  constexpr double kFriction = 1e6;
  for (const Method method : kMethods)
    for (const Accuracy accuracy : kPresets) {
      SCOPED_TRACE(std::string(ToString(method)) + ' ' + std::string(ToString(accuracy)));
      const TracedPath path = TraceData("very_rough_floor", method, accuracy);
      if (method == Method::kBranch) {
        EXPECT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
        ExpectNoFindings(path);
        const double most = sliding_bar::kEA * (1.0 / sliding_bar::kHeight - 1.0 / sliding_bar::kRestLength);
        EXPECT_NEAR(LargestLoadFactor(path) / kFriction, most * sliding_bar::kHeight, 1e-12);
        EXPECT_EQ(IncrementsOfKind(path, IncrementKind::kSmoothLimit).size(), 1U);
      } else {
        // The node slides by a millionth of what the load grows: less than the regularisation can tell from sticking.
        EXPECT_TRUE(path.result.reason == EndReason::kStepTooSmall || path.result.reason == EndReason::kNotDetermined)
            << path.result.message;
      }
      for (const Increment& increment : path.increments) {
        const double x = PositionX(path, increment, "b");
        const double stiffness =
            sliding_bar::kEA * (1.0 / std::hypot(x, sliding_bar::kHeight) - 1.0 / sliding_bar::kRestLength);
        const double load = increment.index == 0 ? 0.0 : stiffness * (sliding_bar::kHeight * kFriction - x);
        EXPECT_NEAR(increment.load_factor / kFriction, load / kFriction, Tolerance(increment, 1e-9));
        EXPECT_NEAR(increment.contacts[0].rn, stiffness * sliding_bar::kHeight, Tolerance(increment, 1e-9));
      }
    }
}

// Pressed with 5e-12 of F, and lifted. k = 1e-10: what the support of the spring has moved up since the press, less the
// depth of the press.
TEST(Sizes, ContactThatIsSoftAcrossAndStiffAlong) {
  constexpr double kRounding = 1e-14;
  for (const Accuracy accuracy : kPresets) {  // by branch: forces of 1e-12 of F are far below the eps of mpec
    SCOPED_TRACE(ToString(accuracy));
    const TracedPath path = TraceData("soft_across_stiff_along", Method::kBranch, accuracy);
    EXPECT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
    ExpectNoFindings(path);
    for (const Increment& increment : path.increments) {
      const double lifted = PositionY(path, increment, "c") - 1.0;
      EXPECT_NEAR(increment.contacts[0].gap, std::max(lifted, 0.0), kRounding);
      EXPECT_NEAR(increment.contacts[0].rn / 1e-10, std::max(-lifted, 0.0), kRounding);
    }
  }
}

TEST(Sizes, ContactThatIsSoftInAllDirections) {
  constexpr double kSoft = 1e-10, kFriction = 0.3, kRounding = 1e-14;
  for (const Accuracy accuracy : kPresets) {
    SCOPED_TRACE(ToString(accuracy));
    const TracedPath path = TraceData("soft_support", Method::kBranch, accuracy);
    EXPECT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
    ExpectNoFindings(path);
    for (const Increment& increment : path.increments) {
      const double x_c = PositionX(path, increment, "c"), y_c = PositionY(path, increment, "c");
      const double pressed = std::max(1.0 - y_c, 0.0), x = std::max(x_c - kFriction * pressed, 0.0);
      EXPECT_NEAR(increment.contacts[0].gap, std::max(y_c - 1.0, 0.0), kRounding);
      EXPECT_NEAR(increment.contacts[0].rn / kSoft, pressed, kRounding);
      EXPECT_NEAR(PositionX(path, increment, "b"), x, kRounding);
      EXPECT_NEAR(increment.contacts[0].rt / kSoft, pressed > 0.0 ? x - x_c : 0.0, kRounding);
    }
  }
}

// The regularisation of method mpec cannot tell slip from stick there, nor any method where loads drive the path.
TEST(Sizes, ContactThatIsTooSoftEndsByName) {
  TraceRequest request = ReadData("soft_support");
  request.options.method = Method::kMpec;
  const TracedPath mpec = TraceIncrements(request);
  request.options.method = Method::kBranch;
  request.program = {request.program[0]};
  request.program[0].support_motions.clear();
  request.program[0].loads = {{"b", 1e-10, -1e-10, false}};
  for (const TraceResult& result : {mpec.result, TraceIncrements(request).result}) {
    EXPECT_EQ(result.reason, EndReason::kNotDetermined);
    EXPECT_NE(result.message.find("the sign of the stiffness of the parts at contact"), std::string::npos)
        << result.message;
  }
}

// Down to where its equation cannot be told from a dependent one it is followed, and softer refused.
TEST(Sizes, SoftestContactOfAll) {
  constexpr double kSoft = 1e-10;
  const TraceRequest request = TraceData("soft_support", Method::kBranch, Accuracy::kBalanced).request;
  for (const double softer : {0.2, 0.02, 0.01, 0.002}) {
    SCOPED_TRACE("stiffness times " + std::to_string(softer));
    TraceRequest scaled = request;
    for (Superelement& part : scaled.scene.superelements)
      for (double& entry : part.stiffness)
        if (std::abs(entry) < 1e-3) entry *= softer;
    const TracedPath path = TraceIncrements(scaled);
    if (path.result.reason == EndReason::kNotDetermined) {
      EXPECT_LT(softer, 0.2);
      EXPECT_NE(path.result.message.find("the sign of the stiffness of the parts at contact"), std::string::npos)
          << path.result.message;
      continue;
    }
    EXPECT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
    for (const Increment& increment : path.increments) {
      const double pressed = std::max(1.0 - PositionY(path, increment, "c"), 0.0);
      EXPECT_NEAR(increment.contacts[0].rn / (softer * kSoft), pressed, 1e-12);
    }
  }
}

TEST(Sizes, HeavyConstantLoadOnALinearPart) {
  constexpr double kLoad = 1e9;
  ForEachPath("heavy_constant_load", [](const TracedPath& path) {
    for (const Increment& increment : path.increments) {
      const double x = PositionX(path, increment, "p") / kLoad, s = increment.load_factor / kLoad;
      // Method mpec may cut corners.
      const double tolerance = path.request.options.method == Method::kBranch ? 1e-12 : 1e-2;
      switch (increment.contacts[0].state) {
        case ContactState::kStick: EXPECT_NEAR(x, 0.0, tolerance); break;
        case ContactState::kSlipPlus: EXPECT_NEAR(s, 1.0 - 0.5 * x, tolerance); break;
        case ContactState::kOpen: EXPECT_NEAR(s, 2.0 / 3.0 + 0.4375 * (x - 2.0 / 3.0), tolerance); break;
        default: ADD_FAILURE() << ToString(increment.contacts[0].state);
      }
    }
    EXPECT_EQ(path.increments.back().contacts[0].state, ContactState::kOpen);
  });
}

TEST(Sizes, LoadsThatNearlyCancel) {
  ForEachPath("loads_that_cancel", [](const TracedPath& path) {
    const double load = path.request.scene.loads[0].fx + path.request.scene.loads[1].fx;
    for (const Increment& increment : path.increments) {
      const double force = load * increment.load_factor;
      EXPECT_NEAR(PositionX(path, increment, "p"), std::min(force, 1.0), 1e-11);
      EXPECT_NEAR(increment.contacts[0].rn, std::max(force - 1.0, 0.0), 1e-11);
    }
  });
}

}  // namespace
}  // namespace contact_path::sizes_test
