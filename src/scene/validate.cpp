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
#include <set>
#include <sstream>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "contact_path/scene/one_line.h"
#include "contact_path/scene/program.h"
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

std::string Indexed(const std::string& list, std::size_t index) { return list + "[" + std::to_string(index) + "]"; }

// Names become columns of a table and parts of "<node>@<obstacle>" and "<node>.x".
bool IsAllowedInName(char c) {
  const auto code = static_cast<unsigned char>(c);
  return code > 0x20 && code != 0x7f && std::string_view("@,\"./").find(c) == std::string_view::npos;
}

// Goes through a request in its own order and collects what is wrong. A rule that needs something which is already
// known to be wrong is left out, so that one mistake is not reported several times.
class Checker {
 public:
  explicit Checker(const TraceRequest& request) : request_(request), scene_(request.scene), options_(request.options) {
    for (const Node& node : scene_.nodes) nodes_.emplace(node.name, &node);
    for (const Obstacle& obstacle : scene_.obstacles) obstacles_.emplace(obstacle.name, &obstacle);
    for (const ContactCandidate& contact : scene_.contacts) {
      contact_nodes_.insert(contact.node);
      const auto node = nodes_.find(contact.node);
      const auto obstacle = obstacles_.find(contact.obstacle);
      if (node != nodes_.end() && obstacle != obstacles_.end() && IsHeld(*node->second, *obstacle->second))
        held_.emplace(obstacle->second, node->second);
    }
  }

