// Paths of plane solids, by both methods.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "contact_path/scene/expand.h"
#include "contact_path/verify/verify_path.h"
#include "support/solid_grid.h"
#include "support/traced_path.h"

namespace contact_path::solid_paths_test {
namespace {

// nx x ny cells of a block, held nowhere.
TraceRequest Block(int nx, int ny, double width, double height, int nodes,
                   MaterialModel model = MaterialModel::kNeoHookean, PlaneState plane = PlaneState::kStrain) {
  TraceRequest request;
  request.scene.materials = {ElasticMaterial("m", 10.0, 0.3, model)};
  Solid solid = SolidOf("m", nodes);
  solid.name = "block";
  solid.plane = plane;
  AddGrid(
      &request.scene, nx, ny, [&](double x, double y) { return Eigen::Vector2d(width * x, height * y); }, solid);
  return request;
}

// To this end, and proved with the state of each increment.
TracedPath TraceFully(const TraceRequest& request, EndReason end = EndReason::kStopCriterion) {
  TracedPath path = TraceIncrements(request);
  ExpectEnd(path, end);
  const Verification verification = VerifyPath(path.request, path.increments);
  for (const Finding& finding : verification.findings)
    ADD_FAILURE() << "increment " << finding.increment << ": " << finding.what;
  EXPECT_EQ(verification.full_increments, static_cast<int>(path.increments.size()));
  return path;
}

// A uniform block in plane stress, pressed between plates without friction: uniaxial stress. Of the neo-Hookean
// material with the stretch l, mu (k^2 - 1) + lambda ln(l k^2) = 0 and P = (mu (l^2 - 1) + lambda ln(l k^2)) / l.
TEST(SolidPaths, CompressedBlock) {
  for (const int nodes : {3, 4, 6, 8}) {
    SCOPED_TRACE("nodes " + std::to_string(nodes));
    TraceRequest request = Block(2, 2, 1.0, 1.0, nodes, MaterialModel::kNeoHookean, PlaneState::kStress);
    for (Node& node : request.scene.nodes) {
      node.fixed_y = node.y == 0.0 || node.y == 1.0;
      node.fixed_x = node.x == 0.0 && node.y == 0.0;
      if (node.y == 1.0) request.scene.support_motions.push_back({node.name, 0.0, -1.0});
    }
    request.options.step = 0.2;
    request.options.stop = {{"load_factor", ">", 0.5}};
    const TracedPath path = TraceFully(request);
    const double l = 1.0 - path.increments.back().load_factor, mu = 10.0 / 2.6, lambda = 2.0 * mu * 0.3 / 0.4;
    double k = 1.0;
    for (int i = 0; i < 100; ++i)
      k -= (mu * (k * k - 1.0) + lambda * std::log(l * k * k)) / (2.0 * mu * k + 2.0 * lambda / k);
    EXPECT_NEAR(l, 0.5, 1e-12);
    const Increment& last = path.increments.back();
    EXPECT_NEAR(PositionX(path, last, "4_4"), k, 1e-9);
    const double volume = std::log(l * k * k);
    EXPECT_NEAR(last.strain_energy,
                0.5 * mu * (l * l + 2.0 * k * k - 3.0 - 2.0 * volume) + 0.5 * lambda * volume * volume, 1e-8);
  }
}

// Of slender blocks in plane stress, the elastica: u/L and w/L of a cantilever with the dead load P L^2 / EI = 10 at
// its tip are 0.554996 and 0.810609. The block is 20 times as long as it is high: shear adds a part in some hundred.
TEST(SolidPaths, CantileverBlock) {
  for (const Method method : kMethods) {
    SCOPED_TRACE(ToString(method));
    TraceRequest request = ReadExample("cantilever_block");
    request.options.method = method;
    if (method == Method::kMpec) request.options.step = 0.5;
    const TracedPath path = TraceFully(request);
    // Between the last two increments, at load factor 10.
    const Increment &before = path.increments[path.increments.size() - 2], &last = path.increments.back();
    const double share = (10.0 - before.load_factor) / (last.load_factor - before.load_factor);
    const auto at_ten = [&](double a, double b) { return a + share * (b - a); };
    const double x = at_ten(PositionX(path, before, "n40_1"), PositionX(path, last, "n40_1"));
    const double y = at_ten(PositionY(path, before, "n40_1"), PositionY(path, last, "n40_1")) - 0.25;
    EXPECT_NEAR(x, 10.0 * (1.0 - 0.554996), 0.1);
    EXPECT_NEAR(y, -10.0 * 0.810609, 0.1);
  }
}

// A block on a rough floor, pressed down at its top and pushed aside there until it slides: H = mu V.
TEST(SolidPaths, BlockOnARoughFloor) {
  for (const Method method : kMethods)
    for (const int nodes : {3, 4}) {
      SCOPED_TRACE(std::string(ToString(method)) + ", nodes " + std::to_string(nodes));
      TraceRequest request = Block(4, 2, 2.0, 1.0, nodes);
      request.scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.5}};
      double count = 0.0;
      for (const Node& node : request.scene.nodes) {
        if (node.y == 0.0) request.scene.contacts.push_back({node.name, "floor"});
        if (node.y == 1.0) count += 1.0;
      }
      for (const Node& node : request.scene.nodes) {
        if (node.y != 1.0) continue;
        request.scene.loads.push_back({node.name, 0.0, -1.0 / count, true});
        request.scene.loads.push_back({node.name, 1.0 / count, 0.0, false});
      }
      request.options.method = method;
      request.options.max_increments = 400;
      request.options.stop = {{"8_0.x", ">", 2.3}};
      if (method == Method::kMpec) request.options.step = 0.02;
      const TracedPath path = TraceFully(request);
      const Increment& last = path.increments.back();
      EXPECT_NEAR(last.load_factor, 0.5, 1e-6);
      double tangential = 0.0;
      for (const ContactRecord& contact : last.contacts) tangential += contact.rt;
      EXPECT_NEAR(SumOfNormals(last), 1.0, 1e-9);
      EXPECT_NEAR(tangential, -0.5, 1e-6);
    }
}

