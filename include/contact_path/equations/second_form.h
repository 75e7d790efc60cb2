// Second and third derivatives of the equations under an arc, along several directions.
#ifndef CONTACT_PATH_EQUATIONS_SECOND_FORM_H_
#define CONTACT_PATH_EQUATIONS_SECOND_FORM_H_

#include <Eigen/Core>

#include "contact_path/equations/arc_equations.h"

namespace contact_path {

// F''(a, b) at x, and F'''(a, a, a); times left vectors psi it is the form of which tangents at singular points are
// zeros. equations and x must outlive the object.
class SecondForm {
 public:
  SecondForm(ArcEquations* equations, const Eigen::VectorXd& x) : equations_(*equations), x_(x) {}

  Eigen::VectorXd operator()(const Eigen::VectorXd& a) const { return equations_.SecondDerivative(x_, a); }
  // By polarisation, b as long as a.
  Eigen::VectorXd operator()(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const {
    const double size = b.norm() / a.norm();
    if (!(size > 0.0)) return Eigen::VectorXd::Zero(equations_.NumEquations());
    const Eigen::VectorXd scaled = b / size;
    return 0.25 * size * ((*this)(a + scaled) - (*this)(a - scaled));
  }
  // By central differences and Richardson's extrapolation: the error is of the order of the fourth power of the step.
  Eigen::VectorXd Third(const Eigen::VectorXd& a) const {
    constexpr double kStep = 1e-3;
    const auto difference = [&](double step) -> Eigen::VectorXd {
      const Eigen::VectorXd beyond = equations_.SecondDerivative(x_ + step * a, a);
      return (beyond - equations_.SecondDerivative(x_ - step * a, a)) / (2.0 * step);
    };
    return (4.0 * difference(kStep) - difference(2.0 * kStep)) / 3.0;
  }

 private:
  ArcEquations& equations_;
  const Eigen::VectorXd& x_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_EQUATIONS_SECOND_FORM_H_
