// A vector that serves where any vector will do.
#ifndef CONTACT_PATH_LINEAR_GENERIC_VECTOR_H_
#define CONTACT_PATH_LINEAR_GENERIC_VECTOR_H_

#include <Eigen/Core>

namespace contact_path {

// As the border or the right side of singular equations, which must not be orthogonal to their null vector; beyond
// that, the result does not depend on it. Null vectors of structures are often symmetric or antisymmetric, and
// components that are positive and all different are not orthogonal to these.
inline Eigen::VectorXd GenericVector(Eigen::Index size) { return Eigen::VectorXd::LinSpaced(size, 0.5, 1.0); }

}  // namespace contact_path

#endif  // CONTACT_PATH_LINEAR_GENERIC_VECTOR_H_
