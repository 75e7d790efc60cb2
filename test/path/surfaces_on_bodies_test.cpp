// Surfaces that contacts touch, some of whose nodes move with bodies.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <string>

#include "support/beams.h"
#include "support/parts.h"
#include "support/solid_grid.h"
#include "support/traced_path.h"
#include "support/transformations.h"

namespace contact_path::surfaces_on_bodies_test {
namespace {

// The upper side of beams between nodes of one body, which turns about a pin with the rotational spring k, 2 a below.
// A node that is guided along y presses on it at 2.5 a.
TraceRequest Lever(double a, double k, double friction) {
  Scene scene;
  scene.name = "lever";
  scene.bodies = {{"ground", 0.0, 0.0, true, true, true}, {"lever", a, 0.0}};
  scene.nodes = {
      NodeOf("ground", "below", 0.0, 0.0), NodeOf("lever", "hub", 0.0, 0.0), {"guided", 2.5 * a, 2.0 * a, true, false}};
  BoundarySurface top{"top", {}};
  for (int i = 0; i < 4; ++i) {
    const std::string name = "n" + std::to_string(i);
    scene.nodes.push_back(NodeOf("lever", name, i * a, 2.0 * a));
    if (i > 0) scene.beams.push_back(Between("beam" + std::to_string(i), top.nodes.back(), name, k / a, k * a, 1));
    top.nodes.push_back(name);
  }
  scene.surfaces = {top};
  scene.pins = {{{"below", "hub"}, k, 0.0, "hinge"}};
  scene.superelements = {{{"guided"}, {k / (a * a), 0.0, 0.0, 0.1 * k / (a * a)}}};
  scene.contacts = {{"guided", "", "", "top", friction}};
  scene.loads = {{"guided", 0.0, -k / a}};
  return RequestUntil({"lever.rotation", "<", -0.5}, scene);
}

// With p the turn and d = (2.5 a - h sin p) / cos p the place on the lever, h = 2 a above the pin: N (d - mu h) = k p,
// as the node slides towards the pin.
TEST(SurfacesOnBodies, ALeverIsTurnedThroughItsSurface) {
  for (const double a : {0.02, 1.0, 50.0})
    for (const double k : {1e-3, 1.0, 1e4})
      for (const double friction : {0.0, 0.4}) {
        SCOPED_TRACE(testing::Message() << a << ' ' << k << ' ' << friction);
        const TracedPath path = TraceProved(Lever(a, k, friction));
        const double h = 2.0 * a;
        for (std::size_t i = 1; i < path.increments.size(); ++i) {
          const double p = -std::asin(PositionY(path, path.increments[i], "lever") / a);
          const double d = (2.5 * a - h * std::sin(p)) / std::cos(p), N = k * p / (d - friction * h);
          const double down = h - h * std::cos(p) + d * std::sin(p);
          EXPECT_NEAR(path.increments[i].load_factor * k / a,
                      N * (std::cos(p) - friction * std::sin(p)) + 0.1 * k / (a * a) * down, 1e-12 * k / a);
        }
      }
}

// A soft pad with its upper side held, and a surface round its three other sides, on which a node on springs is
// pressed. body: holds it, "" for nodes that are fixed themselves.
TraceRequest Pad(const std::string& body, double friction, double E, int nodes_per_element) {
  Scene scene;
  scene.name = "pad";
  scene.materials = {ElasticMaterial("rubber", E, 0.3)};
  AddGrid(
      &scene, 4, 2, [](double x, double y) { return Eigen::Vector2d(2.0 * x, y); },
      SolidOf("rubber", nodes_per_element));
  for (Node& node : scene.nodes) {
    if (node.y != 1.0) continue;
    node.body = body;
    node.fixed_x = node.fixed_y = body.empty();
  }
  if (!body.empty()) scene.bodies = {{body, 1.0, 1.2, true, true, true}};
  BoundarySurface round{"round", {}};
  const int step = nodes_per_element == 8 ? 1 : 2;
  for (int j = 4; j > 0; j -= step) round.nodes.push_back("8_" + std::to_string(j));
  for (int i = 8; i > 0; i -= step) round.nodes.push_back(std::to_string(i) + "_0");
  for (int j = 0; j <= 4; j += step) round.nodes.push_back("0_" + std::to_string(j));
  scene.surfaces = {round};
  scene.nodes.push_back({"tip", 0.9, -0.05});
  scene.superelements = {{{"tip"}, {2.0 * E, 0.0, 0.0, E}}};
  scene.contacts = {{"tip", "", "", "round", friction}};
  scene.loads = {{"tip", -0.1 * E, 0.4 * E}};
  return RequestUntil({"load_factor", ">", 1.0}, scene);
}

TEST(SurfacesOnBodies, APadIsGluedToAJaw) {
  for (const double friction : {0.0, 0.1, 0.6})
    for (const double E : {1e-3, 1e3})
      for (const int nodes_per_element : {4, 8}) {
        SCOPED_TRACE(testing::Message() << friction << ' ' << E << ' ' << nodes_per_element);
        const TraceRequest glued = Pad("jaw", friction, E, nodes_per_element);
        const TracedPath path = TraceProved(glued), fixed = TraceProved(Pad("", friction, E, nodes_per_element));
        ExpectSameEvents(path, fixed, 1e-7);
        const ContactRecord &of = Contact(path, path.increments.back(), "tip@round"),
                            &expected = Contact(fixed, fixed.increments.back(), "tip@round");
        EXPECT_GT(of.rn, 0.05 * E);
        EXPECT_NEAR(of.rn / E, expected.rn / E, 1e-7);
        EXPECT_NEAR(of.rt / E, expected.rt / E, 1e-7);
        for (const TraceRequest& other :
             {ChangeUnits(glued, 1e-3, 1e6), Reverse(glued), Mirror(glued), Rotate(glued, 0.4)})
          ExpectSameEvents(TraceIncrements(other), path, 1e-7);
      }
}

// A block of the weight 1 on the outline of a body, of beams that nothing bends, is pushed 0.05 above by 0.8 s: it
// slides at 0.8 s = 0.4, however many of its nodes stand on the outline, and whatever the beams could bear.
TEST(SurfacesOnBodies, ABlockSlidesOnAnOutline) {
  for (const bool of_body : {true, false})
    for (const int feet : {2, 3, 5})
      for (const double stiffness : {1e-6, 1.0, 1e9}) {
        if (!of_body && stiffness != 1.0) continue;  // beams between nodes that supports hold can bend
        SCOPED_TRACE(testing::Message() << of_body << ' ' << feet << ' ' << stiffness);
        Scene scene;
        scene.bodies = {{"block", 0.0, 1.05}};
        if (of_body) scene.bodies.push_back({"anvil", 0.0, 0.0, true, true, true});
        BoundarySurface outline{"outline", {}, true};
        const auto add = [&](double x, double y) {
          const std::string name = "o" + std::to_string(outline.nodes.size());
          scene.nodes.push_back(of_body ? NodeOf("anvil", name, x, y) : Node{name, x, y, true, true, true});
          outline.nodes.push_back(name);
        };
        for (int i = 0; i < 8; ++i) add(-1.0 + 0.25 * i, 1.0);
        for (int i = 0; i < 4; ++i) add(1.0, 1.0 - 0.25 * i);
        for (int i = 0; i < 8; ++i) add(1.0 - 0.25 * i, 0.0);
        for (int i = 0; i < 4; ++i) add(-1.0, 0.25 * i);
        for (std::size_t i = 0; i < outline.nodes.size(); ++i)
          scene.beams.push_back(Between("edge" + std::to_string(i), outline.nodes[i],
                                        outline.nodes[(i + 1) % outline.nodes.size()], stiffness, stiffness, 1));
        scene.surfaces = {outline};
        for (int i = 0; i < feet; ++i) {
          const std::string foot = "foot" + std::to_string(i);
          scene.nodes.push_back(NodeOf("block", foot, -0.53 + i / (feet - 1.0), 1.0));
          scene.contacts.push_back({foot, "", "", "outline", 0.4});
        }
        scene.loads = {LoadOnBody("block", 0.0, -1.0, true)};
        const TracedPath path =
            TraceTo(RequestUpToALimit(scene, {LoadingStage({LoadOnBody("block", 0.8, 0.0)})}), EndReason::kAtLimit);
        EXPECT_NEAR(path.increments.back().load_factor, 0.5, 1e-12);
        ExpectNoFindings(path);
      }
}

}  // namespace
}  // namespace contact_path::surfaces_on_bodies_test
