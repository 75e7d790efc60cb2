#include "contact_path/ros/convert.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include "contact_path/scene/field.h"
#include "contact_path/scene/key_path.h"
#include "contact_path/scene/validate.h"
#include "contact_path/scene/words.h"

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

constexpr Table<EndReason, 9> kEndReasons{{
    {EndReason::kNumericalFailure, Response::END_NUMERICAL_FAILURE},
    {EndReason::kStopCriterion, Response::END_STOP_CRITERION},
    {EndReason::kMaxIncrements, Response::END_MAX_INCREMENTS},
    {EndReason::kPathEnd, Response::END_PATH_END},
    {EndReason::kStepTooSmall, Response::END_STEP_TOO_SMALL},
    {EndReason::kCancelled, Response::END_CANCELLED},
    {EndReason::kNoSuchBranch, Response::END_NO_SUCH_BRANCH},
    {EndReason::kClosedPath, Response::END_CLOSED_PATH},
    {EndReason::kMemoryLimit, Response::END_MEMORY_LIMIT},
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

// "event.branches[3].states".
std::string Key(const std::string& list, std::size_t index, const std::string& field) {
  return list + "[" + std::to_string(index) + "]." + field;
}

// Copies parts of messages to parts of the core, which have fields of the same names. Words that are not known become
// violations.
class FromMessages {
 public:
  template <typename From, typename To>
  void Copy(const From& from, const KeyPath& path, To* to) {
    if constexpr (kIsPart<To>) {
      ForEachFieldPair<To, From>([&](const auto& field, const auto& message_field) {
        Copy(from.*message_field.member, path.Key(field.name), &(to->*field.member));
      });
    } else if constexpr (kIsPartList<To>) {
      to->resize(from.size());
      for (std::size_t i = 0; i < from.size(); ++i) Copy(from[i], path[i], &(*to)[i]);
    } else if constexpr (std::is_enum_v<To>) {
      CopyWord(from, path, to);
    } else if constexpr (std::is_same_v<To, bool>) {
      *to = from != 0;
    } else {
      *to = from;
    }
  }

  const std::vector<Violation>& violations() const { return violations_; }

 private:
  template <typename Enum>
  void CopyWord(const std::string& word, const KeyPath& path, Enum* to) {
    if (const std::optional<Enum> value = ParseWord<Enum>(word)) {
      *to = *value;
    } else if (violations_.size() < kMostViolations) {
      Violation& violation = violations_.emplace_back();
      violation.key = path.ToString();
      violation.value = word;
      violation.rule = WordRule<Enum>(word);
    }
  }

  std::vector<Violation> violations_;
};

// The other way round; words are written out.
template <typename From, typename To>
void CopyToMessage(const From& from, To* to) {
  if constexpr (kIsPart<From>) {
    ForEachFieldPair<From, To>([&](const auto& field, const auto& message_field) {
      CopyToMessage(from.*field.member, &(to->*message_field.member));
    });
  } else if constexpr (kIsPartList<From>) {
    to->resize(from.size());
    for (std::size_t i = 0; i < from.size(); ++i) CopyToMessage(from[i], &(*to)[i]);
  } else if constexpr (std::is_enum_v<From>) {
    *to = ToString(from);
  } else {
    *to = from;
  }
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
  message.taken = ToCount(event.taken);
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
  event.taken = FromCount(message.taken, "event.taken");
  event.weakly_active = FromCount(message.weakly_active, "event.weakly_active");
  event.complete = message.complete != 0;
  event.null_vector = message.null_vector;
  return event;
}

}  // namespace

TraceRequest FromMessage(const msgs::Scene& scene, const msgs::TraceOptions& options,
                         const std::vector<msgs::Stage>& program) {
  TraceRequest request;
  FromMessages from;
  from.Copy(scene, KeyPath("scene"), &request.scene);
  from.Copy(options, KeyPath("options"), &request.options);
  from.Copy(program, KeyPath("program"), &request.program);
  if (!from.violations().empty()) throw InvalidRequest(from.violations());
  return request;
}

msgs::TraceRequest ToMessage(const TraceRequest& request) {
  msgs::TraceRequest message;
  CopyToMessage(request, &message);
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
  return std::string(ToString(ValueOf(kEndReasons, end_reason, "end_reason")));
}

std::string EndMessage(const std::string& name, const std::string& why, const PathSummary& path,
                       const std::string& bag) {
  return path.ToText(name, why) + "; bag " + bag;
}

std::uint8_t StatusOf(EndReason reason) {
  if (reason == EndReason::kNoSuchBranch) return Response::INVALID_REQUEST;
  return IsComplete(reason) ? Response::OK : Response::ENDED_EARLY;
}

msgs::TraceResult ToResult(const msgs::TracePathResponse& response) { return SameResult<msgs::TraceResult>(response); }

msgs::TracePathResult ToActionResult(const msgs::TracePathResponse& response) {
  return SameResult<msgs::TracePathResult>(response);
}

}  // namespace contact_path
