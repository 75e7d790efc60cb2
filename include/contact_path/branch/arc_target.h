// Functions of the unknowns at whose values steps end.
#ifndef CONTACT_PATH_BRANCH_ARC_TARGET_H_
#define CONTACT_PATH_BRANCH_ARC_TARGET_H_

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace contact_path {

struct ArcTarget {
  std::function<double(const Eigen::VectorXd& x)> of;  // scaled
  std::vector<double> values;                          // finite; a step ends where `of` first comes to one of them
  double rounding = 0.0;                               // error of `of`: differences up to this are none, > 0
  double sense = 0.0;         // 1: only where `of` rises through a value, -1: only where it falls; 0: both
  Eigen::Index unknown = -1;  // which unknown `of` is; -1: none
  int criterion = -1;         // of options.stop, which ends the path at the value; -1: none does
};

using ArcTargets = std::vector<ArcTarget>;

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_ARC_TARGET_H_
