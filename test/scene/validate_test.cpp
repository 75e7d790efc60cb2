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
  scene.nodes = {{"a", 0.0, 5.0, true, true}, {"b", -5.0, 0.0, false, false}, {"c", -6.0, 0.0, false, false}};
  scene.bars = {{{"a", "b"}, 14.0, 0.0, StrainMeasure::kBiot}};
  scene.superelements = {{{"b", "c"},
                          {2.0, 0.0, -2.0, 0.0, 0.0, 1.0, 0.0, -1.0,  //
                           -2.0, 0.0, 2.0, 0.0, 0.0, -1.0, 0.0, 1.0}}};
  scene.loads = {{"b", 1.0, 0.0, false}, {"b", 0.0, -1.0, true}};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 2.0, 0.3}};
  scene.contacts = {{"b", "floor"}, {"c", "floor"}};
  request.options.stop = {{"b.x", ">", 4.95}, {"load_factor", "<", -2.0}, {"c.y", "<", -1.0}};
  return request;
}

class ValidateTest : public testing::TestWithParam<BrokenRule> {};

TEST_P(ValidateTest, ReportsTheBrokenRuleAlone) { ExpectBrokenAlone(GetParam(), SoundRequest()); }

const BrokenRule kNodeRules[] = {
    {"NoNodes", [](auto& r) { r = TraceRequest(); }, "scene.nodes", "[]", "at least one node is needed"},
    {"EmptyNodeName", [](auto& r) { r.scene.nodes[0].name = r.scene.bars[0].nodes[0] = ""; }, "scene.nodes[0].name",
     "\"\"", "must not be empty"},
    {"SpaceInNodeName", [](auto& r) { r.scene.nodes[0].name = r.scene.bars[0].nodes[0] = "a b"; },
     "scene.nodes[0].name", "a b", "must not contain"},
    {"ControlInNodeName", [](auto& r) { r.scene.nodes[0].name = r.scene.bars[0].nodes[0] = "a\x7f"; },
     "scene.nodes[0].name", "a\x7f", "must not contain"},
    {"LineInNodeName", [](auto& r) { r.scene.nodes[0].name = r.scene.bars[0].nodes[0] = "a\n"; }, "scene.nodes[0].name",
     "a\n", "must not contain"},
    {"AtInNodeName", [](auto& r) { r.scene.nodes[0].name = r.scene.bars[0].nodes[0] = "a@"; }, "scene.nodes[0].name",
     "a@", "must not contain"},
    {"CommaInNodeName", [](auto& r) { r.scene.nodes[0].name = r.scene.bars[0].nodes[0] = ","; }, "scene.nodes[0].name",
     ",", "must not contain"},
    {"QuoteInNodeName", [](auto& r) { r.scene.nodes[0].name = r.scene.bars[0].nodes[0] = "\"a"; },
     "scene.nodes[0].name", "\"a", "must not contain"},
    {"PointInNodeName", [](auto& r) { r.scene.nodes[0].name = r.scene.bars[0].nodes[0] = "a.1"; },
     "scene.nodes[0].name", "a.1", "must not contain"},
    {"SlashInNodeName", [](auto& r) { r.scene.nodes[0].name = r.scene.bars[0].nodes[0] = "a/1"; },
     "scene.nodes[0].name", "a/1", "must not contain"},
    {"NodeNameNotUtf8", [](auto& r) { r.scene.nodes[0].name = r.scene.bars[0].nodes[0] = "m\xfchle"; },
     "scene.nodes[0].name", "m\xfchle", "must be UTF-8"},
    {"SceneNameNotUtf8", [](auto& r) { r.scene.name = "\xff"; }, "scene.name", "\xff", "must be UTF-8"},
    {"RepeatedNodeName", [](auto& r) { r.scene.nodes.push_back(r.scene.nodes[1]); }, "scene.nodes[3].name", "b",
     "must be unique"},
    {"XNotFinite", [](auto& r) { r.scene.nodes[0].x = kNaN; }, "scene.nodes[0].x", ".nan", "must be finite"},
    {"YNotFinite", [](auto& r) { r.scene.nodes[2].y = -kInfinity; }, "scene.nodes[2].y", "-.inf", "must be finite"},
    {"XTooLarge", [](auto& r) { r.scene.nodes[0].x = -1.0000001e100; }, "scene.nodes[0].x", "-1.0000001e+100",
     "must not exceed 1e+100"},
    {"NodeNotHeld",
     [](auto& r) {
       r.scene.nodes.push_back({"d", 0.0, 0.0, true, false});
     },
     "scene.nodes[3]", "d", "a node that is free to move must belong"},
    {"NodeNotHeldAlongX",
     [](auto& r) {
       r.scene.nodes.push_back({"d", 0.0, 0.0, false, true});
     },
     "scene.nodes[3]", "d", "a node that is free to move must belong"},
    {"NothingFree",
     [](auto& r) {
       for (Node& node : r.scene.nodes) node.fixed_x = node.fixed_y = true;
       r.scene.contacts.clear();
     },
     "scene.nodes", "all fixed", "at least one component of a node must be free"},
};
INSTANTIATE_TEST_SUITE_P(Nodes, ValidateTest, testing::ValuesIn(kNodeRules), NameOf<BrokenRule>);

