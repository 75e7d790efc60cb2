#include "contact_path/path/path_summary.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iomanip>
#include <locale>
#include <sstream>

#include "contact_path/tolerances.h"

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

std::string LoadFactorText(double load_factor, double scale) {
  if (std::abs(load_factor) <= tolerances::kToldAsZero * scale) return "0";
  std::ostringstream text = NewText();
  text << std::setprecision(10) << load_factor;
  return text.str();
}

void PathSummary::Add(const Increment& increment) {
  ++increments_;
  if (increment.event.number > 0 || increment.kind == IncrementKind::kContactEvent ||
      increment.kind == IncrementKind::kCornerLimit)
    ++events_;
  if (increment.kind != IncrementKind::kSmoothLimit && increment.kind != IncrementKind::kCornerLimit) return;
  limit_points_.push_back({increment.index, increment.stage, increment.kind, increment.load_factor});
}

std::string PathSummary::ToText() const {
  std::ostringstream text = NewText();
  text << Counted(increments_, "increment") << "; limit points: ";
  if (limit_points_.empty()) text << "none";
  const std::size_t listed = std::min(limit_points_.size(), kLimitPointsListed);
  for (std::size_t i = 0; i < listed; ++i) {
    const LimitPoint& point = limit_points_[i];
    text << (i == 0 ? "" : ", ") << ToString(point.kind) << " at load factor "
         << LoadFactorText(point.load_factor, load_scale_) << " (increment " << point.index << ')';
  }
  if (listed < limit_points_.size()) text << " and " << limit_points_.size() - listed << " more";
  text << "; " << Counted(events_, "event");
  return text.str();
}

std::string PathSummary::ToText(std::string_view reason, const std::string& message) const {
  return (reason.empty() ? "" : std::string(reason) + ": ") + message + "; " + ToText();
}

}  // namespace contact_path
