#include "contact_path/study/path_column.h"

#include <cstddef>
#include <optional>
#include <stdexcept>

#include "contact_path/path/csv.h"
#include "contact_path/path/stop.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/nearest_name.h"
#include "contact_path/scene/quantity.h"

namespace contact_path {
namespace {

constexpr std::string_view kState = "state_";

constexpr std::string_view kSolveTime = "solve_time";

// Columns of verdicts and jumps: numbers, or words.
struct OfStability {
  std::string_view name;
  double (*number)(const Increment&);
  std::string_view (*word)(const Increment&);
};
constexpr OfStability kOfStability[] = {
    {"stability", nullptr, [](const Increment& increment) { return ToString(increment.stability.stability); }},
    {"stability_controlled", nullptr,
     [](const Increment& increment) { return ToString(increment.stability.stability_controlled); }},
    {"unstable_directions",
     [](const Increment& increment) { return static_cast<double>(increment.stability.unstable_directions); }, nullptr},
    {"critical_stiffness", [](const Increment& increment) { return increment.stability.critical_stiffness; }, nullptr},
    {"energy_released", [](const Increment& increment) { return increment.jump.energy_released; }, nullptr},
    {"landing_robust", [](const Increment& increment) { return increment.jump.landing_robust ? 1.0 : 0.0; }, nullptr},
};

[[noreturn]] void Reject(const std::string& rule) { throw std::invalid_argument(rule); }

// What to say of a node or contact that the scene does not have.
std::string UnknownPart(const SpelledQuantity& quantity, const Scene& scene) {
  return "must be of " + PartOf(quantity.kind) + NearestPart(quantity, scene).Question();
}

std::string UnknownColumn(const std::string& name) {
  NearestName nearest(name);
  for (const CsvNumber& column : kCsvNumbers)
    if (column.name != kSolveTime) nearest.Offer(column.name);
  nearest.Offer("kind");
  for (const OfStability& column : kOfStability) nearest.Offer(column.name);
  return "must be a column of the CSV, as load_factor, x_<node> or rn_<contact>" + nearest.Question();
}

}  // namespace

PathColumn::PathColumn(const std::string& name, const TraceRequest& request, const SceneIndex& index) {
  const Scene& scene = request.scene;
  if (name == "stage" && request.program.empty()) Reject("must be of a scene with a program");
  if (name == "landing_robust" && !request.options.landing_checks) Reject("must be of a trace with landing_checks");
  if (name == kSolveTime) Reject("must be the same whenever it is computed: solve_time is not");
  for (const CsvNumber& column : kCsvNumbers)
    if (name == column.name) number_ = column.value;
  if (name == "kind") word_ = [](const Increment& increment) { return ToString(increment.kind); };
  for (const OfStability& column : kOfStability) {
    if (name != column.name) continue;
    if (column.number != nullptr) number_ = column.number;
    if (column.word != nullptr) word_ = column.word;
  }
  if (number_ != nullptr || word_ != nullptr) return;

  if (name.compare(0, kState.size(), kState) == 0) {
    const std::string contact = name.substr(kState.size());
    const std::optional<std::size_t> place = index.FindContact(contact);
    if (!place) Reject(UnknownPart({Quantity::Kind::kGap, contact}, scene));
    word_ = [place = *place](const Increment& increment) { return ToString(increment.contacts[place].state); };
    return;
  }
  const std::optional<SpelledQuantity> spelled = ReadQuantity(name);
  if (!spelled) Reject(UnknownColumn(name));
  const std::optional<Quantity> quantity = FindQuantity(name, index);
  if (!quantity) Reject(UnknownPart(*spelled, scene));
  if (quantity->kind == Quantity::Kind::kRotation && !NodesThatTurn(scene)[quantity->part])
    Reject("must be of a node that a beam turns");
  lists_.Add(*quantity);
  if (quantity->IsOfObstacle())
    number_ = [quantity = *quantity, request](const Increment& increment) {
      return ValueOf(quantity, increment, request);
    };
  else
    number_ = [quantity = *quantity](const Increment& increment) { return ValueOf(quantity, increment); };
}

}  // namespace contact_path
