#include "contact_path/scene/validate.h"

#include <gtest/gtest.h>

#include <ctime>
#include <limits>
#include <string>
#include <vector>

#include "support/broken_rule.h"

namespace contact_path::validate_test {
namespace {

// A pinned node a, a bar to b, a superelement from b to c, both on a floor; with something of every kind.
TraceRequest SoundRequest() {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.nodes = {{"a", 0.0, 5.0, true, true}, {"b", -5.0, 0.0}, {"c", -6.0, 0.0}};
  scene.bars = {{{"a", "b"}, 14.0}};
  scene.superelements = {{{"b", "c"},
                          {2.0, 0.0, -2.0, 0.0, 0.0, 1.0, 0.0, -1.0,  //
                           -2.0, 0.0, 2.0, 0.0, 0.0, -1.0, 0.0, 1.0}}};
  scene.loads = {{"b", 1.0, 0.0}, {"b", 0.0, -1.0, true}};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 2.0, 0.3}};
  scene.contacts = {{"b", "floor"}, {"c", "floor"}};
  request.options.stop = {{"b.x", ">", 4.95}, {"load_factor", "<", -2.0}, {"c.y", "<", -1.0}};
  return request;
}

const std::string kQuantity = "must be a quantity, as load_factor, <node>.x, <contact>.rn, <obstacle>.ry or <beam>.1.M";
const std::string kNoLoad = "a load that is not constant must act";

