#include "scene/rules.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "contact_path/scene/scaling.h"
#include "contact_path/scene/surface.h"

namespace contact_path {
namespace {

// What the stages of a program have brought on, summed by component: whether a stage that unloads has anything to take
// back. Takes time in proportion to what is added.
class BroughtOn {
 public:
  enum class Kind { kLoad, kSupport, kObstacle, kFriction };

  // part: the place of the node or obstacle.
  void Add(Kind kind, std::size_t part, int component, double value) {
    const auto at = sums_.try_emplace({kind, part, component}).first;
    Sum& sum = at->second;
    sum.value += value / left_;
    sum.largest = std::max(sum.largest, std::abs(value / left_));
    if (std::abs(sum.value) <= kCancelled * sum.largest) sums_.erase(at);
  }
  void TakeBack(double share) {
    left_ *= 1.0 - share;
    if (left_ > kCancelled) return;
    sums_.clear();
    left_ = 1.0;
  }
  bool IsNothing() const { return sums_.empty(); }
  bool HasLoads() const { return !sums_.empty() && KindOf(*sums_.begin()) == Kind::kLoad; }
  bool HasMore() const { return !sums_.empty() && KindOf(*sums_.rbegin()) != Kind::kLoad; }

 private:
  struct Sum {
    double value = 0.0, largest = 0.0;
  };
  using Sums = std::map<std::tuple<Kind, std::size_t, int>, Sum>;
  static Kind KindOf(const Sums::value_type& item) { return std::get<0>(item.first); }

  Sums sums_;  // over left_
  double left_ = 1.0;
};

// The lists of what IsDriven() asks for that have entries. Loading: Scene or Stage.
template <typename Loading>
std::vector<std::string_view> DrivingLists(const Loading& of) {
  std::vector<std::string_view> lists;
  if (!of.support_motions.empty()) lists.emplace_back("support_motions");
  if (!of.obstacle_motions.empty()) lists.emplace_back("obstacle_motions");
  if (!of.friction_changes.empty()) lists.emplace_back("friction_changes");
  return lists;
}

// Whether all are sound. loading: as of Checker::LoadPlace.
bool CheckLoads(const KeyPath& where, std::size_t loading, const std::vector<Load>& loads, Checker* checker) {
  const KeyPath list = where.Key("loads");
  const std::size_t found_before = checker->NumFound();
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const KeyPath path = list[checker->LoadPlace(loading, i)];
    if (checker->CheckFields(path, loads[i]) && loads[i].moment != 0.0 && !checker->Turns(loads[i].node))
      checker->Add(path.Key("moment"), NumberText(loads[i].moment), "must be 0: no beam turns node " + loads[i].node);
  }
  return checker->NumFound() == found_before;
}

// A machine, and motions or changes of friction, in one stage have no one path parameter. Loading: Scene or Stage.
template <typename Loading>
void CheckMachine(const KeyPath& where, const Loading& of, Checker* checker) {
  const bool loaded = std::any_of(of.loads.begin(), of.loads.end(), [](const Load& load) { return !load.constant; });
  if (checker->Request().options.machine_stiffness > 0.0 && loaded && IsDriven(of))
    checker->Add(where.Key(DrivingLists(of).front()), "",
                 "must be empty where a machine loads the structure (machine_stiffness): a stage has a machine, or "
                 "motions or changes of friction");
}

// Whether the loads that the load factor scales, summed by node, leave something on a free component.
bool HasReferenceLoad(const std::vector<Load>& loads, const Checker& checker) {
  struct Sums {
    double fx = 0.0, fy = 0.0, moment = 0.0;
  };
  std::map<const Node*, Sums> by_node;
  double largest = kSmallestInput / kCancelled, largest_moment = largest;
  for (const Load& load : loads) {
    if (load.constant) continue;
    const Node* const node = checker.KnownNode(load.node);
    const Sums part = {node->fixed_x ? 0.0 : load.fx, node->fixed_y ? 0.0 : load.fy,
                       node->fixed_rotation ? 0.0 : load.moment};
    Sums& sums = by_node[node];
    sums.fx += part.fx;
    sums.fy += part.fy;
    sums.moment += part.moment;
    largest = std::max({largest, std::abs(part.fx), std::abs(part.fy)});
    largest_moment = std::max(largest_moment, std::abs(part.moment));
  }
  return std::any_of(by_node.begin(), by_node.end(), [&](const auto& item) {
    const Sums& sums = item.second;
    return std::hypot(sums.fx, sums.fy) >= kCancelled * largest || std::abs(sums.moment) >= kCancelled * largest_moment;
  });
}

// Whether nothing changes with the load factor of a scene or a stage with sound loads.
template <typename Loading>
bool IsIdle(const Loading& of, const Checker& checker) {
  return checker.HasFreeComponent() && !HasReferenceLoad(of.loads, checker) && !IsDriven(of);
}

// Of motions, changes of friction, and the stages of a program.
class ProgramRules {
 public:
  ProgramRules(bool loads_are_sound, Checker* checker)
      : checker_(*checker), scene_(checker->GetScene()), loads_are_sound_(loads_are_sound) {
    std::unordered_set<std::string_view> touched;
    for (const ContactCandidate& contact : scene_.contacts) {
      contact_nodes_.insert(contact.node);
      const Node* const node = checker_.KnownNode(contact.node);
      const Obstacle* const obstacle = checker_.KnownObstacle(contact.obstacle);
      if (node != nullptr && obstacle != nullptr && contact.FrictionWith(*obstacle) > 0.0 && !contact.Rolls() &&
          !CanSlide(!node->fixed_x, !node->fixed_y, *obstacle))
        held_.emplace(obstacle, node);
      if (contact.OnSurface()) touched.insert(contact.surface);
    }
    for (const BoundarySurface& surface : scene_.surfaces)
      if (touched.count(surface.name) > 0)
        for (const std::string& node : surface.nodes) surface_nodes_.emplace(node, surface.name);
  }

