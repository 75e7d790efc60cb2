#include "contact_path/structure/material.h"

#include <cmath>

#include "contact_path/iterations.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

// ln C33 of the neo-Hookean material in plane stress where ln of the area ratio is `area`: mu (e^z - 1) + lambda (area
// + z/2) = 0. NaN where there is none. The left side is convex in z; beyond its least value it grows.
double NeoHookeanThickness(const Lame& lame, double area) {
  const auto value = [&](double z) { return lame.mu * std::expm1(z) + lame.lambda * (area + 0.5 * z); };
  // Newton's method comes down to the root from any point above it.
  double z = std::max(0.0, -2.0 * area);
  if (lame.lambda < 0.0)
    for (int i = 0; i < kMostIterations && value(z) < 0.0; ++i) z += 1.0;
  for (int i = 0; i < kMostIterations; ++i) {
    const double slope = lame.mu * std::exp(z) + 0.5 * lame.lambda;
    if (!(slope > 0.0)) return NAN;
    const double step = value(z) / slope;
    z -= step;
    if (!(std::abs(step) > tolerances::kLastDigits * (1.0 + std::abs(z)))) return z;
  }
  return std::abs(value(z)) <= tolerances::kEqual * (lame.mu + std::abs(lame.lambda)) ? z : NAN;
}

// d2p/dF2
Eigen::Matrix4d DistortionHessian() {
  Eigen::Matrix4d hessian;
  hessian << 1.0, 0.0, 0.0, -1.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, -1.0, 0.0, 0.0, 1.0;
  return hessian;
}

// d2J/dF2
Eigen::Matrix4d AreaHessian() {
  Eigen::Matrix4d hessian = Eigen::Matrix4d::Zero();
  hessian(0, 3) = hessian(3, 0) = 1.0;
  hessian(1, 2) = hessian(2, 1) = -1.0;
  return hessian;
}

}  // namespace

struct PlaneMaterial::Measures {
  double p = 0.0, q = 0.0;
  Gradient p_gradient, q_gradient;
};

struct PlaneMaterial::Derivatives {
  double w = 0.0;
  double p = 0.0, q = 0.0;
  double pp = 0.0, pq = 0.0, qq = 0.0;
  double ppp = 0.0, ppq = 0.0, pqq = 0.0, qqq = 0.0;
};

PlaneMaterial::PlaneMaterial(const Material& material, PlaneState plane)
    : model_(material.model), plane_(plane), lame_(LameOf(material)), a_(material.a), lambda_in_plane_(lame_.lambda) {
  if (plane == PlaneState::kStress) lambda_in_plane_ = 2.0 * lame_.lambda * lame_.mu / (lame_.lambda + 2.0 * lame_.mu);
}

PlaneMaterial::Measures PlaneMaterial::MeasuresOf(const Gradient& F) const {
  const double across = F[0] - F[3], shear = F[1] + F[2];
  Measures at;
  at.p = 0.5 * (across * across + shear * shear);
  at.p_gradient << across, shear, shear, -across;
  if (Linear()) {
    at.q = F[0] + F[3] - 2.0;
    at.q_gradient << 1.0, 0.0, 0.0, 1.0;
    return at;
  }
  const double area = F[0] * F[3] - F[1] * F[2];
  at.q = area > 0.0 ? area - 1.0 : NAN;
  if (model_ == MaterialModel::kStVenantKirchhoff && plane_ == PlaneState::kStress &&
      !(lame_.lambda + 2.0 * lame_.mu > 2.0 * lame_.lambda * (at.p + at.q)))
    at.q = NAN;  // C33 = 1 - 2 lambda / (lambda + 2 mu) tr E <= 0
  at.q_gradient << F[3], -F[2], -F[1], F[0];
  return at;
}

