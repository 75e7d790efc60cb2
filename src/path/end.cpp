#include "contact_path/path/end.h"

#include <algorithm>
#include <utility>

#include "contact_path/scene/text.h"

namespace contact_path {
namespace {

std::string TextOf(const Number& number, int digits = 2) {
  if (const long* count = std::get_if<long>(&number)) return std::to_string(*count);
  return RoundedText(std::get<double>(number), digits);
}

}  // namespace

std::string EndText(const Causes& causes) {
  std::string text;
  for (const Cause& cause : causes) {
    if (!text.empty()) text += text.back() == ':' ? " " : "; ";
    std::string sentence(cause.sentence);
    for (const auto& [mark, words] :
         {std::pair<std::string, std::string>("<unknown>", "is not known: its value is <value>, its error <other>"),
          {"<value>", TextOf(cause.value)},
          {"<other>", TextOf(cause.other)},
          {"<digits>", TextOf(cause.value, 6)},
          {"<name>", cause.name}})
      if (const std::size_t at = sentence.find(mark); at != std::string::npos) sentence.replace(at, mark.size(), words);
    text += sentence;
  }
  return text;
}

std::string Listed(const std::vector<std::string>& parts, std::size_t most, std::string_view behind) {
  std::string text;
  for (std::size_t i = 0; i < std::min(parts.size(), most); ++i) text += (i == 0 ? "" : ", ") + parts[i];
  if (parts.size() > most) text.append(behind).append("and " + std::to_string(parts.size() - most) + " more");
  return text;
}

bool IsNumerical(EndReason reason) {
  return reason == EndReason::kStepTooSmall || reason == EndReason::kNotDetermined ||
         reason == EndReason::kNumericalFailure;
}

bool IsStuck(EndReason reason) {
  return reason == EndReason::kPathEnd || reason == EndReason::kStepTooSmall || reason == EndReason::kNotDetermined;
}

bool IsReached(EndReason reason, const TraceRequest& request) {
  const TraceOptions& options = request.options;
  const bool asks = !options.stop.empty() || !request.program.empty() || options.at_limit == AtLimit::kStop;
  return reason == EndReason::kStopCriterion || reason == EndReason::kAtLimit ||
         (reason == EndReason::kMaxIncrements && !asks);
}

}  // namespace contact_path
