// The increment length of scenes of many degrees of freedom.
#ifndef CONTACT_PATH_PATH_AUTOMATIC_STEP_H_
#define CONTACT_PATH_PATH_AUTOMATIC_STEP_H_

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace contact_path {

// Factor on the length of a preset. Arc length is a sum over all components: where all of them move alike, it grows
// with the root of their number. Beyond a hundred of them a node moves as far in an increment as it does among a
// hundred.
inline double AutomaticStepGrowth(Eigen::Index num_dofs) {
  return std::sqrt(std::max(1.0, static_cast<double>(num_dofs) / 100.0));
}

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_AUTOMATIC_STEP_H_
