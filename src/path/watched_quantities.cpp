#include "contact_path/path/watched_quantities.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "contact_path/law/slack_bar.h"
#include "contact_path/path/recorder.h"
#include "contact_path/path/sentences.h"
#include "contact_path/path/stop.h"
#include "contact_path/scene/change_units.h"
#include "contact_path/scene/quantity.h"
#include "contact_path/scene/tendon_route.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr double kFrictionLeft = 1e-6;       // of the friction at the load factor 0
constexpr double kRoundingOfAngles = 1e-11;  // [rad]

using Function = std::function<double(const Eigen::VectorXd& x)>;

// Of what a node has, in scaled units counted from the origin of the model; -1 where no unknown changes it.
int UnknownOf(const Model& model, const Quantity& quantity) {
  const bool is_rotation = quantity.kind == Quantity::Kind::kRotation;
  const int component = quantity.kind == Quantity::Kind::kY ? 1 : 0;
  return model.structure.Dofs().Dof(static_cast<int>(quantity.part), is_rotation ? Field::kRotation : Field::kPosition,
                                    component);
}

Function OfAttachedNode(const Model& model, const Quantity& quantity) {
  const FixedPoint point = model.structure.PointOf(static_cast<int>(quantity.part));
  if (quantity.kind == Quantity::Kind::kRotation)
    return [angle = point.frame.angle](const Eigen::VectorXd& x) { return angle.dof >= 0 ? x[angle.dof] : angle.held; };
  return [place = MovingPlace(point), axis = quantity.kind == Quantity::Kind::kY ? 1 : 0](const Eigen::VectorXd& x) {
    return place.At(x, 0.0)[axis];
  };
}

Function OfContact(const Model& model, const Quantity& quantity, const FixedModeSystem& system) {
  const std::size_t i = quantity.part;
  if (quantity.kind != Quantity::Kind::kGap)
    return [i, &system, &contact = *model.contacts[i],
            normal = quantity.kind == Quantity::Kind::kRn](const Eigen::VectorXd& x) {
      const PathPoint point = system.Unpack(x);
      return normal ? NormalReaction(point, i) : contact.OnRecord(point.u, point.s, TangentialReaction(point, i));
    };
  return [i, &system, &contact = *model.contacts[i]](const Eigen::VectorXd& x) {
    const PathPoint point = system.Unpack(x);
    return contact.GapOnRecord(point.u, point.s, contact.KnownPatch(point.u, point.s, point.modes[i].piece));
  };
}

// unit: of the quantity, in the scene; here and below.
Function OfObstacle(const Model& model, const Quantity& quantity, double unit, const TraceRequest& request,
                    std::size_t stage) {
  return [=, &model, &request](const Eigen::VectorXd& x) {
    Increment increment;
    increment.stage = static_cast<int>(stage) + 1;
    increment.load_factor = x[model.structure.NumDofs()] * model.scaling.load_factor;
    return ValueOf(quantity, increment, request) / unit;
  };
}

Function OfResponse(const Model& model, const Quantity& quantity, double unit, const FixedModeSystem& system) {
  return [&model, &system, quantity, unit](const Eigen::VectorXd& x) {
    const PathPoint point = system.Unpack(x);
    Increment increment;
    FillLists(model, point, {quantity.IsOfSection(), quantity.IsOfElement(), quantity.IsOfPressure()}, &increment);
    if (quantity.of == Quantity::Of::kPin) {
      FillState(model, point, &increment);
    } else if (quantity.IsReaction()) {
      Reactions reactions = model.ReactionsAt(point);
      increment.supports = std::move(reactions.supports);
      increment.boundaries = std::move(reactions.boundaries);
    }
    return ValueOf(quantity, increment) / unit;
  };
}

bool Moves(const Scene& scene, std::size_t obstacle) {
  return std::any_of(scene.obstacle_motions.begin(), scene.obstacle_motions.end(),
                     [&](const ObstacleMotion& motion) { return motion.obstacle == scene.obstacles[obstacle].name; });
}

