#include "contact_path/scene/tendon_route.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "contact_path/geometry/plane.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/text.h"

namespace contact_path {
namespace {

constexpr double kMostTurns = 100.0;
constexpr double kNearlyHalf = 3.1;  // of a turn [rad]
constexpr double kMeet = 1e-3;       // 1 - |delta| / |d| of a span of which too little is free

bool Turns(const Node& body, const Scene& scene) {
  return !body.fixed_rotation ||
         std::any_of(scene.support_motions.begin(), scene.support_motions.end(),
                     [&](const SupportMotion& motion) { return motion.node == body.name && motion.rotation != 0.0; });
}

// From 0 to a whole turn.
double Positive(double angle) { return angle < 0.0 ? angle + 2.0 * M_PI : angle; }

}  // namespace

double SignedRadius(const Tendon& tendon, std::size_t node) {
  if (node >= tendon.radii.size() || node >= tendon.turns.size()) return 0.0;
  return std::copysign(tendon.radii[node], tendon.turns[node]);
}

std::optional<RollerFault> FindRollerFault(const Tendon& tendon) {
  const std::size_t count = tendon.radii.empty() && tendon.turns.empty() ? 0 : tendon.nodes.size();
  for (const auto& [name, list] : {std::pair("radii", &tendon.radii), std::pair("turns", &tendon.turns)})
    if (list->size() != count)
      return RollerFault{name, std::nullopt, std::to_string(list->size()) + " numbers",
                         "must have one for each node: " + std::to_string(count)};
  if (tendon.pulley == Pulley::kFree && tendon.friction > 0.0)
    return RollerFault{"friction", std::nullopt, NumberText(tendon.friction),
                       "must be 0 where the pulleys turn freely"};
  for (std::size_t i = 0; i < count; ++i) {
    const double turns = tendon.turns[i];
    if (turns != std::round(turns) || std::abs(turns) > kMostTurns)
      return RollerFault{"turns", i, NumberText(turns), "must be a whole number up to " + NumberText(kMostTurns)};
    if ((turns == 0.0) != (tendon.radii[i] == 0.0))
      return RollerFault{"turns", i, NumberText(turns), "must be 0 where the radius is, and only there"};
  }
  return std::nullopt;
}

bool SpanIsSound(const Tendon& tendon, std::size_t span, const Eigen::Vector2d& d) {
  return (1.0 - kMeet) * d.norm() > std::abs(SignedRadius(tendon, span + 1) - SignedRadius(tendon, span));
}

std::vector<Eigen::Vector2d> PointsOf(const std::vector<int>& nodes, const std::vector<double>& positions) {
  std::vector<Eigen::Vector2d> points;
  for (const int node : nodes) {
    const auto i = 2 * static_cast<std::size_t>(node);
    points.emplace_back(positions[i], positions[i + 1]);
  }
  return points;
}

TendonRoute RouteOf(const Tendon& tendon, const std::vector<Eigen::Vector2d>& points) {
  TendonRoute route;
  route.wrapped.assign(points.size(), 0.0);
  const std::size_t last = points.size() - 1;
  std::vector<RolledSpan> bare;
  for (std::size_t i = 0; i < last; ++i)
    bare.emplace_back(SignedRadius(tendon, i), SignedRadius(tendon, i + 1), points[i + 1] - points[i], 0.0);
  for (std::size_t i = 0; i <= last; ++i) {
    const double rho = SignedRadius(tendon, i);
    if (rho == 0.0) continue;
    double& angle = route.wrapped[i];
    if (tendon.IsPiece())
      angle = tendon.wrapped[i];
    else if (i == 0 || i == last)
      angle = 2.0 * M_PI * std::abs(tendon.turns[i]);
    else
      angle = Positive((rho > 0.0 ? 1.0 : -1.0) * bare[i - 1].Turned(bare[i].StartDirection())) +
              2.0 * M_PI * (std::abs(tendon.turns[i]) - 1.0);
  }
  // An arc is half that of the span before and half that of the span behind, at an end all that of its one span.
  const auto share = [&](std::size_t i) {
    const bool whole = tendon.IsPiece() || i == 0 || i == last;
    return (whole ? 1.0 : 0.5) * std::abs(SignedRadius(tendon, i)) * route.wrapped[i];
  };
  for (std::size_t i = 0; i < last; ++i)
    route.spans.emplace_back(SignedRadius(tendon, i), SignedRadius(tendon, i + 1), points[i + 1] - points[i],
                             share(i) + share(i + 1));
  route.by_turn = {-SignedRadius(tendon, 0), SignedRadius(tendon, last)};
  route.length = LengthOn(route, points, {});
  return route;
}

const std::string& BodyOfDrum(const Tendon& tendon, std::size_t end, const Scene& scene, const SceneIndex& index) {
  static const std::string none;
  const std::size_t node = end == 0 ? 0 : tendon.nodes.size() - 1;
  return SignedRadius(tendon, node) != 0.0 ? scene.nodes[index.Node(tendon.nodes[node])].body : none;
}

double LengthOn(const TendonRoute& route, const std::vector<Eigen::Vector2d>& points,
                const std::array<double, 2>& turned) {
  double length = route.by_turn[0] * turned[0] + route.by_turn[1] * turned[1];
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const RolledSpan::At span = route.spans[i].Of(points[i + 1] - points[i], 0.0);
    length += span.tangent.norm() + span.arcs;
  }
  return length;
}

