#include "cli/progress.h"

#include <gtest/gtest.h>

#include <sstream>

namespace contact_path::event_table_test {
namespace {

TEST(EventTable, NamesWhatChangesAndHasNoNumbersOfRounding) {
  TraceRequest request;
  request.scene.contacts = {{"b", "floor"}, {"c", "floor"}};
  request.scene.bars.resize(4);
  for (const std::size_t i : {1U, 3U}) request.scene.bars[i].sense = BarSense::kTension;
  request.scene.bars[3].name = "rope";
  Increment increment;
  increment.index = 7;
  increment.kind = IncrementKind::kContactEvent;
  increment.load_factor = 1.979807808e-33;
  increment.event.number = 2;
  increment.event.taken = 1;
  increment.contacts.resize(2);
  increment.contacts[0].state = ContactState::kStick;
  increment.bars = {BarState::kTaut, BarState::kSlack};
  increment.event.branches = {
      {{ContactState::kStick, ContactState::kOpen},
       -4.452e-16,
       -4.452e-16,
       8.638e-17,
       1.49e-8,
       {BarState::kTaut, BarState::kSlack}},
      {{ContactState::kSlipPlus, ContactState::kOpen},
       4.958e-6,
       4.958e-6,
       3.807e-7,
       0.25,
       {BarState::kTaut, BarState::kTaut}},
      {{ContactState::kSlipMinus, ContactState::kStick}, 0.5, 0.5, 0.0, 0.0, {BarState::kSlack, BarState::kTaut}}};
  std::ostringstream out;
  PrintBranches(request, increment, 1.0, out);
  EXPECT_EQ(out.str(),
            "event 2, increment 7, contact_event at load factor 0\n"
            "* branch 1: dissipation rate 0, load rate 0, turn 0; 4 unchanged\n"
            "  branch 2: dissipation rate 3.807e-07, load rate 4.958e-06, turn 0.25; b@floor stick -> slip+, rope "
            "slack -> taut; 2 unchanged\n"
            "  branch 3: dissipation rate 0, load rate 0.5, turn 0; b@floor stick -> slip-, c@floor open -> stick, "
            "bar2 taut -> slack, rope slack -> taut\n");
}

}  // namespace
}  // namespace contact_path::event_table_test