// Where the scaled quantity is counted from, in the scene.
double OriginOf(const Model& model, Quantity::Kind kind) {
  if (kind == Quantity::Kind::kX) return model.origin[0];
  return kind == Quantity::Kind::kY ? model.origin[1] : 0.0;
}

// Forces are known as positions are, times the stiffness; means and quotients of them, no better than their size.
double ErrorOf(const Model& model, const Quantity& quantity, double largest) {
  const double of_size = tolerances::kEqual * (1.0 + largest);
  const double of_forces = tolerances::kMargin * model.structure.ForceRounding().maxCoeff();
  const bool is_force =
      quantity.IsReaction() || quantity.kind == Quantity::Kind::kRn || quantity.kind == Quantity::Kind::kRt;
  if (is_force) return std::max(tolerances::kLastDigits * largest, of_forces);
  const bool is_motion = quantity.kind <= Quantity::Kind::kSetting || quantity.IsOfNode() || quantity.IsOfObstacle() ||
                         quantity.IsOfContact();
  if (is_motion && !quantity.IsOfPressure()) return of_size * model.structure.ResidualUnits().maxCoeff();
  return std::max(of_size, of_forces);
}

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

ArcTargets WatchedQuantities(const Model& model, const TraceRequest& request, std::size_t stage,
                             const MachineSetting& setting, const FixedModeSystem& system) {
  ArcTargets targets;
  // Nothing for what does not change. sense, criterion: as of ArcTarget.
  const auto add = [&](const std::string& text, const std::vector<double>& values, double sense, int criterion) {
    const Quantity quantity = FindQuantity(text, model.index).value();
    const Scaling& scaling = model.scaling;
    const double unit = SizeOf(UnitOf(quantity.kind), {scaling.length, scaling.force, scaling.load_factor});
    ArcTarget target;
    target.sense = sense;
    target.criterion = criterion;
    if (quantity.kind == Quantity::Kind::kLoadFactor)
      target.unknown = model.structure.NumDofs();
    else if (quantity.kind == Quantity::Kind::kSetting)
      target.of = [&setting, unit, nd = model.structure.NumDofs()](const Eigen::VectorXd& x) {
        return setting.At(x.head(nd), x[nd]) / unit;
      };
    else if (quantity.IsOfNode() && model.structure.AttachmentOf(static_cast<int>(quantity.part)) != nullptr)
      target.of = OfAttachedNode(model, quantity);
    else if (quantity.IsOfNode())
      target.unknown = UnknownOf(model, quantity);
    else if (quantity.IsOfObstacle() && Moves(model.scene, quantity.part))
      target.of = OfObstacle(model, quantity, unit, request, stage);
    else if (quantity.IsOfContact() && !quantity.IsOfPressure())
      target.of = OfContact(model, quantity, system);
    else if (!quantity.IsOfObstacle())
      target.of = OfResponse(model, quantity, unit, system);
    if (target.unknown >= 0) target.of = [i = target.unknown](const Eigen::VectorXd& x) { return x[i]; };
    if (target.of == nullptr) return;
    double largest = 0.0;
    for (const double value : values) {
      target.values.push_back((value - OriginOf(model, quantity.kind)) / unit);
      largest = std::max(largest, std::abs(target.values.back()));
    }
    target.rounding = ErrorOf(model, quantity, largest);
    targets.push_back(std::move(target));
  };
  for (std::size_t i = 0; i < request.options.stop.size(); ++i) {
    const StopCriterion& criterion = request.options.stop[i];
    if (criterion.exact == DefaultTrue::kTrue)
      add(criterion.quantity, {criterion.value}, criterion.when == ">" ? 1.0 : -1.0, static_cast<int>(i));
  }
  for (const Samples& samples : request.options.at) add(samples.quantity, samples.Values(), 0.0, -1);
  for (const SceneEnd& end : SceneEnds(model)) targets.push_back(end.target);
  return targets;
}

}  // namespace contact_path
