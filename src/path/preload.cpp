#include "contact_path/path/preload.h"

#include <locale>
#include <optional>
#include <sstream>
#include <utility>

#include "contact_path/contact/fixed_state_system.h"
#include "contact_path/contact/nearest_point.h"

namespace contact_path {
namespace {

constexpr double kNothing = 1e-14;  // scaled force: rounding of an unstressed start
constexpr double kInequalityTolerance = 1e-11;
constexpr double kSmallestStep = 1e-12;
const char* const kWhere = "while the constant loads were brought on: ";

std::string LimitMessage(double share) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(6);
  text << "a limit point at " << share << " of their full size; only a dynamic jump leads further";
  return text.str();
}

// The scene whose load factor, from 0 to 1, brings the constant loads on. holding: internal force at the start, by dof,
// in scene units.
Scene PreloadScene(const Model& model, const Eigen::VectorXd& holding) {
  Scene scene = model.scene;
  scene.loads.clear();
  for (const Load& load : model.scene.loads)
    if (load.constant) scene.loads.push_back({load.node, load.fx, load.fy, false});
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const int dof_x = model.structure.Dof(static_cast<int>(i), 0), dof_y = model.structure.Dof(static_cast<int>(i), 1);
    const double fx = dof_x < 0 ? 0.0 : holding[dof_x], fy = dof_y < 0 ? 0.0 : holding[dof_y];
    if (fx == 0.0 && fy == 0.0) continue;
    scene.loads.push_back({scene.nodes[i].name, fx, fy, true});
    scene.loads.push_back({scene.nodes[i].name, -fx, -fy, false});
  }
  return scene;
}

// The point at load factor `target` on the piece from `before` to `after`, which lies beyond it.
std::optional<PathPoint> PointAtLoadFactor(const Model& model, const PathPoint& before, const PathPoint& after,
                                           double target) {
  FixedStateSystem system(model.structure, model.contacts);
  system.SetStates(after.states, TangentialPositions(model.contacts, before.u));
  system.PinLoadFactor(target);
  const double share = (target - before.s) / (after.s - before.s);
  const Eigen::VectorXd start = (1.0 - share) * system.Pack(before) + share * system.Pack(after);
  const NearestPoint nearest = FindNearestPoint(&system, start, start.head(before.u.size() + 1));
  if (!nearest.converged) return std::nullopt;
  for (const Limit& limit : system.Inequalities())
    if (system.Value(limit, nearest.x) < -kInequalityTolerance) return std::nullopt;
  const PathPoint point = system.Unpack(nearest.x);
  if (Distance(before, point) > 2.0 * Distance(before, after)) return std::nullopt;
  return point;
}

}  // namespace

Preload TracePreload(const Model& model, int max_increments, const MethodFactory& make_method,
                     const std::function<bool()>& cancelled) {
  Preload preload;
  preload.point = model.InitialPoint();
  Eigen::VectorXd holding(model.structure.NumDofs());
  model.structure.InternalForce(preload.point.u, holding);
  const bool stressed = holding.lpNorm<Eigen::Infinity>() > kNothing;
  const double constant = model.structure.ConstantLoad().lpNorm<Eigen::Infinity>();
  if (!stressed && constant <= 0.0) {
    preload.done = true;
    return preload;
  }

  if (!stressed) holding.setZero();
  const Scene scene = PreloadScene(model, model.scaling.force * holding);
  Scaling scaling = model.scaling;
  scaling.load_factor = CharacteristicScales(scene).load_factor / CharacteristicScales(scene).force * scaling.force;
  const Model preload_model(scene, scaling);
  const double target = 1.0 / scaling.load_factor;
  const std::unique_ptr<PathMethod> method = make_method(preload_model);
  EventRecord ways;
  if (const std::optional<EndReason> reason = method->Start(preload.point, &ways, &preload.message)) {
    preload.reason = *reason;
    preload.message = kWhere + preload.message;
    return preload;
  }
  double longest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < max_increments; ++i) {
    if (cancelled && cancelled()) {
      preload.reason = EndReason::kCancelled;
      preload.message = kWhere + std::string("cancelled by the caller");
      return preload;
    }
    Advance advance = method->Next(preload.point, longest);
    for (AcceptedPoint& row : advance.rows) {
      if (row.point.s < target) {
        preload.point = std::move(row.point);
        if (row.kind != RowKind::kSmoothLimit && row.kind != RowKind::kCornerLimit) continue;
        preload.reason = EndReason::kPathEnd;
        preload.message = kWhere + LimitMessage(preload.point.s / target);
        return preload;
      }
      std::optional<PathPoint> point = PointAtLoadFactor(preload_model, preload.point, row.point, target);
      if (point) {
        preload.point = *std::move(point);
        preload.point.s = 0.0;
        preload.done = true;
        return preload;
      }
      longest = 0.5 * Distance(preload.point, row.point);
      break;
    }
    const bool stuck = longest < kSmallestStep;
    if (!advance.ended && !stuck) continue;
    preload.reason = stuck ? EndReason::kStepTooSmall : advance.reason;
    preload.message = kWhere + (stuck ? "their full size is not reached" : advance.message);
    return preload;
  }
  preload.reason = EndReason::kMaxIncrements;
  preload.message = kWhere + std::string("too many increments");
  return preload;
}

}  // namespace contact_path