const BrokenRule kRules[] = {
    {[](auto& r) { r = TraceRequest(); }, "scene.nodes", "[]", "at least one node is needed"},
    {"scene.name", "\xff", "must be UTF-8"},
    {[](auto& r) { r.scene.nodes.push_back(r.scene.nodes[1]); }, "scene.nodes[3].name", "b", "must be unique"},
    {"scene.nodes[0].x", ".nan", "must be finite"},
    {"scene.nodes[2].y", "-.inf", "must be finite"},
    {"scene.nodes[0].x", "-1.0000001e+100", "must not exceed 1e+100"},
    {[](auto& r) {
       r.scene.nodes.push_back({"d", 0.0, 0.0, true, false});
     },
     "scene.nodes[3]", "d", "a node that is free to move must belong"},
    {[](auto& r) {
       r.scene.nodes.push_back({"d", 0.0, 0.0, false, true});
     },
     "scene.nodes[3]", "d", "a node that is free to move must belong"},
    {[](auto& r) {
       for (Node& node : r.scene.nodes) node.fixed_x = node.fixed_y = true;
       r.scene.contacts.clear();
     },
     "scene.nodes", "all fixed", "at least one component of a node must be free"},
    {[](auto& r) { r.scene.bars.clear(), r.scene.superelements.clear(); }, "scene.bars", "[]",
     "at least one bar, superelement, beam, solid, tendon or pin"},
    {[](auto& r) { r.scene.bars[0].nodes = {"b"}; }, "scene.bars[0].nodes", "[b]", "must name two"},
    {[](auto& r) {
       r.scene.bars[0].nodes = {"a", "b", "c"};
     },
     "scene.bars[0].nodes", "[a, b, c]", "must name two nodes"},
    {"scene.bars[0].nodes[0]", "zz", "must name a node"},
    {"scene.bars[0].nodes[1]", "\"\"", "must name a node"},
    {[](auto& r) { r.scene.bars[0].nodes[0] = "b"; }, "scene.bars[0].nodes", "[b, b]", "must name two different nodes"},
    {[](auto& r) { r.scene.nodes[0].x = -5.0, r.scene.nodes[0].y = 0.0; }, "scene.bars[0].nodes", "[a, b]",
     "the two nodes must not be at the same point"},
    {[](auto& r) {
       r.scene.nodes[0].x = -5.0, r.scene.nodes[0].y = 0.0;
       r.scene.bars[0].rest_length = 1.0, r.scene.bars[0].strain = StrainMeasure::kGreenLagrange;
     },
     "scene.bars[0].nodes", "[a, b]", "the two nodes must not be at the same point"},
    {"scene.bars[0].EA", "0", "must be > 0"},
    {"scene.bars[0].EA", "-0.1", "must be > 0"},
    {"scene.bars[0].EA", "1e-200", "must be > 0"},
    {"scene.bars[0].EA", ".inf", "must be finite"},
    {"scene.bars[0].EA", "1e+101", "must not exceed"},
    {"scene.bars[0].rest_length", "-7", "must be 0 or positive"},
    {"scene.bars[0].rest_length", "1e-300", "must be 0 or positive"},
    {"scene.bars[0].rest_length", ".nan", "must be finite"},
    {[](auto& r) { r.scene.superelements.push_back({}); }, "scene.superelements[1].nodes", "[]",
     "at least one node is needed"},
    {"scene.superelements[0].nodes[1]", "zz", "must name a node"},
    {[](auto& r) {
       r.scene.superelements.push_back({{"b", "b"}, {}});
       r.scene.superelements[1].stiffness = r.scene.superelements[0].stiffness;
     },
     "scene.superelements[1].nodes[1]", "b", "must not be repeated"},
    {[](auto& r) { r.scene.superelements[0].stiffness.pop_back(); }, "scene.superelements[0].stiffness", "15 entries",
     "must have 16 entries: 4 rows of 4"},
    {[](auto& r) { r.scene.superelements[0].stiffness.push_back(0.0); }, "scene.superelements[0].stiffness",
     "17 entries", "must have 16 entries: 4 rows of 4"},
    {"scene.superelements[0].stiffness[3]", ".nan", "must be finite"},
    {[](auto& r) { r.scene.superelements[0].stiffness.assign(16, 0.0); }, "scene.superelements[0].stiffness", "all 0",
     "must not be zero"},
    // The bound is relative to the largest entry, 2.
    {[](auto& r) { r.scene.superelements[0].stiffness[8] += 2.1e-9; }, "scene.superelements[0].stiffness[8]",
     "-1.9999999979", "the matrix must be symmetric, but entry [2] is -2"},
    {[](auto& r) { r.scene.superelements[0].stiffness[8] = r.scene.superelements[0].stiffness[13] = 1.0; },
     "scene.superelements[0].stiffness[8]", "1", "the matrix must be symmetric, but entry [2] is -2"},
    {"scene.loads[1].node", "zz", "must name a node"},
    {"scene.loads[0].fx", ".inf", "must be finite"},
    {"scene.loads[0].fy", "1e+300", "must not exceed"},
    {[](auto& r) { r.scene.loads.clear(); }, "scene.loads", "[]", kNoLoad},
    {[](auto& r) { r.scene.loads[0].constant = true; }, "scene.loads", "no net force", kNoLoad},
    {[](auto& r) { r.scene.loads[0].fx = 0.0; }, "scene.loads", "no net force", kNoLoad},
    {[](auto& r) { r.scene.loads[0].fx = 1e-200; }, "scene.loads", "no net force", kNoLoad},
    {[](auto& r) { r.scene.loads[0].node = "a"; }, "scene.loads", "no net force", kNoLoad},
    {[](auto& r) { r.scene.nodes[1].fixed_x = true; }, "scene.loads", "no net force", kNoLoad},
    // 0.1 + 0.2 - 0.3 is not 0 in doubles.
    {[](auto& r) {
       r.scene.loads = {{"b", 0.1, 0.0}, {"b", 0.2, 0.0}, {"b", -0.3, 0.0}};
     },
     "scene.loads", "no net force", kNoLoad},
    {[](auto& r) { r.scene.obstacles[0].name = "", r.scene.contacts.clear(); }, "scene.obstacles[0].name", "\"\"",
     "must not be empty"},
    {[](auto& r) { r.scene.obstacles[0].name = "a@b", r.scene.contacts.clear(); }, "scene.obstacles[0].name", "a@b",
     "must not contain"},
    {[](auto& r) { r.scene.obstacles[0].name = "a\t", r.scene.contacts.clear(); }, "scene.obstacles[0].name", "a\t",
     "must not contain"},
    {[](auto& r) { r.scene.obstacles.push_back(r.scene.obstacles[0]); }, "scene.obstacles[1].name", "floor",
     "must be unique"},
    {"scene.obstacles[0].px", ".nan", "must be finite"},
    {"scene.obstacles[0].py", ".nan", "must be finite"},
    {"scene.obstacles[0].py", "1e+101", "must not exceed"},
    {"scene.obstacles[0].nx", ".nan", "must be finite"},
    {"scene.obstacles[0].ny", "1e+101", "must not exceed"},
    {[](auto& r) { r.scene.obstacles[0].ny = 0.0; }, "scene.obstacles[0].nx", "0",
     "the normal (nx, ny) must not be zero"},
    {"scene.obstacles[0].friction", "-0.3", "must be >= 0"},
    {"scene.obstacles[0].friction", ".inf", "must be finite"},
    {"scene.contacts[0].node", "zz", "must name a node"},
    {"scene.contacts[1].obstacle", "wall", "must name an obstacle"},
    {"scene.contacts[1].obstacle", "flor", "must name an obstacle of the scene; did you mean floor?"},
    {[](auto& r) { r.scene.contacts.push_back(r.scene.contacts[0]); }, "scene.contacts[2]", "b@floor",
     "must not be repeated"},
    {"scene.contacts[0].node", "a", "must be free to move along the normal"},
    {[](auto& r) { r.scene.nodes[2].fixed_y = true; }, "scene.contacts[1].node", "c",
     "must be free to move along the normal"},
    {[](auto& r) { r.scene.nodes[2].fixed_y = true, r.scene.obstacles[0].nx = 1e-13; }, "scene.contacts[1].node", "c",
     "must be free to move along the normal"},
    // The normal is (0, 2): the penetration is a length.
    {[](auto& r) { r.scene.nodes[2].y = -0.25; }, "scene.contacts[1]", "c@floor",
     "initial position penetrates the obstacle by 0.25"},
    // L = 5 sqrt(2), so that up to 7.07e-9 is taken for rounding.
    {[](auto& r) { r.scene.nodes[2].y = -7.1e-9; }, "scene.contacts[1]", "c@floor",
     "initial position penetrates the obstacle by 7.1e-09"},
    {"options.direction", ".nan", "must be finite"},
    {"options.step", "-1", "must be >= 0"},
    {"options.step", ".inf", "must be finite"},
    {"options.max_increments", "-1", "must be >= 0"},
    {"options.full_state_every", "-2", "must be >= 0"},
    {"options.stop[0].quantity", "\"\"", kQuantity},
    {"options.stop[0].quantity", "b", kQuantity},
    {"options.stop[0].quantity", ".x", kQuantity},
    {"options.stop[0].quantity", "b.z", kQuantity},
    {"options.stop[0].quantity", "load_facto", kQuantity + "; did you mean load_factor?"},
    {"options.stop[0].quantity", "b.xx", kQuantity + "; did you mean b.x?"},
    {"options.stop[2].quantity", "zz.y", "must refer to a node"},
    {"options.stop[0].quantity", "B.x", "must refer to a node or an obstacle of the scene; did you mean b.x?"},
    {"options.stop[0].quantity", "rn_c@flor", "must refer to a contact of the scene; did you mean rn_c@floor?"},
    {"options.stop[0].quantity", "b.rn", "must refer to a contact of the scene"},
    {"options.stop[0].when", "\"\"", "must be \">\" or \"<\""},
    {"options.stop[1].when", ">=", "must be \">\" or \"<\""},
    {"options.stop[1].value", ".nan", "must be finite"},
    {"options.stop[0].quantity", "b.rx", "must refer to a component that a support holds"},
};

