// Lattice scenes of a wanted size for the benchmarks, and the linear system of their increments.
#ifndef CONTACT_PATH_BENCH_LATTICES_H_
#define CONTACT_PATH_BENCH_LATTICES_H_

#include <Eigen/SparseCore>

#include "contact_path/path/model.h"
#include "contact_path/scene/lattice.h"

namespace contact_path {

// A wall five times as long as high with about `dofs` degrees of freedom, 1 % of its nodes contact candidates.
TraceRequest WallOf(int dofs, int far_candidates = 0);

// A square block of about `dofs` degrees of freedom above a rough floor, at a distance of `gap` cells. contacts: 0 = a
// candidate for each node of the edge.
TraceRequest BlockOf(int dofs, int contacts, double gap);

// M' of linear/bordered_solver.h at the initial configuration, all candidates touching in this state; square. The
// last row has few entries, as large systems have it.
Eigen::SparseMatrix<double> BorderedMatrix(const Model& model, ContactState state);

}  // namespace contact_path

#endif  // CONTACT_PATH_BENCH_LATTICES_H_
