// contact_path_response SCENE.yaml: what elements and contacts bear at increments of a path of the scene. Reads
// increments as JSON, one a line, as contact_path_trace --log writes them, from standard input; for each writes a line
// with its reactions, section forces, stresses, pressures and widths to standard output.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli/json_fields.h"
#include "cli/scene_program.h"
#include "contact_path/path/increment_lists.h"
#include "contact_path/path/model.h"
#include "contact_path/path/recorder.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/program.h"

namespace contact_path {
namespace {

// Throws std::invalid_argument for a word that is none.
ContactState StateFrom(const std::string& word) {
  for (const ContactState state : {ContactState::kOpen, ContactState::kStick, ContactState::kSlipPlus,
                                   ContactState::kSlipMinus, ContactState::kClosed})
    if (word == ToString(state)) return state;
  throw std::invalid_argument("state = " + word + ": must be open, closed, stick, slip+ or slip-");
}

BarState BarStateFrom(const std::string& word) {
  for (const BarState state : {BarState::kTaut, BarState::kSlack})
    if (word == ToString(state)) return state;
  throw std::invalid_argument("bars: " + word + ": must be taut or slack");
}

// Throws Json::exception and std::invalid_argument for another type. stages: of the program; 0: there is none.
Increment IncrementFrom(const Json& line, std::int64_t stages) {
  Increment increment;
  const Json stage = line.contains("stage") ? line.at("stage") : Json(0);
  const std::int64_t number = stage.is_number_integer() ? stage.get<std::int64_t>() : -1;
  if (number < std::min<std::int64_t>(stages, 1) || number > stages)
    throw std::invalid_argument("stage = " + stage.dump() + ": must be " +
                                (stages == 0 ? "0: there is no program" : "1 to " + std::to_string(stages)));
  increment.stage = static_cast<int>(number);
  increment.load_factor = line.at("load_factor").get<double>();
  increment.positions = line.at("positions").get<std::vector<double>>();
  increment.rotations = line.value("rotations", std::vector<double>());
  if (!line.at("contacts").is_array()) throw std::invalid_argument("contacts: must be a list");
  for (const Json& contact : line.at("contacts")) {
    ContactRecord& record = increment.contacts.emplace_back();
    record.rn = contact.at("rn").get<double>();
    record.rt = contact.at("rt").get<double>();
    record.state = StateFrom(contact.at("state").get<std::string>());
  }
  for (const std::string& word : line.value("bars", std::vector<std::string>()))
    increment.bars.push_back(BarStateFrom(word));
  if (line.contains("pins") && !line.at("pins").is_array()) throw std::invalid_argument("pins: must be a list");
  for (const Json& pin : line.value("pins", Json::array()))
    increment.pins.push_back({pin.at("rx").get<double>(), pin.at("ry").get<double>()});
  return increment;
}

// Whether all numbers in lists and objects are finite.
bool AllFinite(const Json& value) {
  if (value.is_number_float()) return std::isfinite(value.get<double>());
  return !value.is_structured() || std::all_of(value.begin(), value.end(), AllFinite);
}

class Responder {
 public:
  explicit Responder(const TraceRequest& given)
      : expanded_(given), index_(Request().scene), of_program_(ProgramScales(Request(), index_)) {}

  std::int64_t Stages() const { return static_cast<std::int64_t>(Request().program.size()); }

  // Throws std::invalid_argument where the increment is none of the scene.
  Json Of(Increment increment) {
    RequireSize(increment.positions.size(), 2 * Request().scene.nodes.size(), "positions");
    RequireSize(increment.rotations.size(), HasRotations(Request().scene) ? Request().scene.nodes.size() : 0,
                "rotations");
    RequireSize(increment.contacts.size(), Request().scene.contacts.size(), "contacts");
    RequireSize(increment.bars.size(), OneSidedBars(Request().scene).size(), "bars");
    RequireSize(increment.pins.size(), Request().scene.pins.size(), "pins");
    SetStage(static_cast<std::size_t>(std::max(increment.stage, 1) - 1));
    const PathPoint point = model_->FromIncrement(increment);
    FillState(*model_, point, &increment);
    FillLists(*model_, point, {true, true, true}, &increment);
    Json answer = {{"supports", JsonOf(increment.supports)},
                   {"boundaries", JsonOf(increment.boundaries)},
                   {"pins", JsonOf(increment.pins)},
                   {"sections", JsonOf(increment.sections)},
                   {"stresses", JsonOf(increment.stresses)},
                   {"pressures", JsonOf(increment.pressures)},
                   {"widths", increment.widths}};
    if (!AllFinite(answer)) throw std::invalid_argument("the numbers are beyond what can be computed");
    return answer;
  }

 private:
  const TraceRequest& Request() const { return expanded_.Get(); }

  static void RequireSize(std::size_t size, std::size_t wanted, const std::string& name) {
    if (size == wanted) return;
    throw std::invalid_argument(name + " has " + std::to_string(size) + " entries: must be " + std::to_string(wanted));
  }

  void SetStage(std::size_t stage) {
    if (model_ && stage == stage_) return;
    stage_ = stage;
    model_ = std::make_unique<const Model>(StageScene(Request(), index_, stage),
                                           StageConfiguration(Request(), index_, stage),
                                           StageScales(Request(), index_, stage, of_program_));
  }

  const ExpandedRequest expanded_;
  const SceneIndex index_;
  const Scaling of_program_;
  std::size_t stage_ = 0;
  std::unique_ptr<const Model> model_;  // of the stage
};

void Respond(const TraceRequest& request) {
  Responder responder(request);
  std::string line;
  for (int number = 1; std::cout && std::getline(std::cin, line); ++number) {
    try {
      const Json increment = Json::parse(line);
      // A log has lines of other types.
      if (increment.is_object() && increment.value("type", "increment") != "increment") continue;
      WriteLine(responder.Of(IncrementFrom(increment, responder.Stages())), &std::cout);
    } catch (const std::exception& error) {
      throw std::invalid_argument("line " + std::to_string(number) + " of standard input: " + error.what());
    }
  }
  if (std::cin.bad()) throw std::invalid_argument("standard input cannot be read");
}

}  // namespace
}  // namespace contact_path

int main(int argc, char** argv) {
  return contact_path::RunOnScene("contact_path_response",
                                  "Writes what elements and contacts bear at increments of a path, which are read as "
                                  "JSON lines from standard input.",
                                  "", argc, argv, contact_path::Respond);
}