TEST(ValidateTest, BrokenRulesAreReportedAlone) {
  for (const BrokenRule& rule : kRules) ExpectBrokenAlone(rule, SoundRequest());
}

TEST(ValidateTest, NamesAreOfCharactersThatCanBeReferredTo) {
  const std::pair<const char*, const char*> names[] = {{"", "must not be empty"},     {"a b", "must not contain"},
                                                       {"a\x7f", "must not contain"}, {"a\n", "must not contain"},
                                                       {"a@", "must not contain"},    {",", "must not contain"},
                                                       {"\"a", "must not contain"},   {"a.1", "must not contain"},
                                                       {"a/1", "must not contain"},   {"m\xfchle", "must be UTF-8"}};
  for (const auto& [name, rule] : names) {
    const auto rename = [name = name](auto& r) { r.scene.nodes[0].name = r.scene.bars[0].nodes[0] = name; };
    ExpectBrokenAlone({rename, "scene.nodes[0].name", *name == 0 ? "\"\"" : name, rule}, SoundRequest());
  }
}

TEST(ValidateTest, BrokenRulesOfChoicesSamplesAndRecordsAreReportedAlone) {
  TraceRequest request = SoundRequest();
  request.options.max_increments = 10;
  request.options.branch_choices = {{1, 0, 2}, {2, 0, 2}};
  request.options.at = {{"b.y", {1.0, 2.0}}, {"b.y", {}, 0.0, 1.0, 3}};
  request.options.record = {"sections", "stresses"};
  const BrokenRule rules[] = {
      {"options.branch_choices[1].event", "-1", "must be >= 0"},
      {"options.branch_choices[0].branch", "-2", "must be >= 0"},
      {[](auto& r) { r.options.branch_choices[0].event = 0, r.options.branch_choices[0].increment = -1; },
       "options.branch_choices[0].increment", "-1", "must be >= 0"},
      {"options.branch_choices[0].increment", "5", "must be 0 where event is given"},
      {"options.at[0].quantity", "zz.y", "must refer to a node"},
      {[](auto& r) { r.options.at[0].values.clear(); }, "options.at[0]", "b.y",
       "must have values, or else from, to and count"},
      {[](auto& r) { r.options.at[1].values = {1.0}; }, "options.at[1]", "b.y",
       "must have values, or else from, to and count"},
      {"options.at[0].values[1]", ".nan", "must be finite"},
      {"options.at[1].count", "-3", "must be >= 0"},
      {"options.at[1].count", "11", "must be at most max_increments"},
      {"options.record[1]", "strains", "must be sections, stresses, pressures or inner"},
  };
  for (const BrokenRule& rule : rules) ExpectBrokenAlone(rule, request);
}