  void Check() {
    CheckMotions(kScene, 0, scene_);
    const std::vector<Stage>& program = checker_.Request().program;
    if (!program.empty())
      for (const std::string_view list : DrivingLists(scene_))
        checker_.Add(kScene.Key(list), "",
                     std::string("must be empty where there is a program: ") +
                         (list == "friction_changes" ? "they" : "motions") + " belong to its stages");
    const KeyPath path("program");
    for (std::size_t i = 0; i < program.size(); ++i) CheckStage(path[i], i + 1, program[i]);
  }

 private:
  // Of the scene or a stage. loading: as of Checker::MotionPlace.
  template <typename Loading>
  void CheckMotions(const KeyPath& where, std::size_t loading, const Loading& of) {
    const KeyPath support_list = where.Key("support_motions");
    std::unordered_set<std::string_view> moved;
    std::optional<std::size_t> faulty;
    for (std::size_t i = 0; i < of.support_motions.size(); ++i) {
      const std::size_t place = checker_.MotionPlace(loading, i);
      if (place == faulty) continue;  // one node of a group tells
      const std::size_t found_before = checker_.NumFound();
      CheckSupportMotion(support_list[place], of.support_motions[i], &moved);
      if (checker_.NumFound() > found_before) faulty = place;
    }
    moved.clear();
    checker_.CheckList(where.Key("obstacle_motions"), of.obstacle_motions,
                       [&](const auto& path, const auto& motion, bool) { CheckObstacleMotion(path, motion, &moved); });
    CheckFrictionChanges(where.Key("friction_changes"), of.friction_changes);
  }

  // moved: the nodes, or the obstacles below, so far.
  void CheckSupportMotion(const KeyPath& path, const SupportMotion& motion,
                          std::unordered_set<std::string_view>* moved) {
    checker_.CheckFields(path, motion);
    if (!moved->insert(motion.node).second) checker_.Add(path.Key("node"), motion.node, "must not be repeated");
    const Node* const node = checker_.KnownNode(motion.node);
    if (!CheckMotion(path, motion.dx, motion.dy, motion.rotation, "rotation") || node == nullptr) return;
    if (motion.dx != 0.0 && !node->fixed_x)
      checker_.Add(path.Key("dx"), NumberText(motion.dx), "must be 0: node " + node->name + " is not fixed in x");
    if (motion.dy != 0.0 && !node->fixed_y)
      checker_.Add(path.Key("dy"), NumberText(motion.dy), "must be 0: node " + node->name + " is not fixed in y");
    if (motion.rotation != 0.0 && !node->fixed_rotation)
      checker_.Add(path.Key("rotation"), NumberText(motion.rotation),
                   "must be 0: the rotation of node " + node->name + " is not fixed");
    if (motion.dx == 0.0 && motion.dy == 0.0) return;
    if (contact_nodes_.count(motion.node) > 0)
      checker_.Add(path.Key("node"), motion.node,
                   "must not be a contact candidate: its reactions would not be determined");
    if (const auto on = surface_nodes_.find(motion.node); on != surface_nodes_.end())
      checker_.Add(path.Key("node"), motion.node,
                   "must not belong to surface " + std::string(on->second) +
                       ", which contacts touch: leave it out of the surface");
  }

