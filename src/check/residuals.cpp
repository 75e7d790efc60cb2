// Written from the definitions and summed in long double, so that the check is more exact than the solver.
#include "contact_path/check/residuals.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unordered_map>

#include "contact_path/scene/scaling.h"

namespace contact_path {
namespace {

using Real = long double;

struct Vector {
  Real x = 0.0L;
  Real y = 0.0L;
};

Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y}; }
Real Dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y; }

// The larger of the two. What is no finite double counts as infinite, so that NaN never passes as small.
double Worst(double worst, Real value) {
  if (!(value <= static_cast<Real>(std::numeric_limits<double>::max()))) return std::numeric_limits<double>::infinity();
  return std::max(worst, static_cast<double>(value));
}

bool AllFinite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

bool AllFinite(const CheckedState& state) {
  return std::isfinite(state.load_factor) && AllFinite(state.positions) && AllFinite(state.rn) && AllFinite(state.rt);
}

void RequireSize(const std::vector<double>& values, std::size_t size, const char* name) {
  if (values.size() == size) return;
  throw std::invalid_argument(std::string(name) + " has " + std::to_string(values.size()) + " entries: must be " +
                              std::to_string(size));
}

void RequireSizes(const Scene& scene, const CheckedState& state) {
  RequireSize(state.positions, 2 * scene.nodes.size(), "positions");
  RequireSize(state.rn, scene.contacts.size(), "rn");
  RequireSize(state.rt, scene.contacts.size(), "rt");
}

// Index of each node by its name.
using NodeIndex = std::unordered_map<std::string_view, std::size_t>;

NodeIndex IndexNodes(const Scene& scene) {
  NodeIndex index;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) index[scene.nodes[i].name] = i;
  return index;
}

Vector NodePosition(const std::vector<double>& positions, std::size_t node) {
  return {positions[2 * node], positions[2 * node + 1]};
}

std::vector<double> InitialPositions(const Scene& scene) {
  std::vector<double> positions;
  for (const Node& node : scene.nodes) {
    positions.push_back(node.x);
    positions.push_back(node.y);
  }
  return positions;
}

struct BarLengths {
  Real current = 0.0L;
  Real rest = 0.0L;
  Vector span;  // from the first node to the second
};

BarLengths MeasureBar(const Scene& scene, const NodeIndex& index, const Bar& bar,
                      const std::vector<double>& positions) {
  const std::size_t first = index.at(bar.nodes[0]);
  const std::size_t second = index.at(bar.nodes[1]);
  BarLengths lengths;
  lengths.span = NodePosition(positions, second) - NodePosition(positions, first);
  lengths.current = std::hypot(lengths.span.x, lengths.span.y);
  lengths.rest = bar.rest_length;
  if (bar.rest_length == 0.0) {
    const Node& a = scene.nodes[first];
    const Node& b = scene.nodes[second];
    lengths.rest = std::hypot(static_cast<Real>(b.x) - a.x, static_cast<Real>(b.y) - a.y);
  }
  return lengths;
}

// e
Real Strain(StrainMeasure measure, const BarLengths& lengths) {
  const Real stretch = lengths.current / lengths.rest;
  switch (measure) {
    case StrainMeasure::kBiot: return stretch - 1.0L;
    case StrainMeasure::kGreenLagrange: return (stretch * stretch - 1.0L) / 2.0L;
    case StrainMeasure::kLogarithmic: return std::log(stretch);
  }
  return std::numeric_limits<Real>::quiet_NaN();
}

// de/dl
Real StrainRate(StrainMeasure measure, const BarLengths& lengths) {
  switch (measure) {
    case StrainMeasure::kBiot: return 1.0L / lengths.rest;
    case StrainMeasure::kGreenLagrange: return lengths.current / (lengths.rest * lengths.rest);
    case StrainMeasure::kLogarithmic: return 1.0L / lengths.current;
  }
  return std::numeric_limits<Real>::quiet_NaN();
}

// x - X of the nodes of `part`, in its order.
std::vector<Real> Displacements(const NodeIndex& index, const Superelement& part, const std::vector<double>& initial,
                                const std::vector<double>& positions) {
  std::vector<Real> displacements;
  for (const std::string& name : part.nodes) {
    const std::size_t node = index.at(name);
    const Vector moved = NodePosition(positions, node) - NodePosition(initial, node);
    displacements.push_back(moved.x);
    displacements.push_back(moved.y);
  }
  return displacements;
}

// K d
std::vector<Real> ElasticForces(const Superelement& part, const std::vector<Real>& displacements) {
  const std::size_t size = displacements.size();
  std::vector<Real> forces(size, 0.0L);
  for (std::size_t row = 0; row < size; ++row) {
    for (std::size_t column = 0; column < size; ++column) {
      forces[row] += part.stiffness[row * size + column] * displacements[column];
    }
  }
  return forces;
}

// The obstacle's frame and friction as a contact candidate sees them.
struct Surface {
  Vector point;
  Vector normal;   // n, of length 1
  Vector tangent;  // t = (n_y, -n_x)
  Real friction = 0.0L;
};

Surface FindSurface(const Scene& scene, const ContactCandidate& contact) {
  const auto obstacle = std::find_if(scene.obstacles.begin(), scene.obstacles.end(),
                                     [&](const Obstacle& candidate) { return candidate.name == contact.obstacle; });
  if (obstacle == scene.obstacles.end()) throw std::invalid_argument("no obstacle has the name " + contact.obstacle);
  const Real length = std::hypot(static_cast<Real>(obstacle->nx), static_cast<Real>(obstacle->ny));
  Surface surface;
  surface.point = {obstacle->px, obstacle->py};
  surface.normal = {obstacle->nx / length, obstacle->ny / length};
  surface.tangent = {surface.normal.y, -surface.normal.x};
  surface.friction = obstacle->friction;
  return surface;
}

