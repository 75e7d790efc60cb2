// What the tests of the verification share: paths, what was found in them, and increments that may be changed.
#ifndef CONTACT_PATH_TEST_VERIFY_VERIFIED_H_
#define CONTACT_PATH_TEST_VERIFY_VERIFIED_H_

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "contact_path/scene/read_scene.h"
#include "contact_path/verify/verify_path.h"
#include "support/traced_path.h"

namespace contact_path {

// The request in test/data/<name>.yaml.
inline TraceRequest ReadData(const std::string& name) {
  return ReadTraceRequestFile(std::string(CONTACT_PATH_TEST_DATA) + "/" + name + ".yaml");
}

inline TracedPath Traced(const std::string& scene, Method method) {
  TraceRequest request = ReadExample(scene);
  request.options.method = method;
  if (method == Method::kMpec) request.options.step = 0.05;
  return TraceIncrements(request);
}

// A path with slip both ways, corners and contact events.
inline const TracedPath& Genuine() {
  static const TracedPath path = Traced("two_dof_friction", Method::kBranch);
  return path;
}

inline std::string Listed(const Verification& verification) {
  std::string text;
  for (const Finding& finding : verification.findings)
    text += "increment " + std::to_string(finding.increment) + ": " + finding.what + '\n';
  return text;
}

inline std::size_t First(const std::vector<Increment>& increments, const std::function<bool(const Increment&)>& is) {
  for (std::size_t i = 1; i + 2 < increments.size(); ++i)
    if (is(increments[i])) return i;
  ADD_FAILURE() << "no such increment";
  return 1;
}

inline std::size_t FirstSlipping(const std::vector<Increment>& increments) {
  return First(increments, [](const Increment& increment) {
    return increment.kind == IncrementKind::kRegular && increment.contacts[0].state == ContactState::kSlipPlus;
  });
}

inline std::size_t FirstRegular(const std::vector<Increment>& increments) {
  return First(increments, [](const Increment& increment) { return increment.kind == IncrementKind::kRegular; });
}

inline std::size_t FirstCorner(const std::vector<Increment>& increments) {
  return First(increments, [](const Increment& increment) { return increment.kind == IncrementKind::kCornerLimit; });
}

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_VERIFY_VERIFIED_H_
