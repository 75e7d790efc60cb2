#include "contact_path/contact/deformable_pair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <unsupported/Eigen/AutoDiff>
#include <utility>

#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

// Gap, knot and slip of a node beside a patch of a spline, in numbers that carry their derivatives along.

// x and y of the node, then of the control nodes; and whatever there is of each of these.
using Place = Eigen::Matrix<double, 8, 1>;
template <typename T>
using Places = std::array<T, Place::SizeAtCompileTime>;

// Numbers that carry derivatives along: by all places, the same twice, and twice along one curve.
using ByPlaces = Eigen::AutoDiffScalar<Place>;
using TwiceByPlaces = Eigen::AutoDiffScalar<Eigen::Matrix<ByPlaces, Place::SizeAtCompileTime, 1>>;
using Along = Eigen::AutoDiffScalar<Eigen::Matrix<double, 1, 1>>;
using TwiceAlong = Eigen::AutoDiffScalar<Eigen::Matrix<Along, 1, 1>>;

template <typename T>
T Constant(double value) {
  return T(typename T::Scalar(value));
}

template <typename T>
struct Plane {
  T x, y;
};

template <typename T>
T Dot(const Plane<T>& a, const Plane<T>& b) {
  return T(a.x * b.x + a.y * b.y);
}

// Along a parabola from one foot: where the node is, and what follows.
template <typename T>
struct FootOnParabola {
  // tau: of the foot, or near it.
  FootOnParabola(const SplinePatch& patch, const Places<T>& z, const T& tau) {
    second = {Constant<T>(0.0), Constant<T>(0.0)};
    first = second;
    away = {z[0], z[1]};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      const T constant = Constant<T>(patch.weights(row, 0)), linear = Constant<T>(patch.weights(row, 1)),
              square = Constant<T>(patch.weights(row, 2)), twice = Constant<T>(2.0 * patch.weights(row, 2));
      const Plane<T> at = {z[2 * k + 2], z[2 * k + 3]};
      weights[k] = T(T(T(square * tau) + linear) * tau) + constant;
      slopes[k] = T(twice * tau) + linear;
      away = {T(away.x - weights[k] * at.x), T(away.y - weights[k] * at.y)};
      first = {T(first.x + slopes[k] * at.x), T(first.y + slopes[k] * at.y)};
      second = {T(second.x + twice * at.x), T(second.y + twice * at.y)};
    }
  }
  // Minus the derivative of away . first by tau.
  T Bend() const { return T(Dot(first, first) - Dot(away, second)); }

  std::array<T, 3> weights, slopes;  // N_k and N_k'
  Plane<T> away, first, second;      // p, y', y''
};

// Gap without the radius, knot from the begin of the patch, slip per knot, and gradients of the first two by the
// places, all of them to `order` derivatives.
template <typename T>
struct Values {
  Values(const SplinePatch& patch, const Places<T>& z, double foot, double radius, int order) {
    // Each step of Newton's method from the foot doubles the order to which derivatives are right.
    knot = Constant<T>(foot);
    for (int i = 0; i < order; ++i) {
      const FootOnParabola<T> at(patch, z, knot);
      knot = T(knot + T(Dot(at.away, at.first)) / at.Bend());
    }
    const FootOnParabola<T> at(patch, z, knot);
    using std::sqrt;
    const T square = Dot(at.first, at.first), speed = T(sqrt(square)), bend = at.Bend();
    const Plane<T> normal = {T(Constant<T>(0.0) - at.first.y) / speed, T(at.first.x / speed)};
    gap = Dot(at.away, normal);
    const T cross = T(at.first.x * at.second.y - at.first.y * at.second.x);
    slip = T(speed - T(Constant<T>(radius) * cross) / square);
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const T &n = axis == 0 ? normal.x : normal.y, &first = axis == 0 ? at.first.x : at.first.y,
              &away = axis == 0 ? at.away.x : at.away.y;
      gap_gradient[axis] = n;
      knot_gradient[axis] = T(first / bend);
      for (std::size_t k = 0; k < 3; ++k) {
        gap_gradient[2 * k + 2 + axis] = T(Constant<T>(0.0) - at.weights[k] * n);
        knot_gradient[2 * k + 2 + axis] = T(T(at.slopes[k] * away - at.weights[k] * first) / bend);
      }
    }
  }

  T gap, knot, slip;
  Places<T> gap_gradient, knot_gradient;
};

