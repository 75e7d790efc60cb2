// Elements of solids as the check sees them: the energy alone, its forces by automatic differentiation; apart from
// structure/.
#ifndef CONTACT_PATH_SRC_CHECK_SOLID_H_
#define CONTACT_PATH_SRC_CHECK_SOLID_H_

#include <cstddef>
#include <memory>
#include <vector>

#include "check/elements.h"
#include "contact_path/scene/scene.h"

namespace contact_path::check {

// nodes: of one element of the solid. reference: x0, y0, x1, ... of all nodes of the scene. Energy and forces are NaN
// where the element is turned inside out, and where plane stress has no solution.
std::unique_ptr<const Element> MakeSolid(const Solid& solid, const Material& material, std::vector<std::size_t> nodes,
                                         const std::vector<double>& reference);

}  // namespace contact_path::check

#endif  // CONTACT_PATH_SRC_CHECK_SOLID_H_
