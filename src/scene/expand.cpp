#include "contact_path/scene/expand.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "contact_path/scene/cell.h"
#include "contact_path/scene/scene_index.h"
#include "scene/expansion_steps.h"
#include "scene/input_bounds.h"
#include "scene/pinned_twins.h"

namespace contact_path {
namespace {

constexpr int kSegments = 20;

bool IsExpanded(const Beam& beam) { return static_cast<int>(beam.nodes.size()) == beam.segments + 1; }

// The point at `share` of the arc from a to b that turns by `angle` to the left.
Node PointOfArc(const Node& a, const Node& b, double angle, double share) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  Node point;
  if (std::abs(angle) < kCancelled) {  // the chord is shorter than the arc by less than rounding
    point.x = a.x + share * dx;
    point.y = a.y + share * dy;
    return point;
  }
  // The chord of a part of the arc: as long as sines of half of the angles tell, and turned against the whole chord.
  const double stretch = std::sin(0.5 * share * angle) / std::sin(0.5 * angle);
  const double turn = -0.5 * (1.0 - share) * angle;
  point.x = a.x + stretch * (std::cos(turn) * dx - std::sin(turn) * dy);
  point.y = a.y + stretch * (std::sin(turn) * dx + std::cos(turn) * dy);
  return point;
}

// What stands for a group: its nodes, and the beam, if it is one.
struct GroupNodes {
  const std::vector<std::string>* nodes = nullptr;
  const Beam* beam = nullptr;
};

class Groups {
 public:
  // scene: expanded; must outlive the groups.
  explicit Groups(const Scene& scene)
      : scene_(scene), nodes_(PlacesByName(scene.nodes)), surfaces_(PlacesByName(scene.surfaces)) {
    for (const Group& group : scene.groups) groups_.emplace(group.name, GroupNodes{&group.nodes, nullptr});
    for (const Beam& beam : scene.beams) groups_.emplace(beam.name, GroupNodes{&beam.nodes, &beam});
    for (std::size_t i = 0; i < scene.solids.size(); ++i)
      solids_[SolidName(scene.solids[i], i)].push_back(&scene.solids[i]);
    for (const Solid& solid : scene.solids) {
      const std::size_t count = solid.NodesPerElement();
      if (count <= 4) continue;
      for (std::size_t i = 0; i < solid.nodes.size(); ++i)
        if (i % count >= count / 2) mid_sides_.insert(solid.nodes[i]);
    }
  }

  // Null for a name that the scene does not have.
  const GroupNodes* Find(const std::string& name) const {
    const auto found = groups_.find(name);
    return found == groups_.end() ? nullptr : &found->second;
  }
  const BoundarySurface* FindSurface(const std::string& name) const {
    const auto found = surfaces_.find(name);
    return found == surfaces_.end() ? nullptr : &scene_.surfaces[found->second];
  }
  // All that have the name.
  std::vector<const Solid*> FindSolids(const std::string& name) const {
    const auto found = solids_.find(name);
    return found == solids_.end() ? std::vector<const Solid*>() : found->second;
  }
  bool IsMidSide(const std::string& node) const { return mid_sides_.count(node) > 0; }

  const Node& NodeOf(const std::string& name) const { return scene_.nodes[nodes_.at(name)]; }
  std::array<double, 2> Place(const std::string& node) const { return {NodeOf(node).x, NodeOf(node).y}; }
  bool CanMove(const std::string& node) const { return !NodeOf(node).fixed_x || !NodeOf(node).fixed_y; }
  bool CanMove(const BoundarySurface& surface) const {
    return std::any_of(surface.nodes.begin(), surface.nodes.end(),
                       [this](const std::string& node) { return CanMove(node); });
  }
  // The length between two nodes at the start.
  double Length(const std::string& first, const std::string& second) const {
    const auto [ax, ay] = Place(first);
    const auto [bx, by] = Place(second);
    return std::hypot(bx - ax, by - ay);
  }

