// Rules of validate.h, each broken by a change of a sound request.
#ifndef CONTACT_PATH_TEST_SUPPORT_BROKEN_RULE_H_
#define CONTACT_PATH_TEST_SUPPORT_BROKEN_RULE_H_

#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "contact_path/scene/request_field.h"
#include "contact_path/scene/validate.h"

namespace contact_path {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// What breaks a rule, and the violation that must come out of it, alone. rule: the start of it.
struct BrokenRule {
  BrokenRule(std::function<void(TraceRequest&)> by, std::string at, std::string what, std::string start)
      : change(std::move(by)), key(std::move(at)), value(std::move(what)), rule(std::move(start)) {}
  // By the value of the field itself.
  BrokenRule(const std::string& at, const std::string& what, const std::string& start)
      : BrokenRule([=](TraceRequest& request) { SetField(PathOf(at), what == "\"\"" ? "" : what, &request); }, at, what,
                   start) {}

  std::function<void(TraceRequest&)> change;
  std::string key;
  std::string value;
  std::string rule;

 private:
  // "bars.0.EA" of the key "scene.bars[0].EA".
  static std::string PathOf(const std::string& key) {
    std::string path;
    for (const char c : key.substr(key.rfind("scene.", 0) == 0 ? 6 : 0))
      if (c != ']') path += c == '[' ? '.' : c;
    return path;
  }
};

// `request`: sound.
inline void ExpectBrokenAlone(const BrokenRule& broken, TraceRequest request) {
  SCOPED_TRACE(broken.key + " = " + broken.value);
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
