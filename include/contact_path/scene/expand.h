// A request in which every node, load and contact is listed by itself: what is traced.
#ifndef CONTACT_PATH_SCENE_EXPAND_H_
#define CONTACT_PATH_SCENE_EXPAND_H_

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "contact_path/scene/scene.h"

namespace contact_path {

// The name of a part, or that by its kind and its place in the list, from 0.
inline std::string NameOr(const std::string& name, const char* kind, std::size_t place) {
  return name.empty() ? kind + std::to_string(place + 1) : name;
}
inline std::string BarName(const Bar& bar, std::size_t place) { return NameOr(bar.name, "bar", place); }
inline std::string BeamName(const Beam& beam, std::size_t place) { return NameOr(beam.name, "beam", place); }
inline std::string SolidName(const Solid& solid, std::size_t place) { return NameOr(solid.name, "solid", place); }
inline std::string TendonName(const Tendon& of, std::size_t place) { return NameOr(of.name, "tendon", place); }
inline std::string PinName(const Pin& pin, std::size_t place) { return NameOr(pin.name, "pin", place); }

// What bears in one sense alone: a bar, or a tendon, whose length is that along its route (tendon_route.h).
struct OneSidedBar {
  std::string name;
  const std::vector<std::string>* nodes;  // of the scene
  double EA, rest_length;                 // rest_length: as the scene has it
  StrainMeasure strain;
  BarSense sense;
  const Tendon* tendon = nullptr;  // null: a bar
};

// Bars, then tendons, in the order of the scene.
std::vector<OneSidedBar> OneSidedBars(const Scene& scene);

// Whether it slides through an eye with friction, and is not expanded.
bool RubsAtEyes(const Tendon& tendon);

// The number of its segments, given or by default.
int BeamSegments(const Beam& beam);

// Whether the beam turns its node `place`, of the nodes that are listed for it.
bool TurnsNode(const Beam& beam, std::size_t place);

// By node of an expanded scene: whether a beam turns it, or it is a body. Only such a node has a rotation. Names that
// the scene does not have count for nothing.
std::vector<bool> NodesThatTurn(const Scene& scene);
// Whether anything in a scene, expanded or not, turns nodes.
bool HasRotations(const Scene& scene);

// In an expanded scene a body is a node of its name whose `body` is that name, too.
inline bool IsBody(const Node& node) { return !node.body.empty() && node.body == node.name; }
inline bool IsAttached(const Node& node) { return !node.body.empty() && node.body != node.name; }
// The node whose rotation is that of what holds the node: its body, or itself.
inline const std::string& TurnsWith(const Node& node) { return node.body.empty() ? node.name : node.body; }

// Which elements can deform: not all of their nodes are of one body.
class DeformableElements {
 public:
  // scene: must outlive this.
  explicit DeformableElements(const Scene& scene) {
    for (const Node& node : scene.nodes)
      if (!node.body.empty()) bodies_.emplace(node.name, node.body);
  }
  // The nodes of an element.
  template <typename Iterator>
  bool Have(Iterator begin, Iterator end) const {
    const auto first = begin == end ? bodies_.end() : bodies_.find(*begin);
    return first == bodies_.end() || std::any_of(begin, end, [&](const std::string& node) {
             const auto found = bodies_.find(node);
             return found == bodies_.end() || found->second != first->second;
           });
  }
  bool Have(const std::vector<std::string>& nodes) const { return Have(nodes.begin(), nodes.end()); }
  // Bars, tendons or beams.
  template <typename Part>
  bool HaveAnyOf(const std::vector<Part>& parts) const {
    return std::any_of(parts.begin(), parts.end(), [this](const Part& part) { return Have(part.nodes); });
  }

 private:
  std::unordered_map<std::string_view, std::string_view> bodies_;  // by node
};

// By pin of an expanded scene: whether it is part of a loop of pins, from body or node to body or node, or from one
// thing that a support or a contact may hold to another. Only there may equilibrium not tell the forces of pins. Names
// that the scene does not have count for nothing.
std::vector<bool> PinsInLoops(const Scene& scene);

// The circle of a contact that rolls; null for others, and where the scene does not have its obstacle.
const Obstacle* RollingCircle(const ContactCandidate& contact, const Scene& scene);

// The node at the centre of a circle that a body carries: the body itself, if its reference point is there, or the node
// of the name of the circle. scene: expanded.
std::string CentreNode(const Obstacle& circle, const Scene& scene);

// The inner nodes of all beams follow the nodes of the scene, beam by beam; each beam lists all of its nodes. Bodies
// follow as nodes, and then the centres of circles that roll. `scene` must have sound beams; of a beam that is expanded
// nothing changes.
void ExpandParts(Scene* scene);

// Where the parts of an expanded list stand in the list of the request, from 0.
using ListPlaces = std::vector<std::size_t>;

// The request with the inner nodes of its beams and with nodes in place of its bodies, and with loads, contacts and
// support motions on nodes in place of those on groups; what `supports` fix is fixed in the nodes. A circle that rolls
// has its centre for the node of its contact. A node that is fixed
// in x and y is no candidate of its group, but with a surface that can move. A traction acts on the nodes of each
// segment of a beam, half of its resultant on each, which is exact to second order in the length of the segment, and on
// the nodes of each edge of a solid by their shape functions; the weight of a solid acts on the nodes of each of its
// elements by their shape functions. `request` must be sound (validate.h); a part that names
// no group, beam or surface of the scene stays as it is.
struct Expansion {
  TraceRequest request;
  ListPlaces contacts;
  // Of the scene, and then by stage.
  std::vector<ListPlaces> loads, motions;
};
Expansion Expand(const TraceRequest& request);

// Whether the request has anything that Expand() changes, or a field of it.
bool NeedsExpansion(const TraceRequest& request);

// The request as it is traced, without a copy where nothing needs one.
class ExpandedRequest {
 public:
  // `request` must be sound, and outlive this.
  explicit ExpandedRequest(const TraceRequest& request) : given_(request) {
    if (NeedsExpansion(request)) expanded_ = Expand(request).request;
  }
  ExpandedRequest(const ExpandedRequest&) = delete;
  ExpandedRequest& operator=(const ExpandedRequest&) = delete;

  const TraceRequest& Get() const { return expanded_ ? *expanded_ : given_; }

 private:
  const TraceRequest& given_;
  std::optional<TraceRequest> expanded_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_EXPAND_H_
