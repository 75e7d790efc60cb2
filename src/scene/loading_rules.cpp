#include "scene/rules.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "contact_path/scene/scaling.h"
#include "contact_path/scene/surface.h"

namespace contact_path {

void BroughtOn::Add(Kind kind, std::size_t part, int component, double value) {
  const auto at = sums_.try_emplace({kind, part, component}).first;
  Sum& sum = at->second;
  sum.value += value / left_;
  sum.largest = std::max(sum.largest, std::abs(value / left_));
  if (std::abs(sum.value) <= kCancelled * sum.largest) sums_.erase(at);
}

void BroughtOn::TakeBack(double share) {
  left_ *= 1.0 - share;
  if (left_ > kCancelled) return;
  sums_.clear();
  left_ = 1.0;
}

LoadingRules::LoadingRules(Checker* checker) : checker_(*checker), scene_(checker->GetScene()) {
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

void LoadingRules::CheckSceneLoads() {
  CheckLoads(kScene, 0, scene_.loads);
  CheckWhatMoves();
}

void LoadingRules::CheckSceneMotions() {
  CheckMotions(kScene, 0, scene_.support_motions, scene_.obstacle_motions);
  CheckFrictionChanges(kScene, scene_.friction_changes);
}

void LoadingRules::CheckLoads(const KeyPath& where, std::size_t loading, const std::vector<Load>& loads) {
  const KeyPath list = where.Key("loads");
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const KeyPath path = list[checker_.LoadPlace(loading, i)];
    bool sound = checker_.CheckFields(path, loads[i]);
    if (sound && loads[i].moment != 0.0 && !checker_.Turns(loads[i].node)) {
      checker_.Add(path.Key("moment"), NumberText(loads[i].moment), "must be 0: no beam turns node " + loads[i].node);
      sound = false;
    }
    loads_are_sound_ = loads_are_sound_ && sound;
  }
}

// Something must change with the load factor, of the scene or of each stage.
void LoadingRules::CheckWhatMoves() {
  const KeyPath list = kScene.Key("loads");
  if (!checker_.Request().program.empty()) {
    for (std::size_t i = 0; i < scene_.loads.size(); ++i)
      if (!scene_.loads[i].constant)
        checker_.Add(list[checker_.LoadPlace(0, i)].Key("constant"), "false",
                     "must be true where there is a program: loads that a load factor scales belong to a stage");
    return;
  }
  CheckMachine(kScene, scene_);
  if (loads_are_sound_ && checker_.HasFreeComponent() && !HasReferenceLoad(scene_.loads) && !IsDriven(scene_)) {
    checker_.Add(list, scene_.loads.empty() ? "[]" : "no net force",
                 "a load that is not constant must act on a free component, a support or an obstacle must move, or "
                 "friction must change");
  }
}

void LoadingRules::CheckProgram() {
  const bool program = !checker_.Request().program.empty();
  if (program && !scene_.support_motions.empty())
    checker_.Add(kScene.Key("support_motions"), "",
                 "must be empty where there is a program: motions belong to its stages");
  if (program && !scene_.obstacle_motions.empty())
    checker_.Add(kScene.Key("obstacle_motions"), "",
                 "must be empty where there is a program: motions belong to its stages");
  if (program && !scene_.friction_changes.empty())
    checker_.Add(kScene.Key("friction_changes"), "",
                 "must be empty where there is a program: they belong to its stages");
  const KeyPath list("program");
  for (std::size_t i = 0; i < checker_.Request().program.size(); ++i) CheckStage(list[i], i);
}

void LoadingRules::CheckStage(const KeyPath& path, std::size_t number) {
  const Stage& stage = checker_.Request().program[number];
  const KeyPath loads = path.Key("loads");
  const bool sound = checker_.CheckFields(path, stage);
  CheckLoads(path, number + 1, stage.loads);
  for (std::size_t k = 0; k < stage.loads.size(); ++k)
    if (stage.loads[k].constant)
      checker_.Add(loads[checker_.LoadPlace(number + 1, k)].Key("constant"), "true",
                   "must be false: constant loads belong to the scene");
  CheckMotions(path, number + 1, stage.support_motions, stage.obstacle_motions);
  CheckFrictionChanges(path, stage.friction_changes);
  CheckMachine(path, stage);
  if (stage.unload)
    CheckUnloading(path, stage, sound);
  else if (loads_are_sound_ && checker_.HasFreeComponent() && !HasReferenceLoad(stage.loads) && !IsDriven(stage))
    checker_.Add(path, stage.name,
                 "a load must act on a free component, a support or an obstacle must move, or friction must change");
  NoteBroughtOn(stage);
  for (const ObstacleMotion& motion : stage.obstacle_motions)
    if (motion.turn != 0.0) turned_ = motion.obstacle;
}

void LoadingRules::CheckUnloading(const KeyPath& path, const Stage& stage, bool sound) {
  const char* const rule = "must be empty where the stage unloads: it takes back what the stages before have left";
  if (!stage.loads.empty()) checker_.Add(path.Key("loads"), "", rule);
  if (!stage.support_motions.empty()) checker_.Add(path.Key("support_motions"), "", rule);
  if (!stage.obstacle_motions.empty()) checker_.Add(path.Key("obstacle_motions"), "", rule);
  if (!stage.friction_changes.empty()) checker_.Add(path.Key("friction_changes"), "", rule);
  if (!turned_.empty())
    checker_.Add(
        path.Key("unload"), "true",
        "must be false after a stage that turns an obstacle, here " + turned_ + ": turn it back by a stage of its own");
  if (sound && !(stage.target >= 0.0 && stage.target <= 1.0))
    checker_.Add(path.Key("target"), NumberText(stage.target),
                 "must be from 0 to 1 where the stage unloads: the part that is taken back, 0 = all");
  if (checker_.NothingFound() && brought_on_.IsNothing())
    checker_.Add(path.Key("unload"), "true",
                 "the stages before must have left a load, a motion or a change of friction that can be taken back");
  const bool moved = brought_on_.Has(BroughtOn::Kind::kSupport) || brought_on_.Has(BroughtOn::Kind::kObstacle) ||
                     brought_on_.Has(BroughtOn::Kind::kFriction);
  if (checker_.Request().options.machine_stiffness > 0.0 && moved && brought_on_.Has(BroughtOn::Kind::kLoad))
    checker_.Add(path.Key("unload"), "true",
                 "must be false where loads and motions are taken back and a machine loads the structure "
                 "(machine_stiffness): a stage has a machine, or motions or changes of friction");
}

void LoadingRules::NoteBroughtOn(const Stage& stage) {
  if (!checker_.NothingFound() || !loads_are_sound_) return;
  const double target = stage.Target();
  if (stage.unload) return brought_on_.TakeBack(target);
  const auto add = [&](BroughtOn::Kind kind, std::size_t part, const std::array<double, 3>& values) {
    for (int i = 0; i < 3; ++i) brought_on_.Add(kind, part, i, target * values[static_cast<std::size_t>(i)]);
  };
  for (const Load& load : stage.loads) {
    const std::size_t at = checker_.Index().Node(load.node);
    const Node& node = scene_.nodes[at];
    add(BroughtOn::Kind::kLoad, at,
        {node.fixed_x ? 0.0 : load.fx, node.fixed_y ? 0.0 : load.fy, node.fixed_rotation ? 0.0 : load.moment});
  }
  for (const SupportMotion& motion : stage.support_motions)
    add(BroughtOn::Kind::kSupport, checker_.Index().Node(motion.node), {motion.dx, motion.dy, motion.rotation});
  for (const ObstacleMotion& motion : stage.obstacle_motions)
    add(BroughtOn::Kind::kObstacle, checker_.Index().Obstacle(motion.obstacle), {motion.dx, motion.dy, motion.turn});
  for (const FrictionChange& change : stage.friction_changes)
    add(BroughtOn::Kind::kFriction, checker_.Index().Obstacle(change.obstacle), {change.rate, 0.0, 0.0});
}

bool LoadingRules::CheckMotion(const KeyPath& path, double dx, double dy, double turn, const char* name_of_turn) {
  if (!(std::abs(dx) <= kLargestInput && std::abs(dy) <= kLargestInput && std::abs(turn) <= kLargestInput))
    return false;
  if (std::hypot(dx, dy) >= kSmallestInput || std::abs(turn) >= kSmallestInput) return true;
  checker_.Add(path, "no motion",
               std::string("dx, dy or ") + name_of_turn + " must not be zero (length at least 1e-100)");
  return false;
}

template <typename Loading>
void LoadingRules::CheckMachine(const KeyPath& where, const Loading& of) {
  const bool loaded = std::any_of(of.loads.begin(), of.loads.end(), [](const Load& load) { return !load.constant; });
  if (!(checker_.Request().options.machine_stiffness > 0.0) || !loaded || !IsDriven(of)) return;
  const char* const list = !of.support_motions.empty()    ? "support_motions"
                           : !of.obstacle_motions.empty() ? "obstacle_motions"
                                                          : "friction_changes";
  checker_.Add(
      where.Key(list), "",
      "must be empty where a machine loads the structure (machine_stiffness): a stage has a machine, or motions "
      "or changes of friction");
}

void LoadingRules::CheckFrictionChanges(const KeyPath& where, const std::vector<FrictionChange>& changes) {
  const KeyPath list = where.Key("friction_changes");
  std::unordered_set<std::string_view> changed;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const FrictionChange& change = changes[i];
    const KeyPath path = list[i];
    checker_.CheckFields(path, change);
    if (!changed.insert(change.obstacle).second)
      checker_.Add(path.Key("obstacle"), change.obstacle, "must not be repeated");
    if (std::abs(change.rate) < kSmallestInput)
      checker_.Add(path.Key("rate"), NumberText(change.rate), "must not be 0 (at least 1e-100)");
    const Obstacle* const obstacle = checker_.KnownObstacle(change.obstacle);
    if (obstacle == nullptr) continue;
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
  }
  // Linear parts have the force of what acts on them.
  const auto acts = [](const auto& of) {
    return !of.loads.empty() || !of.support_motions.empty() || !of.obstacle_motions.empty();
  };
  const std::vector<Stage>& program = checker_.Request().program;
  if (!changes.empty() && !scene_.superelements.empty() && !HasForceScale(scene_) && !acts(scene_) &&
      std::none_of(program.begin(), program.end(), acts))
    checker_.Add(kScene.Key("loads"), "[]", "must have a load that presses a contact where friction alone changes");
}

