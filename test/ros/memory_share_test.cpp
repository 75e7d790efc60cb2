#include "contact_path/ros/memory_share.h"

#include <cstddef>
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace contact_path::memory_share_test {
namespace {

constexpr std::size_t kMegabyte = std::size_t{1} << 20U;

TEST(MemoryShareTest, CountsWhatIsAllocated) {
  const double before = DataMegabytes();
  if (before == 0.0) GTEST_SKIP() << "not counted in this build";
  const std::vector<char> data(200 * kMegabyte, 'x');
  EXPECT_NEAR(DataMegabytes() - before, 200.0, 10.0);
}

// In a process of its own: the limit stays.
TEST(MemoryShareDeathTest, RefusesWhatIsBeyondTheLimit) {
  if (DataMegabytes() == 0.0) GTEST_SKIP() << "not counted in this build";
  EXPECT_EXIT(
      {
        const int limit = static_cast<int>(DataMegabytes()) + 300;
        LimitData(limit);
        const WithinLimit within(limit);
        const std::vector<char> admitted(200 * kMegabyte, 'x');
        try {
          const std::vector<char> refused(200 * kMegabyte, 'x');
        } catch (const std::bad_alloc&) {
          std::_Exit(admitted.back() == 'x' ? 0 : 2);
        }
        std::_Exit(1);
      },
      testing::ExitedWithCode(0), "");
}

TEST(MemoryShareDeathTest, AdmitsItToThreadsThatAreNotHeldToTheLimit) {
  if (DataMegabytes() == 0.0) GTEST_SKIP() << "not counted in this build";
  EXPECT_EXIT(
      {
        LimitData(static_cast<int>(DataMegabytes()) + 300);
        const std::vector<char> admitted(400 * kMegabyte, 'x');
        std::_Exit(admitted.back() == 'x' ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

TEST(MemoryShareTest, RefusesALimitThatIsUsedUp) {
  EXPECT_NO_THROW(LimitData(0));
  if (DataMegabytes() == 0.0) GTEST_SKIP() << "not counted in this build";
  EXPECT_THROW(LimitData(1), std::invalid_argument);
}

}  // namespace
}  // namespace contact_path::memory_share_test
