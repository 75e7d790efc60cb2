#include "contact_path/branch/crossing.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <utility>

#include "contact_path/branch/bordered_jacobian.h"
#include "contact_path/equations/newton_loop.h"
#include "contact_path/equations/second_form.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr Eigen::Index kMostParts = 8;  // null vectors at one point

// Makes the sense of a unit vector in (u, s) the same whatever it was.
void Orient(Eigen::Index motion, Eigen::VectorXd* direction) {
  double sense = (*direction)[motion - 1];
  if (std::abs(sense) <= tolerances::kRate) {
    const double largest = direction->head(motion).cwiseAbs().maxCoeff();
    Eigen::Index i = 0;
    while (std::abs((*direction)[i]) < (1.0 - tolerances::kSameTangent) * largest) ++i;
    sense = (*direction)[i];
  }
  if (sense < 0.0) *direction = -*direction;
}

// The crossing with its null vectors, each of one part: t, and columns of v with the left vectors in columns of psi, so
// that psi_i . F''(t, v_j) is 0 for other parts.
class Parts {
 public:
  Parts(ArcEquations* equations, const BorderedJacobian& at, const Eigen::VectorXd& x)
      : at_(at), form_(equations, x), motion_(equations->NumMotion()), v_(at.across), psi_(at.psi) {
    if (v_.cols() > 1) Separate();
  }

  // The tangents of the curve t + ... and of the one in which the part j alone takes part; false: they do not cross.
  bool TangentsOf(Eigen::Index j, Eigen::VectorXd* one, Eigen::VectorXd* other) const {
    const Eigen::VectorXd& t = at_.along;
    const double a = Form(j, t), b = psi_.col(j).dot(form_(t, v_.col(j))), c = Form(j, v_.col(j));
    const double size = std::abs(a) + std::abs(b) + std::abs(c), discriminant = b * b - a * c;
    if (!(discriminant > tolerances::kDependent * size * size)) return false;
    const double q = -b - std::copysign(std::sqrt(discriminant), b);
    *one = Normalised(q * t + a * v_.col(j));
    *other = Normalised(c * t + q * v_.col(j));
    return true;
  }

  // The curve with the tangent z: its second derivative has a share of `from`, the tangent of the other curve.
  CurveDerivatives Curve(const Eigen::VectorXd& z, Eigen::Index j, const Eigen::VectorXd& from) const {
    const auto without = [&](const Eigen::VectorXd& y) {
      return Eigen::VectorXd(y - y.head(motion_).dot(z.head(motion_)) * z);
    };
    Eigen::VectorXd left;
    const Eigen::VectorXd bent = without(at_.Solve(-form_(z), &left)), across = without(from);
    const double along_psi = psi_.col(j).dot(form_.Third(z) + 3.0 * form_(z, bent));
    const double share = along_psi / (3.0 * psi_.col(j).dot(form_(z, across)));
    return {z, bent - share * across};
  }

  Eigen::VectorXd Normalised(const Eigen::VectorXd& z) const { return z / z.head(motion_).norm(); }

 private:
  double Form(Eigen::Index j, const Eigen::VectorXd& z) const { return psi_.col(j).dot(form_(z)); }

  // Null vectors of parts that are not connected have components of their own: those of a reduced echelon form.
  void Separate() {
    const Eigen::Index k = v_.cols();
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> places(v_.topRows(motion_).transpose());
    Eigen::MatrixXd square(k, k), mixed(k, k);
    // In the order of the unknowns, whatever the pivots are.
    Eigen::VectorXi chosen = places.colsPermutation().indices().head(k);
    std::sort(chosen.data(), chosen.data() + k);
    for (Eigen::Index j = 0; j < k; ++j) square.row(j) = v_.row(chosen[j]);
    v_ = v_ * square.inverse();
    for (Eigen::Index j = 0; j < k; ++j) v_.col(j) = Normalised(v_.col(j));
    for (Eigen::Index j = 0; j < k; ++j) mixed.col(j) = psi_.transpose() * form_(at_.along, v_.col(j));
    psi_ = psi_ * mixed.inverse().transpose();
  }

  const BorderedJacobian& at_;
  const SecondForm form_;
  const Eigen::Index motion_;
  Eigen::MatrixXd v_, psi_;
};

// The curves through the located point.
bool FindCurves(ArcEquations* equations, const BorderedJacobian& at, const Eigen::VectorXd& tangent,
                Crossing* crossing) {
  const Parts parts(equations, at, crossing->x);
  const Eigen::Index k = at.across.cols();
  Eigen::VectorXd one, other, all = Eigen::VectorXd::Zero(at.along.size());
  for (Eigen::Index j = 0; j < k; ++j) {
    if (!parts.TangentsOf(j, &one, &other)) return false;
    const auto component = [&](const Eigen::VectorXd& z) { return std::abs(z.head(tangent.size()).dot(tangent)); };
    if (component(other) > component(one)) std::swap(one, other);
    if (j == 0) crossing->along = parts.Curve(one, j, other);
    crossing->across.push_back(parts.Curve(other, j, one));
  }
  crossing->NameCurves(tangent);
  if (k > 1) {
    // How the curve of all parts together bends is left to its first step.
    for (const CurveDerivatives& curve : crossing->across) all += curve.first;
    all = parts.Normalised(all);
    crossing->across.push_back({all, Eigen::VectorXd::Zero(all.size())});
  }
  const auto finite = [](const CurveDerivatives& curve) { return curve.second.allFinite(); };
  return finite(crossing->along) && std::all_of(crossing->across.begin(), crossing->across.end(), finite);
}

