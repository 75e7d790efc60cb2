// Linear complementarity problems.
#ifndef CONTACT_PATH_BRANCH_COMPLEMENTARITY_H_
#define CONTACT_PATH_BRANCH_COMPLEMENTARITY_H_

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace contact_path {

// w = M z + q, 0 <= w, 0 <= z, w . z = 0, by Lemke's method with the covering vector `cover` > 0 (Cottle, Pang & Stone,
// The Linear Complementarity Problem, 2009, algorithm 4.4.5). M: n x n, q, cover: n. Ties are broken by changing
// each entry of q by another share of 1e-9 of its largest one, so that the method ends. Returned: which z are basic,
// that is may differ from zero; nothing where the method ends on a ray or the pivots are lost in rounding. The cost is
// n^2 a pivot.
std::optional<std::vector<bool>> SolveByLemke(const Eigen::MatrixXd& M, const Eigen::VectorXd& q,
                                              const Eigen::VectorXd& cover);

// Whether the symmetric part of M is positive definite, by a Cholesky factorisation: then every q has exactly one
// solution.
bool HasOneSolutionForEach(const Eigen::MatrixXd& M);

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_COMPLEMENTARITY_H_
