#include "cli/event_table.h"

#include <cmath>
#include <cstddef>
#include <iomanip>

#include "contact_path/path/path_summary.h"
#include "contact_path/scene/text.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

// 0 where it is rounding.
double Shown(double value, double rounding) { return std::abs(value) > rounding ? value : 0.0; }

}  // namespace

void PrintBranches(const TraceRequest& request, const Increment& increment, double load_scale, std::ostream& out) {
  if (increment.event.branches.empty() && increment.event.number == 0) return;
  std::ostringstream text = ClassicStream();
  if (increment.event.number > 0) text << "event " << increment.event.number << ", ";
  text << "increment " << increment.index << ", " << ToString(increment.kind) << " at load factor "
       << LoadFactorText(increment.load_factor, load_scale)
       << (increment.event.complete ? "" : "; not all combinations of states were tried") << '\n'
       << std::setprecision(4);
  if (increment.event.branches.empty()) text << "  no branch was found\n";
  for (std::size_t i = 0; i < increment.event.branches.size(); ++i) {
    const BranchRecord& branch = increment.event.branches[i];
    const bool taken = static_cast<int>(i) + 1 == increment.event.taken;
    text << (taken ? "* branch " : "  branch ") << i + 1 << ": dissipation rate "
         << Shown(branch.dissipation_rate, tolerances::kRate) << ", load rate "
         << Shown(branch.load_rate, tolerances::kRate) << ", turn " << Shown(branch.turn, tolerances::kSameDirection);
    std::size_t changes = 0;
    for (std::size_t k = 0; k < branch.states.size(); ++k) {
      const ContactState before = increment.contacts[k].state;
      if (branch.states[k] == before) continue;
      text << (changes++ == 0 ? "; " : ", ") << request.scene.contacts[k].Name() << ' ' << ToString(before) << " -> "
           << ToString(branch.states[k]);
    }
    if (const std::size_t same = branch.states.size() - changes; same > 0) text << "; " << same << " unchanged";
    text << '\n';
  }
  out << text.str();
}

}  // namespace contact_path