void LoadingRules::CheckMotions(const KeyPath& where, std::size_t loading, const std::vector<SupportMotion>& supports,
                                const std::vector<ObstacleMotion>& obstacles) {
  const KeyPath support_list = where.Key("support_motions"), obstacle_list = where.Key("obstacle_motions");
  std::unordered_set<std::string> moved;
  std::optional<std::size_t> faulty;
  for (std::size_t i = 0; i < supports.size(); ++i) {
    const SupportMotion& motion = supports[i];
    const std::size_t place = checker_.MotionPlace(loading, i);
    if (place == faulty) continue;  // one node of a group tells
    const std::size_t found_before = checker_.NumFound();
    CheckSupportMotion(support_list[place], motion, &moved);
    if (checker_.NumFound() > found_before) faulty = place;
  }
  moved.clear();
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    const ObstacleMotion& motion = obstacles[i];
    const KeyPath path = obstacle_list[i];
    checker_.CheckFields(path, motion);
    if (const Obstacle* const known = checker_.KnownObstacle(motion.obstacle); known != nullptr && !known->body.empty())
      checker_.Add(path.Key("obstacle"), motion.obstacle, "must not be carried by a body, here " + known->body);
    if (!moved.insert(motion.obstacle).second)
      checker_.Add(path.Key("obstacle"), motion.obstacle, "must not be repeated");
    const Obstacle* const obstacle = checker_.KnownObstacle(motion.obstacle);
    if (CheckMotion(path, motion.dx, motion.dy, motion.turn, "turn") && obstacle != nullptr)
      CheckNodesCanFollow(path, motion, *obstacle);
  }
}

