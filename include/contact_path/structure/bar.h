// Straight elastic bar between two nodes.
#ifndef CONTACT_PATH_STRUCTURE_BAR_H_
#define CONTACT_PATH_STRUCTURE_BAR_H_

#include <vector>

#include "contact_path/scene/scene.h"
#include "contact_path/structure/element.h"

namespace contact_path {

// W = EA l0 e^2 / 2 with e the strain of the current length l (scene.h, StrainMeasure; Biot: Kanno & Martins 2005,
// section 4), and 0 where the strain is not of the sense that the bar bears. Written in q = l^2, in which the
// Green-Lagrange bar is a polynomial: no singularity at l = 0.
class BarElement : public Element {
 public:
  // EA > 0 [force], rest_length > 0 [length].
  BarElement(double EA, double rest_length, StrainMeasure strain, BarSense sense = BarSense::kBoth);

  const std::vector<LocalDof>& Dofs() const override;
  double Energy(const Values& x) const override;
  void Force(const Values& x, Eigen::Ref<Eigen::VectorXd> force) const override;
  void Tangent(const Values& x, Eigen::Ref<Eigen::MatrixXd> tangent) const override;
  void TangentDerivative(const Values& x, const Values& v, Eigen::Ref<Eigen::MatrixXd> derivative) const override;

 private:
  // Derivatives of W by q.
  struct EnergyDerivatives {
    double first, second, third;
  };
  EnergyDerivatives Derivatives(double q) const;
  bool Slack(double length) const;

  double EA_;
  double rest_length_;
  StrainMeasure strain_;
  BarSense sense_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_STRUCTURE_BAR_H_
