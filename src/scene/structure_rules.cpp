
#include <algorithm>
#include <cmath>
#include <set>

#include "contact_path/scene/scaling.h"
#include "contact_path/scene/tendon_route.h"
#include "scene/rules.h"

namespace contact_path {
namespace {

// "bar or superelement".
std::string ElementKinds() {
  std::vector<std::string_view> kinds;
  ForEachElementList(Scene(), [&](std::string_view list, const auto&) {
    kinds.push_back(list.substr(0, list.size() - 1));  // one of them
  });
  return Either(kinds);
}

class StructureRules {
 public:
  explicit StructureRules(Checker* checker) : checker_(*checker), scene_(checker->GetScene()) {}

  void CheckNodes() {
    const KeyPath list = kScene.Key("nodes");
    if (scene_.nodes.empty()) return checker_.Add(list, "[]", "at least one node is needed");
    bool held_is_reliable = false;
    const std::unordered_set<std::string> held = HeldNodes(&held_is_reliable);
    std::unordered_set<std::string> earlier;
    for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
      const Node& node = scene_.nodes[i];
      if (i >= checker_.NumListedNodes()) break;
      checker_.CheckFields(list[i], node, &earlier);
      if (node.fixed_rotation && !node.name.empty() && !checker_.Turns(node.name))
        checker_.Add(list[i].Key("fixed_rotation"), "true", "must be false: no beam turns this node");
      CheckBodyOf(list[i], node);
      if (held_is_reliable && node.body.empty() && !(node.fixed_x && node.fixed_y) && held.count(node.name) == 0)
        checker_.Add(list[i], TextOrQuotes(node.name),
                     "a node that is free to move must belong to a " + ElementKinds());
    }
    if (!checker_.HasFreeComponent()) checker_.Add(list, "all fixed", "at least one component of a node must be free");
  }

  void CheckElements() {
    bool any = false;
    ForEachElementList(scene_, [&](std::string_view, const auto& elements) { any = any || !elements.empty(); });
    if (!any && !scene_.nodes.empty() && std::none_of(scene_.nodes.begin(), scene_.nodes.end(), IsBody))
      checker_.Add(kScene.Key("bars"), "[]", "at least one " + ElementKinds() + " is needed");
    ForEachElementList(scene_, [&](std::string_view name, const auto& elements) {
      const KeyPath list = kScene.Key(name);
      for (std::size_t i = 0; i < elements.size(); ++i) CheckElement(list[i], elements[i]);
    });
    std::unordered_set<std::string> earlier;   // names of bars, as columns have them
    std::unordered_set<std::string> by_place;  // of bars without a name, and of the forces of all
    for (std::size_t i = 0; i < scene_.bars.size(); ++i) by_place.insert(BarName({}, i));
    for (std::size_t i = 0; i < scene_.bars.size(); ++i) {
      const std::string name = BarName(scene_.bars[i], i);
      checker_.CheckName(kScene.Key("bars")[i].Key("name"), name, &earlier);
      if (name != BarName({}, i) && by_place.count(name) != 0)
        checker_.Add(kScene.Key("bars")[i].Key("name"), name, "must not be that of the place of another bar");
    }
    for (const Beam& beam : scene_.beams) earlier.insert(beam.name);  // whose sections have names alike
    for (std::size_t i = 0; i < scene_.tendons.size(); ++i) {
      const Tendon& tendon = scene_.tendons[i];
      if (tendon.IsPiece() && !tendon.slides[0].empty()) continue;  // it has its name from the first one
      const std::string name = TendonName(tendon, i);
      checker_.CheckName(kScene.Key("tendons")[i].Key("name"),
                         tendon.IsPiece() ? name.substr(0, name.rfind('/')) : name, &earlier);
    }
    std::unordered_set<std::string> earlier_pins, reacting;  // whose columns have names alike
    const auto add_names = [&](const auto& parts) {
      for (const auto& part : parts) reacting.insert(part.name);
    };
    add_names(scene_.nodes);
    add_names(scene_.obstacles);
    add_names(scene_.surfaces);
    const KeyPath pins = kScene.Key("pins");
    for (std::size_t i = 0; i < scene_.pins.size(); ++i) {
      const std::string name = PinName(scene_.pins[i], i);
      if (reacting.count(name) > 0)
        checker_.Add(pins[i].Key("name"), name,
                     "must not be the name of a node, a body, an obstacle or a surface, too");
      else
        checker_.CheckName(pins[i].Key("name"), name, &earlier_pins);
    }
  }

 private:
  void CheckBodyOf(const KeyPath& path, const Node& node) {
    if (node.body.empty()) return;
    if (checker_.KnownNode(node.body) == &node)
      checker_.Add(path.Key("body"), node.body, "must name a body of the scene");
    checker_.CheckBody(path, node.body);
    for (const auto& [name, fixed] : {std::pair("fixed_x", node.fixed_x), std::pair("fixed_y", node.fixed_y),
                                      std::pair("fixed_rotation", node.fixed_rotation)})
      if (fixed) checker_.Add(path.Key(name), "true", "must be false: the node moves with body " + node.body);
  }