  void CheckObstacleMotion(const KeyPath& path, const ObstacleMotion& motion,
                           std::unordered_set<std::string_view>* moved) {
    const Obstacle* const obstacle = checker_.KnownObstacle(motion.obstacle);
    if (obstacle != nullptr && !obstacle->body.empty())
      checker_.Add(path.Key("obstacle"), motion.obstacle, "must not be carried by a body, here " + obstacle->body);
    if (!moved->insert(motion.obstacle).second)
      checker_.Add(path.Key("obstacle"), motion.obstacle, "must not be repeated");
    if (CheckMotion(path, motion.dx, motion.dy, motion.turn, "turn") && obstacle != nullptr)
      CheckNodesCanFollow(path, motion, *obstacle);
  }

  // Of a support or an obstacle.
  bool CheckMotion(const KeyPath& path, double dx, double dy, double turn, const char* name_of_turn) {
    if (!(std::abs(dx) <= kLargestInput && std::abs(dy) <= kLargestInput && std::abs(turn) <= kLargestInput))
      return false;
    if (std::hypot(dx, dy) >= kSmallestInput || std::abs(turn) >= kSmallestInput) return true;
    checker_.Add(path, "no motion",
                 std::string("dx, dy or ") + name_of_turn + " must not be zero (length at least 1e-100)");
    return false;
  }

  // What an obstacle with friction drags along must be able to follow it, or its reaction is not determined.
  void CheckNodesCanFollow(const KeyPath& path, const ObstacleMotion& motion, const Obstacle& obstacle) {
    if (obstacle.shape != ObstacleShape::kHalfPlane) return;
    const double norm = std::hypot(obstacle.nx, obstacle.ny);
    const double along = std::abs(obstacle.ny * motion.dx - obstacle.nx * motion.dy) / norm;
    // Not along a normal, nor along one that turns: its candidates can follow.
    if (!(along > kCancelled * std::hypot(motion.dx, motion.dy))) return;
    if (const auto held = held_.find(&obstacle); held != held_.end())
      checker_.Add(path.Key("obstacle"), motion.obstacle,
                   "moves along itself with friction: node " + held->second->name + " must be free to move that way");
  }

  void CheckFrictionChanges(const KeyPath& list, const std::vector<FrictionChange>& changes) {
    std::unordered_set<std::string_view> changed;
    checker_.CheckList(list, changes, [&](const KeyPath& path, const FrictionChange& change, bool) {
      if (!changed.insert(change.obstacle).second)
        checker_.Add(path.Key("obstacle"), change.obstacle, "must not be repeated");
      if (std::abs(change.rate) < kSmallestInput)
        checker_.Add(path.Key("rate"), NumberText(change.rate), "must not be 0 (at least 1e-100)");
      const Obstacle* const obstacle = checker_.KnownObstacle(change.obstacle);
      if (obstacle == nullptr) return;
      bool touched = false;
      for (const ContactCandidate& contact : scene_.contacts) {
        if (contact.OnSurface() || contact.obstacle != change.obstacle) continue;
        touched = true;
        if (contact.FrictionWith(*obstacle) > 0.0) continue;
        checker_.Add(path.Key("obstacle"), change.obstacle,
                     "must have friction > 0 at load factor 0, or its contact " + contact.Name() + " must");
        break;
      }
      if (!touched) checker_.Add(path.Key("obstacle"), change.obstacle, "must be the obstacle of a contact");
    });
    // Linear parts have the force of what acts on them.
    const auto acts = [](const auto& of) {
      return !of.loads.empty() || !of.support_motions.empty() || !of.obstacle_motions.empty();
    };
    const std::vector<Stage>& program = checker_.Request().program;
    if (!changes.empty() && !scene_.superelements.empty() && !HasForceScale(scene_) && !acts(scene_) &&
        std::none_of(program.begin(), program.end(), acts))
      checker_.Add(kScene.Key("loads"), "[]", "must have a load that presses a contact where friction alone changes");
  }

  // number: from 1.
  void CheckStage(const KeyPath& path, std::size_t number, const Stage& stage) {
    const KeyPath loads = path.Key("loads");
    const bool sound = checker_.CheckFields(path, stage);
    loads_are_sound_ = CheckLoads(path, number, stage.loads, &checker_) && loads_are_sound_;
    for (std::size_t k = 0; k < stage.loads.size(); ++k)
      if (stage.loads[k].constant)
        checker_.Add(loads[checker_.LoadPlace(number, k)].Key("constant"), "true",
                     "must be false: constant loads belong to the scene");
    CheckMotions(path, number, stage);
    CheckMachine(path, stage, &checker_);
    if (stage.unload)
      CheckUnloading(path, stage, sound);
    else if (loads_are_sound_ && IsIdle(stage, checker_))
      checker_.Add(path, stage.name,
                   "a load must act on a free component, a support or an obstacle must move, or friction must change");
    NoteBroughtOn(stage);
    for (const ObstacleMotion& motion : stage.obstacle_motions)
      if (motion.turn != 0.0) turned_ = motion.obstacle;
  }

