// The request of a trace as plain data: an elastic plane structure, its loads, its obstacles, and the options.
//
// Any consistent set of units: [length], [force]; the load factor has no unit. Names tie the parts together and are
// unique within their list. The structs hold what the user wrote; nothing is checked or normalised here (validate.h).
#ifndef CONTACT_PATH_SCENE_SCENE_H_
#define CONTACT_PATH_SCENE_SCENE_H_

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace contact_path {

// Strain of a bar of current length l and rest length l0.
enum class StrainMeasure {
  kBiot,           // l / l0 - 1
  kGreenLagrange,  // ((l / l0)^2 - 1) / 2
  kLogarithmic,    // ln(l / l0)
};

enum class ObstacleShape { kHalfPlane };

enum class Method {
  kBranch,  // piecewise smooth continuation with located events
  kMpec,    // Algorithm 3.2 of Kanno & Martins 2005
};

enum class Accuracy { kFast, kBalanced, kAccurate };

struct Node {
  std::string name;
  double x = 0.0;  // initial position [length]
  double y = 0.0;
  bool fixed_x = false;
  bool fixed_y = false;
};

// Straight bar with energy EA l0 e^2 / 2, e by `strain`.
struct Bar {
  std::vector<std::string> nodes;  // two names
  double EA = 0.0;                 // axial stiffness [force], > 0
  double rest_length = 0.0;        // [length]; 0 = distance of the nodes at the start
  StrainMeasure strain = StrainMeasure::kBiot;
};

// Linear elastic part: force = K (x - X), both ordered x0, y0, x1, y1, ... over `nodes`.
struct Superelement {
  std::vector<std::string> nodes;           // n names
  std::vector<double> stiffness;            // K, row-major, 2n x 2n, symmetric [force/length]
  std::vector<double> rest_positions = {};  // X, 2n [length]; empty = the initial positions of the nodes
};

struct Load {
  std::string node;
  double fx = 0.0;  // [force], per unit of the load factor unless constant
  double fy = 0.0;
  bool constant = false;  // true: not scaled by the load factor
};

// Half plane of admissible points: n . (x - p) >= 0. The tangent is t = (n_y, -n_x).
struct Obstacle {
  std::string name;
  ObstacleShape shape = ObstacleShape::kHalfPlane;
  double px = 0.0;  // a point of the boundary [length]
  double py = 0.0;
  double nx = 0.0;  // normal towards the admissible side, of any length > 0
  double ny = 0.0;
  double friction = 0.0;  // Coulomb's coefficient, >= 0; 0 = frictionless
};

// A node that may touch an obstacle. Its name is "<node>@<obstacle>".
struct ContactCandidate {
  std::string node;
  std::string obstacle;

  std::string Name() const { return node + "@" + obstacle; }
};

// Prescribed displacement of a support: the fixed components of the node are at their initial position + (dx, dy) x
// load factor.
struct SupportMotion {
  std::string node;
  double dx = 0.0;  // [length] per unit of the load factor; 0 where the component is free
  double dy = 0.0;
};

// Translation of an obstacle: its point is at (px, py) + (dx, dy) x load factor. Slip is motion relative to it.
struct ObstacleMotion {
  std::string obstacle;
  double dx = 0.0;  // [length] per unit of the load factor
  double dy = 0.0;
};

struct Scene {
  std::string name;
  std::vector<Node> nodes;
  std::vector<Bar> bars;
  std::vector<Superelement> superelements;
  std::vector<Load> loads;
  std::vector<Obstacle> obstacles;
  std::vector<ContactCandidate> contacts;
  std::vector<SupportMotion> support_motions;
  std::vector<ObstacleMotion> obstacle_motions;
};

// Holds when `quantity` lies beyond `value` on the side that `when` names.
struct StopCriterion {
  std::string quantity;  // "<node>.x", "<node>.y" (current position) or "load_factor"
  std::string when;      // ">" or "<"
  double value = 0.0;
};

// Takes another branch than the best one (method branch): at the n-th event, or at an increment, which then counts as
// an event.
struct BranchChoice {
  int event = 0;      // n, from 1; 0 = `increment` is meant
  int increment = 0;  // index of the increment, from 0; used where event = 0
  int branch = 0;     // number of the branch in the record of that event, from 1; 0 = 1, the best
};

struct TraceOptions {
  Method method = Method::kBranch;
  Accuracy accuracy = Accuracy::kBalanced;
  double direction = 0.0;  // sign of the first change of the load factor; 0 = +1
  double step = 0.0;       // target increment length in the scaled norm, >= 0; 0 = automatic (by accuracy)
  int max_increments = 0;  // >= 0; 0 = 1000
  // Of messages and bags, not of the CSV: every n-th regular increment has positions and contacts, and all located
  // increments have; the others leave them empty. >= 0; 0 = 1, all of them.
  int full_state_every = 0;
  std::vector<StopCriterion> stop;
  std::vector<BranchChoice> branch_choices;

  int MaxIncrements() const { return max_increments == 0 ? 1000 : max_increments; }
  double Direction() const { return direction < 0.0 ? -1.0 : 1.0; }
};

// A part of a load program. Its load factor goes from 0 to `target`; then what it has brought on stays.
struct Stage {
  std::string name;
  std::vector<Load> loads;  // none constant
  std::vector<SupportMotion> support_motions;
  std::vector<ObstacleMotion> obstacle_motions;
  double target = 0.0;  // load factor at its end; 0 = 1

  double Target() const { return target == 0.0 ? 1.0 : target; }
};

struct TraceRequest {
  Scene scene;
  TraceOptions options;
  // Traced one after the other, with the friction history of those before. Empty: the path of the scene's own loads and
  // motions, as far as it goes. Otherwise the scene has none but constant loads.
  std::vector<Stage> program;
};

// Words of the scene format. Parse* take "" for the default and give nothing for a word that is not known.
std::optional<StrainMeasure> ParseStrainMeasure(std::string_view word);
std::optional<ObstacleShape> ParseObstacleShape(std::string_view word);
std::optional<Method> ParseMethod(std::string_view word);
std::optional<Accuracy> ParseAccuracy(std::string_view word);
std::string_view ToString(StrainMeasure strain);
std::string_view ToString(ObstacleShape shape);
std::string_view ToString(Method method);
std::string_view ToString(Accuracy accuracy);

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_SCENE_H_
