// The same path in other units, turned, mirrored, and with everything in another order.
#include <gtest/gtest.h>

#include <string>

#include "contact_path/verify/verify_path.h"
#include "support/transformations.h"

namespace contact_path::invariance_test {
namespace {

// Scaled quantities, row by row; measured up to 3e-12 (arch19, whose stiffness is singular).
constexpr double kSame = 1e-8;

constexpr double kDegree = 0.017453292519943295;

// Of a node that is held along one axis only, which cannot be said in a turned frame; a spring can.
constexpr double kHeld = 1e4;

struct Case {
  const char* name;
  double step;
  int max_increments;
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
    HoldBySprings(&request.scene);
    return request;
  }
  static void HoldBySprings(Scene* scene) {
    for (Node& node : scene->nodes) {
      if (node.fixed_x == node.fixed_y) continue;
      scene->superelements.push_back({{node.name}, {node.fixed_x ? kHeld : 0.0, 0.0, 0.0, node.fixed_y ? kHeld : 0.0}});
      node.fixed_x = node.fixed_y = false;
    }
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
    testing::Values(Case{"sliding_bar", 0.1, 20}, Case{"rough_truss", 0.05, 12}, Case{"two_dof_friction", 0.1, 50},
                    Case{"arch19", 0.1, 60}, Case{"lee_frame", 0.0, 150, Method::kBranch},
                    Case{"williams_toggle", 0.0, 100, Method::kBranch}, Case{"rough_arch", 0.0, 100, Method::kBranch},
                    Case{"portal_frame", 0.0, 60, Method::kBranch}, Case{"cantilever_block", 0.0, 40, Method::kBranch},
                    Case{"peg", 0.0, 60, Method::kBranch}, Case{"rope", 0.0, 50, Method::kBranch},
                    Case{"cam", 0.0, 150, Method::kBranch}, Case{"snap_hook", 0.0, 100, Method::kBranch},
                    Case{"fin_ray", 0.0, 250, Method::kBranch}, Case{"peg_in_hole", 0.0, 180, Method::kBranch},
                    Case{"two_blocks", 0.0, 80, Method::kBranch}, Case{"ring_on_ring", 0.0, 210, Method::kBranch},
                    Case{"crushed_ring", 0.0, 180, Method::kBranch}, Case{"lee_frame", 0.0, 20},
                    Case{"cantilever_block", 0.5, 10}),
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
  constexpr double kAngle = 37.0 * kDegree;
  ExpectSamePath(UndoRotation(TraceIncrements(Rotate(Request(), kAngle)), kAngle), Expected(), kSame);
}

TEST_P(Invariance, MirrorImage) { ExpectSamePath(UndoMirror(TraceIncrements(Mirror(Request()))), Expected(), kSame); }

TEST_P(Invariance, OrderOfParts) {
  ExpectSamePath(UndoReversal(TraceIncrements(Reverse(Request()))), Expected(), kSame);
}

}  // namespace
}  // namespace contact_path::invariance_test
