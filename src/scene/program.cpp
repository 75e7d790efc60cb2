#include "contact_path/scene/program.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <string_view>
#include <unordered_map>

namespace contact_path {
namespace {

// F of beams, of the sum of the loads of a stage at its target, at least: a beam that has been bent by about its length
// carries further loads along its axis.
constexpr double kShareOfLoads = 0.1;

// Sum of the sizes of the loads of a stage at its target, of one node together, on free components [force]. Moments
// count by the force that they are at `length`.
double SumOfLoads(const Stage& stage, const Scene& scene, const SceneIndex& index, double length) {
  std::map<std::size_t, Load> by_node;
  for (const Load& load : stage.loads) {
    const Node& node = scene.nodes[index.Node(load.node)];
    Load& sum = by_node[index.Node(load.node)];
    if (!node.fixed_x) sum.fx += load.fx;
    if (!node.fixed_y) sum.fy += load.fy;
    if (!node.fixed_rotation) sum.moment += load.moment;
  }
  std::vector<double> sizes;
  sizes.reserve(by_node.size());
  for (const auto& [node, load] : by_node) sizes.push_back(std::hypot(load.fx, load.fy, load.moment / length));
  std::sort(sizes.begin(), sizes.end());
  return std::abs(stage.Target()) * std::accumulate(sizes.begin(), sizes.end(), 0.0);
}

// Calls visit(stage before, share) for each stage before `stage`, from the first one. share: the load factor of that
// stage that is on, its target less what stages that unload have taken back.
template <typename Visit>
void ForEachStageBefore(const std::vector<Stage>& program, std::size_t stage, Visit&& visit) {
  if (program.empty()) return;
  std::vector<double> shares(stage, 0.0);
  double left = 1.0;
  for (std::size_t i = stage; i-- > 0;) {
    if (program[i].unload)
      left *= 1.0 - program[i].Target();
    else
      shares[i] = left * program[i].Target();
  }
  for (std::size_t i = 0; i < stage; ++i) visit(program[i], shares[i]);
}

// The numbers of a load, a motion or a change of friction.
std::array<double*, 3> NumbersOf(Load* load) { return {&load->fx, &load->fy, &load->moment}; }
std::array<double*, 3> NumbersOf(SupportMotion* motion) { return {&motion->dx, &motion->dy, &motion->rotation}; }
std::array<double*, 3> NumbersOf(ObstacleMotion* motion) { return {&motion->dx, &motion->dy, &motion->turn}; }
std::array<double*, 1> NumbersOf(FrictionChange* change) { return {&change->rate}; }

// A load, a motion or a change of friction at a share of its size.
template <typename Part>
Part Times(double share, Part part) {
  for (double* const number : NumbersOf(&part)) *number *= share;
  return part;
}

Load Times(double share, const Load& load, bool constant) {
  Load part = Times(share, load);
  part.constant = constant;
  return part;
}

void Rotate(double angle, double* x, double* y) {
  const double c = std::cos(angle), s = std::sin(angle), from = *x;
  *x = c * from - s * *y;
  *y = s * from + c * *y;
}

// Takes a point of an obstacle along with a share of its motion.
void Move(double share, const ObstacleMotion& motion, double* x, double* y) {
  if (motion.turn != 0.0) {
    double from_x = *x - motion.about_x, from_y = *y - motion.about_y;
    Rotate(share * motion.turn, &from_x, &from_y);
    *x = motion.about_x + from_x;
    *y = motion.about_y + from_y;
  }
  *x += share * motion.dx;
  *y += share * motion.dy;
}

// An obstacle, whose points are counted from (px, py).
void Move(double share, const ObstacleMotion& motion, Obstacle* obstacle) {
  Move(share, motion, &obstacle->px, &obstacle->py);
  if (motion.turn == 0.0) return;
  const double angle = share * motion.turn;
  Rotate(angle, &obstacle->nx, &obstacle->ny);
  for (std::size_t i = 0; i + 1 < obstacle->points.size(); i += 2)
    Rotate(angle, &obstacle->points[i], &obstacle->points[i + 1]);
}

// The friction of an obstacle, and of its contacts that have their own.
void Change(double by, Obstacle* obstacle, std::vector<ContactCandidate>* contacts) {
  obstacle->friction += by;
  for (ContactCandidate& contact : *contacts)
    if (contact.obstacle == obstacle->name && contact.friction > 0.0) contact.friction += by;
}

// Configuration::slip_origins of the stage.
std::vector<double> SlipOrigins(const TraceRequest& request, const SceneIndex& index, std::size_t stage) {
  std::vector<double> origins;
  std::unordered_multimap<std::size_t, std::size_t> of_obstacle;  // places in `origins`
  for (const ContactCandidate& contact : request.scene.contacts) {
    const Node& node = request.scene.nodes[index.Node(contact.node)];
    if (!contact.OnSurface()) of_obstacle.emplace(index.Obstacle(contact.obstacle), origins.size());
    origins.insert(origins.end(), {node.x, node.y});
  }
  ForEachStageBefore(request.program, stage, [&](const Stage& before, double share) {
    for (const ObstacleMotion& motion : before.obstacle_motions) {
      const auto [begin, end] = of_obstacle.equal_range(index.Obstacle(motion.obstacle));
      for (auto at = begin; at != end; ++at) Move(share, motion, &origins[at->second], &origins[at->second + 1]);
    }
  });
  return origins;
}

// Loads, obstacle motions and changes of friction of all stages before `stage`.
void BringOn(const std::vector<Stage>& program, std::size_t stage, const SceneIndex& index, Scene* scene) {
  ForEachStageBefore(program, stage, [&](const Stage& before, double share) {
    if (share == 0.0) return;
    for (const Load& load : before.loads) scene->loads.push_back(Times(share, load, /*constant=*/true));
    for (const ObstacleMotion& motion : before.obstacle_motions)
      Move(share, motion, &scene->obstacles[index.Obstacle(motion.obstacle)]);
    for (const FrictionChange& change : before.friction_changes)
      Change(share * change.rate, &scene->obstacles[index.Obstacle(change.obstacle)], &scene->contacts);
  });
}

// The motions of supports or obstacles, or the changes of friction, that the stages before `stage` have left, with the
// opposite sign: one for each name.
template <typename Motion>
std::vector<Motion> TakenBack(const std::vector<Stage>& program, std::size_t stage, std::vector<Motion> Stage::*list,
                              std::string Motion::*name) {
  std::vector<Motion> sums;
  std::unordered_map<std::string_view, std::size_t> places;
  ForEachStageBefore(program, stage, [&](const Stage& before, double share) {
    if (share == 0.0) return;
    for (const Motion& motion : before.*list) {
      const auto [at, is_new] = places.emplace(motion.*name, sums.size());
      if (is_new) {
        sums.push_back(motion);
        for (double* const number : NumbersOf(&sums.back())) *number = 0.0;
      }
      Motion part = Times(-share, motion);
      const auto sum = NumbersOf(&sums[at->second]), more = NumbersOf(&part);
      for (std::size_t i = 0; i < sum.size(); ++i) *sum[i] += *more[i];
    }
  });
  return sums;
}

// With the loads, motions and changes of friction of a stage.
void SetLoading(const Stage& stage, Scene* scene) {
  scene->loads = stage.loads;
  scene->support_motions = stage.support_motions;
  scene->obstacle_motions = stage.obstacle_motions;
  scene->friction_changes = stage.friction_changes;
}

// The scene with the loads and motions of one stage at its target, and what is constant.
Scene LoadedAtTarget(Stage stage, Scene scene) {
  const double target = stage.Target();
  for (Load& load : stage.loads) load = Times(target, load);
  for (SupportMotion& motion : stage.support_motions) motion = Times(target, motion);
  for (ObstacleMotion& motion : stage.obstacle_motions) motion = Times(target, motion);
  stage.loads.insert(stage.loads.end(), scene.loads.begin(), scene.loads.end());
  SetLoading(stage, &scene);
  return scene;
}

}  // namespace

std::size_t NumStages(const TraceRequest& request) { return std::max<std::size_t>(1, request.program.size()); }

Stage StageAsTraced(const TraceRequest& request, std::size_t stage) {
  Stage traced = request.program[stage];
  if (!traced.unload) return traced;
  ForEachStageBefore(request.program, stage, [&](const Stage& before, double share) {
    if (share == 0.0) return;
    for (const Load& load : before.loads) traced.loads.push_back(Times(-share, load, /*constant=*/false));
  });
  traced.support_motions = TakenBack(request.program, stage, &Stage::support_motions, &SupportMotion::node);
  traced.obstacle_motions = TakenBack(request.program, stage, &Stage::obstacle_motions, &ObstacleMotion::obstacle);
  traced.friction_changes = TakenBack(request.program, stage, &Stage::friction_changes, &FrictionChange::obstacle);
  return traced;
}

Scene StageScene(const TraceRequest& request, const SceneIndex& index, std::size_t stage) {
  Scene scene = request.scene;
  if (request.program.empty()) return scene;
  BringOn(request.program, stage, index, &scene);
  Stage now = StageAsTraced(request, stage);
  now.loads.insert(now.loads.begin(), scene.loads.begin(), scene.loads.end());
  SetLoading(now, &scene);
  return scene;
}

std::vector<Obstacle> ObstaclesAt(const Scene& scene, const SceneIndex& index, double load_factor) {
  std::vector<Obstacle> obstacles = scene.obstacles;
  for (const ObstacleMotion& motion : scene.obstacle_motions)
    Move(load_factor, motion, &obstacles[index.Obstacle(motion.obstacle)]);
  return obstacles;
}

Configuration StageConfiguration(const TraceRequest& request, const SceneIndex& index, std::size_t stage) {
  Configuration configuration = Configuration::Of(request.scene);
  if (request.options.friction_law == FrictionLaw::kTotal)
    configuration.slip_origins = SlipOrigins(request, index, stage);
  ForEachStageBefore(request.program, stage, [&](const Stage& before, double share) {
    for (const SupportMotion& motion : before.support_motions) {
      const std::size_t node = index.Node(motion.node);
      configuration.start[2 * node] += share * motion.dx;
      configuration.start[2 * node + 1] += share * motion.dy;
      configuration.start_rotations[node] += share * motion.rotation;
    }
  });
  return configuration;
}

ObstaclePlace PlaceOf(const TraceRequest& request, const Obstacle& obstacle, std::size_t stage, double load_factor) {
  ObstaclePlace place{obstacle.px, obstacle.py, 0.0};
  const auto move = [&](const std::vector<ObstacleMotion>& motions, double share) {
    for (const ObstacleMotion& motion : motions) {
      if (motion.obstacle != obstacle.name) continue;
      Move(share, motion, &place.x, &place.y);
      place.turn += share * motion.turn;
    }
  };
  ForEachStageBefore(request.program, stage,
                     [&](const Stage& before, double share) { move(before.obstacle_motions, share); });
  move(request.program.empty() ? request.scene.obstacle_motions : StageAsTraced(request, stage).obstacle_motions,
       load_factor);
  return place;
}

Scaling ProgramScales(const TraceRequest& request, const SceneIndex& index) {
  Scaling largest = CharacteristicScales(StageScene(request, index, 0), index);
  if (request.program.empty()) return largest;
  if (!HasForceScale(request.scene)) {
    const Scaling of_first = largest;
    largest.force = 0.0;
    for (const Stage& stage : request.program) {
      if (stage.unload) continue;  // brings no force on
      const Scaling scaling = CharacteristicScales(LoadedAtTarget(stage, request.scene), index);
      if (scaling.force > largest.force) largest = scaling;
    }
    return largest.force > 0.0 ? largest : of_first;  // where friction alone changes
  }
  if (!request.scene.bars.empty()) return largest;
  // What has a target is as sure to come as what is constant.
  double loads = 0.0;
  bool moves = false;
  for (const Stage& stage : request.program) {
    loads = std::max(loads, SumOfLoads(stage, request.scene, index, largest.length));
    moves = moves || !stage.support_motions.empty() || !stage.obstacle_motions.empty();
  }
  largest.force = ForceOfElements(request.scene, index, loads, moves);
  if (request.scene.solids.empty()) largest.force = std::max(largest.force, kShareOfLoads * loads);
  return largest;
}

Scaling StageScales(const TraceRequest& request, const SceneIndex& index, std::size_t stage,
                    const Scaling& of_program) {
  Scaling scaling = of_program;
  if (request.program.empty()) return scaling;
  Scene scene = request.scene;
  SetLoading(StageAsTraced(request, stage), &scene);
  scaling.load_factor = LoadFactorScale(scene, index, scaling.length, scaling.force);
  return scaling;
}

Scaling StageScales(const TraceRequest& request, std::size_t stage) {
  const SceneIndex index(request.scene);
  return StageScales(request, index, stage, ProgramScales(request, index));
}

}  // namespace contact_path
