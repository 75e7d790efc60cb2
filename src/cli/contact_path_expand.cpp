// contact_path_expand SCENE.yaml: writes what is traced of a scene as one JSON object to standard output: every field
// of every part, also where the file leaves its default; the inner nodes of beams; loads and contacts of groups on
// their nodes; stages that unload with the loads and motions that they take back; the characteristic length and force;
// and the names that columns have.
#include <cstddef>
#include <iostream>

#include "cli/json_fields.h"
#include "cli/scene_program.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/program.h"
#include "contact_path/scene/scene_index.h"

namespace contact_path {
namespace {

// The names of `count` things, by their place.
template <typename Name>
Json ListOf(std::size_t count, Name name) {
  Json list = Json::array();
  for (std::size_t i = 0; i < count; ++i) list.push_back(name(i));
  return list;
}

Json Expanded(const TraceRequest& given) {
  const ExpandedRequest expanded(given);
  const TraceRequest& request = expanded.Get();
  const Scene& scene = request.scene;
  Json object = JsonOf(request);
  for (std::size_t i = 0; i < request.program.size(); ++i) {
    object["program"][i] = JsonOf(StageAsTraced(request, i));
    object["program"][i]["target"] = request.program[i].Target();
  }
  for (std::size_t i = 0; i < scene.solids.size(); ++i)
    object["scene"]["solids"][i]["nodes_per_element"] = scene.solids[i].NodesPerElement();
  for (std::size_t i = 0; i < scene.beams.size(); ++i)
    object["scene"]["beams"][i]["name"] = BeamName(scene.beams[i], i);
  const std::vector<bool> turns = NodesThatTurn(scene);
  Json turning = Json::array(), supports = Json::array(), boundaries = Json::array(), contacts = Json::array(),
       bars = Json::array(), pins = Json::array();
  for (std::size_t i = 0; i < turns.size(); ++i)
    if (turns[i]) turning.push_back(scene.nodes[i].name);
  for (const SupportedNode& support : SupportedNodes(scene))
    supports.push_back(
        {{"node", scene.nodes[support.node].name}, {"x", support.x}, {"y", support.y}, {"rotation", support.rotation}});
  for (const TouchedBoundary& boundary : TouchedBoundaries(scene))
    boundaries.push_back({{"name", boundary.name}, {"is_surface", boundary.is_surface}});
  for (const ContactCandidate& contact : scene.contacts) contacts.push_back(contact.Name());
  for (const OneSidedBar& bar : OneSidedBars(scene)) bars.push_back(bar.name);
  for (std::size_t i = 0; i < scene.pins.size(); ++i)
    pins.push_back({{"name", PinName(scene.pins[i], i)}, {"has_spring", scene.pins[i].stiffness > 0.0}});
  const Scaling scales = ProgramScales(request);
  object["scales"] = {{"length", scales.length}, {"force", scales.force}};
  const ElementNames names(scene);
  object["names"] = {{"turning", turning},
                     {"supports", supports},
                     {"boundaries", boundaries},
                     {"contacts", contacts},
                     {"bars", bars},
                     {"pins", pins},
                     {"sections", ListOf(names.NumSections(), [&](std::size_t i) { return names.SectionName(i); })},
                     {"elements", ListOf(names.NumElements(), [&](std::size_t i) { return names.ElementName(i); })}};
  return object;
}

}  // namespace
}  // namespace contact_path

int main(int argc, char** argv) {
  return contact_path::RunOnScene("contact_path_expand", "Writes what is traced of a scene as JSON to standard output.",
                                  "/dev/stdin", argc, argv, [](const contact_path::TraceRequest& request) {
                                    contact_path::WriteLine(contact_path::Expanded(request), &std::cout);
                                  });
}
