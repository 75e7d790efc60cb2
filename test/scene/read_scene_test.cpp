#include "contact_path/scene/read_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "contact_path/scene/validate.h"
#include "support/broken_rule.h"

namespace contact_path::read_scene_test {
namespace {

// A request with every key. Tests name its lines by the number, from 1.
const std::vector<std::string> kLines = {
    "scene:",                                                       // 1
    "  name: base",                                                 // 2
    "  nodes:",                                                     // 3
    "  - {name: a, x: 0.0, y: 5.0, fixed_x: true, fixed_y: true}",  // 4
    "  - name: b",                                                  // 5
    "    x: -5.0",                                                  // 6
    "    y: 0",                                                     // 7
    "    fixed_x: false",                                           // 8
    "    fixed_y: 0",                                               // 9
    "  - {name: c, x: -6.0, y: 0.0}",                               // 10
    "  bars:",                                                      // 11
    "  - nodes: [a, b]",                                            // 12
    "    EA: 14.0",                                                 // 13
    "    rest_length: 7.0",                                         // 14
    "    strain: logarithmic",                                      // 15
    "  superelements:",                                             // 16
    "  - nodes: [b,",                                               // 17
    "            c]",                                               // 18
    "    stiffness: [2.0, 0.0, -2.0, 0.0,",                         // 19
    "                0.0, 1.0, 0.0, -1.0,",                         // 20
    "                -2.0, 0.0, 2.0, 0.0,",                         // 21
    "                0.0, -1.0, 0.0, 1.0]",                         // 22
    "  loads:",                                                     // 23
    "  - node: b",                                                  // 24
    "    fx: 1.5",                                                  // 25
    "    fy: 0.25",                                                 // 26
    "    constant: false",                                          // 27
    "  - {node: b, fy: -1.0, constant: true}",                      // 28
    "  obstacles:",                                                 // 29
    "  - name: floor",                                              // 30
    "    shape: half_plane",                                        // 31
    "    px: 1.0",                                                  // 32
    "    py: -0.5",                                                 // 33
    "    nx: 0.0",                                                  // 34
    "    ny: 2.0",                                                  // 35
    "    friction: 0.3",                                            // 36
    "  contacts:",                                                  // 37
    "  - node: b",                                                  // 38
    "    obstacle: floor",                                          // 39
    "  - {node: c, obstacle: floor}",                               // 40
    "options:",                                                     // 41
    "  method: mpec",                                               // 42
    "  accuracy: accurate",                                         // 43
    "  direction: -1.0",                                            // 44
    "  step: 0.125",                                                // 45
    "  max_increments: 12",                                         // 46
    "  stop:",                                                      // 47
    "  - quantity: b.x",                                            // 48
    "    when: \">\"",                                              // 49
    "    value: 4.95",                                              // 50
    "  full_state_every: 5",                                        // 51
};

// The base with some lines replaced, by number. Choices of branches want the method branch.
std::string BaseWith(std::map<std::size_t, std::string> replaced) {
  for (const auto& [number, line] : replaced)
    if (line.find("branch_choices") != line.npos) replaced.emplace(42, "  method: branch");
  std::string text;
  for (std::size_t i = 0; i < kLines.size(); ++i) {
    const auto other = replaced.find(i + 1);
    text += (other == replaced.end() ? kLines[i] : other->second) + "\n";
  }
  return text;
}

std::vector<Violation> ViolationsOf(const std::string& text) {
  try {
    ReadTraceRequest(text, "file.yaml");
  } catch (const InvalidRequest& error) {
    return error.violations();
  }
  return {};
}

void ExpectBase(const TraceRequest& request) {
  const Scene& scene = request.scene;
  EXPECT_EQ(scene.name, "base");
  ASSERT_EQ(scene.nodes.size(), 3U);
  EXPECT_EQ(scene.nodes[0].name, "a");
  EXPECT_EQ(scene.nodes[0].y, 5.0);
  EXPECT_TRUE(scene.nodes[0].fixed_x);
  EXPECT_TRUE(scene.nodes[0].fixed_y);
  EXPECT_EQ(scene.nodes[1].x, -5.0);
  EXPECT_FALSE(scene.nodes[1].fixed_x);
  EXPECT_FALSE(scene.nodes[1].fixed_y);
  ASSERT_EQ(scene.bars.size(), 1U);
  EXPECT_EQ(scene.bars[0].nodes, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(scene.bars[0].EA, 14.0);
  EXPECT_EQ(scene.bars[0].rest_length, 7.0);
  EXPECT_EQ(scene.bars[0].strain, StrainMeasure::kLogarithmic);
  ASSERT_EQ(scene.superelements.size(), 1U);
  EXPECT_EQ(scene.superelements[0].nodes, (std::vector<std::string>{"b", "c"}));
  ASSERT_EQ(scene.superelements[0].stiffness.size(), 16U);
  EXPECT_EQ(scene.superelements[0].stiffness[7], -1.0);
  ASSERT_EQ(scene.loads.size(), 2U);
  EXPECT_EQ(scene.loads[0].node, "b");
  EXPECT_EQ(scene.loads[0].fx, 1.5);
  EXPECT_EQ(scene.loads[0].fy, 0.25);
  EXPECT_FALSE(scene.loads[0].constant);
  EXPECT_TRUE(scene.loads[1].constant);
  ASSERT_EQ(scene.obstacles.size(), 1U);
  EXPECT_EQ(scene.obstacles[0].name, "floor");
  EXPECT_EQ(scene.obstacles[0].px, 1.0);
  EXPECT_EQ(scene.obstacles[0].py, -0.5);
  EXPECT_EQ(scene.obstacles[0].nx, 0.0);
  EXPECT_EQ(scene.obstacles[0].ny, 2.0);
  EXPECT_EQ(scene.obstacles[0].friction, 0.3);
  ASSERT_EQ(scene.contacts.size(), 2U);
  EXPECT_EQ(scene.contacts[1].Name(), "c@floor");
  const TraceOptions& options = request.options;
  EXPECT_EQ(options.method, Method::kMpec);
  EXPECT_EQ(options.accuracy, Accuracy::kAccurate);
  EXPECT_EQ(options.direction, -1.0);
  EXPECT_EQ(options.step, 0.125);
  EXPECT_EQ(options.max_increments, 12);
  EXPECT_EQ(options.full_state_every, 5);
  ASSERT_EQ(options.stop.size(), 1U);
  EXPECT_EQ(options.stop[0].quantity, "b.x");
  EXPECT_EQ(options.stop[0].when, ">");
  EXPECT_EQ(options.stop[0].value, 4.95);
}

TEST(ReadSceneTest, TakesEveryKey) { ExpectBase(ReadTraceRequest(BaseWith({}), "file.yaml")); }

TEST(ReadSceneTest, MissingAndNullKeysHaveTheirDefaults) {
  const std::vector<std::string> texts = {
      "scene: {nodes: [{name: a, fixed_x: yes, fixed_y: on}, {name: b, y: 1}], bars: [{nodes: [a, b], EA: 1}],\n"
      "        loads: [{node: b, fx: 1}]}\n",
      "scene:\n  name:\n  nodes: [{name: a, x: ~, fixed_x: yes, fixed_y: on}, {name: b, y: 1, fixed_x: null}]\n"
      "  bars: [{nodes: [a, b], EA: 1, rest_length: , strain: null}]\n  superelements:\n"
      "  loads: [{node: b, fx: 1, fy: Null, constant: ~}]\n  obstacles: ~\n  contacts: null\n"
      "options: {method: , accuracy: '', direction: ~, step: NULL, max_increments: ~, stop: ~}\n",
      "scene: {nodes: [{name: a, fixed_x: yes, fixed_y: on}, {name: b, y: 1}], bars: [{nodes: [a, b], EA: 1}],\n"
      "        loads: [{node: b, fx: 1}]}\noptions:\n"};
  for (const std::string& text : texts) {
    const TraceRequest request = ReadTraceRequest(text, "");
    EXPECT_EQ(request.scene.name, "");
    EXPECT_EQ(request.scene.nodes[0].x, 0.0);
    EXPECT_FALSE(request.scene.nodes[1].fixed_x);
    EXPECT_EQ(request.scene.bars[0].rest_length, 0.0);
    EXPECT_EQ(request.scene.bars[0].strain, StrainMeasure::kBiot);
    EXPECT_EQ(request.scene.loads[0].fy, 0.0);
    EXPECT_FALSE(request.scene.loads[0].constant);
    EXPECT_TRUE(request.scene.contacts.empty());
    EXPECT_EQ(request.options.method, Method::kBranch);
    EXPECT_EQ(request.options.accuracy, Accuracy::kBalanced);
    EXPECT_EQ(request.options.max_increments, 0);
    EXPECT_TRUE(request.options.stop.empty());
  }
}

// Line `replaced` of the base becomes `by`; out comes one violation.
struct BadLine {
  std::string name;
  std::size_t replaced;
  std::string by;
  std::string key;
  int line;
  std::string value;
  std::string rule;  // the start of it
};

class BadLineTest : public testing::TestWithParam<BadLine> {};

TEST_P(BadLineTest, IsReportedAloneWithItsLine) {
  const BadLine& bad = GetParam();
  const std::vector<Violation> violations = ViolationsOf(BaseWith({{bad.replaced, bad.by}}));
  ASSERT_FALSE(violations.empty());
  EXPECT_EQ(violations[0].key, bad.key);
  EXPECT_EQ(violations[0].line, bad.line);
  EXPECT_EQ(violations[0].value, bad.value);
  EXPECT_EQ(violations[0].rule.substr(0, bad.rule.size()), bad.rule);
  EXPECT_EQ(violations[0].file, "file.yaml");
  for (std::size_t i = 1; i < violations.size(); ++i) ADD_FAILURE() << "also: " << violations[i].ToLine();
}

const BadLine kUnknownAndRepeatedKeys[] = {
    {"UnknownAtTop", 41, "surprise: 1\noptions:", "surprise", 41, "1",
     "unknown key, must be one of: scene, options, program"},
    {"UnknownInNode", 9, "    fixed: true", "scene.nodes[1].fixed", 9, "true", "unknown key"},
    {"UnknownInFlowNode", 10, "  - {name: c, x: -6.0, z: {}}", "scene.nodes[2].z", 10, "a map", "unknown key"},
    {"UnknownInSuperelement", 16, "  superelements:\n  - {size: 1, nodes: [b], stiffness: [1, 0, 0, 1]}",
     "scene.superelements[0].size", 17, "1", "unknown key"},
    {"UnknownInStop", 50, "    value: 4.95\n    unit: mm", "options.stop[0].unit", 51, "mm", "unknown key"},
    {"UnknownInBranchChoice", 47, "  branch_choices:\n  - {at: 1, branch: 2}\n  stop:", "options.branch_choices[0].at",
     48, "1", "unknown key, must be one of: event, increment, branch"},
    {"KeysAreCaseSensitive", 45, "  Step: 1.0", "options.Step", 45, "1.0", "unknown key"},
    {"KeyThatIsNoText", 45, "  [1, 2]: 1.0", "options.a list", 45, "1.0", "unknown key"},
    {"KeyThatIsNull", 45, "  ~: 1.0", "options.null", 45, "1.0", "unknown key"},
    {"RepeatedAtTop", 41, "scene: {}\noptions:", "scene", 41, "a map", "repeated key, first in line 1"},
    {"RepeatedInNode", 8, "    x: 1.0", "scene.nodes[1].x", 8, "1.0", "repeated key, first in line 6"},
};
INSTANTIATE_TEST_SUITE_P(Keys, BadLineTest, testing::ValuesIn(kUnknownAndRepeatedKeys), NameOf<BadLine>);

const BadLine kWrongTypes[] = {
    {"TextForNumber", 6, "    x: five", "scene.nodes[1].x", 6, "five", "must be a number"},
    {"QuotedNumber", 6, "    x: \"5.0\"", "scene.nodes[1].x", 6, "\"5.0\"", "must be a number"},
    {"TaggedText", 6, "    x: !!str 5.0", "scene.nodes[1].x", 6, "\"5.0\"", "must be a number"},
    {"NumberWithUnit", 6, "    x: 5.0 mm", "scene.nodes[1].x", 6, "5.0 mm", "must be a number"},
    {"NumberWithComma", 6, "    x: 5,0", "scene.nodes[1].x", 6, "5,0", "must be a number"},
    {"TwoSigns", 6, "    x: +-5", "scene.nodes[1].x", 6, "+-5", "must be a number"},
    {"OnlySign", 6, "    x: +", "scene.nodes[1].x", 6, "+", "must be a number"},
    {"EmptyExponent", 6, "    x: 5e", "scene.nodes[1].x", 6, "5e", "must be a number"},
    {"OnlyPoint", 6, "    x: .", "scene.nodes[1].x", 6, ".", "must be a number"},
    {"TwoPoints", 6, "    x: 1.2.3", "scene.nodes[1].x", 6, "1.2.3", "must be a number"},
    {"Hexadecimal", 6, "    x: 0x10", "scene.nodes[1].x", 6, "0x10", "must be a number"},
    {"LeadingZero", 6, "    x: -010", "scene.nodes[1].x", 6, "-010", "must be a number"},
    {"ShortLeadingZero", 6, "    x: 07", "scene.nodes[1].x", 6, "07", "must be a number"},
    {"PlainInf", 6, "    x: inf", "scene.nodes[1].x", 6, "inf", "must be a number"},
    {"FlagForNumber", 6, "    x: true", "scene.nodes[1].x", 6, "true", "must be a number"},
    {"ListForNumber", 6, "    x: [1.0]", "scene.nodes[1].x", 6, "a list", "must be a number"},
    {"MapForNumber", 6, "    x:\n      y: 2.0", "scene.nodes[1].x", 6, "a map", "must be a number"},
    {"ListForText", 30, "  - name: [floor]", "scene.obstacles[0].name", 30, "a list", "must be text"},
    {"NumberForText", 2, "  name: 12", "scene.name", 2, "12", "must be text"},
    {"RealForText", 2, "  name: 1e3", "scene.name", 2, "1e3", "must be text"},
    {"FlagForText", 2, "  name: no", "scene.name", 2, "no", "must be text"},
    {"TextForFlag", 8, "    fixed_x: maybe", "scene.nodes[1].fixed_x", 8, "maybe", "must be true or false"},
    {"QuotedFlag", 8, "    fixed_x: 'true'", "scene.nodes[1].fixed_x", 8, "\"true\"", "must be true or false"},
    {"OtherNumberForFlag", 8, "    fixed_x: 2", "scene.nodes[1].fixed_x", 8, "2", "must be true or false"},
    {"RealForFlag", 8, "    fixed_x: 1.0", "scene.nodes[1].fixed_x", 8, "1.0", "must be true or false"},
    {"ListForFlag", 8, "    fixed_x: []", "scene.nodes[1].fixed_x", 8, "a list", "must be true or false"},
    {"RealForInteger", 46, "  max_increments: 12.0", "options.max_increments", 46, "12.0", "must be an integer"},
    {"ExponentForInteger", 46, "  max_increments: 1e3", "options.max_increments", 46, "1e3", "must be an integer"},
    {"IntegerTooLarge", 46, "  max_increments: 2147483648", "options.max_increments", 46, "2147483648",
     "must be an integer"},
    {"OctalForInteger", 46, "  max_increments: 012", "options.max_increments", 46, "012", "must be an integer"},
    {"QuotedInteger", 46, "  max_increments: '12'", "options.max_increments", 46, "\"12\"", "must be an integer"},
    {"UnknownMethod", 42, "  method: newton", "options.method", 42, "newton", "must be branch or mpec"},
    {"UnknownAccuracy", 43, "  accuracy: Fast", "options.accuracy", 43, "Fast", "must be fast, balanced or accurate"},
    {"UnknownStrain", 15, "    strain: cauchy", "scene.bars[0].strain", 15, "cauchy",
     "must be biot, green_lagrange or logarithmic"},
    {"UnknownShape", 31, "    shape: disc", "scene.obstacles[0].shape", 31, "disc",
     "must be half_plane, circle, polyline or spline"},
    {"ListForWord", 42, "  method: [mpec]", "options.method", 42, "a list", "must be branch or mpec"},
    {"RealForWay", 47, "  branch_choices:\n  - {event: 1, branch: 2.0}\n  stop:", "options.branch_choices[0].branch",
     48, "2.0", "must be an integer"},
    {"TextForList", 12, "  - nodes: a", "scene.bars[0].nodes", 12, "a", "must be a list"},
    {"MapForList", 12, "  - nodes: {a: b}", "scene.bars[0].nodes", 12, "a map", "must be a list"},
    {"NumberInListOfText", 12, "  - nodes: [1, b]", "scene.bars[0].nodes[0]", 12, "1", "must be text"},
    {"NullInListOfText", 18, "            ~]", "scene.superelements[0].nodes[1]", 18, "null", "must be text"},
    {"TextInListOfNumbers", 21, "                -2.0, 0.0, two, 0.0,", "scene.superelements[0].stiffness[10]", 21,
     "two", "must be a number"},
    {"NullInListOfNumbers", 21, "                -2.0, 0.0, ~, 0.0,", "scene.superelements[0].stiffness[10]", 21,
     "null", "must be a number"},
    {"RowsInListOfNumbers", 19, "    stiffness: [[2.0, 0.0], -2.0, 0.0,", "scene.superelements[0].stiffness[0]", 19,
     "a list", "must be a number"},
    {"TextForMap", 40, "  - c@floor", "scene.contacts[1]", 40, "c@floor", "must be a map with keys of: node, obstacle"},
    {"ListForMap", 40, "  - [c, floor]", "scene.contacts[1]", 40, "a list", "must be a map with keys of"},
};
INSTANTIATE_TEST_SUITE_P(Types, BadLineTest, testing::ValuesIn(kWrongTypes), NameOf<BadLine>);

// Rules of validate.h, broken in places whose lines are found in different ways.
const BadLine kRules[] = {
    {"MissingNodeName", 10, "  - {name: c, x: -6.0, y: 0.0}\n  - fixed_x: 1\n    fixed_y: 1", "scene.nodes[3].name", 11,
     "\"\"", "must not be empty"},
    {"RepeatedNodeName", 10, "  - {name: c, x: -6.0, y: 0.0}\n  - x: 1.0\n    name: c", "scene.nodes[3].name", 12, "c",
     "must be unique"},
    {"XNotFinite", 6, "    x: .nan", "scene.nodes[1].x", 6, ".nan", "must be finite"},
    {"XBeyondDouble", 6, "    x: -1e400", "scene.nodes[1].x", 6, "-.inf", "must be finite"},
    {"NodeNotHeld", 10, "  - {name: c, x: -6.0, y: 0.0}\n  -\n    name: d", "scene.nodes[3]", 12, "d",
     "a node that is free to move must belong"},
    {"BarFromUnknownNode", 12, "  - nodes: [zz, b]", "scene.bars[0].nodes[0]", 12, "zz", "must name a node"},
    {"EAMissing", 13, "", "scene.bars[0].EA", 12, "0", "must be > 0"},
    {"SuperelementWithRepeatedNode", 16,
     "  superelements:\n  - nodes:\n    - c\n    - c\n    stiffness: [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]",
     "scene.superelements[0].nodes[1]", 19, "c", "must not be repeated"},
    {"MatrixTooSmall", 22, "                0.0, -1.0, 0.0]", "scene.superelements[0].stiffness", 19, "15 entries",
     "must have 16 entries"},
    {"MatrixNotSymmetric", 21, "                -2.5, 0.0, 2.0, 0.0,", "scene.superelements[0].stiffness[8]", 21,
     "-2.5", "the matrix must be symmetric"},
    {"OnlyConstantLoads", 27, "    constant: true", "scene.loads", 23, "no net force",
     "a load that is not constant must act on a free component"},
    {"RepeatedObstacleName", 29, "  obstacles:\n  - {name: floor, ny: 1.0, py: -1.0}", "scene.obstacles[1].name", 31,
     "floor", "must be unique"},
    {"NormalMissing", 29, "  obstacles:\n  - name: wall", "scene.obstacles[0].nx", 30, "0",
     "the normal (nx, ny) must not be zero"},
    {"ContactWithoutObstacle", 39, "", "scene.contacts[0].obstacle", 38, "\"\"", "must name an obstacle"},
    {"EventAndIncrement", 47, "  branch_choices:\n  - event: 1\n    increment: 5\n  stop:",
     "options.branch_choices[0].increment", 49, "5", "must be 0 where event is given"},
    {"WhenMissing", 49, "", "options.stop[0].when", 48, "\"\"", "must be \">\" or \"<\""},
};
INSTANTIATE_TEST_SUITE_P(Rules, BadLineTest, testing::ValuesIn(kRules), NameOf<BadLine>);

// Rules on whole lists, and the line of the key of the list or of what encloses it.
TEST(ReadSceneTest, RulesOnListsHaveTheLineOfTheList) {
  const std::string bars = "  bars: [{nodes: [a, b], EA: 1}]\n";
  const std::string nodes = "  nodes:\n  - {name: a, fixed_x: 1, fixed_y: 1}\n  - {name: b, x: 1}\n";
  const std::string fixed =
      "  nodes:\n  - {name: a, fixed_x: 1, fixed_y: 1}\n  - {name: b, x: 1, fixed_x: 1, fixed_y: 1}\n";
  const std::string loads = "  loads: [{node: b, fx: 1}]\n";
  struct Case {
    std::string text, line;
  };
  const std::vector<Case> cases = {
      {"# empty\nscene:\n", "f:2: scene.nodes = []: at least one node is needed"},
      {"# empty\n\nscene: {}\n", "f:3: scene.nodes = []: at least one node is needed"},
      {"# empty\noptions:\n", "f:2: scene.nodes = []: at least one node is needed"},
      {"scene:\n  name: n\n\n  nodes: []\n", "f:4: scene.nodes = []: at least one node is needed"},
      {"scene:\n" + nodes + loads,
       "f:1: scene.bars = []: at least one bar, superelement, beam, solid, tendon or pin is needed"},
      {"scene:\n" + nodes + "  bars: []\n" + loads,
       "f:5: scene.bars = []: at least one bar, superelement, beam, solid, tendon or pin is needed"},
      {"scene:\n" + nodes + bars,
       "f:1: scene.loads = []: a load that is not constant must act on a free component, a support or an obstacle must "
       "move, or friction must change"},
      {"scene:\n" + fixed + bars + loads,
       "f:2: scene.nodes = all fixed: at least one component of a node must be free"},
      {"~", "f:1: scene.nodes = []: at least one node is needed"},
  };
  for (const Case& c : cases) {
    try {
      ReadTraceRequest(c.text, "f");
      ADD_FAILURE() << "accepted: " << c.text;
    } catch (const InvalidRequest& error) {
      EXPECT_EQ(error.what(), c.line);
      EXPECT_EQ(error.violations().size(), 1U) << c.text;
    }
  }
}

TEST(ReadSceneTest, PenetrationHasTheLineOfTheContact) {
  const std::vector<Violation> violations = ViolationsOf(BaseWith({{33, "    py: 0.125"}}));
  ASSERT_EQ(violations.size(), 2U);
  EXPECT_EQ(
      violations[0].ToLine(),
      "file.yaml:38: scene.contacts[0] = b@floor: initial position penetrates the obstacle by 0.125; its normal points "
      "to the side where nodes may be");
  EXPECT_EQ(
      violations[1].ToLine(),
      "file.yaml:40: scene.contacts[1] = c@floor: initial position penetrates the obstacle by 0.125; its normal points "
      "to the side where nodes may be");
}

TEST(ReadSceneTest, AllViolationsAreReported) {
  const std::vector<Violation> violations =
      ViolationsOf(BaseWith({{13, "    EA: -1.0"}, {26, "    gy: 1.0"}, {42, "  method: x"}, {45, "  step: -1.0"}}));
  std::vector<int> lines;
  for (const Violation& violation : violations) lines.push_back(violation.line);
  // The step is an option, as the word that could not be read is.
  EXPECT_EQ(lines, (std::vector<int>{13, 26, 42}));
  lines.clear();
  for (const Violation& violation :
       ViolationsOf(BaseWith({{13, "    EA: -1.0"}, {26, "    gy: 1.0"}, {45, "  step: -1.0"}})))
    lines.push_back(violation.line);
  EXPECT_EQ(lines, (std::vector<int>{13, 26, 45}));
}

// One fault is told once, and none because of another.
TEST(ReadSceneTest, FaultsOfAllKindsAreReportedTogether) {
  struct Case {
    std::string text;
    std::vector<std::string> lines;  // key = value
  };
  const std::string scene =
      "scene:\n"
      "  nodes: [{name: a, fixed_x: true, fixed_y: true}, {name: b, x: 2}, {name: 7, x: 2, y: 1}]\n"
      "  obstacles: [{name: floor, ny: 1, py: -1, friction: -0.5}]\n";
  const std::vector<Case> cases = {
      // A text that needs quotes can be referred to; a key that is misspelt, or a number that is none, breaks no rule.
      {scene + "  bars: [{nodes: [a, b], AE: 1}, {nodes: [b, \"7\"], EA: x}, {nodes: [a, c], EA: 1}]\n"
               "  loads: [{node: b, fx: 1}]\n  contacts: [{node: b, obstacle: flor}]\n",
       {"scene.nodes[2].name = 7", "scene.obstacles[0].friction = -0.5", "scene.bars[0].AE = 1", "scene.bars[1].EA = x",
        "scene.bars[2].nodes[1] = c", "scene.contacts[0].obstacle = flor"}},
      // What cannot be expanded is left out, as are the candidates that it would be.
      {"scene:\n  nodes: [{name: a, fixed_x: true, fixed_y: true}, {name: b, x: 2}]\n"
       "  beams: [{name: leg, nodes: [a, b], EA: -1, EI: 1}]\n"
       "  supports: [{group: lag, fixed_x: true}, {group: leg}]\n"
       "  loads: [{group: lge, fx: 1}, {node: leg/3, fx: 1}]\n"
       "  obstacles: [{name: floor, py: -1}]\n"
       "  contacts: [{group: foot, obstacle: floor}, {node: b, surface: top}]\n"
       "  support_motions: [{group: leg, dx: 1}]\n"
       "options: {step: -1, stop: [{quantity: b@floor.rn, when: \">\", value: 1}]}\n",
       {"scene.beams[0].EA = -1", "scene.supports[0].group = lag", "scene.supports[1] = leg",
        "scene.loads[0].group = lge", "scene.obstacles[0].nx = 0", "scene.contacts[0].group = foot",
        "scene.contacts[1].surface = top", "options.step = -1"}},
      // Without the nodes of the beam, or a list, numbers alone are judged.
      {"scene:\n  nodes: [{name: a}, {name: b, x: 2}]\n  beams: [{name: leg, nodes: [a, c], EA: 1, EI: 1}]\n"
       "  loads: [{node: leg/3, fx: .inf}]\noptions: {step: -1}\n",
       {"scene.beams[0].nodes[1] = c", "scene.loads[0].fx = .inf", "options.step = -1"}},
      {"scene:\n  nodes: 5\n  bars: [{nodes: [a, b], EA: -1}]\noptions: {max_increments: many, step: -1}\n",
       {"scene.nodes = 5", "scene.bars[0].EA = -1", "options.max_increments = many", "options.step = -1"}},
  };
  for (const Case& c : cases) {
    std::vector<std::string> lines;
    for (const Violation& violation : ViolationsOf(c.text)) {
      lines.push_back(violation.key + " = " + violation.value);
      EXPECT_FALSE(violation.rule.empty());
      EXPECT_GT(violation.line, 0);
    }
    EXPECT_EQ(lines, c.lines);
  }
}

TEST(ReadSceneTest, NumbersInTheSpellingsOfYaml) {
  const std::vector<std::pair<std::string, double>> numbers = {
      {"5", 5.0},   {"+5", 5.0},   {"-5", -5.0},    {"5.", 5.0},         {".5", 0.5},
      {"1e3", 1e3}, {"1E3", 1e3},  {"1.5e+2", 150}, {"-1.5e-2", -0.015}, {"0", 0.0},
      {"0.1", 0.1}, {"00.5", 0.5}, {"1e-400", 0.0}, {"!!float 3", 3.0},  {"14.142135623730951", 14.142135623730951}};
  for (const auto& [text, number] : numbers) {
    const TraceRequest request = ReadTraceRequest(BaseWith({{25, "    fx: " + text}}), "");
    EXPECT_EQ(request.scene.loads[0].fx, number) << text;
  }
}

TEST(ReadSceneTest, TruthValuesAndIntegersInTheSpellingsOfYaml) {
  for (const std::string text : {"true", "True", "TRUE", "yes", "on", "1"}) {
    EXPECT_TRUE(ReadTraceRequest(BaseWith({{8, "    fixed_x: " + text}}), "").scene.nodes[1].fixed_x) << text;
  }
  for (const std::string text : {"false", "False", "FALSE", "no", "off", "0"}) {
    EXPECT_FALSE(ReadTraceRequest(BaseWith({{8, "    fixed_x: " + text}}), "").scene.nodes[1].fixed_x) << text;
  }
  EXPECT_EQ(ReadTraceRequest(BaseWith({{46, "  max_increments: +5"}}), "").options.max_increments, 5);
  EXPECT_EQ(ReadTraceRequest(BaseWith({{46, "  max_increments: 2147483647"}}), "").options.max_increments, 2147483647);
}

TEST(ReadSceneTest, TakesBranchChoices) {
  const std::string text = BaseWith({{47, "  branch_choices: [{event: 2, branch: 3}, {increment: 7}]\n  stop:"}});
  const std::vector<BranchChoice> choices = ReadTraceRequest(text, "").options.branch_choices;
  ASSERT_EQ(choices.size(), 2U);
  EXPECT_EQ(choices[0].event, 2);
  EXPECT_EQ(choices[0].increment, 0);
  EXPECT_EQ(choices[0].branch, 3);
  EXPECT_EQ(choices[1].event, 0);
  EXPECT_EQ(choices[1].increment, 7);
  EXPECT_EQ(choices[1].branch, 0);
}

// A name of an earlier version is answered by the new one, a misspelt one by the nearest.
TEST(ReadSceneTest, NamesTheKeyOrWordThatWasMeant) {
  struct Case {
    std::size_t replaced;
    std::string by, line;
  };
  const std::vector<Case> cases = {
      {47, "  branch_choices: [{event: 1, way: 2}]\n  stop:",
       "file.yaml:47: options.branch_choices[0].way = 2: unknown key, is named branch now"},
      {47, "  branch_choices: [{row: 5}]\n  stop:",
       "file.yaml:47: options.branch_choices[0].row = 5: unknown key, is named increment now"},
      {14, "    restlength: 7.0",
       "file.yaml:14: scene.bars[0].restlength = 7.0: unknown key (did you mean rest_length?), must be one of: nodes, "
       "EA, "
       "rest_length, strain, sense, name"},
      {45, "  Step: 1.0",
       "file.yaml:45: options.Step = 1.0: unknown key (did you mean step?), must be one of: method, accuracy, "
       "direction, "
       "step, max_increments, full_state_every, stop, at, record, branch_rule, branch_cho..."},
      {43, "  accuracy: Fast",
       "file.yaml:43: options.accuracy = Fast: must be fast, balanced or accurate; did you mean fast?"},
      {39, "    obstacle: flor",
       "file.yaml:39: scene.contacts[0].obstacle = flor: must name an obstacle of the scene; did you mean floor?"},
      {48, "  - quantity: B.x",
       "file.yaml:48: options.stop[0].quantity = B.x: must refer to a node or an obstacle of the scene; did you mean "
       "b.x?"},
  };
  for (const Case& c : cases) {
    const std::vector<Violation> violations = ViolationsOf(BaseWith({{c.replaced, c.by}}));
    ASSERT_EQ(violations.size(), 1U) << c.by;
    EXPECT_EQ(violations[0].ToLine(), c.line);
  }
}

TEST(ReadSceneTest, QuotedWordsAreText) {
  EXPECT_EQ(ReadTraceRequest(BaseWith({{2, "  name: '12'"}}), "").scene.name, "12");
  EXPECT_EQ(ReadTraceRequest(BaseWith({{2, "  name: \"no\\nyes\""}}), "").scene.name, "no\nyes");
  EXPECT_EQ(ReadTraceRequest(BaseWith({{2, "  name: !!str 12"}}), "").scene.name, "12");
  EXPECT_EQ(ReadTraceRequest(BaseWith({{2, "  name: two words"}}), "").scene.name, "two words");
}

TEST(ReadSceneTest, AliasesStandForWhatTheyReferTo) {
  const TraceRequest request = ReadTraceRequest(BaseWith({{6, "    x: &place -5.0"},
                                                          {25, "    fx: *place"},
                                                          {38, "  - &contact\n    node: b"},
                                                          {40, "  - {node: c, obstacle: floor}"}}),
                                                "");
  EXPECT_EQ(request.scene.loads[0].fx, -5.0);
  // What stands behind an alias has the line of the alias.
  const std::vector<Violation> violations =
      ViolationsOf(BaseWith({{38, "  - &contact\n    node: b"}, {40, "  - *contact"}}));
  ASSERT_EQ(violations.size(), 1U);
  EXPECT_EQ(violations[0].ToLine(), "file.yaml:41: scene.contacts[1] = b@floor: must not be repeated");
}

// What is no request at all, and the line of the only violation, which has no key.
TEST(ReadSceneTest, RefusesWhatIsNotOneYamlDocument) {
  std::string laughs = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string last = "*a" + std::to_string(i - 1) + ", ";
    laughs += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [";
    for (int k = 0; k < 10; ++k) laughs += last;
    laughs += "]\n";
  }
  std::string many = "scene: [";
  for (int i = 0; i < 2'000'001; ++i) many += "1,";
  std::string tower = "a0: &a0 [1]\n";
  for (int i = 1; i < 100; ++i) {
    tower += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [*a" + std::to_string(i - 1) + "]\n";
  }
  std::string blocks;
  for (int i = 0; i < 100'000; ++i) blocks += "- ";
  struct Case {
    std::string name, text;
    int line;
    std::string rule;  // the start of it
  };
  const std::vector<Case> cases = {
      {"empty", "", 1, "must be a request in YAML, but is empty"},
      {"blank", " \n\n", 1, "must be a request in YAML, but is empty"},
      {"comment", "# nothing\n", 1, "must be a request in YAML, but is empty"},
      {"cut off", BaseWith({}).substr(0, 200) + "\n - {[", 0, "must be YAML: "},
      {"open bracket", "scene:\n  nodes: [\n", 0, "must be YAML: "},
      {"stray bracket", BaseWith({}) + "}\n", 52, "must be YAML: "},
      {"tab", "scene:\n\tname: a\n", 2, "must be YAML: "},
      {"unknown alias", "scene: {}\noptions: *a\n", 2, "must be YAML: "},
      {"alias in itself", "scene: {}\noptions: &a [*a]\n", 2, "an alias must not stand within what it refers to"},
      {"two documents", BaseWith({}) + "---\nscene: {}\n", 53, "must end after one YAML document"},
      {"end of transmission", "scene: {}\n\x04junk: 1\n", 2, "must be YAML, without control characters"},
      {"null character", std::string("scene: {}\n\0", 11), 2, "must be YAML, without control characters"},
      {"not Latin 1", "scene:\n  name: m\xfchle\n", 2, "must be UTF-8"},
      {"lone byte", "scene:\n  name: a\x80\n", 2, "must be UTF-8"},
      {"cut off", "scene: {}\n# \xe2\x82", 2, "must be UTF-8"},
      {"longer than needed", "scene: {}\n\n# \xc0\xaf\n", 3, "must be UTF-8"},
      {"surrogate", "scene: {}\n# \xed\xa0\x80\n", 2, "must be UTF-8"},
      {"beyond Unicode", "scene: {}\n# \xf4\x90\x80\x80\n", 2, "must be UTF-8"},
      {"deep", "scene:\n  " + std::string(100'000, '['), 2, "lists and maps must be at most 64 deep"},
      {"deep blocks", "scene:\n" + blocks, 2, "lists and maps must be at most 64 deep"},
      {"deep by aliases", tower, 64, "lists and maps must be at most 64 deep"},
      {"many by aliases", laughs, 0, "must have at most 2000000 values"},
      {"many", many, 0, "must have at most 2000000 values"},
      {"large", std::string((std::size_t{64} << 20U) + 1, '#'), 0, "must be at most 64 MiB long"},
  };
  for (const Case& c : cases) {
    const std::vector<Violation> violations = ViolationsOf(c.text);
    ASSERT_EQ(violations.size(), 1U) << c.name;
    EXPECT_EQ(violations[0].rule.substr(0, c.rule.size()), c.rule) << c.name;
    EXPECT_EQ(violations[0].file, "file.yaml") << c.name;
    if (c.line > 0) {
      EXPECT_EQ(violations[0].line, c.line) << c.name;
    }
  }
}

TEST(ReadSceneTest, TextForTheWholeIsAWrongType) {
  const std::vector<Violation> violations = ViolationsOf("# a list\n- scene\n");
  ASSERT_EQ(violations.size(), 1U);
  EXPECT_EQ(violations[0].ToLine(), "file.yaml:2: a list: must be a map with keys of: scene, options, program");
}

// No text may do anything but be read or be refused with InvalidRequest.
TEST(ReadSceneTest, DamagedTextsAreReadOrRefused) {
  const std::string base = BaseWith({});
  const std::string inserted = "[]{}:,-?&*!|>'\"%#~ \n\t0";
  int read = 0;
  int refused = 0;
  for (std::size_t at = 0; at < base.size(); ++at) {
    const std::string head = base.substr(0, at);
    const std::string tail = base.substr(at);
    std::vector<std::string> damaged = {head, head + tail.substr(1)};
    for (std::size_t i = 0; i < 3; ++i) damaged.push_back(head + inserted[(3 * at + i) % inserted.size()] + tail);
    for (const std::string& text : damaged) {
      try {
        ReadTraceRequest(text, "");
        ++read;
      } catch (const InvalidRequest& error) {
        ASSERT_FALSE(error.violations().empty());
        for (const Violation& violation : error.violations()) ASSERT_GT(violation.line, 0) << violation.ToLine();
        ++refused;
      }
    }
  }
  EXPECT_GT(read, 100);
  EXPECT_GT(refused, 100);
}

TEST(ReadSceneTest, ReadsAFile) {
  const std::string path = testing::TempDir() + "read_scene_test.yaml";
  std::ofstream(path) << BaseWith({});
  ExpectBase(ReadTraceRequestFile(path));
  std::ofstream(path) << BaseWith({{13, "    EA: -1.0"}});
  try {
    ReadTraceRequestFile(path);
    ADD_FAILURE() << "accepted";
  } catch (const InvalidRequest& error) {
    EXPECT_EQ(error.what(), path + ":13: scene.bars[0].EA = -1: must be > 0 (at least 1e-100)");
  }
  std::remove(path.c_str());
}

TEST(ReadSceneTest, RefusesWhatIsNoFile) {
  for (const std::string& path : {testing::TempDir() + "no/such/file.yaml", testing::TempDir()}) {
    try {
      ReadTraceRequestFile(path);
      ADD_FAILURE() << "accepted: " << path;
    } catch (const InvalidRequest& error) {
      ASSERT_EQ(error.violations().size(), 1U);
      EXPECT_EQ(error.violations()[0].file, path);
      EXPECT_EQ(error.violations()[0].line, 0);
      EXPECT_EQ(error.violations()[0].rule.substr(0, 14), "cannot be read");
    }
  }
}

// The scenes of this package lie beside the tests.
std::filesystem::path ScenesDirectory() {
  return std::filesystem::path(__FILE__).parent_path().parent_path().parent_path() / "scenes";
}

TEST(ScenesTest, AreSoundAndNamedAsTheirFiles) {
  std::size_t scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(ScenesDirectory())) {
    if (entry.path().extension() != ".yaml") continue;
    ++scenes;
    EXPECT_NO_THROW({
      const TraceRequest request = ReadTraceRequestFile(entry.path().string());
      EXPECT_EQ(request.scene.name, entry.path().stem().string());
      EXPECT_FALSE(request.options.stop.empty() && request.program.empty() &&
                   request.options.at_limit != AtLimit::kStop)
          << entry.path();
    }) << entry.path();
  }
  EXPECT_GE(scenes, 6U);
}

TEST(ScenesTest, ArchIsItsOwnMirrorImage) {
  const Scene scene = ReadTraceRequestFile((ScenesDirectory() / "arch19.yaml").string()).scene;
  ASSERT_EQ(scene.nodes.size(), 11U);
  ASSERT_EQ(scene.bars.size(), 19U);
  const double degree = std::acos(-1.0) / 180.0;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    const Node& mirrored = scene.nodes[scene.nodes.size() - 1 - i];
    EXPECT_EQ(node.x, -mirrored.x);  // exactly
    EXPECT_EQ(node.y, mirrored.y);
    // The strip goes from 60 to -60 degrees by 12, on radii 6 and 5 in turn; a, at 48 degrees, has y = 0.
    const double angle = (60.0 - 12.0 * static_cast<double>(i)) * degree;
    const double radius = i % 2 == 0 ? 6.0 : 5.0;
    EXPECT_NEAR(node.x, radius * std::sin(angle), 1e-15 * radius);
    EXPECT_NEAR(node.y, radius * std::cos(angle) - 5.0 * std::cos(48.0 * degree), 1e-15 * radius);
  }
  std::map<std::string, Node> nodes;
  for (const Node& node : scene.nodes) nodes[node.name] = node;
  EXPECT_EQ(nodes.at("f").y, scene.obstacles.at(0).py);  // in contact at the start, exactly
  for (const char* pair : {"ag", "bh", "di", "ej", "fk", "cc"}) {
    EXPECT_EQ(nodes.at(std::string(1, pair[0])).x, -nodes.at(std::string(1, pair[1])).x) << pair;
  }
}

}  // namespace
}  // namespace contact_path::read_scene_test