const BrokenRule kElementRules[] = {
    {"NoElements", [](auto& r) { r.scene.bars.clear(), r.scene.superelements.clear(); }, "scene.bars", "[]",
     "at least one bar, superelement, beam, solid, tendon or pin"},
    {"BarOfOneNode", [](auto& r) { r.scene.bars[0].nodes = {"b"}; }, "scene.bars[0].nodes", "[b]", "must name two"},
    {"BarOfThreeNodes",
     [](auto& r) {
       r.scene.bars[0].nodes = {"a", "b", "c"};
     },
     "scene.bars[0].nodes", "[a, b, c]", "must name two nodes"},
    {"BarFromUnknownNode", [](auto& r) { r.scene.bars[0].nodes[0] = "zz"; }, "scene.bars[0].nodes[0]", "zz",
     "must name a node"},
    {"BarToEmptyName", [](auto& r) { r.scene.bars[0].nodes[1] = ""; }, "scene.bars[0].nodes[1]", "\"\"",
     "must name a node"},
    {"BarToItself", [](auto& r) { r.scene.bars[0].nodes[0] = "b"; }, "scene.bars[0].nodes", "[b, b]",
     "must name two different nodes"},
    {"BarOfLengthZero", [](auto& r) { r.scene.nodes[0].x = -5.0, r.scene.nodes[0].y = 0.0; }, "scene.bars[0].nodes",
     "[a, b]", "the two nodes must not be at the same point"},
    {"BarOfLengthZeroAtRestLength",
     [](auto& r) {
       r.scene.nodes[0].x = -5.0, r.scene.nodes[0].y = 0.0;
       r.scene.bars[0].rest_length = 1.0, r.scene.bars[0].strain = StrainMeasure::kGreenLagrange;
     },
     "scene.bars[0].nodes", "[a, b]", "the two nodes must not be at the same point"},
    {"EAZero", [](auto& r) { r.scene.bars[0].EA = 0.0; }, "scene.bars[0].EA", "0", "must be > 0"},
    {"EANegative", [](auto& r) { r.scene.bars[0].EA = -0.1; }, "scene.bars[0].EA", "-0.1", "must be > 0"},
    {"EATiny", [](auto& r) { r.scene.bars[0].EA = 1e-200; }, "scene.bars[0].EA", "1e-200", "must be > 0"},
    {"EANotFinite", [](auto& r) { r.scene.bars[0].EA = kInfinity; }, "scene.bars[0].EA", ".inf", "must be finite"},
    {"EATooLarge", [](auto& r) { r.scene.bars[0].EA = 1e101; }, "scene.bars[0].EA", "1e+101", "must not exceed"},
    {"RestLengthNegative", [](auto& r) { r.scene.bars[0].rest_length = -7.0; }, "scene.bars[0].rest_length", "-7",
     "must be 0 or positive"},
    {"RestLengthTiny", [](auto& r) { r.scene.bars[0].rest_length = 1e-300; }, "scene.bars[0].rest_length", "1e-300",
     "must be 0 or positive"},
    {"RestLengthNotFinite", [](auto& r) { r.scene.bars[0].rest_length = kNaN; }, "scene.bars[0].rest_length", ".nan",
     "must be finite"},
    {"SuperelementWithoutNodes", [](auto& r) { r.scene.superelements.push_back({}); }, "scene.superelements[1].nodes",
     "[]", "at least one node is needed"},
    {"SuperelementAtUnknownNode", [](auto& r) { r.scene.superelements[0].nodes[1] = "zz"; },
     "scene.superelements[0].nodes[1]", "zz", "must name a node"},
    {"SuperelementWithRepeatedNode",
     [](auto& r) {
       r.scene.superelements.push_back({{"b", "b"}, {}});
       r.scene.superelements[1].stiffness = r.scene.superelements[0].stiffness;
     },
     "scene.superelements[1].nodes[1]", "b", "must not be repeated"},
    {"MatrixTooSmall", [](auto& r) { r.scene.superelements[0].stiffness.pop_back(); },
     "scene.superelements[0].stiffness", "15 entries", "must have 16 entries: 4 rows of 4"},
    {"MatrixTooLarge", [](auto& r) { r.scene.superelements[0].stiffness.push_back(0.0); },
     "scene.superelements[0].stiffness", "17 entries", "must have 16 entries: 4 rows of 4"},
    {"MatrixNotFinite", [](auto& r) { r.scene.superelements[0].stiffness[3] = kNaN; },
     "scene.superelements[0].stiffness[3]", ".nan", "must be finite"},
    {"MatrixZero", [](auto& r) { r.scene.superelements[0].stiffness.assign(16, 0.0); },
     "scene.superelements[0].stiffness", "all 0", "must not be zero"},
    // The bound is relative to the largest entry, 2.
    {"MatrixNotSymmetric", [](auto& r) { r.scene.superelements[0].stiffness[8] += 2.1e-9; },
     "scene.superelements[0].stiffness[8]", "-1.9999999979", "the matrix must be symmetric, but entry [2] is -2"},
    {"MatrixNotSymmetricTwice",
     [](auto& r) { r.scene.superelements[0].stiffness[8] = r.scene.superelements[0].stiffness[13] = 1.0; },
     "scene.superelements[0].stiffness[8]", "1", "the matrix must be symmetric, but entry [2] is -2"},
};
INSTANTIATE_TEST_SUITE_P(Elements, ValidateTest, testing::ValuesIn(kElementRules), NameOf<BrokenRule>);

