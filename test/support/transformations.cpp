#include "support/transformations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "contact_path/scene/change_units.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/program.h"
#include "contact_path/scene/quantity.h"
#include "contact_path/scene/scaling.h"

namespace contact_path {
namespace {

void Turn(double cosine, double sine, double* x, double* y) {
  const double turned = cosine * *x - sine * *y;
  *y = sine * *x + cosine * *y;
  *x = turned;
}

// Applies a linear map of the plane to pairs of entries.
template <typename Map>
void ForEachPoint(std::vector<double>* components, Map map) {
  for (std::size_t i = 0; i + 1 < components->size(); i += 2) map(&(*components)[i], &(*components)[i + 1]);
}

// Q K Q' for the block-diagonal Q of the map.
template <typename Map>
void TransformStiffness(std::vector<double>* stiffness, std::size_t rows, Map map) {
  for (std::size_t column = 0; column < rows; ++column)
    for (std::size_t row = 0; row < rows; row += 2)
      map(&(*stiffness)[row * rows + column], &(*stiffness)[(row + 1) * rows + column]);
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t column = 0; column < rows; column += 2)
      map(&(*stiffness)[row * rows + column], &(*stiffness)[row * rows + column + 1]);
}

// Calls change(&loads, &support motions, &obstacle motions) for those of the scene and of each stage.
template <typename Change>
void ForEachLoading(TraceRequest* request, Change change) {
  Scene& scene = request->scene;
  change(&scene.loads, &scene.support_motions, &scene.obstacle_motions);
  for (Stage& stage : request->program) change(&stage.loads, &stage.support_motions, &stage.obstacle_motions);
}

template <typename Map>
void TransformRequest(TraceRequest* request, Map map) {
  Scene* const scene = &request->scene;
  ForEachLoading(request, [&](auto* loads, auto* supports, auto* obstacles) {
    for (Load& load : *loads) {
      map(&load.fx, &load.fy);
      map(&load.px, &load.py);
      map(&load.bx, &load.by);
    }
    for (SupportMotion& motion : *supports) map(&motion.dx, &motion.dy);
    for (ObstacleMotion& motion : *obstacles) {
      map(&motion.dx, &motion.dy);
      map(&motion.about_x, &motion.about_y);
    }
  });
  for (Node& node : scene->nodes) map(&node.x, &node.y);
  for (RigidBody& body : scene->bodies) map(&body.x, &body.y);
  for (Obstacle& obstacle : scene->obstacles) {
    map(&obstacle.px, &obstacle.py);
    map(&obstacle.nx, &obstacle.ny);
    ForEachPoint(&obstacle.points, map);
  }
  for (Superelement& part : scene->superelements) {
    TransformStiffness(&part.stiffness, 2 * part.nodes.size(), map);
    ForEachPoint(&part.rest_positions, map);
  }
}

bool IsPosition(const StopCriterion& criterion) {
  const Quantity::Kind kind = ReadQuantity(criterion.quantity)->kind;
  return kind == Quantity::Kind::kX || kind == Quantity::Kind::kY;
}

// Corners and mid-sides of each element the other way round, from the same first corner.
void TurnElementsRound(Solid* solid) {
  const auto size = static_cast<std::ptrdiff_t>(solid->NodesPerElement()), corners = size > 4 ? size / 2 : size;
  for (auto first = solid->nodes.begin(); first != solid->nodes.end(); first += size) {
    std::reverse(first + 1, first + corners);
    std::reverse(first + corners, first + size);
  }
}

// Each element from its next corner on.
void ShiftElements(Solid* solid) {
  const auto size = static_cast<std::ptrdiff_t>(solid->NodesPerElement()), corners = size > 4 ? size / 2 : size;
  for (auto first = solid->nodes.begin(); first != solid->nodes.end(); first += size) {
    std::rotate(first, first + 1, first + corners);
    if (size > corners) std::rotate(first + corners, first + corners + 1, first + size);
  }
}

// The order of the elements backwards.
void ReverseElements(Solid* solid) {
  const std::size_t size = solid->NodesPerElement();
  std::vector<std::string> nodes;
  for (std::size_t end = solid->nodes.size(); end > 0; end -= size)
    for (std::size_t i = end - size; i < end; ++i) nodes.push_back(solid->nodes[i]);
  solid->nodes = std::move(nodes);
}

// Reverses the values of the nodes of the scene, `each` for a node, those of the inner nodes of beams behind them, and
// those of bodies at the end.
void ReverseNodes(const Scene& scene, std::size_t each, std::vector<double>* values) {
  const auto nodes = values->begin() + static_cast<std::ptrdiff_t>(scene.nodes.size() * each),
             bodies = values->end() - static_cast<std::ptrdiff_t>(scene.bodies.size() * each);
  std::reverse(values->begin(), nodes);
  std::reverse(nodes, bodies);
  std::reverse(bodies, values->end());
  if (each == 2) ForEachPoint(values, [](double* y, double* x) { std::swap(*x, *y); });
}

// The name of an inner node of a beam that is walked the other way.
std::string FromOtherEnd(const std::string& node, const std::vector<Beam>& beams) {
  const std::size_t slash = node.find('/');
  if (slash == std::string::npos) return node;
  const std::string name = node.substr(0, slash);
  const auto beam = std::find_if(beams.begin(), beams.end(), [&](const Beam& any) { return any.name == name; });
  return name + "/" + std::to_string(BeamSegments(*beam) - std::stoi(node.substr(slash + 1)));
}

void FlipTangent(ContactRecord* contact) {
  contact->rt = -contact->rt;
  if (contact->state == ContactState::kSlipPlus)
    contact->state = ContactState::kSlipMinus;
  else if (contact->state == ContactState::kSlipMinus)
    contact->state = ContactState::kSlipPlus;
}

}  // namespace

