// A step that a method has tried, for the log.
#ifndef CONTACT_PATH_BRANCH_TRIAL_STEP_H_
#define CONTACT_PATH_BRANCH_TRIAL_STEP_H_

#include <functional>
#include <string_view>
#include <utility>
#include <vector>

namespace contact_path {

struct TrialStep {
  double length = 0.0;       // wanted, scaled norm
  std::string_view verdict;  // "accepted", or the first test that the step does not pass
  std::string_view ends_at;  // what ends an accepted step before its wanted length; empty: nothing
  // What the verdict rests on, by name: values next to their bounds.
  std::vector<std::pair<std::string_view, double>> numbers;
};

// A verdict: the work of the loads is not what the strain energy gains and what slides takes.
inline constexpr std::string_view kEnergiesOff = "the energies do not balance";

// Called with each trial; empty: nobody asks, and no trial is described.
using TrialObserver = std::function<void(const TrialStep&)>;

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_TRIAL_STEP_H_
