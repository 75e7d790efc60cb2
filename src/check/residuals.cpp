// Written from the definitions and summed in long double, so that the check is more exact than the solver.
#include "contact_path/check/residuals.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

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

Vector NodePosition(const std::vector<double>& positions, std::size_t node) {
  return {positions[2 * node], positions[2 * node + 1]};
}

// Of long double squares, which neither overflow nor vanish for finite doubles.
Real Length(const Vector& v) { return std::sqrt(v.x * v.x + v.y * v.y); }

struct BarLengths {
  Real current = 0.0L;
  Real rest = 0.0L;
  Vector span;  // from the first node to the second
};

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

// de/dl / l: by Green and Lagrange's measure a bar of no length has one, too.
Real StrainRatePerLength(StrainMeasure measure, const BarLengths& lengths) {
  switch (measure) {
    case StrainMeasure::kBiot: return 1.0L / (lengths.rest * lengths.current);
    case StrainMeasure::kGreenLagrange: return 1.0L / (lengths.rest * lengths.rest);
    case StrainMeasure::kLogarithmic: return 1.0L / (lengths.current * lengths.current);
  }
  return std::numeric_limits<Real>::quiet_NaN();
}

}  // namespace

// The obstacle's frame and friction as a contact candidate sees them.
struct ResidualCheck::Surface {
  Vector point;
  Vector normal;   // n, of length 1
  Vector tangent;  // t = (n_y, -n_x)
  Vector motion;   // of the point, per unit of the load factor
  Real friction = 0.0L;

  Vector Displacement(double load_factor) const { return {load_factor * motion.x, load_factor * motion.y}; }
};

// The scene with all names resolved; vectors in the order of the scene's lists.
struct ResidualCheck::Prepared {
  struct PreparedBar {
    std::size_t first = 0, second = 0;
    Real EA = 0.0L, rest = 0.0L;
    StrainMeasure strain = StrainMeasure::kBiot;
  };
  struct PreparedPart {
    std::vector<std::size_t> nodes;
    std::vector<Real> stiffness;  // row by row
    std::vector<double> rest;     // x0, y0, x1, ...
  };
  struct PreparedLoad {
    std::size_t node = 0;
    Real fx = 0.0L, fy = 0.0L;
    bool constant = false;
  };
  struct PreparedContact {
    std::size_t node = 0;
    Surface surface;
  };

  Prepared(const Scene& scene, const Configuration& configuration, const Scaling& scaling_in)
      : scaling(scaling_in), start(configuration.start) {
    const std::vector<double>& reference = configuration.reference;
    std::unordered_map<std::string_view, std::size_t> index;
    for (const Node& node : scene.nodes) {
      index.emplace(node.name, index.size());
      free.push_back(!node.fixed_x);
      free.push_back(!node.fixed_y);
    }
    for (const Bar& bar : scene.bars) {
      PreparedBar prepared{index.at(bar.nodes[0]), index.at(bar.nodes[1]), bar.EA, bar.rest_length, bar.strain};
      if (bar.rest_length == 0.0)
        prepared.rest = Length(NodePosition(reference, prepared.second) - NodePosition(reference, prepared.first));
      bars.push_back(prepared);
    }
    for (const Superelement& part : scene.superelements) {
      PreparedPart prepared;
      for (const std::string& name : part.nodes) prepared.nodes.push_back(index.at(name));
      prepared.stiffness.assign(part.stiffness.begin(), part.stiffness.end());
      prepared.rest.assign(part.rest_positions.begin(), part.rest_positions.end());
      if (prepared.rest.empty())
        for (const std::size_t node : prepared.nodes)
          prepared.rest.insert(prepared.rest.end(), {reference[2 * node], reference[2 * node + 1]});
      parts.push_back(std::move(prepared));
    }
    // Summed by node, so that what cancels does so before the load factor makes it large.
    std::map<std::pair<std::size_t, bool>, std::size_t> sums;
    for (const Load& load : scene.loads) {
      const auto [at, is_new] = sums.try_emplace({index.at(load.node), load.constant}, loads.size());
      if (is_new) loads.push_back({index.at(load.node), 0.0L, 0.0L, load.constant});
      loads[at->second].fx += load.fx;
      loads[at->second].fy += load.fy;
    }
    rates.resize(start.size());
    for (const SupportMotion& motion : scene.support_motions) {
      rates[2 * index.at(motion.node)] = motion.dx;
      rates[2 * index.at(motion.node) + 1] = motion.dy;
    }
    std::unordered_map<std::string_view, Surface> surfaces;
    for (const Obstacle& obstacle : scene.obstacles) {
      const Vector along{obstacle.nx, obstacle.ny};
      const Real length = Length(along);
      Surface surface;
      surface.point = {obstacle.px, obstacle.py};
      surface.normal = {along.x / length, along.y / length};
      surface.tangent = {surface.normal.y, -surface.normal.x};
      surface.friction = obstacle.friction;
      surfaces.emplace(obstacle.name, surface);
    }
    for (const ObstacleMotion& motion : scene.obstacle_motions)
      surfaces.at(motion.obstacle).motion = {motion.dx, motion.dy};
    for (const ContactCandidate& contact : scene.contacts) {
      const auto surface = surfaces.find(contact.obstacle);
      if (surface == surfaces.end()) throw std::invalid_argument("no obstacle has the name " + contact.obstacle);
      contacts.push_back({index.at(contact.node), surface->second});
    }
  }

