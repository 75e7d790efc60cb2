#include "contact_path/scene/validate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iomanip>
#include <iterator>
#include <limits>
#include <locale>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "contact_path/scene/field.h"
#include "contact_path/scene/key_path.h"
#include "contact_path/scene/nearest_name.h"
#include "contact_path/scene/one_line.h"
#include "contact_path/scene/program.h"
#include "contact_path/scene/quantity.h"
#include "contact_path/scene/scene_index.h"
#include "contact_path/scene/utf8.h"

namespace contact_path {
namespace {

// Within these bounds no product or quotient that is formed of two inputs leaves the range of double.
constexpr double kLargest = 1e100;
constexpr double kSmallest = 1e-100;  // of what must be positive

// Relative bounds, far above rounding and far below anything meant.
constexpr double kSymmetry = 1e-9;       // of a stiffness matrix, by its largest entry
constexpr double kPenetration = 1e-9;    // of the initial gap, by the characteristic length
constexpr double kNormalOnFree = 1e-12;  // of the normal's part along free components
constexpr double kLoadLeft = 1e-12;      // of the sum of loads that cancel

// The shortest text that reads back as `value`, in YAML's spelling.
std::string NumberText(double value) {
  if (std::isnan(value)) return ".nan";
  if (std::isinf(value)) return value > 0.0 ? ".inf" : "-.inf";
  std::string text;
  for (int digits = 15; digits <= std::numeric_limits<double>::max_digits10; ++digits) {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out << std::setprecision(digits) << value;
    text = out.str();
    std::istringstream in(text);
    in.imbue(std::locale::classic());
    double back = 0.0;
    if (in >> back && back == value) break;
  }
  return text;
}

std::string TextOrQuotes(const std::string& text) { return text.empty() ? "\"\"" : text; }

std::string ListText(const std::vector<std::string>& names) {
  constexpr std::size_t kShown = 8;
  std::string text = "[";
  for (std::size_t i = 0; i < names.size() && i < kShown; ++i) text += (i > 0 ? ", " : "") + TextOrQuotes(names[i]);
  return text + (names.size() > kShown ? ", ...]" : "]");
}

// Names become columns of a table and parts of "<node>@<obstacle>" and "<node>.x".
bool IsAllowedInName(char c) {
  const auto code = static_cast<unsigned char>(c);
  return code > 0x20 && code != 0x7f && std::string_view("@,\"./").find(c) == std::string_view::npos;
}

const KeyPath kScene("scene");

std::string_view NameOf(const Node& node) { return node.name; }
std::string_view NameOf(const Obstacle& obstacle) { return obstacle.name; }
std::string NameOf(const ContactCandidate& contact) { return contact.Name(); }

template <typename Part>
NearestName NearestTo(const std::vector<Part>& parts, std::string_view wanted) {
  NearestName nearest(wanted);
  for (const Part& part : parts) nearest.Offer(NameOf(part));
  return nearest;
}

// What the stages of a program have brought on, summed by component: whether a stage that unloads has anything to take
// back. Takes time in proportion to what is added.
class BroughtOn {
 public:
  enum class Kind { kLoad, kSupport, kObstacle };

  // part: the place of the node or obstacle.
  void Add(Kind kind, std::size_t part, int component, double value) {
    const auto at = sums_.try_emplace({kind, part, component}).first;
    Sum& sum = at->second;
    sum.value += value / left_;
    sum.largest = std::max(sum.largest, std::abs(value / left_));
    if (std::abs(sum.value) <= kLoadLeft * sum.largest) sums_.erase(at);
  }
  void TakeBack(double share) {
    left_ *= 1.0 - share;
    if (left_ > kLoadLeft) return;
    sums_.clear();
    left_ = 1.0;
  }
  bool IsNothing() const { return sums_.empty(); }

 private:
  struct Sum {
    double value = 0.0, largest = 0.0;
  };
  std::map<std::tuple<Kind, std::size_t, int>, Sum> sums_;  // over left_
  double left_ = 1.0;
};

// Goes through a request in its own order and collects what is wrong. A rule that needs something which is already
// known to be wrong is left out, so that one mistake is not reported several times.
class Checker {
 public:
  explicit Checker(const TraceRequest& request)
      : request_(request), scene_(request.scene), options_(request.options), index_(request.scene) {
    for (const ContactCandidate& contact : scene_.contacts) {
      contact_nodes_.insert(contact.node);
      const Node* const node = KnownNode(contact.node);
      const Obstacle* const obstacle = KnownObstacle(contact.obstacle);
      if (node != nullptr && obstacle != nullptr && IsHeld(*node, *obstacle)) held_.emplace(obstacle, node);
    }
  }

