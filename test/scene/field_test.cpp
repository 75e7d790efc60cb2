#include "contact_path/scene/field.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <type_traits>

#include "contact_path/scene/key_path.h"
#include "contact_path/scene/scene.h"

namespace contact_path::field_test {
namespace {

// Calls visit(part) for an object of each kind of part in Part, which comes first.
template <typename Part, typename Visit>
void ForEachPart(Visit visit) {
  visit(Part());
  ForEachField<Part>([&](const auto& field) {
    using Value = typename std::decay_t<decltype(field)>::Value;
    if constexpr (kIsPart<Value>) ForEachPart<Value>(visit);
    if constexpr (kIsPartList<Value>) ForEachPart<typename Value::value_type>(visit);
  });
}

TEST(FieldTest, EveryFieldHasAMemberAndNamesOfItsOwn) {
  int parts = 0;
  ForEachPart<TraceRequest>([&](const auto& part) {
    using Part = std::decay_t<decltype(part)>;
    ++parts;
    std::set<std::string> names;
    std::set<const void*> members;
    std::size_t fields = 0;
    ForEachField<Part>([&](const auto& field) {
      ++fields;
      names.emplace(field.name);
      members.insert(&(part.*field.member));
      EXPECT_FALSE(field.name.empty());
    });
    EXPECT_EQ(names.size(), fields);
    EXPECT_EQ(members.size(), fields);
    // An earlier name must not be the name of another field today.
    ForEachField<Part>(
        [&](const auto& field) { EXPECT_EQ(names.count(std::string(field.formerly)), 0U) << field.formerly; });
  });
  EXPECT_GE(parts, 14);
}

TEST(KeyPathTest, IsWrittenAsMessagesWantIt) {
  const KeyPath request, scene("scene"), bars = scene.Key("bars"), bar = bars[3], nodes = bar.Key("nodes");
  EXPECT_EQ(request.ToString(), "");
  EXPECT_EQ(request.Key("scene").ToString(), "scene");
  EXPECT_EQ(bar.ToString(), "scene.bars[3]");
  EXPECT_EQ(nodes[1].ToString(), "scene.bars[3].nodes[1]");
  EXPECT_EQ(bar.Key("").ToString(), "scene.bars[3].");
}

}  // namespace
}  // namespace contact_path::field_test