  BarLengths Measure(const PreparedBar& bar, const std::vector<double>& positions) const {
    const Vector span = NodePosition(positions, bar.second) - NodePosition(positions, bar.first);
    return {Length(span), bar.rest, span};
  }

  // x - X of the nodes of `part`, in its order.
  std::vector<Real> Displacements(const PreparedPart& part, const std::vector<double>& positions) const {
    std::vector<Real> displacements;
    for (std::size_t i = 0; i < part.nodes.size(); ++i) {
      const Vector moved = NodePosition(positions, part.nodes[i]) - NodePosition(part.rest, i);
      displacements.push_back(moved.x);
      displacements.push_back(moved.y);
    }
    return displacements;
  }

  // K d
  static std::vector<Real> ElasticForces(const PreparedPart& part, const std::vector<Real>& displacements) {
    const std::size_t size = displacements.size();
    std::vector<Real> forces(size, 0.0L);
    for (std::size_t row = 0; row < size; ++row) {
      for (std::size_t column = 0; column < size; ++column) {
        forces[row] += part.stiffness[row * size + column] * displacements[column];
      }
    }
    return forces;
  }

  // phi - T r on each component x0, y0, x1, ...: internal forces less loads less reactions.
  std::vector<Real> Unbalance(const CheckedState& state) const {
    std::vector<Real> forces(state.positions.size(), 0.0L);
    for (const PreparedBar& bar : bars) {
      const BarLengths lengths = Measure(bar, state.positions);
      // N = dW/dl = EA l0 e de/dl, along the bar: N / l times its span.
      const Real per_length =
          bar.EA * lengths.rest * Strain(bar.strain, lengths) * StrainRatePerLength(bar.strain, lengths);
      const Vector pull{per_length * lengths.span.x, per_length * lengths.span.y};
      forces[2 * bar.first] -= pull.x;
      forces[2 * bar.first + 1] -= pull.y;
      forces[2 * bar.second] += pull.x;
      forces[2 * bar.second + 1] += pull.y;
    }
    for (const PreparedPart& part : parts) {
      const std::vector<Real> elastic = ElasticForces(part, Displacements(part, state.positions));
      for (std::size_t i = 0; i < part.nodes.size(); ++i) {
        forces[2 * part.nodes[i]] += elastic[2 * i];
        forces[2 * part.nodes[i] + 1] += elastic[2 * i + 1];
      }
    }
    for (const PreparedLoad& load : loads) {
      const Real factor = load.constant ? 1.0L : static_cast<Real>(state.load_factor);
      forces[2 * load.node] -= factor * load.fx;
      forces[2 * load.node + 1] -= factor * load.fy;
    }
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      if (state.rn[i] == 0.0 && state.rt[i] == 0.0) continue;
      const auto& [node, surface] = contacts[i];
      forces[2 * node] -= state.rn[i] * surface.normal.x + state.rt[i] * surface.tangent.x;
      forces[2 * node + 1] -= state.rn[i] * surface.normal.y + state.rt[i] * surface.tangent.y;
    }
    return forces;
  }

  void RequireSizes(const CheckedState& state) const {
    RequireSize(state.positions, start.size(), "positions");
    RequireSize(state.rn, contacts.size(), "rn");
    RequireSize(state.rt, contacts.size(), "rt");
  }

  Scaling scaling;
  std::vector<double> start;  // places at load factor 0: x0, y0, x1, ...
  std::vector<bool> free;     // the same components
  std::vector<double> rates;  // of the fixed ones, per unit of the load factor
  std::vector<PreparedBar> bars;
  std::vector<PreparedPart> parts;
  std::vector<PreparedLoad> loads;
  std::vector<PreparedContact> contacts;
};

ResidualCheck::ResidualCheck(const Scene& scene)
    : ResidualCheck(scene, Configuration::Of(scene), CharacteristicScales(scene)) {}