  // The nodes that elements hold; nothing where elements refer to unknown nodes or where there are no elements.
  std::unordered_set<std::string> HeldNodes(bool* reliable) const {
    std::unordered_set<std::string> held;
    ForEachElementList(scene_, [&](std::string_view, const auto& elements) {
      for (const auto& element : elements) held.insert(element.nodes.begin(), element.nodes.end());
    });
    *reliable = !held.empty() && std::all_of(held.begin(), held.end(),
                                             [this](const auto& n) { return checker_.KnownNode(n) != nullptr; });
    return held;
  }

  template <typename Part>
  void CheckElement(const KeyPath& path, const Part& element) {
    const bool sound = checker_.CheckFields(path, element);
    const KeyPath nodes = path.Key("nodes");
    if constexpr (std::is_same_v<Part, Bar>) {
      CheckTwoNodes(&checker_, nodes, element.nodes);
    } else if constexpr (std::is_same_v<Part, Tendon>) {
      CheckSpans(nodes, element.nodes, element.IsPiece());
      if (sound) CheckRollers(path, element);
      if (element.friction > 0.0 && element.nodes.size() == 2)
        checker_.Add(path.Key("friction"), NumberText(element.friction), "must be 0 without a node between its ends");
    } else if constexpr (std::is_same_v<Part, Pin>) {
      CheckPinned(nodes, element);
    } else if constexpr (std::is_same_v<Part, Beam> || std::is_same_v<Part, Superelement>) {
      CheckNodeList(nodes, element.nodes);
    } else {
      static_assert(std::is_same_v<Part, Solid>);  // of a mesh, each element has nodes of its own
    }
    CheckOwnRules(path, element, sound);
  }

  void CheckNodeList(const KeyPath& key, const std::vector<std::string>& nodes) {
    if (nodes.empty()) checker_.Add(key, "[]", "at least one node is needed");
    std::unordered_set<std::string> earlier;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (!earlier.insert(nodes[i]).second && checker_.KnownNode(nodes[i]) != nullptr)
        checker_.Add(key[i], nodes[i], "must not be repeated");
  }

  void CheckSpans(const KeyPath& key, const std::vector<std::string>& nodes, bool piece) {
    if (nodes.size() < 2) return checker_.Add(key, ListText(nodes), "must name two nodes at least");
    std::set<std::pair<std::string, int>> unknowns;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Node* const node = checker_.KnownNode(nodes[i]);
      const Node* const next = checker_.KnownNode(nodes[(i + 1) % nodes.size()]);
      if (node == nullptr || next == nullptr) return;
      if (i + 1 < nodes.size() && std::hypot(next->x - node->x, next->y - node->y) < kSmallestInput)
        checker_.Add(key[i + 1], nodes[i + 1], "must not be at the same point as the node before");
      const Node& moves =
          IsAttached(*node) && checker_.KnownNode(node->body) != nullptr ? *checker_.KnownNode(node->body) : *node;
      if (!moves.fixed_x) unknowns.emplace(moves.name, 0);
      if (!moves.fixed_y) unknowns.emplace(moves.name, 1);
      if (IsBody(moves) && !moves.fixed_rotation) unknowns.emplace(moves.name, 2);
    }
    if (!piece && unknowns.size() > kMostTendonUnknowns)
      checker_.Add(key, ListText(nodes),
                   "must have at most " + std::to_string(kMostTendonUnknowns) + " unknowns that move its nodes: has " +
                       std::to_string(unknowns.size()));
  }

  void CheckRollers(const KeyPath& path, const Tendon& tendon) {
    if (const std::optional<RollerFault> fault = FindRollerFault(tendon)) {
      const KeyPath list = path.Key(fault->field);
      return checker_.Add(fault->entry ? list[*fault->entry] : list, fault->value, fault->rule);
    }
    const std::size_t count = tendon.nodes.size();
    for (std::size_t i = 0; i < tendon.radii.size(); ++i) {
      const Node* const node = checker_.KnownNode(tendon.nodes[i]);
      const Node* const next = i + 1 < count ? checker_.KnownNode(tendon.nodes[i + 1]) : nullptr;
      if (node != nullptr && next != nullptr && !SpanIsSound(tendon, i, {next->x - node->x, next->y - node->y}))
        return checker_.Add(path.Key("radii")[i + 1], NumberText(tendon.radii[i + 1]),
                            "must leave room for the string between the roller and the one before");
    }
  }

