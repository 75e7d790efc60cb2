// Linear complementarity problems.
#ifndef CONTACT_PATH_BRANCH_COMPLEMENTARITY_H_
#define CONTACT_PATH_BRANCH_COMPLEMENTARITY_H_

#include <Eigen/Core>
#include <vector>

namespace contact_path {

// Whether z is what may differ from zero, by pair; otherwise w is.
using ComplementaritySolution = std::vector<bool>;

// w = M z + q, 0 <= w, 0 <= z, w . z = 0. M: n x n, scaled to a diagonal of the order of 1; q: n, known to
// tolerances::kRate of the largest variable. Solutions are found by Lemke's method (Cottle, Pang & Stone, The Linear
// Complementarity Problem, 2009, algorithm 4.4.5), where there may be several by several covering vectors and from both
// sides. Ties are broken by changing each entry of q by another share of 1e-9 of its largest one, so that the method
// ends. None is found where it ends on a ray, or the pivots are lost in rounding. The cost is n^2 a pivot.
std::vector<ComplementaritySolution> SolveComplementarity(const Eigen::MatrixXd& M, const Eigen::VectorXd& q);

// Whether the symmetric part of M is positive definite, by a Cholesky factorisation: then every q has exactly one
// solution.
bool HasOneSolutionForEach(const Eigen::MatrixXd& M);

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_COMPLEMENTARITY_H_
