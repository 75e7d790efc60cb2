#include "contact_path/path/branch_options.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace contact_path {

std::string PlaceOf(const BranchChoice& choice) {
  return choice.event > 0 ? "event " + std::to_string(choice.event) : "increment " + std::to_string(choice.increment);
}

BranchOptions BranchOptions::For(const TraceOptions& options, double growth) {
  BranchOptions result;
  const auto accuracy = static_cast<std::size_t>(options.accuracy);  // fast, balanced, accurate
  result.step = std::array{0.05, 0.02, 0.005}[accuracy];
  result.prediction = std::array{1e-2, 1e-3, 1e-4}[accuracy];
  result.smallest_cosine = std::array{0.9, 0.98, 0.998}[accuracy];
  result.step = options.step > 0.0 ? options.step : result.step * growth;
  result.smallest_step = std::min(result.smallest_step, 1e-3 * result.step);
  result.direction = options.Direction();
  result.choices = options.branch_choices;
  result.stability = options.stability == DefaultTrue::kTrue;
  result.at_limit = options.at_limit;
  result.machine_stiffness = options.machine_stiffness;
  result.landing_checks = options.landing_checks;
  result.forward = options.branch_rule == BranchRule::kForward;
  result.inner = options.Records("inner");
  return result;
}

const BranchChoice* BranchOptions::ChoiceAt(int increment, int event) const {
  for (const BranchChoice& choice : choices)
    if (choice.event == 0 && choice.increment == increment) return &choice;
  for (const BranchChoice& choice : choices)
    if (choice.event > 0 && choice.event == event) return &choice;
  return nullptr;
}

bool BranchOptions::HasChoiceAfter(int increment, int event) const {
  return std::any_of(choices.begin(), choices.end(), [&](const BranchChoice& choice) {
    return choice.event > 0 ? choice.event > event : choice.increment > increment;
  });
}

}  // namespace contact_path
