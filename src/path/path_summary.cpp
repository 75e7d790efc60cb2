#include "contact_path/path/path_summary.h"

#include <cstddef>
#include <iomanip>
#include <locale>
#include <sstream>

namespace contact_path {
namespace {

constexpr std::size_t kLimitPointsListed = 10;

std::ostringstream NewText() {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  return text;
}

std::string Counted(int count, const char* what) {
  return std::to_string(count) + ' ' + what + (count == 1 ? "" : "s");
}

}  // namespace

void PathSummary::Add(const Increment& increment) {
  ++increments_;
  if (increment.event.number > 0 || increment.kind == IncrementKind::kContactEvent ||
      increment.kind == IncrementKind::kCornerLimit)
    ++events_;
  if (increment.kind != IncrementKind::kSmoothLimit && increment.kind != IncrementKind::kCornerLimit) return;
  ++limit_points_;
  if (listed_.size() == kLimitPointsListed) return;
  std::ostringstream text = NewText();
  text << ToString(increment.kind) << " at load factor " << std::setprecision(10) << increment.load_factor
       << " (increment " << increment.index << ')';
  listed_.push_back(text.str());
}

std::string PathSummary::ToText() const {
  std::ostringstream text = NewText();
  text << Counted(increments_, "increment") << "; limit points: ";
  if (listed_.empty()) text << "none";
  for (std::size_t i = 0; i < listed_.size(); ++i) text << (i == 0 ? "" : ", ") << listed_[i];
  const int more = limit_points_ - static_cast<int>(listed_.size());
  if (more > 0) text << " and " << more << " more";
  text << "; " << Counted(events_, "event");
  return text.str();
}

std::string PathSummary::ToText(std::string_view reason, const std::string& message) const {
  return (reason.empty() ? "" : std::string(reason) + ": ") + message + "; " + ToText();
}

}  // namespace contact_path
