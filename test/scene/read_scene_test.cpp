#include "contact_path/scene/read_scene.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "contact_path/scene/validate.h"
#include "scene/base_text.h"
#include "support/same_request.h"

namespace contact_path::read_scene_test {
namespace {

TraceRequest Base() {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.name = "base";
  scene.nodes = {{"a", 0.0, 5.0, true, true}, {"b", -5.0, 0.0}, {"c", -6.0, 0.0}};
  scene.bars = {{{"a", "b"}, 14.0, 7.0, StrainMeasure::kLogarithmic}};
  scene.superelements = {{{"b", "c"},
                          {2.0, 0.0, -2.0, 0.0, 0.0, 1.0, 0.0, -1.0,  //
                           -2.0, 0.0, 2.0, 0.0, 0.0, -1.0, 0.0, 1.0}}};
  scene.loads = {{"b", 1.5, 0.25}, {"b", 0.0, -1.0, true}};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 1.0, -0.5, 0.0, 2.0, 0.3}};
  scene.contacts = {{"b", "floor"}, {"c", "floor"}};
  TraceOptions& options = request.options;
  options.method = Method::kMpec;
  options.accuracy = Accuracy::kAccurate;
  options.direction = -1.0;
  options.step = 0.125;
  options.max_increments = 12;
  options.full_state_every = 5;
  options.stop = {{"b.x", ">", 4.95}};
  return request;
}

TEST(ReadSceneTest, TakesEveryKey) {
  EXPECT_EQ(FirstDifference(ReadTraceRequest(BaseWith({}), "file.yaml"), Base()), "");
}

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
  TraceRequest expected = Base();
  expected.options.method = Method::kBranch;
  expected.options.branch_choices = {{2, 0, 3}, {0, 7, 0}};
  EXPECT_EQ(FirstDifference(ReadTraceRequest(text, ""), expected), "");
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
  EXPECT_EQ(FirstDifference(ReadTraceRequestFile(path), Base()), "");
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

}  // namespace
}  // namespace contact_path::read_scene_test