PlaneMaterial::Derivatives PlaneMaterial::DerivativesAt(const Measures& at) const {
  const double p = at.p, q = at.q, lambda = lambda_in_plane_, mu = lame_.mu;
  Derivatives of;
  switch (model_) {
    case MaterialModel::kNeoHookean: return NeoHookean(at);
    case MaterialModel::kCiarletGeymonat: return CiarletGeymonat(at);
    case MaterialModel::kStVenantKirchhoff:
      // tr E = p + q, tr(E E) = p^2 + p + 2 p q + q^2/2 in the plane.
      of.w = 0.5 * lambda * (p + q) * (p + q) + mu * (p * p + p + 2.0 * p * q + 0.5 * q * q);
      of.p = lambda * (p + q) + mu * (2.0 * p + 1.0 + 2.0 * q);
      of.q = lambda * (p + q) + mu * (2.0 * p + q);
      of.pp = of.pq = lambda + 2.0 * mu;
      of.qq = lambda + mu;
      break;
    case MaterialModel::kLinear:
      // tr e = q, tr(e e) = q^2/2 + p.
      of.w = 0.5 * (lambda + mu) * q * q + mu * p;
      of.p = mu;
      of.q = (lambda + mu) * q;
      of.qq = lambda + mu;
      break;
  }
  return of;
}

// W = mu (p + q) + G(ln J).
PlaneMaterial::Derivatives PlaneMaterial::NeoHookean(const Measures& at) const {
  const double lambda = lame_.lambda, mu = lame_.mu, log = std::log1p(at.q), J = 1.0 + at.q;
  // G and its derivatives by ln J. Plane stress: z = ln C33, whose derivatives follow from the equation for z.
  double g = 0.5 * lambda * log * log, g1 = lambda * log, g2 = lambda, g3 = 0.0;
  if (plane_ == PlaneState::kStress) {
    const double z = NeoHookeanThickness(lame_, log), stretch = mu * std::exp(z), slope = stretch + 0.5 * lambda;
    const double z1 = -lambda / slope, z2 = -stretch * z1 * z1 / slope;
    g1 = -mu * std::expm1(z);  // lambda (ln J + z/2), without the large lambda of a nearly incompressible material
    g = 0.5 * mu * (std::expm1(z) - z) + 0.5 * g1 * (log + 0.5 * z);
    g2 = lambda * stretch / slope;
    g3 = 0.5 * lambda * z2;
  }
  g1 -= mu;
  Derivatives of;
  of.w = mu * (at.p + (at.q - log)) + g;
  of.p = mu;
  of.q = mu + g1 / J;
  of.qq = (g2 - g1) / (J * J);
  of.qqq = (g3 - 3.0 * g2 + 2.0 * g1) / (J * J * J);
  return of;
}

// i1 = 2 (p + J) + C33, i2 = J^2 + 2 C33 (p + J), i3 = J^2 C33.
PlaneMaterial::Derivatives PlaneMaterial::CiarletGeymonat(const Measures& at) const {
  const double p = at.p, q = at.q, lambda = lame_.lambda, mu = lame_.mu, log = std::log1p(q), J = 1.0 + q;
  const double e = 0.5 * lambda + mu;
  Derivatives of;
  if (plane_ == PlaneState::kStrain) {
    of.w = mu * (p + (q - log)) + 0.25 * lambda * (q * (2.0 + q) - 2.0 * log);
    of.p = mu;
    of.q = mu + 0.5 * lambda * J - e / J;
    of.qq = 0.5 * lambda + e / (J * J);
    of.qqq = -2.0 * e / (J * J * J);
    return of;
  }
  // Plane stress: C33 = 1 / r, r = 1 + m, m = (2/e) (2 b (p + q) + d (J^2 - 1)).
  const double b = 0.5 * mu - a_, d = 0.25 * lambda - b;
  const double m = 2.0 / e * (2.0 * b * (p + q) + d * q * (2.0 + q)), r = 1.0 + m;
  const double m_p = 4.0 * b / e, m_q = 4.0 / e * (b + d * J), m_qq = 4.0 * d / e;
  of.w = 2.0 * a_ * (p + q) + b * q * (2.0 + q) - e * log + 0.5 * e * std::log1p(m);
  of.p = 2.0 * a_ + 0.5 * e * m_p / r;
  of.q = 2.0 * a_ + 2.0 * b * J - e / J + 0.5 * e * m_q / r;
  of.pp = -0.5 * e * m_p * m_p / (r * r);
  of.pq = -0.5 * e * m_p * m_q / (r * r);
  of.qq = 2.0 * b + e / (J * J) + 0.5 * e * (m_qq / r - m_q * m_q / (r * r));
  of.ppp = e * m_p * m_p * m_p / (r * r * r);
  of.ppq = e * m_p * m_p * m_q / (r * r * r);
  of.pqq = e * m_p * (m_q * m_q / (r * r * r) - 0.5 * m_qq / (r * r));
  of.qqq = -2.0 * e / (J * J * J) + e * m_q * (m_q * m_q / (r * r * r) - 1.5 * m_qq / (r * r));
  return of;
}

