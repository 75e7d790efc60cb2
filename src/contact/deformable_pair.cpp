#include "contact_path/contact/deformable_pair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "contact/spline_contact.h"
#include "contact_path/contact/contact_pair.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

using spline_contact::Along;
using spline_contact::ByPlaces;
using spline_contact::Constant;
using spline_contact::Place;
using spline_contact::Places;
using spline_contact::TwiceAlong;
using spline_contact::TwiceByPlaces;
using spline_contact::Values;

}  // namespace

// Where the node and the control nodes of a patch are, and the unknowns among their places.
struct DeformablePair::Stencil {
  Stencil(const DeformablePair& pair, const Eigen::VectorXd& u, int patch_number)
      : boundary(*pair.boundary_), patch(pair.patches_.Patch(patch_number)) {
    const std::array<Eigen::Vector2d, 3> places = boundary.Places(patch, u);
    const Eigen::Vector2d x = pair.node_.At(u);
    z << x, places[0], places[1], places[2];
    foot = Parabola(patch, places).FootOf(x, patch.begin, patch.end);
  }

  // Values with derivatives by the places.
  Values<ByPlaces> ByAllPlaces() const {
    Places<ByPlaces> variables;
    for (int k = 0; k < Place::SizeAtCompileTime; ++k)
      variables[static_cast<std::size_t>(k)] = ByPlaces(z[k], Place::SizeAtCompileTime, k);
    return {patch, variables, foot, boundary.Radius(), 1};
  }
  Values<TwiceByPlaces> TwiceByAllPlaces() const {
    Places<TwiceByPlaces> variables;
    for (int k = 0; k < Place::SizeAtCompileTime; ++k)
      variables[static_cast<std::size_t>(k)] =
          TwiceByPlaces(ByPlaces(z[k], Place::SizeAtCompileTime, k), Place::SizeAtCompileTime, k);
    return {patch, variables, foot, boundary.Radius(), 2};
  }
  // Along z + h first + h^2 / 2 second.
  Values<TwiceAlong> TwiceAlongCurve(const Place& first, const Place& second) const {
    const auto along = [](double value, double slope) { return Along(value, Eigen::Matrix<double, 1, 1>(slope)); };
    Places<TwiceAlong> variables;
    for (std::size_t k = 0; k < variables.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      Eigen::Matrix<Along, 1, 1> slope;
      slope[0] = along(first[i], second[i]);
      variables[k] = TwiceAlong(along(z[i], first[i]), slope);
    }
    return {patch, variables, foot, boundary.Radius(), 2};
  }

  const DeformableBoundary& boundary;
  SplinePatch patch;
  Place z;
  double foot;
};

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

DeformablePair::DeformablePair(std::shared_ptr<const DeformableBoundary> boundary, const AdmissiblePatches& patches,
                               const NodePlace& node, double friction, const Eigen::VectorXd& force_bounds,
                               const BroughtOn& overlap)
    : boundary_(std::move(boundary)), patches_(patches), node_(node) {
  Traits traits;
  traits.largest_ratio = friction;
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
  SetContact(traits, of_surface);
}

LawDofs DeformablePair::Dofs(int patch) const { return Columns(*this, patches_.Patch(patch)).dofs; }

void DeformablePair::Evaluate(const Eigen::VectorXd& u, double s, int patch, const PortReals& reference,
                              PortsAt* ports) const {
  const Stencil stencil(*this, u, KnownPatch(u, s, patch));
  const Columns columns(*this, stencil.patch);
  const Values<ByPlaces> at = stencil.ByAllPlaces();
  const double length = boundary_->LengthPerKnot();
  PortAt &gap = (*ports)[kNormal], &xi = (*ports)[kTangent];
  ports->dofs = columns.dofs;
  gap.motion = at.gap.value() - boundary_->Radius();
  xi.motion = length * (stencil.patch.knot + stencil.foot) - reference[kTangent];
  Place gap_gradient, knot_gradient;
  for (std::size_t k = 0; k < at.gap_gradient.size(); ++k) {
    gap_gradient[static_cast<Eigen::Index>(k)] = at.gap_gradient[k].value();
    knot_gradient[static_cast<Eigen::Index>(k)] = at.knot_gradient[k].value();
  }
  gap.gradient = columns.Gather(gap_gradient);
  ToGap(s, &gap);
  xi.gradient = length * columns.Gather(knot_gradient);
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

int DeformablePair::PatchAt(const Eigen::VectorXd& u, double /*s*/) const {
  return PatchBeside(BoundaryAtPlaces(u), node_.At(u));
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
  const Stencil stencil(*this, u, KnownPatch(u, s, patch));
  const Columns columns(*this, stencil.patch);
  const Values<TwiceByPlaces> at = stencil.TwiceByAllPlaces();
  const Place by_place = columns.Scatter(weights);
  TwiceByPlaces along_gap = Constant<TwiceByPlaces>(0.0), along_knot = along_gap;
  for (std::size_t k = 0; k < at.gap_gradient.size(); ++k) {
    const TwiceByPlaces weight = Constant<TwiceByPlaces>(by_place[static_cast<Eigen::Index>(k)]);
    along_gap = TwiceByPlaces(along_gap + weight * at.gap_gradient[k]);
    along_knot = TwiceByPlaces(along_knot + weight * at.knot_gradient[k]);
  }
  // c grad xi is the slip per knot times the gradient of the knot.
  const TwiceByPlaces force =
      TwiceByPlaces(Constant<TwiceByPlaces>(forces[kNormal]) * along_gap) +
      TwiceByPlaces(Constant<TwiceByPlaces>(forces[kTangent]) * TwiceByPlaces(at.slip * along_knot));
  *hessian = columns.GatherRows(
      [&](std::size_t k) { return force.derivatives()[static_cast<Eigen::Index>(k)].derivatives(); });
}

LawVector DeformablePair::SecondDirectional(const Eigen::VectorXd& u, double s, int patch, const PortReals& forces,
                                            const LawVector& direction) const {
  const Stencil stencil(*this, u, KnownPatch(u, s, patch));
  const Columns columns(*this, stencil.patch);
  const Values<TwiceAlong> at = stencil.TwiceAlongCurve(columns.Scatter(direction), Place::Zero());
  Place second;
  for (std::size_t k = 0; k < at.gap_gradient.size(); ++k) {
    const TwiceAlong force =
        TwiceAlong(Constant<TwiceAlong>(forces[kNormal]) * at.gap_gradient[k]) +
        TwiceAlong(Constant<TwiceAlong>(forces[kTangent]) * TwiceAlong(at.slip * at.knot_gradient[k]));
    second[static_cast<Eigen::Index>(k)] = force.derivatives()[0].derivatives()[0];
  }
  return columns.Gather(second);
}

Eigen::Vector3d DeformablePair::FactorAlong(std::size_t port, const Eigen::VectorXd& u, double s, int patch,
                                            const LawVector& first, const LawVector& second) const {
  if (port == kNormal) return Law::FactorAlong(port, u, s, patch, first, second);
  const Stencil stencil(*this, u, KnownPatch(u, s, patch));
  const Columns columns(*this, stencil.patch);
  const Values<TwiceAlong> at = stencil.TwiceAlongCurve(columns.Scatter(first), columns.Scatter(second));
  const Eigen::Vector3d slip(at.slip.value().value(), at.slip.derivatives()[0].value(),
                             at.slip.derivatives()[0].derivatives()[0]);
  return slip / boundary_->LengthPerKnot();
}

}  // namespace contact_path