// How many ranks are lost near x at about one place: singular values of sigma of one size.
Eigen::Index RanksNear(ArcEquations* equations, const Eigen::VectorXd& x, const Eigen::VectorXd& tangent) {
  const Eigen::Index most = std::min(kMostParts, equations->NumMotion() - 1);
  BorderedJacobian at(equations, tangent);
  if (most < 2 || !at.ChooseBorders(x, most) || !at.Factorize(x)) return 1;
  at.UpdateBorders();
  if (!at.Factorize(x)) return 1;
  const Eigen::VectorXd values = Eigen::JacobiSVD<Eigen::MatrixXd>(at.sigma, Eigen::ComputeFullV).singularValues();
  Eigen::Index k = 1;
  while (k < most && values[most - 1 - k] <= 2.0 * values[most - 1]) ++k;
  return k;
}

}  // namespace

void Crossing::NameCurves(const Eigen::VectorXd& tangent) {
  const auto component = [&](const CurveDerivatives& curve) { return curve.first.head(tangent.size()).dot(tangent); };
  if (across.size() == 1 && std::abs(component(across[0])) > std::abs(component(along))) std::swap(along, across[0]);
  if (component(along) < 0.0) along.first = -along.first;
  for (CurveDerivatives& curve : across) Orient(tangent.size(), &curve.first);
}
// Both F at x and the points of the path have rounding of that size.
bool Crossing::IsPerfect() const { return std::abs(unfolding) <= 2.0 * error; }

std::optional<Crossing> FindCrossing(ArcEquations* equations, const Eigen::VectorXd& guess,
                                     const Eigen::VectorXd& tangent, Eigen::Index k) {
  if (equations->NumUnknowns() != equations->NumEquations() + 1) return std::nullopt;
  if (k == 0) k = RanksNear(equations, guess, tangent);
  BorderedJacobian at(equations, tangent);
  if (!at.ChooseBorders(guess, k)) return std::nullopt;
  Crossing crossing;
  crossing.x = guess;
  crossing.factorisations = 1;
  Eigen::VectorXd residual, step;
  const auto next = [&](const Eigen::VectorXd& x, bool, Eigen::VectorXd* dx) {
    if (crossing.factorisations > 1) at.UpdateBorders();
    equations->Residual(x, &residual);
    ++crossing.factorisations;
    if (!residual.allFinite() || !at.Factorize(x)) return false;
    Eigen::VectorXd left;
    const Eigen::VectorXd back = at.Solve(-residual, &left);
    const SecondForm form(equations, x);
    // Shares of t and of each v: k equations left_along = 0, and one that the mean of the diagonal of sigma is 0.
    Eigen::MatrixXd slope(k + 1, k + 1);
    Eigen::VectorXd value(k + 1);
    const auto psi_of = [&](const Eigen::VectorXd& second) { return Eigen::VectorXd(at.psi.transpose() * second); };
    slope.col(0).head(k) = psi_of(form(at.along));
    value.head(k) = at.left_along - psi_of(form(at.along, back));
    slope.row(k).setZero();
    value[k] = 0.0;
    for (Eigen::Index j = 0; j < k; ++j) {
      const Eigen::VectorXd mixed = psi_of(form(at.along, at.across.col(j)));
      slope.col(1 + j).head(k) = mixed;
      slope(k, 0) += mixed[j];
      value[k] += at.sigma(j, j) - at.psi.col(j).dot(form(at.across.col(j), back));
      for (Eigen::Index i = 0; i < k; ++i)
        slope(k, 1 + i) +=
            at.psi.col(j).dot(i == j ? form(at.across.col(j)) : form(at.across.col(j), at.across.col(i)));
    }
    const Eigen::VectorXd shares = slope.fullPivLu().solve(value);
    *dx = back + shares[0] * at.along + at.across * shares.tail(k);
    return true;
  };
  NewtonLimits limits;
  limits.unit = equations->ResidualUnit();
  const NewtonCourse course = NewtonLoop(
      limits, true, next, [&](const Eigen::VectorXd& dx) { return equations->Norm(dx); }, &crossing.x, &step);
  if (!course.at_rounding) return std::nullopt;
  equations->Residual(crossing.x, &residual);
  const Eigen::VectorXd imperfection = equations->Imperfection(crossing.x);
  for (Eigen::Index j = 0; j < k; ++j) {
    const double length = at.psi.col(j).norm();
    const double unfolding = at.psi.col(j).dot(residual) / length;
    const double error = imperfection.dot(at.psi.col(j).cwiseAbs()) / length;
    if (j > 0 && !(std::abs(unfolding) - error > std::abs(crossing.unfolding) - crossing.error)) continue;
    crossing.unfolding = unfolding;
    crossing.error = error;
  }
  // Of several null vectors, all entries of sigma are zero, or they belong to several points.
  if (k > 1 && !(at.sigma.cwiseAbs().maxCoeff() <= tolerances::kRate * equations->ResidualUnit())) return std::nullopt;
  if (!FindCurves(equations, at, tangent, &crossing)) return std::nullopt;
  return crossing;
}

}  // namespace contact_path