  std::vector<Violation> Run() {
    std::vector<Violation> all, of_program;
    try {
      CheckUtf8(kScene.Key("name"), scene_.name);
      CheckNodes();
      CheckBars();
      CheckSuperelements();
      CheckLoads(kScene.Key("loads"), scene_.loads);
      CheckWhatMoves();
      const bool structure_is_sound = violations_.empty();
      CheckObstacles();
      std::swap(all, violations_);
      CheckMotions(kScene, scene_.support_motions, scene_.obstacle_motions);
      CheckProgram();
      std::swap(of_program, violations_);
      // Lengths are compared with the characteristic one, which may be that of the program.
      CheckContacts(structure_is_sound && of_program.empty() ? ProgramScales(request_).length : 0.0);
      CheckOptions();
    } catch (const Enough&) {
      // What was found so far tells.
    }
    for (std::vector<Violation>* const part : {&violations_, &of_program})
      std::move(part->begin(), part->end(), std::back_inserter(all));
    return all;
  }

 private:
  struct Enough {};  // thrown as soon as there are kMostViolations

  void Add(const KeyPath& path, std::string value, std::string rule) {
    Violation violation;
    violation.key = path.ToString();
    violation.value = std::move(value);
    violation.rule = std::move(rule);
    violations_.push_back(std::move(violation));
    if (++found_ >= kMostViolations) throw Enough();
  }

  // Checks each field of a part by itself, as its description says. earlier: the names of the parts before it in its
  // list; null for a part without a name. False after adding a violation.
  template <typename Part>
  bool CheckFields(const KeyPath& path, const Part& part, std::unordered_set<std::string>* earlier = nullptr) {
    const std::size_t found_before = found_;
    ForEachField<Part>([&](const auto& field) {
      const auto& value = part.*field.member;
      using Value = std::decay_t<decltype(value)>;
      const KeyPath key = path.Key(field.name);
      if constexpr (std::is_same_v<Value, double>) CheckNumber(key, value, field.range);
      if constexpr (std::is_same_v<Value, int>)
        if (value < 0 && field.range == Range::kNotNegative) Add(key, std::to_string(value), "must be >= 0");
      if constexpr (std::is_same_v<Value, std::string>) CheckText(key, value, field.text, earlier);
      if constexpr (std::is_same_v<Value, std::vector<double>>)
        for (std::size_t i = 0; i < value.size(); ++i) CheckNumber(key[i], value[i], field.range);
      if constexpr (std::is_same_v<Value, std::vector<std::string>>)
        for (std::size_t i = 0; i < value.size(); ++i) CheckText(key[i], value[i], field.text, earlier);
    });
    return found_ == found_before;
  }

  void CheckNumber(const KeyPath& key, double value, Range range) {
    if (!std::isfinite(value)) {
      Add(key, NumberText(value), "must be finite");
    } else if (std::abs(value) > kLargest) {
      Add(key, NumberText(value), "must not exceed 1e+100 in magnitude");
    } else if (range == Range::kNotNegative && value < 0.0) {
      Add(key, NumberText(value), "must be >= 0");
    } else if (range == Range::kPositive && value < kSmallest) {
      Add(key, NumberText(value), "must be > 0 (at least 1e-100)");
    } else if (range == Range::kZeroOrPositive && value != 0.0 && value < kSmallest) {
      Add(key, NumberText(value), "must be 0 or positive (at least 1e-100)");
    }
  }

  void CheckText(const KeyPath& key, const std::string& text, TextKind kind, std::unordered_set<std::string>* earlier) {
    switch (kind) {
      case TextKind::kAny: CheckUtf8(key, text); break;
      case TextKind::kNewName: CheckName(key, text, *earlier); break;
      case TextKind::kNode:
        if (!index_.FindNode(text))
          Add(key, TextOrQuotes(text), "must name a node of the scene" + NearestTo(scene_.nodes, text).Question());
        break;
      case TextKind::kObstacle:
        if (!index_.FindObstacle(text))
          Add(key, TextOrQuotes(text),
              "must name an obstacle of the scene" + NearestTo(scene_.obstacles, text).Question());
        break;
      case TextKind::kQuantity: CheckQuantity(key, text); break;
    }
  }

