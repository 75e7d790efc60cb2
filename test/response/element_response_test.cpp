#include "contact_path/response/element_response.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

#include "contact_path/path/csv.h"
#include "contact_path/path/stop.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/quantity.h"
#include "contact_path/scene/scene_index.h"
#include "response/cantilever.h"
#include "support/solid_grid.h"
#include "support/traced_path.h"

namespace contact_path::element_response_test {
namespace {

// A cantilever under a force at its tip, whatever bends: what each section bears is the force and its moment about
// where the section is.
TEST(Sections, OfACantileverBearItsForce) {
  TraceRequest request = Cantilever({"tip", 4.0, 3.0});
  request.scene.beams[0].GA = 500.0;
  request.scene.beams[0].segments = 7;
  request.options.record = {"sections"};
  const TracedPath path = TraceIncrements(request);
  const ExpandedRequest expanded(path.request);
  const std::vector<std::string>& nodes = expanded.Get().scene.beams[0].nodes;
  for (const Increment& increment : path.increments) {
    ASSERT_EQ(increment.sections.size(), 7U);
    const double fx = 0.3 * increment.load_factor, fy = -increment.load_factor;
    const double tip_x = PositionX(path, increment, "tip"), tip_y = PositionY(path, increment, "tip");
    for (std::size_t i = 0; i < 7; ++i) {
      const SectionForces& of = increment.sections[i];
      std::array<double, 2> x{}, y{};
      for (std::size_t end = 0; end < 2; ++end) {
        const std::size_t node = NodeNumber(expanded.Get().scene, nodes[i + end]);
        x[end] = increment.positions[2 * node];
        y[end] = increment.positions[2 * node + 1];
      }
      const double dx = x[1] - x[0], dy = y[1] - y[0], length = std::hypot(dx, dy);
      EXPECT_NEAR(of.N, (fx * dx + fy * dy) / length, 1e-9);
      EXPECT_NEAR(of.Q, (fy * dx - fx * dy) / length, 1e-9);
      const auto moment = [&](double at_x, double at_y) { return (tip_x - at_x) * fy - (tip_y - at_y) * fx; };
      EXPECT_NEAR(of.M1, moment(x[0], y[0]), 1e-9);
      EXPECT_NEAR(of.M2, moment(x[1], y[1]), 1e-9);
      EXPECT_NEAR(of.M, moment(0.5 * (x[0] + x[1]), 0.5 * (y[0] + y[1])), 1e-9);
    }
    EXPECT_NEAR(increment.sections[0].M1, -increment.supports[0].rm, 1e-9);
  }
}

TEST(Sections, OfBarsAreTheirAxialForces) {
  for (const StrainMeasure strain :
       {StrainMeasure::kBiot, StrainMeasure::kGreenLagrange, StrainMeasure::kLogarithmic}) {
    TraceRequest request = ReadExample("von_mises");
    for (Bar& bar : request.scene.bars) bar.strain = strain;
    request.options.stop.clear();
    request.options.max_increments = 20;
    request.options.record = {"sections"};
    const TracedPath path = TraceIncrements(request);
    const Scene& scene = path.request.scene;
    for (const Increment& increment : path.increments)
      for (std::size_t i = 0; i < scene.bars.size(); ++i) {
        const std::size_t a = NodeNumber(scene, scene.bars[i].nodes[0]), b = NodeNumber(scene, scene.bars[i].nodes[1]);
        const double length = std::hypot(increment.positions[2 * b] - increment.positions[2 * a],
                                         increment.positions[2 * b + 1] - increment.positions[2 * a + 1]);
        const double rest = std::hypot(scene.nodes[b].x - scene.nodes[a].x, scene.nodes[b].y - scene.nodes[a].y);
        const double stretch = length / rest, EA = scene.bars[i].EA;
        const double force = strain == StrainMeasure::kBiot            ? EA * (stretch - 1.0)
                             : strain == StrainMeasure::kGreenLagrange ? EA * 0.5 * (stretch * stretch - 1.0) * stretch
                                                                       : EA * std::log(stretch) / stretch;
        EXPECT_NEAR(increment.sections[i].N, force, 1e-11);
        EXPECT_EQ(increment.sections[i].M, 0.0);
      }
  }
}

struct Law {
  MaterialModel model;
  PlaneState plane;
  std::size_t nodes_per_element;
};

// An element whose nodes all move by one deformation gradient.
class StressPatch : public testing::TestWithParam<Law> {
 protected:
  static constexpr double kE = 3.0, kNu = 0.3, kThickness = 0.7;

