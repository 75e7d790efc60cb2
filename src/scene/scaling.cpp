#include "contact_path/scene/scaling.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "contact_path/scene/cell.h"
#include "contact_path/scene/change_units.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/solid_parts.h"
#include "contact_path/scene/surface.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

// In L: where the nearest contact that does not touch is farther, a length that is made of forces only is no measure of
// the scene.
constexpr double kFarthestContact = 1e4;

// F of beams and solids, of their loads at most.
constexpr double kLightest = 1e3;
// Norm of the constant loads, of that of the others: a smaller one disturbs, and tells no forces.
constexpr double kWeight = 0.1;

// Sum in the order of size, so that it does not depend on the order of the terms, not even by rounding.
double OrderedSum(std::vector<double> terms) {
  std::sort(terms.begin(), terms.end());
  double sum = 0.0;
  for (const double term : terms) sum += term;
  return sum;
}

double Distance(const Node& a, const Node& b) { return std::hypot(b.x - a.x, b.y - a.y); }

// The length between the first node of an element and its last one, along all of its nodes.
double LengthOf(const std::vector<std::string>& nodes, const Scene& scene, const SceneIndex& index) {
  double length = 0.0;
  for (std::size_t i = 1; i < nodes.size(); ++i)
    length += Distance(scene.nodes[index.Node(nodes[i - 1])], scene.nodes[index.Node(nodes[i])]);
  return length;
}

// Length and force of all solids as one body: the root of its area, and the mean of Young's modulus x thickness, by its
// logarithm over the area, x that length. They do not depend on the mesh. A length of 0: none can deform.
Scaling ScalesOfSolids(const Scene& scene, const SceneIndex& index, const DeformableElements& deformable) {
  std::vector<double> areas, logarithms;
  for (const Solid& solid : scene.solids) {
    const double E = YoungModulus(LameOf(scene.materials[index.Material(solid.material)]));
    const double logarithm = std::log(E) + std::log(solid.Thickness());
    const std::size_t count = solid.NodesPerElement();
    std::vector<double> positions;
    std::vector<std::string> element;
    for (const std::string& name : solid.nodes) {
      const Node& node = scene.nodes[index.Node(name)];
      positions.insert(positions.end(), {node.x, node.y});
      element.push_back(name);
      if (element.size() < count) continue;
      const bool deforms = deformable.Have(element);
      element.clear();
      for (const PlacedPoint& point : deforms ? PlacePoints(positions) : std::vector<PlacedPoint>()) {
        areas.push_back(point.area);
        logarithms.push_back(point.area * logarithm);
      }
      positions.clear();
    }
  }
  const double area = OrderedSum(std::move(areas));
  Scaling scaling;
  scaling.length = std::sqrt(area);
  if (area == 0.0) return scaling;
  scaling.force = std::exp(OrderedSum(std::move(logarithms)) / area) * scaling.length;
  return scaling;
}

// Mean length [length] and exp(mean ln force) of bars and beams, by their initial lengths, and of the body of all
// solids. There must be one. The force deforms it by something like its length: EA of a bar, EI / length^2 of a beam.
Scaling ScalesOfElements(const Scene& scene, const SceneIndex& index) {
  std::vector<double> lengths, logarithms;
  const auto add = [&](double length, double force) {
    lengths.push_back(length);
    logarithms.push_back(std::log(force));
  };
  const DeformableElements deformable(scene);
  for (const Bar& bar : scene.bars)
    if (deformable.Have(bar.nodes)) add(LengthOf(bar.nodes, scene, index), bar.EA);
  for (const Tendon& tendon : scene.tendons)
    if (deformable.Have(tendon.nodes)) add(LengthOf(tendon.nodes, scene, index), tendon.EA);
  for (const Beam& beam : scene.beams) {
    if (!deformable.Have(beam.nodes)) continue;
    const double length = LengthOf(beam.nodes, scene, index);
    add(length, beam.EI / (length * length));
  }
  if (const Scaling body = ScalesOfSolids(scene, index, deformable); body.length > 0.0) add(body.length, body.force);
  const auto count = static_cast<double>(lengths.size());
  Scaling scaling;
  scaling.length = OrderedSum(std::move(lengths)) / count;
  scaling.force = std::exp(OrderedSum(std::move(logarithms)) / count);
  return scaling;
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
    result[at->second].moment += load.moment;
  }
  return result;
}

struct NodeLoad {
  std::vector<double> x, y, moments;
};

