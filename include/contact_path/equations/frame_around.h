// The frame of the fixed-state systems of a structure.
#ifndef CONTACT_PATH_EQUATIONS_FRAME_AROUND_H_
#define CONTACT_PATH_EQUATIONS_FRAME_AROUND_H_

#include <Eigen/SparseCore>
#include <cstddef>
#include <vector>

#include "contact_path/contact/contact_pair.h"
#include "contact_path/linear/frame.h"
#include "contact_path/structure/structure.h"

namespace contact_path {

// framed: contacts that may touch, with rigid surfaces, ascending; tangent: its pattern counts. Unknowns: u, r_n and
// r_t of each contact of `framed`, reactions of the prescribed components, s. Equations: equilibrium, u_n and xi of
// each contact, prescribed components. Where a system stands in it is left open.
Frame FrameAround(const Structure& structure, const ContactPairs& contacts, const std::vector<std::size_t>& framed,
                  const Eigen::SparseMatrix<double>& tangent);

}  // namespace contact_path

#endif  // CONTACT_PATH_EQUATIONS_FRAME_AROUND_H_