TraceRequest ChangeUnits(TraceRequest request, double length, double force) {
  const UnitSizes sizes = {1.0 / length, 1.0 / force, 1.0};
  for (Solid& solid : request.scene.solids) solid.thickness = solid.Thickness();  // 0 is 1 in any unit
  ChangeUnits(&request, sizes);
  // The unit of a weight depends on what has it.
  ForEachLoading(&request, [&](auto* loads, auto*, auto*) {
    for (Load& load : *loads)
      for (double* const weight : {&load.bx, &load.by})
        *weight *= force / (load.solid.empty() ? load.beam.empty() ? 1.0 : length : std::pow(length, 3));
  });
  for (StopCriterion& criterion : request.options.stop)
    criterion.value /= SizeOf(UnitOf(ReadQuantity(criterion.quantity)->kind), sizes);
  return request;
}

TracedPath UndoUnits(TracedPath path, double length, double force) {
  for (Increment& increment : path.increments) {
    for (double& position : increment.positions) position /= length;
    for (ContactRecord& contact : increment.contacts) {
      contact.gap /= length;
      contact.rn /= force;
      contact.rt /= force;
    }
    for (Resultant& pin : increment.pins) pin = {pin.rx / force, pin.ry / force, pin.rm / (force * length)};
    for (double* work : {&increment.dissipation, &increment.strain_energy, &increment.external_work})
      *work /= length * force;
  }
  return path;
}

TraceRequest Rotate(TraceRequest request, double angle) {
  for (const Node& node : request.scene.nodes)
    if (node.fixed_x != node.fixed_y) throw std::invalid_argument(node.name + " is held along one axis only");
  for (const StopCriterion& criterion : request.options.stop)
    if (IsPosition(criterion)) throw std::invalid_argument("the stop criterion looks at " + criterion.quantity);
  const double cosine = std::cos(angle), sine = std::sin(angle);
  TransformRequest(&request, [=](double* x, double* y) { Turn(cosine, sine, x, y); });
  return request;
}

TracedPath UndoRotation(TracedPath path, double angle) {
  const double cosine = std::cos(angle), sine = std::sin(-angle);
  for (Increment& increment : path.increments) {
    ForEachPoint(&increment.positions, [=](double* x, double* y) { Turn(cosine, sine, x, y); });
    for (Resultant& pin : increment.pins) Turn(cosine, sine, &pin.rx, &pin.ry);
  }
  return path;
}

