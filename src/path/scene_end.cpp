#include "contact_path/path/scene_end.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "contact_path/law/slack_bar.h"
#include "contact_path/path/sentences.h"
#include "contact_path/scene/tendon_route.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr double kFrictionLeft = 1e-6;       // of the friction at the load factor 0
constexpr double kRoundingOfAngles = 1e-11;  // [rad]

void AddFrictionEnds(const Model& model, std::vector<SceneEnd>* ends) {
  const Eigen::Index s = model.structure.NumDofs();
  for (const FrictionChange& change : model.scene.friction_changes) {
    const Obstacle& obstacle = model.scene.obstacles[model.index.Obstacle(change.obstacle)];
    for (const ContactCandidate& contact : model.scene.contacts) {
      if (contact.OnSurface() || contact.at_eye || contact.obstacle != change.obstacle) continue;
      const double load_factor = -contact.FrictionWith(obstacle) / change.rate;
      const double value = (1.0 - kFrictionLeft) * load_factor / model.scaling.load_factor;
      SceneEnd end;
      end.target.unknown = s;
      end.target.of = [s](const Eigen::VectorXd& x) { return x[s]; };
      end.target.values = {value};
      end.target.rounding = tolerances::kEqual * (1.0 + std::abs(value));
      end.beyond = value > 0.0 ? 1.0 : -1.0;
      end.cause = {sentences::kFrictionEnds, change.obstacle, load_factor};
      const auto beside =
          std::find_if(ends->begin(), ends->end(), [&](const SceneEnd& other) { return other.beyond == end.beyond; });
      if (beside == ends->end())
        ends->push_back(std::move(end));
      else if (std::abs(value) < std::abs(beside->target.values.front()))
        *beside = std::move(end);
    }
  }
}

std::string_view SentenceOf(WrapLimit::Kind kind) {
  switch (kind) {
    case WrapLimit::Kind::kComesOff: return sentences::kComesOff;
    case WrapLimit::Kind::kHauled: return sentences::kHauled;
    case WrapLimit::Kind::kTurns: return sentences::kStringTurns;
    case WrapLimit::Kind::kMeet: return sentences::kMeetsRoller;
  }
  return {};
}

void AddRollerEnds(const Model& model, std::vector<SceneEnd>* ends) {
  const Scene& scene = model.scaled;
  for (const WrapLimit& limit : WrapLimits(scene, model.index)) {
    std::vector<BarSpan> spans;  // of the turns of the limit
    for (const WrapLimit::Turn& turn : limit.turns) {
      const Tendon& tendon = scene.tendons[turn.tendon];
      const auto point = [&](std::size_t node) {
        return model.structure.PointOf(static_cast<int>(model.index.Node(tendon.nodes[node])));
      };
      spans.push_back({MovingPlace::Between(point(turn.span), point(turn.span + 1)),
                       RouteIn(scene, model.index, tendon).spans[turn.span]});
    }
    Coordinate body = {};
    if (!limit.body.empty()) body = model.structure.FrameOfBody(static_cast<int>(model.index.Node(limit.body))).angle;
    SceneEnd& end = ends->emplace_back();
    end.target.of = [limit, spans, body, n = model.structure.NumDofs()](const Eigen::VectorXd& x) {
      const Eigen::VectorXd u = x.head(n);
      const auto turned = [&](const WrapLimit::Turn& of) {
        const BarSpan& span = spans[static_cast<std::size_t>(&of - limit.turns.data())];
        return limit.MeasureOf(span.rolled, span.apart.At(u, x[n]));
      };
      return limit.Left(turned, body.dof >= 0 ? u[body.dof] : body.held + body.rate * x[n]);
    };
    end.target.values = {0.0};
    end.target.rounding = kRoundingOfAngles;
    end.target.sense = end.beyond = -1.0;
    end.cause = {SentenceOf(limit.kind), limit.of};
  }
}

}  // namespace

std::vector<SceneEnd> SceneEnds(const Model& model) {
  std::vector<SceneEnd> ends;
  AddFrictionEnds(model, &ends);
  AddRollerEnds(model, &ends);
  return ends;
}

std::optional<Cause> EndOfScene(const Model& model, const PathPoint& point) {
  Eigen::VectorXd x(point.u.size() + 1);
  x << point.u, point.s;
  for (const SceneEnd& end : SceneEnds(model))
    if (end.beyond * end.target.of(x) >= end.beyond * end.target.values.front() - end.target.rounding) return end.cause;
  return std::nullopt;
}

}  // namespace contact_path