  // Others could not be read by clients in Python.
  bool CheckUtf8(const KeyPath& key, const std::string& name) {
    if (FindNoUtf8(name) == std::string_view::npos) return true;
    Add(key, name, "must be UTF-8");
    return false;
  }

  // `earlier` holds the names before this one.
  void CheckName(const KeyPath& key, const std::string& name, std::unordered_set<std::string>& earlier) {
    if (name.empty()) {
      Add(key, TextOrQuotes(name), "must not be empty");
    } else if (!CheckUtf8(key, name)) {
      return;
    } else if (!std::all_of(name.begin(), name.end(), IsAllowedInName)) {
      Add(key, name, "must not contain white space, control characters or any of @ , \" . /");
    } else if (!earlier.insert(name).second) {
      Add(key, name, "must be unique, but an earlier one has the same name");
    }
  }

  const Node* KnownNode(const std::string& name) const {
    const std::optional<std::size_t> place = index_.FindNode(name);
    return place ? &scene_.nodes[*place] : nullptr;
  }
  const Obstacle* KnownObstacle(const std::string& name) const {
    const std::optional<std::size_t> place = index_.FindObstacle(name);
    return place ? &scene_.obstacles[*place] : nullptr;
  }

  // The nodes that elements hold; nothing where elements refer to unknown nodes or where there are no elements.
  std::unordered_set<std::string> HeldNodes(bool* reliable) const {
    std::unordered_set<std::string> held;
    for (const Bar& bar : scene_.bars) held.insert(bar.nodes.begin(), bar.nodes.end());
    for (const Superelement& element : scene_.superelements) held.insert(element.nodes.begin(), element.nodes.end());
    *reliable = !held.empty() &&
                std::all_of(held.begin(), held.end(), [this](const auto& n) { return KnownNode(n) != nullptr; });
    return held;
  }

  void CheckNodes() {
    const KeyPath list = kScene.Key("nodes");
    if (scene_.nodes.empty()) return Add(list, "[]", "at least one node is needed");
    bool held_is_reliable = false;
    const std::unordered_set<std::string> held = HeldNodes(&held_is_reliable);
    std::unordered_set<std::string> earlier;
    for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
      const Node& node = scene_.nodes[i];
      CheckFields(list[i], node, &earlier);
      if (held_is_reliable && !(node.fixed_x && node.fixed_y) && held.count(node.name) == 0)
        Add(list[i], TextOrQuotes(node.name), "a node that is free to move must belong to a bar or a superelement");
    }
    if (!HasFreeComponent()) Add(list, "all fixed", "at least one component of a node must be free");
  }

  bool HasFreeComponent() const {
    return std::any_of(scene_.nodes.begin(), scene_.nodes.end(),
                       [](const Node& node) { return !node.fixed_x || !node.fixed_y; });
  }

  void CheckBars() {
    const KeyPath list = kScene.Key("bars");
    if (scene_.bars.empty() && scene_.superelements.empty() && !scene_.nodes.empty())
      Add(list, "[]", "at least one bar or superelement is needed");
    for (std::size_t i = 0; i < scene_.bars.size(); ++i) {
      CheckFields(list[i], scene_.bars[i]);
      CheckBarNodes(list[i].Key("nodes"), scene_.bars[i]);
    }
  }

  void CheckBarNodes(const KeyPath& key, const Bar& bar) {
    if (bar.nodes.size() != 2) return Add(key, ListText(bar.nodes), "must name two nodes");
    const Node *const first = KnownNode(bar.nodes[0]), *const second = KnownNode(bar.nodes[1]);
    if (first == nullptr || second == nullptr) return;
    const double distance = std::hypot(second->x - first->x, second->y - first->y);
    if (first == second) {
      Add(key, ListText(bar.nodes), "must name two different nodes");
    } else if (distance < kSmallest) {  // false for a distance that is not finite
      Add(key, ListText(bar.nodes), "the two nodes must not be at the same point");
    }
  }

