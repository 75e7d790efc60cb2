// Linear complementarity problems, by Lemke's method (Cottle, Pang & Stone, The Linear Complementarity Problem, 2009,
// algorithm 4.4.5).
#ifndef CONTACT_PATH_BRANCH_COMPLEMENTARITY_H_
#define CONTACT_PATH_BRANCH_COMPLEMENTARITY_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <optional>
#include <vector>

namespace contact_path {

// Whether z is what may differ from zero, by pair; otherwise w is.
using ComplementaritySolution = std::vector<bool>;

// w = M z + q, 0 <= w, 0 <= z, w . z = 0. M: n x n, scaled to a diagonal of the order of 1; q: n, known to
// tolerances::kRate of the largest variable. Where there may be several solutions, several covering vectors are tried,
// from both sides. Ties are broken by changing each entry of q by another share of 1e-9 of its largest one, so that the
// method ends. None is found where it ends on a ray, or the pivots are lost in rounding. The cost is n^2 a pivot.
std::vector<ComplementaritySolution> SolveComplementarity(const Eigen::MatrixXd& M, const Eigen::VectorXd& q);

// Whether the symmetric part of M is positive definite, by a Cholesky factorisation: then every q has exactly one
// solution.
bool HasOneSolutionForEach(const Eigen::MatrixXd& M);

// What breaks ties is this share of the data of a problem.
inline constexpr double kOfTies = 1e-9;

// equations (x, w, z) = right, x free, 0 <= w, 0 <= z, w . z = 0. As many equations as x and w have entries.
struct ComplementarityProblem {
  Eigen::SparseMatrix<double> equations;  // columns: x, w, z
  Eigen::VectorXd right;
  Eigen::Index pairs = 0;   // entries of w, and of z
  Eigen::VectorXd changes;  // of w, > 0: what breaks ties

  Eigen::Index NumFree() const { return equations.cols() - 2 * pairs; }
  Eigen::Index First(Eigen::Index pair) const { return NumFree() + pair; }
  Eigen::Index Second(Eigen::Index pair) const { return NumFree() + pairs + pair; }
};

// From `start`, whose basic variables `cover` > 0 covers; empty: z = 0. Ties are broken by changing each of these by
// another share of `changes`, so that the method ends. Nothing where it ends on a ray, where the pivots are lost in
// rounding, or where x and the basic variables are not unique. One solution with sparse LU factors a pivot. values: by
// pair, of the one of w and z that is basic.
std::optional<ComplementaritySolution> SolveByLemke(const ComplementarityProblem& problem, const Eigen::VectorXd& cover,
                                                    ComplementaritySolution start = {},
                                                    Eigen::VectorXd* values = nullptr);

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_COMPLEMENTARITY_H_
