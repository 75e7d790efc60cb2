#include "contact_path/path/csv.h"

#include <cstddef>
#include <limits>
#include <locale>
#include <ostream>

#include "contact_path/scene/scene_index.h"

namespace contact_path {
namespace {

using Place = CsvNumber::Place;

bool IsBehindContacts(const CsvNumber& number, bool program) {
  return number.place == Place::kBehindContacts || (program && number.place == Place::kBehindContactsOfProgram);
}

}  // namespace

std::ostringstream NewCsvLine() {
  std::ostringstream line;
  line.imbue(std::locale::classic());
  line.precision(std::numeric_limits<double>::max_digits10);
  return line;
}

CsvWriter::CsvWriter(const TraceRequest& request) : CsvWriter(ExpandedRequest(request)) {}

CsvWriter::CsvWriter(const ExpandedRequest& expanded)
    : elements_(expanded.Get().scene),
      sections_(expanded.Get().options.Records("sections")),
      stresses_(expanded.Get().options.Records("stresses")),
      pressures_(expanded.Get().options.Records("pressures")),
      stability_(expanded.Get().options.stability == DefaultTrue::kTrue),
      machine_(expanded.Get().options.machine_stiffness > 0.0),
      jumps_(expanded.Get().options.at_limit == AtLimit::kJump),
      checks_(jumps_ && expanded.Get().options.landing_checks),
      program_(!expanded.Get().program.empty()) {
  const Scene& scene = expanded.Get().scene;
  for (const Node& node : scene.nodes) nodes_.push_back(node.name);
  for (const ContactCandidate& contact : scene.contacts) contacts_.push_back(contact.Name());
  turn_ = NodesThatTurn(scene);
  supports_ = SupportedNodes(scene);
  const SceneIndex index(scene);
  for (const TouchedBoundary& boundary : TouchedBoundaries(scene)) {
    touched_.push_back(boundary.name);
    boundaries_.push_back(index.FindSupport(boundary.name) ? "" : boundary.name);
  }
}

void CsvWriter::WriteHeader(std::ostream& out) const {
  std::ostringstream line = NewCsvLine();
  for (const CsvNumber& number : kCsvNumbers)
    if (number.place == Place::kFirst) line << number.name << ',';
  line << "kind";
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    line << ",x_" << nodes_[i] << ",y_" << nodes_[i];
    if (turn_[i]) line << ",rotation_" << nodes_[i];
  }
  for (const std::string& name : contacts_)
    line << ",gap_" << name << ",rn_" << name << ",rt_" << name << ",state_" << name;
  for (const CsvNumber& number : kCsvNumbers)
    if (IsBehindContacts(number, program_)) line << ',' << number.name;
  for (const SupportedNode& support : supports_) {
    if (support.x) line << ",rx_" << nodes_[support.node];
    if (support.y) line << ",ry_" << nodes_[support.node];
    if (support.rotation) line << ",rm_" << nodes_[support.node];
  }
  for (const std::string& name : boundaries_)
    if (!name.empty()) line << ",rx_" << name << ",ry_" << name << ",rm_" << name;
  if (stability_) line << ",stability,stability_controlled,unstable_directions,critical_stiffness";
  if (machine_) line << ",setting";
  if (jumps_) line << ",energy_released" << (checks_ ? ",landing_robust" : "");
  for (std::size_t i = 0; sections_ && i < elements_.NumSections(); ++i) {
    const std::string name = elements_.SectionName(i);
    line << ",N_" << name;
    if (!elements_.IsBar(i)) line << ",Q_" << name << ",M_" << name << ",M1_" << name << ",M2_" << name;
  }
  for (std::size_t i = 0; stresses_ && i < elements_.NumElements(); ++i)
    ForEachField<SolidStress>([&](const auto& field) { line << ',' << field.name << '_' << elements_.ElementName(i); });
  if (pressures_) {
    for (const std::string& name : contacts_) line << ",pressure_" << name << ",traction_" << name;
    for (const std::string& name : touched_) line << ",width_" << name;
  }
  line << '\n';
  out << line.str();
}

void CsvWriter::WriteRow(const Increment& increment, std::ostream& out) const {
  std::ostringstream line = NewCsvLine();
  for (const CsvNumber& number : kCsvNumbers)
    if (number.place == Place::kFirst) line << number.value(increment) << ',';
  line << ToString(increment.kind);
  for (std::size_t i = 0; i < increment.positions.size(); ++i) {
    line << ',' << increment.positions[i];
    const std::size_t node = i / 2;
    if (i % 2 == 1 && node < increment.rotations.size() && turn_[node]) line << ',' << increment.rotations[node];
  }
  for (const ContactRecord& contact : increment.contacts) {
    line << ',' << contact.gap << ',' << contact.rn << ',' << contact.rt << ',' << ToString(contact.state);
  }
  for (const CsvNumber& number : kCsvNumbers)
    if (IsBehindContacts(number, increment.stage > 0)) line << ',' << number.value(increment);
  for (std::size_t i = 0; i < supports_.size(); ++i) {
    const Resultant& reaction = increment.supports[i];
    if (supports_[i].x) line << ',' << reaction.rx;
    if (supports_[i].y) line << ',' << reaction.ry;
    if (supports_[i].rotation) line << ',' << reaction.rm;
  }
  for (std::size_t i = 0; i < boundaries_.size(); ++i) {
    const Resultant& of = increment.boundaries[i];
    if (!boundaries_[i].empty()) line << ',' << of.rx << ',' << of.ry << ',' << of.rm;
  }
  if (stability_) {
    const StabilityRecord& of = increment.stability;
    line << ',' << ToString(of.stability) << ',' << ToString(of.stability_controlled) << ',' << of.unstable_directions
         << ',' << of.critical_stiffness;
  }
  if (machine_) line << ',' << increment.setting;
  if (jumps_) line << ',' << increment.jump.energy_released;
  if (checks_) line << ',' << (increment.jump.landing_robust ? 1 : 0);
  for (std::size_t i = 0; sections_ && i < increment.sections.size(); ++i) {
    const SectionForces& of = increment.sections[i];
    line << ',' << of.N;
    if (!elements_.IsBar(i)) line << ',' << of.Q << ',' << of.M << ',' << of.M1 << ',' << of.M2;
  }
  if (stresses_)
    for (const SolidStress& of : increment.stresses)
      ForEachField<SolidStress>([&](const auto& field) { line << ',' << of.*field.member; });
  if (pressures_) {
    for (const ContactPressure& of : increment.pressures) line << ',' << of.pressure << ',' << of.traction;
    for (const double width : increment.widths) line << ',' << width;
  }
  line << '\n';
  out << line.str();
}

}  // namespace contact_path
