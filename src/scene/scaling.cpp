#include "contact_path/scene/scaling.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace contact_path {
namespace {

using NodesByName = std::unordered_map<std::string, const Node*>;

NodesByName IndexNodes(const Scene& scene) {
  NodesByName nodes;
  for (const Node& node : scene.nodes) nodes.emplace(node.name, &node);
  return nodes;
}

// Sum in the order of size, so that it does not depend on the order of the terms, not even by rounding.
double OrderedSum(std::vector<double> terms) {
  std::sort(terms.begin(), terms.end());
  double sum = 0.0;
  for (const double term : terms) sum += term;
  return sum;
}

double Distance(const Node& a, const Node& b) { return std::hypot(b.x - a.x, b.y - a.y); }

// Initial lengths of all bars [length].
std::vector<double> BarLengths(const Scene& scene, const NodesByName& nodes) {
  std::vector<double> lengths;
  lengths.reserve(scene.bars.size());
  for (const Bar& bar : scene.bars) lengths.push_back(Distance(*nodes.at(bar.nodes[0]), *nodes.at(bar.nodes[1])));
  return lengths;
}

// exp(mean ln EA) [force].
double GeometricMeanOfAxialStiffness(const Scene& scene) {
  std::vector<double> logarithms;
  logarithms.reserve(scene.bars.size());
  for (const Bar& bar : scene.bars) logarithms.push_back(std::log(bar.EA));
  return std::exp(OrderedSum(std::move(logarithms)) / static_cast<double>(scene.bars.size()));
}

// One constant load and one that the load factor scales for each node, in the order in which they come: what cancels is
// to do so before anything is rounded.
std::vector<Load> SumByNode(const std::vector<Load>& loads) {
  std::map<std::pair<std::string, bool>, std::size_t> sums;
  std::vector<Load> result;
  for (const Load& load : loads) {
    const auto [at, is_new] = sums.try_emplace({load.node, load.constant}, result.size());
    if (is_new) {
      result.push_back(load);
      continue;
    }
    result[at->second].fx += load.fx;
    result[at->second].fy += load.fy;
  }
  return result;
}

// Euclidean norm of the loads that the load factor scales, summed by node, over the free components [force].
double ReferenceLoadNorm(const Scene& scene, const NodesByName& nodes) {
  struct Terms {
    std::vector<double> x, y;
  };
  std::unordered_map<const Node*, Terms> loads;
  for (const Load& load : scene.loads) {
    if (load.constant) continue;
    Terms& terms = loads[nodes.at(load.node)];
    terms.x.push_back(load.fx);
    terms.y.push_back(load.fy);
  }
  std::vector<double> squares;
  for (const auto& [node, terms] : loads) {
    if (!node->fixed_x) squares.push_back(std::pow(OrderedSum(terms.x), 2));
    if (!node->fixed_y) squares.push_back(std::pow(OrderedSum(terms.y), 2));
  }
  return std::sqrt(OrderedSum(std::move(squares)));
}

// Euclidean norm of all prescribed motions [length].
double MotionNorm(const Scene& scene) {
  std::vector<double> squares;
  for (const SupportMotion& motion : scene.support_motions)
    for (const double part : {motion.dx, motion.dy}) squares.push_back(part * part);
  for (const ObstacleMotion& motion : scene.obstacle_motions)
    for (const double part : {motion.dx, motion.dy}) squares.push_back(part * part);
  return std::sqrt(OrderedSum(std::move(squares)));
}

// sqrt(sum K_ij^2 / rows) over all superelements [force/length]. The Frobenius norm does not change by rotation.
double MeanStiffness(const Scene& scene) {
  std::vector<double> squares;
  std::size_t rows = 0;
  for (const Superelement& element : scene.superelements) {
    rows += 2 * element.nodes.size();
    for (const double entry : element.stiffness) squares.push_back(entry * entry);
  }
  return std::sqrt(OrderedSum(std::move(squares)) / static_cast<double>(rows));
}

}  // namespace

Scaling CharacteristicScales(const Scene& scene) {
  const NodesByName nodes = IndexNodes(scene);
  Scaling scaling;
  if (!scene.bars.empty()) {
    scaling.length = OrderedSum(BarLengths(scene, nodes)) / static_cast<double>(scene.bars.size());
    scaling.force = GeometricMeanOfAxialStiffness(scene);
  } else {
    const double reference_load = ReferenceLoadNorm(scene, nodes), stiffness = MeanStiffness(scene);
    scaling.force = reference_load > 0.0 ? reference_load : stiffness * MotionNorm(scene);
    scaling.length = scaling.force / stiffness;
  }
  scaling.load_factor = LoadFactorScale(scene, scaling.length, scaling.force);
  return scaling;
}

double LoadFactorScale(const Scene& scene, double length, double force) {
  const double load = ReferenceLoadNorm(scene, IndexNodes(scene)), motion = MotionNorm(scene);
  return motion > 0.0 ? 1.0 / std::hypot(load / force, motion / length) : force / load;
}

Scene ScaleScene(const Scene& scene, const Scaling& scaling) {
  const double reference_load = scaling.force / scaling.load_factor;
  const double stiffness = scaling.force / scaling.length;
  Scene scaled = scene;
  for (Node& node : scaled.nodes) {
    node.x /= scaling.length;
    node.y /= scaling.length;
  }
  const NodesByName nodes = IndexNodes(scaled);
  for (Bar& bar : scaled.bars) {
    bar.EA /= scaling.force;
    bar.rest_length = bar.rest_length > 0.0 ? bar.rest_length / scaling.length
                                            : Distance(*nodes.at(bar.nodes[0]), *nodes.at(bar.nodes[1]));
  }
  for (Superelement& element : scaled.superelements) {
    for (double& entry : element.stiffness) entry /= stiffness;
    for (double& position : element.rest_positions) position /= scaling.length;
  }
  scaled.loads = SumByNode(scene.loads);
  for (Load& load : scaled.loads) {
    const double unit = load.constant ? scaling.force : reference_load;
    load.fx /= unit;
    load.fy /= unit;
  }
  for (Obstacle& obstacle : scaled.obstacles) {
    obstacle.px /= scaling.length;
    obstacle.py /= scaling.length;
    const double norm = std::hypot(obstacle.nx, obstacle.ny);
    obstacle.nx /= norm;
    obstacle.ny /= norm;
  }
  const double motion_unit = scaling.length / scaling.load_factor;
  for (SupportMotion& motion : scaled.support_motions) {
    motion.dx /= motion_unit;
    motion.dy /= motion_unit;
  }
  for (ObstacleMotion& motion : scaled.obstacle_motions) {
    motion.dx /= motion_unit;
    motion.dy /= motion_unit;
  }
  return scaled;
}

}  // namespace contact_path
