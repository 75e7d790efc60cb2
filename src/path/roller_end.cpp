#include "contact_path/path/roller_end.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "contact_path/path/sentences.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/tendon_route.h"

namespace contact_path {
namespace {

constexpr double kNearlyHalf = 3.1;  // of a turn [rad]
constexpr double kRounding = 1e-11;  // of angles [rad]

// Its number in the scene and its spans.
struct PlacedTendon {
  std::string name;
  const Tendon* tendon = nullptr;
  TendonRoute route;
  std::vector<BarSpan> spans;
};

std::vector<PlacedTendon> TendonsOf(const Model& model) {
  std::vector<PlacedTendon> placed;
  for (std::size_t k = 0; k < model.scaled.tendons.size(); ++k) {
    const Tendon& tendon = model.scaled.tendons[k];
    std::vector<Eigen::Vector2d> points;
    std::vector<FixedPoint> fixed;
    for (const std::string& name : tendon.nodes) {
      const std::size_t node = model.index.Node(name);
      points.emplace_back(model.scaled.nodes[node].x, model.scaled.nodes[node].y);
      fixed.push_back(model.structure.PointOf(static_cast<int>(node)));
    }
    PlacedTendon& of = placed.emplace_back(PlacedTendon{TendonName(tendon, k), &tendon, RouteOf(tendon, points), {}});
    for (std::size_t i = 0; i + 1 < fixed.size(); ++i)
      of.spans.push_back({MovingPlace::Between(fixed[i], fixed[i + 1]), of.route.spans[i]});
  }
  return placed;
}

}  // namespace

double RollerEnds::Limit::Left(const Eigen::VectorXd& u, double s) const {
  double turned = of_body == 0.0 ? 0.0 : of_body * (body.dof >= 0 ? u[body.dof] : body.held + body.rate * s);
  for (const auto& [factor, span] : turns)
    turned += factor * span.rolled.Turned(span.rolled.Of(span.apart.At(u, s), 0.0).tangent);
  return start + (both_senses ? -std::abs(turned) : turned);
}

RollerEnds::RollerEnds(const Model& model) : num_dofs_(model.structure.NumDofs()) {
  const std::vector<PlacedTendon> tendons = TendonsOf(model);
  for (const PlacedTendon& of : tendons) {
    const Windings windings = WindingsOf(*of.tendon, model.scaled, model.index, model.structure);
    const std::size_t last = of.tendon->nodes.size() - 1;
    for (std::size_t i = 0; i <= last; ++i) {
      if (i < last && of.route.spans[i].Delta() != 0.0) {
        Limit& limit = limits_.emplace_back(Limit{{sentences::kStringTurns, of.name}, kNearlyHalf, {}});
        limit.turns = {{1.0, of.spans[i]}};
        limit.both_senses = true;
      }
      const double rho = SignedRadius(*of.tendon, i), sense = rho > 0.0 ? 1.0 : -1.0;
      if (rho == 0.0) continue;
      const bool slides = i <= 1 && !of.tendon->slides[i].empty(), turns = windings[i == 0 ? 0 : 1].turn.Moves();
      if (slides && i == 0 && !turns) continue;  // the piece before has the whole angle
      Limit limit{{sentences::kComesOff, of.name + " at " + of.tendon->nodes[i]}, of.route.wrapped[i], {}};
      if (i > 0) limit.turns.push_back({-sense, of.spans[i - 1]});
      if (i < last) limit.turns.push_back({sense, of.spans[i]});
      if (slides && !turns) {
        const PlacedTendon& next = *std::find_if(tendons.begin(), tendons.end(), [&](const PlacedTendon& known) {
          return known.tendon->slides[0] == of.tendon->slides[1];
        });
        limit.start += next.route.wrapped[0];
        limit.turns.push_back({sense, next.spans[0]});
      } else if (i == 0 || i == last) {
        if (slides) limit.cause.sentence = sentences::kHauled;
        limit.of_body = i == 0 ? -sense : sense;
        limit.body = windings[i == 0 ? 0 : 1].turn;
      }
      limits_.push_back(std::move(limit));
    }
  }
}

void RollerEnds::AddTo(ArcTargets* targets) const {
  for (const Limit& limit : limits_) {
    ArcTarget& target = targets->emplace_back();
    target.of = [limit, n = num_dofs_](const Eigen::VectorXd& x) { return limit.Left(x.head(n), x[n]); };
    target.values = {0.0};
    target.rounding = kRounding;
    target.sense = -1.0;
  }
}

std::optional<Cause> RollerEnds::At(const PathPoint& point) const {
  for (const Limit& limit : limits_)
    if (limit.Left(point.u, point.s) <= kRounding) return limit.cause;
  return std::nullopt;
}

}  // namespace contact_path
