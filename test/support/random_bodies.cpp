#include "support/random_bodies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "support/beams.h"
#include "support/solid_grid.h"

namespace contact_path {
namespace {

constexpr double kWidth = 2.0;      // of the lower body, from x = 0 on
constexpr double kMostDrag = 0.35;  // so far does no candidate leave the lower body

// What the other body can touch, from left to right, and what moves the body.
struct Body {
  std::vector<std::string> edge;    // the nodes that face the other body
  std::vector<std::string> around;  // of the upper body as a surface: none that is moved is among them
  std::vector<std::string> driven;  // of the upper body
  double reach = 0.0;               // y of the node of the edge that is nearest to the other body
  double radius = 0.0;              // of the edge as a surface
};

class Builder {
 public:
  explicit Builder(Decisions* random) : random_(*random) {}

  TraceRequest Build(const std::string& name) {
    request_.scene.name = name;
    const double stiffness = std::pow(10.0, random_.Number(-0.5, 0.5));
    const Body lower = random_.Chance(0.7) ? LowerBlock() : LowerArch();
    Body upper = random_.Chance(0.75) ? UpperBlock(stiffness) : UpperArch(stiffness);
    const double gap = random_.Chance(0.3) ? 0.002 : random_.Number(0.01, 0.08);
    RaiseUpper(lower.reach + lower.radius + gap - upper.reach);
    AddContacts(lower, upper);
    AddProgram(upper, gap, stiffness);
    return std::move(request_);
  }

 private:
  Scene& scene() { return request_.scene; }

  static std::string NameOf(char body, int i, int j) {
    return std::string(1, body) + std::to_string(i) + "_" + std::to_string(j);
  }

