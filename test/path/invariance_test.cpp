// The same path in other units, turned, mirrored, and with everything in another order.
#include <gtest/gtest.h>

#include <string>

#include "contact_path/verify/verify_path.h"
#include "support/transformations.h"

namespace contact_path {
namespace {

// Scaled quantities, row by row; measured up to 3e-12 (arch19, whose stiffness is singular).
constexpr double kSame = 1e-8;

constexpr double kDegree = 0.017453292519943295;

struct Case {
  const char* name;
  double step;
  int max_increments;
  bool can_turn;  // no node is held along one axis only, and no node slides to where the two halves of a circle meet
  Method method = Method::kMpec;
};

std::string NameOf(const Case& scene) {
  return std::string(scene.name) + (scene.method == Method::kBranch ? "_branch" : "");
}

class Invariance : public testing::TestWithParam<Case> {
 protected:
  static TraceRequest Request() {
    TraceRequest request = ReadExample(GetParam().name);
    request.options.method = GetParam().method;
    request.options.step = GetParam().step;
    request.options.max_increments = GetParam().max_increments;
    request.options.stop.clear();
    return request;
  }
  // Traced once for all tests of a case; they run one after the other.
  static const TracedPath& Expected() {
    static std::string name;
    static TracedPath path;
    if (name != NameOf(GetParam())) {
      name = NameOf(GetParam());
      path = TraceIncrements(Request());
    }
    return path;
  }
};

std::string CaseName(const testing::TestParamInfo<Case>& instance) { return NameOf(instance.param); }

INSTANTIATE_TEST_SUITE_P(
    Scenes, Invariance,
    testing::Values(
        Case{"sliding_bar", 0.1, 20, true}, Case{"rough_truss", 0.05, 12, true},
        Case{"two_dof_friction", 0.1, 50, true}, Case{"arch19", 0.1, 60, true},
        Case{"lee_frame", 0.0, 150, true, Method::kBranch}, Case{"williams_toggle", 0.0, 100, true, Method::kBranch},
        Case{"rough_arch", 0.0, 100, false, Method::kBranch}, Case{"portal_frame", 0.0, 60, true, Method::kBranch},
        Case{"cantilever_block", 0.0, 40, true, Method::kBranch}, Case{"peg", 0.0, 60, true, Method::kBranch},
        Case{"rope", 0.0, 50, false, Method::kBranch}, Case{"cam", 0.0, 150, true, Method::kBranch},
        Case{"snap_hook", 0.0, 100, false, Method::kBranch}, Case{"fin_ray", 0.0, 250, false, Method::kBranch},
        Case{"peg_in_hole", 0.0, 190, true, Method::kBranch}, Case{"two_blocks", 0.0, 80, true, Method::kBranch},
        Case{"peg", 0.1, 25, true}, Case{"cam", 0.1, 40, true}, Case{"rope", 0.1, 12, true},
        Case{"lee_frame", 0.0, 20, true}, Case{"portal_frame", 0.0, 10, true}, Case{"cantilever_block", 0.5, 10, true}),
    CaseName);

TEST_P(Invariance, PathIsLongEnoughToMeanSomething) {
  EXPECT_EQ(Expected().result.reason, EndReason::kMaxIncrements);
  for (const Finding& finding : VerifyPath(Expected().request, Expected().increments).findings)
    ADD_FAILURE() << "increment " << finding.increment << ": " << finding.what;
  // It is about a scene without a program.
  if (Request().program.empty()) ExpectSoundIncrements(Expected(), 1e-9);
}

TEST_P(Invariance, Units) {
  ExpectSamePath(UndoUnits(TraceIncrements(ChangeUnits(Request(), 1e-3, 1e6)), 1e-3, 1e6), Expected(), kSame);
}

TEST_P(Invariance, Rotation) {
  if (!GetParam().can_turn) GTEST_SKIP() << "the scene has axes of its own";
  ExpectSamePath(UndoRotation(TraceIncrements(Rotate(Request(), 37.0 * kDegree)), 37.0 * kDegree), Expected(), kSame);
}

TEST_P(Invariance, MirrorImage) { ExpectSamePath(UndoMirror(TraceIncrements(Mirror(Request()))), Expected(), kSame); }

TEST_P(Invariance, OrderOfParts) {
  ExpectSamePath(UndoReversal(TraceIncrements(Reverse(Request()))), Expected(), kSame);
}

}  // namespace
}  // namespace contact_path