const BrokenRule kLoadRules[] = {
    {"LoadAtUnknownNode", [](auto& r) { r.scene.loads[1].node = "zz"; }, "scene.loads[1].node", "zz",
     "must name a node"},
    {"FxNotFinite", [](auto& r) { r.scene.loads[0].fx = kInfinity; }, "scene.loads[0].fx", ".inf", "must be finite"},
    {"FyTooLarge", [](auto& r) { r.scene.loads[0].fy = 1e300; }, "scene.loads[0].fy", "1e+300", "must not exceed"},
    {"NoLoads", [](auto& r) { r.scene.loads.clear(); }, "scene.loads", "[]", "a load that is not constant must act"},
    {"OnlyConstantLoads", [](auto& r) { r.scene.loads[0].constant = true; }, "scene.loads", "no net force",
     "a load that is not constant must act"},
    {"LoadZero", [](auto& r) { r.scene.loads[0].fx = 0.0; }, "scene.loads", "no net force",
     "a load that is not constant must act"},
    {"LoadTiny", [](auto& r) { r.scene.loads[0].fx = 1e-200; }, "scene.loads", "no net force",
     "a load that is not constant must act"},
    {"LoadOnFixedNode", [](auto& r) { r.scene.loads[0].node = "a"; }, "scene.loads", "no net force",
     "a load that is not constant must act"},
    {"LoadOnFixedComponent", [](auto& r) { r.scene.nodes[1].fixed_x = true; }, "scene.loads", "no net force",
     "a load that is not constant must act"},
    // 0.1 + 0.2 - 0.3 is not 0 in doubles.
    {"LoadsCancel",
     [](auto& r) {
       r.scene.loads = {{"b", 0.1, 0.0, false}, {"b", 0.2, 0.0, false}, {"b", -0.3, 0.0, false}};
     },
     "scene.loads", "no net force", "a load that is not constant must act"},
};
INSTANTIATE_TEST_SUITE_P(Loads, ValidateTest, testing::ValuesIn(kLoadRules), NameOf<BrokenRule>);

