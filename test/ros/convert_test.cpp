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
#include "support/filled_request.h"
#include "support/same_request.h"

namespace contact_path::convert_test {
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

TEST(ConvertTest, RequestSurvivesTheWayThroughMessages) {
  const TraceRequest request = FilledRequest();
  const msgs::TraceRequest message = ThroughTheWire(ToMessage(request));
  EXPECT_EQ(FirstDifference(FromMessage(message), request), "");
  EXPECT_NE(FirstDifference(TraceRequest(), request), "");
  EXPECT_EQ(message.scene.nodes[1].y, request.scene.nodes[1].y);
  EXPECT_EQ(message.scene.bars[0].strain, ToString(request.scene.bars[0].strain));
}

TEST(ConvertTest, FieldsLeftOutHaveTheDefaultsOfTheCore) {
  msgs::TraceRequest message;
  TraceRequest defaults;
  message.scene.bars.resize(1);
  message.scene.obstacles.resize(1);
  message.options.branch_choices.resize(1);
  defaults.scene.bars.resize(1);
  defaults.scene.obstacles.resize(1);
  defaults.options.branch_choices.resize(1);
  EXPECT_EQ(FirstDifference(FromMessage(message), defaults), "");
}

TEST(ConvertTest, RefusesEveryWordThatIsNotKnown) {
  msgs::TraceRequest message = ToMessage(FilledRequest());
  message.scene.bars[1].strain = "hencky";
  message.scene.obstacles[0].shape = "ellipse";
  message.options.method = "magic";
  message.options.accuracy = "perfect";
  try {
    FromMessage(message);
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
  increment.event.branches = {
      {{ContactState::kOpen, ContactState::kSlipPlus}, 32.0, 35.5, 33.0, 34.0, {BarState::kTaut, BarState::kSlack}},
      {{ContactState::kStick, ContactState::kOpen}, 35.0, 36.0, 37.0, 0.0, {}}};
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
  EXPECT_EQ(message.event.branches[0].parameter_rate, 35.5);
  EXPECT_EQ(message.event.branches[0].dissipation_rate, 33.0);
  EXPECT_EQ(message.event.branches[0].turn, 34.0);
  EXPECT_EQ(message.event.branches[0].bars, (std::vector<std::uint8_t>{msgs::Increment::TAUT, msgs::Increment::SLACK}));
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
  message.event.branches[0].bars[1] = 200;
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
    std::uint8_t early;  // where what was asked for was not reached
  };
  const std::vector<Increment> increments = {
      {EndReason::kNumericalFailure, Response::END_NUMERICAL_FAILURE, "numerical_failure", Response::ENDED_EARLY},
      {EndReason::kStopCriterion, Response::END_STOP_CRITERION, "stop_criterion", Response::ENDED_EARLY},
      {EndReason::kMaxIncrements, Response::END_MAX_INCREMENTS, "max_increments", Response::ENDED_EARLY},
      {EndReason::kPathEnd, Response::END_PATH_END, "path_end", Response::ENDED_EARLY},
      {EndReason::kStepTooSmall, Response::END_STEP_TOO_SMALL, "step_too_small", Response::ENDED_EARLY},
      {EndReason::kCancelled, Response::END_CANCELLED, "cancelled", Response::ENDED_EARLY},
      {EndReason::kNoSuchBranch, Response::END_NO_SUCH_BRANCH, "no_such_branch", Response::INVALID_REQUEST},
      {EndReason::kClosedPath, Response::END_CLOSED_PATH, "closed_path", Response::ENDED_EARLY},
      {EndReason::kMemoryLimit, Response::END_MEMORY_LIMIT, "memory_limit", Response::ENDED_EARLY},
      {EndReason::kElementInverted, Response::END_ELEMENT_INVERTED, "element_inverted", Response::ENDED_EARLY},
      {EndReason::kNotDetermined, Response::END_NOT_DETERMINED, "not_determined", Response::ENDED_EARLY},
      {EndReason::kAtLimit, Response::END_AT_LIMIT, "at_limit", Response::ENDED_EARLY},
      {EndReason::kNoLanding, Response::END_NO_LANDING, "no_landing", Response::ENDED_EARLY},
  };
  for (const Increment& increment : increments) {
    EXPECT_EQ(ToConstant(increment.reason), increment.constant);
    EXPECT_EQ(EndReasonName(increment.constant), increment.name);
    EXPECT_EQ(StatusOf({increment.reason, "", 0, false}), increment.early);
  }
  EXPECT_EQ(StatusOf({EndReason::kMaxIncrements, "", 0, true}), Response::OK);
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
  const msgs::TraceRequest request = ToMessage(FilledRequest());
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
  expect_same(ThroughTheWire(ToResult<msgs::TraceResult>(response)));
  expect_same(ThroughTheWire(ToResult<msgs::TracePathResult>(response)));
}

}  // namespace
}  // namespace contact_path::convert_test
