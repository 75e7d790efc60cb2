#include "contact_path/path/csv.h"

#include <cstddef>
#include <limits>
#include <locale>
#include <ostream>
#include <sstream>

namespace contact_path {
namespace {

// A line in the making: the same bytes whatever the locale and the format flags of the stream it ends up in.
std::ostringstream NewLine() {
  std::ostringstream line;
  line.imbue(std::locale::classic());
  line.precision(std::numeric_limits<double>::max_digits10);
  return line;
}

}  // namespace

void WriteCsvHeader(const TraceRequest& request, std::ostream& out) {
  const Scene& scene = request.scene;
  std::ostringstream line = NewLine();
  line << "index,load_factor,arc_length,kind";
  for (const Node& node : scene.nodes) line << ",x_" << node.name << ",y_" << node.name;
  for (const ContactCandidate& contact : scene.contacts) {
    const std::string name = contact.Name();
    line << ",gap_" << name << ",rn_" << name << ",rt_" << name << ",state_" << name;
  }
  line << ",dissipation,strain_energy,equilibrium_residual,complementarity_residual,solve_time"
       << (request.program.empty() ? "\n" : ",stage\n");
  out << line.str();
}

void WriteCsvRow(const Increment& increment, std::ostream& out) {
  std::ostringstream line = NewLine();
  line << increment.index << ',' << increment.load_factor << ',' << increment.arc_length << ','
       << ToString(increment.kind);
  for (const double position : increment.positions) line << ',' << position;
  for (const ContactRecord& contact : increment.contacts) {
    line << ',' << contact.gap << ',' << contact.rn << ',' << contact.rt << ',' << ToString(contact.state);
  }
  line << ',' << increment.dissipation << ',' << increment.strain_energy << ',' << increment.residuals.equilibrium
       << ',' << increment.residuals.Contact() << ',' << increment.solve.time;
  if (increment.stage > 0) line << ',' << increment.stage;
  line << '\n';
  out << line.str();
}

}  // namespace contact_path
