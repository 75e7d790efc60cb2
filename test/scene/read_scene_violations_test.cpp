// What is wrong with a text, and in which line.
#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

#include "contact_path/scene/read_scene.h"
#include "contact_path/scene/validate.h"
#include "scene/base_text.h"

namespace contact_path::read_scene_violations_test {
namespace {

// Line `replaced` of the base becomes `by`; out comes one violation.
struct BadLine {
  std::size_t replaced;
  std::string by;
  std::string key;
  int line;
  std::string value;
  std::string rule;  // the start of it
};

void ExpectReportedAlone(const BadLine& bad) {
  SCOPED_TRACE(bad.by);
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
    {41, "surprise: 1\noptions:", "surprise", 41, "1", "unknown key, must be one of: scene, options, program"},
    {9, "    fixed: true", "scene.nodes[1].fixed", 9, "true", "unknown key"},
    {10, "  - {name: c, x: -6.0, z: {}}", "scene.nodes[2].z", 10, "a map", "unknown key"},
    {16, "  superelements:\n  - {size: 1, nodes: [b], stiffness: [1, 0, 0, 1]}", "scene.superelements[0].size", 17, "1",
     "unknown key"},
    {50, "    value: 4.95\n    unit: mm", "options.stop[0].unit", 51, "mm", "unknown key"},
    {47, "  branch_choices:\n  - {at: 1, branch: 2}\n  stop:", "options.branch_choices[0].at", 48, "1",
     "unknown key, must be one of: event, increment, branch"},
    {45, "  Step: 1.0", "options.Step", 45, "1.0", "unknown key"},
    {45, "  [1, 2]: 1.0", "options.a list", 45, "1.0", "unknown key"},
    {45, "  ~: 1.0", "options.null", 45, "1.0", "unknown key"},
    {41, "scene: {}\noptions:", "scene", 41, "a map", "repeated key, first in line 1"},
    {8, "    x: 1.0", "scene.nodes[1].x", 8, "1.0", "repeated key, first in line 6"},
};
TEST(ReadSceneViolations, UnknownAndRepeatedKeysAreReportedAlone) {
  for (const BadLine& bad : kUnknownAndRepeatedKeys) ExpectReportedAlone(bad);
}

// Values of the type that the field in a line does not have.
struct WrongType {
  std::size_t line;
  std::string before;  // the value
  std::string key;
  std::string rule;
  std::vector<std::string> values;
};
const WrongType kWrongValues[] = {
    {6,
     "    x: ",
     "scene.nodes[1].x",
     "must be a number",
     {"five", "\"5.0\"", "!!str 5.0", "5.0 mm", "5,0", "+-5", "+", "5e", ".", "1.2.3", "0x10", "-010", "07", "inf",
      "true", "[1.0]"}},
    {2, "  name: ", "scene.name", "must be text", {"12", "1e3", "no"}},
    {8, "    fixed_x: ", "scene.nodes[1].fixed_x", "must be true or false", {"maybe", "'true'", "2", "1.0", "[]"}},
    {46,
     "  max_increments: ",
     "options.max_increments",
     "must be an integer",
     {"12.0", "1e3", "2147483648", "012", "'12'"}},
    {42, "  method: ", "options.method", "must be branch or mpec", {"newton", "[mpec]"}},
    {43, "  accuracy: ", "options.accuracy", "must be fast, balanced or accurate", {"Fast"}},
    {15, "    strain: ", "scene.bars[0].strain", "must be biot, green_lagrange or logarithmic", {"cauchy"}},
    {31, "    shape: ", "scene.obstacles[0].shape", "must be half_plane, circle, polyline or spline", {"disc"}},
    {12, "  - nodes: ", "scene.bars[0].nodes", "must be a list", {"a", "{a: b}"}},
    {40, "  - ", "scene.contacts[1]", "must be a map with keys of: node, obstacle", {"c@floor", "[c, floor]"}},
};

// As messages show a value.
std::string Shown(const std::string& value) {
  if (value[0] == '[') return "a list";
  if (value[0] == '{') return "a map";
  if (value[0] == '\'') return '"' + value.substr(1, value.size() - 2) + '"';
  return value == "!!str 5.0" ? "\"5.0\"" : value;
}

const BadLine kWrongTypes[] = {
    {6, "    x:\n      y: 2.0", "scene.nodes[1].x", 6, "a map", "must be a number"},
    {30, "  - name: [floor]", "scene.obstacles[0].name", 30, "a list", "must be text"},
    {47, "  branch_choices:\n  - {event: 1, branch: 2.0}\n  stop:", "options.branch_choices[0].branch", 48, "2.0",
     "must be an integer"},
    {12, "  - nodes: [1, b]", "scene.bars[0].nodes[0]", 12, "1", "must be text"},
    {18, "            ~]", "scene.superelements[0].nodes[1]", 18, "null", "must be text"},
    {21, "                -2.0, 0.0, two, 0.0,", "scene.superelements[0].stiffness[10]", 21, "two", "must be a number"},
    {21, "                -2.0, 0.0, ~, 0.0,", "scene.superelements[0].stiffness[10]", 21, "null", "must be a number"},
    {19, "    stiffness: [[2.0, 0.0], -2.0, 0.0,", "scene.superelements[0].stiffness[0]", 19, "a list",
     "must be a number"},
};
TEST(ReadSceneViolations, WrongTypesAreReportedAlone) {
  for (const WrongType& of : kWrongValues)
    for (const std::string& value : of.values)
      ExpectReportedAlone({of.line, of.before + value, of.key, static_cast<int>(of.line), Shown(value), of.rule});
  for (const BadLine& bad : kWrongTypes) ExpectReportedAlone(bad);
}

// Rules of validate.h, broken in places whose lines are found in different ways.
const BadLine kRules[] = {
    {10, "  - {name: c, x: -6.0, y: 0.0}\n  - fixed_x: 1\n    fixed_y: 1", "scene.nodes[3].name", 11, "\"\"",
     "must not be empty"},
    {10, "  - {name: c, x: -6.0, y: 0.0}\n  - x: 1.0\n    name: c", "scene.nodes[3].name", 12, "c", "must be unique"},
    {6, "    x: .nan", "scene.nodes[1].x", 6, ".nan", "must be finite"},
    {6, "    x: -1e400", "scene.nodes[1].x", 6, "-.inf", "must be finite"},
    {10, "  - {name: c, x: -6.0, y: 0.0}\n  -\n    name: d", "scene.nodes[3]", 12, "d",
     "a node that is free to move must belong"},
    {12, "  - nodes: [zz, b]", "scene.bars[0].nodes[0]", 12, "zz", "must name a node"},
    {13, "", "scene.bars[0].EA", 12, "0", "must be > 0"},
    {16, "  superelements:\n  - nodes:\n    - c\n    - c\n    stiffness: [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]",
     "scene.superelements[0].nodes[1]", 19, "c", "must not be repeated"},
    {22, "                0.0, -1.0, 0.0]", "scene.superelements[0].stiffness", 19, "15 entries",
     "must have 16 entries"},
    {21, "                -2.5, 0.0, 2.0, 0.0,", "scene.superelements[0].stiffness[8]", 21, "-2.5",
     "the matrix must be symmetric"},
    {27, "    constant: true", "scene.loads", 23, "no net force",
     "a load that is not constant must act on a free component"},
    {29, "  obstacles:\n  - {name: floor, ny: 1.0, py: -1.0}", "scene.obstacles[1].name", 31, "floor",
     "must be unique"},
    {29, "  obstacles:\n  - name: wall", "scene.obstacles[0].nx", 30, "0", "the normal (nx, ny) must not be zero"},
    {39, "", "scene.contacts[0].obstacle", 38, "\"\"", "must name an obstacle"},
    {47, "  branch_choices:\n  - event: 1\n    increment: 5\n  stop:", "options.branch_choices[0].increment", 49, "5",
     "must be 0 where event is given"},
    {49, "", "options.stop[0].when", 48, "\"\"", "must be \">\" or \"<\""},
};
TEST(ReadSceneViolations, BrokenRulesAreReportedAlone) {
  for (const BadLine& bad : kRules) ExpectReportedAlone(bad);
}

// Rules on whole lists, and the line of the key of the list or of what encloses it.
TEST(ReadSceneViolations, RulesOnListsHaveTheLineOfTheList) {
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

TEST(ReadSceneViolations, PenetrationHasTheLineOfTheContact) {
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

TEST(ReadSceneViolations, AllViolationsAreReported) {
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
TEST(ReadSceneViolations, FaultsOfAllKindsAreReportedTogether) {
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

// A name of an earlier version is answered by the new one, a misspelt one by the nearest.
TEST(ReadSceneViolations, NamesTheKeyOrWordThatWasMeant) {
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

}  // namespace
}  // namespace contact_path::read_scene_violations_test
