#include "contact_path/branch/redundant_contacts.h"

#include <gtest/gtest.h>

#include <vector>

#include "contact_path/path/model.h"

namespace contact_path::redundant_contacts_test {
namespace {

constexpr ContactState kOpen = ContactState::kOpen, kClosed = ContactState::kClosed, kStick = ContactState::kStick;
constexpr ContactState kSlipPlus = ContactState::kSlipPlus, kSlipMinus = ContactState::kSlipMinus;

Obstacle Wall(const char* name, double nx, double ny, double friction) {
  Obstacle wall;
  wall.name = name;
  wall.nx = nx;
  wall.ny = ny;
  wall.friction = friction;
  return wall;
}

// A node at the origin that these walls touch.
bool Redundant(const std::vector<Obstacle>& walls, const std::vector<ContactState>& states, bool fixed_x = false) {
  Scene scene;
  scene.nodes = {{"a", 0.0, 1.0, true, true}, {"b", 0.0, 0.0, fixed_x, false}};
  scene.bars = {{{"a", "b"}, 1.0}};
  scene.loads = {{"b", 0.0, -1.0}};
  scene.obstacles = walls;
  for (const Obstacle& wall : walls) scene.contacts.push_back({"b", wall.name});
  const Model model(scene, Scaling());
  return RedundantContacts(model.contacts, model.InitialPoint(), 1e-10).Among(states);
}

TEST(RedundantContacts, WallsThatFaceEachOther) {
  const std::vector<Obstacle> guide = {Wall("l", 1.0, 0.0, 0.3), Wall("r", -1.0, 0.0, 0.0)};
  EXPECT_TRUE(Redundant(guide, {kStick, kClosed}));
  EXPECT_TRUE(Redundant(guide, {kSlipPlus, kClosed}));
  EXPECT_FALSE(Redundant(guide, {kStick, kOpen}));
  EXPECT_FALSE(Redundant(guide, {kSlipMinus, kOpen}));
  EXPECT_FALSE(Redundant(guide, {kOpen, kClosed}));
  EXPECT_FALSE(Redundant(guide, {kOpen, kOpen}));
}

TEST(RedundantContacts, WallsAtAnAngle) {
  const std::vector<Obstacle> corner = {Wall("l", 1.0, 1.0, 0.3), Wall("r", -1.0, 1.0, 0.3)};
  EXPECT_FALSE(Redundant(corner, {kSlipPlus, kSlipMinus}));
  EXPECT_FALSE(Redundant(corner, {kSlipPlus, kSlipPlus}));
  EXPECT_TRUE(Redundant(corner, {kStick, kSlipMinus}));
  EXPECT_TRUE(Redundant(corner, {kStick, kStick}));
}

// Slipping forth on one wall and back on the other, the node feels forces along one line.
TEST(RedundantContacts, EdgesOfTwoConesInOneLine) {
  const std::vector<Obstacle> corner = {Wall("l", 1.0, 1.0, 1.0), Wall("r", -1.0, 1.0, 1.0)};
  EXPECT_TRUE(Redundant(corner, {kSlipPlus, kSlipMinus}));
  EXPECT_FALSE(Redundant(corner, {kSlipPlus, kSlipPlus}));
}

TEST(RedundantContacts, ThreeWalls) {
  const std::vector<Obstacle> walls = {Wall("l", 1.0, 1.0, 0.0), Wall("r", -1.0, 1.0, 0.0), Wall("f", 0.0, 1.0, 0.0)};
  EXPECT_TRUE(Redundant(walls, {kClosed, kClosed, kClosed}));
  EXPECT_FALSE(Redundant(walls, {kOpen, kClosed, kClosed}));
}

TEST(RedundantContacts, OneWallAtANodeThatMovesInOneDirection) {
  const std::vector<Obstacle> slope = {Wall("f", 1.0, 1.0, 0.3)};
  EXPECT_TRUE(Redundant(slope, {kStick}, true));
  EXPECT_FALSE(Redundant(slope, {kSlipPlus}, true));
  EXPECT_FALSE(Redundant(slope, {kStick}));
  // Where the edge of the cone points across the direction in which the node can move, no reaction acts on it.
  const std::vector<Obstacle> steep = {Wall("f", 1.0, 1.0, 1.0)};
  EXPECT_NE(Redundant(steep, {kSlipPlus}, true), Redundant(steep, {kSlipMinus}, true));
}

}  // namespace
}  // namespace contact_path::redundant_contacts_test