  // nx by ny quadrilaterals from (x, 0) on; their inner edges and, but for flat ones, the outer ones are uneven. j = 0
  // is the lower edge.
  void AddBlock(char body, int nx, int ny, double x, double width, double height, double stiffness) {
    const double dx = width / nx, dy = height / ny, uneven = random_.Chance(0.3) ? 0.0 : 0.12;
    first_of_upper_ = scene().nodes.size();
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i) {
        const double aside = i > 0 && i < nx ? random_.Number(-uneven, uneven) : 0.0;
        scene().nodes.push_back(
            {NameOf(body, i, j), x + dx * (i + aside), dy * (j + random_.Number(-uneven, uneven)), false, false});
      }
    const MaterialModel model = random_.OneOf(
        std::array<MaterialModel, 3>{MaterialModel::kNeoHookean, MaterialModel::kNeoHookean, MaterialModel::kLinear});
    const Material material =
        ElasticMaterial(std::string(1, body) + "_stuff", stiffness, random_.Number(0.0, 0.4), model);
    Solid solid = SolidOf(material.name);
    solid.name = std::string(1, body);
    solid.plane = random_.Chance(0.5) ? PlaneState::kStrain : PlaneState::kStress;
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        for (const auto& [di, dj] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)})
          solid.nodes.push_back(NameOf(body, i + di, j + dj));
    scene().materials.push_back(material);
    scene().solids.push_back(std::move(solid));
  }

  // Between (x, 0) and (x + width, 0), > 0 turned to the left: hanging.
  void AddArch(char body, int segments, double x, double width, double angle, double EA) {
    first_of_upper_ = scene().nodes.size();
    scene().nodes.push_back({NameOf(body, 0, 0), x, 0.0, true, true, true});
    scene().nodes.push_back({NameOf(body, 1, 0), x + width, 0.0, true, true, true});
    scene().beams.push_back(Between(std::string(1, body), NameOf(body, 0, 0), NameOf(body, 1, 0), EA,
                                    EA * std::pow(10.0, random_.Number(-3.5, -2.0)), segments, angle));
  }

  Node& NodeOf(const std::string& name) {
    return *std::find_if(scene().nodes.begin(), scene().nodes.end(),
                         [&](const Node& node) { return node.name == name; });
  }

  Body LowerBlock() {
    const int nx = 3 + static_cast<int>(random_.Index(2)), ny = 1 + static_cast<int>(random_.Index(2));
    AddBlock('b', nx, ny, 0.0, kWidth, 0.4 * ny, 1.0);
    Body body;
    body.reach = -1.0;
    for (int i = 0; i <= nx; ++i) {
      Node& base = NodeOf(NameOf('b', i, 0));
      base.fixed_x = base.fixed_y = true;
      body.edge.push_back(NameOf('b', i, ny));
      body.reach = std::max(body.reach, NodeOf(body.edge.back()).y);
    }
    return body;
  }

  Body LowerArch() {
    const int segments = 4 + static_cast<int>(random_.Index(4));
    const double turn = random_.Number(0.3, 1.5);
    AddArch('b', segments, 0.0, kWidth, -turn, 10.0);
    Body body;
    body.edge = EdgeOfArch('b', segments);
    body.reach = 0.5 * kWidth * std::tan(0.25 * turn);
    body.radius = random_.Chance(0.5) ? 0.0 : 0.05;
    return body;
  }

  std::vector<std::string> EdgeOfArch(char body, int segments) const {
    std::vector<std::string> nodes = {NameOf(body, 0, 0)};
    for (int i = 1; i < segments; ++i) nodes.push_back(std::string(1, body) + "/" + std::to_string(i));
    nodes.push_back(NameOf(body, 1, 0));
    return nodes;
  }

  // In the middle of the lower body, with room to be dragged.
  Body UpperBlock(double stiffness) {
    const int nx = 2, ny = 1 + static_cast<int>(random_.Index(2));
    const double width = random_.Number(0.6, 0.9), x = random_.Number(0.5, 1.5 - width);
    AddBlock('u', nx, ny, x, width, 0.35 * ny, stiffness);
    Body body;
    body.reach = 1.0;
    for (int i = 0; i <= nx; ++i) {
      body.edge.push_back(NameOf('u', i, 0));
      body.driven.push_back(NameOf('u', i, ny));
      body.reach = std::min(body.reach, NodeOf(body.edge.back()).y);
    }
    body.around = body.edge;
    if (ny > 1) {
      body.around.insert(body.around.begin(), NameOf('u', 0, 1));
      body.around.push_back(NameOf('u', nx, 1));
    }
    return body;
  }

  Body UpperArch(double stiffness) {
    const int segments = 4 + static_cast<int>(random_.Index(3));
    const double width = random_.Number(0.6, 1.0), turn = random_.Number(1.0, 2.5);
    AddArch('u', segments, random_.Number(0.5, 1.5 - width), width, turn, 10.0 * stiffness);
    Body body;
    const std::vector<std::string> nodes = EdgeOfArch('u', segments);
    body.edge.assign(nodes.begin() + 1, nodes.end() - 1);
    body.around = body.edge;
    body.driven = {nodes.front(), nodes.back()};
    body.reach = -0.5 * width * std::tan(0.25 * turn);
    return body;
  }

  void RaiseUpper(double by) {
    for (std::size_t i = first_of_upper_; i < scene().nodes.size(); ++i) scene().nodes[i].y += by;
  }

  // The admissible side of a surface is on its left: below the upper body its nodes go from right to left.
  void AddContacts(const Body& lower, const Body& upper) {
    const double friction = random_.Chance(0.2) ? 0.0 : random_.Number(0.1, 1.0);
    const auto touch = [&](const Body& body, const std::string& group, const std::string& surface) {
      scene().groups.push_back({group, body.edge});
      scene().contacts.push_back({"", "", group, surface, friction});
    };
    scene().surfaces.push_back({"table", lower.edge, false, lower.radius});
    touch(upper, "sole", "table");
    if (!random_.Chance(0.15)) return;
    scene().surfaces.push_back({"bottom", {upper.around.rbegin(), upper.around.rend()}});
    touch(lower, "of_table", "bottom");
  }

  void AddProgram(const Body& upper, double gap, double stiffness) {
    const bool hangs = !scene().solids.empty() && scene().solids.back().name == "u" && random_.Chance(0.3);
    const double press = gap + random_.Number(0.02, 0.1);
    const double drag = random_.Number(0.1, kMostDrag) * (random_.Chance(0.5) ? 1.0 : -1.0);
    const double spring = 0.1 * stiffness;  // of each node that hangs
    const auto add = [&](const std::string& name, double dx, double dy) {
      Stage stage;
      stage.name = name;
      for (const std::string& node : upper.driven) {
        if (hangs)
          stage.loads.push_back({node, spring * dx, spring * dy});
        else
          stage.support_motions.push_back({node, dx, dy});
      }
      request_.program.push_back(std::move(stage));
    };
    for (const std::string& name : upper.driven) {
      if (hangs)
        scene().superelements.push_back({{name}, {spring, 0.0, 0.0, spring}});
      else
        NodeOf(name).fixed_x = NodeOf(name).fixed_y = true;
    }
    add("press", 0.0, -(hangs ? 2.0 : 1.0) * press);
    add("drag", drag, 0.0);
    if (random_.Chance(0.3)) add("lift", 0.0, 2.0 * press);
  }

  Decisions& random_;
  TraceRequest request_;
  std::size_t first_of_upper_ = 0;  // node, when the upper body is there
};

}  // namespace

TraceRequest RandomBodies(unsigned seed) {
  Decisions decisions{SplitMix64(seed)};
  return RandomBodies(&decisions, "bodies_" + std::to_string(seed));
}

TraceRequest RandomBodies(Decisions* decisions, const std::string& name) { return Builder(decisions).Build(name); }

}  // namespace contact_path
