// Writes a path as CSV: a header line, then a row per increment, doubles with 17 significant digits.
#ifndef CONTACT_PATH_PATH_CSV_H_
#define CONTACT_PATH_PATH_CSV_H_

#include <array>
#include <iosfwd>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "contact_path/path/increment.h"
#include "contact_path/scene/element_names.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/reacting_parts.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

// A column of numbers of the increment as a whole.
struct CsvNumber {
  enum class Place { kFirst, kBehindContacts, kBehindContactsOfProgram };
  std::string_view name;
  double (*value)(const Increment&);
  Place place = Place::kBehindContacts;
};

// In the order of the CSV.
inline constexpr std::array<CsvNumber, 9> kCsvNumbers = {{
    {"index", [](const Increment& increment) { return static_cast<double>(increment.index); },
     CsvNumber::Place::kFirst},
    {"load_factor", [](const Increment& increment) { return increment.load_factor; }, CsvNumber::Place::kFirst},
    {"arc_length", [](const Increment& increment) { return increment.arc_length; }, CsvNumber::Place::kFirst},
    {"dissipation", [](const Increment& increment) { return increment.dissipation; }},
    {"strain_energy", [](const Increment& increment) { return increment.strain_energy; }},
    {"equilibrium_residual", [](const Increment& increment) { return increment.residuals.equilibrium; }},
    {"complementarity_residual", [](const Increment& increment) { return increment.residuals.Contact(); }},
    {"solve_time", [](const Increment& increment) { return increment.solve.time; }},
    {"stage", [](const Increment& increment) { return static_cast<double>(increment.stage); },
     CsvNumber::Place::kBehindContactsOfProgram},
}};

// A line in the making: the same bytes whatever the locale and the format flags of the stream it ends up in, doubles
// with 17 significant digits.
std::ostringstream NewCsvLine();

// Columns: index, load_factor, arc_length, kind, x_<node>, y_<node>, ..., gap_<contact>, rn_<contact>, rt_<contact>,
// state_<contact>, ..., dissipation, strain_energy, equilibrium_residual, complementarity_residual, solve_time;
// with a program: stage; rx_<node>, ry_<node>, rm_<node> of each component that a support holds; rx_<boundary>,
// ry_<boundary>, rm_<boundary> of each obstacle and surface with candidates, except of one that has the name of a
// supported node; unless options.stability is false: stability, stability_controlled, unstable_directions,
// critical_stiffness; where options.at_limit is jump: energy_released, and with options.landing_checks landing_robust;
// with options.record: N_bar<place>, and N_, Q_, M_, M1_, M2_<beam>.<segment>; sxx_, syy_, sxy_, szz_, mises_,
// energy_<solid>.<element>; pressure_, traction_<contact>, width_<boundary>. rotation_<node> follows y_<node> where a
// beam turns the node. Nodes and contacts in the order of the expanded scene (scene/expand.h). Errors are left in the
// state of the stream.
class CsvWriter {
 public:
  // `request` must be sound (scene/validate.h).
  explicit CsvWriter(const TraceRequest& request);

  void WriteHeader(std::ostream& out) const;
  void WriteRow(const Increment& increment, std::ostream& out) const;

 private:
  explicit CsvWriter(const ExpandedRequest& expanded);

  std::vector<std::string> nodes_, contacts_;  // names
  std::vector<SupportedNode> supports_;
  std::vector<std::string> touched_, boundaries_;  // names; of boundaries empty: no columns of forces
  ElementNames elements_;
  bool sections_, stresses_, pressures_, stability_, machine_, jumps_, checks_;
  std::vector<bool> turn_;  // by node
  bool program_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_CSV_H_