 private:
  const Scene& scene_;
  std::unordered_map<std::string_view, GroupNodes> groups_;
  std::unordered_map<std::string_view, std::size_t> nodes_, surfaces_;
  std::unordered_map<std::string, std::vector<const Solid*>> solids_;
  std::unordered_set<std::string_view> mid_sides_;  // nodes of solids
};

// Calls add(load on a node) for a traction on a surface.
template <typename Add>
void ExpandTraction(const Load& load, const BoundarySurface& surface, const Groups& groups, Add&& add) {
  std::vector<std::string> nodes = surface.nodes;
  if (surface.closed) nodes.push_back(nodes.front());
  const auto give = [&](const std::string& node, double length) {
    add(Load{node, length * load.px, length * load.py, load.constant});
  };
  for (std::size_t i = 0; i + 1 < nodes.size();) {
    if (i + 2 < nodes.size() && groups.IsMidSide(nodes[i + 1])) {
      const std::array<double, 3> lengths =
          ShapeLengths(groups.Place(nodes[i]), groups.Place(nodes[i + 1]), groups.Place(nodes[i + 2]));
      for (std::size_t k = 0; k < 3; ++k) give(nodes[i + k], lengths[k]);
      i += 2;
    } else {
      const double half = 0.5 * groups.Length(nodes[i], nodes[i + 1]);
      give(nodes[i], half);
      give(nodes[i + 1], half);
      ++i;
    }
  }
}

// Calls add(load on a node) for the weight of a solid, once for each of its nodes.
template <typename Add>
void ExpandWeight(const Load& load, const Solid& solid, const Groups& groups, Add&& add) {
  const std::size_t count = solid.NodesPerElement();
  std::unordered_map<std::string_view, std::size_t> places;
  std::vector<std::pair<std::string, double>> volumes;
  for (std::size_t first = 0; first < solid.nodes.size(); first += count) {
    std::vector<double> positions;
    for (std::size_t i = 0; i < count; ++i) {
      const auto [x, y] = groups.Place(solid.nodes[first + i]);
      positions.insert(positions.end(), {x, y});
    }
    for (const PlacedPoint& point : PlacePoints(positions))
      for (std::size_t i = 0; i < count; ++i) {
        const auto [at, is_new] = places.emplace(solid.nodes[first + i], volumes.size());
        if (is_new) volumes.emplace_back(at->first, 0.0);
        volumes[at->second].second += solid.Thickness() * point.area * point.values[i];
      }
  }
  for (const auto& [node, volume] : volumes) add(Load{node, volume * load.bx, volume * load.by, load.constant});
}

// Calls add(load on a node).
template <typename Add>
void ExpandLoad(Load load, const Groups& groups, Add&& add) {
  if (const BoundarySurface* const surface = groups.FindSurface(load.surface))
    return ExpandTraction(load, *surface, groups, add);
  if (const std::vector<const Solid*> solids = groups.FindSolids(load.solid); !solids.empty()) {
    for (const Solid* const solid : solids) ExpandWeight(load, *solid, groups, add);
    return;
  }
  if (!load.beam.empty()) {
    load.group = std::exchange(load.beam, {});
    load.px += std::exchange(load.bx, 0.0);
    load.py += std::exchange(load.by, 0.0);
  }
  const GroupNodes* const found = groups.Find(load.group);
  if (found == nullptr) return add(load);
  const GroupNodes& group = *found;
  if (load.fx != 0.0 || load.fy != 0.0 || load.moment != 0.0)
    for (const std::string& node : *group.nodes) add(Load{node, load.fx, load.fy, load.constant, load.moment});
  if (group.beam == nullptr || (load.px == 0.0 && load.py == 0.0)) return;
  const std::vector<std::string>& nodes = *group.nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    double length = 0.0;
    if (i > 0) length += 0.5 * groups.Length(nodes[i - 1], nodes[i]);
    if (i + 1 < nodes.size()) length += 0.5 * groups.Length(nodes[i], nodes[i + 1]);
    add(Load{nodes[i], length * load.px, length * load.py, load.constant});
  }
}