const BrokenRule kObstacleRules[] = {
    {"EmptyObstacleName", [](auto& r) { r.scene.obstacles[0].name = "", r.scene.contacts.clear(); },
     "scene.obstacles[0].name", "\"\"", "must not be empty"},
    {"AtInObstacleName", [](auto& r) { r.scene.obstacles[0].name = "a@b", r.scene.contacts.clear(); },
     "scene.obstacles[0].name", "a@b", "must not contain"},
    {"TabInObstacleName", [](auto& r) { r.scene.obstacles[0].name = "a\t", r.scene.contacts.clear(); },
     "scene.obstacles[0].name", "a\t", "must not contain"},
    {"RepeatedObstacleName", [](auto& r) { r.scene.obstacles.push_back(r.scene.obstacles[0]); },
     "scene.obstacles[1].name", "floor", "must be unique"},
    {"PxNotFinite", [](auto& r) { r.scene.obstacles[0].px = kNaN; }, "scene.obstacles[0].px", ".nan", "must be finite"},
    {"PyNotFinite", [](auto& r) { r.scene.obstacles[0].py = kNaN; }, "scene.obstacles[0].py", ".nan", "must be finite"},
    {"PyTooLarge", [](auto& r) { r.scene.obstacles[0].py = 1e101; }, "scene.obstacles[0].py", "1e+101",
     "must not exceed"},
    {"NxNotFinite", [](auto& r) { r.scene.obstacles[0].nx = kNaN; }, "scene.obstacles[0].nx", ".nan", "must be finite"},
    {"NyTooLarge", [](auto& r) { r.scene.obstacles[0].ny = 1e101; }, "scene.obstacles[0].ny", "1e+101",
     "must not exceed"},
    {"NormalZero", [](auto& r) { r.scene.obstacles[0].ny = 0.0; }, "scene.obstacles[0].nx", "0",
     "the normal (nx, ny) must not be zero"},
    {"FrictionNegative", [](auto& r) { r.scene.obstacles[0].friction = -0.3; }, "scene.obstacles[0].friction", "-0.3",
     "must be >= 0"},
    {"FrictionNotFinite", [](auto& r) { r.scene.obstacles[0].friction = kInfinity; }, "scene.obstacles[0].friction",
     ".inf", "must be finite"},
};
INSTANTIATE_TEST_SUITE_P(Obstacles, ValidateTest, testing::ValuesIn(kObstacleRules), NameOf<BrokenRule>);

const BrokenRule kContactRules[] = {
    {"ContactOfUnknownNode", [](auto& r) { r.scene.contacts[0].node = "zz"; }, "scene.contacts[0].node", "zz",
     "must name a node"},
    {"ContactWithUnknownObstacle", [](auto& r) { r.scene.contacts[1].obstacle = "wall"; }, "scene.contacts[1].obstacle",
     "wall", "must name an obstacle"},
    {"ContactWithMisspeltObstacle", [](auto& r) { r.scene.contacts[1].obstacle = "flor"; },
     "scene.contacts[1].obstacle", "flor", "must name an obstacle of the scene; did you mean floor?"},
    {"RepeatedContact", [](auto& r) { r.scene.contacts.push_back(r.scene.contacts[0]); }, "scene.contacts[2]",
     "b@floor", "must not be repeated"},
    {"ContactOfFixedNode", [](auto& r) { r.scene.contacts[0].node = "a"; }, "scene.contacts[0].node", "a",
     "must be free to move along the normal"},
    {"ContactAlongFixedComponent", [](auto& r) { r.scene.nodes[2].fixed_y = true; }, "scene.contacts[1].node", "c",
     "must be free to move along the normal"},
    {"ContactAlongFixedComponentButForRounding",
     [](auto& r) { r.scene.nodes[2].fixed_y = true, r.scene.obstacles[0].nx = 1e-13; }, "scene.contacts[1].node", "c",
     "must be free to move along the normal"},
    // The normal is (0, 2): the penetration is a length.
    {"Penetration", [](auto& r) { r.scene.nodes[2].y = -0.25; }, "scene.contacts[1]", "c@floor",
     "initial position penetrates the obstacle by 0.25"},
    // L = 5 sqrt(2), so that up to 7.07e-9 is taken for rounding.
    {"SmallPenetration", [](auto& r) { r.scene.nodes[2].y = -7.1e-9; }, "scene.contacts[1]", "c@floor",
     "initial position penetrates the obstacle by 7.1e-09"},
};
INSTANTIATE_TEST_SUITE_P(Contacts, ValidateTest, testing::ValuesIn(kContactRules), NameOf<BrokenRule>);

