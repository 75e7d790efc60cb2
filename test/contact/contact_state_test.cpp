#include "contact_path/contact/contact_state.h"

#include <gtest/gtest.h>

namespace contact_path::contact_state_test {
namespace {

TEST(ContactState, WordsAreThoseOfTheOutput) {
  EXPECT_EQ(ToString(ContactState::kOpen), "open");
  EXPECT_EQ(ToString(ContactState::kStick), "stick");
  EXPECT_EQ(ToString(ContactState::kSlipPlus), "slip+");
  EXPECT_EQ(ToString(ContactState::kSlipMinus), "slip-");
  EXPECT_EQ(ToString(ContactState::kClosed), "closed");
}

}  // namespace
}  // namespace contact_path::contact_state_test
