// Elements of plane solids.
#ifndef CONTACT_PATH_STRUCTURE_SOLID_H_
#define CONTACT_PATH_STRUCTURE_SOLID_H_

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "contact_path/scene/scene.h"
#include "contact_path/structure/element.h"
#include "contact_path/structure/material.h"

namespace contact_path {

// Of an element: means of Cauchy's stress over its current volume [force/length^2], and its strain energy [force
// length].
struct SolidStress {
  double sxx = 0.0;
  double syy = 0.0;
  double sxy = 0.0;
  double szz = 0.0;    // across the plane
  double mises = 0.0;  // of these means
  double energy = 0.0;
};

class SolidElement : public Element {
 public:
  virtual SolidStress MeanStress(const Eigen::Ref<const Eigen::VectorXd>& x) const = 0;
};

// Isoparametric element of a plane solid (scene/cell.h has its shapes) by its initial positions: W = sum over its
// integration points of area x thickness x W(F), F = sum of x_i (grad N_i)'. Values, forces and tangents are NaN where
// the material of an integration point has none: where the element is turned inside out there (structure/material.h).
// positions: x0, y0, x1, ... [length], with a positive Jacobian at all points. thickness > 0 [length].
std::unique_ptr<const SolidElement> MakeSolidElement(const PlaneMaterial& material, double thickness,
                                                     const std::vector<double>& positions);

}  // namespace contact_path

#endif  // CONTACT_PATH_STRUCTURE_SOLID_H_