  void CheckSuperelements() {
    const KeyPath list = kScene.Key("superelements");
    for (std::size_t i = 0; i < scene_.superelements.size(); ++i) {
      const Superelement& element = scene_.superelements[i];
      const KeyPath path = list[i], nodes = path.Key("nodes"), rest_positions = path.Key("rest_positions");
      const bool sound = CheckFields(path, element);
      if (element.nodes.empty()) Add(nodes, "[]", "at least one node is needed");
      std::unordered_set<std::string> earlier;
      for (std::size_t j = 0; j < element.nodes.size(); ++j)
        if (!earlier.insert(element.nodes[j]).second && KnownNode(element.nodes[j]) != nullptr)
          Add(nodes[j], element.nodes[j], "must not be repeated");
      if (!element.nodes.empty()) CheckStiffness(path.Key("stiffness"), element, sound);
      const std::size_t size = element.rest_positions.size();
      if (size != 0 && size != 2 * element.nodes.size())
        Add(rest_positions, std::to_string(size) + " entries",
            "must be empty or have " + std::to_string(2 * element.nodes.size()) + " entries: x, y of each node");
    }
  }

  // sound: all entries are.
  void CheckStiffness(const KeyPath& key, const Superelement& element, bool sound) {
    const std::vector<double>& entries = element.stiffness;
    const std::size_t rows = 2 * element.nodes.size();
    if (entries.size() != rows * rows) {
      return Add(key, std::to_string(entries.size()) + " entries",
                 "must have " + std::to_string(rows * rows) + " entries: " + std::to_string(rows) + " rows of " +
                     std::to_string(rows));
    }
    if (!sound) return;
    double largest = 0.0;
    for (const double entry : entries) largest = std::max(largest, std::abs(entry));
    if (largest < kSmallest) return Add(key, "all 0", "must not be zero (an entry of at least 1e-100 is needed)");
    for (std::size_t row = 0; row < rows; ++row) {
      for (std::size_t column = row + 1; column < rows; ++column) {
        const std::size_t above = row * rows + column;
        const std::size_t below = column * rows + row;
        if (std::abs(entries[above] - entries[below]) <= kSymmetry * largest) continue;
        return Add(
            key[below], NumberText(entries[below]),
            "the matrix must be symmetric, but entry [" + std::to_string(above) + "] is " + NumberText(entries[above]));
      }
    }
  }

  void CheckLoads(const KeyPath& list, const std::vector<Load>& loads) {
    for (std::size_t i = 0; i < loads.size(); ++i)
      loads_are_sound_ = CheckFields(list[i], loads[i]) && loads_are_sound_;
  }

  // Something must change with the load factor, of the scene or of each stage.
  void CheckWhatMoves() {
    const KeyPath list = kScene.Key("loads");
    if (!request_.program.empty()) {
      for (std::size_t i = 0; i < scene_.loads.size(); ++i)
        if (!scene_.loads[i].constant)
          Add(list[i].Key("constant"), "false",
              "must be true where there is a program: loads that a load factor scales belong to a stage");
      return;
    }
    if (loads_are_sound_ && HasFreeComponent() && !HasReferenceLoad(scene_.loads) && scene_.support_motions.empty() &&
        scene_.obstacle_motions.empty()) {
      Add(list, scene_.loads.empty() ? "[]" : "no net force",
          "a load that is not constant must act on a free component, or a support or an obstacle must move");
    }
  }

  void CheckProgram() {
    const bool program = !request_.program.empty();
    if (program && !scene_.support_motions.empty())
      Add(kScene.Key("support_motions"), "", "must be empty where there is a program: motions belong to its stages");
    if (program && !scene_.obstacle_motions.empty())
      Add(kScene.Key("obstacle_motions"), "", "must be empty where there is a program: motions belong to its stages");
    const KeyPath list("program");
    for (std::size_t i = 0; i < request_.program.size(); ++i) CheckStage(list[i], request_.program[i]);
  }

  void CheckStage(const KeyPath& path, const Stage& stage) {
    const KeyPath loads = path.Key("loads");
    const bool sound = CheckFields(path, stage);
    CheckLoads(loads, stage.loads);
    for (std::size_t k = 0; k < stage.loads.size(); ++k)
      if (stage.loads[k].constant)
        Add(loads[k].Key("constant"), "true", "must be false: constant loads belong to the scene");
    CheckMotions(path, stage.support_motions, stage.obstacle_motions);
    if (stage.unload)
      CheckUnloading(path, stage, sound);
    else if (loads_are_sound_ && HasFreeComponent() && !HasReferenceLoad(stage.loads) &&
             stage.support_motions.empty() && stage.obstacle_motions.empty())
      Add(path, stage.name, "a load must act on a free component, or a support or an obstacle must move");
    NoteBroughtOn(stage);
  }

