// The request of a trace as plain data: an elastic plane structure, its loads, its obstacles, and the options.
//
// Any consistent set of units: [length], [force]; the load factor has no unit. Names tie the parts together and are
// unique within their list. The structs hold what the user wrote; nothing is checked or normalised here (validate.h).
//
// Each struct is followed by the description of its fields (field.h). A new field is a member and its description here;
// a new kind of part is a struct with its description and a list in Scene (an element also in ForEachElementList()).
// scripts/messages adds both to the messages, and to the Python package.
// Bars, tendons, pins and beams are in slender_parts.h, solids and surfaces in solid_parts.h, options in
// trace_options.h.
#ifndef CONTACT_PATH_SCENE_SCENE_H_
#define CONTACT_PATH_SCENE_SCENE_H_

#include <string>
#include <tuple>
#include <vector>

#include "contact_path/scene/field.h"
#include "contact_path/scene/slender_parts.h"
#include "contact_path/scene/solid_parts.h"
#include "contact_path/scene/trace_options.h"
#include "contact_path/scene/words.h"

namespace contact_path {

// The admissible side is on the left of a curve that is walked from its first point to its last one.
enum class ObstacleShape {
  kHalfPlane,
  kCircle,
  kPolyline,  // with rounded corners
  kSpline,    // the cubic through its points with continuous curvature (geometry/point_curves.h)
};
constexpr auto WordsOf(ObstacleShape) { return WordList("half_plane", "circle", "polyline", "spline"); }

struct Node {
  std::string name;
  double x = 0.0;  // initial position [length]
  double y = 0.0;
  bool fixed_x = false;
  bool fixed_y = false;
  bool fixed_rotation = false;  // only where a beam turns the node
  std::string body = {};        // moves with it; then nothing of the node is fixed by itself

