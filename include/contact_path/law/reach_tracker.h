// The search for laws in reach.
#ifndef CONTACT_PATH_LAW_REACH_TRACKER_H_
#define CONTACT_PATH_LAW_REACH_TRACKER_H_

#include <Eigen/Core>
#include <cstddef>
#include <utility>
#include <vector>

#include "contact_path/law/laws.h"

namespace contact_path {

// No Law::Reach() changes by more than its largest rate times the distance moved. So a law is looked at again only when
// (u, s) may have moved far enough for it to come into reach: along a path, a law far away is looked at a few times.
class ReachTracker {
 public:
  // laws: must outlive the tracker.
  explicit ReachTracker(const Laws& laws) : laws_(laws) {}

  // The laws with Reach() <= reach times their largest rate at (u, s), ascending. u: the dofs, and maybe more entries,
  // which then count as motion, too; of another size than in the last call, all laws are looked at.
  std::vector<std::size_t> InReach(const Eigen::Ref<const Eigen::VectorXd>& u, double s, double reach);

 private:
  using Look = std::pair<double, std::size_t>;  // at which distance moved, which law

  const Laws& laws_;
  std::vector<Look> looks_;  // a heap: the next one first
  Eigen::VectorXd u_;        // of the last call; empty before
  double s_ = 0.0;
  double moved_ = 0.0;  // sum of the distances between calls
};

}  // namespace contact_path

#endif  // CONTACT_PATH_LAW_REACH_TRACKER_H_
