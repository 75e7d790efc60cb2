// A fuzz target takes any bytes, and throws where the program breaks a promise.
//
// Each is built twice: by clang as a libFuzzer program (CONTACT_PATH_FUZZ), which looks for bytes that make it throw,
// crash, hang or grow, and with replay_test.cpp by any compiler as a test over test/fuzz/corpus/<target>/: seeds, and
// what was once found.
#ifndef CONTACT_PATH_TEST_FUZZ_TARGET_H_
#define CONTACT_PATH_TEST_FUZZ_TARGET_H_

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "contact_path/scene/validate.h"

// The name that libFuzzer calls.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace contact_path {

inline void Require(bool holds, const char* promise) {
  if (!holds) throw std::logic_error(promise);
}

// A message is one line of printable text, and not endless, whatever the request says.
inline void RequireLine(const std::string& text) {
  constexpr std::size_t kLongest = 2000;
  Require(!text.empty() && text.size() <= kLongest, "a message is not empty and not endless");
  const bool control = std::any_of(text.begin(), text.end(), [](char c) {
    const auto code = static_cast<unsigned char>(c);
    return code < 0x20 || code == 0x7f;
  });
  Require(!control, "a message has no control characters");
}

inline void RequireLines(const std::vector<Violation>& violations) {
  for (const Violation& violation : violations) RequireLine(violation.ToLine());
}

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_FUZZ_TARGET_H_
