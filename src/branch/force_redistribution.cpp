#include "contact_path/branch/force_redistribution.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr std::size_t kMostAtOneNode = 4;   // laws that are looked at together
constexpr std::size_t kMostComponents = 2;  // of a node: laws that move more are not looked at
constexpr std::size_t kMostPoints = 200;    // combinations over all nodes

// A ray of the cone of a law, and the force of its unit on the node.
struct Edge {
  std::size_t law;
  Ray ray;
  Eigen::Vector2d force;
};

// Forces of the laws at one node, as weights of the edges, each >= 0.
using Weights = std::vector<double>;

struct Acting {
  std::vector<std::size_t> laws;
  std::vector<Edge> edges;
};

// On the dofs of a law, as x and y; 0 where a component is not free.
Eigen::Vector2d ForceOn(const PortsAt& at, const PortReals& forces) {
  Eigen::Vector2d force = Eigen::Vector2d::Zero();
  const auto m = static_cast<Eigen::Index>(at.dofs.size());
  for (std::size_t p = 0; p < forces.size(); ++p)
    if (forces[p] != 0.0) force.head(m) += (forces[p] * at[p].factor) * at[p].gradient.head(m);
  return force;
}

PortsAt PortsOf(const Law& law, const PathPoint& point, int piece) {
  PortsAt at;
  law.Evaluate(point.u, point.s, piece, {}, &at);
  return at;
}

// Laws that do not give way and are not away from their limits, by their dofs.
std::vector<Acting> ActingByNode(const Laws& laws, const PathPoint& point, const ActiveSetTolerance& tolerance) {
  std::map<std::vector<int>, Acting> nodes;
  for (std::size_t i = 0; i < laws.size(); ++i) {
    const Law& law = laws[i];
    const int piece = point.modes[i].piece;
    if (law.Compliant() || law.Motion(0, point.u, point.s, piece, {}) > tolerance.motion) continue;
    const LawDofs dofs = law.Dofs(0);
    if (dofs.empty() || dofs.size() > kMostComponents) continue;
    Acting& node = nodes[std::vector<int>(dofs.begin(), dofs.end())];
    node.laws.push_back(i);
    const PortsAt at = PortsOf(law, point, piece);
    for (const Ray& ray : law.Rays(point.u, point.s, piece, tolerance))
      node.edges.push_back({i, ray, ForceOn(at, ray.force)});
  }
  std::vector<Acting> result;
  result.reserve(nodes.size());
  for (auto& [dofs, node] : nodes) result.push_back(std::move(node));
  return result;
}

Eigen::Vector2d TotalForce(const Acting& node, const Laws& laws, const PathPoint& point) {
  Eigen::Vector2d force = Eigen::Vector2d::Zero();
  for (const std::size_t i : node.laws)
    force += ForceOn(PortsOf(laws[i], point, point.modes[i].piece), laws.Of(point.forces, i));
  return force;
}

// Vertices of the polytope { weights >= 0 : sum of weight . edge = force }: at most two edges carry.
std::vector<Weights> Vertices(const std::vector<Edge>& edges, const Eigen::Vector2d& force, double tolerance) {
  std::vector<Weights> vertices;
  const Weights none(edges.size(), 0.0);
  if (force.norm() <= tolerance) vertices.push_back(none);
  for (std::size_t a = 0; a < edges.size(); ++a) {
    const Eigen::Vector2d& g = edges[a].force;
    if (!(g.norm() > 0.0)) continue;
    const double alone = g.dot(force) / g.squaredNorm();
    if (alone > tolerance && (force - alone * g).norm() <= tolerance) {
      Weights weights = none;
      weights[a] = alone;
      vertices.push_back(std::move(weights));
      continue;  // every pair with it is the same
    }
    for (std::size_t b = a + 1; b < edges.size(); ++b) {
      Eigen::Matrix2d pair;
      pair << g, edges[b].force;
      if (!(std::abs(pair.determinant()) > tolerances::kDependent * g.norm() * edges[b].force.norm())) continue;
      const Eigen::Vector2d both = pair.inverse() * force;
      if (std::min(both[0], both[1]) <= tolerance) continue;  // one edge alone, or none
      Weights weights = none;
      weights[a] = both[0];
      weights[b] = both[1];
      vertices.push_back(std::move(weights));
    }
  }
  return vertices;
}