  void CheckPinned(const KeyPath& key, const Pin& pin) {
    const std::vector<std::string>& nodes = pin.nodes;
    if (nodes.size() != 2) return checker_.Add(key, ListText(nodes), "must name two nodes");
    const Node *const first = checker_.KnownNode(nodes[0]), *const second = checker_.KnownNode(nodes[1]);
    if (first == nullptr || second == nullptr) return;
    if (TurnsWith(*first) == TurnsWith(*second))
      return checker_.Add(key, ListText(nodes),
                          first == second ? "must name two different nodes"
                                          : "must not name two nodes of one body: " + TurnsWith(*first));
    if (!pinned_.insert(std::minmax(nodes[0], nodes[1])).second)
      return checker_.Add(key, ListText(nodes), "must not be repeated: an earlier pin holds these nodes together");
    const double apart = std::hypot(second->x - first->x, second->y - first->y);
    if (apart > kWrittenRounding * ExtentOfNodes(scene_))
      return checker_.Add(
          key, ListText(nodes),
          "the two nodes must be at the same point at the start: they are " + NumberText(apart) + " apart");
    if (!CanMove(*first) && !CanMove(*second))
      return checker_.Add(key, ListText(nodes), "one of the two nodes must be free to move");
    if (!(pin.stiffness > 0.0)) return;
    for (const Node* const node : {first, second})
      if (checker_.KnownNode(TurnsWith(*node)) != nullptr && !checker_.Turns(TurnsWith(*node)))
        checker_.Add(key, node->name,
                     "must be of a body, or a node that a beam turns, where the pin has a stiffness: a spring turns "
                     "both of its nodes");
  }

  // Whether anything of the node is free, or of the body that it moves with.
  bool CanMove(const Node& node) const {
    const Node* const moves = checker_.KnownNode(TurnsWith(node));
    return moves == nullptr || !moves->fixed_x || !moves->fixed_y || (IsAttached(node) && !moves->fixed_rotation);
  }

  // What the description of an element does not tell. sound: its fields are.
  template <typename Part>
  void CheckOwnRules(const KeyPath&, const Part&, bool) {}

  void CheckOwnRules(const KeyPath& path, const Solid& solid, bool sound) { CheckSolid(path, solid, sound, &checker_); }

  void CheckOwnRules(const KeyPath& path, const Superelement& element, bool sound) {
    if (!element.nodes.empty()) CheckStiffness(path.Key("stiffness"), element, sound);
    const std::size_t size = element.rest_positions.size();
    if (size != 0 && size != 2 * element.nodes.size())
      checker_.Add(path.Key("rest_positions"), std::to_string(size) + " entries",
                   "must be empty or have " + std::to_string(2 * element.nodes.size()) + " entries: x, y of each node");
  }

  // sound: all entries are.
  void CheckStiffness(const KeyPath& key, const Superelement& element, bool sound) {
    const std::vector<double>& entries = element.stiffness;
    const std::size_t rows = 2 * element.nodes.size();
    if (entries.size() != rows * rows) {
      return checker_.Add(key, std::to_string(entries.size()) + " entries",
                          "must have " + std::to_string(rows * rows) + " entries: " + std::to_string(rows) +
                              " rows of " + std::to_string(rows));
    }
    if (!sound) return;
    double largest = 0.0;
    for (const double entry : entries) largest = std::max(largest, std::abs(entry));
    if (largest < kSmallestInput)
      return checker_.Add(key, "all 0", "must not be zero (an entry of at least 1e-100 is needed)");
    for (std::size_t row = 0; row < rows; ++row) {
      for (std::size_t column = row + 1; column < rows; ++column) {
        const std::size_t above = row * rows + column;
        const std::size_t below = column * rows + row;
        if (std::abs(entries[above] - entries[below]) <= kWrittenRounding * largest) continue;
        return checker_.Add(
            key[below], NumberText(entries[below]),
            "the matrix must be symmetric, but entry [" + std::to_string(above) + "] is " + NumberText(entries[above]));
      }
    }
  }

  Checker& checker_;
  const Scene& scene_;
  std::set<std::pair<std::string, std::string>> pinned_;  // nodes of the pins before
};

}  // namespace

void CheckStructure(Checker* checker) {
  StructureRules rules(checker);
  rules.CheckNodes();
  CheckMaterials(checker);
  rules.CheckElements();
}

void CheckTwoNodes(Checker* checker, const KeyPath& key, const std::vector<std::string>& nodes) {
  if (nodes.size() != 2) return checker->Add(key, ListText(nodes), "must name two nodes");
  const Node *const first = checker->KnownNode(nodes[0]), *const second = checker->KnownNode(nodes[1]);
  if (first == nullptr || second == nullptr) return;
  const double distance = std::hypot(second->x - first->x, second->y - first->y);
  if (first == second) {
    checker->Add(key, ListText(nodes), "must name two different nodes");
  } else if (distance < kSmallestInput) {  // false for a distance that is not finite
    checker->Add(key, ListText(nodes), "the two nodes must not be at the same point");
  }
}

}  // namespace contact_path
