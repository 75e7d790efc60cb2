#include "contact_path/contact/contact_pair.h"

#include <algorithm>
#include <cmath>

#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr int kPowersApart = 20;  // 2^20 is about 1e6: nearly all scenes have the unit 1

}  // namespace

PairVector ContactPair::SecondDirectional(const Eigen::VectorXd& u, double s, int patch, double rn, double rt,
                                          const PairVector& direction) const {
  PairMatrix derivative;
  ForceHessian(u, s, patch, rn, rt, direction, &derivative);
  return derivative * direction;
}

Eigen::Vector3d ContactPair::SlipFactorAlong(const Eigen::VectorXd& /*u*/, double /*s*/, int /*patch*/,
                                             const PairVector& /*first*/, const PairVector& /*second*/) const {
  return Eigen::Vector3d::UnitX();
}

double ContactPair::Xi(const Eigen::VectorXd& u, double s, int patch) const {
  Kinematics kinematics;
  Evaluate(u, s, patch, 0.0, &kinematics);
  return kinematics.xi;
}

double ContactPair::SlipReference(const Eigen::VectorXd& u, double s, int patch) const {
  if (!HasTotalLaw()) return Xi(u, s, patch);
  const double origin = *traits_.slip_origin;
  if (!(traits_.round > 0.0)) return origin;
  return origin + traits_.round * std::round((Xi(u, s, patch) - origin) / traits_.round);
}

double ContactPair::Slipped(const Eigen::VectorXd& u, double s, int patch) const {
  return HasTotalLaw() ? Xi(u, s, patch) - SlipReference(u, s, patch) : 0.0;
}

double ContactPair::SlipRate(const Eigen::VectorXd& u, double s, int patch, const Eigen::VectorXd& du,
                             double ds) const {
  Kinematics kinematics;
  Evaluate(u, s, patch, 0.0, &kinematics);
  return kinematics.slip_factor * kinematics.Rate(kinematics.xi_gradient, du, ds);
}

double ContactPair::Slip(const Eigen::VectorXd& u, double s, int patch, const Eigen::VectorXd& du, double ds,
                         int patch_after) const {
  if (!Curved()) return SlipRate(u, s, patch, du, ds);
  Kinematics from, to;
  Evaluate(u, s, patch, 0.0, &from);
  Evaluate(u + du, s + ds, patch_after, from.xi, &to);
  return to.xi;
}

double LargestReaction(const ContactPairs& contacts, const PathPoint& point) {
  double largest = 0.0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    largest = std::max(largest, std::max(std::abs(point.rn[k]), std::abs(point.rt[k])) / contacts[i]->ForceUnit());
  }
  return largest;
}

Eigen::VectorXd SlipReferences(const ContactPairs& contacts, const PathPoint& point) {
  Eigen::VectorXd references(static_cast<Eigen::Index>(contacts.size()));
  for (std::size_t i = 0; i < contacts.size(); ++i)
    references[static_cast<Eigen::Index>(i)] = contacts[i]->SlipReference(point.u, point.s, point.Patch(i));
  return references;
}

double ForceUnitAbove(double bound) {
  const double rounding = tolerances::kStiffForce * bound;
  if (rounding > 1.0 && std::isfinite(rounding))
    return std::ldexp(1.0, static_cast<int>(std::ceil(std::log2(rounding))));
  if (!(bound > 0.0) || !(bound < 1.0)) return 1.0;
  return std::ldexp(1.0, kPowersApart * static_cast<int>(std::ceil(std::log2(bound) / kPowersApart)));
}

}  // namespace contact_path
