// Gap and surface coordinate of a contact candidate with their derivatives.
#ifndef CONTACT_PATH_CONTACT_KINEMATICS_H_
#define CONTACT_PATH_CONTACT_KINEMATICS_H_

#include <Eigen/Core>

namespace contact_path {

// The most unknowns that move one candidate.
inline constexpr int kMostPairDofs = 12;

// By (dofs, s): the unknowns of the pair in their order, then the load factor. No allocation.
using PairVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostPairDofs + 1, 1>;
using PairMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostPairDofs + 1, kMostPairDofs + 1>;

struct Kinematics {
  double gap = 0.0;                      // u_n [length]
  double xi = 0.0;                       // u_t: motion along the surface since a reference [length]
  PairVector gap_gradient, xi_gradient;  // by (dofs, s)
  PairMatrix gap_hessian, xi_hessian;    // by (dofs, s), symmetric; empty where both are zero throughout
};

}  // namespace contact_path

#endif  // CONTACT_PATH_CONTACT_KINEMATICS_H_
