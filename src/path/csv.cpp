#include "contact_path/path/csv.h"

#include <cstddef>
#include <limits>
#include <ostream>
#include <type_traits>
#include <utility>

#include "contact_path/scene/expand.h"
#include "contact_path/scene/scene_index.h"
#include "contact_path/scene/text.h"

namespace contact_path {
namespace {

double Cell(double number) { return number; }
std::string_view Cell(ContactState state) { return ToString(state); }

bool AllFields(std::string_view) { return true; }

}  // namespace

CsvWriter::CsvWriter(const TraceRequest& given) {
  const ExpandedRequest expanded(given);
  const Scene& scene = expanded.Get().scene;
  const TraceOptions& options = expanded.Get().options;
  const auto add = [this](std::string name, auto value) {
    columns_.push_back({std::move(name), [value](const Increment& of, std::ostream& line) { line << value(of); }});
  };
  const auto add_place = [&](CsvColumn::Place place) {
    for (const CsvColumn& column : kCsvColumns) {
      if (column.place != place) continue;
      if (column.number != nullptr) add(std::string(column.name), column.number);
      if (column.word != nullptr) add(std::string(column.name), column.word);
    }
  };
  // A column for each wanted field of what stands at `i` of a list.
  const auto add_fields = [&](auto list, std::size_t i, const std::string& of_name, auto wanted) {
    using Part = typename std::decay_t<decltype(std::declval<Increment>().*list)>::value_type;
    ForEachField<Part>([&](const auto& field) {
      if (!wanted(field.name)) return;
      add(std::string(field.name) + "_" + of_name,
          [list, i, member = field.member](const Increment& of) { return Cell((of.*list)[i].*member); });
    });
  };

  add_place(CsvColumn::kFirst);
  const std::vector<bool> turn = NodesThatTurn(scene);
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const std::string& name = scene.nodes[i].name;
    add("x_" + name, [i](const Increment& of) { return of.positions[2 * i]; });
    add("y_" + name, [i](const Increment& of) { return of.positions[2 * i + 1]; });
    if (turn[i]) add("rotation_" + name, [i](const Increment& of) { return of.rotations[i]; });
  }
  for (std::size_t i = 0; i < scene.contacts.size(); ++i)
    add_fields(&Increment::contacts, i, scene.contacts[i].Name(), AllFields);
  const std::vector<OneSidedBar> bars = OneSidedBars(scene);
  for (std::size_t k = 0; k < bars.size(); ++k)
    add("state_" + bars[k].name, [k](const Increment& of) { return ToString(of.bars[k]); });
  add_place(CsvColumn::kBehindContacts);
  if (!expanded.Get().program.empty()) add_place(CsvColumn::kOfProgram);
  const SceneIndex index(scene);
  const std::vector<SupportedNode> supports = SupportedNodes(scene);
  for (std::size_t i = 0; i < supports.size(); ++i)
    add_fields(&Increment::supports, i, scene.nodes[supports[i].node].name,
               [&of = supports[i]](std::string_view component) {
                 return component == "rx" ? of.x : component == "ry" ? of.y : of.rotation;
               });
  const std::vector<TouchedBoundary> boundaries = TouchedBoundaries(scene);
  for (std::size_t i = 0; i < boundaries.size(); ++i)
    if (!index.FindSupport(boundaries[i].name)) add_fields(&Increment::boundaries, i, boundaries[i].name, AllFields);
  for (std::size_t i = 0; i < scene.pins.size(); ++i)
    add_fields(
        &Increment::pins, i, PinName(scene.pins[i], i),
        [has_spring = scene.pins[i].stiffness > 0.0](std::string_view field) { return field != "rm" || has_spring; });
  if (options.stability == DefaultTrue::kTrue) add_place(CsvColumn::kOfStability);
  if (options.machine_stiffness > 0.0) add_place(CsvColumn::kOfMachine);
  if (options.at_limit == AtLimit::kJump) add_place(CsvColumn::kOfJumps);
  if (options.at_limit == AtLimit::kJump && options.landing_checks) add_place(CsvColumn::kOfChecks);
  const ElementNames& elements = index.Elements();
  for (std::size_t i = 0; options.Records("sections") && i < elements.NumSections(); ++i)
    add_fields(&Increment::sections, i, elements.SectionName(i),
               [only = elements.HasOnlyN(i)](std::string_view force) { return force == "N" || !only; });
  for (std::size_t i = 0; options.Records("stresses") && i < elements.NumElements(); ++i)
    add_fields(&Increment::stresses, i, elements.ElementName(i), AllFields);
  if (!options.Records("pressures")) return;
  for (std::size_t i = 0; i < scene.contacts.size(); ++i)
    add_fields(&Increment::pressures, i, scene.contacts[i].Name(),
               [](std::string_view field) { return field != "length"; });
  for (std::size_t i = 0; i < boundaries.size(); ++i)
    add("width_" + boundaries[i].name, [i](const Increment& of) { return of.widths[i]; });
}

void CsvWriter::WriteHeader(std::ostream& out) const {
  std::string line;
  for (const Column& column : columns_) line += (line.empty() ? "" : ",") + column.name;
  out << line + "\n";
}

void CsvWriter::WriteRow(const Increment& increment, std::ostream& out) const {
  std::ostringstream line = ClassicStream(std::numeric_limits<double>::max_digits10);
  for (const Column& column : columns_) {
    if (&column != &columns_.front()) line << ',';
    column.write(increment, line);
  }
  line << '\n';
  out << line.str();
}

}  // namespace contact_path