// The constant loads, or those that the load factor scales, by node.
std::unordered_map<std::size_t, NodeLoad> LoadsByNode(const Scene& scene, const SceneIndex& index, bool constant) {
  std::unordered_map<std::size_t, NodeLoad> loads;
  for (const Load& load : scene.loads) {
    if (load.constant != constant) continue;
    NodeLoad& terms = loads[index.Node(load.node)];
    terms.x.push_back(load.fx);
    terms.y.push_back(load.fy);
    if (load.moment != 0.0) terms.moments.push_back(load.moment);
  }
  return loads;
}

// Euclidean norm of the constant loads, or of those that the load factor scales, summed by node, over the free
// components [force]. Moments count by the force that they are at `length`, without beams there are none.
double LoadNorm(const Scene& scene, const SceneIndex& index, bool constant, double length = 1.0) {
  std::vector<double> squares;
  for (const auto& [node, terms] : LoadsByNode(scene, index, constant)) {
    if (!scene.nodes[node].fixed_x) squares.push_back(std::pow(OrderedSum(terms.x), 2));
    if (!scene.nodes[node].fixed_y) squares.push_back(std::pow(OrderedSum(terms.y), 2));
    if (!scene.nodes[node].fixed_rotation && !terms.moments.empty())
      squares.push_back(std::pow(OrderedSum(terms.moments) / length, 2));
  }
  return std::sqrt(OrderedSum(std::move(squares)));
}

// Euclidean norm of all prescribed motions [length]. Rotations count by the motion that they are at `length`.
double MotionNorm(const Scene& scene, double length = 1.0) {
  std::vector<double> squares;
  for (const SupportMotion& motion : scene.support_motions)
    for (const double part : {motion.dx, motion.dy, motion.rotation * length}) squares.push_back(part * part);
  for (const ObstacleMotion& motion : scene.obstacle_motions)
    for (const double part : {motion.dx, motion.dy, motion.turn * length}) squares.push_back(part * part);
  for (const ContactCandidate& contact : scene.contacts) squares.push_back(contact.overlap_rate * contact.overlap_rate);
  return std::sqrt(OrderedSum(std::move(squares)));
}

// Euclidean norm of the rates of all coefficients of friction.
double ChangeNorm(const Scene& scene) {
  std::vector<double> squares;
  for (const FrictionChange& change : scene.friction_changes) squares.push_back(change.rate * change.rate);
  return std::sqrt(OrderedSum(std::move(squares)));
}

// sqrt(sum K_ij^2 / rows) over all linear parts [force/length]. The Frobenius norm does not change by rotation.
double MeanStiffness(const Scene& scene) {
  std::vector<double> squares;
  std::size_t rows = 0;
  for (const Superelement& part : scene.superelements) {
    rows += 2 * part.nodes.size();
    for (const double entry : part.stiffness) squares.push_back(entry * entry);
  }
  return std::sqrt(OrderedSum(std::move(squares)) / static_cast<double>(rows));
}

// Mean stiffness of rotational springs, by its logarithm [force length]; 0 where there is none.
double MeanSpring(const Scene& scene) {
  std::vector<double> logarithms;
  for (const Pin& pin : scene.pins)
    if (pin.stiffness > 0.0) logarithms.push_back(std::log(pin.stiffness));
  const auto count = static_cast<double>(logarithms.size());
  return logarithms.empty() ? 0.0 : std::exp(OrderedSum(std::move(logarithms)) / count);
}