// Of the force, what belongs to these gradients of the gap and of the knot: c grad xi is the slip per knot times the
// gradient of the knot.
template <typename T>
T ForceOf(const PortReals& forces, const T& gap, const T& slip, const T& knot) {
  return T(Constant<T>(forces[kNormal]) * gap) + T(Constant<T>(forces[kTangent]) * T(slip * knot));
}

}  // namespace

// Places among the unknowns of a pair on a patch.
struct DeformablePair::Columns {
  Columns(const DeformablePair& pair, const SplinePatch& patch) {
    Places<int> all{};
    all.fill(-1);
    sign.fill(1.0);
    const auto set = [&](std::size_t node, const NodePlace& place) {
      for (std::size_t axis = 0; axis < 2; ++axis) {
        all[2 * node + axis] = place.dofs[axis];
        sign[2 * node + axis] = place.sign[axis];
      }
    };
    set(0, pair.node_);
    for (std::size_t k = 0; k < 3; ++k)
      if (patch.nodes[k] >= 0) set(k + 1, pair.boundary_->Nodes()[static_cast<std::size_t>(patch.nodes[k])]);
    Places<int> sorted = all;
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t k = 0; k < sorted.size(); ++k)
      if (sorted[k] >= 0 && (k == 0 || sorted[k] != sorted[k - 1])) dofs.push_back(sorted[k]);
    for (std::size_t k = 0; k < all.size(); ++k)
      of[k] = all[k] < 0 ? -1 : std::lower_bound(dofs.begin(), dofs.end(), all[k]) - dofs.begin();
  }

  // By (dofs, s), from values by place; what is held, and s, have no share.
  LawVector Gather(const Place& values) const {
    LawVector q = LawVector::Zero(static_cast<Eigen::Index>(dofs.size()) + 1);
    for (std::size_t k = 0; k < of.size(); ++k)
      if (of[k] >= 0) q[of[k]] += sign[k] * values[static_cast<Eigen::Index>(k)];
    return q;
  }
  Place Scatter(const LawVector& q) const {
    Place values = Place::Zero();
    for (std::size_t k = 0; k < of.size(); ++k)
      if (of[k] >= 0) values[static_cast<Eigen::Index>(k)] = sign[k] * q[of[k]];
    return values;
  }
  // rows(k): by place, of the place k.
  template <typename Rows>
  LawMatrix GatherRows(Rows rows) const {
    const auto size = static_cast<Eigen::Index>(dofs.size()) + 1;
    LawMatrix matrix = LawMatrix::Zero(size, size);
    for (std::size_t k = 0; k < of.size(); ++k)
      if (of[k] >= 0) matrix.row(of[k]) += sign[k] * Gather(rows(k)).transpose();
    return matrix;
  }

  LawDofs dofs;
  Places<Eigen::Index> of{};  // by place; -1: held, or there is none
  Places<double> sign{};      // by place, of the dof in it: an image has the dofs of its node
};

// Where the node and the control nodes of a patch are, and the unknowns among their places.
struct DeformablePair::Stencil {
  Stencil(const DeformablePair& pair, const Eigen::VectorXd& u, double s, int patch_number)
      : radius(pair.boundary_->Radius()),
        patch(pair.patches_.Patch(pair.KnownPatch(u, s, patch_number))),
        columns(pair, patch) {
    const std::array<Eigen::Vector2d, 3> places = pair.boundary_->Places(patch, u);
    const Eigen::Vector2d x = pair.node_.At(u);
    z << x, places[0], places[1], places[2];
    foot = Parabola(patch, places).FootOf(x, patch.begin, patch.end);
  }

  // variable(k): of the place k.
  template <typename T, typename Variable>
  Values<T> ValuesOf(int order, Variable variable) const {
    Places<T> variables;
    for (int k = 0; k < Place::SizeAtCompileTime; ++k) variables[static_cast<std::size_t>(k)] = variable(k);
    return {patch, variables, foot, radius, order};
  }
  // With derivatives by the places.
  ByPlaces Variable(int k) const { return {z[k], Place::SizeAtCompileTime, k}; }
  Values<ByPlaces> ByAllPlaces() const {
    return ValuesOf<ByPlaces>(1, [this](int k) { return Variable(k); });
  }
  Values<TwiceByPlaces> TwiceByAllPlaces() const {
    return ValuesOf<TwiceByPlaces>(2,
                                   [this](int k) { return TwiceByPlaces(Variable(k), Place::SizeAtCompileTime, k); });
  }
  // Along z + h first + h^2 / 2 second.
  Values<TwiceAlong> TwiceAlongCurve(const Place& first, const Place& second) const {
    const auto along = [](double value, double slope) { return Along(value, Eigen::Matrix<double, 1, 1>(slope)); };
    return ValuesOf<TwiceAlong>(2, [&](int k) {
      return TwiceAlong(along(z[k], first[k]), Eigen::Matrix<Along, 1, 1>(along(first[k], second[k])));
    });
  }