TraceRequest Mirror(TraceRequest request) {
  TransformRequest(&request, [](double* x, double*) { *x = -*x; });
  ForEachLoading(&request, [](auto* loads, auto* supports, auto* obstacles) {
    for (Load& load : *loads) load.moment = -load.moment;
    for (SupportMotion& motion : *supports) motion.rotation = -motion.rotation;
    for (ObstacleMotion& motion : *obstacles) motion.turn = -motion.turn;
  });
  for (Obstacle& obstacle : request.scene.obstacles) {  // the admissible side stays on the left
    std::reverse(obstacle.points.begin(), obstacle.points.end());
    ForEachPoint(&obstacle.points, [](double* y, double* x) { std::swap(*x, *y); });
  }
  for (Beam& beam : request.scene.beams) beam.angle = -beam.angle;
  for (Pin& pin : request.scene.pins) pin.angle = -pin.angle;
  for (Tendon& tendon : request.scene.tendons)
    for (double& turns : tendon.turns) turns = -turns;
  for (Solid& solid : request.scene.solids) TurnElementsRound(&solid);
  for (BoundarySurface& surface : request.scene.surfaces) std::reverse(surface.nodes.begin(), surface.nodes.end());
  for (StopCriterion& criterion : request.options.stop) {
    const Quantity::Kind kind = ReadQuantity(criterion.quantity)->kind;
    if (kind != Quantity::Kind::kX && kind != Quantity::Kind::kRotation && kind != Quantity::Kind::kRt) continue;
    criterion.value = -criterion.value;
    criterion.when = criterion.when == ">" ? "<" : ">";
  }
  return request;
}

TracedPath UndoMirror(TracedPath path) {
  for (Increment& increment : path.increments) {
    ForEachPoint(&increment.positions, [](double* x, double*) { *x = -*x; });
    for (double& rotation : increment.rotations) rotation = -rotation;
    for (ContactRecord& contact : increment.contacts) FlipTangent(&contact);
    for (Resultant& pin : increment.pins) pin = {-pin.rx, pin.ry, -pin.rm};
  }
  return path;
}

TraceRequest Reverse(TraceRequest request) {
  Scene& scene = request.scene;
  const auto turn_round = [](auto&... lists) { (std::reverse(lists.begin(), lists.end()), ...); };
  turn_round(scene.nodes, scene.bodies, scene.bars, scene.tendons, scene.pins, scene.superelements, scene.beams,
             scene.materials, scene.solids, scene.obstacles, scene.contacts);
  ForEachLoading(&request,
                 [&](auto* loads, auto* supports, auto* obstacles) { turn_round(*loads, *supports, *obstacles); });
  for (Group& group : scene.groups) {
    std::reverse(group.nodes.begin(), group.nodes.end());
    for (std::string& node : group.nodes) node = FromOtherEnd(node, scene.beams);
  }
  for (BoundarySurface& surface : scene.surfaces)
    for (std::string& node : surface.nodes) node = FromOtherEnd(node, scene.beams);
  for (Bar& bar : scene.bars) std::reverse(bar.nodes.begin(), bar.nodes.end());
  for (Tendon& tendon : scene.tendons) {
    turn_round(tendon.nodes, tendon.radii, tendon.turns);
    for (double& turns : tendon.turns) turns = -turns;
  }
  for (Pin& pin : scene.pins) {
    std::reverse(pin.nodes.begin(), pin.nodes.end());
    pin.angle = -pin.angle;
  }
  for (Beam& beam : scene.beams) {
    turn_round(beam.nodes, beam.hinged);
    beam.angle = -beam.angle;
  }
  for (Solid& solid : scene.solids) {
    ReverseElements(&solid);
    ShiftElements(&solid);
  }
  for (Superelement& part : scene.superelements) {
    const std::size_t nodes = part.nodes.size();
    turn_round(part.nodes, part.rest_positions);
    ForEachPoint(&part.rest_positions, [](double* y, double* x) { std::swap(*x, *y); });
    const std::vector<double> stiffness = part.stiffness;
    const auto moved = [&](std::size_t i) { return 2 * (nodes - 1 - i / 2) + i % 2; };
    for (std::size_t i = 0; i < 2 * nodes; ++i)
      for (std::size_t j = 0; j < 2 * nodes; ++j)
        part.stiffness[moved(i) * 2 * nodes + moved(j)] = stiffness[i * 2 * nodes + j];
  }
  return request;
}

