// The way of a tendon from node to node and round rollers.
#ifndef CONTACT_PATH_SCENE_TENDON_ROUTE_H_
#define CONTACT_PATH_SCENE_TENDON_ROUTE_H_

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "contact_path/geometry/rolled_span.h"
#include "contact_path/scene/scene.h"
#include "contact_path/scene/scene_index.h"

namespace contact_path {

// rho of RolledSpan at a node of the tendon [length]; 0: it has no roller there.
double SignedRadius(const Tendon& tendon, std::size_t node);

// The first rule that the radii and turns break by themselves; nothing: none.
struct RollerFault {
  std::string_view field;
  std::optional<std::size_t> entry;
  std::string value, rule;
};
std::optional<RollerFault> FindRollerFault(const Tendon& tendon);

// Whether a string can go from node `span` to the next one, d apart, where their rollers are apart as well.
bool SpanIsSound(const Tendon& tendon, std::size_t span, const Eigen::Vector2d& d);

struct TendonRoute {
  std::vector<RolledSpan> spans;
  std::vector<double> wrapped;  // by node, round its roller at the start [rad], >= 0
  double length = 0.0;          // at the start, with arcs
  // What each end adds to the length per angle by which its roller turns [length].
  std::array<double, 2> by_turn = {};
};

// x, y of each of these nodes.
std::vector<Eigen::Vector2d> PointsOf(const std::vector<int>& nodes, const std::vector<double>& positions);

// points: by node of the tendon, at the start; no span is shorter than the difference of the signed radii.
TendonRoute RouteOf(const Tendon& tendon, const std::vector<Eigen::Vector2d>& points);

// The body with which the roller at the first end (0) or the last one (1) of the tendon, or of a piece, turns; empty:
// there is none.
const std::string& BodyOfDrum(const Tendon& tendon, std::size_t end, const Scene& scene, const SceneIndex& index);

// The length at places of its nodes, with the rollers at its ends turned by these angles since the start.
double LengthOn(const TendonRoute& route, const std::vector<Eigen::Vector2d>& points,
                const std::array<double, 2>& turned);

// An angle, or a share, that must stay > 0: start + the sum of factor times what a span has turned since the start, +
// of_body times the turn of a body; where both senses count, start - |that sum|.
struct WrapLimit {
  enum class Kind {
    kComesOff,  // what a tendon is wrapped round a roller by, or wound on a drum
    kHauled,    // what is left between the middle of the arc at the start, carried by a roller that turns, and its end
    kTurns,     // what is left to nearly half a turn of a span beside a roller
    kMeet,      // no angle: what is left of the free length of a span, 1 - |delta| / |d|, turned being 1 / |d|
  };
  struct Turn {
    double factor;
    std::size_t tendon, span;  // places in the scene and in the tendon
  };
  Kind kind;
  std::string of;  // the tendon, or tendon and node
  double start;    // [rad]
  std::vector<Turn> turns;
  double of_body = 0.0;
  std::string body = {};
  bool both_senses = false;

  // What `turned` below is of a span that is d now: an angle, or 1 / |d|.
  double MeasureOf(const RolledSpan& span, const Eigen::Vector2d& d) const {
    return kind == Kind::kMeet ? 1.0 / d.norm() : span.Turned(span.Of(d, 0.0).tangent);
  }
  // turned: of a turn's span. rotation: of the body.
  template <typename Turned>
  double Left(Turned turned, double rotation) const {
    double sum = of_body == 0.0 ? 0.0 : of_body * rotation;
    for (const Turn& turn : turns) sum += turn.factor * turned(turn);
    return start + (both_senses ? -std::abs(sum) : sum);
  }
};

// Of all tendons of an expanded scene, by the places of its nodes.
std::vector<WrapLimit> WrapLimits(const Scene& scene, const SceneIndex& index);

// The piece of a tendon that slides in (0) or out (1) through the eye of this node. scene: expanded.
const Tendon& PieceAtEye(const Scene& scene, const std::string& eye, std::size_t end);

// The route of a tendon of the scene by the places of its nodes there.
TendonRoute RouteIn(const Scene& scene, const SceneIndex& index, const Tendon& tendon);

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_TENDON_ROUTE_H_
