#include "contact_path/branch/reaction_redistribution.h"

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

constexpr std::size_t kMostAtOneNode = 4;   // contacts that are looked at together
constexpr std::size_t kMostComponents = 2;  // of a node: contacts that move more are not looked at
constexpr std::size_t kMostPoints = 200;    // combinations over all nodes

// An edge of a friction cone, or the normal of a frictionless contact: the force of a unit normal reaction there.
struct Edge {
  std::size_t contact;
  double slip;  // rt / rn: mu, -mu or 0
  Eigen::Vector2d force;
};

// Reactions of the contacts at one node, as weights of the edges, each >= 0.
using Weights = std::vector<double>;

struct Touching {
  std::vector<std::size_t> contacts;
  std::vector<Edge> edges;
};

// The force of a unit reaction on a node, in x and y; 0 where the component is not free.
struct UnitForces {
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();
  Eigen::Vector2d tangential = Eigen::Vector2d::Zero();
};

UnitForces UnitForcesOf(const ContactPair& pair, const PathPoint& point, int patch) {
  Kinematics at;
  pair.Evaluate(point.u, point.s, patch, 0.0, &at);
  const auto m = static_cast<Eigen::Index>(at.dofs.size());
  UnitForces forces;
  forces.normal.head(m) = at.gap_gradient.head(m);
  forces.tangential.head(m) = at.xi_gradient.head(m);
  return forces;
}

// rt / rn at the edges of the cone, at most two: one where the two are parallel to rounding, and by the total law of
// friction where the contact has slipped.
std::vector<double> SlipRatiosOf(const ContactPair& contact, const PathPoint& point, int patch, double tolerance) {
  const double mu = contact.Friction();
  if (!(mu > tolerances::kDependent)) return {0.0};
  const double slipped = contact.Slipped(point.u, point.s, patch);
  if (std::abs(slipped) > tolerance) return {slipped > 0.0 ? -mu : mu};
  return {mu, -mu};
}

// Contacts that touch rigid surfaces, by the free components of their node.
std::vector<Touching> TouchingByNode(const ContactPairs& contacts, const PathPoint& point, double tolerance) {
  std::map<std::vector<int>, Touching> nodes;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const ContactPair& contact = *contacts[i];
    if (contact.Deformable() || contact.Gap(point.u, point.s, point.Patch(i)) > tolerance) continue;
    const PairDofs dofs = contact.Dofs(0);
    if (dofs.empty() || dofs.size() > kMostComponents) continue;
    Touching& node = nodes[std::vector<int>(dofs.begin(), dofs.end())];
    node.contacts.push_back(i);
    const UnitForces unit = UnitForcesOf(contact, point, point.Patch(i));
    for (const double slip : SlipRatiosOf(contact, point, point.Patch(i), tolerance))
      node.edges.push_back({i, slip, unit.normal + slip * unit.tangential});
  }
  std::vector<Touching> result;
  result.reserve(nodes.size());
  for (auto& [dofs, node] : nodes) result.push_back(std::move(node));
  return result;
}

Eigen::Vector2d TotalForce(const Touching& node, const ContactPairs& contacts, const PathPoint& point) {
  Eigen::Vector2d force = Eigen::Vector2d::Zero();
  for (const std::size_t i : node.contacts) {
    const auto k = static_cast<Eigen::Index>(i);
    const UnitForces unit = UnitForcesOf(*contacts[i], point, point.Patch(i));
    force += point.rn[k] * unit.normal + point.rt[k] * unit.tangential;
  }
  return force;
}

// Vertices of the polytope { weights >= 0 : sum of weight . edge = force }: at most two edges carry.
std::vector<Weights> Vertices(const std::vector<Edge>& edges, const Eigen::Vector2d& force, double tolerance) {
  std::vector<Weights> vertices;
  const auto add = [&](Weights weights) {
    for (double& weight : weights) {
      if (weight < -tolerance) return;
      weight = std::max(weight, 0.0);
    }
    vertices.push_back(std::move(weights));
  };
  const Weights none(edges.size(), 0.0);
  if (force.norm() <= tolerance) add(none);
  for (std::size_t a = 0; a < edges.size(); ++a) {
    const Eigen::Vector2d& g = edges[a].force;
    if (!(g.norm() > 0.0)) continue;
    const double alone = g.dot(force) / g.squaredNorm();
    if (alone > tolerance && (force - alone * g).norm() <= tolerance) {
      Weights weights = none;
      weights[a] = alone;
      add(std::move(weights));
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
      add(std::move(weights));
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

Weights PresentWeights(const Touching& node, const PathPoint& point, double tolerance) {
  Weights weights;
  for (const Edge& edge : node.edges) {
    const auto k = static_cast<Eigen::Index>(edge.contact);
    const double share = edge.slip == 0.0 ? point.rn[k] : 0.5 * (point.rn[k] + point.rt[k] / edge.slip);
    weights.push_back(share > tolerance ? share : 0.0);
  }
  return weights;
}

// Means of the vertices of each face that `present` is not in. A face is the set of edges that may carry there.
std::vector<Weights> OtherFaces(const Touching& node, const std::vector<Weights>& vertices, const Weights& present) {
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

void SetReactions(const Touching& node, const Weights& weights, PathPoint* point) {
  for (const std::size_t i : node.contacts) {
    point->rn[static_cast<Eigen::Index>(i)] = 0.0;
    point->rt[static_cast<Eigen::Index>(i)] = 0.0;
  }
  for (std::size_t e = 0; e < node.edges.size(); ++e) {
    const auto k = static_cast<Eigen::Index>(node.edges[e].contact);
    point->rn[k] += weights[e];
    point->rt[k] += node.edges[e].slip * weights[e];
  }
}

}  // namespace

ReactionRedistributions FindReactionRedistributions(const ContactPairs& contacts, const PathPoint& point,
                                                    const ActiveSetTolerance& tolerance) {
  ReactionRedistributions result;
  for (const Touching& node : TouchingByNode(contacts, point, tolerance.gap)) {
    if (node.contacts.size() < 2) {
      // The cone of one contact gives each force in one way only, where both components of its node are free.
      const ContactPair& contact = *contacts[node.contacts.front()];
      if (!contact.Frictional() || contact.Dofs(0).size() == kMostComponents) continue;
    }
    if (node.contacts.size() > kMostAtOneNode) {
      result.complete = false;
      continue;
    }
    double unit = 0.0;
    for (const std::size_t i : node.contacts) unit = std::max(unit, contacts[i]->ForceUnit());
    const double force = tolerance.force * unit;
    const std::vector<Weights> vertices = Vertices(node.edges, TotalForce(node, contacts, point), force);
    const std::vector<Weights> others = OtherFaces(node, vertices, PresentWeights(node, point, force));
    // Beside what the nodes before can have.
    const std::size_t so_far = result.points.size();
    for (std::size_t k = 0; k <= so_far; ++k) {
      for (const Weights& weights : others) {
        if (result.points.size() == kMostPoints) {
          result.complete = false;
          return result;
        }
        PathPoint other = k == 0 ? point : result.points[k - 1];
        SetReactions(node, weights, &other);
        result.points.push_back(std::move(other));
      }
    }
  }
  return result;
}

}  // namespace contact_path
