// Lattices, frames and solids of a wanted size for the benchmarks, and the linear systems of their increments.
#ifndef CONTACT_PATH_BENCH_LATTICES_H_
#define CONTACT_PATH_BENCH_LATTICES_H_

#include <Eigen/SparseCore>

#include "contact_path/path/model.h"
#include "lattice.h"

namespace contact_path {

// A wall five times as long as high with about `dofs` degrees of freedom, 1 % of its nodes contact candidates.
TraceRequest WallOf(int dofs, int far_candidates = 0);

// Candidates out of reach beside those that a wall has: the first of its free nodes against a wavy polyline of 1,000
// edges with fillets, ten cells below it. Throws std::invalid_argument for more candidates than free nodes.
void AddFarCurve(int candidates, Scene* wall);

// A square block of about `dofs` degrees of freedom above a rough floor, at a distance of `gap` cells. contacts: 0 = a
// candidate for each node of the edge.
TraceRequest BlockOf(int dofs, int contacts, double gap);

// A frame of as many bays as storeys, of squares of side 1, with about `dofs` degrees of freedom, clamped at the
// ground and pushed sideways at each storey. Each beam has four segments and EA L^2 / EI = 10^4.
TraceRequest FrameOf(int dofs);

// A square block of elements of four nodes, held at its left edge and pushed down at its right one. cells: along a
// side.
TraceRequest SolidOf(int cells, MaterialModel model, PlaneState plane);

// Least of three factorisations of the tangent at u by CHOLMOD, supernodal and ordered by METIS, ordered and analysed
// before [s].
double CholmodTime(const Structure& structure, const Eigen::VectorXd& u);

// M' of linear/bordered_solver.h at the initial configuration, all candidates touching in this state; square. The
// last row has few entries, as large systems have it.
Eigen::SparseMatrix<double> BorderedMatrix(const Model& model, ContactState state);

}  // namespace contact_path

#endif  // CONTACT_PATH_BENCH_LATTICES_H_