// phi - T r on each component x0, y0, x1, ...: internal forces less loads less reactions.
std::vector<Real> Unbalance(const Scene& scene, const NodeIndex& index, const CheckedState& state) {
  std::vector<Real> forces(state.positions.size(), 0.0L);
  for (const Bar& bar : scene.bars) {
    const BarLengths lengths = MeasureBar(scene, index, bar, state.positions);
    // N = dW/dl = EA l0 e de/dl, along the bar.
    const Real tension = bar.EA * lengths.rest * Strain(bar.strain, lengths) * StrainRate(bar.strain, lengths);
    const Vector pull{tension * (lengths.span.x / lengths.current), tension * (lengths.span.y / lengths.current)};
    const std::size_t first = index.at(bar.nodes[0]);
    const std::size_t second = index.at(bar.nodes[1]);
    forces[2 * first] -= pull.x;
    forces[2 * first + 1] -= pull.y;
    forces[2 * second] += pull.x;
    forces[2 * second + 1] += pull.y;
  }
  const std::vector<double> initial = InitialPositions(scene);
  for (const Superelement& part : scene.superelements) {
    const std::vector<Real> elastic = ElasticForces(part, Displacements(index, part, initial, state.positions));
    for (std::size_t i = 0; i < part.nodes.size(); ++i) {
      const std::size_t node = index.at(part.nodes[i]);
      forces[2 * node] += elastic[2 * i];
      forces[2 * node + 1] += elastic[2 * i + 1];
    }
  }
  for (const Load& load : scene.loads) {
    const std::size_t node = index.at(load.node);
    const Real factor = load.constant ? 1.0L : static_cast<Real>(state.load_factor);
    forces[2 * node] -= factor * load.fx;
    forces[2 * node + 1] -= factor * load.fy;
  }
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    const Surface surface = FindSurface(scene, scene.contacts[i]);
    const std::size_t node = index.at(scene.contacts[i].node);
    forces[2 * node] -= state.rn[i] * surface.normal.x + state.rt[i] * surface.tangent.x;
    forces[2 * node + 1] -= state.rn[i] * surface.normal.y + state.rt[i] * surface.tangent.y;
  }
  return forces;
}

}  // namespace

double Residuals::Contact() const {
  double worst = 0.0;
  for (const double residual : {penetration, adhesion, complementarity, cone, friction_law}) {
    worst = Worst(worst, residual);
  }
  return worst;
}

Residuals CheckResiduals(const Scene& scene, const CheckedState& before, const CheckedState& now) {
  RequireSizes(scene, before);
  RequireSizes(scene, now);
  if (!AllFinite(before) || !AllFinite(now)) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return {kInfinity, kInfinity, kInfinity, kInfinity, kInfinity, kInfinity};
  }

  const Scaling scaling = CharacteristicScales(scene);
  const NodeIndex index = IndexNodes(scene);
  Residuals residuals;
  const std::vector<Real> unbalance = Unbalance(scene, index, now);
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    if (!node.fixed_x) residuals.equilibrium = Worst(residuals.equilibrium, std::abs(unbalance[2 * i]) / scaling.force);
    if (!node.fixed_y) {
      residuals.equilibrium = Worst(residuals.equilibrium, std::abs(unbalance[2 * i + 1]) / scaling.force);
    }
  }
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    const Surface surface = FindSurface(scene, scene.contacts[i]);
    const std::size_t node = index.at(scene.contacts[i].node);
    const Vector position = NodePosition(now.positions, node);
    const Vector motion = position - NodePosition(before.positions, node);
    const Real gap = Dot(surface.normal, position - surface.point) / scaling.length;
    const Real slip = Dot(surface.tangent, motion) / scaling.length;
    const Real rn = static_cast<Real>(now.rn[i]) / scaling.force;
    const Real rt = static_cast<Real>(now.rt[i]) / scaling.force;
    const Real bound = surface.friction * std::max(rn, 0.0L);
    residuals.penetration = Worst(residuals.penetration, -gap);
    residuals.adhesion = Worst(residuals.adhesion, -rn);
    residuals.complementarity = Worst(residuals.complementarity, std::abs(std::min(gap, rn)));
    residuals.cone = Worst(residuals.cone, std::abs(rt) - surface.friction * rn);
    residuals.friction_law = Worst(residuals.friction_law, std::abs(rt - std::clamp(rt - slip, -bound, bound)));
  }
  return residuals;
}

double CheckStrainEnergy(const Scene& scene, const std::vector<double>& positions) {
  RequireSize(positions, 2 * scene.nodes.size(), "positions");
  const NodeIndex index = IndexNodes(scene);
  Real energy = 0.0L;
  for (const Bar& bar : scene.bars) {
    const BarLengths lengths = MeasureBar(scene, index, bar, positions);
    const Real strain = Strain(bar.strain, lengths);
    energy += bar.EA * lengths.rest * strain * strain / 2.0L;
  }
  const std::vector<double> initial = InitialPositions(scene);
  for (const Superelement& part : scene.superelements) {
    const std::vector<Real> displacements = Displacements(index, part, initial, positions);
    const std::vector<Real> forces = ElasticForces(part, displacements);
    for (std::size_t i = 0; i < forces.size(); ++i) energy += forces[i] * displacements[i] / 2.0L;
  }
  return static_cast<double>(energy);
}

}  // namespace contact_path