  // sound: the numbers of the stage are.
  void CheckUnloading(const KeyPath& path, const Stage& stage, bool sound) {
    const char* const rule = "must be empty where the stage unloads: it takes back what the stages before have left";
    if (!stage.loads.empty()) Add(path.Key("loads"), "", rule);
    if (!stage.support_motions.empty()) Add(path.Key("support_motions"), "", rule);
    if (!stage.obstacle_motions.empty()) Add(path.Key("obstacle_motions"), "", rule);
    if (sound && !(stage.target >= 0.0 && stage.target <= 1.0))
      Add(path.Key("target"), NumberText(stage.target),
          "must be from 0 to 1 where the stage unloads: the part that is taken back, 0 = all");
    if (violations_.empty() && brought_on_.IsNothing())
      Add(path.Key("unload"), "true", "the stages before must have left a load or a motion that can be taken back");
  }

  // Nothing of a request that is not sound.
  void NoteBroughtOn(const Stage& stage) {
    if (!violations_.empty() || !loads_are_sound_) return;
    const double target = stage.Target();
    if (stage.unload) return brought_on_.TakeBack(target);
    for (const Load& load : stage.loads) {
      const std::size_t node = index_.Node(load.node);
      if (!scene_.nodes[node].fixed_x) brought_on_.Add(BroughtOn::Kind::kLoad, node, 0, target * load.fx);
      if (!scene_.nodes[node].fixed_y) brought_on_.Add(BroughtOn::Kind::kLoad, node, 1, target * load.fy);
    }
    for (const SupportMotion& motion : stage.support_motions) {
      const std::size_t node = index_.Node(motion.node);
      brought_on_.Add(BroughtOn::Kind::kSupport, node, 0, target * motion.dx);
      brought_on_.Add(BroughtOn::Kind::kSupport, node, 1, target * motion.dy);
    }
    for (const ObstacleMotion& motion : stage.obstacle_motions) {
      const std::size_t obstacle = index_.Obstacle(motion.obstacle);
      brought_on_.Add(BroughtOn::Kind::kObstacle, obstacle, 0, target * motion.dx);
      brought_on_.Add(BroughtOn::Kind::kObstacle, obstacle, 1, target * motion.dy);
    }
  }

  // Of a support or an obstacle.
  template <typename Motion>
  bool CheckMotion(const KeyPath& path, const Motion& motion) {
    if (!(std::abs(motion.dx) <= kLargest && std::abs(motion.dy) <= kLargest)) return false;
    if (std::hypot(motion.dx, motion.dy) >= kSmallest) return true;
    Add(path, "no motion", "dx or dy must not be zero (length at least 1e-100)");
    return false;
  }

  void CheckMotions(const KeyPath& where, const std::vector<SupportMotion>& supports,
                    const std::vector<ObstacleMotion>& obstacles) {
    const KeyPath support_list = where.Key("support_motions"), obstacle_list = where.Key("obstacle_motions");
    std::unordered_set<std::string> moved;
    for (std::size_t i = 0; i < supports.size(); ++i) {
      const SupportMotion& motion = supports[i];
      const KeyPath path = support_list[i];
      CheckFields(path, motion);
      if (!moved.insert(motion.node).second) Add(path.Key("node"), motion.node, "must not be repeated");
      const Node* const node = KnownNode(motion.node);
      if (!CheckMotion(path, motion) || node == nullptr) continue;
      if (motion.dx != 0.0 && !node->fixed_x)
        Add(path.Key("dx"), NumberText(motion.dx), "must be 0: node " + node->name + " is not fixed in x");
      if (motion.dy != 0.0 && !node->fixed_y)
        Add(path.Key("dy"), NumberText(motion.dy), "must be 0: node " + node->name + " is not fixed in y");
      if (contact_nodes_.count(motion.node) > 0)
        Add(path.Key("node"), motion.node, "must not be a contact candidate: its reactions would not be determined");
    }
    moved.clear();
    for (std::size_t i = 0; i < obstacles.size(); ++i) {
      const ObstacleMotion& motion = obstacles[i];
      const KeyPath path = obstacle_list[i];
      CheckFields(path, motion);
      if (!moved.insert(motion.obstacle).second) Add(path.Key("obstacle"), motion.obstacle, "must not be repeated");
      const Obstacle* const obstacle = KnownObstacle(motion.obstacle);
      if (CheckMotion(path, motion) && obstacle != nullptr) CheckNodesCanFollow(path, motion, *obstacle);
    }
  }

