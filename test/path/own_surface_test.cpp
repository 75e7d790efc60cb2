// Parts that touch themselves: the same path as between two surfaces, a slit that closes, ends of paths.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "contact_path/check/residuals.h"
#include "contact_path/verify/verify_path.h"
#include "support/beams.h"
#include "support/parts.h"
#include "support/solid_grid.h"
#include "support/traced_path.h"

namespace contact_path::own_surface_test {
namespace {

// The force of the supports that move, along their motion.
double DrivingForce(const TracedPath& path, const Increment& increment) {
  return ResidualCheck(path.request.scene).DrivingForce(StateOf(increment));
}

// A block of 2 x 2 between a held bottom and a top that sinks by 0.04, with a slit of the width 0.002 in its left half,
// or without.
TraceRequest Block(int cells, bool slit) {
  const int middle = cells;  // in the lattice of half cells
  TraceRequest request;
  Scene& scene = request.scene;
  scene.materials = {ElasticMaterial("rubber", 1.0, 0.3, MaterialModel::kLinear)};
  AddGrid(
      &scene, cells, cells, [](double x, double y) { return Eigen::Vector2d(2.0 * x, 2.0 * y); }, SolidOf("rubber"));
  for (Node& node : scene.nodes) node.fixed_x = node.fixed_y = node.y == 0.0 || node.y == 2.0;
  for (const Node& node : scene.nodes)
    if (node.y == 2.0) scene.support_motions.push_back({node.name, 0.0, -0.04});
  request.options.stop = {{"load_factor", ">", 1.0}};
  if (!slit) return request;

  // Round the corners of both halves, so that no node slides over an end.
  Group upper{"upper", {}};
  BoundarySurface faces{"slit", {"0_" + std::to_string(middle - 2)}};
  for (int i = 0; i <= middle; i += 2) faces.nodes.push_back(std::to_string(i) + "_" + std::to_string(middle));
  for (int i = middle - 2; i >= 0; i -= 2) {
    const std::string lower = std::to_string(i) + "_" + std::to_string(middle), name = "u" + lower;
    const Node of = GridNode(&scene, i, middle);
    scene.nodes.push_back({name, of.x, of.y + 0.002});
    upper.nodes.push_back(name);
    faces.nodes.push_back(name);
    std::vector<std::string>& elements = scene.solids[0].nodes;
    // The upper half of the elements, row by row from below.
    std::replace(elements.begin() + static_cast<std::ptrdiff_t>(elements.size() / 2), elements.end(), lower, name);
  }
  faces.nodes.push_back("0_" + std::to_string(middle + 2));
  scene.groups = {upper};
  scene.surfaces = {faces};
  scene.contacts = {{"", "", "upper", "slit", 1.0}};
  return request;
}

// By load factor, between two increments.
double Stiffness(const TracedPath& path, const Increment& from, const Increment& to) {
  return (DrivingForce(path, to) - DrivingForce(path, from)) / (to.load_factor - from.load_factor);
}

// Open, the slit makes the block softer. Closed and stuck, the block is as stiff as without it, but for a node at
// either end of the slit: next to the tip it has nothing to touch, and at the corner the surface is rounded.
TEST(OwnSurface, ASlitThatIsClosedIsAsStiffAsNone) {
  std::vector<double> errors;
  for (const int cells : {8, 16, 32}) {
    const TracedPath path = TraceProved(Block(cells, true)), whole = TraceProved(Block(cells, false));
    const double expected = Stiffness(whole, whole.increments.front(), whole.increments.back());
    EXPECT_LT(Stiffness(path, path.increments[0], path.increments[1]), 0.8 * expected);
    const auto is_closed = [](const Increment& increment) {
      return std::count_if(increment.contacts.begin(), increment.contacts.end(),
                           [](const ContactRecord& contact) { return contact.state == ContactState::kOpen; }) <= 2;
    };
    const Increment& closed = FirstThat(path, is_closed);
    ASSERT_LT(closed.load_factor, 0.5);
    for (const ContactRecord& contact : path.increments.back().contacts)
      EXPECT_TRUE(contact.state == ContactState::kOpen || contact.state == ContactState::kStick);
    errors.push_back(std::abs(Stiffness(path, closed, path.increments.back()) / expected - 1.0));
  }
  EXPECT_LT(errors[0], 0.08);
  for (std::size_t i = 1; i < errors.size(); ++i) EXPECT_LT(errors[i], 0.35 * errors[i - 1]);
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
  // Steps end where the curves do, and these are other places.
  const auto events_and_ends = [](const TracedPath& of) {
    std::vector<Increment> found;
    for (const Increment& increment : of.increments)
      if (increment.event.number > 0 || increment.index == LastOfStage(of, increment.stage).index)
        found.push_back(increment);
    return found;
  };
  const std::vector<Increment> events = events_and_ends(path), expected = events_and_ends(halves);
  ASSERT_EQ(events.size(), expected.size());
  ASSERT_GT(events.size(), 6u);
  for (std::size_t i = 0; i < events.size(); ++i) {
    EXPECT_NEAR(events[i].load_factor, expected[i].load_factor, 1e-9);
    const Increment &one = events[i], &other = expected[i];
    for (std::size_t k = 0; k < one.positions.size(); ++k) EXPECT_NEAR(one.positions[k], other.positions[k], 1e-8);
    for (std::size_t k = 0; k < one.contacts.size(); ++k) EXPECT_EQ(one.contacts[k].state, other.contacts[k].state);
  }
}

// A thin ring that is pressed at two points is a spring, at first; both of its sides carry the same.
TEST(OwnSurface, ARingIsCrushedAsItsOwnMirrorImage) {
  const TracedPath path = TraceProved(ReadExample("crushed_ring"));
  const Increment& first = path.increments[1];
  const double plunger = 1.0 / 100.0, ring = M_PI / 4.0 - 2.0 / M_PI;  // how far they give way per force
  const double share = (2.0 - PositionY(path, first, "top")) / (2.2 * first.load_factor);
  EXPECT_NEAR(share, ring / (ring + plunger), 0.01);
  // Of the elastica: docs/scenes.md.
  EXPECT_NEAR(LoadsOfKind(path, IncrementKind::kContactEvent).at(0), 0.89821, 0.005);
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

// Of few and long segments, whose curves are prolonged far past the places where the surface is left out.
TEST(OwnSurface, ARingHasTheSameEventsWithOtherSteps) {
  TraceRequest request = ReadExample("crushed_ring");
  Scene& scene = request.scene;
  std::vector<std::string>& nodes = scene.surfaces[0].nodes;
  nodes = {"base"};
  for (const int beam : {0, 1}) {
    scene.beams[static_cast<std::size_t>(beam)].segments = 8;
    for (int i = 1; i < 8; ++i) nodes.push_back((beam == 0 ? "right/" : "left/") + std::to_string(i));
    if (beam == 0) nodes.emplace_back("top");
  }
  scene.groups[0].nodes = nodes;
  scene.surfaces[0].radius = 0.05;
  request.options.accuracy = Accuracy::kFast;
  const TracedPath path = TraceProved(request);
  EXPECT_GT(EventsOf(path).size(), 4u);
  for (const Accuracy accuracy : {Accuracy::kBalanced, Accuracy::kAccurate}) {
    request.options.accuracy = accuracy;
    ExpectSameEvents(path, TraceProved(request), 1e-8);
  }
}

// Two legs of a hairpin, open at the left: the end of the upper leg is pressed onto the lower leg, and drawn along
// it.
TraceRequest Hairpin() {
  Scene scene;
  scene.nodes = {{"low", 0.0, 0.0, true, true}, {"bend", 2.0, 0.0, true, true}, {"up", 2.0, 0.4}, {"tip", 0.0, 0.4}};
  scene.nodes[0].fixed_rotation = scene.nodes[1].fixed_rotation = true;
  scene.beams = {Between("b0", "low", "bend", 100.0, 10.0, 10), Between("b1", "bend", "up", 100.0, 0.05, 6, M_PI),
                 Between("b2", "up", "tip", 100.0, 0.05, 10)};
  BoundarySurface inner{"inner", {"low"}};
  for (const Beam& beam : scene.beams) {
    for (int i = 1; i < beam.segments; ++i) inner.nodes.push_back(beam.name + "/" + std::to_string(i));
    inner.nodes.push_back(beam.nodes[1]);
  }
  inner.radius = 0.02;
  scene.surfaces = {inner};
  scene.contacts = {{"tip", "", "", "inner", 0.2}};
  return RequestOf(scene, {LoadingStage({{"tip", 0.0, -0.05}}), LoadingStage({{"tip", 0.05, 0.0}})});
}

// A foot on two springs is pressed onto the ground and pushed along it. The surface goes on from the end of the ground
// by two soft bars back to the foot: the last patch of the ground, next but one to that of the foot, is left out.
TEST(OwnSurface, EndsWhereANodeComesNextToItself) {
  Scene scene;
  scene.nodes = {{"l", -1.0, 1.0, true, true}, {"r", 1.0, 1.1, true, true}, {"foot", 0.0, 0.0}, {"back", 0.6, 0.6}};
  scene.bars = {{{"l", "foot"}, 10.0}, {{"r", "foot"}, 8.0}};
  BoundarySurface surface{"ground", {}};
  for (int i = 0; i < 6; ++i) {
    const std::string name = "g" + std::to_string(i);
    scene.nodes.push_back({name, -1.0 + 0.4 * i, 0.0, true, true});
    if (i > 0) scene.bars.push_back({{surface.nodes.back(), name}, 1.0});
    surface.nodes.push_back(name);
  }
  for (const char* const name : {"back", "foot"}) {
    scene.bars.push_back({{surface.nodes.back(), name}, 0.1});
    surface.nodes.emplace_back(name);
  }
  scene.surfaces = {surface};
  scene.contacts = {{"foot", "", "", "ground", 0.3}};
  const TracedPath path =
      TraceIncrements(RequestOf(scene, {LoadingStage({{"foot", 0.0, -2.0}}), LoadingStage({{"foot", 14.0, 0.0}})}));
  ExpectEnd(path, EndReason::kPathEnd, "foot@ground is lost");
  EXPECT_NEAR(PositionX(path, path.increments.back(), "foot"), 0.8, 1e-9);  // where the patch of g5 begins
  EXPECT_GT(Contact(path, path.increments.back(), "foot@ground").rn, 0.1);
}

TEST(OwnSurface, BothMethodsFollowAHairpin) {
  TraceRequest request = Hairpin();
  const TracedPath path = TraceProved(request);
  request.options.method = Method::kMpec;
  const TracedPath other = TraceProved(request);
  const Increment &end = path.increments.back(), &end_other = other.increments.back();
  for (std::size_t k = 0; k < end.positions.size(); ++k) EXPECT_NEAR(end.positions[k], end_other.positions[k], 1e-8);
  EXPECT_GT(PositionX(path, end, "tip"), 0.04);
  EXPECT_NEAR(PositionY(path, end, "tip"), 0.02, 1e-4);
}

TEST(OwnSurface, AWrongReactionIsRefuted) {
  TracedPath path = TraceIncrements(ReadExample("crushed_ring"));
  for (ContactRecord& contact : path.increments.back().contacts) contact.rn *= 1.001;
  EXPECT_FALSE(VerifyPath(path.request, path.increments).findings.empty());
}

}  // namespace
}  // namespace contact_path::own_surface_test
