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

constexpr std::size_t kPointsListed = 10;

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
  if (std::abs(load_factor) <= tolerances::kRounding * scale) return "0";
  std::ostringstream text = NewText();
  text << std::setprecision(10) << load_factor;
  return text.str();
}

void PathSummary::Add(const Increment& increment) {
  ++increments_;
  if (increment.event.number > 0 || increment.kind == IncrementKind::kContactEvent ||
      increment.kind == IncrementKind::kCornerLimit)
    ++events_;
  if (increment.kind == IncrementKind::kJump) ++jumps_;
  const CriticalPoint point = {increment.index, increment.stage, increment.kind, increment.load_factor};
  if (increment.kind == IncrementKind::kSmoothLimit || increment.kind == IncrementKind::kCornerLimit)
    limit_points_.push_back(point);
  if (increment.kind == IncrementKind::kBifurcation || !increment.event.null_vector.empty())
    crossings_.push_back(point);
}

std::string PathSummary::Listed(const std::vector<CriticalPoint>& points) const {
  std::ostringstream text = NewText();
  const std::size_t listed = std::min(points.size(), kPointsListed);
  for (std::size_t i = 0; i < listed; ++i)
    text << (i == 0 ? "" : ", ") << ToString(points[i].kind) << " at load factor "
         << LoadFactorText(points[i].load_factor, load_scale_) << " (increment " << points[i].index << ')';
  if (listed < points.size()) text << " and " << points.size() - listed << " more";
  return text.str();
}

std::string PathSummary::ToText() const {
  std::string text = Counted(increments_, "increment") + "; limit points: ";
  text += limit_points_.empty() ? "none" : Listed(limit_points_);
  if (!crossings_.empty()) text += "; another path crosses: " + Listed(crossings_);
  text += "; " + Counted(events_, "event");
  return jumps_ > 0 ? text + ", " + Counted(jumps_, "jump") : text;
}

std::string PathSummary::ToText(std::string_view reason, const std::string& message) const {
  return (reason.empty() ? "" : std::string(reason) + ": ") + message + "; " + ToText();
}

}  // namespace contact_path