const BrokenRule kOptionRules[] = {
    {"DirectionNotFinite", [](auto& r) { r.options.direction = kNaN; }, "options.direction", ".nan", "must be finite"},
    {"StepNegative", [](auto& r) { r.options.step = -1.0; }, "options.step", "-1", "must be >= 0"},
    {"StepNotFinite", [](auto& r) { r.options.step = kInfinity; }, "options.step", ".inf", "must be finite"},
    {"IncrementsNegative", [](auto& r) { r.options.max_increments = -1; }, "options.max_increments", "-1",
     "must be >= 0"},
    {"FullStateNegative", [](auto& r) { r.options.full_state_every = -2; }, "options.full_state_every", "-2",
     "must be >= 0"},
    {"EmptyQuantity", [](auto& r) { r.options.stop[0].quantity = ""; }, "options.stop[0].quantity", "\"\"",
     "must be a quantity, as load_factor, <node>.x, <contact>.rn, <obstacle>.ry or <beam>.1.M"},
    {"QuantityWithoutComponent", [](auto& r) { r.options.stop[0].quantity = "b"; }, "options.stop[0].quantity", "b",
     "must be a quantity, as load_factor, <node>.x, <contact>.rn, <obstacle>.ry or <beam>.1.M"},
    {"QuantityWithoutNode", [](auto& r) { r.options.stop[0].quantity = ".x"; }, "options.stop[0].quantity", ".x",
     "must be a quantity, as load_factor, <node>.x, <contact>.rn, <obstacle>.ry or <beam>.1.M"},
    {"QuantityWithWrongComponent", [](auto& r) { r.options.stop[0].quantity = "b.z"; }, "options.stop[0].quantity",
     "b.z", "must be a quantity, as load_factor, <node>.x, <contact>.rn, <obstacle>.ry or <beam>.1.M"},
    {"MisspeltLoadFactor", [](auto& r) { r.options.stop[0].quantity = "load_facto"; }, "options.stop[0].quantity",
     "load_facto",
     "must be a quantity, as load_factor, <node>.x, <contact>.rn, <obstacle>.ry or <beam>.1.M; did you "
     "mean load_factor?"},
    {"MisspeltComponent", [](auto& r) { r.options.stop[0].quantity = "b.xx"; }, "options.stop[0].quantity", "b.xx",
     "must be a quantity, as load_factor, <node>.x, <contact>.rn, <obstacle>.ry or <beam>.1.M; did you "
     "mean b.x?"},
    {"QuantityOfUnknownNode", [](auto& r) { r.options.stop[2].quantity = "zz.y"; }, "options.stop[2].quantity", "zz.y",
     "must refer to a node"},
    {"QuantityOfMisspeltNode", [](auto& r) { r.options.stop[0].quantity = "B.x"; }, "options.stop[0].quantity", "B.x",
     "must refer to a node or an obstacle of the scene; did you mean b.x?"},
    {"ColumnOfMisspeltContact", [](auto& r) { r.options.stop[0].quantity = "rn_c@flor"; }, "options.stop[0].quantity",
     "rn_c@flor", "must refer to a contact of the scene; did you mean rn_c@floor?"},
    {"ReactionOfNode", [](auto& r) { r.options.stop[0].quantity = "b.rn"; }, "options.stop[0].quantity", "b.rn",
     "must refer to a contact of the scene"},
    {"EmptyWhen", [](auto& r) { r.options.stop[0].when = ""; }, "options.stop[0].when", "\"\"",
     "must be \">\" or \"<\""},
    {"UnknownWhen", [](auto& r) { r.options.stop[1].when = ">="; }, "options.stop[1].when",
     ">=", "must be \">\" or \"<\""},
    {"ValueNotFinite", [](auto& r) { r.options.stop[1].value = kNaN; }, "options.stop[1].value", ".nan",
     "must be finite"},
    {"EventNegative",
     [](auto& r) {
       r.options.branch_choices = {{1, 0, 2}, {-1, 0, 2}};
     },
     "options.branch_choices[1].event", "-1", "must be >= 0"},
    {"RowNegative",
     [](auto& r) {
       r.options.branch_choices = {{0, -1, 2}};
     },
     "options.branch_choices[0].increment", "-1", "must be >= 0"},
    {"BranchNegative",
     [](auto& r) {
       r.options.branch_choices = {{1, 0, -2}};
     },
     "options.branch_choices[0].branch", "-2", "must be >= 0"},
    {"SamplesOfUnknownNode",
     [](auto& r) {
       r.options.at = {{"zz.y", {1.0}}};
     },
     "options.at[0].quantity", "zz.y", "must refer to a node"},
    {"SamplesWithoutValues",
     [](auto& r) {
       r.options.at = {{"b.y", {}}};
     },
     "options.at[0]", "b.y", "must have values, or else from, to and count"},
    {"SamplesWithBoth",
     [](auto& r) {
       r.options.at = {{"b.y", {1.0}}, {"b.y", {1.0}, 0.0, 1.0, 3}};
     },
     "options.at[1]", "b.y", "must have values, or else from, to and count"},
    {"SampleNotFinite",
     [](auto& r) {
       r.options.at = {{"b.y", {1.0, kNaN}}};
     },
     "options.at[0].values[1]", ".nan", "must be finite"},
    {"SamplesNegativeCount",
     [](auto& r) {
       r.options.at = {{"b.y", {}, 0.0, 1.0, -3}};
     },
     "options.at[0].count", "-3", "must be >= 0"},
    {"SamplesTooMany",
     [](auto& r) {
       r.options.max_increments = 10;
       r.options.at = {{"b.y", {}, 0.0, 1.0, 11}};
     },
     "options.at[0].count", "11", "must be at most max_increments"},
    {"UnknownRecord",
     [](auto& r) {
       r.options.record = {"sections", "strains"};
     },
     "options.record[1]", "strains", "must be sections, stresses, pressures or inner"},
    {"ReactionOfAFreeComponent", [](auto& r) { r.options.stop[0].quantity = "b.rx"; }, "options.stop[0].quantity",
     "b.rx", "must refer to a component that a support holds"},
    {"EventAndIncrement",
     [](auto& r) {
       r.options.branch_choices = {{1, 5, 2}};
     },
     "options.branch_choices[0].increment", "5", "must be 0 where event is given"},
};
INSTANTIATE_TEST_SUITE_P(Options, ValidateTest, testing::ValuesIn(kOptionRules), NameOf<BrokenRule>);

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

