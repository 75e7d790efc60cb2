// Writes a path as CSV: a header line, then a row per increment, doubles with 17 significant digits.
#ifndef CONTACT_PATH_PATH_CSV_H_
#define CONTACT_PATH_PATH_CSV_H_

#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "contact_path/path/increment.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

// A column of the increment as a whole: of numbers, or of words.
struct CsvColumn {
  enum Place { kFirst, kBehindContacts, kOfProgram, kOfStability, kOfMachine, kOfJumps, kOfChecks };
  Place place;
  std::string_view name;
  double (*number)(const Increment&);
  std::string_view (*word)(const Increment&) = nullptr;
};

// In the order of the CSV.
inline constexpr CsvColumn kCsvColumns[] = {
    {CsvColumn::kFirst, "index", [](const Increment& of) { return static_cast<double>(of.index); }},
    {CsvColumn::kFirst, "load_factor", [](const Increment& of) { return of.load_factor; }},
    {CsvColumn::kFirst, "arc_length", [](const Increment& of) { return of.arc_length; }},
    {CsvColumn::kFirst, "kind", nullptr, [](const Increment& of) { return ToString(of.kind); }},
    {CsvColumn::kBehindContacts, "dissipation", [](const Increment& of) { return of.dissipation; }},
    {CsvColumn::kBehindContacts, "strain_energy", [](const Increment& of) { return of.strain_energy; }},
    {CsvColumn::kBehindContacts, "equilibrium_residual", [](const Increment& of) { return of.residuals.equilibrium; }},
    {CsvColumn::kBehindContacts, "complementarity_residual",
     [](const Increment& of) { return of.residuals.Contact(); }},
    {CsvColumn::kBehindContacts, "solve_time", [](const Increment& of) { return of.solve.time; }},
    {CsvColumn::kOfProgram, "stage", [](const Increment& of) { return static_cast<double>(of.stage); }},
    {CsvColumn::kOfStability, "stability", nullptr,
     [](const Increment& of) { return ToString(of.stability.stability); }},
    {CsvColumn::kOfStability, "stability_controlled", nullptr,
     [](const Increment& of) { return ToString(of.stability.stability_controlled); }},
    {CsvColumn::kOfStability, "unstable_directions",
     [](const Increment& of) { return static_cast<double>(of.stability.unstable_directions); }},
    {CsvColumn::kOfStability, "critical_stiffness",
     [](const Increment& of) { return of.stability.critical_stiffness; }},
    {CsvColumn::kOfMachine, "setting", [](const Increment& of) { return of.setting; }},
    {CsvColumn::kOfJumps, "energy_released", [](const Increment& of) { return of.jump.energy_released; }},
    {CsvColumn::kOfChecks, "landing_robust", [](const Increment& of) { return of.jump.landing_robust ? 1.0 : 0.0; }},
};

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
  // The request must be sound (scene/validate.h).
  explicit CsvWriter(const TraceRequest& given);

  void WriteHeader(std::ostream& out) const;
  void WriteRow(const Increment& increment, std::ostream& out) const;

 private:
  struct Column {
    std::string name;
    std::function<void(const Increment&, std::ostream&)> write;
  };

  std::vector<Column> columns_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_CSV_H_
