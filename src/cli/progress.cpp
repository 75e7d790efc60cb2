#include "cli/progress.h"

#include <cmath>
#include <cstddef>
#include <iomanip>
#include <utility>

#include "contact_path/scene/expand.h"
#include "contact_path/scene/program.h"
#include "contact_path/scene/text.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

using std::chrono::steady_clock;

constexpr auto kTimeBetweenDrawings = std::chrono::milliseconds(100);
constexpr int kBarWidth = 14;             // characters; the whole line fits into 80
constexpr char kWipeLine[] = "\r\x1b[K";  // ANSI: to the first column, erase to the end of the line

// An estimate of the time left is worth its place after this share of the path, and this time.
constexpr double kLeastFraction = 0.02;
constexpr double kLeastSeconds = 3.0;

// "2:05", "3:00:10".
std::string InMinutes(double seconds) {
  const auto whole = std::lround(seconds);
  std::ostringstream text = ClassicStream();
  text << std::setfill('0');
  if (whole >= 3600) text << whole / 3600 << ':' << std::setw(2);
  text << whole / 60 % 60 << ':' << std::setw(2) << whole % 60;
  return text.str();
}

// 0 where it is rounding.
double Shown(double value, double rounding) { return std::abs(value) > rounding ? value : 0.0; }

}  // namespace

Progress::Progress(const TraceRequest& request, bool show_bar, std::ostream& out, Clock clock)
    : estimate_(request),
      show_bar_(show_bar),
      out_(out),
      clock_(std::move(clock)),
      summary_(ProgramScales(ExpandedRequest(request).Get()).load_factor),
      begin_(clock_()) {
  if (show_bar_) out_ << kWipeLine << "looking for the start" << std::flush;
  visible_ = show_bar_;
}

void Progress::Add(const Increment& increment) {
  const double done = estimate_.Add(increment);
  summary_.Add(increment);
  const auto now = clock_();
  if (increment.index == 0) first_increment_ = now;
  if (show_bar_ && (increment.index == 0 || now - drawn_ >= kTimeBetweenDrawings)) {
    Draw(increment, done);
    drawn_ = now;
    visible_ = true;
  }
}

void Progress::Wipe() {
  if (visible_) out_ << kWipeLine << std::flush;
  visible_ = false;
}

std::string Progress::Summary(const TraceResult& result) const {
  const double seconds = std::chrono::duration<double>(clock_() - begin_).count();
  std::ostringstream line = ClassicStream();
  line << summary_.ToText(ToString(result.reason), result.message) << "; " << std::fixed << std::setprecision(2)
       << seconds << " s";
  return line.str();
}

void Progress::Draw(const Increment& increment, double done) {
  std::ostringstream line = ClassicStream();
  line << kWipeLine;
  if (estimate_.HasEnd()) {
    const auto filled = static_cast<std::size_t>(done * kBarWidth);
    line << '[' << std::string(filled, '#') << std::string(kBarWidth - filled, ' ') << "] " << std::setw(3)
         << static_cast<int>(100.0 * done) << "%  ";
  }
  line << "increment " << increment.index;
  if (increment.stage > 0) line << "  stage " << increment.stage;
  line << "  load factor " << std::setprecision(4) << increment.load_factor << "  events " << summary_.events();
  const double seconds = std::chrono::duration<double>(clock_() - first_increment_).count();
  if (done >= kLeastFraction && seconds >= kLeastSeconds)
    line << "  " << InMinutes(seconds * (1.0 - done) / done) << " left";
  out_ << line.str() << std::flush;
}

void PrintBranches(const TraceRequest& request, const Increment& increment, double load_scale, std::ostream& out) {
  if (increment.event.branches.empty() && increment.event.number == 0) return;
  std::ostringstream text = ClassicStream();
  if (increment.event.number > 0) text << "event " << increment.event.number << ", ";
  text << "increment " << increment.index << ", " << ToString(increment.kind) << " at load factor "
       << LoadFactorText(increment.load_factor, load_scale)
       << (increment.event.complete ? "" : "; not all combinations of states were tried") << '\n'
       << std::setprecision(4);
  if (increment.event.branches.empty()) text << "  no branch was found\n";
  const std::vector<OneSidedBar> bars = OneSidedBars(request.scene);
  for (std::size_t i = 0; i < increment.event.branches.size(); ++i) {
    const BranchRecord& branch = increment.event.branches[i];
    const bool taken = static_cast<int>(i) + 1 == increment.event.taken;
    text << (taken ? "* branch " : "  branch ") << i + 1 << ": dissipation rate "
         << Shown(branch.dissipation_rate, tolerances::kRate) << ", load rate "
         << Shown(branch.load_rate, tolerances::kRate) << ", turn " << Shown(branch.turn, tolerances::kSameDirection);
    std::size_t changes = 0;
    const auto list = [&](const std::string& name, auto before, auto state) {
      if (state != before)
        text << (changes++ == 0 ? "; " : ", ") << name << ' ' << ToString(before) << " -> " << ToString(state);
    };
    for (std::size_t k = 0; k < branch.states.size(); ++k)
      list(request.scene.contacts[k].Name(), increment.contacts[k].state, branch.states[k]);
    for (std::size_t k = 0; k < branch.bars.size(); ++k) list(bars[k].name, increment.bars[k], branch.bars[k]);
    if (const std::size_t same = branch.states.size() + branch.bars.size() - changes; same > 0)
      text << "; " << same << " unchanged";
    text << '\n';
  }
  out << text.str();
}

}  // namespace contact_path