// A stage that presses b and moves the floor down, and one that takes that back.
TraceRequest SoundProgram() {
  TraceRequest request = SoundRequest();
  request.scene.loads = {{"b", 0.0, -1.0, true}};
  request.options.stop.clear();
  request.program.resize(2);
  request.program[0].loads = {{"b", 2.0, 0.0, false}};
  request.program[0].obstacle_motions = {{"floor", 0.0, -1.0}};
  request.program[1].unload = true;
  return request;
}

struct BrokenProgram {
  std::string name;
  std::function<void(std::vector<Stage>&)> change;
  std::string line;
};

class ValidateProgramTest : public testing::TestWithParam<BrokenProgram> {};

TEST_P(ValidateProgramTest, ReportsTheBrokenRuleAlone) {
  TraceRequest request = SoundProgram();
  GetParam().change(request.program);
  const std::vector<Violation> violations = Validate(request);
  ASSERT_EQ(violations.size(), GetParam().line.empty() ? 0U : 1U);
  if (!violations.empty()) {
    EXPECT_EQ(violations[0].ToLine(), GetParam().line);
  }
}

const char kNothingLeft[] =
    "= true: the stages before must have left a load, a motion or a change of friction that can be taken back";
const BrokenProgram kPrograms[] = {
    {"Sound", [](auto&) {}, ""},
    {"Half", [](auto& p) { p[1].target = 0.5; }, ""},
    {"HalfAndTheRest", [](auto& p) { p[1].target = 0.5, p.push_back(p[1]), p[2].target = 1.0; }, ""},
    {"LoadedAgain", [](auto& p) { p.push_back(p[0]), p.push_back(p[1]); }, ""},
    {"NothingBefore", [](auto& p) { p.erase(p.begin()); }, std::string("program[0].unload ") + kNothingLeft},
    {"Twice", [](auto& p) { p.push_back(p[1]); }, std::string("program[2].unload ") + kNothingLeft},
    {"CancelledBefore",
     [](auto& p) {
       p.insert(p.begin() + 1, p[0]);
       p[1].target = -1.0;
     },
     std::string("program[2].unload ") + kNothingLeft},
    // 0.1 + 0.2 - 0.3 is not 0 in doubles.
    {"CancelledBeforeButForRounding",
     [](auto& p) {
       p[0].obstacle_motions.clear();
       p = {p[0], p[0], p[0], p[1]};
       p[0].target = 0.1, p[1].target = 0.2, p[2].target = -0.3;
     },
     std::string("program[3].unload ") + kNothingLeft},
    {"MoreThanAll", [](auto& p) { p[1].target = 1.5; },
     "program[1].target = 1.5: must be from 0 to 1 where the stage unloads: the part that is taken back, 0 = all"},
    {"LessThanNothing", [](auto& p) { p[1].target = -0.5; },
     "program[1].target = -0.5: must be from 0 to 1 where the stage unloads: the part that is taken back, 0 = all"},
    {"WithLoads", [](auto& p) { p[1].loads = p[0].loads; },
     "program[1].loads: must be empty where the stage unloads: it takes back what the stages before have left"},
    {"WithMotions", [](auto& p) { p[1].obstacle_motions = p[0].obstacle_motions; },
     "program[1].obstacle_motions: must be empty where the stage unloads: it takes back what the stages before have "
     "left"},
};
INSTANTIATE_TEST_SUITE_P(Programs, ValidateProgramTest, testing::ValuesIn(kPrograms), NameOf<BrokenProgram>);

