#include "check/elements.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/AutoDiff>
#include <utility>

namespace contact_path::check {
namespace {

constexpr Real kNaN = std::numeric_limits<Real>::quiet_NaN();

// A number with its derivatives by kCount variables.
template <int kCount>
using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<Real, kCount, 1>>;

template <int kCount>
Dual<kCount> Variable(Real value, int number) {
  return {value, kCount, number};
}

// A point of the reference cell.
struct CellPlace {
  Real xi, eta, weight;
};

std::vector<CellPlace> Places(std::size_t nodes) {
  if (nodes == 3) return {{1.0L / 3.0L, 1.0L / 3.0L, 0.5L}};
  std::vector<CellPlace> places;
  if (nodes == 6) {
    for (const auto& [xi, eta] : {std::pair(4.0L, 1.0L), std::pair(1.0L, 4.0L), std::pair(1.0L, 1.0L)})
      places.push_back({xi / 6.0L, eta / 6.0L, 1.0L / 6.0L});
    return places;
  }
  const Real root = std::sqrt(1.0L / 3.0L);
  for (const Real xi : {-root, root})
    for (const Real eta : {-root, root}) places.push_back({xi, eta, 1.0L});
  return places;
}

// Shape functions at (xi, eta). Those of corners are the linear or bilinear ones less half of each mid-side's beside
// them.
using CellNumber = Dual<2>;
std::vector<CellNumber> ShapeFunctions(std::size_t nodes, const CellNumber& xi, const CellNumber& eta) {
  std::vector<CellNumber> shapes;
  const CellNumber one(1.0L);
  if (nodes == 3 || nodes == 6) {
    shapes = {one - xi - eta, xi, eta};
    if (nodes == 6)
      for (std::size_t i = 0; i < 3; ++i) shapes.push_back(shapes[i] * shapes[(i + 1) % 3] * 4.0L);
  } else {
    const CellNumber left = (one - xi) / 2.0L, right = (one + xi) / 2.0L;
    const CellNumber below = (one - eta) / 2.0L, above = (one + eta) / 2.0L;
    shapes = {left * below, right * below, right * above, left * above};
    if (nodes == 8) {
      const CellNumber across = left * right * 4.0L, up = below * above * 4.0L;
      for (const CellNumber& middle :
           {CellNumber(across * below), CellNumber(right * up), CellNumber(across * above), CellNumber(left * up)})
        shapes.push_back(middle);
    }
  }
  const std::size_t corners = nodes <= 4 ? nodes : nodes / 2;
  for (std::size_t i = corners; i < nodes; ++i) {
    const std::size_t side = i - corners;
    for (const std::size_t corner : {side, (side + 1) % corners}) shapes[corner] = shapes[corner] - shapes[i] / 2.0L;
  }
  return shapes;
}

// W of a deformation gradient in the plane and of the thickness: `across` is C33, or e33 of the linear law.
struct Law {
  // F: F11, F12, F21, F22.
  template <typename T>
  T Energy(const std::array<T, 4>& F, const T& across) const {
    using std::log;
    if (model == MaterialModel::kLinear) {
      const T e11 = F[0] - 1.0L, e22 = F[3] - 1.0L, e12 = (F[1] + F[2]) / 2.0L;
      return Quadratic<T>(e11 + e22 + across, e11 * e11 + e22 * e22 + e12 * e12 * 2.0L + across * across);
    }
    const T C11 = F[0] * F[0] + F[2] * F[2], C22 = F[1] * F[1] + F[3] * F[3], C12 = F[0] * F[1] + F[2] * F[3];
    const T in_plane = C11 * C22 - C12 * C12;
    const T i1 = C11 + C22 + across, i2 = in_plane + across * (C11 + C22), i3 = in_plane * across;
    if (model == MaterialModel::kStVenantKirchhoff) {
      // tr(C C) = i1^2 - 2 i2.
      const T trace = (i1 - 3.0L) / 2.0L;
      return Quadratic<T>(trace, (i1 * i1 - i2 * 2.0L - i1 * 2.0L + 3.0L) / 4.0L);
    }
    const T logarithm = log(i3);
    if (model == MaterialModel::kNeoHookean)
      return (i1 - 3.0L - logarithm) * (mu / 2.0L) + logarithm * logarithm * (lambda / 8.0L);
    return (i1 - 3.0L) * a + (i2 - 3.0L) * (mu / 2.0L - a) + (i3 - 1.0L) * (lambda / 4.0L - mu / 2.0L + a) -
           logarithm * ((lambda / 2.0L + mu) / 2.0L);
  }
  template <typename T>
  T Quadratic(const T& trace, const T& squares) const {
    return trace * trace * (lambda / 2.0L) + squares * mu;
  }