  double radius;
  SplinePatch patch;
  Columns columns;
  Place z;
  double foot;
};

DeformablePair::DeformablePair(std::shared_ptr<const DeformableBoundary> boundary, const AdmissiblePatches& patches,
                               const NodePlace& node, double friction, const Eigen::VectorXd& force_bounds,
                               const BroughtOn& overlap, double told_by)
    : boundary_(std::move(boundary)), patches_(patches), node_(node) {
  Traits traits;
  traits.largest_ratio = friction;
  traits.told_by = told_by;
  traits.compliant = traits.couples = traits.curved = true;
  traits.moves[kNormal].set();
  traits.moves[kTangent].set();
  SurfaceTraits of_surface;
  of_surface.has_patches = of_surface.deformable = true;
  of_surface.overlap = overlap;
  // The foot moves by no more than the largest motion of a control node.
  traits.largest_reach_rate = std::sqrt(2.0) + std::abs(overlap.rate);
  if (force_bounds.size() > 0) {
    const auto bound_of = [&](const NodePlace& place) {
      double bound = 0.0;
      for (const int dof : place.dofs)
        if (dof >= 0) bound += force_bounds[dof];
      return bound;
    };
    double bound = 0.0;
    for (const NodePlace& place : boundary_->Nodes()) bound = std::max(bound, bound_of(place));
    const double own = bound_of(node_);
    if (own > 0.0 && (own < bound || bound == 0.0)) bound = own;
    traits.force_unit = ForceUnitAbove(bound);
  }
  if (told_by > 0.0) traits.force_unit = std::max(traits.force_unit, ForceUnitOf(told_by));
  SetContact(traits, of_surface);
}

LawDofs DeformablePair::Dofs(int patch) const { return Columns(*this, patches_.Patch(patch)).dofs; }

void DeformablePair::Evaluate(const Eigen::VectorXd& u, double s, int patch, const PortReals& reference,
                              PortsAt* ports) const {
  const Stencil stencil(*this, u, s, patch);
  const Columns& columns = stencil.columns;
  const Values<ByPlaces> at = stencil.ByAllPlaces();
  const double length = boundary_->LengthPerKnot();
  const auto gather = [&](const Places<ByPlaces>& gradient) {
    Place values;
    for (std::size_t k = 0; k < gradient.size(); ++k) values[static_cast<Eigen::Index>(k)] = gradient[k].value();
    return columns.Gather(values);
  };
  PortAt &gap = (*ports)[kNormal], &xi = (*ports)[kTangent];
  ports->dofs = columns.dofs;
  gap.motion = at.gap.value() - stencil.radius;
  xi.motion = length * (stencil.patch.knot + stencil.foot) - reference[kTangent];
  gap.gradient = gather(at.gap_gradient);
  ToGap(s, &gap);
  xi.gradient = length * gather(at.knot_gradient);
  gap.hessian = columns.GatherRows([&](std::size_t k) { return at.gap_gradient[k].derivatives(); });
  xi.hessian = length * columns.GatherRows([&](std::size_t k) { return at.knot_gradient[k].derivatives(); });
  xi.factor = at.slip.value() / length;
  xi.factor_gradient = columns.Gather(at.slip.derivatives()) / length;
}

double DeformablePair::Gap(const Eigen::VectorXd& u, double s, int patch) const {
  return GapAt(s, GapBeside(BoundaryAtPlaces(u), node_.At(u), KnownPatch(u, s, patch)));
}

NearestFoot DeformablePair::Nearest(const Eigen::VectorXd& u, double s) const {
  NearestFoot nearest = BoundaryAtPlaces(u).Nearest(node_.At(u));
  nearest.distance = GapAt(s, nearest.distance - boundary_->Radius());
  return nearest;
}

