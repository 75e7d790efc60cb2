// Collects what is found wrong with increments.
#ifndef CONTACT_PATH_SRC_VERIFY_FINDINGS_H_
#define CONTACT_PATH_SRC_VERIFY_FINDINGS_H_

#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

#include "contact_path/verify/verify_path.h"

namespace contact_path {

class Findings {
 public:
  // Appends to *list, up to kMostFindings.
  explicit Findings(std::vector<Finding>* list) : list_(*list) {}

  // The increment that the next findings are of.
  void SetIncrement(std::size_t increment) { increment_ = increment; }

  template <typename... Parts>
  void Report(const Parts&... parts) {
    if (list_.size() >= static_cast<std::size_t>(kMostFindings)) return;
    std::ostringstream text;
    text.precision(6);
    (text << ... << parts);
    list_.push_back({static_cast<int>(increment_), text.str()});
  }

  // Of a value that should be zero, or less.
  void Bound(const std::string& what, double value, double tolerance) {
    if (!(value <= tolerance)) Report(what, ": ", value, " > ", tolerance);
  }

 private:
  std::vector<Finding>& list_;
  std::size_t increment_ = 0;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_VERIFY_FINDINGS_H_