// How far loads move a node of a scene of linear parts that no contact holds [length]: the farthest one, by the
// constant loads, or by those that the load factor scales, of the norm force_norm. Infinite where contacts alone hold
// something.
double MotionByLoads(const Scene& scene, const SceneIndex& index, double force_norm) {
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<int> dofs(2 * scene.nodes.size(), -1);
  int free = 0;
  for (const Superelement& element : scene.superelements)
    for (const std::string& name : element.nodes) {
      const std::size_t node = index.Node(name);
      if (!scene.nodes[node].fixed_x && dofs[2 * node] < 0) dofs[2 * node] = free++;
      if (!scene.nodes[node].fixed_y && dofs[2 * node + 1] < 0) dofs[2 * node + 1] = free++;
    }
  const auto dof = [&](std::size_t node, std::size_t axis) { return dofs[2 * node + axis]; };
  for (const Superelement& element : scene.superelements) {
    const std::size_t rows = 2 * element.nodes.size();
    for (std::size_t i = 0; i < element.stiffness.size(); ++i) {
      const int row = dof(index.Node(element.nodes[i / rows / 2]), i / rows % 2);
      const int column = dof(index.Node(element.nodes[i % rows / 2]), i % 2);
      if (row >= 0 && column >= 0) entries.emplace_back(row, column, element.stiffness[i]);
    }
  }
  Eigen::SparseMatrix<double> stiffness(free, free);
  stiffness.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(stiffness);
  double farthest = 0.0;
  for (const bool constant : {false, true}) {
    Eigen::VectorXd force = Eigen::VectorXd::Zero(free);
    for (const auto& [node, terms] : LoadsByNode(scene, index, constant)) {
      if (dof(node, 0) >= 0) force[dof(node, 0)] = OrderedSum(terms.x);
      if (dof(node, 1) >= 0) force[dof(node, 1)] = OrderedSum(terms.y);
    }
    if (force.isZero(0.0)) continue;
    if (factors.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
    if (!constant) force *= force_norm / LoadNorm(scene, index, false);
    const Eigen::VectorXd motion = factors.solve(force);
    const auto along = [&](int at) { return at < 0 ? 0.0 : motion[at]; };
    for (std::size_t node = 0; node < scene.nodes.size(); ++node) {
      const double moved = std::hypot(along(dof(node, 0)), along(dof(node, 1)));
      farthest = std::max(farthest, std::isnan(moved) ? std::numeric_limits<double>::infinity() : moved);
    }
  }
  return farthest;
}

// Smallest gap of a contact candidate at the start that is not rounding of a touching one, 0 if there is none [length].
double NearestGap(const Scene& scene, const SceneIndex& index) {
  std::vector<double> gaps;
  std::unordered_map<std::size_t, std::unique_ptr<const Surface>> surfaces;  // null: there is no surface
  for (const ContactCandidate& contact : scene.contacts) {
    // The length is asked for while contacts are still being judged.
    const std::optional<std::size_t> at = index.FindNode(contact.node), by = index.FindObstacle(contact.obstacle);
    if (!at || !by) continue;
    const auto [made, is_new] = surfaces.try_emplace(*by);
    const Obstacle& obstacle = scene.obstacles[*by];
    if (is_new && FindShapeFault(obstacle).field.empty()) made->second = MakeSurface(obstacle);
    if (made->second == nullptr) continue;
    const Eigen::Vector2d x(scene.nodes[*at].x, scene.nodes[*at].y);
    const NearestFoot nearest = made->second->Nearest(x);
    const Obstacle* const circle = RollingCircle(contact, scene);
    gaps.push_back((nearest.is_end ? nearest.distance : made->second->Project(x, nearest.patch).gap) -
                   (circle == nullptr ? 0.0 : circle->radius));
  }
  double size = 0.0;
  for (const double gap : gaps) size = std::max(size, gap);
  for (const Node& node : scene.nodes)
    size = std::max(size, std::hypot(node.x - scene.nodes[0].x, node.y - scene.nodes[0].y));
  double nearest = 0.0;
  for (const double gap : gaps)
    if (gap > tolerances::kTouching * size && (nearest == 0.0 || gap < nearest)) nearest = gap;
  return nearest;
}

// Of a boundary that is not straight on without end [length].
double ExtentOf(const Obstacle& obstacle) {
  double largest = 2.0 * obstacle.radius;
  for (std::size_t i = 2; i + 1 < obstacle.points.size(); i += 2)
    largest = std::max(
        largest, std::hypot(obstacle.points[i] - obstacle.points[0], obstacle.points[i + 1] - obstacle.points[1]));
  return largest;
}

// What moments and turns are measured by where no length is known yet: how far nodes are from each other, and from what
// obstacles turn about [length].
double ArmOf(const Scene& scene) {
  double arm = ExtentOfNodes(scene);
  for (const ObstacleMotion& motion : scene.obstacle_motions)
    for (const Node& node : scene.nodes)
      if (motion.turn != 0.0) arm = std::max(arm, std::hypot(node.x - motion.about_x, node.y - motion.about_y));
  return arm > 0.0 ? arm : 1.0;
}

}  // namespace

double ExtentOfNodes(const Scene& scene) {
  std::vector<double> x, y;
  for (const Node& node : scene.nodes) {
    x.push_back(node.x);
    y.push_back(node.y);
  }
  const auto count = static_cast<double>(scene.nodes.size());
  const double middle_x = OrderedSum(std::move(x)) / count, middle_y = OrderedSum(std::move(y)) / count;
  double largest = 0.0;
  for (const Node& node : scene.nodes) largest = std::max(largest, std::hypot(node.x - middle_x, node.y - middle_y));
  return 2.0 * largest;
}

