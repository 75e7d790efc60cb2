// From which size on a system is large.
#ifndef CONTACT_PATH_LINEAR_LARGE_SYSTEM_H_
#define CONTACT_PATH_LINEAR_LARGE_SYSTEM_H_

#include <Eigen/Core>
#include <cstddef>

namespace contact_path {

// Unknowns from which on METIS and dense kernels are worth their overhead: KLU is as fast at 10^3, and takes three
// times as long at 10^4. Below, no solver but Ipopt calls the BLAS, whose kernels depend on the processor: a path by
// method branch has the same bytes with all of them, its stability included.
inline constexpr Eigen::Index kLargeSystem = 3000;

// Factors serve a matrix that differs in so many equations at most: more solutions take as long as a factorisation.
inline constexpr std::size_t kMostChanged = 16;

}  // namespace contact_path

#endif  // CONTACT_PATH_LINEAR_LARGE_SYSTEM_H_