TEST(ValidateOptionsTest, MpecTakesNoneOfWhatNeedsLocatedEvents) {
  struct Case {
    std::function<void(TraceOptions&)> set;
    std::string line;
  };
  const Case cases[] = {
      {[](TraceOptions& options) {
         options.branch_choices = {{1, 0, 2}};
       },
       "options.branch_choices: must be empty with method mpec, which does not find the branches of an event"},
      {[](TraceOptions& options) {
         options.at = {{"b.y", {1.0}}};
       },
       "options.at: must be empty with method mpec, which does not locate values"},
      {[](TraceOptions& options) { options.at_limit = AtLimit::kJump; },
       "options.at_limit = jump: must be follow with method mpec, which does not locate limit points"},
      {[](TraceOptions& options) { options.friction_law = FrictionLaw::kTotal; },
       "options.friction_law = total: must be incremental with method mpec"}};
  for (const Case& of : cases) {
    TraceRequest request = SoundRequest();
    of.set(request.options);
    EXPECT_TRUE(Validate(request).empty()) << of.line;
    request.options.method = Method::kMpec;
    const std::vector<Violation> violations = Validate(request);
    ASSERT_EQ(violations.size(), 1U) << of.line;
    EXPECT_EQ(violations[0].ToLine(), of.line);
  }
}

TEST(ValidateOptionsTest, MachinesMayBeRigid) {
  TraceRequest request = SoundRequest();
  request.options.machine_stiffness = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(Validate(request).empty());
  for (const double wrong : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
    request.options.machine_stiffness = wrong;
    const std::vector<Violation> violations = Validate(request);
    ASSERT_EQ(violations.size(), 1U);
    EXPECT_EQ(violations[0].key, "options.machine_stiffness");
  }
}

// What looks odd but breaks no rule.
struct SoundVariant {
  std::string name;
  std::function<void(TraceRequest&)> change;
};