  // dW/d(across).
  Real StressAcross(const std::array<Real, 4>& F, Real across) const {
    std::array<Dual<1>, 4> constant;
    for (std::size_t i = 0; i < 4; ++i) constant[i] = Dual<1>(F[i], Dual<1>::DerType::Zero());
    return Energy<Dual<1>>(constant, Variable<1>(across, 0)).derivatives()[0];
  }

  // The thickness that the plane state gives; NaN where there is none.
  Real Across(const std::array<Real, 4>& F) const;

  MaterialModel model = MaterialModel::kNeoHookean;
  PlaneState plane = PlaneState::kStrain;
  Real lambda = 0.0L, mu = 0.0L, a = 0.0L;
};

Real Law::Across(const std::array<Real, 4>& F) const {
  const bool linear = model == MaterialModel::kLinear;
  if (plane == PlaneState::kStrain) return linear ? 0.0L : 1.0L;
  if (linear) return -lambda / (lambda + 2.0L * mu) * (F[0] + F[3] - 2.0L);
  // The logarithm of C33 between two at which the stress has opposite signs, narrowed by the false position method
  // with halved ends (Illinois).
  const auto stress = [&](Real logarithm) { return StressAcross(F, std::exp(logarithm)); };
  Real low = 0.0L, high = 0.0L, at_low = stress(low), at_high = at_low;
  Real reach = 0.25L;
  for (; at_low > 0.0L && std::exp(low) > 0.0L; reach *= 2.0L) at_low = stress(low -= reach);
  reach = 0.25L;
  for (; at_high < 0.0L && std::isfinite(std::exp(high)); reach *= 2.0L) at_high = stress(high += reach);
  if (!(at_low <= 0.0L && at_high >= 0.0L)) return kNaN;
  while (at_high > at_low) {
    const Real middle = low - at_low * (high - low) / (at_high - at_low), at_middle = stress(middle);
    if (at_middle == 0.0L || middle <= low || middle >= high) return std::exp(middle);
    if (at_middle < 0.0L) {
      low = middle;
      if (at_low == at_middle) break;
      at_low = at_middle;
      at_high /= 2.0L;
    } else {
      high = middle;
      at_high = at_middle;
      at_low /= 2.0L;
    }
  }
  return std::exp(std::abs(at_low) < std::abs(at_high) ? low : high);
}

class SolidElement : public Element {
 public:
  SolidElement(const Solid& solid, const Material& material, std::vector<std::size_t> nodes,
               const std::vector<double>& reference)
      : Element(Kind::kSolid, std::move(nodes)) {
    law_.model = material.model;
    law_.plane = solid.plane;
    law_.lambda = material.lambda;
    law_.mu = material.mu;
    law_.a = material.a;
    if (material.E != 0.0) {
      const Real E = material.E, nu = material.nu;
      law_.lambda = E * nu / ((1.0L + nu) * (1.0L - 2.0L * nu));
      law_.mu = E / (2.0L + 2.0L * nu);
    }
    const Real thickness = solid.Thickness();
    for (const CellPlace& place : Places(Nodes().size())) points_.push_back(MakePoint(place, thickness, reference));
  }

  bool Turns() const override { return law_.model != MaterialModel::kLinear; }

  Real Stiffness() const override {
    Real stiffness = 0.0L;
    for (const Point& point : points_) {
      Real steepest = 0.0L;
      for (const Vector& gradient : point.gradients) steepest = std::max(steepest, Dot(gradient, gradient));
      stiffness += point.volume * (std::abs(law_.lambda) + 2.0L * law_.mu) * steepest;
    }
    return stiffness;
  }

  void AddEnergy(const std::vector<double>& positions, Real* energy) const override {
    for (const Point& point : points_) {
      const std::array<Real, 4> F = GradientAt(point, positions);
      *energy += Sound(F) ? point.volume * law_.Energy<Real>(F, law_.Across(F)) : kNaN;
    }
  }