// Which edges carry, as bits.
std::size_t Support(const Weights& weights) {
  std::size_t bits = 0;
  for (std::size_t e = 0; e < weights.size(); ++e)
    if (weights[e] > 0.0) bits |= std::size_t{1} << e;
  return bits;
}

Weights PresentWeights(const Acting& node, const Laws& laws, const PathPoint& point, double tolerance) {
  Weights weights;
  for (const Edge& edge : node.edges) {
    const PortReals forces = laws.Of(point.forces, edge.law);
    double share = 0.0;
    for (std::size_t p = 0; p < forces.size(); ++p) share += edge.ray.share[p] * forces[p];
    weights.push_back(share > tolerance ? share : 0.0);
  }
  return weights;
}

// Means of the vertices of each face that `present` is not in. A face is the set of edges that may carry there.
std::vector<Weights> OtherFaces(const Acting& node, const std::vector<Weights>& vertices, const Weights& present) {
  std::vector<Weights> means;
  for (std::size_t face = 0; face < std::size_t{1} << node.edges.size(); ++face) {
    if ((Support(present) & ~face) == 0) continue;
    Weights mean(node.edges.size(), 0.0);
    double count = 0.0;
    for (const Weights& vertex : vertices) {
      if ((Support(vertex) & ~face) != 0) continue;
      count += 1.0;
      for (std::size_t e = 0; e < mean.size(); ++e) mean[e] += vertex[e];
    }
    if (count == 0.0) continue;
    for (double& weight : mean) weight /= count;
    if (std::find(means.begin(), means.end(), mean) == means.end()) means.push_back(std::move(mean));
  }
  return means;
}

void SetForces(const Acting& node, const Weights& weights, const Laws& laws, PathPoint* point) {
  for (const std::size_t i : node.laws) laws.Put({}, i, &point->forces);
  for (std::size_t e = 0; e < node.edges.size(); ++e) {
    const Edge& edge = node.edges[e];
    for (std::size_t p = 0; p < laws[edge.law].NumPorts(); ++p)
      point->forces[laws.FirstPort(edge.law) + static_cast<Eigen::Index>(p)] += edge.ray.force[p] * weights[e];
  }
}

}  // namespace

ForceRedistributions FindForceRedistributions(const Laws& laws, const PathPoint& point,
                                              const ActiveSetTolerance& tolerance) {
  ForceRedistributions result;
  for (const Acting& node : ActingByNode(laws, point, tolerance)) {
    if (node.laws.size() < 2) {
      // The cone of one law gives each force in one way only, where it has no more ports that bear than its node has
      // free components.
      const Law& law = laws[node.laws.front()];
      if (law.LargestRatio() == 0.0 || law.Dofs(0).size() == kMostComponents) continue;
    }
    if (node.laws.size() > kMostAtOneNode) {
      result.complete = false;
      continue;
    }
    double unit = 0.0;
    for (const std::size_t i : node.laws) unit = std::max(unit, laws[i].ForceUnit());
    const double force = tolerance.ForceOf(unit);
    const std::vector<Weights> vertices = Vertices(node.edges, TotalForce(node, laws, point), force);
    const std::vector<Weights> others = OtherFaces(node, vertices, PresentWeights(node, laws, point, force));
    // Beside what the nodes before can have.
    const std::size_t so_far = result.points.size();
    for (std::size_t k = 0; k <= so_far; ++k) {
      for (const Weights& weights : others) {
        if (result.points.size() == kMostPoints) {
          result.complete = false;
          return result;
        }
        PathPoint other = k == 0 ? point : result.points[k - 1];
        SetForces(node, weights, laws, &other);
        result.points.push_back(std::move(other));
      }
    }
  }
  return result;
}

}  // namespace contact_path