void LoadingRules::CheckSupportMotion(const KeyPath& path, const SupportMotion& motion,
                                      std::unordered_set<std::string>* moved) {
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

void LoadingRules::CheckNodesCanFollow(const KeyPath& path, const ObstacleMotion& motion, const Obstacle& obstacle) {
  if (obstacle.shape != ObstacleShape::kHalfPlane) return;
  const double norm = std::hypot(obstacle.nx, obstacle.ny);
  const double along = std::abs(obstacle.ny * motion.dx - obstacle.nx * motion.dy) / norm;
  // Not along a normal, nor along one that turns: its candidates can follow.
  if (!(along > kCancelled * std::hypot(motion.dx, motion.dy))) return;
  const auto held = held_.find(&obstacle);
  if (held != held_.end())
    checker_.Add(path.Key("obstacle"), motion.obstacle,
                 "moves along itself with friction: node " + held->second->name + " must be free to move that way");
}

bool LoadingRules::HasReferenceLoad(const std::vector<Load>& loads) const {
  struct Sums {
    double fx = 0.0, fy = 0.0, moment = 0.0;
  };
  std::map<const Node*, Sums> by_node;
  double largest = kSmallestInput / kCancelled, largest_moment = largest;
  for (const Load& load : loads) {
    if (load.constant) continue;
    const Node* const node = checker_.KnownNode(load.node);
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

}  // namespace contact_path
