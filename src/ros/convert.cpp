#include "contact_path/ros/convert.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <type_traits>
#include <utility>

#include "contact_path/scene/field.h"
#include "contact_path/scene/key_path.h"
#include "contact_path/scene/validate.h"
#include "contact_path/scene/words.h"

namespace contact_path {

template <typename P>
constexpr auto Fields(Of<CriticalPoint>) {
  return std::tuple(Member("index", &P::index), Member("stage", &P::stage), Member("kind", &P::kind),
                    Member("load_factor", &P::load_factor));
}

namespace {

namespace msgs = contact_path_msgs;
using Response = msgs::TracePathResponse;

// The message constants of a type of the core, one pair for each value. Other enumerations are words in messages.
template <typename Value>
constexpr std::nullptr_t kConstants = nullptr;

template <>
constexpr std::pair<ContactState, std::uint8_t> kConstants<ContactState>[] = {
    {ContactState::kOpen, msgs::ContactState::OPEN},
    {ContactState::kStick, msgs::ContactState::STICK},
    {ContactState::kSlipPlus, msgs::ContactState::SLIP_PLUS},
    {ContactState::kSlipMinus, msgs::ContactState::SLIP_MINUS},
    {ContactState::kClosed, msgs::ContactState::CLOSED},
};

template <>
constexpr std::pair<BarState, std::uint8_t> kConstants<BarState>[] = {
    {BarState::kTaut, msgs::Increment::TAUT},
    {BarState::kSlack, msgs::Increment::SLACK},
};

template <>
constexpr std::pair<IncrementKind, std::uint8_t> kConstants<IncrementKind>[] = {
    {IncrementKind::kStart, msgs::Increment::START},
    {IncrementKind::kRegular, msgs::Increment::REGULAR},
    {IncrementKind::kSmoothLimit, msgs::Increment::SMOOTH_LIMIT},
    {IncrementKind::kCornerLimit, msgs::Increment::CORNER_LIMIT},
    {IncrementKind::kContactEvent, msgs::Increment::CONTACT_EVENT},
    {IncrementKind::kBifurcation, msgs::Increment::BIFURCATION},
    {IncrementKind::kSample, msgs::Increment::SAMPLE},
    {IncrementKind::kOnset, msgs::Increment::ONSET},
    {IncrementKind::kJump, msgs::Increment::JUMP},
};

template <>
constexpr std::pair<Method, std::uint8_t> kConstants<Method>[] = {
    {Method::kBranch, msgs::Increment::BRANCH},
    {Method::kMpec, msgs::Increment::MPEC},
};

template <>
constexpr std::pair<EndReason, std::uint8_t> kConstants<EndReason>[] = {
    {EndReason::kNumericalFailure, Response::END_NUMERICAL_FAILURE},
    {EndReason::kStopCriterion, Response::END_STOP_CRITERION},
    {EndReason::kMaxIncrements, Response::END_MAX_INCREMENTS},
    {EndReason::kPathEnd, Response::END_PATH_END},
    {EndReason::kStepTooSmall, Response::END_STEP_TOO_SMALL},
    {EndReason::kCancelled, Response::END_CANCELLED},
    {EndReason::kNoSuchBranch, Response::END_NO_SUCH_BRANCH},
    {EndReason::kClosedPath, Response::END_CLOSED_PATH},
    {EndReason::kMemoryLimit, Response::END_MEMORY_LIMIT},
    {EndReason::kElementInverted, Response::END_ELEMENT_INVERTED},
    {EndReason::kNotDetermined, Response::END_NOT_DETERMINED},
    {EndReason::kAtLimit, Response::END_AT_LIMIT},
    {EndReason::kNoLanding, Response::END_NO_LANDING},
};

template <typename Value>
std::uint8_t ConstantOf(Value value) {
  for (const auto& [known, constant] : kConstants<Value>) {
    if (known == value) return constant;
  }
  throw std::logic_error("a value of the core has no message constant");
}

template <typename Value>
Value ValueOf(std::uint8_t constant, const KeyPath& path) {
  for (const auto& [value, known] : kConstants<Value>) {
    if (known == constant) return value;
  }
  throw std::invalid_argument(path.ToString() + " = " + std::to_string(constant) + ": no known constant");
}

int FromCount(std::uint32_t count, const KeyPath& path) {
  if (count > static_cast<std::uint32_t>(std::numeric_limits<int>::max())) {
    throw std::invalid_argument(path.ToString() + " = " + std::to_string(count) + ": too large");
  }
  return static_cast<int>(count);
}

template <typename T>
constexpr bool kIsEnumList = false;
template <typename T>
constexpr bool kIsEnumList<std::vector<T>> = std::is_enum_v<T>;

// Copies parts of messages to parts of the core, which have fields of the same names. Words that are not known become
// violations; constants that are not known, and counts that are too large, throw std::invalid_argument.
class FromMessages {
 public:
  template <typename From, typename To>
  void Copy(const From& from, const KeyPath& path, To* to) {
    if constexpr (kIsPart<To>) {
      ForEachFieldPair<To, From>([&](const auto& field, const auto& message_field) {
        Copy(from.*message_field.member, path.Key(field.name), &(to->*field.member));
      });
    } else if constexpr (kIsPartList<To> || kIsEnumList<To>) {
      to->resize(from.size());
      for (std::size_t i = 0; i < from.size(); ++i) Copy(from[i], path[i], &(*to)[i]);
    } else if constexpr (std::is_enum_v<To> && std::is_same_v<From, std::string>) {
      CopyWord(from, path, to);
    } else if constexpr (std::is_enum_v<To>) {
      *to = ValueOf<To>(from, path);
    } else if constexpr (std::is_same_v<To, int> && std::is_same_v<From, std::uint32_t>) {
      *to = FromCount(from, path);
    } else if constexpr (std::is_same_v<To, bool>) {
      *to = from != 0;
    } else if constexpr (std::is_same_v<To, std::vector<bool>>) {
      to->assign(from.begin(), from.end());
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
      violations_.push_back({path.ToString(), word, WordRule<Enum>(word)});
    }
  }