  // The force across an area is the same whether it is told by the area now or at the start: sigma dv = P F' dV.
  std::optional<MeanStress> Stress(const std::vector<double>& positions) const override {
    const bool linear = law_.model == MaterialModel::kLinear;
    MeanStress mean;
    Real volume = 0.0L, steepest = 0.0L;
    for (const Point& point : points_) {
      const std::array<Real, 4> F = GradientAt(point, positions);
      const Real across = Sound(F) ? law_.Across(F) : kNaN;
      const Derivatives P = StressAt(F, across);
      const Real sideways = law_.StressAcross(F, across);  // half the stress over C33, of the linear law the stress
      if (linear) {
        mean.xx += point.volume * P[0];
        mean.yy += point.volume * P[3];
        mean.xy += point.volume * (P[1] + P[2]) / 2.0L;
        mean.zz += point.volume * sideways;
      } else {
        mean.xx += point.volume * (P[0] * F[0] + P[1] * F[1]);
        mean.yy += point.volume * (P[2] * F[2] + P[3] * F[3]);
        mean.xy += point.volume * (P[0] * F[2] + P[1] * F[3]);
        mean.zz += point.volume * 2.0L * sideways * across;
      }
      volume += point.volume * (linear ? 1.0L : (F[0] * F[3] - F[1] * F[2]) * std::sqrt(across));
      for (const Vector& gradient : point.gradients) steepest = std::max(steepest, Length(gradient));
    }
    for (Real* const of : {&mean.xx, &mean.yy, &mean.xy, &mean.zz}) *of /= volume;
    mean.per_motion = (std::abs(law_.lambda) + 2.0L * law_.mu) * steepest;
    AddEnergy(positions, &mean.energy);
    return mean;
  }

  void AddForce(const std::vector<double>& positions, std::vector<Real>* forces) const override {
    for (const Point& point : points_) {
      const std::array<Real, 4> F = GradientAt(point, positions);
      const Derivatives stress = StressAt(F, Sound(F) ? law_.Across(F) : kNaN);
      for (std::size_t i = 0; i < Nodes().size(); ++i) {
        const Vector& gradient = point.gradients[i];
        AddTo(forces, Nodes()[i],
              {point.volume * (stress[0] * gradient.x + stress[1] * gradient.y),
               point.volume * (stress[2] * gradient.x + stress[3] * gradient.y)});
      }
    }
  }

 private:
  using Derivatives = Dual<4>::DerType;

  // dW/dF. The thickness of plane stress makes W least: W does not change with it.
  Derivatives StressAt(const std::array<Real, 4>& F, Real across) const {
    std::array<Dual<4>, 4> variables;
    for (int i = 0; i < 4; ++i) variables[static_cast<std::size_t>(i)] = Variable<4>(F[static_cast<std::size_t>(i)], i);
    return law_.Energy<Dual<4>>(variables, Dual<4>(across, Derivatives::Zero())).derivatives();
  }

  // An integration point.
  struct Point {
    Real volume = 0.0L;
    std::vector<Vector> gradients;  // of the shape functions
  };

  Point MakePoint(const CellPlace& place, Real thickness, const std::vector<double>& reference) const {
    const std::vector<CellNumber> shapes =
        ShapeFunctions(Nodes().size(), Variable<2>(place.xi, 0), Variable<2>(place.eta, 1));
    CellNumber x(0.0L, CellNumber::DerType::Zero()), y = x;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      const Vector at = NodePosition(reference, Nodes()[i]) - NodePosition(reference, Nodes()[0]);
      x += shapes[i] * at.x;
      y += shapes[i] * at.y;
    }
    Eigen::Matrix<Real, 2, 2> jacobian;
    jacobian << x.derivatives().transpose(), y.derivatives().transpose();
    Point point;
    point.volume = place.weight * jacobian.determinant() * thickness;
    for (const CellNumber& shape : shapes) {
      const Eigen::Matrix<Real, 2, 1> gradient = jacobian.inverse().transpose() * shape.derivatives();
      point.gradients.push_back({gradient[0], gradient[1]});
    }
    return point;
  }

  std::array<Real, 4> GradientAt(const Point& point, const std::vector<double>& positions) const {
    std::array<Real, 4> F = {};
    for (std::size_t i = 1; i < Nodes().size(); ++i) {
      const Vector from_first = NodePosition(positions, Nodes()[i]) - NodePosition(positions, Nodes()[0]);
      F[0] += from_first.x * point.gradients[i].x;
      F[1] += from_first.x * point.gradients[i].y;
      F[2] += from_first.y * point.gradients[i].x;
      F[3] += from_first.y * point.gradients[i].y;
    }
    return F;
  }

  // Whether the material is not turned inside out.
  bool Sound(const std::array<Real, 4>& F) const {
    return law_.model == MaterialModel::kLinear || F[0] * F[3] - F[1] * F[2] > 0.0L;
  }

  Law law_;
  std::vector<Point> points_;
};

}  // namespace

std::unique_ptr<const Element> MakeSolid(const Solid& solid, const Material& material, std::vector<std::size_t> nodes,
                                         const std::vector<double>& reference) {
  return std::make_unique<SolidElement>(solid, material, std::move(nodes), reference);
}

}  // namespace contact_path::check