// A St. Venant-Kirchhoff block has no resistance to being pressed to nothing.
TEST(SolidPaths, EndsWhereAnElementTurnsInsideOut) {
  TraceRequest request = Block(2, 1, 2.0, 1.0, 4, MaterialModel::kStVenantKirchhoff);
  for (Node& node : request.scene.nodes) {
    node.fixed_x = node.fixed_y = true;
    if (node.x == 1.0) node.fixed_x = false;
    if (node.x == 2.0) request.scene.support_motions.push_back({node.name, -1.0, 0.0});
  }
  const TracedPath path = TraceFully(request, EndReason::kElementInverted);
  ExpectEnd(path, EndReason::kElementInverted, " of solids[0] (block) turns inside out: its area has shrunk to ");
  EXPECT_EQ(path.result.message.find("element "), 0u);
  EXPECT_GT(path.increments.size(), 5u);
}

// Elements of few nodes in a nearly incompressible material.
TEST(SolidPaths, RemarkWhereElementsLock) {
  for (const int nodes : {4, 8})
    for (const PlaneState plane : {PlaneState::kStrain, PlaneState::kStress}) {
      TraceRequest request = Block(1, 1, 1.0, 1.0, nodes, MaterialModel::kNeoHookean, plane);
      request.scene.materials[0].nu = 0.495;
      for (Node& node : request.scene.nodes) node.fixed_x = node.fixed_y = node.x == 0.0;
      request.scene.loads = {{"2_2", 0.1, 0.0}};
      request.options.max_increments = 1;
      const bool locks = nodes == 4 && plane == PlaneState::kStrain;
      EXPECT_EQ(
          TraceIncrements(request).result.message.find("; solids[0] (block): elements of 3 or 4 nodes are far too "
                                                       "stiff in plane strain") != std::string::npos,
          locks);
    }
}

// The method of the paper finds the same path.
TEST(SolidPaths, MethodsAgree) {
  TraceRequest request = Block(3, 3, 1.0, 1.0, 4, MaterialModel::kCiarletGeymonat);
  request.scene.materials[0] = {"m", MaterialModel::kCiarletGeymonat, 0.0, 0.0, 40.0, 1.2, 0.3};
  for (Node& node : request.scene.nodes) node.fixed_x = node.fixed_y = node.y == 0.0;
  request.scene.loads = {{"6_6", 0.1, -0.2}};
  request.options.stop = {{"6_6.y", "<", 0.9}};
  request.options.step = 0.02;
  const TracedPath branch = TraceFully(request);
  request.options.method = Method::kMpec;
  const TracedPath mpec = TraceFully(request);
  const auto load_at = [](const TracedPath& path, double y) {
    const std::size_t n = path.increments.size();
    const double a = PositionY(path, path.increments[n - 2], "6_6"), b = PositionY(path, path.increments[n - 1], "6_6");
    const double s = path.increments[n - 2].load_factor;
    return s + (path.increments[n - 1].load_factor - s) * (y - a) / (b - a);
  };
  EXPECT_NEAR(load_at(branch, 0.9), load_at(mpec, 0.9), 1e-3 * load_at(branch, 0.9));
}

// Half a cylinder on a rigid plane: half-width and pressure of Hertz within the mesh's error.
TEST(SolidPaths, Hertz) {
  const TracedPath path = TraceFully(ReadExample("hertz"));
  const Increment& last = path.increments.back();
  const double P = last.load_factor, pi = 3.14159265358979323846;
  const double a = std::sqrt(4.0 * P * (1.0 - 0.09) / pi), p0 = 2.0 * P / (pi * a);
  struct Touch {
    double x, rn;
  };
  std::vector<Touch> rim;
  const Scene scene = Expand(path.request).request.scene;
  double sum = 0.0;
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    rim.push_back({scene.nodes[NodeNumber(scene, scene.contacts[i].node)].x, last.contacts[i].rn});
    sum += last.contacts[i].rn;
  }
  EXPECT_NEAR(2.0 * sum, P, 1e-12);
  std::sort(rim.begin(), rim.end(), [](const Touch& one, const Touch& other) { return one.x < other.x; });
  std::size_t end = 0;  // the first that does not touch
  while (rim[end].rn > 0.0) ++end;
  EXPECT_LT(rim[end - 1].x, a);
  EXPECT_GT(rim[end].x + (rim[end].x - rim[end - 1].x), a);
  for (std::size_t i = 1; rim[i].x < 0.9 * a; ++i) {
    const double pressure = rim[i].rn / (0.5 * (rim[i + 1].x - rim[i - 1].x));
    EXPECT_NEAR(pressure, p0 * std::sqrt(1.0 - std::pow(rim[i].x / a, 2)), 0.04 * p0) << rim[i].x;
  }
}

// Pressed and dragged until all that touches slips: then H = mu V.
TEST(SolidPaths, RubberFoot) {
  const TracedPath path = TraceFully(ReadExample("rubber_foot"));
  double V = 0.0, H = 0.0;
  for (const ContactRecord& contact : path.increments.back().contacts) {
    V += contact.rn;
    H += contact.rt;
    EXPECT_TRUE(contact.state == ContactState::kSlipPlus || contact.state == ContactState::kOpen);
  }
  EXPECT_GT(V, 0.3);
  EXPECT_NEAR(H, -0.3 * V, 1e-10);
}

}  // namespace
}  // namespace contact_path::solid_paths_test
