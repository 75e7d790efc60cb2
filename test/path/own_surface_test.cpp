// Parts that touch themselves: the same path as between two surfaces, a slit that closes, ends of paths.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "contact_path/check/residuals.h"
#include "contact_path/scene/expand.h"
#include "contact_path/verify/verify_path.h"
#include "support/solid_grid.h"
#include "support/traced_path.h"

namespace contact_path {
namespace {

const double kPi = std::acos(-1.0);

TracedPath TraceProved(const TraceRequest& request) {
  TracedPath path = TraceIncrements(request);
  EXPECT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
  for (const Finding& finding : VerifyPath(path.request, path.increments).findings)
    ADD_FAILURE() << "increment " << finding.increment << ": " << finding.what;
  path.request = Expand(request).request;
  return path;
}

double SumOfNormals(const Increment& increment) {
  double sum = 0.0;
  for (const ContactRecord& contact : increment.contacts) sum += contact.rn;
  return sum;
}

// The force of the supports that move, along their motion.
double DrivingForce(const TracedPath& path, const Increment& increment) {
  const Scene& scene = path.request.scene;
  return ResidualCheck(scene).DrivingForce(StateOf(increment));
}

// A block of 2 x 2 between a held bottom and a top that sinks by 0.04, with a slit of the width 0.002 in its left half,
// or without.
TraceRequest Block(bool slit) {
  constexpr int kCells = 16, kMiddle = kCells;  // in the lattice of half cells
  TraceRequest request;
  Scene& scene = request.scene;
  scene.materials = {ElasticMaterial("rubber", 1.0, 0.3, MaterialModel::kLinear)};
  Solid solid;
  solid.material = "rubber";
  solid.nodes_per_element = 4;
  AddGrid(
      &scene, kCells, kCells, [](double x, double y) { return Eigen::Vector2d(2.0 * x, 2.0 * y); }, solid);
  for (Node& node : scene.nodes) node.fixed_x = node.fixed_y = node.y == 0.0 || node.y == 2.0;
  for (const Node& node : scene.nodes)
    if (node.y == 2.0) scene.support_motions.push_back({node.name, 0.0, -0.04});
  request.options.stop = {{"load_factor", ">", 1.0}};
  if (!slit) return request;

  Group upper{"upper", {}};
  BoundarySurface faces{"slit", {}};
  for (int i = 0; i <= kMiddle; i += 2) faces.nodes.push_back(std::to_string(i) + "_" + std::to_string(kMiddle));
  for (int i = kMiddle - 2; i >= 0; i -= 2) {
    const std::string lower = faces.nodes[static_cast<std::size_t>(i / 2)], name = "u" + lower;
    const Node of = GridNode(&scene, i, kMiddle);
    scene.nodes.push_back({name, of.x, of.y + 0.002});
    upper.nodes.push_back(name);
    faces.nodes.push_back(name);
    std::vector<std::string>& elements = scene.solids[0].nodes;
    // The upper half of the elements, row by row from below.
    std::replace(elements.begin() + static_cast<std::ptrdiff_t>(elements.size() / 2), elements.end(), lower, name);
  }
  scene.groups = {upper};
  scene.surfaces = {faces};
  scene.contacts = {{"", "", "upper", "slit", 1.0}};
  return request;
}

// Open, the slit makes the block softer; closed and stuck, the block is as stiff as without it.
TEST(OwnSurface, ASlitThatIsClosedIsAsStiffAsNone) {
  const TracedPath path = TraceProved(Block(true)), whole = TraceProved(Block(false));
  const auto stiffness = [&](const TracedPath& of, const Increment& from, const Increment& to) {
    return (DrivingForce(of, to) - DrivingForce(of, from)) / (to.load_factor - from.load_factor);
  };
  const double expected = stiffness(whole, whole.increments.front(), whole.increments.back());
  const auto is_closed = [](const Increment& increment) {
    const auto open = std::count_if(increment.contacts.begin(), increment.contacts.end(),
                                    [](const ContactRecord& contact) { return contact.state == ContactState::kOpen; });
    return open <= 1;  // the node next to the tip has nothing to touch
  };
  const Increment& last = path.increments.back();
  const auto closed = std::find_if(path.increments.begin(), path.increments.end(), is_closed);
  ASSERT_NE(closed, path.increments.end());
  ASSERT_LT(closed->load_factor, 0.8);
  EXPECT_TRUE(is_closed(last));
  EXPECT_LT(stiffness(path, path.increments[0], path.increments[1]), 0.9 * expected);
  EXPECT_NEAR(stiffness(path, *closed, last), expected, 0.01 * expected);
}

// The upper half of the ring against a surface of the lower half alone: the same curve but for its ends.
TEST(OwnSurface, ARingIsAsTwoHalves) {
  TraceRequest request = ReadExample("crushed_ring");
  const TracedPath path = TraceProved(request);
  BoundarySurface& surface = request.scene.surfaces[0];
  const auto count = static_cast<std::ptrdiff_t>(surface.nodes.size());
  // From the left of the base to the right of it.
  std::rotate(surface.nodes.begin(), surface.nodes.begin() + 3 * count / 4 + 1, surface.nodes.end());
  surface.nodes.resize(static_cast<std::size_t>(count / 2 - 1));
  surface.closed = false;
  const TracedPath halves = TraceProved(request);
  ASSERT_EQ(path.increments.size(), halves.increments.size());
  for (std::size_t i = 0; i < path.increments.size(); ++i) {
    const Increment &one = path.increments[i], &other = halves.increments[i];
    ASSERT_NEAR(one.load_factor, other.load_factor, 1e-9);
    for (std::size_t k = 0; k < one.positions.size(); ++k) EXPECT_NEAR(one.positions[k], other.positions[k], 1e-8);
    for (std::size_t k = 0; k < one.contacts.size(); ++k) EXPECT_EQ(one.contacts[k].state, other.contacts[k].state);
  }
}

// A ring that is pressed at two points is a spring, at first; both of its sides carry the same.
TEST(OwnSurface, ARingIsCrushedAsItsOwnMirrorImage) {
  const TracedPath path = TraceProved(ReadExample("crushed_ring"));
  const Increment* touching = nullptr;
  for (const Increment& increment : path.increments) {
    if (increment.stage != 1) break;
    for (const ContactRecord& contact : increment.contacts) EXPECT_NEAR(contact.rt, 0.0, 1e-9);
    if (SumOfNormals(increment) > 0.0) touching = &increment;
  }
  ASSERT_NE(touching, nullptr);
  const std::size_t count = touching->contacts.size();
  for (std::size_t k = 0; k < count; ++k)
    EXPECT_NEAR(touching->contacts[k].rn, touching->contacts[count - 1 - k].rn, 1e-8);
}

TEST(OwnSurface, AWrongReactionIsRefuted) {
  TracedPath path = TraceIncrements(ReadExample("crushed_ring"));
  for (ContactRecord& contact : path.increments.back().contacts) contact.rn *= 1.001;
  EXPECT_FALSE(VerifyPath(path.request, path.increments).findings.empty());
}

}  // namespace
}  // namespace contact_path
