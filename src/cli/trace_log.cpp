#include "cli/trace_log.h"

#include <cstdint>
#include <iomanip>
#include <utility>

#include "cli/json_fields.h"
#include "contact_path/path/end.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/program.h"
#include "contact_path/scene/read_scene.h"
#include "contact_path/scene/text.h"

namespace contact_path {

std::string HashOf(const TraceRequest& request) {
  std::uint64_t hash = 14695981039346656037U;
  for (const char byte : WriteTraceRequest(request)) hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211U;
  std::ostringstream text = ClassicStream();
  text << std::hex << std::setfill('0') << std::setw(16) << hash;
  return text.str();
}

TraceLog::TraceLog(const TraceRequest& request, std::ostream* out)
    : out_(*out), landing_checks_(request.options.landing_checks) {
  const Scaling scaling = ProgramScales(request);
  Json header;
  header["type"] = "header";
  header["format"] = 1;
  header["version"] = CONTACT_PATH_VERSION;
  header["scene"] = request.scene.name;
  header["scene_hash"] = HashOf(request);
  header["method"] = JsonOf(request.options.method);
  header["accuracy"] = JsonOf(request.options.accuracy);
  header["friction_law"] = JsonOf(request.options.friction_law);
  header["scaling"] = {{"length", scaling.length}, {"force", scaling.force}, {"load_factor", scaling.load_factor}};
  Json nodes = Json::array(), contacts = Json::array(), bars = Json::array(), pins = Json::array();
  for (const Node& node : request.scene.nodes) nodes.push_back(node.name);
  for (const ContactCandidate& contact : request.scene.contacts) contacts.push_back(contact.Name());
  for (const OneSidedBar& bar : OneSidedBars(request.scene)) bars.push_back(bar.name);
  for (std::size_t i = 0; i < request.scene.pins.size(); ++i) pins.push_back(PinName(request.scene.pins[i], i));
  header["nodes"] = std::move(nodes);
  header["contacts"] = std::move(contacts);
  header["bars"] = std::move(bars);
  header["pins"] = std::move(pins);
  WriteLine(header, &out_);
}

void TraceLog::Add(const TrialStep& trial) {
  Json line = {{"type", "trial"}, {"length", trial.length}, {"verdict", std::string(trial.verdict)}};
  if (!trial.ends_at.empty()) line["ends_at"] = std::string(trial.ends_at);
  for (const auto& [name, number] : trial.numbers) line[std::string(name)] = number;
  WriteLine(line, &out_);
}

void TraceLog::Add(const Increment& increment) {
  Json line = JsonOf(increment);
  Json event = std::move(line["event"]);
  line.erase("event");
  if (increment.inner.positions.empty()) line.erase("inner");
  line["type"] = "increment";
  line["equilibrium_residual"] = increment.residuals.equilibrium;
  line["complementarity_residual"] = increment.residuals.Contact();
  line.update(JsonOf(increment.solve));
  line.update(JsonOf(increment.stability));
  if (increment.kind == IncrementKind::kJump) line.update(JsonOf(increment.jump));
  if (!landing_checks_) line.erase("landing_robust");
  line["solve_time"] = increment.solve.time;
  line["positions"] = increment.positions;
  line["rotations"] = increment.rotations;
  line["contacts"] = JsonOf(increment.contacts);
  WriteLine(line, &out_);
  if (increment.event.number == 0 && increment.event.branches.empty()) return;
  event["type"] = "event";
  event["increment"] = increment.index;
  WriteLine(event, &out_);
}

void TraceLog::End(const TraceResult& result, const std::string& summary) {
  WriteLine({{"type", "end"},
             {"reason", JsonOf(result.reason)},
             {"message", result.message},
             {"summary", summary},
             {"increments", result.increments},
             {"reached", result.reached}},
            &out_);
}

}  // namespace contact_path
