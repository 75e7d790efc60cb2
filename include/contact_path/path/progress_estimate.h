// How much of a trace is done.
#ifndef CONTACT_PATH_PATH_PROGRESS_ESTIMATE_H_
#define CONTACT_PATH_PATH_PROGRESS_ESTIMATE_H_

#include <vector>

#include "contact_path/path/increment.h"
#include "contact_path/path/stop.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

class ProgressEstimate {
 public:
  explicit ProgressEstimate(const TraceRequest& request);  // sound (scene/validate.h)

  // Whether the request names an end: a stop criterion, a number of increments, or a program.
  bool HasEnd() const { return max_increments_ > 0 || !goals_.empty() || !targets_.empty(); }

  // Takes every increment, from increment 0 on. Part of the way done, 0 to 1: the largest over the stop criteria, from
  // their value at increment 0, the wanted number of increments, and the stages; 0 without an end. May fall: paths
  // turn.
  double Add(const Increment& increment);

 private:
  // A stop criterion as the way from where the path started to where it would end.
  struct Goal {
    Quantity quantity;
    double start = 0.0;
    double end = 0.0;
  };

  std::vector<double> targets_;  // of the stages
  int max_increments_;           // as in the request: 0 = not asked for
  std::vector<Goal> goals_;
  TraceRequest request_;  // empty where no goal is of an obstacle
};

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_PROGRESS_ESTIMATE_H_
