#include "contact_path/path/end.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>

#include "contact_path/path/sentences.h"
#include "contact_path/scene/read_scene.h"
#include "support/traced_path.h"

namespace contact_path::end_test {
namespace {

TEST(EndText, PutsNamesAndNumbersIn) {
  EXPECT_EQ(EndText({{sentences::kReactionSign, "p@floor", -1.2e-12, 5e-12}}),
            "the sign of the reaction of contact p@floor is not known: its value is -1.2e-12, its error 5e-12");
  EXPECT_EQ(
      EndText({{sentences::kCurveTurnsReaction, "p@table", 1e-9, 2.7123e-7}}),
      "contact p@table is pressed onto a curve of the radius 1e-09: rounding of the coordinates turns its reaction "
      "by 2.7e-07 rad");
  EXPECT_EQ(EndText({{sentences::kNoSuchBranch, "event 1", 7, 12345}}),
            "branch_choices wants branch 7 at event 1: the number of branches there is 12345");
  EXPECT_EQ(EndText({{sentences::kLimitPointOfLoads, "", 0.123456789}}),
            "a limit point at 0.123457 of their full size; only a dynamic jump leads further");
  EXPECT_EQ(EndText({{sentences::kCollapsedBar, "0 (<value>, b)", 0.5}}),
            "bar 0 (<value>, b) has shrunk to 0.5 of its initial length");
}

TEST(EndText, JoinsCauses) {
  EXPECT_EQ(EndText({}), "");
  EXPECT_EQ(EndText({{sentences::kConstantLoads}, {sentences::kNoIncrement}, {sentences::kNotSolved}}),
            "while the constant loads were brought on: no increment could be accepted, however short: the increment "
            "problem was not solved");
  EXPECT_EQ(EndText({{sentences::kNoBranch}, {sentences::kStandsAtEnd, "p@skin"}}),
            "no admissible branch: the quasi-static path ends here, only a dynamic jump leads further; contact p@skin "
            "stands at an end of its surface, over which a contact cannot slide");
}

TEST(Reached, IsWhatWasAskedFor) {
  TraceRequest request = ReadExample("sliding_bar");
  EXPECT_TRUE(TraceIncrements(request).result.reached);
  request.options.max_increments = 4;
  const TracedPath cut = TraceIncrements(request);
  EXPECT_EQ(cut.result.reason, EndReason::kMaxIncrements);
  EXPECT_FALSE(cut.result.reached);
  // Where nothing else was asked for.
  request.options.stop.clear();
  EXPECT_TRUE(TraceIncrements(request).result.reached);
  request.options.at_limit = AtLimit::kStop;
  EXPECT_FALSE(TraceIncrements(request).result.reached);
  request.options.max_increments = 0;
  EXPECT_TRUE(TraceIncrements(request).result.reached);
  request.options.at_limit = AtLimit::kFollow;
  const TracedPath closed = TraceIncrements(request);
  EXPECT_EQ(closed.result.reason, EndReason::kClosedPath);
  EXPECT_FALSE(closed.result.reached);
}

TEST(Reached, AProgramIsAtItsEnd) {
  TraceRequest request = ReadExample("stick_slip_cycle");
  EXPECT_TRUE(TraceIncrements(request).result.reached);
  request.options.max_increments = 4;
  EXPECT_FALSE(TraceIncrements(request).result.reached);
}

// Nodes that supports move down to a floor. One hangs on a bar, and is the only candidate.
TraceRequest Lowered(double down) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.nodes = {
      {"a", 0.0, 3.0, true, true}, {"b", 0.0, 2.0, true}, {"c", 1.0, 1.0, true, true}, {"d", 2.0, 1.1, true, true}};
  request.program = {{"down", {}, {{"a", 0.0, -down}}, {}, 0.0}};
  for (const char* const end : {"b", "c", "d"}) {
    scene.bars.push_back({{"a", end}, 1.0});
  }
  for (const char* const node : {"c", "d"}) request.program[0].support_motions.push_back({node, 0.0, -down});
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0}};
  scene.contacts = {{"b", "floor"}};
  return request;
}

std::string MessageOf(const TraceRequest& request) { return TraceIncrements(request).result.message; }

TEST(Remarks, NameNodesThatHaveGoneIntoObstacles) {
  const std::string end = "the program was traced to its end",
                    inside = end + "; nodes that are no candidates have gone into obstacles: ";
  EXPECT_EQ(MessageOf(Lowered(0.5)), end);
  EXPECT_EQ(MessageOf(Lowered(1.25)), inside + "c into floor by 0.25, d into floor by 0.15");
  // An obstacle that comes to them; in a later stage it is where it was left.
  TraceRequest lifted = Lowered(0.5);
  lifted.program.push_back({"lift", {}, {}, {{"floor", 0.0, 1.0}}, 0.0});
  lifted.program.push_back({"let go", {}, {{"c", 0.0, 0.25}}, {}, 0.0});
  EXPECT_EQ(MessageOf(lifted), inside + "d into floor by 0.4, c into floor by 0.25");
  // In the obstacle from the start on.
  TraceRequest buried = Lowered(0.5);
  for (const std::size_t i : {2U, 3U}) buried.scene.nodes[i].y = -1.0;
  EXPECT_EQ(MessageOf(buried), end);
  // On the side of the wall where nothing is.
  TraceRequest round = Lowered(1.25);
  round.scene.obstacles[0].shape = ObstacleShape::kPolyline;
  round.scene.obstacles[0].points = {-1.0, 0.0, 0.5, 0.0};
  EXPECT_EQ(MessageOf(round), end);
}

// A hook that is pushed over a rib, whose points are listed in the wrong sense.
TEST(Remarks, NameTheContactThatIsBehindItsBoundary) {
  const TraceRequest request = ReadTraceRequest(R"(
scene:
  nodes: [{name: root, x: 0, y: 0, fixed_x: true, fixed_y: true, fixed_rotation: true}, {name: tip, x: 20, y: 0}, {name: nose, x: 20, y: -2}]
  beams:
  - {name: arm, nodes: [root, tip], EA: 43200.0, EI: 14400.0, segments: 16}
  - {name: nib, nodes: [tip, nose], EA: 432000.0, EI: 144000.0, segments: 1}
  obstacles: [{name: rib, shape: polyline, points: [27.5, -2.5, 26, -0.5, 25, -0.5, 21, -2.5], fillet: 0.2, friction: 0.3}]
  contacts: [{node: nose, obstacle: rib}]
program: [{name: push in, support_motions: [{node: root, dx: 9.0}]}]
)",
                                                "");
  const std::string message = MessageOf(request);
  EXPECT_NE(message.find("contact nose@rib: the node has come past an end of the obstacle to "), std::string::npos)
      << message;
}

}  // namespace
}  // namespace contact_path::end_test