  std::vector<Violation> violations_;
};

// Copies parts of the core to parts of messages; words are written out.
template <typename From, typename To>
void CopyToMessage(const From& from, To* to) {
  if constexpr (kIsPart<From>) {
    ForEachFieldPair<From, To>([&](const auto& field, const auto& message_field) {
      CopyToMessage(from.*field.member, &(to->*message_field.member));
    });
  } else if constexpr (kIsPartList<From> || kIsEnumList<From>) {
    to->resize(from.size());
    for (std::size_t i = 0; i < from.size(); ++i) CopyToMessage(from[i], &(*to)[i]);
  } else if constexpr (std::is_enum_v<From> && std::is_same_v<To, std::string>) {
    *to = ToString(from);
  } else if constexpr (std::is_enum_v<From>) {
    *to = ConstantOf(from);
  } else if constexpr (std::is_same_v<From, int> && std::is_same_v<To, std::uint32_t>) {
    *to = static_cast<std::uint32_t>(from);
  } else if constexpr (std::is_same_v<From, std::vector<bool>>) {
    to->assign(from.begin(), from.end());
  } else {
    *to = from;
  }
}

constexpr std::pair<double Residuals::*, double msgs::Increment::*> kResiduals[] = {
    {&Residuals::equilibrium, &msgs::Increment::equilibrium_residual},
    {&Residuals::penetration, &msgs::Increment::penetration_residual},
    {&Residuals::tensile_reaction, &msgs::Increment::tensile_reaction_residual},
    {&Residuals::complementarity, &msgs::Increment::min_form_residual},
    {&Residuals::cone, &msgs::Increment::cone_residual},
    {&Residuals::friction_law, &msgs::Increment::friction_law_residual},
    {&Residuals::support, &msgs::Increment::support_residual}};

}  // namespace

TraceRequest FromMessage(const msgs::TraceRequest& message) {
  TraceRequest request;
  FromMessages from;
  from.Copy(message, KeyPath(), &request);
  if (!from.violations().empty()) throw InvalidRequest(from.violations());
  return request;
}

msgs::TraceRequest ToMessage(const TraceRequest& request) {
  msgs::TraceRequest message;
  CopyToMessage(request, &message);
  return message;
}

msgs::Increment ToMessage(const Increment& increment, int full_state_every) {
  msgs::Increment message;
  CopyToMessage(increment, &message);
  CopyToMessage(increment.solve, &message);
  CopyToMessage(increment.stability, &message);
  CopyToMessage(increment.jump, &message);
  if (increment.kind != IncrementKind::kRegular || increment.index % std::max(full_state_every, 1) == 0) {
    message.x.reserve(increment.positions.size() / 2);
    message.y.reserve(increment.positions.size() / 2);
    for (std::size_t i = 0; i + 1 < increment.positions.size(); i += 2) {
      message.x.push_back(increment.positions[i]);
      message.y.push_back(increment.positions[i + 1]);
    }
    message.rotation = increment.rotations;
    CopyToMessage(increment.contacts, &message.contacts);
  } else {
    message.sections.clear();
    message.stresses.clear();
    message.pressures.clear();
    message.widths.clear();
    message.inner = msgs::InnerState();
  }
  for (const auto& [of, in] : kResiduals) message.*in = increment.residuals.*of;
  message.complementarity_residual = increment.residuals.Contact();
  message.solve_time = increment.solve.time;
  return message;
}

Increment FromMessage(const msgs::Increment& message) {
  if (message.x.size() != message.y.size()) {
    throw std::invalid_argument("x has " + std::to_string(message.x.size()) + " numbers, y has " +
                                std::to_string(message.y.size()));
  }
  Increment increment;
  FromMessages from;
  from.Copy(message, KeyPath(), &increment);
  from.Copy(message, KeyPath(), &increment.solve);
  from.Copy(message, KeyPath(), &increment.stability);
  from.Copy(message, KeyPath(), &increment.jump);
  if (!from.violations().empty()) {
    const Violation& wrong = from.violations().front();
    throw std::invalid_argument(wrong.key + " = " + wrong.value + ": " + wrong.rule);
  }
  from.Copy(message.contacts, KeyPath("contacts"), &increment.contacts);
  for (std::size_t i = 0; i < message.x.size(); ++i) {
    increment.positions.push_back(message.x[i]);
    increment.positions.push_back(message.y[i]);
  }
  increment.rotations = message.rotation;
  for (const auto& [of, in] : kResiduals) increment.residuals.*of = message.*in;
  increment.solve.time = message.solve_time;
  return increment;
}

std::vector<msgs::LimitPoint> ToMessages(const std::vector<CriticalPoint>& points) {
  std::vector<msgs::LimitPoint> messages;
  CopyToMessage(points, &messages);
  return messages;
}

std::uint8_t ToConstant(EndReason reason) { return ConstantOf(reason); }

std::string EndReasonName(std::uint8_t end_reason) {
  if (end_reason == Response::END_NONE) return "";
  if (end_reason == Response::END_TIME_LIMIT) return "time_limit";
  return std::string(ToString(ValueOf<EndReason>(end_reason, KeyPath("end_reason"))));
}

std::string EndMessage(const std::string& name, const std::string& why, const PathSummary& path,
                       const std::string& bag) {
  return path.ToText(name, why) + "; bag " + bag;
}

std::uint8_t StatusOf(const TraceResult& result) {
  if (result.reason == EndReason::kNoSuchBranch) return Response::INVALID_REQUEST;
  return result.reached ? Response::OK : Response::ENDED_EARLY;
}

}  // namespace contact_path