ResidualCheck::ResidualCheck(const Scene& scene, const Configuration& configuration, const Scaling& scaling)
    : prepared_(std::make_unique<Prepared>(scene, configuration, scaling)) {}
ResidualCheck::~ResidualCheck() = default;

double Residuals::Contact() const {
  double worst = 0.0;
  for (const double residual : {penetration, tensile_reaction, complementarity, cone, friction_law}) {
    worst = Worst(worst, residual);
  }
  return worst;
}

double Residuals::Largest() const { return Worst(Worst(Contact(), equilibrium), support); }

Residuals ResidualCheck::Check(const CheckedState& before, const CheckedState& now) const {
  const Prepared& scene = *prepared_;
  scene.RequireSizes(before);
  scene.RequireSizes(now);
  if (!AllFinite(before) || !AllFinite(now)) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return {kInfinity, kInfinity, kInfinity, kInfinity, kInfinity, kInfinity, kInfinity};
  }

  const Scaling& scaling = scene.scaling;
  Residuals residuals;
  const std::vector<Real> unbalance = scene.Unbalance(now);
  for (std::size_t i = 0; i < unbalance.size(); ++i) {
    if (scene.free[i]) {
      residuals.equilibrium = Worst(residuals.equilibrium, std::abs(unbalance[i]) / scaling.force);
      continue;
    }
    const Real place = scene.start[i] + static_cast<Real>(now.load_factor) * scene.rates[i];
    residuals.support = Worst(residuals.support, std::abs(now.positions[i] - place) / scaling.length);
  }
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    const auto& [node, surface] = scene.contacts[i];
    // As the obstacle sees it.
    const Vector position = NodePosition(now.positions, node) - surface.Displacement(now.load_factor);
    const Real gap = Dot(surface.normal, position - surface.point) / scaling.length;
    if (now.rn[i] == 0.0 && now.rt[i] == 0.0) {  // all else is zero then, but for a gap that is closed too far
      residuals.penetration = Worst(residuals.penetration, -gap);
      residuals.complementarity = Worst(residuals.complementarity, std::abs(std::min(gap, 0.0L)));
      continue;
    }
    const Vector motion = position - (NodePosition(before.positions, node) - surface.Displacement(before.load_factor));
    const Real slip = Dot(surface.tangent, motion) / scaling.length;
    const Real rn = static_cast<Real>(now.rn[i]) / scaling.force;
    const Real rt = static_cast<Real>(now.rt[i]) / scaling.force;
    const Real bound = surface.friction * std::max(rn, 0.0L);
    residuals.penetration = Worst(residuals.penetration, -gap);
    residuals.tensile_reaction = Worst(residuals.tensile_reaction, -rn);
    residuals.complementarity = Worst(residuals.complementarity, std::abs(std::min(gap, rn)));
    residuals.cone = Worst(residuals.cone, std::abs(rt) - surface.friction * rn);
    residuals.friction_law = Worst(residuals.friction_law, std::abs(rt - std::clamp(rt - slip, -bound, bound)));
  }
  return residuals;
}

std::vector<double> ResidualCheck::Unbalance(const CheckedState& state) const {
  prepared_->RequireSizes(state);
  const std::vector<Real> unbalance = prepared_->Unbalance(state);
  return {unbalance.begin(), unbalance.end()};
}

double ResidualCheck::DrivingForce(const CheckedState& state) const {
  const Prepared& scene = *prepared_;
  scene.RequireSizes(state);
  const std::vector<Real> unbalance = scene.Unbalance(state);
  Real force = 0.0L;
  for (std::size_t i = 0; i < unbalance.size(); ++i) force += scene.rates[i] * unbalance[i];
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    const Surface& surface = scene.contacts[i].surface;
    force += state.rn[i] * Dot(surface.normal, surface.motion) + state.rt[i] * Dot(surface.tangent, surface.motion);
  }
  return static_cast<double>(force);
}

double ResidualCheck::StrainEnergy(const std::vector<double>& positions) const {
  RequireSize(positions, prepared_->start.size(), "positions");
  Real energy = 0.0L;
  for (const Prepared::PreparedBar& bar : prepared_->bars) {
    const BarLengths lengths = prepared_->Measure(bar, positions);
    const Real strain = Strain(bar.strain, lengths);
    energy += bar.EA * lengths.rest * strain * strain / 2.0L;
  }
  for (const Prepared::PreparedPart& part : prepared_->parts) {
    const std::vector<Real> displacements = prepared_->Displacements(part, positions);
    const std::vector<Real> forces = Prepared::ElasticForces(part, displacements);
    for (std::size_t i = 0; i < forces.size(); ++i) energy += forces[i] * displacements[i] / 2.0L;
  }
  return static_cast<double>(energy);
}

}  // namespace contact_path
