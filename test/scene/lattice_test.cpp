#include "contact_path/scene/lattice.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "support/traced_path.h"

namespace contact_path::lattice_test {
namespace {

LatticeOptions Options(LatticeKind kind, int columns, int rows) {
  LatticeOptions options;
  options.kind = kind;
  options.columns = columns;
  options.rows = rows;
  return options;
}

TEST(Lattice, HasAllSidesAndDiagonalsOfItsCells) {
  const Scene scene = LatticeRequest(Options(LatticeKind::kColumn, 4, 3)).scene;
  EXPECT_EQ(scene.nodes.size(), 20U);
  EXPECT_EQ(scene.bars.size(), 4U * 4U + 5U * 3U + 2U * 12U);  // along, across, diagonals
  EXPECT_EQ(scene.contacts.size(), 5U);
}

TEST(Lattice, CandidatesAreSpreadOverTheEdge) {
  LatticeOptions options = Options(LatticeKind::kColumn, 10, 2);
  options.contacts = 3;
  const Scene scene = LatticeRequest(options).scene;
  ASSERT_EQ(scene.contacts.size(), 3U);
  EXPECT_EQ(scene.contacts[0].node, "n0_0");
  EXPECT_EQ(scene.contacts[1].node, "n5_0");
  EXPECT_EQ(scene.contacts[2].node, "n10_0");
}

TEST(Lattice, FarCandidatesChangeNothing) {
  for (const LatticeKind kind : {LatticeKind::kColumn, LatticeKind::kArch, LatticeKind::kWall, LatticeKind::kBlock}) {
    LatticeOptions options = Options(kind, 10, 1);
    options.contacts = 2;
    TraceRequest request = LatticeRequest(options);
    request.options.max_increments = 30;
    const TracedPath without = TraceIncrements(request);
    options.far_candidates = 40;
    request.scene = LatticeRequest(options).scene;
    const TracedPath with = TraceIncrements(request);
    ASSERT_EQ(with.increments.size(), without.increments.size());
    ASSERT_GT(with.increments.size(), 5U) << without.result.message;
    for (std::size_t i = 0; i < with.increments.size(); ++i) {
      EXPECT_EQ(with.increments[i].load_factor, without.increments[i].load_factor);
      EXPECT_EQ(with.increments[i].positions, without.increments[i].positions);
    }
    ExpectSoundIncrements(with, 1e-9);
  }
}

TEST(Lattice, RefusesOptionsOutOfRange) {
  EXPECT_THROW(LatticeRequest(Options(LatticeKind::kWall, 1, 3)), std::invalid_argument);
  EXPECT_THROW(LatticeRequest(Options(LatticeKind::kWall, 3, 0)), std::invalid_argument);
  LatticeOptions options = Options(LatticeKind::kWall, 3, 3);
  options.contacts = 4;
  EXPECT_THROW(LatticeRequest(options), std::invalid_argument);
  options.contacts = -1;
  EXPECT_THROW(LatticeRequest(options), std::invalid_argument);
  options = Options(LatticeKind::kWall, 3, 3);
  options.friction = -0.1;
  EXPECT_THROW(LatticeRequest(options), std::invalid_argument);
  options = Options(LatticeKind::kWall, 3, 3);
  options.far_candidates = -1;
  EXPECT_THROW(LatticeRequest(options), std::invalid_argument);
}

TEST(Lattice, KnowsItsKinds) {
  EXPECT_EQ(ParseLatticeKind("column"), LatticeKind::kColumn);
  EXPECT_EQ(ParseLatticeKind("arch"), LatticeKind::kArch);
  EXPECT_EQ(ParseLatticeKind("wall"), LatticeKind::kWall);
  EXPECT_EQ(ParseLatticeKind("block"), LatticeKind::kBlock);
  EXPECT_FALSE(ParseLatticeKind("tower"));
}

}  // namespace
}  // namespace contact_path::lattice_test
