#include "contact_path/branch/plane_tangents.h"

#include <algorithm>
#include <cmath>

#include "contact_path/equations/second_form.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

// a y^2 + 2 b y z + c z^2
struct QuadraticForm {
  double a = 0.0, b = 0.0, c = 0.0;
  double Size() const { return std::abs(a) + std::abs(b) + std::abs(c); }
  double operator()(const Eigen::Vector2d& v) const {
    return a * v[0] * v[0] + 2.0 * b * v[0] * v[1] + c * v[1] * v[1];
  }
};

// Unit zeros of the form, up to their sign.
std::vector<Eigen::Vector2d> Zeros(const QuadraticForm& form) {
  const auto& [a, b, c] = form;
  const double discriminant = b * b - a * c;
  if (std::abs(discriminant) <= tolerances::kDependent * form.Size() * form.Size()) {
    const Eigen::Vector2d zero = std::abs(a) >= std::abs(c) ? Eigen::Vector2d(-b, a) : Eigen::Vector2d(c, -b);
    return {zero.normalized()};
  }
  if (discriminant < 0.0) return {};
  const double q = -b - std::copysign(std::sqrt(discriminant), b);
  return {Eigen::Vector2d(q, a).normalized(), Eigen::Vector2d(c, q).normalized()};
}

}  // namespace

PlaneTangents TangentsInPlane(ArcEquations* equations, const Eigen::VectorXd& x, const Eigen::MatrixXd& plane,
                              const Eigen::MatrixXd& left) {
  const SecondForm of(equations, x);
  const Eigen::VectorXd first = of(plane.col(0)), second = of(plane.col(1)), mixed = of(plane.col(0), plane.col(1));
  std::vector<QuadraticForm> forms;
  std::size_t largest = 0;
  for (Eigen::Index k = 0; k < left.cols(); ++k) {
    const Eigen::VectorXd psi = left.col(k).normalized();
    QuadraticForm form;
    form.a = psi.dot(first);
    form.b = psi.dot(mixed);
    form.c = psi.dot(second);
    forms.push_back(form);
    if (form.Size() > forms[largest].Size()) largest = forms.size() - 1;
  }
  PlaneTangents result;
  // Null vectors are known to rounding, which stiff elements make large.
  const double size = std::max({1.0, first.norm(), second.norm(), mixed.norm()});
  if (forms.empty() || !(forms[largest].Size() > tolerances::kNoForm * size)) return result;
  result.determined = true;
  const Eigen::Index motion = equations->NumMotion();
  for (const Eigen::Vector2d& zero : Zeros(forms[largest])) {
    bool common = true;
    for (const QuadraticForm& form : forms)
      common = common && std::abs(form(zero)) <= tolerances::kNearlyParallel * forms[largest].Size();
    const Eigen::VectorXd direction = plane * zero;
    const double norm = direction.head(motion).norm();
    if (common && norm > 0.0) result.directions.emplace_back(direction / norm);
  }
  return result;
}

}  // namespace contact_path