// expand(part, add): calls add(part on a node) for a part of the list.
template <typename Part, typename Expander>
ListPlaces ExpandList(std::vector<Part>* list, Expander&& expand) {
  std::vector<Part> expanded;
  ListPlaces places;
  for (std::size_t i = 0; i < list->size(); ++i)
    expand((*list)[i], [&](const Part& part) {
      expanded.push_back(part);
      places.push_back(i);
    });
  *list = std::move(expanded);
  return places;
}

// Calls add(part on a node) for each node of its group, or with the part as it is.
template <typename Part, typename Add>
void ForEachNode(Part part, const Groups& groups, Add&& add) {
  const GroupNodes* const group = groups.Find(part.group);
  if (group == nullptr) return add(part);
  part.group.clear();
  for (const std::string& node : *group->nodes) {
    part.node = node;
    add(part);
  }
}

// A load or a motion of a body is one of its node.
template <typename Part>
Part OnNode(Part part) {
  if (part.body.empty()) return part;
  part.node = std::exchange(part.body, {});
  if constexpr (std::is_same_v<Part, Load>) {
    part.fx += std::exchange(part.bx, 0.0);
    part.fy += std::exchange(part.by, 0.0);
  }
  return part;
}

ListPlaces ExpandContacts(const Groups& groups, PinnedTwins* twins, Scene* scene) {
  return ExpandList(&scene->contacts, [&](const ContactCandidate& contact, auto&& add) {
    const auto is_partner = [&](const Obstacle& of) { return of.name == contact.obstacles[1]; };
    if (const Obstacle* const circle = RollingCircle(contact, *scene);
        circle != nullptr && contact.obstacles.size() == 2 &&
        std::any_of(scene->obstacles.begin(), scene->obstacles.end(), is_partner)) {
      ContactCandidate rolling = contact;
      rolling.node = CentreNode(*circle, *scene);
      rolling.obstacle = contact.obstacles.back();
      return add(rolling);
    }
    const BoundarySurface* const surface = groups.FindSurface(contact.surface);
    const bool all = groups.Find(contact.group) == nullptr || (surface != nullptr && groups.CanMove(*surface));
    ForEachNode(contact, groups, [&](ContactCandidate on_node) {
      if (!all && !groups.CanMove(on_node.node)) return;
      if (on_node.OnSurface() && twins->IsOfBody(on_node.node)) {
        on_node.twin_of = on_node.node;
        on_node.node = twins->TwinOf(on_node.node);
      }
      add(on_node);
    });
  });
}

// Scene or Stage.
template <typename Loading>
void ExpandLoading(const Groups& groups, PinnedTwins* twins, Loading* loading, Expansion* expansion) {
  expansion->loads.push_back(ExpandList(&loading->loads, [&](const Load& load, auto&& add) {
    ExpandLoad(OnNode(load), groups, [&](const Load& on_node) { twins->Move(on_node, add); });
  }));
  expansion->motions.push_back(ExpandList(&loading->support_motions, [&](const SupportMotion& motion, auto&& add) {
    ForEachNode(OnNode(motion), groups, add);
  }));
}

// Of an expanded scene but for its supports.
void FixNodes(const Groups& groups, Scene* scene) {
  if (scene->supports.empty()) return;
  const auto places = PlacesByName(scene->nodes);
  const std::vector<bool> turns = NodesThatTurn(*scene);
  for (const Support& support : std::exchange(scene->supports, {}))
    ForEachNode(support, groups, [&](const Support& on_node) {
      const auto place = places.find(on_node.node);
      if (place == places.end()) return;
      Node& node = scene->nodes[place->second];
      node.fixed_x = node.fixed_x || support.fixed_x;
      node.fixed_y = node.fixed_y || support.fixed_y;
      node.fixed_rotation = node.fixed_rotation || (support.fixed_rotation && turns[place->second]);
    });
}

}  // namespace

std::vector<OneSidedBar> OneSidedBars(const Scene& scene) {
  std::vector<OneSidedBar> bars;
  for (std::size_t i = 0; i < scene.bars.size(); ++i)
    if (const Bar& bar = scene.bars[i]; bar.sense != BarSense::kBoth)
      bars.push_back({BarName(bar, i), &bar.nodes, bar.EA, bar.rest_length, bar.strain, bar.sense});
  for (std::size_t i = 0; i < scene.tendons.size(); ++i) {
    const Tendon& tendon = scene.tendons[i];
    bars.push_back({TendonName(tendon, i), &tendon.nodes, tendon.EA, tendon.rest_length, StrainMeasure::kBiot,
                    BarSense::kTension, &tendon});
  }
  return bars;
}