  TraceRequest Request() const {
    TraceRequest request;
    Scene& scene = request.scene;
    Material material = ElasticMaterial("rubber", kE, kNu, GetParam().model);
    if (material.model == MaterialModel::kCiarletGeymonat) material.a = 0.25 * kE / (1.0 + kNu);
    scene.materials = {material};
    Solid solid;
    solid.name = "patch";
    solid.material = "rubber";
    solid.thickness = kThickness;
    solid.plane = GetParam().plane;
    solid.nodes_per_element = static_cast<int>(GetParam().nodes_per_element);
    std::vector<std::array<double, 2>> corners = {{0.0, 0.0}, {1.1, -0.1}, {1.2, 0.9}, {-0.1, 1.0}};
    if (GetParam().nodes_per_element == 3 || GetParam().nodes_per_element == 6) corners.pop_back();
    const std::size_t count = corners.size();
    if (GetParam().nodes_per_element > 4)
      for (std::size_t i = 0; i < count; ++i)
        corners.push_back(
            {0.5 * (corners[i][0] + corners[(i + 1) % count][0]), 0.5 * (corners[i][1] + corners[(i + 1) % count][1])});
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::string name = "n" + std::to_string(i);
      scene.nodes.push_back({name, corners[i][0], corners[i][1], true, true});
      solid.nodes.push_back(name);
      if (i > 0)
        scene.support_motions.push_back({name, 0.3 * corners[i][0] + 0.1 * corners[i][1], -0.2 * corners[i][1]});
    }
    scene.nodes.push_back({"free", 5.0, 5.0});  // a path needs something that moves
    scene.nodes.push_back({"held", 6.0, 5.0, true, true});
    scene.bars = {{{"free", "held"}, 1.0}, {{"free", "n0"}, 1.0}};
    scene.solids = {solid};
    request.options.record = {"stresses"};
    request.options.stop = {{"load_factor", ">", 1.0}};
    return request;
  }
};

TEST_P(StressPatch, IsExact) {
  const TracedPath path = TraceIncrements(Request());
  ASSERT_EQ(path.result.reason, EndReason::kStopCriterion) << path.result.message;
  const double lambda = kE * kNu / ((1.0 + kNu) * (1.0 - 2.0 * kNu)), mu = 0.5 * kE / (1.0 + kNu), a = 0.5 * mu;
  const bool plane_stress = GetParam().plane == PlaneState::kStress;
  const Increment& last = path.increments.back();
  const double F11 = 1.3, F12 = 0.1, F22 = 0.8, area = F11 * F22;
  // Left Cauchy-Green tensor in the plane.
  const double b11 = F11 * F11 + F12 * F12, b12 = F12 * F22, b22 = F22 * F22;
  // Stresses for a stretch across the plane, by the laws in three dimensions.
  const auto stresses = [&](double across) -> std::array<double, 4> {
    const double J = area * across, C33 = across * across;
    switch (GetParam().model) {
      case MaterialModel::kNeoHookean: {
        const double p = (lambda * std::log(J) - mu) / J;
        return {mu * b11 / J + p, mu * b22 / J + p, mu * b12 / J, mu * C33 / J + p};
      }
      case MaterialModel::kStVenantKirchhoff: {
        const double E11 = 0.5 * (F11 * F11 - 1.0), E22 = 0.5 * (F12 * F12 + F22 * F22 - 1.0), E12 = 0.5 * F11 * F12;
        const double E33 = 0.5 * (C33 - 1.0), trace = E11 + E22 + E33;
        const double S11 = lambda * trace + 2.0 * mu * E11, S22 = lambda * trace + 2.0 * mu * E22, S12 = 2.0 * mu * E12;
        return {(F11 * F11 * S11 + 2.0 * F11 * F12 * S12 + F12 * F12 * S22) / J, F22 * F22 * S22 / J,
                (F11 * F22 * S12 + F12 * F22 * S22) / J, C33 * (lambda * trace + 2.0 * mu * E33) / J};
      }
      case MaterialModel::kCiarletGeymonat: {
        const double i1 = b11 + b22 + C33, c = 0.5 * mu - a;
        const double p = (2.0 * (0.25 * lambda - 0.5 * mu + a) * J * J - (0.5 * lambda + mu)) / J;
        const auto normal = [&](double b, double b_b) { return 2.0 * (a * b + c * (i1 * b - b_b)) / J + p; };
        return {normal(b11, b11 * b11 + b12 * b12), normal(b22, b12 * b12 + b22 * b22),
                2.0 * (a * b12 + c * (i1 * b12 - b12 * (b11 + b22))) / J, normal(C33, C33 * C33)};
      }
      case MaterialModel::kLinear: {
        const double e11 = F11 - 1.0, e22 = F22 - 1.0, e33 = across - 1.0, trace = e11 + e22 + e33;
        return {lambda * trace + 2.0 * mu * e11, lambda * trace + 2.0 * mu * e22, mu * F12,
                lambda * trace + 2.0 * mu * e33};
      }
    }
    return {};
  };
  double across = 1.0;
  if (plane_stress) {  // where no stress acts across the plane, by bisection
    double low = 0.3, high = 3.0;
    for (int i = 0; i < 100; ++i) {
      across = 0.5 * (low + high);
      (stresses(across)[3] < 0.0 ? low : high) = across;
    }
  }
  const std::array<double, 4> wanted = stresses(across);
  ASSERT_EQ(last.stresses.size(), 1U);
  const SolidStress& of = last.stresses[0];
  EXPECT_NEAR(of.sxx, wanted[0], 1e-11);
  EXPECT_NEAR(of.syy, wanted[1], 1e-11);
  EXPECT_NEAR(of.sxy, wanted[2], 1e-11);
  EXPECT_NEAR(of.szz, plane_stress ? 0.0 : wanted[3], 1e-11);
  const double deviatoric = (of.sxx * of.sxx + of.syy * of.syy + of.szz * of.szz - of.sxx * of.syy - of.syy * of.szz -
                             of.szz * of.sxx + 3.0 * of.sxy * of.sxy);
  EXPECT_NEAR(of.mises, std::sqrt(deviatoric), 1e-12);
}

// Forces on the boundary of a body, times the places where they act, are its mean stress times its volume.
class StressAndForces : public StressPatch {};

TEST_P(StressAndForces, Agree) {
  const TracedPath path = TraceIncrements(Request());
  const ExpandedRequest expanded(path.request);
  const Scene& scene = expanded.Get().scene;
  const Increment& last = path.increments.back();
  const std::vector<SupportedNode> supports = SupportedNodes(scene);
  std::array<double, 3> sum = {};
  for (std::size_t i = 0; i < scene.solids[0].nodes.size(); ++i) {
    const double x = last.positions[2 * supports[i].node], y = last.positions[2 * supports[i].node + 1];
    double fx = last.supports[i].rx, fy = last.supports[i].ry;
    if (i == 0) {  // less what the bar pulls with
      const std::size_t free = NodeNumber(scene, "free");
      const double dx = last.positions[2 * free] - x, dy = last.positions[2 * free + 1] - y, l = std::hypot(dx, dy);
      const double N = l / std::hypot(5.0, 5.0) - 1.0;
      fx += N * dx / l;
      fy += N * dy / l;
    }
    sum[0] += fx * x;
    sum[1] += fy * y;
    sum[2] += fy * x;
  }
  const double initial = GetParam().nodes_per_element == 3 || GetParam().nodes_per_element == 6 ? 0.555 : 1.2;
  const double volume = 1.3 * 0.8 * kThickness * initial;
  EXPECT_NEAR(last.stresses[0].sxx, sum[0] / volume, 1e-10);
  EXPECT_NEAR(last.stresses[0].syy, sum[1] / volume, 1e-10);
  EXPECT_NEAR(last.stresses[0].sxy, sum[2] / volume, 1e-10);
}

std::string NameOfLaw(const testing::TestParamInfo<Law>& of) {
  return std::string(ToString(of.param.model)) + "_" + std::string(ToString(of.param.plane)) + "_" +
         std::to_string(of.param.nodes_per_element);
}

std::vector<Law> AllLaws() {
  std::vector<Law> laws;
  ForEachWord<MaterialModel>([&](std::string_view, MaterialModel model) {
    for (const PlaneState plane : {PlaneState::kStrain, PlaneState::kStress})
      for (const std::size_t nodes : {3U, 4U, 6U, 8U}) laws.push_back({model, plane, nodes});
  });
  return laws;
}

// In plane stress the thickness changes with the body; linear stresses are those of the shape at the start.
std::vector<Law> LawsOfBodies() {
  std::vector<Law> laws = AllLaws();
  laws.erase(std::remove_if(laws.begin(), laws.end(),
                            [](const Law& law) {
                              return law.plane == PlaneState::kStress || law.model == MaterialModel::kLinear;
                            }),
             laws.end());
  return laws;
}

INSTANTIATE_TEST_SUITE_P(Laws, StressPatch, testing::ValuesIn(AllLaws()), NameOfLaw);
INSTANTIATE_TEST_SUITE_P(Laws, StressAndForces, testing::ValuesIn(LawsOfBodies()), NameOfLaw);

// Recorded or not, sections and stresses are quantities; the columns are there where they are recorded.
TEST(Sections, AreQuantitiesWithoutBeingRecorded) {
  TraceRequest request = ReadExample("lee_frame");
  const ExpandedRequest expanded(request);
  const std::string name = ElementNames(expanded.Get().scene).SectionName(2);
  request.options.stop = {{name + ".M", ">", 5.0}, {name + ".M", "<", -5.0}};
  const TracedPath path = TraceIncrements(request);
  ASSERT_EQ(path.result.reason, EndReason::kStopCriterion);
  EXPECT_NEAR(std::abs(path.increments.back().sections[2].M), 5.0, 1e-10);
  std::ostringstream without, with;
  CsvWriter(request).WriteHeader(without);
  request.options.record = {"sections"};
  CsvWriter(request).WriteHeader(with);
  EXPECT_EQ(without.str().find("M_" + name), std::string::npos);
  EXPECT_NE(with.str().find(",M_" + name + ","), std::string::npos);
  EXPECT_EQ(FindQuantity("M_" + name, SceneIndex(expanded.Get().scene))->kind, Quantity::Kind::kM);
  EXPECT_EQ(FindQuantity(name + ".M1", SceneIndex(expanded.Get().scene))->kind, Quantity::Kind::kM1);
}

}  // namespace
}  // namespace contact_path::element_response_test