const SoundVariant kSoundVariants[] = {
    {"AsItIs", [](auto&) {}},
    {"AnySceneName", [](auto& r) { r.scene.name = "two words, \"quoted\"\n"; }},
    {"LettersBeyondAscii",
     [](auto& r) { r.scene.obstacles.push_back(r.scene.obstacles[0]), r.scene.obstacles[1].name = "\xc3\xa9"; }},
    {"SameNameForNodeAndObstacle",
     [](auto& r) { r.scene.obstacles.push_back(r.scene.obstacles[0]), r.scene.obstacles[1].name = "b"; }},
    {"FixedNodeWithoutElement",
     [](auto& r) { r.scene.nodes.push_back(r.scene.nodes[0]), r.scene.nodes[3].name = "d"; }},
    {"LargestNumbers", [](auto& r) { r.scene.bars[0].EA = 1e100, r.scene.obstacles[0].ny = 1e100; }},
    {"SmallestStiffness", [](auto& r) { r.scene.bars[0].EA = 1e-100; }},
    {"RestLength", [](auto& r) { r.scene.bars[0].rest_length = 3.0; }},
    {"MatrixSymmetricButForRounding", [](auto& r) { r.scene.superelements[0].stiffness[8] += 1.9e-9; }},
    {"WithoutBars", [](auto& r) { r.scene.bars.clear(); }},
    {"FrictionlessContact", [](auto& r) { r.scene.obstacles[0].friction = 0.0; }},
    {"NoContacts", [](auto& r) { r.scene.obstacles.clear(), r.scene.contacts.clear(); }},
    {"GapOpen", [](auto& r) { r.scene.nodes[2].y = 3.0; }},
    {"PenetrationByRounding", [](auto& r) { r.scene.nodes[2].y = -7.0e-9; }},
    {"InclinedContactOfGuidedNode", [](auto& r) { r.scene.nodes[2].fixed_y = true, r.scene.obstacles[0].nx = -0.1; }},
    {"LoadsCancelInOneComponent",
     [](auto& r) { r.scene.loads.push_back(r.scene.loads[0]), r.scene.loads[2].fx = -1.0, r.scene.loads[2].fy = 1.0; }},
    {"SmallLoadBesideLargeOnFixedNode",
     [](auto& r) {
       r.scene.loads.push_back(r.scene.loads[0]), r.scene.loads[2] = Load{"a", 1e50};
     }},
    {"SlightlyInclinedContactOfGuidedNode",
     [](auto& r) { r.scene.nodes[2].fixed_y = true, r.scene.obstacles[0].nx = 1e-9; }},
    {"LoadsNearlyCancel",
     [](auto& r) {
       r.scene.loads.push_back({"b", -1.0 + 1e-9, 0.0});
     }},
    {"BranchChoices",
     [](auto& r) {
       r.options.branch_choices = {{1, 0, 2}, {0, 7, 0}, {}};
     }},
    {"NegativeDirection", [](auto& r) { r.options.direction = -1.0; }},
    {"Step", [](auto& r) { r.options.step = 0.01; }},
    {"NoStopCriterion", [](auto& r) { r.options.stop.clear(); }},
    {"StopAtContacts",
     [](auto& r) {
       r.options.stop = {{"b@floor.rn", ">", 1.0}, {"gap_c@floor", ">", 1.0}, {"x_b", "<", 1.0}};
     }},
    {"StopAtFixedNode", [](auto& r) { r.options.stop[0].quantity = "a.x"; }},
};
TEST(ValidateTest, SoundRequestsBreakNoRule) {
  for (const auto& [name, change] : kSoundVariants) {
    TraceRequest request = SoundRequest();
    change(request);
    for (const Violation& violation : Validate(request)) ADD_FAILURE() << name << ": " << violation.ToLine();
  }
}

