#include "contact_path/scene/program.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
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

// The load factors of the stages before `stage` that are on there: their targets, less what stages that unload have
// taken back.
std::vector<double> SharesBefore(const std::vector<Stage>& program, std::size_t stage) {
  std::vector<double> shares(stage, 0.0);
  double left = 1.0;
  for (std::size_t i = stage; i-- > 0;) {
    if (program[i].unload)
      left *= 1.0 - program[i].Target();
    else
      shares[i] = left * program[i].Target();
  }
  return shares;
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
  if (request.program.empty()) return origins;
  const std::vector<double> shares = SharesBefore(request.program, stage);
  for (std::size_t i = 0; i < stage; ++i)
    for (const ObstacleMotion& motion : request.program[i].obstacle_motions) {
      const auto [begin, end] = of_obstacle.equal_range(index.Obstacle(motion.obstacle));
      for (auto at = begin; at != end; ++at) Move(shares[i], motion, &origins[at->second], &origins[at->second + 1]);
    }
  return origins;
}

// Loads, obstacle motions and changes of friction of all stages before `stage`.
void BringOn(const std::vector<Stage>& program, std::size_t stage, const SceneIndex& index, Scene* scene) {
  const std::vector<double> shares = SharesBefore(program, stage);
  for (std::size_t i = 0; i < stage; ++i) {
    const double share = shares[i];
    if (share == 0.0) continue;
    for (const Load& load : program[i].loads) scene->loads.push_back(Times(share, load, /*constant=*/true));
    for (const ObstacleMotion& motion : program[i].obstacle_motions)
      Move(share, motion, &scene->obstacles[index.Obstacle(motion.obstacle)]);
    for (const FrictionChange& change : program[i].friction_changes)
      Change(share * change.rate, &scene->obstacles[index.Obstacle(change.obstacle)], &scene->contacts);
  }
}

// Adds factor * motion to the motion of the same support or obstacle, or to the change of its friction. places: of what
// is in `sums`, by name.
template <typename Motion>
void AddMotion(std::string_view name, const Motion& motion, double factor,
               std::unordered_map<std::string_view, std::size_t>* places, std::vector<Motion>* sums) {
  const auto [at, is_new] = places->emplace(name, sums->size());
  if (is_new) {
    sums->push_back(motion);
    for (double* const number : NumbersOf(&sums->back())) *number = 0.0;
  }
  Motion part = Times(factor, motion);
  const auto sum = NumbersOf(&(*sums)[at->second]), more = NumbersOf(&part);
  for (std::size_t i = 0; i < sum.size(); ++i) *sum[i] += *more[i];
}

void SetMotions(const Stage& stage, Scene* scene) {
  scene->support_motions = stage.support_motions;
  scene->obstacle_motions = stage.obstacle_motions;
  scene->friction_changes = stage.friction_changes;
}

// With the loads, motions and changes of friction of a stage.
void SetLoading(const Stage& stage, Scene* scene) {
  scene->loads = stage.loads;
  SetMotions(stage, scene);
}

// The scene with the loads and motions of one stage at its target, and what is constant.
Scene LoadedAtTarget(const Stage& stage, Scene scene) {
  const double target = stage.Target();
  const std::vector<Load> constant = scene.loads;
  SetLoading(stage, &scene);
  for (Load& load : scene.loads) load = Times(target, load);
  for (SupportMotion& motion : scene.support_motions) motion = Times(target, motion);
  for (ObstacleMotion& motion : scene.obstacle_motions) motion = Times(target, motion);
  scene.loads.insert(scene.loads.end(), constant.begin(), constant.end());
  return scene;
}

}  // namespace

std::size_t NumStages(const TraceRequest& request) { return std::max<std::size_t>(1, request.program.size()); }

Stage StageAsTraced(const TraceRequest& request, std::size_t stage) {
  Stage traced = request.program[stage];
  if (!traced.unload) return traced;
  const std::vector<double> shares = SharesBefore(request.program, stage);
  std::unordered_map<std::string_view, std::size_t> supports, obstacles, changed;
  for (std::size_t i = 0; i < stage; ++i) {
    if (shares[i] == 0.0) continue;
    const Stage& before = request.program[i];
    for (const Load& load : before.loads) traced.loads.push_back(Times(-shares[i], load, /*constant=*/false));
    for (const SupportMotion& motion : before.support_motions)
      AddMotion(motion.node, motion, -shares[i], &supports, &traced.support_motions);
    for (const ObstacleMotion& motion : before.obstacle_motions)
      AddMotion(motion.obstacle, motion, -shares[i], &obstacles, &traced.obstacle_motions);
    for (const FrictionChange& change : before.friction_changes)
      AddMotion(change.obstacle, change, -shares[i], &changed, &traced.friction_changes);
  }
  return traced;
}

Scene StageScene(const TraceRequest& request, const SceneIndex& index, std::size_t stage) {
  Scene scene = request.scene;
  if (request.program.empty()) return scene;
  BringOn(request.program, stage, index, &scene);
  const Stage now = StageAsTraced(request, stage);
  scene.loads.insert(scene.loads.end(), now.loads.begin(), now.loads.end());
  SetMotions(now, &scene);
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
  if (request.program.empty()) return configuration;
  const std::vector<double> shares = SharesBefore(request.program, stage);
  for (std::size_t i = 0; i < stage; ++i) {
    for (const SupportMotion& motion : request.program[i].support_motions) {
      const std::size_t node = index.Node(motion.node);
      configuration.start[2 * node] += shares[i] * motion.dx;
      configuration.start[2 * node + 1] += shares[i] * motion.dy;
      configuration.start_rotations[node] += shares[i] * motion.rotation;
    }
  }
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
  if (request.program.empty()) {
    move(request.scene.obstacle_motions, load_factor);
    return place;
  }
  const std::vector<double> shares = SharesBefore(request.program, stage);
  for (std::size_t i = 0; i < stage; ++i) move(request.program[i].obstacle_motions, shares[i]);
  move(StageAsTraced(request, stage).obstacle_motions, load_factor);
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