int DeformablePair::PatchAfter(const Eigen::VectorXd& u, double /*s*/, int from) const {
  return PatchBeside(BoundaryAtPlaces(u), node_.At(u), from);
}

bool DeformablePair::HasPatch(int patch) const { return patches_.Has(patch); }

XiRange DeformablePair::RangeOf(int patch) const {
  const Eigen::VectorXd nowhere;  // xi stays with the material
  return RangeBeside(BoundaryAtPlaces(nowhere), patch);
}

bool DeformablePair::Overrun(const Eigen::VectorXd& u, const Eigen::VectorXd& after, int patch) const {
  const BoundaryAt from = BoundaryAtPlaces(u), to = BoundaryAtPlaces(after);
  const Eigen::Vector2d x = node_.At(u), moved = node_.At(after);
  const double radius = boundary_->Radius();
  if (to.Nearest(moved).distance < std::abs(to.Project(moved, patch).gap + radius) - tolerances::kRootOfRounding)
    return true;
  const NodalSpline& spline = boundary_->Spline();
  const int own = spline.Within(patch), count = spline.NumPatches();
  for (int i = 0; i < count; ++i) {
    const int apart = std::abs(i - own);
    if (!patches_.Has(i) || std::min(apart, spline.Closed() ? count - apart : apart) <= 1) continue;
    const Projection foot = to.Project(moved, i), before = from.Project(x, i);
    const XiRange range = to.RangeOf(i);
    // The foot may have come from a patch beside.
    const double beside = range.end - range.begin;
    if (foot.xi >= range.begin && foot.xi <= range.end && std::abs(foot.xi - before.xi) <= beside &&
        foot.gap + radius < 0.0 && before.gap + radius >= 0.0)
      return true;
  }
  return false;
}

void DeformablePair::ForceHessian(const Eigen::VectorXd& u, double s, int patch, const PortReals& forces,
                                  const LawVector& weights, LawMatrix* hessian) const {
  const Stencil stencil(*this, u, s, patch);
  const Values<TwiceByPlaces> at = stencil.TwiceByAllPlaces();
  const Place by_place = stencil.columns.Scatter(weights);
  TwiceByPlaces along_gap = Constant<TwiceByPlaces>(0.0), along_knot = along_gap;
  for (std::size_t k = 0; k < at.gap_gradient.size(); ++k) {
    const TwiceByPlaces weight = Constant<TwiceByPlaces>(by_place[static_cast<Eigen::Index>(k)]);
    along_gap = TwiceByPlaces(along_gap + weight * at.gap_gradient[k]);
    along_knot = TwiceByPlaces(along_knot + weight * at.knot_gradient[k]);
  }
  const TwiceByPlaces force = ForceOf(forces, along_gap, at.slip, along_knot);
  *hessian = stencil.columns.GatherRows(
      [&](std::size_t k) { return force.derivatives()[static_cast<Eigen::Index>(k)].derivatives(); });
}

LawVector DeformablePair::SecondDirectional(const Eigen::VectorXd& u, double s, int patch, const PortReals& forces,
                                            const LawVector& direction) const {
  const Stencil stencil(*this, u, s, patch);
  const Values<TwiceAlong> at = stencil.TwiceAlongCurve(stencil.columns.Scatter(direction), Place::Zero());
  Place second;
  for (std::size_t k = 0; k < at.gap_gradient.size(); ++k)
    second[static_cast<Eigen::Index>(k)] =
        ForceOf(forces, at.gap_gradient[k], at.slip, at.knot_gradient[k]).derivatives()[0].derivatives()[0];
  return stencil.columns.Gather(second);
}

Eigen::Vector3d DeformablePair::FactorAlong(std::size_t port, const Eigen::VectorXd& u, double s, int patch,
                                            const LawVector& first, const LawVector& second) const {
  if (port == kNormal) return Law::FactorAlong(port, u, s, patch, first, second);
  const Stencil stencil(*this, u, s, patch);
  const TwiceAlong slip = stencil.TwiceAlongCurve(stencil.columns.Scatter(first), stencil.columns.Scatter(second)).slip;
  const Along& change = slip.derivatives()[0];
  return Eigen::Vector3d(slip.value().value(), change.value(), change.derivatives()[0]) / boundary_->LengthPerKnot();
}

}  // namespace contact_path