TEST(ValidateOrderTest, ViolationsComeInTheOrderOfTheRequest) {
  TraceRequest request = SoundRequest();
  request.options.step = -1.0;
  request.options.stop[1].when = "";
  request.scene.nodes[1].x = kNaN;
  request.scene.bars[0].EA = -1.0;
  request.scene.superelements[0].stiffness.clear();
  request.scene.loads[0].node = "zz";
  request.scene.obstacles[0].friction = -1.0;
  request.scene.contacts[1].obstacle = "zz";
  std::vector<std::string> keys;
  for (const Violation& violation : Validate(request)) keys.push_back(violation.key);
  const std::vector<std::string> expected = {"scene.nodes[1].x",
                                             "scene.bars[0].EA",
                                             "scene.superelements[0].stiffness",
                                             "scene.loads[0].node",
                                             "scene.obstacles[0].friction",
                                             "scene.contacts[1].obstacle",
                                             "options.step",
                                             "options.stop[1].when"};
  EXPECT_EQ(keys, expected);
}

// Whatever is missing, nothing is thrown; only contacts, and with them obstacles, can be left out.
TEST(ValidateOrderTest, EveryRequestWithMissingListsIsJudged) {
  for (int missing = 0; missing < 64; ++missing) {
    TraceRequest request = SoundRequest();
    if ((missing & 1) != 0) request.scene.contacts.clear();
    if ((missing & 2) != 0) request.scene.obstacles.clear();
    if ((missing & 4) != 0) request.scene.nodes.clear();
    if ((missing & 8) != 0) request.scene.bars.clear();
    if ((missing & 16) != 0) request.scene.superelements.clear();
    if ((missing & 32) != 0) request.scene.loads.clear();
    std::vector<Violation> violations;
    EXPECT_NO_THROW(violations = Validate(request)) << missing;
    // Without the bar, the superelement still holds b and c.
    const bool is_sound = (missing & ~8) == 0 || (missing & ~8) == 1 || (missing & ~8) == 3;
    EXPECT_EQ(violations.empty(), is_sound) << missing;
  }
}

TEST(ValidateSizeTest, ReportsNoMoreThanAnybodyReads) {
  TraceRequest request = SoundRequest();
  Bar broken = request.scene.bars[0];
  broken.EA = -1.0;
  request.scene.bars.assign(1000, broken);
  const std::vector<Violation> violations = Validate(request);
  ASSERT_EQ(violations.size(), kMostViolations);
  EXPECT_EQ(violations[0].key, "scene.bars[0].EA");
  EXPECT_EQ(violations[99].key, "scene.bars[99].EA");
}

// Each motion is asked for all contacts, by an index: 10^10 comparisons would be seen here.
TEST(ValidateSizeTest, TakesTimeInProportionToTheRequest) {
  TraceRequest request = SoundRequest();
  constexpr int kMany = 100000;
  request.scene.loads.clear();
  request.options.stop.clear();
  request.scene.superelements.clear();
  request.scene.nodes.resize(2);
  request.scene.contacts.resize(1);
  Stage stage;
  stage.obstacle_motions = {{"floor", 1.0, 0.0}};
  request.program.assign(kMany, stage);
  for (int i = 0; i < kMany; ++i) {
    request.scene.obstacles.push_back({"o" + std::to_string(i), ObstacleShape::kHalfPlane, 0.0, -9.0, 0.0, 1.0, 0.3});
    request.scene.contacts.push_back({"b", "o" + std::to_string(i)});
  }
  const std::clock_t start = std::clock();
  EXPECT_TRUE(Validate(request).empty());
  EXPECT_LT(std::clock() - start, 5 * CLOCKS_PER_SEC);
}

TEST(Validate, NumbersAreShownAsShortAsExact) {
  const std::vector<std::pair<double, std::string>> shown = {
      {-0.1, "-0.1"}, {-0.1 - 0.2, "-0.30000000000000004"}, {-1.0 / 3.0, "-0.3333333333333333"}, {-5.0, "-5"}};
  for (const auto& [number, text] : shown) {
    TraceRequest request = SoundRequest();
    request.options.step = number;
    const std::vector<Violation> violations = Validate(request);
    ASSERT_EQ(violations.size(), 1U) << text;
    EXPECT_EQ(violations[0].value, text);
  }
}

}  // namespace
}  // namespace contact_path::validate_test