int BeamSegments(const Beam& beam) { return beam.segments > 0 ? beam.segments : kSegments; }

bool TurnsNode(const Beam& beam, std::size_t place) {
  if (beam.hinged.empty()) return true;
  return !(place == 0 && beam.hinged.front()) && !(place + 1 == beam.nodes.size() && beam.hinged.back());
}

bool HasRotations(const Scene& scene) {
  return !scene.beams.empty() || !scene.bodies.empty() || std::any_of(scene.nodes.begin(), scene.nodes.end(), IsBody);
}

std::vector<bool> NodesThatTurn(const Scene& scene) {
  std::vector<bool> turn;
  for (const Node& node : scene.nodes) turn.push_back(IsBody(node));
  if (scene.beams.empty()) return turn;
  const auto places = PlacesByName(scene.nodes);
  for (const Beam& beam : scene.beams)
    for (std::size_t i = 0; i < beam.nodes.size(); ++i)
      if (const auto node = places.find(beam.nodes[i]); node != places.end() && TurnsNode(beam, i))
        turn[node->second] = true;
  return turn;
}

std::vector<bool> PinsInLoops(const Scene& scene) {
  std::vector<bool> in_loops(scene.pins.size(), false);
  if (scene.pins.empty()) return in_loops;
  const auto places = PlacesByName(scene.nodes);
  const std::size_t held = scene.nodes.size();  // what supports and contacts hold
  const auto owner = [&](const std::string& name) {
    const auto node = places.find(name);
    if (node == places.end()) return held;
    const auto found = places.find(TurnsWith(scene.nodes[node->second]));
    return found == places.end() ? held : found->second;
  };
  std::vector<std::size_t> parents(held + 1);
  std::iota(parents.begin(), parents.end(), std::size_t{0});
  const auto root = [](const std::vector<std::size_t>& of, std::size_t i) {
    while (of[i] != i) i = of[i];
    return i;
  };
  for (const Node& node : scene.nodes)
    if (node.fixed_x || node.fixed_y || node.fixed_rotation) parents[root(parents, owner(node.name))] = held;
  for (const ContactCandidate& contact : scene.contacts) parents[root(parents, owner(contact.node))] = held;
  for (std::size_t k = 0; k < scene.pins.size(); ++k) {
    std::vector<std::size_t> without = parents;
    for (std::size_t i = 0; i < scene.pins.size(); ++i)
      if (i != k) without[root(without, owner(scene.pins[i].nodes[0]))] = root(without, owner(scene.pins[i].nodes[1]));
    in_loops[k] = root(without, owner(scene.pins[k].nodes[0])) == root(without, owner(scene.pins[k].nodes[1]));
  }
  return in_loops;
}

const Obstacle* RollingCircle(const ContactCandidate& contact, const Scene& scene) {
  if (!contact.Rolls()) return nullptr;
  const auto found = std::find_if(scene.obstacles.begin(), scene.obstacles.end(),
                                  [&](const Obstacle& of) { return of.name == contact.obstacles.front(); });
  return found == scene.obstacles.end() ? nullptr : &*found;
}

std::string CentreNode(const Obstacle& circle, const Scene& scene) {
  const bool is_body = std::any_of(scene.nodes.begin(), scene.nodes.end(), [&](const Node& node) {
    return IsBody(node) && node.name == circle.body && node.x == circle.px && node.y == circle.py;
  });
  return is_body ? circle.body : circle.name;
}

bool RubsAtEyes(const Tendon& tendon) { return tendon.friction > 0.0 && tendon.nodes.size() > 2 && !tendon.IsPiece(); }

