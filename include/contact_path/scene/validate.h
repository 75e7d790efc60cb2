// The rules that a request must keep before anything is computed from it.
#ifndef CONTACT_PATH_SCENE_VALIDATE_H_
#define CONTACT_PATH_SCENE_VALIDATE_H_

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "contact_path/scene/scene.h"

namespace contact_path {

// One broken rule.
struct Violation {
  std::string key;        // where in the request, e.g. "scene.bars[0].EA"
  std::string value;      // what stands there
  std::string rule;       // what must hold
  std::string file = {};  // empty for a request that is not from a file
  int line = 0;           // in the file, from 1; 0 = unknown

  // One line: "FILE:LINE: KEY = VALUE: RULE", without what is not known.
  std::string ToLine() const;
};

// Thrown where a request enters; what() has a line for each violation, of more than kMostLines the first ones
// and their number.
class InvalidRequest : public std::invalid_argument {
 public:
  explicit InvalidRequest(std::vector<Violation> violations);  // at least one
  const std::vector<Violation>& violations() const { return violations_; }

 private:
  std::vector<Violation> violations_;
};

// Nobody reads more, and a large request can break its rules a million times.
constexpr std::size_t kMostViolations = 100;
constexpr std::size_t kMostLines = 20;  // of what is wrong, in a message

// The rules that `request` breaks, in the order of the request, at most about kMostViolations; empty if it is sound.
// Lines and files are left unset.
std::vector<Violation> Validate(const TraceRequest& request);

// Those of the rules that a number breaks by itself.
std::vector<Violation> ValidateNumbers(const TraceRequest& request);

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_VALIDATE_H_
