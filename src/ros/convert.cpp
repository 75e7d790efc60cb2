#include "contact_path/ros/convert.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "contact_path/scene/validate.h"

namespace contact_path {
namespace {

namespace msgs = contact_path_msgs;
using Response = msgs::TracePathResponse;

// A type of the core and the message constants of its values, one pair each.
template <typename Value, std::size_t kSize>
using Table = std::array<std::pair<Value, std::uint8_t>, kSize>;

constexpr Table<ContactState, 5> kContactStates{{
    {ContactState::kOpen, msgs::ContactState::OPEN},
    {ContactState::kStick, msgs::ContactState::STICK},
    {ContactState::kSlipPlus, msgs::ContactState::SLIP_PLUS},
    {ContactState::kSlipMinus, msgs::ContactState::SLIP_MINUS},
    {ContactState::kClosed, msgs::ContactState::CLOSED},
}};

constexpr Table<IncrementKind, 6> kIncrementKinds{{
    {IncrementKind::kStart, msgs::Increment::START},
    {IncrementKind::kRegular, msgs::Increment::REGULAR},
    {IncrementKind::kSmoothLimit, msgs::Increment::SMOOTH_LIMIT},
    {IncrementKind::kCornerLimit, msgs::Increment::CORNER_LIMIT},
    {IncrementKind::kContactEvent, msgs::Increment::CONTACT_EVENT},
    {IncrementKind::kBifurcation, msgs::Increment::BIFURCATION},
}};

constexpr Table<Method, 2> kMethods{{
    {Method::kBranch, msgs::Increment::BRANCH},
    {Method::kMpec, msgs::Increment::MPEC},
}};

constexpr Table<EndReason, 6> kEndReasons{{
    {EndReason::kNumericalFailure, Response::END_NUMERICAL_FAILURE},
    {EndReason::kStopCriterion, Response::END_STOP_CRITERION},
    {EndReason::kMaxIncrements, Response::END_MAX_INCREMENTS},
    {EndReason::kPathEnd, Response::END_PATH_END},
    {EndReason::kStepTooSmall, Response::END_STEP_TOO_SMALL},
    {EndReason::kCancelled, Response::END_CANCELLED},
}};

template <typename Value, std::size_t kSize>
std::uint8_t ConstantOf(const Table<Value, kSize>& table, Value value) {
  for (const auto& [known, constant] : table) {
    if (known == value) return constant;
  }
  throw std::logic_error("a value of the core has no message constant");
}

template <typename Value, std::size_t kSize>
Value ValueOf(const Table<Value, kSize>& table, std::uint8_t constant, const std::string& field) {
  for (const auto& [value, known] : table) {
    if (known == constant) return value;
  }
  throw std::invalid_argument(field + " = " + std::to_string(constant) + ": no known constant");
}

std::uint32_t ToCount(int count) { return static_cast<std::uint32_t>(count); }

int FromCount(std::uint32_t count, const std::string& field) {
  if (count > static_cast<std::uint32_t>(std::numeric_limits<int>::max())) {
    throw std::invalid_argument(field + " = " + std::to_string(count) + ": too large");
  }
  return static_cast<int>(count);
}

// The word's value; for a word that is not known the default, and a violation.
template <typename Value>
Value Known(std::optional<Value> parsed, const std::string& key, const std::string& word, const std::string& rule,
            std::vector<Violation>* violations) {
  if (parsed) return *parsed;
  if (violations->size() >= kMostViolations) return Value{};
  Violation violation;
  violation.key = key;
  violation.value = word;
  violation.rule = rule;
  violations->push_back(violation);
  return Value{};
}

std::string Key(const std::string& list, std::size_t index, const std::string& field) {
  return list + "[" + std::to_string(index) + "]." + field;
}

template <typename Request>
msgs::TraceRequest SameRequest(const Request& request) {
  msgs::TraceRequest same;
  same.scene = request.scene;
  same.options = request.options;
  same.program = request.program;
  same.resume = request.resume;
  return same;
}

template <typename Result>
Result SameResult(const msgs::TracePathResponse& response) {
  Result result;
  result.status = response.status;
  result.message = response.message;
  result.increments = response.increments;
  result.end_reason = response.end_reason;
  result.end_reason_name = response.end_reason_name;
  result.bag = response.bag;
  result.limit_points = response.limit_points;
  return result;
}

msgs::Event ToMessage(const EventRecord& event) {
  msgs::Event message;
  for (const BranchRecord& branch : event.branches) {
    msgs::Branch& to = message.branches.emplace_back();
    for (const ContactState state : branch.states) to.states.push_back(ConstantOf(kContactStates, state));
    to.load_rate = branch.load_rate;
    to.dissipation_rate = branch.dissipation_rate;
    to.turn = branch.turn;
  }
  message.number = ToCount(event.number);
  message.taken = event.taken;
  message.weakly_active = ToCount(event.weakly_active);
  message.complete = event.complete;
  message.null_vector = event.null_vector;
  return message;
}

EventRecord FromMessage(const msgs::Event& message) {
  EventRecord event;
  for (std::size_t i = 0; i < message.branches.size(); ++i) {
    const msgs::Branch& branch = message.branches[i];
    BranchRecord& to = event.branches.emplace_back();
    for (const std::uint8_t state : branch.states) {
      to.states.push_back(ValueOf(kContactStates, state, Key("event.branches", i, "states")));
    }
    to.load_rate = branch.load_rate;
    to.dissipation_rate = branch.dissipation_rate;
    to.turn = branch.turn;
  }
  event.number = FromCount(message.number, "event.number");
  event.taken = message.taken;
  event.weakly_active = FromCount(message.weakly_active, "event.weakly_active");
  event.complete = message.complete != 0;
  event.null_vector = message.null_vector;
  return event;
}

std::vector<Load> FromMessages(const std::vector<msgs::Load>& loads) {
  std::vector<Load> result;
  result.reserve(loads.size());
  for (const msgs::Load& load : loads) result.push_back({load.node, load.fx, load.fy, load.constant != 0});
  return result;
}

std::vector<SupportMotion> FromMessages(const std::vector<msgs::SupportMotion>& motions) {
  std::vector<SupportMotion> result;
  result.reserve(motions.size());
  for (const msgs::SupportMotion& motion : motions) result.push_back({motion.node, motion.dx, motion.dy});
  return result;
}

std::vector<ObstacleMotion> FromMessages(const std::vector<msgs::ObstacleMotion>& motions) {
  std::vector<ObstacleMotion> result;
  result.reserve(motions.size());
  for (const msgs::ObstacleMotion& motion : motions) result.push_back({motion.obstacle, motion.dx, motion.dy});
  return result;
}

std::vector<msgs::Load> ToMessages(const std::vector<Load>& loads) {
  std::vector<msgs::Load> result;
  for (const Load& load : loads) {
    msgs::Load& to = result.emplace_back();
    to.node = load.node;
    to.fx = load.fx;
    to.fy = load.fy;
    to.constant = load.constant;
  }
  return result;
}

std::vector<msgs::SupportMotion> ToMessages(const std::vector<SupportMotion>& motions) {
  std::vector<msgs::SupportMotion> result;
  for (const SupportMotion& motion : motions) {
    msgs::SupportMotion& to = result.emplace_back();
    to.node = motion.node;
    to.dx = motion.dx;
    to.dy = motion.dy;
  }
  return result;
}

std::vector<msgs::ObstacleMotion> ToMessages(const std::vector<ObstacleMotion>& motions) {
  std::vector<msgs::ObstacleMotion> result;
  for (const ObstacleMotion& motion : motions) {
    msgs::ObstacleMotion& to = result.emplace_back();
    to.obstacle = motion.obstacle;
    to.dx = motion.dx;
    to.dy = motion.dy;
  }
  return result;
}

}  // namespace

TraceRequest FromMessage(const msgs::Scene& scene, const msgs::TraceOptions& options,
                         const std::vector<msgs::Stage>& program) {
  TraceRequest request;
  std::vector<Violation> violations;

  request.scene.name = scene.name;
  for (const msgs::Node& node : scene.nodes) {
    request.scene.nodes.push_back({node.name, node.x, node.y, node.fixed_x != 0, node.fixed_y != 0});
  }
  for (std::size_t i = 0; i < scene.bars.size(); ++i) {
    const msgs::Bar& bar = scene.bars[i];
    const StrainMeasure strain = Known(ParseStrainMeasure(bar.strain), Key("scene.bars", i, "strain"), bar.strain,
                                       "must be biot, green_lagrange or logarithmic", &violations);
    request.scene.bars.push_back({bar.nodes, bar.EA, bar.rest_length, strain});
  }
  for (const msgs::Superelement& superelement : scene.superelements) {
    request.scene.superelements.push_back({superelement.nodes, superelement.stiffness, superelement.rest_positions});
  }
  request.scene.loads = FromMessages(scene.loads);
  for (std::size_t i = 0; i < scene.obstacles.size(); ++i) {
    const msgs::Obstacle& obstacle = scene.obstacles[i];
    const ObstacleShape shape = Known(ParseObstacleShape(obstacle.shape), Key("scene.obstacles", i, "shape"),
                                      obstacle.shape, "must be half_plane", &violations);
    request.scene.obstacles.push_back(
        {obstacle.name, shape, obstacle.px, obstacle.py, obstacle.nx, obstacle.ny, obstacle.friction});
  }
  for (const msgs::Contact& contact : scene.contacts) {
    request.scene.contacts.push_back({contact.node, contact.obstacle});
  }
  request.scene.support_motions = FromMessages(scene.support_motions);
  request.scene.obstacle_motions = FromMessages(scene.obstacle_motions);

  request.options.method =
      Known(ParseMethod(options.method), "options.method", options.method, "must be branch or mpec", &violations);
  request.options.accuracy = Known(ParseAccuracy(options.accuracy), "options.accuracy", options.accuracy,
                                   "must be fast, balanced or accurate", &violations);
  request.options.direction = options.direction;
  request.options.step = options.step;
  request.options.max_increments = options.max_increments;
  request.options.full_state_every = options.full_state_every;
  for (const msgs::StopCriterion& stop : options.stop) {
    request.options.stop.push_back({stop.quantity, stop.when, stop.value});
  }
  for (const msgs::BranchChoice& choice : options.branch_choices) {
    request.options.branch_choices.push_back({choice.event, choice.increment, choice.branch});
  }

  for (const msgs::Stage& stage : program)
    request.program.push_back({stage.name, FromMessages(stage.loads), FromMessages(stage.support_motions),
                               FromMessages(stage.obstacle_motions), stage.target});

  if (!violations.empty()) throw InvalidRequest(violations);
  return request;
}

msgs::TraceRequest ToMessage(const TraceRequest& request) {
  msgs::TraceRequest message;
  message.scene.name = request.scene.name;
  for (const Node& node : request.scene.nodes) {
    msgs::Node& to = message.scene.nodes.emplace_back();
    to.name = node.name;
    to.x = node.x;
    to.y = node.y;
    to.fixed_x = node.fixed_x;
    to.fixed_y = node.fixed_y;
  }
  for (const Bar& bar : request.scene.bars) {
    msgs::Bar& to = message.scene.bars.emplace_back();
    to.nodes = bar.nodes;
    to.EA = bar.EA;
    to.rest_length = bar.rest_length;
    to.strain = ToString(bar.strain);
  }
  for (const Superelement& superelement : request.scene.superelements) {
    msgs::Superelement& to = message.scene.superelements.emplace_back();
    to.nodes = superelement.nodes;
    to.stiffness = superelement.stiffness;
    to.rest_positions = superelement.rest_positions;
  }
  message.scene.loads = ToMessages(request.scene.loads);
  for (const Obstacle& obstacle : request.scene.obstacles) {
    msgs::Obstacle& to = message.scene.obstacles.emplace_back();
    to.name = obstacle.name;
    to.shape = ToString(obstacle.shape);
    to.px = obstacle.px;
    to.py = obstacle.py;
    to.nx = obstacle.nx;
    to.ny = obstacle.ny;
    to.friction = obstacle.friction;
  }
  for (const ContactCandidate& contact : request.scene.contacts) {
    msgs::Contact& to = message.scene.contacts.emplace_back();
    to.node = contact.node;
    to.obstacle = contact.obstacle;
  }
  message.scene.support_motions = ToMessages(request.scene.support_motions);
  message.scene.obstacle_motions = ToMessages(request.scene.obstacle_motions);
  message.options.method = ToString(request.options.method);
  message.options.accuracy = ToString(request.options.accuracy);
  message.options.direction = request.options.direction;
  message.options.step = request.options.step;
  message.options.max_increments = request.options.max_increments;
  message.options.full_state_every = request.options.full_state_every;
  for (const StopCriterion& stop : request.options.stop) {
    msgs::StopCriterion& to = message.options.stop.emplace_back();
    to.quantity = stop.quantity;
    to.when = stop.when;
    to.value = stop.value;
  }
  for (const BranchChoice& choice : request.options.branch_choices) {
    msgs::BranchChoice& to = message.options.branch_choices.emplace_back();
    to.event = choice.event;
    to.increment = choice.increment;
    to.branch = choice.branch;
  }
  for (const Stage& stage : request.program) {
    msgs::Stage& to = message.program.emplace_back();
    to.name = stage.name;
    to.loads = ToMessages(stage.loads);
    to.support_motions = ToMessages(stage.support_motions);
    to.obstacle_motions = ToMessages(stage.obstacle_motions);
    to.target = stage.target;
  }
  return message;
}

msgs::TraceRequest ToRequest(const msgs::TracePathRequest& request) { return SameRequest(request); }

msgs::TraceRequest ToRequest(const msgs::TracePathGoal& goal) { return SameRequest(goal); }

msgs::Increment ToMessage(const Increment& increment, int full_state_every) {
  msgs::Increment message;
  message.index = ToCount(increment.index);
  message.stage = ToCount(increment.stage);
  message.load_factor = increment.load_factor;
  message.arc_length = increment.arc_length;
  message.kind = ConstantOf(kIncrementKinds, increment.kind);
  if (increment.kind != IncrementKind::kRegular || increment.index % std::max(full_state_every, 1) == 0) {
    message.x.reserve(increment.positions.size() / 2);
    message.y.reserve(increment.positions.size() / 2);
    for (std::size_t i = 0; i + 1 < increment.positions.size(); i += 2) {
      message.x.push_back(increment.positions[i]);
      message.y.push_back(increment.positions[i + 1]);
    }
    message.contacts.reserve(increment.contacts.size());
    for (const ContactRecord& contact : increment.contacts) {
      msgs::ContactState& to = message.contacts.emplace_back();
      to.gap = contact.gap;
      to.rn = contact.rn;
      to.rt = contact.rt;
      to.state = ConstantOf(kContactStates, contact.state);
    }
  }
  message.dissipation = increment.dissipation;
  message.strain_energy = increment.strain_energy;
  message.external_work = increment.external_work;
  message.equilibrium_residual = increment.residuals.equilibrium;
  message.penetration_residual = increment.residuals.penetration;
  message.tensile_reaction_residual = increment.residuals.tensile_reaction;
  message.min_form_residual = increment.residuals.complementarity;
  message.cone_residual = increment.residuals.cone;
  message.friction_law_residual = increment.residuals.friction_law;
  message.complementarity_residual = increment.residuals.Contact();
  message.support_residual = increment.residuals.support;
  message.method = ConstantOf(kMethods, increment.solve.method);
  message.regularisation = increment.solve.regularisation;
  message.exact = increment.solve.exact;
  message.iterations = ToCount(increment.solve.iterations);
  message.variables = ToCount(increment.solve.variables);
  message.constraints = ToCount(increment.solve.constraints);
  message.rejected = ToCount(increment.solve.rejected);
  message.factorisations = ToCount(increment.solve.factorisations);
  message.nullity = ToCount(increment.solve.nullity);
  message.determinant_sign = increment.solve.determinant_sign;
  message.stiffness_sign = increment.solve.stiffness_sign;
  message.contraction = increment.solve.contraction;
  message.next_step = increment.solve.next_step;
  message.gamma2_factor = increment.solve.gamma2_factor;
  message.solve_time = increment.solve.time;
  message.event = ToMessage(increment.event);
  return message;
}

Increment FromMessage(const msgs::Increment& message) {
  if (message.x.size() != message.y.size()) {
    throw std::invalid_argument("x has " + std::to_string(message.x.size()) + " numbers, y has " +
                                std::to_string(message.y.size()));
  }
  Increment increment;
  increment.index = FromCount(message.index, "index");
  increment.stage = FromCount(message.stage, "stage");
  increment.load_factor = message.load_factor;
  increment.arc_length = message.arc_length;
  increment.kind = ValueOf(kIncrementKinds, message.kind, "kind");
  for (std::size_t i = 0; i < message.x.size(); ++i) {
    increment.positions.push_back(message.x[i]);
    increment.positions.push_back(message.y[i]);
  }
  for (std::size_t i = 0; i < message.contacts.size(); ++i) {
    const msgs::ContactState& contact = message.contacts[i];
    const ContactState state = ValueOf(kContactStates, contact.state, Key("contacts", i, "state"));
    increment.contacts.push_back({contact.gap, contact.rn, contact.rt, state});
  }
  increment.dissipation = message.dissipation;
  increment.strain_energy = message.strain_energy;
  increment.external_work = message.external_work;
  increment.residuals.equilibrium = message.equilibrium_residual;
  increment.residuals.penetration = message.penetration_residual;
  increment.residuals.tensile_reaction = message.tensile_reaction_residual;
  increment.residuals.complementarity = message.min_form_residual;
  increment.residuals.cone = message.cone_residual;
  increment.residuals.friction_law = message.friction_law_residual;
  increment.residuals.support = message.support_residual;
  increment.solve.method = ValueOf(kMethods, message.method, "method");
  increment.solve.regularisation = message.regularisation;
  increment.solve.exact = message.exact != 0;
  increment.solve.iterations = FromCount(message.iterations, "iterations");
  increment.solve.variables = FromCount(message.variables, "variables");
  increment.solve.constraints = FromCount(message.constraints, "constraints");
  increment.solve.rejected = FromCount(message.rejected, "rejected");
  increment.solve.factorisations = FromCount(message.factorisations, "factorisations");
  increment.solve.nullity = FromCount(message.nullity, "nullity");
  increment.solve.determinant_sign = message.determinant_sign;
  increment.solve.stiffness_sign = message.stiffness_sign;
  increment.solve.contraction = message.contraction;
  increment.solve.next_step = message.next_step;
  increment.solve.gamma2_factor = message.gamma2_factor;
  increment.solve.time = message.solve_time;
  increment.event = FromMessage(message.event);
  return increment;
}

std::vector<msgs::LimitPoint> ToMessages(const std::vector<LimitPoint>& points) {
  std::vector<msgs::LimitPoint> messages;
  messages.reserve(points.size());
  for (const LimitPoint& point : points) {
    msgs::LimitPoint& to = messages.emplace_back();
    to.index = ToCount(point.index);
    to.stage = ToCount(point.stage);
    to.kind = ConstantOf(kIncrementKinds, point.kind);
    to.load_factor = point.load_factor;
  }
  return messages;
}

std::uint8_t ToConstant(EndReason reason) { return ConstantOf(kEndReasons, reason); }

std::string EndReasonName(std::uint8_t end_reason) {
  if (end_reason == Response::END_NONE) return "";
  if (end_reason == Response::END_TIME_LIMIT) return "time_limit";
  if (end_reason == Response::END_MEMORY_LIMIT) return "memory_limit";
  return std::string(ToString(ValueOf(kEndReasons, end_reason, "end_reason")));
}

std::string EndMessage(const std::string& name, const std::string& why, const PathSummary& path,
                       const std::string& bag) {
  return path.ToText(name, why) + "; bag " + bag;
}

std::uint8_t StatusOf(EndReason reason) {
  const bool as_asked = reason == EndReason::kStopCriterion || reason == EndReason::kMaxIncrements;
  return as_asked ? Response::OK : Response::ENDED_EARLY;
}

msgs::TraceResult ToResult(const msgs::TracePathResponse& response) { return SameResult<msgs::TraceResult>(response); }

msgs::TracePathResult ToActionResult(const msgs::TracePathResponse& response) {
  return SameResult<msgs::TracePathResult>(response);
}

}  // namespace contact_path