// What looks odd but breaks no rule.
struct SoundVariant {
  std::string name;
  std::function<void(TraceRequest&)> change;
};

class SoundRequestTest : public testing::TestWithParam<SoundVariant> {};

TEST_P(SoundRequestTest, BreaksNoRule) {
  TraceRequest request = SoundRequest();
  GetParam().change(request);
  for (const Violation& violation : Validate(request)) ADD_FAILURE() << violation.ToLine();
}

const SoundVariant kSoundVariants[] = {
    {"AsItIs", [](auto&) {}},
    {"AnySceneName", [](auto& r) { r.scene.name = "two words, \"quoted\"\n"; }},
    {"LettersBeyondAscii",
     [](auto& r) { r.scene.obstacles.push_back(r.scene.obstacles[0]), r.scene.obstacles[1].name = "\xc3\xa9"; }},
    {"SameNameForNodeAndObstacle",
     [](auto& r) { r.scene.obstacles.push_back(r.scene.obstacles[0]), r.scene.obstacles[1].name = "b"; }},
    {"FixedNodeWithoutElement",
     [](auto& r) {
       r.scene.nodes.push_back({"d", 0.0, 0.0, true, true});
     }},
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
     [](auto& r) {
       r.scene.loads.push_back({"b", -1.0, 1.0, false});
     }},
    {"SmallLoadBesideLargeOnFixedNode",
     [](auto& r) {
       r.scene.loads.push_back({"a", 1e50, 0.0, false});
     }},
    {"SlightlyInclinedContactOfGuidedNode",
     [](auto& r) { r.scene.nodes[2].fixed_y = true, r.scene.obstacles[0].nx = 1e-9; }},
    {"LoadsNearlyCancel",
     [](auto& r) {
       r.scene.loads.push_back({"b", -1.0 + 1e-9, 0.0, false});
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
INSTANTIATE_TEST_SUITE_P(Variants, SoundRequestTest, testing::ValuesIn(kSoundVariants), NameOf<SoundVariant>);

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

// Each stage takes a part of what many loads have left: 10^10 sums would be seen here.
TEST(ValidateSizeTest, UnloadingTakesTimeInProportionToTheRequest) {
  TraceRequest request = SoundProgram();
  constexpr int kMany = 100000;
  request.program[0].loads.clear();
  for (int i = 0; i < kMany; ++i) {
    request.scene.nodes.push_back({"n" + std::to_string(i), 1.0, 1.0 + i, false, false});
    request.scene.bars.push_back({{"a", "n" + std::to_string(i)}, 1.0});
    request.program[0].loads.push_back({"n" + std::to_string(i), 1.0, 0.0, false});
  }
  request.program[1].target = 1e-5;
  request.program.resize(kMany, request.program[1]);
  const std::clock_t start = std::clock();
  EXPECT_TRUE(Validate(request).empty());
  EXPECT_LT(std::clock() - start, 5 * CLOCKS_PER_SEC);
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