  // What an obstacle with friction drags along must be able to follow it, or its reaction is not determined.
  void CheckNodesCanFollow(const KeyPath& path, const ObstacleMotion& motion, const Obstacle& obstacle) {
    const double norm = std::hypot(obstacle.nx, obstacle.ny);
    const double along = std::abs(obstacle.ny * motion.dx - obstacle.nx * motion.dy) / norm;
    if (!(obstacle.friction > 0.0) || along <= kNormalOnFree * std::hypot(motion.dx, motion.dy)) return;
    const auto held = held_.find(&obstacle);
    if (held != held_.end())
      Add(path.Key("obstacle"), motion.obstacle,
          "moves along itself with friction: node " + held->second->name + " must be free to move that way");
  }

  // Whether the node cannot move along the obstacle.
  static bool IsHeld(const Node& node, const Obstacle& obstacle) {
    const double free_part = std::hypot(node.fixed_x ? 0.0 : obstacle.ny, node.fixed_y ? 0.0 : obstacle.nx);
    return free_part <= kNormalOnFree * std::hypot(obstacle.nx, obstacle.ny);
  }

  // Whether the loads that the load factor scales, summed by node, leave something on a free component.
  bool HasReferenceLoad(const std::vector<Load>& loads) const {
    std::map<const Node*, std::array<double, 2>> sums;
    double largest = kSmallest / kLoadLeft;
    for (const Load& load : loads) {
      if (load.constant) continue;
      const Node* const node = KnownNode(load.node);
      const std::array<double, 2> force = {node->fixed_x ? 0.0 : load.fx, node->fixed_y ? 0.0 : load.fy};
      for (std::size_t k = 0; k < 2; ++k) {
        sums[node][k] += force[k];
        largest = std::max(largest, std::abs(force[k]));
      }
    }
    return std::any_of(sums.begin(), sums.end(), [&](const auto& sum) {
      return std::hypot(sum.second[0], sum.second[1]) >= kLoadLeft * largest;
    });
  }

  void CheckObstacles() {
    const KeyPath list = kScene.Key("obstacles");
    std::unordered_set<std::string> earlier;
    for (std::size_t i = 0; i < scene_.obstacles.size(); ++i) {
      const Obstacle& obstacle = scene_.obstacles[i];
      CheckFields(list[i], obstacle, &earlier);
      const double norm = std::hypot(obstacle.nx, obstacle.ny);
      if (norm < kSmallest)  // false for a normal that is not finite
        Add(list[i].Key("nx"), NumberText(obstacle.nx),
            "the normal (nx, ny) must not be zero (length at least 1e-100)");
      bool usable = norm >= kSmallest;
      for (const double number : {obstacle.px, obstacle.py, obstacle.nx, obstacle.ny})
        usable = usable && std::abs(number) <= kLargest;
      if (usable) usable_obstacles_.insert(&obstacle);
    }
  }

  // length: the characteristic length, 0 where it is not known.
  void CheckContacts(double length) {
    const KeyPath list = kScene.Key("contacts");
    std::set<std::pair<std::string, std::string>> earlier;
    for (std::size_t i = 0; i < scene_.contacts.size(); ++i) {
      const ContactCandidate& contact = scene_.contacts[i];
      CheckFields(list[i], contact);
      const Node* const node = KnownNode(contact.node);
      const Obstacle* const obstacle = KnownObstacle(contact.obstacle);
      if (!earlier.emplace(contact.node, contact.obstacle).second)
        Add(list[i], contact.Name(), "must not be repeated");
      else if (node != nullptr && obstacle != nullptr && usable_obstacles_.count(obstacle) > 0)
        CheckContactGeometry(list[i], contact, *node, *obstacle, length);
    }
  }

