// Beams: slender and stocky ones, soft ones beside stiff ones, a frame on rough feet.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "extremes/extreme_case.h"
#include "support/beams.h"
#include "support/traced_path.h"

namespace contact_path {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kSegments = 10;

// Clamped at (0, 0), of length 1 along x.
Scene Cantilever(double EA, double EI) {
  Scene scene;
  scene.nodes = {{"root", 0.0, 0.0, true, true, true}, {"tip", 1.0, 0.0}};
  scene.beams = {Between("leg", "root", "tip", EA, EI, kSegments)};
  return scene;
}

struct BeamNode {
  double x, y, rotation;
};

// The node of the cantilever with this number from its root.
BeamNode NodeOf(const Increment& increment, std::size_t number) {
  const std::size_t node = number == 0 ? 0 : number == kSegments ? 1 : number + 1;
  return {increment.positions[2 * node], increment.positions[2 * node + 1], increment.rotations[node]};
}

double Distance(const BeamNode& a, const BeamNode& b) {
  return Largest({a.x - b.x, a.y - b.y, a.rotation - b.rotation});
}

// The nodes from the tip to the root by the equations of one segment after the other: the force (fx, fy) goes through
// all of them, and each turns its chord so that the moments at its ends fit its rotations there.
std::vector<BeamNode> FromTheTip(BeamNode node, double EA, double EI, double fx, double fy) {
  constexpr int kIterations = 80;
  const double length = 1.0 / kSegments;
  std::vector<BeamNode> nodes = {node};
  double outer = 0.0;  // moment on the outer end of the segment
  for (int i = 0; i < kSegments; ++i) {
    double chord = node.rotation, l = length, inner = 0.0;
    for (int k = 0; k < kIterations; ++k) {
      l = length * (1.0 + (fx * std::cos(chord) + fy * std::sin(chord)) / EA);
      inner = -outer - l * (fy * std::cos(chord) - fx * std::sin(chord));
      chord = node.rotation - length / (6.0 * EI) * (2.0 * outer - inner);
    }
    node = {node.x - l * std::cos(chord), node.y - l * std::sin(chord),
            chord + length / (6.0 * EI) * (2.0 * inner - outer)};
    nodes.push_back(node);
    outer = -inner;
  }
  return nodes;
}

// A dead load across the tip, up to the tenfold of EI / L^2.
ExtremeCase BentCantilever(double ratio) {
  ExtremeCase extreme{"slenderness of a cantilever bent by a dead load", "EA L^2 / EI = " + Text(ratio)};
  Scene scene = Cantilever(ratio, 1.0);
  scene.loads = {{"tip", 0.0, 1.0}};
  extreme.request = Until(scene, "load_factor", ">", 10.0);
  extreme.exact = "the same segments one after the other, from the tip to the root";
  // Coordinates are rounded: that alone changes the axial forces by EA eps.
  extreme.allowed = std::max(1e-9, 1e-15 * ratio);
  extreme.allowed_regularised = std::max(1e-3, extreme.allowed);
  if (ratio > 1e9) extreme.ends = {"step_too_small", "not_determined"};
  extreme.error = [ratio](const TraceRequest&, const Increment& increment) {
    const std::vector<BeamNode> nodes =
        FromTheTip(NodeOf(increment, kSegments), ratio, 1.0, 0.0, increment.load_factor);
    double error = 0.0;
    for (std::size_t i = 0; i <= kSegments; ++i)
      error = std::max(error, Distance(nodes[i], NodeOf(increment, kSegments - i)));
    return error;
  };
  return extreme;
}

// A moment at the tip bends every segment by the same angle and stretches none of them.
ExtremeCase RolledUp(double slenderness) {
  const double EA = 12.0 * slenderness * slenderness;
  ExtremeCase extreme{"slenderness of a cantilever rolled up by a moment", "L / h = " + Text(slenderness)};
  Scene scene = Cantilever(EA, 1.0);
  scene.loads = {{"tip", 0.0, 0.0, false, 2.0 * kPi}};
  extreme.request = Until(scene, "tip.rotation", ">", 2.0 * kPi);
  extreme.exact = "closed form";
  extreme.allowed = std::max(1e-9, 1e-15 * EA);
  extreme.allowed_regularised = std::max(1e-3, extreme.allowed);
  if (EA > 1e9) extreme.ends = {"step_too_small", "not_determined"};
  extreme.error = [](const TraceRequest&, const Increment& increment) {
    const double turn = 2.0 * kPi * increment.load_factor / kSegments;
    BeamNode node = {0.0, 0.0, 0.0};
    double error = 0.0;
    for (std::size_t i = 1; i <= kSegments; ++i) {
      node.x += std::cos(node.rotation + 0.5 * turn) / kSegments;
      node.y += std::sin(node.rotation + 0.5 * turn) / kSegments;
      node.rotation += turn;
      error = std::max(error, Distance(node, NodeOf(increment, i)));
    }
    return error;
  };
  return extreme;
}

// A soft beam between the support and a stiff one; a moment at the tip goes through both.
ExtremeCase SoftBeforeStiff(double ratio) {
  const double soft = 1.0 / std::sqrt(ratio), stiff = std::sqrt(ratio);
  ExtremeCase extreme{"beams of different EI in a row", "ratio " + Text(ratio)};
  Scene scene = Cantilever(1e2 * soft, soft);
  scene.nodes.push_back({"end", 2.0, 0.0});
  Beam beam = scene.beams[0];
  beam.name = "stiff";
  beam.nodes = {"tip", "end"};
  beam.EA = 1e2 * stiff;
  beam.EI = stiff;
  beam.segments = 2;
  scene.beams.push_back(beam);
  scene.loads = {{"end", 0.0, 0.0, false, soft}};
  extreme.request = Until(scene, "end.rotation", ">", 3.0);
  extreme.exact = "closed form";
  if (ratio > 1e5) extreme.ends = {"step_too_small", "not_determined", "numerical_failure"};
  extreme.error = [soft, stiff](const TraceRequest&, const Increment& increment) {
    double x = 0.0, y = 0.0, rotation = 0.0;
    const auto add = [&](int segments, double EI) {
      const double turn = soft * increment.load_factor / (EI * segments);
      for (int i = 0; i < segments; ++i, rotation += turn) {
        x += std::cos(rotation + 0.5 * turn) / segments;
        y += std::sin(rotation + 0.5 * turn) / segments;
      }
    };
    add(kSegments, soft);
    add(2, stiff);
    return Largest({increment.positions[4] - x, increment.positions[5] - y, increment.rotations[2] - rotation});
  };
  extreme.allowed = std::max(1e-9, 1e-14 * ratio);
  extreme.allowed_regularised = std::max(1e-3, extreme.allowed);
  return extreme;
}

// A straight column under its axial load, beyond the load at which it could buckle.
ExtremeCase Column(double slenderness) {
  const double EA = 12.0 * slenderness * slenderness;
  ExtremeCase extreme{"slenderness of a straight column", "L / h = " + Text(slenderness)};
  Scene scene = Cantilever(EA, 1.0);
  scene.loads = {{"tip", -1.0, 0.0}};
  extreme.request = Until(scene, "load_factor", ">", 3.0);
  extreme.exact = "closed form";
  if (EA > 1e9) extreme.ends = {"step_too_small", "not_determined"};
  extreme.error = [EA](const TraceRequest&, const Increment& increment) {
    const BeamNode tip = NodeOf(increment, kSegments);
    return Distance(tip, {1.0 - increment.load_factor / EA, 0.0, 0.0});
  };
  return extreme;
}

// scenes/portal_frame.yaml with other axial stiffnesses.
ExtremeCase PortalFrame(double EA) {
  ExtremeCase extreme{"frame that slides on rough feet", "EA L^2 / EI = " + Text(EA * 16.0 / 100.0)};
  extreme.request = ReadExample("portal_frame");
  for (Beam& beam : extreme.request.scene.beams) beam.EA = EA;
  if (EA > 1e8) extreme.ends = {"step_too_small", "not_determined", "numerical_failure"};
  return extreme;
}

}  // namespace

void AddFrameCases(std::vector<ExtremeCase>* cases) {
  for (const double ratio : {1e2, 1e4, 1e6, 1e8, 1e10, 1e12}) cases->push_back(BentCantilever(ratio));
  for (const double slenderness : {1e1, 1e2, 1e3, 1e4, 1e5, 1e6}) cases->push_back(RolledUp(slenderness));
  for (const double slenderness : {1e1, 1e3, 1e6}) cases->push_back(Column(slenderness));
  for (const double ratio : {1.0, 1e4, 1e8, 1e10}) cases->push_back(SoftBeforeStiff(ratio));
  for (const double EA : {1e3, 1e5, 1e7, 1e9}) cases->push_back(PortalFrame(EA));
}

}  // namespace contact_path