  // sound: the numbers of the stage are.
  void CheckUnloading(const KeyPath& path, const Stage& stage, bool sound) {
    std::vector<std::string_view> lists = DrivingLists(stage);
    if (!stage.loads.empty()) lists.insert(lists.begin(), "loads");
    for (const std::string_view list : lists)
      checker_.Add(path.Key(list), "",
                   "must be empty where the stage unloads: it takes back what the stages before have left");
    const KeyPath unload = path.Key("unload");
    if (!turned_.empty())
      checker_.Add(unload, "true",
                   "must be false after a stage that turns an obstacle, here " + turned_ +
                       ": turn it back by a stage of its own");
    if (sound && !(stage.target >= 0.0 && stage.target <= 1.0))
      checker_.Add(path.Key("target"), NumberText(stage.target),
                   "must be from 0 to 1 where the stage unloads: the part that is taken back, 0 = all");
    if (checker_.NothingFound() && brought_on_.IsNothing())
      checker_.Add(unload, "true",
                   "the stages before must have left a load, a motion or a change of friction that can be taken back");
    if (checker_.Request().options.machine_stiffness > 0.0 && brought_on_.HasMore() && brought_on_.HasLoads())
      checker_.Add(unload, "true",
                   "must be false where loads and motions are taken back and a machine loads the structure "
                   "(machine_stiffness): a stage has a machine, or motions or changes of friction");
  }

  // Nothing of a request that is not sound.
  void NoteBroughtOn(const Stage& stage) {
    if (!checker_.NothingFound() || !loads_are_sound_) return;
    const double target = stage.Target();
    if (stage.unload) return brought_on_.TakeBack(target);
    const auto add = [&](BroughtOn::Kind kind, std::size_t part, const std::array<double, 3>& values) {
      for (int i = 0; i < 3; ++i) brought_on_.Add(kind, part, i, target * values[static_cast<std::size_t>(i)]);
    };
    const SceneIndex& index = checker_.Index();
    for (const Load& load : stage.loads) {
      const std::size_t at = index.Node(load.node);
      const Node& node = scene_.nodes[at];
      add(BroughtOn::Kind::kLoad, at,
          {node.fixed_x ? 0.0 : load.fx, node.fixed_y ? 0.0 : load.fy, node.fixed_rotation ? 0.0 : load.moment});
    }
    for (const SupportMotion& motion : stage.support_motions)
      add(BroughtOn::Kind::kSupport, index.Node(motion.node), {motion.dx, motion.dy, motion.rotation});
    for (const ObstacleMotion& motion : stage.obstacle_motions)
      add(BroughtOn::Kind::kObstacle, index.Obstacle(motion.obstacle), {motion.dx, motion.dy, motion.turn});
    for (const FrictionChange& change : stage.friction_changes)
      add(BroughtOn::Kind::kFriction, index.Obstacle(change.obstacle), {change.rate, 0.0, 0.0});
  }

  Checker& checker_;
  const Scene& scene_;
  std::unordered_set<std::string_view> contact_nodes_;                    // candidates
  std::unordered_map<std::string_view, std::string_view> surface_nodes_;  // of surfaces that candidates may touch
  std::unordered_map<const Obstacle*, const Node*> held_;  // the first candidate of each that cannot follow it
  bool loads_are_sound_;                                   // as far as checked
  BroughtOn brought_on_;                                   // by the stages so far
  std::string turned_;                                     // an obstacle that they have turned, or empty
};

}  // namespace

bool CheckSceneLoads(Checker* checker) {
  const Scene& scene = checker->GetScene();
  const KeyPath list = kScene.Key("loads");
  const bool sound = CheckLoads(kScene, 0, scene.loads, checker);
  if (!checker->Request().program.empty()) {
    for (std::size_t i = 0; i < scene.loads.size(); ++i)
      if (!scene.loads[i].constant)
        checker->Add(list[checker->LoadPlace(0, i)].Key("constant"), "false",
                     "must be true where there is a program: loads that a load factor scales belong to a stage");
    return sound;
  }
  CheckMachine(kScene, scene, checker);
  if (sound && IsIdle(scene, *checker))
    checker->Add(list, scene.loads.empty() ? "[]" : "no net force",
                 "a load that is not constant must act on a free component, a support or an obstacle must move, or "
                 "friction must change");
  return sound;
}

void CheckProgram(bool loads_are_sound, Checker* checker) { ProgramRules(loads_are_sound, checker).Check(); }

}  // namespace contact_path
