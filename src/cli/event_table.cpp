#include "cli/event_table.h"

#include <cstddef>
#include <iomanip>
#include <locale>
#include <sstream>

namespace contact_path {

void PrintWays(const Scene& scene, const Increment& row, std::ostream& out) {
  if (row.event.ways.empty() && row.event.number == 0) return;
  std::ostringstream text;
  text.imbue(std::locale::classic());
  if (row.event.number > 0) text << "event " << row.event.number << ", ";
  text << "row " << row.index << ", " << ToString(row.kind) << " at load factor " << std::setprecision(10)
       << row.load_factor << (row.event.complete ? "" : "; not all combinations of states were tried") << '\n'
       << std::setprecision(4);
  if (row.event.ways.empty()) text << "  no way on was found\n";
  for (std::size_t i = 0; i < row.event.ways.size(); ++i) {
    const WayRecord& way = row.event.ways[i];
    const bool taken = static_cast<int>(i) == row.event.taken;
    text << (taken ? "* way " : "  way ") << i + 1 << ": dissipation rate " << way.dissipation_rate << ", load rate "
         << way.load_rate << ", turn " << way.turn;
    for (std::size_t k = 0; k < way.states.size(); ++k)
      text << (k == 0 ? "; " : ", ") << scene.contacts[k].Name() << ' '
           << ToString(way.states[k]);
    text << '\n';
  }
  out << text.str();
}

}  // namespace contact_path