  std::vector<Violation> Run() {
    std::vector<Violation> all, of_program;
    try {
      CheckUtf8("scene.name", scene_.name);
      CheckNodes();
      CheckBars();
      CheckSuperelements();
      CheckLoads("scene", scene_.loads);
      CheckWhatMoves();
      const bool structure_is_sound = violations_.empty();
      CheckObstacles();
      std::swap(all, violations_);
      CheckMotions("scene", scene_.support_motions, scene_.obstacle_motions);
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

  void Add(std::string key, std::string value, std::string rule) {
    Violation violation;
    violation.key = std::move(key);
    violation.value = std::move(value);
    violation.rule = std::move(rule);
    violations_.push_back(std::move(violation));
    if (++found_ >= kMostViolations) throw Enough();
  }

  bool CheckNumber(const std::string& key, double value) {
    if (!std::isfinite(value)) {
      Add(key, NumberText(value), "must be finite");
    } else if (std::abs(value) > kLargest) {
      Add(key, NumberText(value), "must not exceed 1e+100 in magnitude");
    } else {
      return true;
    }
    return false;
  }

  // Others could not be read by clients in Python.
  bool CheckUtf8(const std::string& key, const std::string& name) {
    if (FindNoUtf8(name) == std::string_view::npos) return true;
    Add(key, name, "must be UTF-8");
    return false;
  }

  // `earlier` holds the names before this one.
  void CheckName(const std::string& key, const std::string& name, std::unordered_set<std::string>& earlier) {
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

  // The node, or null after adding a violation.
  const Node* FindNode(const std::string& key, const std::string& name) {
    const auto found = nodes_.find(name);
    if (found != nodes_.end()) return found->second;
    Add(key, TextOrQuotes(name), "must name a node of the scene");
    return nullptr;
  }

  bool IsKnown(const std::string& node) const { return nodes_.count(node) > 0; }

  // The nodes that elements hold; nothing where elements refer to unknown nodes or where there are no elements.
  std::unordered_set<std::string> HeldNodes(bool* reliable) const {
    std::unordered_set<std::string> held;
    for (const Bar& bar : scene_.bars) held.insert(bar.nodes.begin(), bar.nodes.end());
    for (const Superelement& element : scene_.superelements) held.insert(element.nodes.begin(), element.nodes.end());
    *reliable = !held.empty() && std::all_of(held.begin(), held.end(), [this](const auto& n) { return IsKnown(n); });
    return held;
  }

  void CheckNodes() {
    if (scene_.nodes.empty()) return Add("scene.nodes", "[]", "at least one node is needed");
    bool held_is_reliable = false;
    const std::unordered_set<std::string> held = HeldNodes(&held_is_reliable);
    std::unordered_set<std::string> earlier;
    for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
      const Node& node = scene_.nodes[i];
      const std::string key = Indexed("scene.nodes", i);
      CheckName(key + ".name", node.name, earlier);
      CheckNumber(key + ".x", node.x);
      CheckNumber(key + ".y", node.y);
      if (held_is_reliable && !(node.fixed_x && node.fixed_y) && held.count(node.name) == 0) {
        Add(key, TextOrQuotes(node.name), "a node that is free to move must belong to a bar or a superelement");
      }
    }
    if (!HasFreeComponent()) Add("scene.nodes", "all fixed", "at least one component of a node must be free");
  }

  bool HasFreeComponent() const {
    return std::any_of(scene_.nodes.begin(), scene_.nodes.end(),
                       [](const Node& node) { return !node.fixed_x || !node.fixed_y; });
  }

  void CheckBars() {
    if (scene_.bars.empty() && scene_.superelements.empty() && !scene_.nodes.empty()) {
      Add("scene.bars", "[]", "at least one bar or superelement is needed");
    }
    for (std::size_t i = 0; i < scene_.bars.size(); ++i) {
      const Bar& bar = scene_.bars[i];
      const std::string key = Indexed("scene.bars", i);
      CheckBarNodes(key + ".nodes", bar);
      if (CheckNumber(key + ".EA", bar.EA) && bar.EA < kSmallest) {
        Add(key + ".EA", NumberText(bar.EA), "must be > 0 (at least 1e-100)");
      }
      if (CheckNumber(key + ".rest_length", bar.rest_length) && bar.rest_length != 0.0 && bar.rest_length < kSmallest) {
        Add(key + ".rest_length", NumberText(bar.rest_length), "must be 0 or positive (at least 1e-100)");
      }
    }
  }

  void CheckBarNodes(const std::string& key, const Bar& bar) {
    if (bar.nodes.size() != 2) return Add(key, ListText(bar.nodes), "must name two nodes");
    const Node* const first = FindNode(Indexed(key, 0), bar.nodes[0]);
    const Node* const second = FindNode(Indexed(key, 1), bar.nodes[1]);
    if (first == nullptr || second == nullptr) return;
    const double distance = std::hypot(second->x - first->x, second->y - first->y);
    if (first == second) {
      Add(key, ListText(bar.nodes), "must name two different nodes");
    } else if (distance < kSmallest) {  // false for a distance that is not finite
      Add(key, ListText(bar.nodes), "the two nodes must not be at the same point");
    }
  }

  void CheckSuperelements() {
    for (std::size_t i = 0; i < scene_.superelements.size(); ++i) {
      const Superelement& element = scene_.superelements[i];
      const std::string key = Indexed("scene.superelements", i);
      if (element.nodes.empty()) Add(key + ".nodes", "[]", "at least one node is needed");
      std::unordered_set<std::string> earlier;
      for (std::size_t j = 0; j < element.nodes.size(); ++j) {
        const std::string node_key = Indexed(key + ".nodes", j);
        if (FindNode(node_key, element.nodes[j]) != nullptr && !earlier.insert(element.nodes[j]).second) {
          Add(node_key, element.nodes[j], "must not be repeated");
        }
      }
      if (!element.nodes.empty()) CheckStiffness(key + ".stiffness", element);
      const std::size_t size = element.rest_positions.size();
      if (size != 0 && size != 2 * element.nodes.size())
        Add(key + ".rest_positions", std::to_string(size) + " entries",
            "must be empty or have " + std::to_string(2 * element.nodes.size()) + " entries: x, y of each node");
      for (std::size_t k = 0; k < size; ++k)
        CheckNumber(Indexed(key + ".rest_positions", k), element.rest_positions[k]);
    }
  }

  void CheckStiffness(const std::string& key, const Superelement& element) {
    const std::vector<double>& entries = element.stiffness;
    const std::size_t rows = 2 * element.nodes.size();
    if (entries.size() != rows * rows) {
      return Add(key, std::to_string(entries.size()) + " entries",
                 "must have " + std::to_string(rows * rows) + " entries: " + std::to_string(rows) + " rows of " +
                     std::to_string(rows));
    }
    bool usable = true;
    double largest = 0.0;
    for (std::size_t k = 0; k < entries.size(); ++k) {
      usable = CheckNumber(Indexed(key, k), entries[k]) && usable;
      largest = std::max(largest, std::abs(entries[k]));
    }
    if (!usable) return;
    if (largest < kSmallest) return Add(key, "all 0", "must not be zero (an entry of at least 1e-100 is needed)");
    for (std::size_t row = 0; row < rows; ++row) {
      for (std::size_t column = row + 1; column < rows; ++column) {
        const std::size_t above = row * rows + column;
        const std::size_t below = column * rows + row;
        if (std::abs(entries[above] - entries[below]) <= kSymmetry * largest) continue;
        return Add(
            Indexed(key, below), NumberText(entries[below]),
            "the matrix must be symmetric, but entry [" + std::to_string(above) + "] is " + NumberText(entries[above]));
      }
    }
  }

  void CheckLoads(const std::string& where, const std::vector<Load>& loads) {
    for (std::size_t i = 0; i < loads.size(); ++i) {
      const Load& load = loads[i];
      const std::string key = Indexed(where + ".loads", i);
      loads_are_sound_ = FindNode(key + ".node", load.node) != nullptr && loads_are_sound_;
      loads_are_sound_ = CheckNumber(key + ".fx", load.fx) && loads_are_sound_;
      loads_are_sound_ = CheckNumber(key + ".fy", load.fy) && loads_are_sound_;
    }
  }

  // Something must change with the load factor, of the scene or of each stage.
  void CheckWhatMoves() {
    if (!request_.program.empty()) {
      for (std::size_t i = 0; i < scene_.loads.size(); ++i)
        if (!scene_.loads[i].constant)
          Add(Indexed("scene.loads", i) + ".constant", "false",
              "must be true where there is a program: loads that a load factor scales belong to a stage");
      return;
    }
    if (loads_are_sound_ && HasFreeComponent() && !HasReferenceLoad(scene_.loads) && scene_.support_motions.empty() &&
        scene_.obstacle_motions.empty()) {
      Add("scene.loads", scene_.loads.empty() ? "[]" : "no net force",
          "a load that is not constant must act on a free component, or a support or an obstacle must move");
    }
  }

  void CheckProgram() {
    const bool program = !request_.program.empty();
    if (program && !scene_.support_motions.empty())
      Add("scene.support_motions", "", "must be empty where there is a program: motions belong to its stages");
    if (program && !scene_.obstacle_motions.empty())
      Add("scene.obstacle_motions", "", "must be empty where there is a program: motions belong to its stages");
    for (std::size_t i = 0; i < request_.program.size(); ++i) {
      const Stage& stage = request_.program[i];
      const std::string key = Indexed("program", i);
      CheckUtf8(key + ".name", stage.name);
      CheckLoads(key, stage.loads);
      for (std::size_t k = 0; k < stage.loads.size(); ++k)
        if (stage.loads[k].constant)
          Add(Indexed(key + ".loads", k) + ".constant", "true", "must be false: constant loads belong to the scene");
      CheckMotions(key, stage.support_motions, stage.obstacle_motions);
      if (loads_are_sound_ && HasFreeComponent() && !HasReferenceLoad(stage.loads) && stage.support_motions.empty() &&
          stage.obstacle_motions.empty())
        Add(key, stage.name, "a load must act on a free component, or a support or an obstacle must move");
      CheckNumber(key + ".target", stage.target);
    }
  }

  bool CheckMotion(const std::string& key, double dx, double dy) {
    const bool sound = CheckNumber(key + ".dx", dx);
    if (!CheckNumber(key + ".dy", dy) || !sound) return false;
    if (std::hypot(dx, dy) >= kSmallest) return true;
    Add(key, "no motion", "dx or dy must not be zero (length at least 1e-100)");
    return false;
  }

  void CheckMotions(const std::string& where, const std::vector<SupportMotion>& supports,
                    const std::vector<ObstacleMotion>& obstacles) {
    std::unordered_set<std::string> moved;
    for (std::size_t i = 0; i < supports.size(); ++i) {
      const SupportMotion& motion = supports[i];
      const std::string key = Indexed(where + ".support_motions", i);
      const Node* const node = FindNode(key + ".node", motion.node);
      if (!moved.insert(motion.node).second) Add(key + ".node", motion.node, "must not be repeated");
      if (!CheckMotion(key, motion.dx, motion.dy) || node == nullptr) continue;
      if (motion.dx != 0.0 && !node->fixed_x)
        Add(key + ".dx", NumberText(motion.dx), "must be 0: node " + node->name + " is not fixed in x");
      if (motion.dy != 0.0 && !node->fixed_y)
        Add(key + ".dy", NumberText(motion.dy), "must be 0: node " + node->name + " is not fixed in y");
      if (contact_nodes_.count(motion.node) > 0)
        Add(key + ".node", motion.node, "must not be a contact candidate: its reactions would not be determined");
    }
    moved.clear();
    for (std::size_t i = 0; i < obstacles.size(); ++i) {
      const ObstacleMotion& motion = obstacles[i];
      const std::string key = Indexed(where + ".obstacle_motions", i);
      const auto obstacle = obstacles_.find(motion.obstacle);
      if (obstacle == obstacles_.end())
        Add(key + ".obstacle", TextOrQuotes(motion.obstacle), "must name an obstacle of the scene");
      if (!moved.insert(motion.obstacle).second) Add(key + ".obstacle", motion.obstacle, "must not be repeated");
      if (CheckMotion(key, motion.dx, motion.dy) && obstacle != obstacles_.end())
        CheckNodesCanFollow(key, motion, *obstacle->second);
    }
  }

  // What an obstacle with friction drags along must be able to follow it, or its reaction is not determined.
  void CheckNodesCanFollow(const std::string& key, const ObstacleMotion& motion, const Obstacle& obstacle) {
    const double norm = std::hypot(obstacle.nx, obstacle.ny);
    const double along = std::abs(obstacle.ny * motion.dx - obstacle.nx * motion.dy) / norm;
    if (!(obstacle.friction > 0.0) || along <= kNormalOnFree * std::hypot(motion.dx, motion.dy)) return;
    const auto held = held_.find(&obstacle);
    if (held != held_.end())
      Add(key + ".obstacle", motion.obstacle,
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
      const Node* const node = nodes_.at(load.node);
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
    std::unordered_set<std::string> earlier;
    for (std::size_t i = 0; i < scene_.obstacles.size(); ++i) {
      const Obstacle& obstacle = scene_.obstacles[i];
      const std::string key = Indexed("scene.obstacles", i);
      CheckName(key + ".name", obstacle.name, earlier);
      bool sound = CheckNumber(key + ".px", obstacle.px);
      sound = CheckNumber(key + ".py", obstacle.py) && sound;
      const bool nx_sound = CheckNumber(key + ".nx", obstacle.nx);
      const bool ny_sound = CheckNumber(key + ".ny", obstacle.ny);
      if (nx_sound && ny_sound && std::hypot(obstacle.nx, obstacle.ny) < kSmallest) {
        Add(key + ".nx", NumberText(obstacle.nx), "the normal (nx, ny) must not be zero (length at least 1e-100)");
        sound = false;
      }
      if (sound && nx_sound && ny_sound) usable_obstacles_.insert(&obstacle);
      if (CheckNumber(key + ".friction", obstacle.friction) && obstacle.friction < 0.0) {
        Add(key + ".friction", NumberText(obstacle.friction), "must be >= 0");
      }
    }
  }

  // length: the characteristic length, 0 where it is not known.
  void CheckContacts(double length) {
    std::set<std::pair<std::string, std::string>> earlier;
    for (std::size_t i = 0; i < scene_.contacts.size(); ++i) {
      const ContactCandidate& contact = scene_.contacts[i];
      const std::string key = Indexed("scene.contacts", i);
      const Node* const node = FindNode(key + ".node", contact.node);
      const auto obstacle = obstacles_.find(contact.obstacle);
      if (obstacle == obstacles_.end()) {
        Add(key + ".obstacle", TextOrQuotes(contact.obstacle), "must name an obstacle of the scene");
      }
      if (!earlier.emplace(contact.node, contact.obstacle).second) {
        Add(key, contact.Name(), "must not be repeated");
      } else if (node != nullptr && obstacle != obstacles_.end() && usable_obstacles_.count(obstacle->second) > 0) {
        CheckContactGeometry(key, contact, *node, *obstacle->second, length);
      }
    }
  }

  void CheckContactGeometry(const std::string& key, const ContactCandidate& contact, const Node& node,
                            const Obstacle& obstacle, double length) {
    const double norm = std::hypot(obstacle.nx, obstacle.ny);
    const double free_part = std::hypot(node.fixed_x ? 0.0 : obstacle.nx, node.fixed_y ? 0.0 : obstacle.ny);
    if (free_part <= kNormalOnFree * norm) {
      Add(key + ".node", contact.node, "must be free to move along the normal of the obstacle");
    }
    const double gap =
        obstacle.nx / norm * (node.x - obstacle.px) + obstacle.ny / norm * (node.y - obstacle.py);  // [length]
    if (length > 0.0 && gap < -kPenetration * length) {
      Add(key, contact.Name(), "initial position penetrates the obstacle by " + NumberText(-gap));
    }
  }

  void CheckCount(const std::string& key, int count) {
    if (count < 0) Add(key, std::to_string(count), "must be >= 0");
  }

  void CheckOptions() {
    if (CheckNumber("options.direction", options_.direction) && options_.direction != 0.0 && !request_.program.empty())
      Add("options.direction", NumberText(options_.direction),
          "must be 0 where there is a program: each stage goes towards its target");
    if (CheckNumber("options.step", options_.step) && options_.step < 0.0) {
      Add("options.step", NumberText(options_.step), "must be >= 0");
    }
    CheckCount("options.max_increments", options_.max_increments);
    CheckCount("options.full_state_every", options_.full_state_every);
    for (std::size_t i = 0; i < options_.stop.size(); ++i) {
      const StopCriterion& stop = options_.stop[i];
      const std::string key = Indexed("options.stop", i);
      CheckQuantity(key + ".quantity", stop.quantity);
      if (stop.when != ">" && stop.when != "<") Add(key + ".when", TextOrQuotes(stop.when), "must be \">\" or \"<\"");
      CheckNumber(key + ".value", stop.value);
    }
    for (std::size_t i = 0; i < options_.branch_choices.size(); ++i) {
      const BranchChoice& choice = options_.branch_choices[i];
      const std::string key = Indexed("options.branch_choices", i);
      if (choice.event < 0) Add(key + ".event", std::to_string(choice.event), "must be >= 0");
      if (choice.increment < 0) Add(key + ".increment", std::to_string(choice.increment), "must be >= 0");
      if (choice.branch < 0) Add(key + ".branch", std::to_string(choice.branch), "must be >= 0");
      if (choice.event > 0 && choice.increment > 0)
        Add(key + ".increment", std::to_string(choice.increment), "must be 0 where event is given");
    }
  }

  void CheckQuantity(const std::string& key, const std::string& quantity) {
    if (quantity == "load_factor") {
      if (!request_.program.empty())
        Add(key, quantity, "must be <node>.x or <node>.y where there is a program: each stage has a target of its own");
      return;
    }
    const std::size_t name_size = quantity.size() < 2 ? 0 : quantity.size() - 2;
    const std::string component = quantity.substr(name_size);
    if (name_size == 0 || (component != ".x" && component != ".y")) {
      Add(key, TextOrQuotes(quantity), "must be load_factor, <node>.x or <node>.y");
    } else if (!IsKnown(quantity.substr(0, name_size))) {
      Add(key, quantity, "must refer to a node of the scene");
    }
  }

  const TraceRequest& request_;
  const Scene& scene_;
  const TraceOptions& options_;
  std::unordered_map<std::string, const Node*> nodes_;  // the first of each name
  std::unordered_map<std::string, const Obstacle*> obstacles_;
  std::unordered_set<std::string_view> contact_nodes_;
  std::unordered_map<const Obstacle*, const Node*> held_;  // the first candidate of each that cannot follow it
  std::unordered_set<const Obstacle*> usable_obstacles_;   // with a sound point and normal
  bool loads_are_sound_ = true;                            // as far as checked
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
