// The search for candidates in reach.
#ifndef CONTACT_PATH_CONTACT_REACH_TRACKER_H_
#define CONTACT_PATH_CONTACT_REACH_TRACKER_H_

#include <Eigen/Core>
#include <cstddef>
#include <utility>
#include <vector>

#include "contact_path/contact/contact_pair.h"

namespace contact_path {

// No gap changes by more than its largest rate times the distance moved. So a gap is looked at again only when (u, s)
// may have moved far enough for it to come into reach: along a path, a candidate far away is looked at a few times.
class ReachTracker {
 public:
  // contacts: must outlive the tracker.
  explicit ReachTracker(const ContactPairs& contacts);

  // The candidates with u_n <= reach times their largest rate at (u, s), ascending. u: the dofs, and maybe more
  // entries, which then count as motion, too; of another size than in the last call, all gaps are looked at.
  std::vector<std::size_t> InReach(const Eigen::Ref<const Eigen::VectorXd>& u, double s, double reach);

 private:
  using Look = std::pair<double, std::size_t>;  // at which distance moved, which candidate

  void LookAtAll();

  const ContactPairs& contacts_;
  std::vector<Look> looks_;  // a heap: the next one first
  bool sound_ = false;       // looks_ is; not after a call that an exception ended
  Eigen::VectorXd u_;        // of the last call; empty before
  double s_ = 0.0;
  double moved_ = 0.0;  // sum of the distances between calls
};

}  // namespace contact_path

#endif  // CONTACT_PATH_CONTACT_REACH_TRACKER_H_