  // In an expanded scene: the node of a body, at the same place, to which this one is pinned. No field.
  std::string twin_of = {};
};

template <typename P>
constexpr auto Fields(Of<Node>) {
  return std::tuple(Member("name", &P::name).Naming(TextKind::kNewName), Member("x", &P::x).In(units::kLength),
                    Member("y", &P::y).In(units::kLength), Member("fixed_x", &P::fixed_x),
                    Member("fixed_y", &P::fixed_y), Member("fixed_rotation", &P::fixed_rotation),
                    Member("body", &P::body));
}

// Rigid body: x, y and the rotation of a reference point are its unknowns. Nodes that move with it hold it to elements
// and contacts.
struct RigidBody {
  std::string name;
  double x = 0.0;  // initial position of the reference point [length]
  double y = 0.0;
  bool fixed_x = false;
  bool fixed_y = false;
  bool fixed_rotation = false;
};

template <typename P>
constexpr auto Fields(Of<RigidBody>) {
  return std::tuple(Member("name", &P::name).Naming(TextKind::kNewName), Member("x", &P::x).In(units::kLength),
                    Member("y", &P::y).In(units::kLength), Member("fixed_x", &P::fixed_x),
                    Member("fixed_y", &P::fixed_y), Member("fixed_rotation", &P::fixed_rotation));
}

// Nodes with a name of their own. A beam is a group, too: of all its nodes, from the first to the second.
struct Group {
  std::string name;
  std::vector<std::string> nodes;
};

template <typename P>
constexpr auto Fields(Of<Group>) {
  return std::tuple(Member("name", &P::name).Naming(TextKind::kNewName),
                    Member("nodes", &P::nodes).Naming(TextKind::kNode));
}

// Dead load: on a node, or on each node of a group, on a body, as a traction on a beam or a surface, or as the weight
// of a solid, a beam or a body.
struct Load {
  std::string node;
  double fx = 0.0;  // [force], per unit of the load factor unless constant
  double fy = 0.0;
  bool constant = false;   // true: not scaled by the load factor
  double moment = 0.0;     // counterclockwise [force length]; only where a beam turns the node
  std::string group = {};  // in place of node: fx, fy and moment act on each of its nodes; px and py need a beam
  double px = 0.0;         // traction per initial length of the axis or the boundary [force/length]
  double py = 0.0;
  std::string surface = {};  // in place of node: px and py act on it
  std::string body = {};     // in place of node: fx and fy act on its reference point
  // Weight of what is named in place of node: per initial volume of a solid [force/length^3], per initial length of the
  // axis of a beam [force/length], of a body the whole force, which acts on its reference point [force].
  double bx = 0.0;
  double by = 0.0;
  std::string solid = {};
  std::string beam = {};
};

template <typename P>
constexpr auto Fields(Of<Load>) {
  return std::tuple(Member("node", &P::node).Naming(TextKind::kNode), Member("fx", &P::fx).In(units::kForceRate),
                    Member("fy", &P::fy).In(units::kForceRate), Member("constant", &P::constant),
                    Member("moment", &P::moment).In(units::kMomentRate), Member("group", &P::group),
                    Member("px", &P::px).In(units::kTractionRate), Member("py", &P::py).In(units::kTractionRate),
                    Member("surface", &P::surface), Member("body", &P::body), Member("bx", &P::bx),
                    Member("by", &P::by), Member("solid", &P::solid), Member("beam", &P::beam));
}

// Rigid obstacle. A half plane admits the points x with n . (x - p) >= 0. The tangent of any shape is t = (n_y, -n_x).
struct Obstacle {
  std::string name;
  ObstacleShape shape = ObstacleShape::kHalfPlane;
  double px = 0.0;  // p: a point of the half plane's boundary, the centre of a circle, where `points` are counted from
  double py = 0.0;  // [length]
  double nx = 0.0;  // normal towards the admissible side, of any length > 0
  double ny = 0.0;
  double friction = 0.0;            // Coulomb's coefficient, >= 0; 0 = frictionless
  double radius = 0.0;              // of a circle [length], > 0
  bool inside = false;              // admissible side of a circle
  std::vector<double> points = {};  // of a polyline or a spline: x, y, x, y, ... [length]
  bool closed = false;              // from the last point back to the first
  double fillet = 0.0;  // radius at the corners of a polyline [length]; 0 = a tenth of the largest that its edges admit
  std::string body = {};  // carries it, from where both are at the start
  // By point of a polyline, in place of `fillet`: the radius at its corner [length]; 0 = as where nothing is given. The
  // ends of an open polyline have no corner.
  std::vector<double> fillets = {};
};

template <typename P>
constexpr auto Fields(Of<Obstacle>) {
  return std::tuple(
      Member("name", &P::name).Naming(TextKind::kNewName), Member("shape", &P::shape),
      Member("px", &P::px).In(units::kLength), Member("py", &P::py).In(units::kLength), Member("nx", &P::nx),
      Member("ny", &P::ny), Member("friction", &P::friction).Within(Range::kNotNegative),
      Member("radius", &P::radius).In(units::kLength).Within(Range::kZeroOrPositive), Member("inside", &P::inside),
      Member("points", &P::points).In(units::kLength), Member("closed", &P::closed),
      Member("fillet", &P::fillet).In(units::kLength).Within(Range::kZeroOrPositive), Member("body", &P::body),
      Member("fillets", &P::fillets).In(units::kLength).Within(Range::kZeroOrPositive));
}

// What is done about an overlap at the start.
enum class Overlap {
  kRefuse,
  kBringOn,  // taken back from 1 to 0 while constant loads are brought on: a fit
};
constexpr auto WordsOf(Overlap) { return WordList("refuse", "bring_on"); }

// A node that may touch an obstacle or a surface, or each node of a group; or a circle that a body carries, which rolls
// or slides on another obstacle. The name of a candidate is "<node>@<obstacle>", "<node>@<surface>" or
// "<circle>@<obstacle>".
struct ContactCandidate {
  std::string node;
  std::string obstacle;
  std::string group = {};                   // in place of node
  std::string surface = {};                 // in place of obstacle
  double friction = 0.0;                    // Coulomb's coefficient; with an obstacle, <= 0: that of the obstacle
  std::vector<std::string> obstacles = {};  // in place of node and obstacle: the circle, and what it may touch
  Overlap overlap = Overlap::kRefuse;

