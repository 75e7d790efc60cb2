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

// Isoparametric element of a plane solid (scene/cell.h has its shapes) by its initial positions: W = sum over its
// integration points of area x thickness x W(F), F = sum of x_i (grad N_i)'. Values, forces and tangents are NaN where
// the material of an integration point has none: where the element is turned inside out there (structure/material.h).
// positions: x0, y0, x1, ... [length], with a positive Jacobian at all points. thickness > 0 [length].
std::unique_ptr<const Element> MakeSolidElement(const PlaneMaterial& material, double thickness,
                                                const std::vector<double>& positions);

}  // namespace contact_path

#endif  // CONTACT_PATH_STRUCTURE_SOLID_H_
