// Why a trace ended, by name.
#ifndef CONTACT_PATH_PATH_END_REASON_H_
#define CONTACT_PATH_PATH_END_REASON_H_

#include <string_view>

namespace contact_path {

enum class EndReason {
  kNumericalFailure,  // no trustworthy increment could be computed
  kStopCriterion,     // a stop criterion of the request holds in the last increment, or the last stage is at its target
  kMaxIncrements,     // the wanted number of increments was accepted
  kPathEnd,           // no admissible branch: only a dynamic jump leads further
  kStepTooSmall,      // increments had to be shortened below the smallest allowed
  kCancelled,         // the caller asked for it
  kNoSuchBranch,      // branch_choices wants a branch that does not exist: the request is invalid
};

// "stop_criterion", "max_increments", "path_end", "step_too_small", "cancelled", "no_such_branch", "numerical_failure".
std::string_view ToString(EndReason reason);

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_END_REASON_H_
