// Answers of whole paths against closed forms: a clamped frame, a cylinder on a plane, a snap hook.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "contact_path/path/stop.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/quantity.h"
#include "contact_path/scene/scene_index.h"
#include "support/beams.h"
#include "support/solid_grid.h"
#include "support/traced_path.h"

namespace contact_path::closed_forms_test {
namespace {

constexpr double kPi = 3.14159265358979323846;

// A quantity in an increment of a path, as it is spelled in a scene.
class Answers {
 public:
  explicit Answers(const TracedPath& path) : expanded_(path.request), index_(expanded_.Get().scene) {}

  double operator()(const Increment& increment, const std::string& quantity) const {
    return ValueOf(FindQuantity(quantity, index_).value(), increment);
  }

 private:
  ExpandedRequest expanded_;
  SceneIndex index_;
};

// ----- a clamped portal frame -----

constexpr double kHeight = 3.0, kSpan = 4.0, kEI = 100.0, kEA = 1e7;
constexpr double kRatio = kHeight / kSpan;  // stiffness of the beam over that of a column
constexpr int kSegments = 8;

TraceRequest ClampedPortal(const std::vector<double>& load_factors) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.nodes = {{"a", 0.0, 0.0, true, true, true},
                 {"b", 0.0, kHeight},
                 {"c", kSpan, kHeight},
                 {"d", kSpan, 0.0, true, true, true}};
  scene.beams = {Between("left", "a", "b", kEA, kEI, kSegments), Between("beam", "b", "c", kEA, kEI, kSegments),
                 Between("right", "c", "d", kEA, kEI, kSegments)};
  request.options.at = {{"load_factor", load_factors}};
  request.options.stop = {{"load_factor", ">", load_factors.front()}};
  return request;
}

struct RootForces {
  double a_rx, a_rm, d_rx, d_rm;
};

// What the slope-deflection equations of an inextensible frame give must come out in the limit of small loads: the
// error falls with the load, in proportion to it. What is left are axial strains, some EI / (EA h^2) of the bending.
void ExpectSlopeDeflection(TraceRequest request, const RootForces& by_load) {
  const TracedPath path = TraceIncrements(request);
  ASSERT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
  const Answers answers(path);
  std::vector<double> errors;  // the smallest load first
  for (const Increment& increment : path.increments) {
    if (increment.kind != IncrementKind::kSample) continue;
    const double s = increment.load_factor;
    const double force = s * std::abs(by_load.d_rx), moment = s * std::abs(by_load.d_rm);
    errors.push_back(std::max({std::abs(answers(increment, "a.rx") - s * by_load.a_rx) / force,
                               std::abs(answers(increment, "d.rx") - s * by_load.d_rx) / force,
                               std::abs(answers(increment, "a.rm") - s * by_load.a_rm) / moment,
                               std::abs(answers(increment, "d.rm") - s * by_load.d_rm) / moment}));
  }
  ASSERT_EQ(errors.size(), 3U);
  const double axial = 10.0 * kEI / (kEA * kHeight * kHeight);
  EXPECT_LT(errors[0], 1e-4);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_LT(errors[i], 0.15 * errors[i + 1] + axial);  // of ten times the load
}

TEST(ClosedForms, RootsOfAFrameThatIsPushed) {
  TraceRequest request = ClampedPortal({1.0, 0.1, 0.01});
  request.scene.loads = {{"b", 1.0}};
  const double root = 0.5 * kHeight * (1.0 + 3.0 * kRatio) / (1.0 + 6.0 * kRatio);
  ExpectSlopeDeflection(request, {-0.5, root, -0.5, root});
}

TEST(ClosedForms, RootsOfAFrameUnderItsBeamsLoad) {
  TraceRequest request = ClampedPortal({1.0, 0.1, 0.01});
  Load load;
  load.group = "beam";
  load.py = -1.0;
  request.scene.loads = {load};
  // The load acts at the ends of the segments: of a clamped beam with n of them, it has 1 - 1/n^2 of the moment.
  const double clamped = kSpan * kSpan / 12.0 * (1.0 - 1.0 / (kSegments * kSegments));
  const double root = clamped / (2.0 + kRatio);
  ExpectSlopeDeflection(request, {3.0 * root / kHeight, -root, -3.0 * root / kHeight, root});
}

// ----- Hertz: a cylinder on a plane, or on a block -----

constexpr double kE = 1.0, kNu = 0.3, kRadius = 1.0;
// Of the bodies: so much larger than the contact that they count as half spaces. Strains are about a / R, and so is the
// error of a theory of small strains.
constexpr double kHalfWidth = 0.002, kFar = 20.0 * kHalfWidth;

// Places from 0 to kFar, at this distance up to there, then farther and farther apart.
std::vector<double> Graded(double step, double evenly) {
  std::vector<double> places = {0.0};
  while (places.back() < evenly - 0.5 * step) places.push_back(places.back() + step);
  while (places.back() < kFar - step) {
    step *= 1.4;
    places.push_back(places.back() + step);
  }
  places.back() = kFar;
  return places;
}

struct Body {
  std::vector<std::string> touching, far;  // nodes of its lower and its upper side, along x
};

// The right half of a body above its lower side, whose height over x is given, or of its mirror image below.
// `per_width`: elements on the half-width of the contact.
template <typename Height>
Body AddBody(const std::string& name, double per_width, int nodes_per_element, bool below, Height&& height,
             Scene& scene) {
  const double step = kHalfWidth / per_width;
  const std::vector<double> along = Graded(step, 1.5 * kHalfWidth), across = Graded(step, kHalfWidth);
  const int steps = nodes_per_element == 8 ? 2 : 1;
  const int last = steps * (static_cast<int>(along.size()) - 1),
            deepest = steps * (static_cast<int>(across.size()) - 1);
  const auto at = [steps](const std::vector<double>& places, int i) {
    const auto k = static_cast<std::size_t>(i / steps);
    return i % steps == 0 ? places[k] : 0.5 * (places[k] + places[k + 1]);
  };
  const auto node = [&](int i, int j) { return name + std::to_string(i) + "_" + std::to_string(j); };
  const auto is_node = [&](int i, int j) { return steps == 1 || i % 2 == 0 || j % 2 == 0; };
  for (int j = 0; j <= deepest; ++j)
    for (int i = 0; i <= last; ++i) {
      if (!is_node(i, j)) continue;
      const double x = at(along, i), foot = height(x), y = foot + at(across, j) * (kFar - foot) / kFar;
      scene.nodes.push_back({node(i, j), x, below ? -y : y, i == 0, below && j == deepest});
    }
  Solid solid;
  solid.name = name;
  solid.material = "elastic";
  solid.nodes_per_element = nodes_per_element;
  using Place = std::pair<int, int>;
  std::vector<Place> cell = {{0, 0}, {steps, 0}, {steps, steps}, {0, steps}};
  if (steps == 2) cell.insert(cell.end(), {{1, 0}, {2, 1}, {1, 2}, {0, 1}});
  if (below) {  // the mirror image is walked the other way round
    std::reverse(cell.begin(), cell.begin() + 4);
    if (steps == 2) std::reverse(cell.begin() + 4, cell.begin() + 7);
  }
  for (int j = 0; j < deepest; j += steps)
    for (int i = 0; i < last; i += steps)
      for (const auto& [di, dj] : cell) solid.nodes.push_back(node(i + di, j + dj));
  scene.solids.push_back(solid);
  Body body;
  for (int i = 0; i <= last; ++i) {
    body.touching.push_back(node(i, 0));
    body.far.push_back(node(i, deepest));
  }
  return body;
}

// Half of a cylinder that half of its line load presses down.
Body AddCylinder(double per_width, int nodes_per_element, TraceRequest& request) {
  Scene& scene = request.scene;
  scene.materials = {ElasticMaterial("elastic", kE, kNu, MaterialModel::kLinear)};
  Body cylinder = AddBody(
      "cylinder", per_width, nodes_per_element, false, [](double x) { return 0.5 * x * x / kRadius; }, scene);
  scene.surfaces.push_back({"top", cylinder.far});
  Load load;
  load.surface = "top";
  load.py = -0.5 / kFar;
  scene.loads = {load};
  request.options.record = {"pressures"};
  request.options.accuracy = Accuracy::kFast;
  request.options.max_increments = 1000;
  return cylinder;
}

// Line load under which the contact has kHalfWidth, by the modulus E* of the pair.
double LineLoad(double modulus) { return 0.25 * kPi * kHalfWidth * kHalfWidth * modulus / kRadius; }

struct PressureCurve {
  std::vector<double> x, pressure;  // of the nodes that touch, over a and over p0
  double width = 0.0;               // over a
};

// Of the nodes of a cylinder, at the end of a path.
PressureCurve CurveOf(const TracedPath& path, const Body& body, const std::string& boundary, double line_load) {
  const Answers answers(path);
  const Increment& last = path.increments.back();
  const double p0 = 2.0 * line_load / (kPi * kHalfWidth);
  PressureCurve curve;
  for (const std::string& node : body.touching) {
    const std::string contact = node + "@" + boundary;
    if (PositionX(path, last, node) > 1.5 * kHalfWidth || answers(last, contact + ".rn") == 0.0) break;
    curve.x.push_back(PositionX(path, last, node) / kHalfWidth);
    curve.pressure.push_back(answers(last, contact + ".pressure") / p0);
  }
  curve.width = answers(last, boundary + ".width") / kHalfWidth;
  return curve;
}

void AddCandidates(const Body& body, const std::string& obstacle, const std::string& surface, Scene& scene) {
  for (std::size_t i = 0; i < body.touching.size(); ++i) {
    const std::size_t node = NodeNumber(scene, body.touching[i]);
    if (scene.nodes[node].x > 1.5 * kHalfWidth) break;
    scene.contacts.push_back({body.touching[i], obstacle, "", surface});
  }
}

PressureCurve OnAPlane(double per_width, int nodes_per_element) {
  TraceRequest request;
  const Body cylinder = AddCylinder(per_width, nodes_per_element, request);
  request.scene.obstacles = {{"plane", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.0}};
  AddCandidates(cylinder, "plane", "", request.scene);
  const double line_load = LineLoad(kE / (1.0 - kNu * kNu));
  request.options.stop = {{"load_factor", ">", line_load}};
  const TracedPath path = TraceIncrements(request);
  EXPECT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
  return CurveOf(path, cylinder, "plane", line_load);
}

// On a block of the same material, with meshes of their own.
PressureCurve OnABlock(double per_width, double per_width_of_block, int nodes_per_element) {
  TraceRequest request;
  const Body cylinder = AddCylinder(per_width, nodes_per_element, request);
  const Body block = AddBody(
      "block", per_width_of_block, nodes_per_element, true, [](double) { return 0.0; }, request.scene);
  request.scene.surfaces.push_back({"block_top", block.touching});
  AddCandidates(cylinder, "", "block_top", request.scene);
  const double line_load = LineLoad(0.5 * kE / (1.0 - kNu * kNu));
  request.options.stop = {{"load_factor", ">", line_load}};
  const TracedPath path = TraceIncrements(request);
  EXPECT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
  return CurveOf(path, cylinder, "block_top", line_load);
}

double Hertz(double x) { return x < 1.0 ? std::sqrt(1.0 - x * x) : 0.0; }

// The largest error of nodes within this part of the half-width, or of the means (1 2 1)/4 of the same nodes.
double LargestError(const PressureCurve& curve, double within, bool smoothed) {
  double largest = 0.0;
  for (std::size_t i = 0; i < curve.x.size() && curve.x[i] < within; ++i) {
    double pressure = curve.pressure[i];
    if (smoothed) {
      const double before = curve.pressure[i > 0 ? i - 1 : 1];  // the other half of the cylinder
      const double after = i + 1 < curve.x.size() ? curve.pressure[i + 1] : 0.0;
      pressure = 0.25 * before + 0.5 * pressure + 0.25 * after;
    }
    largest = std::max(largest, std::abs(pressure - Hertz(curve.x[i])));
  }
  return largest;
}

// Of means over the edges of a coarser mesh of 8 nodes an element, each of which has two edges of the cylinder beside
// it.
double LargestErrorOfMeans(const PressureCurve& curve, double within) {
  constexpr std::array<double, 5> kWeights = {1.0 / 12.0, 1.0 / 3.0, 1.0 / 6.0, 1.0 / 3.0, 1.0 / 12.0};
  double largest = 0.0;
  for (std::size_t i = 0; i + 4 < curve.x.size() && curve.x[i + 4] < within; i += 4) {
    double error = 0.0;
    for (std::size_t k = 0; k < 5; ++k) error += kWeights[k] * (curve.pressure[i + k] - Hertz(curve.x[i + k]));
    largest = std::max(largest, std::abs(error));
  }
  return largest;
}

// Up to three quarters of the half-width the errors are those of a mesh, of second order, and of bodies that are no
// half spaces, some (a / kFar)^2. The width ends in the middle between two nodes.
TEST(ClosedForms, PressureOfHertzOnThreeMeshes) {
  std::vector<PressureCurve> curves;
  for (const double n : {3.5, 7.0, 14.0}) {
    SCOPED_TRACE(std::to_string(n) + " elements on the half-width");
    curves.push_back(OnAPlane(n, 4));
    EXPECT_LT(LargestError(curves.back(), 0.75, false), 0.1 / (n * n) + 1e-3);
    EXPECT_NEAR(curves.back().width, 1.0, 0.5 / n + 2e-3);
  }
  // Node i of a mesh is node 2 i of the next one.
  for (std::size_t mesh = 0; mesh < 2; ++mesh)
    for (std::size_t i = 0; i < curves[mesh].x.size() && curves[mesh].x[i] < 0.75; ++i) {
      ASSERT_LT(2 * i, curves[mesh + 1].x.size());
      EXPECT_NEAR(curves[mesh].x[i], curves[mesh + 1].x[2 * i], 1e-3);
      EXPECT_NEAR(curves[mesh].pressure[i], curves[mesh + 1].pressure[2 * i], mesh == 0 ? 0.01 : 3e-3);
    }
}

// Nodal pressures of elements of 8 nodes go up and down between corners and nodes in the middle; means of neighbours do
// so less.
TEST(ClosedForms, PressureOfHertzWithEightNodesAnElement) {
  const PressureCurve coarse = OnAPlane(2.25, 8), fine = OnAPlane(4.5, 8);
  EXPECT_LT(LargestError(coarse, 0.75, false), 0.06);
  EXPECT_LT(LargestError(fine, 0.75, false), 0.02);
  EXPECT_LT(LargestError(fine, 0.75, true), 0.01);
  EXPECT_NEAR(coarse.width, 1.0, 0.5 / 2.25 + 5e-3);
  EXPECT_NEAR(fine.width, 1.0, 0.5 / 4.5 + 5e-3);
}

// Between two meshes of elements of 4 nodes the error is that of the coarser one, whichever of them is finer.
// With 8 nodes an element nodal pressures go up and down by a quarter of the largest one, while the mean over each edge
// of the coarser mesh is right.
TEST(ClosedForms, PressureOfHertzBetweenTwoMeshes) {
  for (const auto& [n, of_block] : {std::pair(7.0, 3.5), {7.0, 5.0}, {3.5, 7.0}}) {
    SCOPED_TRACE(std::to_string(n) + " elements on " + std::to_string(of_block));
    const PressureCurve curve = OnABlock(n, of_block, 4);
    EXPECT_LT(LargestError(curve, 0.6, false), 0.03);
    EXPECT_NEAR(curve.width, 1.0, 0.5 / n + 0.01);
  }
  const PressureCurve curve = OnABlock(4.5, 2.25, 8);
  EXPECT_LT(LargestErrorOfMeans(curve, 0.75), 0.03);
}

// ----- a snap hook -----

constexpr double kSpring = 5.0;

// The scene, or the same with a root that is held in place of the spring; with samples where the nose is at these
// heights.
TraceRequest SnapHook(bool held, const std::vector<double>& heights) {
  TraceRequest request = ReadExample("snap_hook");
  if (held) {
    request.scene.superelements.clear();
    request.scene.nodes[NodeNumber(request.scene, "root")].fixed_x = true;
  }
  if (!heights.empty()) request.options.at = {{"nose.y", heights}};
  return request;
}

// The spring has the force of the catch, in every increment.
TEST(ClosedForms, ForceOfASpringIsThatOfTheCatch) {
  const TracedPath path = TraceIncrements(SnapHook(false, {}));
  const Answers answers(path);
  for (const Increment& increment : path.increments)
    EXPECT_NEAR(answers(increment, "die.rx"), kSpring * PositionX(path, increment, "root"), 1e-11);
}

// A spring between the root and the ground does not change which states the hook has, only at which place of the catch
// they are: with the same place of the nose against the catch, the support of a root that is held has the force of the
// spring.
TEST(ClosedForms, SupportOfASnapHookHasTheForceOfASpringInItsPlace) {
  const std::vector<double> heights = {-0.0975, -0.095, -0.0875, -0.08, -0.07};
  const TracedPath with_spring = TraceIncrements(SnapHook(false, heights)),
                   held = TraceIncrements(SnapHook(true, heights));
  for (const TracedPath* path : {&with_spring, &held})
    ASSERT_EQ(path->result.reason, EndReason::kStopCriterion) << path->result.message;
  const std::vector<Increment> soft = IncrementsOfKind(with_spring, IncrementKind::kSample),
                               stiff = IncrementsOfKind(held, IncrementKind::kSample);
  ASSERT_EQ(soft.size(), stiff.size());
  ASSERT_GE(soft.size(), 4U * heights.size());  // up and down, in and out
  const Answers of_support(held);
  for (std::size_t i = 0; i < soft.size(); ++i) {
    const double root = PositionX(with_spring, soft[i], "root");
    EXPECT_EQ(soft[i].stage, stiff[i].stage);
    EXPECT_NEAR(PositionX(with_spring, soft[i], "nose") - root, PositionX(held, stiff[i], "nose"), 1e-10);
    // The catch against the root.
    const double sign = soft[i].stage == 1 ? 1.0 : -1.0;
    EXPECT_NEAR(soft[i].load_factor + sign * root, stiff[i].load_factor, 1e-10);
    EXPECT_NEAR(of_support(stiff[i], "root.rx"), -kSpring * root, 1e-10);
    EXPECT_NEAR(of_support(stiff[i], "root.rx"), -of_support(stiff[i], "die.rx"), 1e-11);
  }
}

// F = f P of the head of the scene: its error falls with the rise, in proportion to it.
TEST(ClosedForms, ForceOfInsertionOfASnapHook) {
  const std::vector<double> rises = {0.000625, 0.0025, 0.01};
  std::vector<double> heights;
  for (const double rise : rises) heights.push_back(-0.1 + rise);
  const TracedPath path = TraceIncrements(SnapHook(true, heights));
  const Answers answers(path);
  const double slope = 0.11657691 / 0.25, friction = 0.3, lever = 0.1;
  const double f = (friction + slope) / (1.0 - friction * slope);
  std::vector<double> errors;
  for (const Increment& increment : path.increments) {
    if (increment.kind != IncrementKind::kSample || increment.stage != 1 || errors.size() == rises.size()) continue;
    const double rise = rises[errors.size()];
    ASSERT_NEAR(PositionY(path, increment, "nose"), -0.1 + rise, 1e-12);
    const double F = answers(increment, "root.rx");
    EXPECT_NEAR(F / answers(increment, "die.ry"), f, 1e-9);
    const double P = rise / (1.0 / 3.0 - 0.5 * f * lever);
    errors.push_back(std::abs(F / (f * P) - 1.0));
  }
  ASSERT_EQ(errors.size(), rises.size());
  EXPECT_LT(errors[0], 2e-3);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_LT(errors[i], 0.4 * errors[i + 1]);  // of four times the rise
}

}  // namespace
}  // namespace contact_path::closed_forms_test
