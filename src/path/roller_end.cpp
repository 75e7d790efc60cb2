#include "contact_path/path/roller_end.h"

#include <utility>

#include "contact_path/path/sentences.h"

namespace contact_path {
namespace {

constexpr double kRounding = 1e-11;  // of angles [rad]

std::string_view SentenceOf(WrapLimit::Kind kind) {
  switch (kind) {
    case WrapLimit::Kind::kComesOff: return sentences::kComesOff;
    case WrapLimit::Kind::kHauled: return sentences::kHauled;
    case WrapLimit::Kind::kTurns: return sentences::kStringTurns;
    case WrapLimit::Kind::kMeet: return sentences::kMeetsRoller;
  }
  return {};
}

}  // namespace

RollerEnds::RollerEnds(const Model& model) : num_dofs_(model.structure.NumDofs()) {
  const Scene& scene = model.scaled;
  for (WrapLimit& limit : WrapLimits(scene, model.index)) {
    Placed placed;
    for (const WrapLimit::Turn& turn : limit.turns) {
      const Tendon& tendon = scene.tendons[turn.tendon];
      const auto point = [&](std::size_t node) {
        return model.structure.PointOf(static_cast<int>(model.index.Node(tendon.nodes[node])));
      };
      placed.spans.push_back({MovingPlace::Between(point(turn.span), point(turn.span + 1)),
                              RouteIn(scene, model.index, tendon).spans[turn.span]});
    }
    if (!limit.body.empty())
      placed.turn = model.structure.FrameOfBody(static_cast<int>(model.index.Node(limit.body))).angle;
    placed.limit = std::move(limit);
    limits_.push_back(std::move(placed));
  }
}

double RollerEnds::Placed::Left(const Eigen::VectorXd& u, double s) const {
  const auto turned = [&](const WrapLimit::Turn& of) {
    const BarSpan& span = spans[static_cast<std::size_t>(&of - limit.turns.data())];
    return limit.MeasureOf(span.rolled, span.apart.At(u, s));
  };
  return limit.Left(turned, turn.dof >= 0 ? u[turn.dof] : turn.held + turn.rate * s);
}

void RollerEnds::AddTo(ArcTargets* targets) const {
  for (const Placed& limit : limits_) {
    ArcTarget& target = targets->emplace_back();
    target.of = [limit, n = num_dofs_](const Eigen::VectorXd& x) { return limit.Left(x.head(n), x[n]); };
    target.values = {0.0};
    target.rounding = kRounding;
    target.sense = -1.0;
  }
}

std::optional<Cause> RollerEnds::At(const PathPoint& point) const {
  for (const Placed& of : limits_)
    if (of.Left(point.u, point.s) <= kRounding) return Cause{SentenceOf(of.limit.kind), of.limit.of};
  return std::nullopt;
}

}  // namespace contact_path