bool HasForceScale(const Scene& scene) {
  const DeformableElements deformable(scene);
  return deformable.HaveAnyOf(scene.bars) || deformable.HaveAnyOf(scene.beams) || deformable.HaveAnyOf(scene.tendons) ||
         std::any_of(scene.solids.begin(), scene.solids.end(), [&](const Solid& solid) {
           const auto count = static_cast<std::ptrdiff_t>(solid.NodesPerElement());
           if (!IsCellShape(solid.NodesPerElement())) return true;
           for (auto at = solid.nodes.begin(); solid.nodes.end() - at >= count; at += count)
             if (deformable.Have(at, at + count)) return true;
           return false;
         });
}

Scaling CharacteristicScales(const Scene& scene, const SceneIndex& index) {
  Scaling scaling;
  if (HasForceScale(scene)) {
    scaling = ScalesOfElements(scene, index);
    // What the load factor scales has no end, and a constant load that is far smaller disturbs, and tells no forces.
    const double constant = LoadNorm(scene, index, true, scaling.length),
                 scaled = LoadNorm(scene, index, false, scaling.length);
    const bool tells = constant > 0.0 && constant >= kWeight * scaled;
    scaling.force = ForceOfElements(scene, index, tells ? scaled : 0.0, !tells || MotionNorm(scene) > 0.0);
  } else if (scene.superelements.empty()) {  // rigid bodies alone
    scaling.length = ExtentOfNodes(scene);
    for (const Obstacle& obstacle : scene.obstacles)
      if (!obstacle.body.empty()) scaling.length = std::max(scaling.length, ExtentOf(obstacle));
    // What the load factor scales has no end where springs tell of forces.
    const double spring = MeanSpring(scene) / scaling.length;
    scaling.force = std::max(spring > 0.0 ? spring : LoadNorm(scene, index, false, scaling.length),
                             LoadNorm(scene, index, true, scaling.length));
    if (scaling.force == 0.0) scaling.force = 1.0;
  } else {
    const double arm = ArmOf(scene);
    const double reference_load = LoadNorm(scene, index, false, arm), stiffness = MeanStiffness(scene);
    scaling.force = std::max({reference_load, stiffness * MotionNorm(scene, arm), LoadNorm(scene, index, true, arm),
                              stiffness * NearestGap(scene, index) / kFarthestContact});
    scaling.length = scaling.force / stiffness;
    // Soft parts beside stiff ones move farther, though no farther than the scene is large. A power of 2 does not
    // depend on the rounding of the motion, as by the order of the nodes; next to a round number none begins.
    const double farther = std::min(MotionByLoads(scene, index, scaling.force), ExtentOfNodes(scene)) / scaling.length;
    if (farther > 1.0) scaling.length *= std::exp2(std::floor(std::log2(farther) + 0.25));
  }
  scaling.load_factor = LoadFactorScale(scene, index, scaling.length, scaling.force);
  return scaling;
}

double ForceOfElements(const Scene& scene, const SceneIndex& index, double loads, bool moves) {
  const Scaling of_elements = ScalesOfElements(scene, index);
  const DeformableElements deformable(scene);
  const double light = std::max(loads, LoadNorm(scene, index, true, of_elements.length));
  return moves || deformable.HaveAnyOf(scene.bars) || deformable.HaveAnyOf(scene.tendons) || light == 0.0
             ? of_elements.force
             : std::min(of_elements.force, kLightest * light);
}

double LoadFactorScale(const Scene& scene, const SceneIndex& index, double length, double force) {
  const double load = LoadNorm(scene, index, false, length), motion = MotionNorm(scene, length);
  if (const double change = ChangeNorm(scene); change > 0.0)
    return 1.0 / std::hypot(load / force, motion / length, change);
  return motion > 0.0 ? 1.0 / std::hypot(load / force, motion / length) : force / load;
}

Scene ScaleScene(const Scene& scene, const Scaling& scaling) {
  Scene scaled = scene;
  scaled.loads = SumByNode(scene.loads);
  for (Solid& solid : scaled.solids) solid.thickness = solid.Thickness();  // 1 is of the unit of the scene
  ChangeUnits(&scaled, {scaling.length, scaling.force, scaling.load_factor});
  for (ContactCandidate& contact : scaled.contacts) {
    contact.overlap_at_0 /= scaling.length;
    contact.overlap_rate *= scaling.load_factor / scaling.length;
  }
  for (Obstacle& obstacle : scaled.obstacles) {
    const double norm = std::hypot(obstacle.nx, obstacle.ny);
    if (!(norm > 0.0)) continue;  // a shape without it
    obstacle.nx /= norm;
    obstacle.ny /= norm;
  }
  return scaled;
}

}  // namespace contact_path
