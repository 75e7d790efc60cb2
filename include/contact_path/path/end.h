// Why a path ends, as data: what is decided in path/. The words are in sentences.h.
#ifndef CONTACT_PATH_PATH_END_H_
#define CONTACT_PATH_PATH_END_H_

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "contact_path/path/end_reason.h"

namespace contact_path {

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

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_END_H_