TendonRoute RouteIn(const Scene& scene, const SceneIndex& index, const Tendon& tendon) {
  std::vector<Eigen::Vector2d> points;
  for (const std::string& name : tendon.nodes) {
    const Node& node = scene.nodes[index.Node(name)];
    points.emplace_back(node.x, node.y);
  }
  return RouteOf(tendon, points);
}

const Tendon& PieceAtEye(const Scene& scene, const std::string& eye, std::size_t end) {
  return *std::find_if(scene.tendons.begin(), scene.tendons.end(),
                       [&](const Tendon& tendon) { return tendon.slides[end] == eye; });
}

std::vector<WrapLimit> WrapLimits(const Scene& scene, const SceneIndex& index) {
  std::vector<WrapLimit> limits;
  for (std::size_t k = 0; k < scene.tendons.size(); ++k) {
    const Tendon& tendon = scene.tendons[k];
    if (tendon.radii.empty()) continue;
    const TendonRoute route = RouteIn(scene, index, tendon);
    const std::string name = TendonName(tendon, k);
    const std::size_t last = tendon.nodes.size() - 1;
    for (std::size_t i = 0; i <= last; ++i) {
      if (i < last && (SignedRadius(tendon, i) != 0.0 || SignedRadius(tendon, i + 1) != 0.0)) {
        limits.push_back({WrapLimit::Kind::kTurns, name, kNearlyHalf, {{1.0, k, i}}});
        limits.back().both_senses = true;
      }
      if (i < last && route.spans[i].Delta() != 0.0)
        limits.push_back({WrapLimit::Kind::kMeet, name, 1.0 - kMeet, {{-std::abs(route.spans[i].Delta()), k, i}}});
      const double rho = SignedRadius(tendon, i), sense = rho > 0.0 ? 1.0 : -1.0;
      if (rho == 0.0) continue;
      const bool slides = i <= 1 && !tendon.slides[i].empty(), ends = i == 0 || i == last;
      std::string body = ends ? BodyOfDrum(tendon, i == 0 ? 0 : 1, scene, index) : std::string();
      if (!body.empty() && !Turns(scene.nodes[index.Node(body)], scene)) body.clear();
      if (slides && i == 0 && body.empty()) continue;  // the piece before has the whole angle
      WrapLimit limit{WrapLimit::Kind::kComesOff, name + " at " + tendon.nodes[i], route.wrapped[i], {}};
      if (i > 0) limit.turns.push_back({-sense, k, i - 1});
      if (i < last) limit.turns.push_back({sense, k, i});
      if (slides && body.empty()) {
        const Tendon& next = PieceAtEye(scene, tendon.slides[1], 0);
        limit.start += next.wrapped[0];
        limit.turns.push_back({sense, static_cast<std::size_t>(&next - scene.tendons.data()), 0});
      } else if (!body.empty()) {
        if (slides) limit.kind = WrapLimit::Kind::kHauled;
        limit.of_body = i == 0 ? -sense : sense;
        limit.body = body;
      }
      limits.push_back(std::move(limit));
    }
  }
  return limits;
}

}  // namespace contact_path
