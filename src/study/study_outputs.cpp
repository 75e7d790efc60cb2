#include "contact_path/study/study_outputs.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "contact_path/path/csv.h"
#include "contact_path/path/stop.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/quantity.h"
#include "contact_path/scene/text.h"

namespace contact_path {
namespace {

std::string TextOf(double number) { return RoundedText(number, std::numeric_limits<double>::max_digits10); }

std::string Joined(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : " ") + TextOf(number);
  return text;
}

constexpr std::string_view kState = "state_";
constexpr std::string_view kSolveTime = "solve_time";

[[noreturn]] void Reject(const std::string& rule) { throw std::invalid_argument(rule); }

// What to say of a node or contact that the scene does not have.
std::string UnknownPart(const SpelledQuantity& quantity, const Scene& scene) {
  return "must be of " + PartOf(quantity.kind) + NearestPart(quantity, scene).Question();
}

std::string UnknownColumn(const std::string& name) {
  NearestName nearest(name);
  for (const CsvColumn& column : kCsvColumns)
    if (column.name != kSolveTime) nearest.Offer(column.name);
  return "must be a column of the CSV, as load_factor, x_<node> or rn_<contact>" + nearest.Question();
}

}  // namespace

StudyOutputs::StudyOutputs(const std::vector<std::string>& names, const TraceRequest& request) {
  constexpr std::pair<std::string_view, Kind> kOfPath[] = {{"limit_loads", Kind::kLimitLoads},
                                                           {"events", Kind::kEvents},
                                                           {"jumps", Kind::kJumps},
                                                           {"released", Kind::kReleased},
                                                           {"stable_range", Kind::kStableRange},
                                                           {"end_reason", Kind::kEndReason}};
  constexpr std::pair<std::string_view, Kind> kOfColumn[] = {
      {"final.", Kind::kFinal}, {"max.", Kind::kMax}, {"min.", Kind::kMin}};
  const ExpandedRequest expanded(request);
  const SceneIndex index(expanded.Get().scene);

  const auto make = [&](const std::string& name) -> Output {
    NearestName nearest(name);
    for (const auto& [word, kind] : kOfPath) {
      if (name == word) return {kind, {}, {}, {}};
      nearest.Offer(word);
    }
    for (const auto& [prefix, kind] : kOfColumn) {
      if (name.compare(0, prefix.size(), prefix) != 0) continue;
      PathColumn column(name.substr(prefix.size()), expanded.Get(), index);
      if (kind != Kind::kFinal && !column.IsNumber())
        throw std::invalid_argument("must be of a column of numbers, or begin with final.");
      return {kind, std::move(column), {}, {}};
    }
    throw std::invalid_argument(
        "must be limit_loads, events, jumps, released, stable_range, end_reason, final.<column>, max.<column> or "
        "min.<column>" +
        nearest.Question());
  };
  outputs_.reserve(names.size());
  for (const std::string& name : names) {
    try {
      outputs_.push_back(make(name));
    } catch (const std::invalid_argument& error) {
      throw UnknownOutput(outputs_.size(), error.what());
    }
  }
}

LongLists StudyOutputs::lists() const {
  LongLists lists;
  for (const Output& output : outputs_)
    if (output.column) lists.Add(output.column->lists());
  return lists;
}

void StudyOutputs::Add(const Increment& increment) {
  if (increment.kind == IncrementKind::kJump) released_.push_back(increment.jump.energy_released);
  if (!stable_range_ && increment.stability.stability == Verdict::kUnstable) {
    // An arc that is unstable inside is so from its beginning on.
    const bool inside = increment.kind == IncrementKind::kRegular && summary_.increments() > 0;
    stable_range_ = inside ? load_before_ : increment.load_factor;
  }
  load_before_ = increment.load_factor;
  summary_.Add(increment);
  for (Output& output : outputs_) {
    if (!output.column) continue;
    if (!output.column->IsNumber()) {
      output.word = output.column->Word(increment);
      continue;
    }
    const double number = output.column->Number(increment);
    if (output.kind == Kind::kFinal || !output.number) {
      output.number = number;
    } else {
      output.number = output.kind == Kind::kMax ? std::max(*output.number, number) : std::min(*output.number, number);
    }
  }
}

std::string StudyOutputs::Text(const Output& output, EndReason reason) const {
  switch (output.kind) {
    case Kind::kEndReason: return std::string(ToString(reason));
    case Kind::kEvents: return summary_.increments() == 0 ? "" : std::to_string(summary_.events());
    case Kind::kJumps: return summary_.increments() == 0 ? "" : std::to_string(summary_.jumps());
    case Kind::kReleased: return Joined(released_);
    case Kind::kStableRange: return stable_range_ ? TextOf(*stable_range_) : "";
    case Kind::kLimitLoads: {
      std::vector<double> loads;
      for (const CriticalPoint& point : summary_.limit_points()) loads.push_back(point.load_factor);
      return Joined(loads);
    }
    case Kind::kFinal:
    case Kind::kMax:
    case Kind::kMin: return output.number ? TextOf(*output.number) : output.word;
  }
  return "";
}

std::vector<std::string> StudyOutputs::Texts(EndReason reason) const {
  std::vector<std::string> texts;
  texts.reserve(outputs_.size());
  for (const Output& output : outputs_) texts.push_back(Text(output, reason));
  return texts;
}

PathColumn::PathColumn(const std::string& name, const TraceRequest& request, const SceneIndex& index) {
  const Scene& scene = request.scene;
  if (name == "stage" && request.program.empty()) Reject("must be of a scene with a program");
  if (name == "landing_robust" && !request.options.landing_checks) Reject("must be of a trace with landing_checks");
  if (name == kSolveTime) Reject("must be the same whenever it is computed: solve_time is not");
  for (const CsvColumn& column : kCsvColumns) {
    if (name != column.name) continue;
    if (column.number != nullptr) number_ = column.number;
    if (column.word != nullptr) word_ = column.word;
  }
  if (number_ != nullptr || word_ != nullptr) return;

  if (name.compare(0, kState.size(), kState) == 0) {
    const std::string contact = name.substr(kState.size());
    const std::optional<std::size_t> place = index.FindContact(contact);
    if (!place) Reject(UnknownPart({Quantity::Kind::kGap, contact}, scene));
    word_ = [place = *place](const Increment& increment) { return ToString(increment.contacts[place].state); };
    return;
  }
  const std::optional<SpelledQuantity> spelled = ReadQuantity(name);
  if (!spelled) Reject(UnknownColumn(name));
  const std::optional<Quantity> quantity = FindQuantity(name, index);
  if (!quantity) Reject(UnknownPart(*spelled, scene));
  if (quantity->kind == Quantity::Kind::kRotation && !NodesThatTurn(scene)[quantity->part])
    Reject("must be of a node that a beam turns");
  lists_.Add(*quantity);
  if (quantity->IsOfObstacle())
    number_ = [quantity = *quantity, request](const Increment& increment) {
      return ValueOf(quantity, increment, request);
    };
  else
    number_ = [quantity = *quantity](const Increment& increment) { return ValueOf(quantity, increment); };
}

}  // namespace contact_path
