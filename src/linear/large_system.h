// From which size on systems of equations are large.
#ifndef CONTACT_PATH_SRC_LINEAR_LARGE_SYSTEM_H_
#define CONTACT_PATH_SRC_LINEAR_LARGE_SYSTEM_H_

#include <Eigen/Core>

namespace contact_path {

// Unknowns from which on dense kernels and the ordering of METIS are worth their overhead: bench/README.md.
inline constexpr Eigen::Index kLargeSystem = 3000;

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_LINEAR_LARGE_SYSTEM_H_
