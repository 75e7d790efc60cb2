#include "contact_path/scene/scene_index.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <optional>

#include "contact_path/scene/expand.h"
#include "support/traced_path.h"

namespace contact_path::element_names_test {
namespace {

TEST(ElementNames, OfElementsAreFound) {
  TraceRequest request = ReadExample("cantilever_block");
  const ExpandedRequest expanded(request);
  const ElementNames names(expanded.Get().scene);
  EXPECT_GT(names.NumElements(), 0U);
  for (std::size_t i = 0; i < names.NumElements(); ++i) EXPECT_EQ(names.FindElement(names.ElementName(i)), i);
  EXPECT_EQ(names.FindElement("nothing.1"), std::nullopt);
  EXPECT_EQ(names.FindElement(names.ElementName(0) + "1000"), std::nullopt);
}

TEST(ElementNames, OfSections) {
  Scene scene;
  scene.bars.resize(3);
  Beam first, second;
  second.name = "leg";
  first.nodes = {"a", "b", "c"};
  second.nodes = {"a", "b"};
  scene.beams = {first, second};
  const ElementNames sections(scene);
  EXPECT_EQ(sections.NumSections(), 6U);
  EXPECT_EQ(sections.FindSection("bar3"), 2U);
  EXPECT_EQ(sections.FindSection("beam1.2"), 4U);
  EXPECT_EQ(sections.FindSection("leg.1"), 5U);
  for (const char* const none : {"bar0", "bar4", "bar03", "bar", "leg.2", "leg.0", "leg", "leg.", "leg.x", ".1"})
    EXPECT_EQ(sections.FindSection(none), std::nullopt) << none;
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(sections.FindSection(sections.SectionName(i)), i);
}

// Names that no column can have, and names that are taken, give way to places.
TEST(ElementNames, OfSolidsWithoutAFitName) {
  Scene scene;
  scene.solids.resize(4);
  scene.solids[0].name = "block";
  scene.solids[2].name = "block";
  scene.solids[3].name = "a b";
  for (Solid& solid : scene.solids) {
    solid.nodes_per_element = 4;
    solid.nodes.resize(8);
  }
  const ElementNames names(scene);
  ASSERT_EQ(names.NumElements(), 8U);
  EXPECT_EQ(names.ElementName(0), "block.1");
  EXPECT_EQ(names.ElementName(3), "solid2.2");
  EXPECT_EQ(names.ElementName(4), "solid3.1");
  EXPECT_EQ(names.ElementName(7), "solid4.2");
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(names.FindElement(names.ElementName(i)), i);
}

}  // namespace
}  // namespace contact_path::element_names_test
