#include "contact_path/ros/convert.h"

#include <cstdint>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bytes.h"
#include "contact_path/scene/validate.h"

namespace contact_path {
namespace {

namespace msgs = contact_path_msgs;
using Response = msgs::TracePathResponse;

template <typename Message>
Message FromBytes(std::vector<std::uint8_t> bytes) {
  Message message;
  ros::serialization::IStream in(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::deserialize(in, message);
  return message;
}

// What arrives at the other side of a connection, or of a bag.
template <typename Message>
Message ThroughTheWire(const Message& message) {
  return FromBytes<Message>(Bytes(message));
}

// Every field differs from its default and from its neighbours.
TraceRequest FullRequest() {
  TraceRequest request;
  request.scene.name = "full";
  request.scene.nodes = {{"a", 1.0, 2.0, true, false}, {"b", 3.0, 4.0, false, true}};
  request.scene.bars = {{{"a", "b"}, 5.0, 6.0, StrainMeasure::kGreenLagrange},
                        {{"b", "a"}, 7.0, 8.0, StrainMeasure::kLogarithmic}};
  request.scene.superelements = {{{"b"}, {1.0, 2.0, 2.0, 3.0}, {25.0, 26.0}}};
  request.scene.materials = {{"rubber", MaterialModel::kCiarletGeymonat, 0.1, 0.2, 0.3, 0.4, 0.5}, {"steel"}};
  request.scene.solids = {{"block", "rubber", 0.6, PlaneState::kStress, 4, {"a", "b", "b", "a"}}};
  request.scene.loads = {{"a", 9.0, 10.0, true}, {"b", 11.0, 12.0, false}};
  request.scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 13.0, 14.0, 15.0, 16.0, 0.17}};
  request.scene.contacts = {{"b", "floor"}};
  request.scene.support_motions = {{"a", 27.0, 0.0}};
  request.scene.obstacle_motions = {{"floor", 28.0, 29.0}};
  request.program = {{"first", {{"b", 30.0, 31.0, false}}, {{"b", 32.0, 33.0}}, {{"floor", 34.0, 35.0}}, 36.0}, {}};
  request.program[1].unload = true;
  request.options.method = Method::kMpec;
  request.options.accuracy = Accuracy::kAccurate;
  request.options.direction = -1.0;
  request.options.step = 0.25;
  request.options.max_increments = 18;
  request.options.full_state_every = 24;
  request.options.stop = {{"b.x", ">", 19.0}, {"load_factor", "<", 20.0}};
  request.options.branch_choices = {{21, 22, 23}};
  request.options.friction_law = FrictionLaw::kTotal;
  request.options.stability = DefaultTrue::kFalse;
  request.options.at_limit = AtLimit::kJump;
  request.options.machine_stiffness = 85.0;
  return request;
}

void ExpectFullRequest(const TraceRequest& request) {
  const Scene& scene = request.scene;
  EXPECT_EQ(scene.name, "full");
  ASSERT_EQ(scene.nodes.size(), 2U);
  EXPECT_EQ(scene.nodes[0].name, "a");
  EXPECT_EQ(scene.nodes[0].x, 1.0);
  EXPECT_EQ(scene.nodes[0].y, 2.0);
  EXPECT_TRUE(scene.nodes[0].fixed_x);
  EXPECT_FALSE(scene.nodes[0].fixed_y);
  EXPECT_FALSE(scene.nodes[1].fixed_x);
  EXPECT_TRUE(scene.nodes[1].fixed_y);
  ASSERT_EQ(scene.bars.size(), 2U);
  EXPECT_EQ(scene.bars[0].nodes, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(scene.bars[0].EA, 5.0);
  EXPECT_EQ(scene.bars[0].rest_length, 6.0);
  EXPECT_EQ(scene.bars[0].strain, StrainMeasure::kGreenLagrange);
  EXPECT_EQ(scene.bars[1].strain, StrainMeasure::kLogarithmic);
  ASSERT_EQ(scene.superelements.size(), 1U);
  EXPECT_EQ(scene.superelements[0].nodes, std::vector<std::string>{"b"});
  EXPECT_EQ(scene.superelements[0].stiffness, (std::vector<double>{1.0, 2.0, 2.0, 3.0}));
  ASSERT_EQ(scene.materials.size(), 2U);
  EXPECT_EQ(scene.materials[0].name, "rubber");
  EXPECT_EQ(scene.materials[0].model, MaterialModel::kCiarletGeymonat);
  EXPECT_EQ(scene.materials[0].E, 0.1);
  EXPECT_EQ(scene.materials[0].nu, 0.2);
  EXPECT_EQ(scene.materials[0].lambda, 0.3);
  EXPECT_EQ(scene.materials[0].mu, 0.4);
  EXPECT_EQ(scene.materials[0].a, 0.5);
  EXPECT_EQ(scene.materials[1].model, MaterialModel::kNeoHookean);
  ASSERT_EQ(scene.solids.size(), 1U);
  EXPECT_EQ(scene.solids[0].name, "block");
  EXPECT_EQ(scene.solids[0].material, "rubber");
  EXPECT_EQ(scene.solids[0].thickness, 0.6);
  EXPECT_EQ(scene.solids[0].plane, PlaneState::kStress);
  EXPECT_EQ(scene.solids[0].nodes_per_element, 4);
  EXPECT_EQ(scene.solids[0].nodes, (std::vector<std::string>{"a", "b", "b", "a"}));
  ASSERT_EQ(scene.loads.size(), 2U);
  EXPECT_EQ(scene.loads[0].node, "a");
  EXPECT_EQ(scene.loads[0].fx, 9.0);
  EXPECT_EQ(scene.loads[0].fy, 10.0);
  EXPECT_TRUE(scene.loads[0].constant);
  EXPECT_FALSE(scene.loads[1].constant);
  ASSERT_EQ(scene.obstacles.size(), 1U);
  EXPECT_EQ(scene.obstacles[0].name, "floor");
  EXPECT_EQ(scene.obstacles[0].px, 13.0);
  EXPECT_EQ(scene.obstacles[0].py, 14.0);
  EXPECT_EQ(scene.obstacles[0].nx, 15.0);
  EXPECT_EQ(scene.obstacles[0].ny, 16.0);
  EXPECT_EQ(scene.obstacles[0].friction, 0.17);
  EXPECT_EQ(scene.superelements[0].rest_positions, (std::vector<double>{25.0, 26.0}));
  ASSERT_EQ(scene.contacts.size(), 1U);
  EXPECT_EQ(scene.contacts[0].Name(), "b@floor");
  ASSERT_EQ(scene.support_motions.size(), 1U);
  EXPECT_EQ(scene.support_motions[0].node, "a");
  EXPECT_EQ(scene.support_motions[0].dx, 27.0);
  EXPECT_EQ(scene.support_motions[0].dy, 0.0);
  ASSERT_EQ(scene.obstacle_motions.size(), 1U);
  EXPECT_EQ(scene.obstacle_motions[0].obstacle, "floor");
  EXPECT_EQ(scene.obstacle_motions[0].dx, 28.0);
  EXPECT_EQ(scene.obstacle_motions[0].dy, 29.0);
  ASSERT_EQ(request.program.size(), 2U);
  const Stage& stage = request.program[0];
  EXPECT_EQ(stage.name, "first");
  ASSERT_EQ(stage.loads.size(), 1U);
  EXPECT_EQ(stage.loads[0].fy, 31.0);
  ASSERT_EQ(stage.support_motions.size(), 1U);
  EXPECT_EQ(stage.support_motions[0].dy, 33.0);
  ASSERT_EQ(stage.obstacle_motions.size(), 1U);
  EXPECT_EQ(stage.obstacle_motions[0].dx, 34.0);
  EXPECT_EQ(stage.target, 36.0);
  EXPECT_FALSE(stage.unload);
  EXPECT_TRUE(request.program[1].unload);
  const TraceOptions& options = request.options;
  EXPECT_EQ(options.method, Method::kMpec);
  EXPECT_EQ(options.accuracy, Accuracy::kAccurate);
  EXPECT_EQ(options.direction, -1.0);
  EXPECT_EQ(options.step, 0.25);
  EXPECT_EQ(options.max_increments, 18);
  EXPECT_EQ(options.full_state_every, 24);
  EXPECT_EQ(options.friction_law, FrictionLaw::kTotal);
  EXPECT_EQ(options.stability, DefaultTrue::kFalse);
  EXPECT_EQ(options.at_limit, AtLimit::kJump);
  EXPECT_EQ(options.machine_stiffness, 85.0);
  ASSERT_EQ(options.stop.size(), 2U);
  EXPECT_EQ(options.stop[0].quantity, "b.x");
  EXPECT_EQ(options.stop[0].when, ">");
  EXPECT_EQ(options.stop[0].value, 19.0);
  EXPECT_EQ(options.stop[1].when, "<");
  ASSERT_EQ(options.branch_choices.size(), 1U);
  EXPECT_EQ(options.branch_choices[0].event, 21);
  EXPECT_EQ(options.branch_choices[0].increment, 22);
  EXPECT_EQ(options.branch_choices[0].branch, 23);
}

TEST(ConvertTest, RequestSurvivesTheWayThroughMessages) {
  const msgs::TraceRequest message = ThroughTheWire(ToMessage(FullRequest()));
  ExpectFullRequest(FromMessage(message.scene, message.options, message.program));
}

TEST(ConvertTest, RequestMessageNamesItsFieldsAsTheSceneFilesDo) {
  const msgs::TraceRequest message = ToMessage(FullRequest());
  EXPECT_EQ(message.scene.nodes[1].y, 4.0);
  EXPECT_EQ(message.scene.bars[0].EA, 5.0);
  EXPECT_EQ(message.scene.bars[0].strain, "green_lagrange");
  EXPECT_EQ(message.scene.loads[0].fy, 10.0);
  EXPECT_EQ(message.scene.obstacles[0].shape, "half_plane");
  EXPECT_EQ(message.scene.obstacles[0].ny, 16.0);
  EXPECT_EQ(message.scene.contacts[0].obstacle, "floor");
  EXPECT_EQ(message.options.method, "mpec");
  EXPECT_EQ(message.options.accuracy, "accurate");
  EXPECT_EQ(message.options.stop[0].quantity, "b.x");
}

TEST(ConvertTest, FieldsLeftOutHaveTheDefaultsOfTheCore) {
  msgs::Scene scene;
  scene.bars.resize(1);
  scene.obstacles.resize(1);
  msgs::TraceOptions options;
  options.branch_choices.resize(1);
  const TraceRequest request = FromMessage(scene, options, {});
  const TraceOptions defaults;
  EXPECT_EQ(request.options.method, defaults.method);
  EXPECT_EQ(request.options.accuracy, defaults.accuracy);
  EXPECT_EQ(request.options.direction, defaults.direction);
  EXPECT_EQ(request.options.step, defaults.step);
  EXPECT_EQ(request.options.max_increments, defaults.max_increments);
  EXPECT_EQ(request.options.branch_choices[0].event, BranchChoice().event);
  EXPECT_EQ(request.options.branch_choices[0].increment, BranchChoice().increment);
  EXPECT_EQ(request.options.branch_choices[0].branch, BranchChoice().branch);
  EXPECT_EQ(request.scene.bars[0].strain, Bar().strain);
  EXPECT_EQ(request.scene.obstacles[0].shape, Obstacle().shape);
}

TEST(ConvertTest, RefusesEveryWordThatIsNotKnown) {
  msgs::TraceRequest message = ToMessage(FullRequest());
  message.scene.bars[1].strain = "hencky";
  message.scene.obstacles[0].shape = "ellipse";
  message.options.method = "magic";
  message.options.accuracy = "perfect";
  try {
    FromMessage(message.scene, message.options, message.program);
    FAIL() << "was not refused";
  } catch (const InvalidRequest& error) {
    ASSERT_EQ(error.violations().size(), 4U);
    EXPECT_EQ(error.violations()[0].key, "scene.bars[1].strain");
    EXPECT_EQ(error.violations()[0].value, "hencky");
    EXPECT_EQ(error.violations()[0].rule, "must be biot, green_lagrange or logarithmic");
    EXPECT_EQ(error.violations()[1].key, "scene.obstacles[0].shape");
    EXPECT_EQ(error.violations()[2].key, "options.method");
    EXPECT_EQ(error.violations()[3].key, "options.accuracy");
  }
}

Increment FullIncrement() {
  Increment increment;
  increment.index = 1;
  increment.load_factor = 2.0;
  increment.arc_length = 3.0;
  increment.kind = IncrementKind::kCornerLimit;
  increment.positions = {4.0, 5.0, 6.0, 7.0};
  increment.contacts = {{8.0, 9.0, 10.0, ContactState::kSlipMinus}, {11.0, 12.0, 13.0, ContactState::kStick}};
  increment.dissipation = 14.0;
  increment.strain_energy = 15.0;
  increment.external_work = 16.0;
  increment.residuals = {17.0, 18.0, 19.0, 20.0, 21.0, 22.0};
  increment.solve.method = Method::kMpec;
  increment.solve.regularisation = 23.0;
  increment.solve.exact = true;
  increment.solve.iterations = 24;
  increment.solve.variables = 25;
  increment.solve.constraints = 26;
  increment.solve.rejected = 27;
  increment.solve.time = 28.0;
  increment.solve.factorisations = 29;
  increment.solve.nullity = 30;
  increment.solve.determinant_sign = -1;
  increment.solve.contraction = 31.0;
  increment.supports = {{51.0, 52.0, 53.0}};
  increment.boundaries = {{54.0, 55.0, 56.0}, {57.0, 58.0, 59.0}};
  increment.sections = {{60.0, 61.0, 62.0, 63.0, 64.0}};
  increment.stresses = {{65.0, 66.0, 67.0, 68.0, 69.0, 70.0}};
  increment.pressures = {{71.0, 72.0, 73.0}, {74.0, 75.0, 76.0}};
  increment.widths = {77.0, 78.0};
  increment.event.branches = {{{ContactState::kOpen, ContactState::kSlipPlus}, 32.0, 33.0, 34.0},
                              {{ContactState::kStick, ContactState::kOpen}, 35.0, 36.0, 37.0}};
  increment.event.number = 41;
  increment.event.taken = 1;
  increment.event.weakly_active = 38;
  increment.event.complete = false;
  increment.event.complete_by = "only_solution";
  increment.event.null_vector = {39.0, 40.0, 41.0, 42.0};
  increment.stability = {Verdict::kUnstable, Verdict::kNotProved, 2, 79.0, {80.0, 81.0, 82.0, 83.0}};
  increment.jump = {84.0, true};
  return increment;
}

TEST(ConvertTest, IncrementMessageHoldsEveryFieldUnderItsName) {
  const msgs::Increment message = ToMessage(FullIncrement());
  EXPECT_EQ(message.index, 1U);
  EXPECT_EQ(message.load_factor, 2.0);
  EXPECT_EQ(message.arc_length, 3.0);
  EXPECT_EQ(message.kind, msgs::Increment::CORNER_LIMIT);
  EXPECT_EQ(message.x, (std::vector<double>{4.0, 6.0}));
  EXPECT_EQ(message.y, (std::vector<double>{5.0, 7.0}));
  ASSERT_EQ(message.contacts.size(), 2U);
  EXPECT_EQ(message.contacts[0].gap, 8.0);
  EXPECT_EQ(message.contacts[0].rn, 9.0);
  EXPECT_EQ(message.contacts[0].rt, 10.0);
  EXPECT_EQ(message.contacts[0].state, msgs::ContactState::SLIP_MINUS);
  EXPECT_EQ(message.contacts[1].state, msgs::ContactState::STICK);
  EXPECT_EQ(message.dissipation, 14.0);
  EXPECT_EQ(message.strain_energy, 15.0);
  EXPECT_EQ(message.external_work, 16.0);
  EXPECT_EQ(message.equilibrium_residual, 17.0);
  EXPECT_EQ(message.penetration_residual, 18.0);
  EXPECT_EQ(message.tensile_reaction_residual, 19.0);
  EXPECT_EQ(message.min_form_residual, 20.0);
  EXPECT_EQ(message.cone_residual, 21.0);
  EXPECT_EQ(message.friction_law_residual, 22.0);
  EXPECT_EQ(message.complementarity_residual, 22.0);
  EXPECT_EQ(message.method, msgs::Increment::MPEC);
  EXPECT_EQ(message.regularisation, 23.0);
  EXPECT_TRUE(message.exact);
  EXPECT_EQ(message.iterations, 24U);
  EXPECT_EQ(message.variables, 25U);
  EXPECT_EQ(message.constraints, 26U);
  EXPECT_EQ(message.rejected, 27U);
  EXPECT_EQ(message.solve_time, 28.0);
  EXPECT_EQ(message.factorisations, 29U);
  EXPECT_EQ(message.nullity, 30U);
  EXPECT_EQ(message.determinant_sign, -1);
  EXPECT_EQ(message.contraction, 31.0);
  ASSERT_EQ(message.supports.size(), 1U);
  EXPECT_EQ(message.supports[0].rx, 51.0);
  EXPECT_EQ(message.supports[0].rm, 53.0);
  ASSERT_EQ(message.boundaries.size(), 2U);
  EXPECT_EQ(message.boundaries[1].ry, 58.0);
  ASSERT_EQ(message.sections.size(), 1U);
  EXPECT_EQ(message.sections[0].N, 60.0);
  EXPECT_EQ(message.sections[0].M2, 64.0);
  ASSERT_EQ(message.stresses.size(), 1U);
  EXPECT_EQ(message.stresses[0].szz, 68.0);
  EXPECT_EQ(message.stresses[0].energy, 70.0);
  ASSERT_EQ(message.pressures.size(), 2U);
  EXPECT_EQ(message.pressures[1].traction, 75.0);
  EXPECT_EQ(message.widths, (std::vector<double>{77.0, 78.0}));
  ASSERT_EQ(message.event.branches.size(), 2U);
  EXPECT_EQ(message.event.branches[0].states,
            (std::vector<std::uint8_t>{msgs::ContactState::OPEN, msgs::ContactState::SLIP_PLUS}));
  EXPECT_EQ(message.event.branches[0].load_rate, 32.0);
  EXPECT_EQ(message.event.branches[0].dissipation_rate, 33.0);
  EXPECT_EQ(message.event.branches[0].turn, 34.0);
  EXPECT_EQ(message.event.number, 41U);
  EXPECT_EQ(message.event.taken, 1);
  EXPECT_EQ(message.event.weakly_active, 38U);
  EXPECT_FALSE(message.event.complete);
  EXPECT_EQ(message.event.complete_by, "only_solution");
  EXPECT_EQ(message.event.null_vector, (std::vector<double>{39.0, 40.0, 41.0, 42.0}));
  EXPECT_EQ(message.stability, "unstable");
  EXPECT_EQ(message.stability_controlled, "not_proved");
  EXPECT_EQ(message.unstable_directions, 2);
  EXPECT_EQ(message.critical_stiffness, 79.0);
  EXPECT_EQ(message.unstable_direction, (std::vector<double>{80.0, 81.0, 82.0, 83.0}));
  EXPECT_EQ(message.energy_released, 84.0);
  EXPECT_TRUE(message.landing_robust);
}

TEST(ConvertTest, RegularIncrementsMayLeaveTheirStateOut) {
  Increment increment = FullIncrement();
  const auto has_state = [&](int index, IncrementKind kind, int every) {
    increment.index = index;
    increment.kind = kind;
    const msgs::Increment message = ToMessage(increment, every);
    EXPECT_EQ(message.index, static_cast<std::uint32_t>(index));
    EXPECT_EQ(message.dissipation, increment.dissipation);
    EXPECT_EQ(message.x.empty(), message.contacts.empty());
    EXPECT_EQ(message.x.empty(), message.y.empty());
    EXPECT_EQ(message.x.empty(), message.sections.empty());
    EXPECT_EQ(message.x.empty(), message.pressures.empty());
    EXPECT_EQ(message.supports.size(), 1U);  // always
    return !message.x.empty();
  };
  for (const int every : {0, 1}) EXPECT_TRUE(has_state(7, IncrementKind::kRegular, every));
  EXPECT_TRUE(has_state(0, IncrementKind::kStart, 3));
  EXPECT_FALSE(has_state(1, IncrementKind::kRegular, 3));
  EXPECT_FALSE(has_state(2, IncrementKind::kRegular, 3));
  EXPECT_TRUE(has_state(3, IncrementKind::kRegular, 3));
  for (const IncrementKind kind :
       {IncrementKind::kSmoothLimit, IncrementKind::kCornerLimit, IncrementKind::kContactEvent,
        IncrementKind::kBifurcation, IncrementKind::kSample, IncrementKind::kOnset, IncrementKind::kJump})
    EXPECT_TRUE(has_state(4, kind, 3));
}

TEST(ConvertTest, IncrementSurvivesTheWayThroughMessages) {
  const msgs::Increment message = ThroughTheWire(ToMessage(FullIncrement()));
  EXPECT_EQ(message, ToMessage(FullIncrement()));
  const Increment increment = FromMessage(message);
  EXPECT_EQ(increment.positions, FullIncrement().positions);
  EXPECT_EQ(increment.residuals.complementarity, 20.0);
  EXPECT_EQ(ToMessage(increment), message);
}

TEST(ConvertTest, NumbersSurviveToTheLastBit) {
  Increment increment;
  increment.load_factor = 0.1 + 0.2;
  increment.dissipation = std::numeric_limits<double>::denorm_min();
  increment.arc_length = std::numeric_limits<double>::max();
  const Increment back = FromMessage(ThroughTheWire(ToMessage(increment)));
  EXPECT_EQ(back.load_factor, increment.load_factor);
  EXPECT_EQ(back.dissipation, increment.dissipation);
  EXPECT_EQ(back.arc_length, increment.arc_length);
}

TEST(ConvertTest, VerdictsMayBeUnknownAndStiffnessInfinite) {
  Increment increment;
  increment.stability.critical_stiffness = std::numeric_limits<double>::infinity();
  const msgs::Increment message = ThroughTheWire(ToMessage(increment));
  EXPECT_EQ(message.stability, "");
  EXPECT_EQ(message.unstable_directions, -1);
  const Increment back = FromMessage(message);
  EXPECT_EQ(back.stability.stability, Verdict::kNotAsked);
  EXPECT_EQ(back.stability.critical_stiffness, increment.stability.critical_stiffness);
  msgs::Increment wrong = message;
  wrong.stability = "steady";
  EXPECT_THROW(FromMessage(wrong), std::invalid_argument);
}

TEST(ConvertTest, EveryKindStateAndMethodHasItsConstant) {
  Increment increment;
  std::set<std::uint8_t> constants;
  for (const IncrementKind kind :
       {IncrementKind::kStart, IncrementKind::kRegular, IncrementKind::kSmoothLimit, IncrementKind::kCornerLimit,
        IncrementKind::kContactEvent, IncrementKind::kBifurcation, IncrementKind::kSample, IncrementKind::kOnset,
        IncrementKind::kJump}) {
    increment.kind = kind;
    constants.insert(ToMessage(increment).kind);
    EXPECT_EQ(FromMessage(ToMessage(increment)).kind, kind);
  }
  EXPECT_EQ(constants.size(), 9U);

  constants.clear();
  increment.contacts.resize(1);
  for (const ContactState state : {ContactState::kOpen, ContactState::kStick, ContactState::kSlipPlus,
                                   ContactState::kSlipMinus, ContactState::kClosed}) {
    increment.contacts[0].state = state;
    constants.insert(ToMessage(increment).contacts[0].state);
    EXPECT_EQ(FromMessage(ToMessage(increment)).contacts[0].state, state);
  }
  EXPECT_EQ(constants.size(), 5U);

  for (const Method method : {Method::kBranch, Method::kMpec}) {
    increment.solve.method = method;
    EXPECT_EQ(FromMessage(ToMessage(increment)).solve.method, method);
  }
}

TEST(ConvertTest, RefusesIncrementMessagesThatContradictThemselves) {
  msgs::Increment message = ToMessage(FullIncrement());
  message.y.pop_back();
  EXPECT_THROW(FromMessage(message), std::invalid_argument);

  message = ToMessage(FullIncrement());
  message.kind = 200;
  EXPECT_THROW(FromMessage(message), std::invalid_argument);

  message = ToMessage(FullIncrement());
  message.contacts[1].state = 200;
  EXPECT_THROW(FromMessage(message), std::invalid_argument);

  message = ToMessage(FullIncrement());
  message.event.branches[1].states[0] = 200;
  EXPECT_THROW(FromMessage(message), std::invalid_argument);

  message = ToMessage(FullIncrement());
  message.method = 200;
  EXPECT_THROW(FromMessage(message), std::invalid_argument);

  message = ToMessage(FullIncrement());
  message.iterations = std::numeric_limits<std::uint32_t>::max();
  EXPECT_THROW(FromMessage(message), std::invalid_argument);
}

TEST(ConvertTest, EndReasonsHaveConstantNameAndStatus) {
  struct Increment {
    EndReason reason;
    std::uint8_t constant;
    std::string name;
    std::uint8_t status;
  };
  const std::vector<Increment> increments = {
      {EndReason::kNumericalFailure, Response::END_NUMERICAL_FAILURE, "numerical_failure", Response::ENDED_EARLY},
      {EndReason::kStopCriterion, Response::END_STOP_CRITERION, "stop_criterion", Response::OK},
      {EndReason::kMaxIncrements, Response::END_MAX_INCREMENTS, "max_increments", Response::OK},
      {EndReason::kPathEnd, Response::END_PATH_END, "path_end", Response::ENDED_EARLY},
      {EndReason::kStepTooSmall, Response::END_STEP_TOO_SMALL, "step_too_small", Response::ENDED_EARLY},
      {EndReason::kCancelled, Response::END_CANCELLED, "cancelled", Response::ENDED_EARLY},
      {EndReason::kNoSuchBranch, Response::END_NO_SUCH_BRANCH, "no_such_branch", Response::INVALID_REQUEST},
      {EndReason::kClosedPath, Response::END_CLOSED_PATH, "closed_path", Response::OK},
      {EndReason::kMemoryLimit, Response::END_MEMORY_LIMIT, "memory_limit", Response::ENDED_EARLY},
      {EndReason::kElementInverted, Response::END_ELEMENT_INVERTED, "element_inverted", Response::ENDED_EARLY},
      {EndReason::kNotDetermined, Response::END_NOT_DETERMINED, "not_determined", Response::ENDED_EARLY},
      {EndReason::kAtLimit, Response::END_AT_LIMIT, "at_limit", Response::OK},
      {EndReason::kNoLanding, Response::END_NO_LANDING, "no_landing", Response::ENDED_EARLY},
  };
  for (const Increment& increment : increments) {
    EXPECT_EQ(ToConstant(increment.reason), increment.constant);
    EXPECT_EQ(EndReasonName(increment.constant), increment.name);
    EXPECT_EQ(StatusOf(increment.reason), increment.status);
  }
  EXPECT_EQ(EndReasonName(Response::END_NONE), "");
  EXPECT_EQ(EndReasonName(Response::END_TIME_LIMIT), "time_limit");
  EXPECT_EQ(EndReasonName(Response::END_MEMORY_LIMIT), "memory_limit");
  EXPECT_THROW(EndReasonName(200), std::invalid_argument);
}

TEST(ConvertTest, AResponseThatNobodyFilledInSaysFailed) {
  EXPECT_EQ(Response().status, Response::FAILED);
  EXPECT_EQ(Response().end_reason, Response::END_NONE);
}

TEST(ConvertTest, RequestsOfServiceAndActionAreTheRecordedOne) {
  const msgs::TraceRequest request = ToMessage(FullRequest());
  // Nothing but the same fields in the same order: their bytes are the same.
  const std::vector<std::uint8_t> bytes = Bytes(request);
  const msgs::TracePathRequest of_service = FromBytes<msgs::TracePathRequest>(bytes);
  const msgs::TracePathGoal of_action = FromBytes<msgs::TracePathGoal>(bytes);
  EXPECT_EQ(Bytes(of_service), bytes);
  EXPECT_EQ(Bytes(of_action), bytes);
  EXPECT_EQ(Bytes(ToRequest(of_service)), bytes);
  EXPECT_EQ(Bytes(ToRequest(of_action)), bytes);
}

TEST(ConvertTest, ResultsHoldTheResponse) {
  Response response;
  response.status = Response::ENDED_EARLY;
  response.message = "no branch";
  response.increments = 7;
  response.end_reason = Response::END_PATH_END;
  response.end_reason_name = "path_end";
  response.bag = "000001_scene.bag";
  response.limit_points =
      ToMessages({{3, 1, IncrementKind::kSmoothLimit, 2.5}, {5, 2, IncrementKind::kCornerLimit, -0.25}});
  const auto expect_same = [&response](const auto& result) {
    EXPECT_EQ(result.status, response.status);
    EXPECT_EQ(result.message, response.message);
    EXPECT_EQ(result.increments, response.increments);
    EXPECT_EQ(result.end_reason, response.end_reason);
    EXPECT_EQ(result.end_reason_name, response.end_reason_name);
    EXPECT_EQ(result.bag, response.bag);
    ASSERT_EQ(result.limit_points.size(), 2U);
    EXPECT_EQ(result.limit_points[0].index, 3U);
    EXPECT_EQ(result.limit_points[0].stage, 1U);
    EXPECT_EQ(result.limit_points[0].kind, msgs::Increment::SMOOTH_LIMIT);
    EXPECT_EQ(result.limit_points[0].load_factor, 2.5);
    EXPECT_EQ(result.limit_points[1].stage, 2U);
    EXPECT_EQ(result.limit_points[1].kind, msgs::Increment::CORNER_LIMIT);
  };
  expect_same(ThroughTheWire(ToResult(response)));
  expect_same(ThroughTheWire(ToActionResult(response)));
}

}  // namespace
}  // namespace contact_path
