// Whether contacts at the edge of their cones begin to slip from rest: the linear algebra of the verdict.
#ifndef CONTACT_PATH_STABILITY_SLIP_STABILITY_H_
#define CONTACT_PATH_STABILITY_SLIP_STABILITY_H_

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace contact_path {

// Slips z >= 0 of ports at the edges of their cones meet w = H z >= 0, w . z = 0: where they stay at the edge, the
// force that slip would overcome has grown by w. All functions take H with entries of one order of size. Functions that
// try all sets of ports answer for at most kMostSlips ports.
inline constexpr Eigen::Index kMostSlips = 12;

// Whether z . F z > 0 for all z >= 0 other than 0 (Kaplan 2000: no principal submatrix has a positive eigenvector to an
// eigenvalue <= 0). Larger ones: whether the symmetric part of F is positive definite, which is sufficient.
bool IsStrictlyCopositive(const Eigen::MatrixXd& F);

// The degree of the problem (Cottle, Pang & Stone 2009, section 6.1): for a generic q > 0 the sum of the signs of
// det H_II over the sets I of contacts that slip in the solutions of w = H z + q, 0 <= z, w, z . w = 0. Nothing where a
// sign is lost in rounding, or H is too large.
std::optional<int> ComplementarityDegree(const Eigen::MatrixXd& H);

// A motion z of unit norm with w = -rate z where z > 0, w >= 0 elsewhere.
struct GrowingSlip {
  double rate = 0.0;  // >= 0
  Eigen::VectorXd z;
};
// All of them, one for each eigenvalue of each set of contacts; empty where H is too large.
std::vector<GrowingSlip> GrowingSlips(const Eigen::MatrixXd& H);

// The number of directions in which slips grow: of negative eigenvalues of H among the contacts that slip in one of
// `growing`. Nothing where an eigenvalue of negative real part is not real.
std::optional<int> CountGrowing(const Eigen::MatrixXd& H, const std::vector<GrowingSlip>& growing);

}  // namespace contact_path

#endif  // CONTACT_PATH_STABILITY_SLIP_STABILITY_H_
