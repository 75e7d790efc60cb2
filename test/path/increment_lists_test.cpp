#include "contact_path/path/increment_lists.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <functional>
#include <vector>

#include "contact_path/scene/expand.h"
#include "support/traced_path.h"

namespace contact_path::increment_lists_test {
namespace {

// A quantity of `stop` brings the list that it is of.
TEST(LongLists, AreThoseOfRecordAndOfQuantities) {
  TraceRequest request = ReadExample("snap_hook");
  const auto lists_of = [&] {
    const ExpandedRequest expanded(request);
    return LongLists::Of(expanded.Get(), SceneIndex(expanded.Get().scene));
  };
  LongLists lists = lists_of();
  EXPECT_FALSE(lists.sections || lists.stresses || lists.pressures);
  request.options.record = {"pressures"};
  lists = lists_of();
  EXPECT_TRUE(lists.pressures && !lists.sections && !lists.stresses);
  request.options.stop = {{"arm.3.M", ">", 100.0}};
  lists = lists_of();
  EXPECT_TRUE(lists.pressures && lists.sections && !lists.stresses);
  request.options.record.clear();
  request.options.stop.clear();
  request.options.at = {{"die.width", {0.5}}};
  lists = lists_of();
  EXPECT_TRUE(lists.pressures && !lists.sections && !lists.stresses);
}

// Lists that are shorter or longer than those of the scene are told, with a state and without.
TEST(IncrementLists, Fit) {
  TraceRequest request = ReadExample("snap_hook");
  request.options.record = {"sections", "pressures"};
  request.options.max_increments = 3;
  const TracedPath path = TraceIncrements(request);
  const ExpandedRequest expanded(path.request);
  const IncrementLists lists(expanded.Get(), SceneIndex(expanded.Get().scene));
  const Increment& full = path.increments.back();
  EXPECT_EQ(full.sections.size(), 11U);
  EXPECT_EQ(full.pressures.size(), 1U);
  EXPECT_EQ(full.supports.size(), 1U);
  EXPECT_EQ(full.boundaries.size(), 1U);
  Increment without_state;
  without_state.supports = full.supports;
  without_state.boundaries = full.boundaries;
  const std::vector<std::function<void(Increment&)>> changes = {
      [](Increment& of) { of.supports.pop_back(); },         [](Increment& of) { of.boundaries.emplace_back(); },
      [](Increment& of) { of.sections.emplace_back(); },     [](Increment& of) { of.stresses.emplace_back(); },
      [](Increment& of) { of.pressures.emplace_back(); },    [](Increment& of) { of.widths.emplace_back(); },
      [](Increment& of) { of.positions.emplace_back(0.0); }, [](Increment& of) { of.rotations.emplace_back(0.0); },
      [](Increment& of) { of.contacts.emplace_back(); }};
  for (const Increment& increment : {full, without_state}) {
    EXPECT_TRUE(lists.Fit(increment));
    for (std::size_t i = 0; i < changes.size(); ++i) {
      Increment other = increment;
      changes[i](other);
      EXPECT_FALSE(lists.Fit(other)) << i;
    }
  }
}

}  // namespace
}  // namespace contact_path::increment_lists_test
