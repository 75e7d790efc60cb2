// Lemke's method on sparse equations.
#ifndef CONTACT_PATH_BRANCH_LEMKE_H_
#define CONTACT_PATH_BRANCH_LEMKE_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <optional>

#include "contact_path/branch/complementarity.h"

namespace contact_path {

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

// By Lemke's method (Cottle, Pang & Stone, The Linear Complementarity Problem, 2009, algorithm 4.4.5) from `start`,
// whose basic variables `cover` > 0 covers; empty: z = 0. Ties are broken by changing each of these by another share of
// `changes`, so that the method ends. Nothing where it ends on a ray, where the pivots are lost in rounding, or where x
// and the basic variables are not unique. One solution with sparse LU factors a pivot. values: by
// pair, of the one of w and z that is basic.
std::optional<ComplementaritySolution> SolveByLemke(const ComplementarityProblem& problem, const Eigen::VectorXd& cover,
                                                    ComplementaritySolution start = {},
                                                    Eigen::VectorXd* values = nullptr);

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_LEMKE_H_