  // While constant loads are brought on: the gap is more by overlap_at_0 + overlap_rate * load factor [length]. No
  // fields.
  double overlap_at_0 = 0.0;
  double overlap_rate = 0.0;
  // In an expanded scene: the node is that of what has slid through an eye of a tendon, `obstacle` names the eye. No
  // field.
  bool at_eye = false;
  // In an expanded scene: the node of a body to which the node is pinned. No field.
  std::string twin_of = {};

  bool OnSurface() const { return !surface.empty(); }
  bool Rolls() const { return !obstacles.empty(); }
  double FrictionWith(const Obstacle& partner) const { return friction > 0.0 ? friction : partner.friction; }
  std::string Name() const {
    const std::string& of = twin_of.empty() ? node : twin_of;
    return (Rolls() ? obstacles.front() : of) + "@" + (OnSurface() ? surface : Rolls() ? obstacles.back() : obstacle);
  }
};

template <typename P>
constexpr auto Fields(Of<ContactCandidate>) {
  return std::tuple(Member("node", &P::node).Naming(TextKind::kNode),
                    Member("obstacle", &P::obstacle).Naming(TextKind::kObstacle).OrNone(), Member("group", &P::group),
                    Member("surface", &P::surface), Member("friction", &P::friction),
                    Member("obstacles", &P::obstacles).Naming(TextKind::kObstacle), Member("overlap", &P::overlap));
}

// Fixes a node besides what the node itself says, or each node of a group.
struct Support {
  std::string node;
  std::string group;  // in place of node
  bool fixed_x = false;
  bool fixed_y = false;
  bool fixed_rotation = false;  // only where a beam turns the node
};

template <typename P>
constexpr auto Fields(Of<Support>) {
  return std::tuple(Member("node", &P::node).Naming(TextKind::kNode), Member("group", &P::group),
                    Member("fixed_x", &P::fixed_x), Member("fixed_y", &P::fixed_y),
                    Member("fixed_rotation", &P::fixed_rotation));
}

// Prescribed displacement of a support: the fixed components of the node are at their initial position + (dx, dy) x
// load factor, its fixed rotation is rotation x load factor. Or of each node of a group.
struct SupportMotion {
  std::string node;
  double dx = 0.0;  // [length] per unit of the load factor; 0 where the component is free
  double dy = 0.0;
  double rotation = 0.0;   // [rad] per unit of the load factor; 0 where the rotation is free
  std::string group = {};  // in place of node
  std::string body = {};   // in place of node
};

template <typename P>
constexpr auto Fields(Of<SupportMotion>) {
  return std::tuple(Member("node", &P::node).Naming(TextKind::kNode), Member("dx", &P::dx).In(units::kLengthRate),
                    Member("dy", &P::dy).In(units::kLengthRate),
                    Member("rotation", &P::rotation).In(units::kRotationRate), Member("group", &P::group),
                    Member("body", &P::body));
}

// Motion of an obstacle: it is turned about a point by the angle turn x load factor, counterclockwise, and then moved
// by (dx, dy) x load factor. Slip is motion relative to it.
struct ObstacleMotion {
  std::string obstacle;
  double dx = 0.0;  // [length] per unit of the load factor
  double dy = 0.0;
  double turn = 0.0;     // [rad] per unit of the load factor
  double about_x = 0.0;  // the point about which it turns, before it has moved [length]
  double about_y = 0.0;
};

template <typename P>
constexpr auto Fields(Of<ObstacleMotion>) {
  return std::tuple(
      Member("obstacle", &P::obstacle).Naming(TextKind::kObstacle), Member("dx", &P::dx).In(units::kLengthRate),
      Member("dy", &P::dy).In(units::kLengthRate), Member("turn", &P::turn).In(units::kRotationRate),
      Member("about_x", &P::about_x).In(units::kLength), Member("about_y", &P::about_y).In(units::kLength));
}

// The coefficient of friction of all contacts with an obstacle is friction + rate x load factor, with `friction` of the
// contact or of the obstacle.
struct FrictionChange {
  std::string obstacle;
  double rate = 0.0;  // per unit of the load factor
};

template <typename P>
constexpr auto Fields(Of<FrictionChange>) {
  return std::tuple(Member("obstacle", &P::obstacle).Naming(TextKind::kObstacle),
                    Member("rate", &P::rate).In(units::kRate));
}

struct Scene {
  std::string name;
  std::vector<Node> nodes;
  std::vector<Bar> bars;
  std::vector<Superelement> superelements;
  std::vector<Beam> beams;
  std::vector<Material> materials;
  std::vector<Solid> solids;
  std::vector<Group> groups;
  std::vector<BoundarySurface> surfaces;
  std::vector<Load> loads;
  std::vector<Obstacle> obstacles;
  std::vector<ContactCandidate> contacts;
  std::vector<Support> supports;
  std::vector<SupportMotion> support_motions;
  std::vector<ObstacleMotion> obstacle_motions;
  std::vector<RigidBody> bodies;
  std::vector<Tendon> tendons;
  std::vector<Pin> pins;
  std::vector<FrictionChange> friction_changes;
};

template <typename P>
constexpr auto Fields(Of<Scene>) {
  return std::tuple(Member("name", &P::name), Member("nodes", &P::nodes), Member("bars", &P::bars),
                    Member("superelements", &P::superelements), Member("beams", &P::beams),
                    Member("materials", &P::materials), Member("solids", &P::solids), Member("groups", &P::groups),
                    Member("surfaces", &P::surfaces), Member("loads", &P::loads), Member("obstacles", &P::obstacles),
                    Member("contacts", &P::contacts), Member("supports", &P::supports),
                    Member("support_motions", &P::support_motions), Member("obstacle_motions", &P::obstacle_motions),
                    Member("bodies", &P::bodies), Member("tendons", &P::tendons), Member("pins", &P::pins),
                    Member("friction_changes", &P::friction_changes));
}

// Calls visit(name, list) for each list of elements of a scene, parts that join `nodes` and hold them by forces, in the
// order of the scene.
template <typename Visit>
void ForEachElementList(const Scene& scene, Visit&& visit) {
  visit("bars", scene.bars);
  visit("superelements", scene.superelements);
  visit("beams", scene.beams);
  visit("solids", scene.solids);
  visit("tendons", scene.tendons);
  visit("pins", scene.pins);
}

// A part of a load program. Its load factor goes from 0 to `target`; then the stage leaves its loads and motions on,
// until a stage unloads.
struct Stage {
  std::string name;
  std::vector<Load> loads;  // none constant
  std::vector<SupportMotion> support_motions;
  std::vector<ObstacleMotion> obstacle_motions;
  double target = 0.0;  // load factor at its end; 0 = 1
  // true: takes the loads and motions that the stages before have left back, in proportion to its load factor, from 0
  // to `target` <= 1; it has none of its own.
  bool unload = false;
  std::vector<FrictionChange> friction_changes = {};

  double Target() const { return target == 0.0 ? 1.0 : target; }
};

template <typename P>
constexpr auto Fields(Of<Stage>) {
  return std::tuple(Member("name", &P::name), Member("loads", &P::loads),
                    Member("support_motions", &P::support_motions), Member("obstacle_motions", &P::obstacle_motions),
                    Member("target", &P::target).In(units::kLoadFactor), Member("unload", &P::unload),
                    Member("friction_changes", &P::friction_changes));
}

// Whether something else than loads goes with the load factor. Loading: Scene or Stage.
template <typename Loading>
bool IsDriven(const Loading& of) {
  return !of.support_motions.empty() || !of.obstacle_motions.empty() || !of.friction_changes.empty();
}

struct TraceRequest {
  Scene scene;
  TraceOptions options;
  // Traced one after the other, with the friction history of those before. Empty: the path of the scene's own loads and
  // motions, as far as it goes. Otherwise the scene has none but constant loads.
  std::vector<Stage> program;
};

template <typename P>
constexpr auto Fields(Of<TraceRequest>) {
  return std::tuple(Member("scene", &P::scene), Member("options", &P::options), Member("program", &P::program));
}

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_SCENE_H_