void ExpandParts(Scene* scene) {
  std::unordered_map<std::string, std::size_t> places;
  for (std::size_t i = 0; i < scene->nodes.size(); ++i) places.emplace(scene->nodes[i].name, i);
  for (std::size_t k = 0; k < scene->beams.size(); ++k) {
    Beam& beam = scene->beams[k];
    beam.name = BeamName(beam, k);
    if (IsExpanded(beam)) continue;
    beam.segments = BeamSegments(beam);
    const Node first = scene->nodes[places.at(beam.nodes[0])], second = scene->nodes[places.at(beam.nodes[1])];
    std::vector<std::string> nodes = {first.name};
    for (int i = 1; i < beam.segments; ++i) {
      Node inner = PointOfArc(first, second, beam.angle, static_cast<double>(i) / beam.segments);
      inner.name = beam.name + "/" + std::to_string(i);
      nodes.push_back(inner.name);
      scene->nodes.push_back(std::move(inner));
    }
    nodes.push_back(second.name);
    beam.nodes = std::move(nodes);
  }
  for (const RigidBody& body : std::exchange(scene->bodies, {}))
    scene->nodes.push_back({body.name, body.x, body.y, body.fixed_x, body.fixed_y, body.fixed_rotation, body.name});
  for (const ContactCandidate& contact : scene->contacts) {
    const Obstacle* const circle = RollingCircle(contact, *scene);
    if (circle == nullptr || CentreNode(*circle, *scene) != circle->name) continue;
    const auto of_name = [&](const Node& node) { return node.name == circle->name; };
    if (std::none_of(scene->nodes.begin(), scene->nodes.end(), of_name))
      scene->nodes.push_back({circle->name, circle->px, circle->py, false, false, false, circle->body});
  }
  for (std::size_t k = 0, count = scene->tendons.size(); k < count; ++k)
    if (RubsAtEyes(scene->tendons[k])) ExpandTendon(k, places, scene);
}

bool IsTouched(const BoundarySurface& surface, const Scene& scene) {
  return std::any_of(scene.contacts.begin(), scene.contacts.end(),
                     [&](const ContactCandidate& contact) { return contact.surface == surface.name; });
}

Expansion Expand(const TraceRequest& request) {
  Expansion expansion;
  expansion.request = request;
  Scene& scene = expansion.request.scene;
  ExpandParts(&scene);
  const Groups groups(scene);
  FixNodes(groups, &scene);
  PinnedTwins twins(scene);
  expansion.contacts = ExpandContacts(groups, &twins, &scene);
  ExpandLoading(groups, &twins, &scene, &expansion);
  for (Stage& stage : expansion.request.program) ExpandLoading(groups, &twins, &stage, &expansion);
  for (BoundarySurface& surface : scene.surfaces)
    if (IsTouched(surface, scene)) twins.Bear(&surface);
  twins.AddTo(&scene);
  FixIdleRotations(&expansion.request);
  return expansion;
}

bool NeedsExpansion(const TraceRequest& request) {
  const auto any_group = [](const auto& parts) {
    return std::any_of(parts.begin(), parts.end(), [](const auto& part) { return !part.group.empty(); });
  };
  const auto any_in = [&](const auto& loading) {
    return any_group(loading.loads) || any_group(loading.support_motions) ||
           std::any_of(loading.loads.begin(), loading.loads.end(), [](const Load& load) {
             return !load.surface.empty() || !load.solid.empty() || !load.beam.empty() || load.px != 0.0 ||
                    load.py != 0.0 || load.bx != 0.0 || load.by != 0.0;
           });
  };
  const Scene& scene = request.scene;
  return !scene.beams.empty() || !scene.bodies.empty() || !scene.groups.empty() || !scene.surfaces.empty() ||
         !scene.supports.empty() || std::any_of(scene.tendons.begin(), scene.tendons.end(), RubsAtEyes) ||
         any_in(scene) || any_group(scene.contacts) ||
         std::any_of(scene.contacts.begin(), scene.contacts.end(),
                     [](const ContactCandidate& contact) { return contact.OnSurface() || contact.Rolls(); }) ||
         std::any_of(request.program.begin(), request.program.end(), any_in);
}

}  // namespace contact_path