double PlaneMaterial::Energy(const Gradient& F) const { return DerivativesAt(MeasuresOf(F)).w; }

PlaneMaterial::Gradient PlaneMaterial::Stress(const Gradient& F) const {
  const Measures at = MeasuresOf(F);
  const Derivatives of = DerivativesAt(at);
  return of.p * at.p_gradient + of.q * at.q_gradient;
}

// J sigma33 = 2 C33 dW/dC33.
PlaneMaterial::Across PlaneMaterial::AcrossPlane(const Gradient& F) const {
  const Measures at = MeasuresOf(F);
  const double p = at.p, q = at.q, lambda = lame_.lambda, mu = lame_.mu, J = 1.0 + q;
  const bool stress = plane_ == PlaneState::kStress;
  switch (model_) {
    case MaterialModel::kNeoHookean:
      if (stress) return {std::exp(NeoHookeanThickness(lame_, std::log1p(q))), 0.0};
      return {1.0, lambda * std::log1p(q)};
    case MaterialModel::kStVenantKirchhoff:
      if (stress) return {1.0 - 2.0 * lambda / (lambda + 2.0 * mu) * (p + q), 0.0};
      return {1.0, lambda * (p + q)};
    case MaterialModel::kCiarletGeymonat: {
      const double slope = a_ + 2.0 * (0.5 * mu - a_) * (p + J) + (0.25 * lambda - 0.5 * mu + a_) * J * J;
      const double rest = 0.5 * lambda + mu;
      if (stress) return {0.5 * rest / slope, 0.0};
      return {1.0, 2.0 * slope - rest};
    }
    case MaterialModel::kLinear: return {1.0, stress ? 0.0 : lambda * q};
  }
  return {};
}

PlaneMaterial::Square PlaneMaterial::Tangent(const Gradient& F) const {
  const Measures at = MeasuresOf(F);
  const Derivatives of = DerivativesAt(at);
  const Gradient by_p = of.pp * at.p_gradient + of.pq * at.q_gradient;
  const Gradient by_q = of.pq * at.p_gradient + of.qq * at.q_gradient;
  Square tangent = of.p * DistortionHessian() + at.p_gradient * by_p.transpose() + at.q_gradient * by_q.transpose();
  if (!Linear()) tangent += of.q * AreaHessian();
  return tangent;
}

PlaneMaterial::Square PlaneMaterial::TangentDerivative(const Gradient& F, const Gradient& V) const {
  const Measures at = MeasuresOf(F);
  const Derivatives of = DerivativesAt(at);
  // Rates of the measures and of their gradients, then of the derivatives of W.
  const double p = at.p_gradient.dot(V), q = at.q_gradient.dot(V);
  const Gradient p_gradient = DistortionHessian() * V;
  const Gradient q_gradient = Linear() ? Gradient::Zero().eval() : Gradient(AreaHessian() * V);
  const double w_p = of.pp * p + of.pq * q, w_q = of.pq * p + of.qq * q;
  const double w_pp = of.ppp * p + of.ppq * q, w_pq = of.ppq * p + of.pqq * q, w_qq = of.pqq * p + of.qqq * q;
  // The sum of a product and its transpose: half of each symmetric part, and all of what pairs a gradient with a rate.
  const Gradient with_p =
      0.5 * w_pp * at.p_gradient + 0.5 * w_pq * at.q_gradient + of.pp * p_gradient + of.pq * q_gradient;
  const Gradient with_q =
      0.5 * w_pq * at.p_gradient + 0.5 * w_qq * at.q_gradient + of.pq * p_gradient + of.qq * q_gradient;
  const Square half = at.p_gradient * with_p.transpose() + at.q_gradient * with_q.transpose();
  Square derivative = half + half.transpose() + w_p * DistortionHessian();
  if (!Linear()) derivative += w_q * AreaHessian();
  return derivative;
}

}  // namespace contact_path