TracedPath UndoReversal(TracedPath path) {
  const Scene& scene = path.request.scene;
  for (Increment& increment : path.increments) {
    ReverseNodes(scene, 2, &increment.positions);
    if (!increment.rotations.empty()) ReverseNodes(scene, 1, &increment.rotations);
    std::reverse(increment.contacts.begin(), increment.contacts.end());
    std::reverse(increment.bars.begin(), increment.bars.end());
    std::reverse(increment.pins.begin(), increment.pins.end());
    for (Resultant& pin : increment.pins) pin = {-pin.rx, -pin.ry, -pin.rm};
  }
  return path;
}

void ExpectSamePath(const TracedPath& actual, const TracedPath& expected, double tolerance) {
  const ExpandedRequest expanded(expected.request);
  const Scaling scaling = StageScales(expanded.Get(), 0);
  const double length = tolerance * scaling.length, force = tolerance * scaling.force;
  const double energy = tolerance * scaling.length * scaling.force;
  EXPECT_EQ(ToString(actual.result.reason), ToString(expected.result.reason));
  ASSERT_EQ(actual.increments.size(), expected.increments.size());
  for (std::size_t i = 0; i < expected.increments.size(); ++i) {
    const Increment &a = actual.increments[i], &e = expected.increments[i];
    SCOPED_TRACE("increment " + std::to_string(i));
    const std::size_t stage = e.stage > 0 ? static_cast<std::size_t>(e.stage) - 1 : 0;
    EXPECT_NEAR(a.load_factor, e.load_factor, tolerance * StageScales(expanded.Get(), stage).load_factor);
    EXPECT_NEAR(a.arc_length, e.arc_length, tolerance);
    EXPECT_EQ(ToString(a.kind), ToString(e.kind));
    ASSERT_EQ(a.positions.size(), e.positions.size());
    for (std::size_t k = 0; k < e.positions.size(); ++k) EXPECT_NEAR(a.positions[k], e.positions[k], length) << k;
    ASSERT_EQ(a.rotations.size(), e.rotations.size());
    for (std::size_t k = 0; k < e.rotations.size(); ++k) EXPECT_NEAR(a.rotations[k], e.rotations[k], tolerance) << k;
    ASSERT_EQ(a.contacts.size(), e.contacts.size());
    for (std::size_t k = 0; k < e.contacts.size(); ++k) {
      EXPECT_EQ(ToString(a.contacts[k].state), ToString(e.contacts[k].state)) << k;
      EXPECT_NEAR(a.contacts[k].gap, e.contacts[k].gap, length) << k;
      EXPECT_NEAR(a.contacts[k].rn, e.contacts[k].rn, force) << k;
      EXPECT_NEAR(a.contacts[k].rt, e.contacts[k].rt, force) << k;
    }
    ASSERT_EQ(a.pins.size(), e.pins.size());
    for (std::size_t k = 0; k < e.pins.size(); ++k) {
      EXPECT_NEAR(a.pins[k].rx, e.pins[k].rx, force) << k;
      EXPECT_NEAR(a.pins[k].ry, e.pins[k].ry, force) << k;
      EXPECT_NEAR(a.pins[k].rm, e.pins[k].rm, energy) << k;
    }
    EXPECT_NEAR(a.dissipation, e.dissipation, energy);
    EXPECT_NEAR(a.strain_energy, e.strain_energy, energy);
    EXPECT_NEAR(a.external_work, e.external_work, energy);
    if (testing::Test::HasFailure()) return;  // the rest only repeats it
  }
}

void ExpectSameInOtherWords(const TraceRequest& request, const TracedPath& path, double tolerance) {
  ExpectSamePath(UndoUnits(TraceIncrements(ChangeUnits(request, 1e-3, 1e6)), 1e-3, 1e6), path, tolerance);
  ExpectSamePath(UndoReversal(TraceIncrements(Reverse(request))), path, tolerance);
  ExpectSamePath(UndoMirror(TraceIncrements(Mirror(request))), path, tolerance);
}

}  // namespace contact_path