  void CheckContactGeometry(const KeyPath& path, const ContactCandidate& contact, const Node& node,
                            const Obstacle& obstacle, double length) {
    const double norm = std::hypot(obstacle.nx, obstacle.ny);
    const double free_part = std::hypot(node.fixed_x ? 0.0 : obstacle.nx, node.fixed_y ? 0.0 : obstacle.ny);
    if (free_part <= kNormalOnFree * norm)
      Add(path.Key("node"), contact.node, "must be free to move along the normal of the obstacle");
    const double gap =
        obstacle.nx / norm * (node.x - obstacle.px) + obstacle.ny / norm * (node.y - obstacle.py);  // [length]
    if (length > 0.0 && gap < -kPenetration * length)
      Add(path, contact.Name(), "initial position penetrates the obstacle by " + NumberText(-gap));
  }

  void CheckOptions() {
    const KeyPath path("options"), stops = path.Key("stop"), choices = path.Key("branch_choices");
    if (CheckFields(path, options_) && options_.direction != 0.0 && !request_.program.empty())
      Add(path.Key("direction"), NumberText(options_.direction),
          "must be 0 where there is a program: each stage goes towards its target");
    for (std::size_t i = 0; i < options_.stop.size(); ++i) {
      const StopCriterion& stop = options_.stop[i];
      CheckFields(stops[i], stop);
      if (stop.when != ">" && stop.when != "<")
        Add(stops[i].Key("when"), TextOrQuotes(stop.when), "must be \">\" or \"<\"");
    }
    for (std::size_t i = 0; i < options_.branch_choices.size(); ++i) {
      const BranchChoice& choice = options_.branch_choices[i];
      CheckFields(choices[i], choice);
      if (choice.event > 0 && choice.increment > 0)
        Add(choices[i].Key("increment"), std::to_string(choice.increment), "must be 0 where event is given");
    }
  }

  void CheckQuantity(const KeyPath& key, const std::string& text) {
    const std::optional<SpelledQuantity> quantity = ReadQuantity(text);
    if (!quantity) {
      Add(key, TextOrQuotes(text),
          "must be load_factor, <node>.x, <node>.y, <contact>.gap, <contact>.rn or <contact>.rt");
    } else if (quantity->kind == Quantity::Kind::kLoadFactor) {
      if (!request_.program.empty())
        Add(key, text, "must be of a node or contact where there is a program: each stage has a target of its own");
    } else if (!FindQuantity(text, index_)) {
      const bool of_node = Quantity{quantity->kind, 0}.IsOfNode();
      const NearestName nearest =
          of_node ? NearestTo(scene_.nodes, quantity->name) : NearestTo(scene_.contacts, quantity->name);
      const std::string question =
          nearest.Get().empty()
              ? ""
              : "; did you mean " + QuantityText(quantity->kind, nearest.Get(), quantity->is_column) + "?";
      Add(key, text,
          (of_node ? "must refer to a node of the scene" : "must refer to a contact of the scene") + question);
    }
  }

  const TraceRequest& request_;
  const Scene& scene_;
  const TraceOptions& options_;
  const SceneIndex index_;
  std::unordered_set<std::string_view> contact_nodes_;
  std::unordered_map<const Obstacle*, const Node*> held_;  // the first candidate of each that cannot follow it
  std::unordered_set<const Obstacle*> usable_obstacles_;   // with a sound point and normal
  bool loads_are_sound_ = true;                            // as far as checked
  BroughtOn brought_on_;                                   // by the stages so far
  std::vector<Violation> violations_;                      // of the part that is being checked
  std::size_t found_ = 0;                                  // in all parts
};

}  // namespace

std::string Violation::ToLine() const {
  std::string text;
  if (!file.empty()) text += OneLine(file) + ":";
  if (line > 0) text += (file.empty() ? "line " : "") + std::to_string(line) + ":";
  if (!text.empty()) text += " ";
  text += OneLine(key);
  if (!key.empty() && !value.empty()) text += " = ";
  text += OneLine(value);
  if (!key.empty() || !value.empty()) text += ": ";
  return text + OneLine(rule);
}

InvalidRequest::InvalidRequest(std::vector<Violation> violations)
    : std::invalid_argument(violations.empty() ? "invalid request" : violations.front().ToLine()),
      violations_(std::move(violations)) {}

std::vector<Violation> Validate(const TraceRequest& request) { return Checker(request).Run(); }

}  // namespace contact_path
