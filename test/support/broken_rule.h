// Rules of validate.h, each broken by a change of a sound request.
#ifndef CONTACT_PATH_TEST_SUPPORT_BROKEN_RULE_H_
#define CONTACT_PATH_TEST_SUPPORT_BROKEN_RULE_H_

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "contact_path/scene/validate.h"

namespace contact_path {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// What breaks a rule, and the violation that must come out of it, alone.
struct BrokenRule {
  std::string name;
  std::function<void(TraceRequest&)> change;
  std::string key;
  std::string value;
  std::string rule;  // the start of it
};

// The name of a test of a list of cases.
template <typename Case>
std::string NameOf(const testing::TestParamInfo<Case>& test) {
  return test.param.name;
}

// `request`: sound.
inline void ExpectBrokenAlone(const BrokenRule& broken, TraceRequest request) {
  broken.change(request);
  const std::vector<Violation> violations = Validate(request);
  ASSERT_FALSE(violations.empty());
  EXPECT_EQ(violations[0].key, broken.key);
  EXPECT_EQ(violations[0].value, broken.value);
  EXPECT_EQ(violations[0].rule.substr(0, broken.rule.size()), broken.rule);
  EXPECT_EQ(violations[0].file, "");
  EXPECT_EQ(violations[0].line, 0);
  for (std::size_t i = 1; i < violations.size(); ++i) ADD_FAILURE() << "also: " << violations[i].ToLine();
}

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SUPPORT_BROKEN_RULE_H_
