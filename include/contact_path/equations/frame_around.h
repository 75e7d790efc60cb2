// The frame of the fixed-mode systems of a structure.
#ifndef CONTACT_PATH_EQUATIONS_FRAME_AROUND_H_
#define CONTACT_PATH_EQUATIONS_FRAME_AROUND_H_

#include <Eigen/SparseCore>
#include <cstddef>
#include <vector>

#include "contact_path/law/laws.h"
#include "contact_path/linear/frame.h"
#include "contact_path/structure/structure.h"

namespace contact_path {

// framed: laws that may act, that couple nothing, ascending; tangent: its pattern counts. Unknowns:
// u, the forces of the ports of each law of `framed`, reactions of the prescribed components, s. Equations:
// equilibrium, the motions of these ports, prescribed components. Where a system stands in it is left open.
Frame FrameAround(const Structure& structure, const Laws& laws, const std::vector<std::size_t>& framed,
                  const Eigen::SparseMatrix<double>& tangent);

}  // namespace contact_path

#endif  // CONTACT_PATH_EQUATIONS_FRAME_AROUND_H_
