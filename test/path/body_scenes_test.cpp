// The example scenes with rigid bodies and tendons, and arches of rigid blocks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/parts.h"
#include "support/traced_path.h"
#include "support/transformations.h"

namespace contact_path::body_scenes_test {
namespace {

constexpr double kExact = 2e-9;  // contacts of bodies give way by 1e-8 of their forces
TEST(BodyScenes, LimitsInClosedForm) {
  const double rolls = 2.0 * 0.2 / (std::tan(M_PI / 12.0) - 0.2) - 1.0, climbed = (0.5 * 3.0 / 1.15 * 4.9 - 1.5) / 6.0;
  for (const auto& [scene, load, tolerance] :
       {std::tuple("held_disc", 0.4, 5e-9), std::tuple("ladder", climbed, 5e-8), std::tuple("three_discs", rolls, 5e-7),
        std::tuple("masonry_arch", 0.29661, 5e-6)}) {
    SCOPED_TRACE(scene);
    const TracedPath path = TraceTo(ReadExample(scene), EndReason::kAtLimit);
    EXPECT_NEAR(LargestLoadFactor(path), load, tolerance);
  }
}

// Coordinates are rounded everywhere but at this angle: 0.
TEST(BodyScenes, AHeldDiscSlipsAtTheSameLoadWhicheverWayItIsTurned) {
  for (const double degrees : {17.0, 90.0, 230.9, 301.3}) {
    SCOPED_TRACE(degrees);
    const TracedPath path = TraceTo(Rotate(ReadExample("held_disc"), degrees * M_PI / 180.0), EndReason::kAtLimit);
    EXPECT_NEAR(LargestLoadFactor(path), 0.4, 5e-9);
  }
}

TEST(BodyScenes, APulleyLiftsABlock) {
  const TracedPath path = TraceProved(ReadExample("pulley_block"));
  for (const Increment& increment : path.increments) {
    const double s = increment.load_factor, pull = std::clamp(1000.0 * (s - 0.1) / 3.6, 0.0, 5.0);
    for (const SectionForces& section : increment.sections) EXPECT_NEAR(section.N, pull, kExact);
    EXPECT_NEAR(increment.positions[11], 0.25 + std::max(0.0, 0.5 * (s - 0.118)), kExact);
  }
}

// The second eye comes to the disc, and then the third one.
TEST(BodyScenes, ATendonBendsAFinger) {
  const TracedPath path = TraceProved(ReadExample("tendon_finger"));
  for (const Increment& increment : path.increments) EXPECT_EQ(increment.bars[0], BarState::kTaut) << increment.index;
  const auto first_touch = [&](std::size_t contact) {
    return std::find_if(path.increments.begin(), path.increments.end(),
                        [&](const Increment& of) { return of.contacts[contact].state != ContactState::kOpen; });
  };
  EXPECT_LT(first_touch(1), first_touch(2));
  EXPECT_EQ(first_touch(0), path.increments.end());
  const std::vector<ContactRecord>& contacts = path.increments.back().contacts;
  EXPECT_GT(contacts[1].rn, 0.1);
  EXPECT_GT(contacts[2].rn, 1.0);
}

TEST(BodyScenes, ARatchetClicksAndHolds) {
  const TracedPath path = TraceProved(ReadExample("ratchet"));
  EXPECT_EQ(IncrementsOfKind(path, IncrementKind::kJump).size(), 1U);
  // Turned on, less than 1 holds it, and back, more than 8.
  double on = 0.0;
  for (const Increment& increment : path.increments)
    if (increment.stage == 1) on = std::max(on, std::abs(increment.supports.back().rm));
  EXPECT_LT(on, 1.0);
  EXPECT_GT(path.increments.back().supports.back().rm, 8.0);
}

// By virtual work: Q cos a = 2 K d sin a + 4 k (a0 - a), d the compression of the rod.
TEST(BodyScenes, AToggleClampClosesAndOpens) {
  const TracedPath path = TraceProved(ReadExample("toggle_clamp"));
  const auto push = [](double a) {
    const double d = std::max(0.0, 2.0 * std::cos(a) - 1.9);
    return (80.0 * d * std::sin(a) + 0.8 * (0.5 - a)) / std::cos(a);
  };
  double largest = 0.0;
  for (double a = 0.0; a < 0.5; a += 1e-5) largest = std::max(largest, push(a));
  for (const Increment& increment : path.increments) {
    const double x = increment.positions[2], a = std::asin(x);  // of the knee
    if (increment.contacts[1].state != ContactState::kOpen || increment.stage == 2) continue;
    EXPECT_NEAR((increment.stage == 1 ? 1.0 : -1.0) * increment.load_factor, push(a), 1e-7) << increment.index;
  }
  ExpectNear(LoadsOfKind(path, IncrementKind::kSmoothLimit), {largest}, 1e-7);
  const std::vector<Increment> corners = IncrementsOfKind(path, IncrementKind::kCornerLimit);
  ASSERT_EQ(corners.size(), 1U);
  EXPECT_NEAR(corners[0].load_factor, -push(-std::asin(0.1)), 1e-7);
  EXPECT_NEAR(corners[0].contacts[0].rn, 40.0 * (2.0 * std::sqrt(0.99) - 1.9), 3e-7);
  EXPECT_EQ(IncrementsOfKind(path, IncrementKind::kJump).size(), 2U);
}

// Friction 0.8 - s: that which balance needs where the feet are, from where the right one slides.
TEST(BodyScenes, AStepLadderSlidesApart) {
  const TracedPath path = TraceProved(ReadExample("step_ladder"));
  EXPECT_NEAR(LargestLoadFactor(path), 0.8 - 0.66 / 0.76 / 3.0, 5e-9);
  int slides = 0;
  for (const Increment& increment : path.increments) {
    if (!Slips(increment.contacts[1].state)) continue;
    ++slides;
    const double b = 0.5 * (increment.positions[4] - increment.positions[0]);
    EXPECT_NEAR(increment.load_factor, 0.8 - 0.66 / 0.76 * b / std::sqrt(2.5 - b * b), 5e-9) << increment.index;
  }
  EXPECT_GT(slides, 10);
}

// Blocks between joints at equal angles on a semicircle of the radius 1, each of which stands on the face of the one
// before; their weights push aside, too. Limits without sliding are those of a linear program over the forces on the
// corners.
TraceRequest Arch(int blocks, double thickness) {
  Scene scene;
  scene.name = "arch";
  const auto joint = [&](int i, double r) {
    const double angle = M_PI - M_PI * i / blocks;
    return Eigen::Vector2d(r * std::cos(angle), r * std::sin(angle));
  };
  const double inner = 1.0 - 0.5 * thickness, outer = 1.0 + 0.5 * thickness;
  for (int i = 0; i < blocks; ++i) {
    const std::string name = "block" + std::to_string(i), face = "face" + std::to_string(i);
    const std::vector<Eigen::Vector2d> corners = {joint(i, inner), joint(i, outer), joint(i + 1, outer),
                                                  joint(i + 1, inner)};
    double area = 0.0;
    Eigen::Vector2d centre = Eigen::Vector2d::Zero();
    for (std::size_t k = 0; k < 4; ++k) {
      const Eigen::Vector2d &a = corners[k], &b = corners[(k + 1) % 4];
      const double cross = a.x() * b.y() - a.y() * b.x();
      area += 0.5 * cross;
      centre += cross / 6.0 * (a + b);
    }
    centre /= area;
    scene.bodies.push_back({name, centre.x(), centre.y()});
    const Eigen::Vector2d along = joint(i, 1.0);
    Obstacle before{face, ObstacleShape::kHalfPlane, along.x(), along.y(), along.y(), -along.x(), 0.8};
    if (i > 0) before.body = "block" + std::to_string(i - 1);
    scene.obstacles.push_back(before);
    for (std::size_t k = 0; k < (i + 1 == blocks ? 4U : 2U); ++k) {
      const std::string node = name + "_" + std::to_string(k);
      scene.nodes.push_back(NodeOf(name, node, corners[k].x(), corners[k].y()));
      scene.contacts.push_back({node, k < 2 ? face : "ground"});
    }
    for (const bool weight : {true, false}) {
      scene.loads.push_back(LoadOnBody(name, 0.0, 0.0, weight));
      (weight ? scene.loads.back().by : scene.loads.back().bx) = weight ? -std::abs(area) : std::abs(area);
    }
  }
  scene.obstacles.push_back({"ground", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.8});
  return RequestUpToALimit(scene);
}

TEST(BodyScenes, ArchesOfBlocksAreThoseOfLinearPrograms) {
  for (const auto& [blocks, thickness, load] : {std::tuple(4, 0.3, 0.55181), std::tuple(8, 0.2, 0.29661),
                                                std::tuple(12, 0.15, 0.15733), std::tuple(12, 0.12, 0.06186)}) {
    SCOPED_TRACE(testing::Message() << blocks << " blocks, " << thickness);
    const TracedPath path = TraceTo(Arch(blocks, thickness), EndReason::kAtLimit);
    EXPECT_NEAR(LargestLoadFactor(path), load, 1e-5);
  }
}

}  // namespace
}  // namespace contact_path::body_scenes_test
