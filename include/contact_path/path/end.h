// Why a path ends, as data: what is decided in path/. The words are in sentences.h.
#ifndef CONTACT_PATH_PATH_END_H_
#define CONTACT_PATH_PATH_END_H_

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "contact_path/scene/scene.h"
#include "contact_path/scene/words.h"

namespace contact_path {

enum class EndReason {
  kNumericalFailure,  // no trustworthy increment could be computed
  kStopCriterion,     // a stop criterion of the request holds in the last increment, or the last stage is at its target
  kMaxIncrements,     // the wanted number of increments was accepted
  kPathEnd,           // no admissible branch: only a dynamic jump leads further
  kStepTooSmall,      // increments had to be shortened below the smallest allowed
  kCancelled,         // the caller asked for it
  kNoSuchBranch,      // branch_choices wants a branch that does not exist: the request is invalid
  kClosedPath,        // the last increment is an earlier one again: the path repeats from there on
  kMemoryLimit,       // there was not enough memory to go on
  kElementInverted,   // an element of a solid would be turned inside out
  kNotDetermined,     // the sign of a value is not known, since the error of the value is larger
  kAtLimit,    // the machine that loads the structure can go no further on a stable path, as at_limit: stop wants
  kNoLanding,  // a jump was followed for long and came to no equilibrium
};

constexpr auto WordsOf(EndReason) {
  return WordList("numerical_failure", "stop_criterion", "max_increments", "path_end", "step_too_small", "cancelled",
                  "no_such_branch", "closed_path", "memory_limit", "element_inverted", "not_determined", "at_limit",
                  "no_landing");
}

// Whether numbers end the trace, and not the structure or the caller.
bool IsNumerical(EndReason reason);

// Whether the path may have come to where nothing holds a node.
bool IsStuck(EndReason reason);

// Whether the trace came to what the request asks for: to a stop criterion, the end of its program, or the limit at
// which at_limit: stop ends it. Where it asks for none of these: to max_increments.
bool IsReached(EndReason reason, const TraceRequest& request);

// A quantity in units of the scene, or a count.
using Number = std::variant<double, long>;

struct Cause {
  std::string_view sentence;  // of sentences.h
  std::string name = {};      // of the contact, bar, ... that the sentence is about
  Number value = 0.0;
  Number other = 0.0;  // the second number of the sentence: of a sign, the error of value
};

using Causes = std::vector<Cause>;

inline void Append(const Causes& causes, Causes* to) { to->insert(to->end(), causes.begin(), causes.end()); }

struct End {
  EndReason reason = EndReason::kNumericalFailure;
  Causes causes = {};
};

// One line for a person.
std::string EndText(const Causes& causes);

// "a, b"; where there are more than `most`, the first ones "and 7 more" behind this.
std::string Listed(const std::vector<std::string>& parts, std::size_t most = std::string::npos,
                   std::string_view behind = " ");

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_END_H_
