#include "contact_path/path/preload.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "contact_path/law/active_set_tolerance.h"
#include "contact_path/path/branch_method.h"
#include "contact_path/path/diagnosis.h"
#include "contact_path/path/free_motion.h"
#include "contact_path/path/sentences.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr int kMostIncrements = 100000;  // to bring the constant loads on; not counted with the others

// By contact: what is to be taken back of an overlap at the start [scaled length].
std::vector<double> OverlapsAt(const Model& model, const PathPoint& start) {
  std::vector<double> overlaps;
  for (std::size_t i = 0; i < model.contacts.size(); ++i) {
    const double gap = model.contacts[i]->Gap(start.u, start.s, start.modes[i].piece);
    overlaps.push_back(model.scene.contacts[i].overlap == Overlap::kBringOn && gap < 0.0 ? -gap : 0.0);
  }
  return overlaps;
}

// The scene whose load factor, from 0 to 1, brings the constant loads on. holding: force of all parts at the start, by
// dof, in scene units.
Scene PreloadScene(const Model& model, const Eigen::VectorXd& holding, const std::vector<double>& overlaps) {
  Scene scene = model.scene;
  scene.loads.clear();
  scene.obstacle_motions.clear();
  scene.friction_changes.clear();
  for (const Load& load : model.scene.loads)
    if (load.constant) {
      scene.loads.push_back(load);
      scene.loads.back().constant = false;
    }
  for (std::size_t i = 0; i < overlaps.size(); ++i) {
    scene.contacts[i].overlap_at_0 = model.scaling.length * overlaps[i];
    scene.contacts[i].overlap_rate = -scene.contacts[i].overlap_at_0;
  }
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const int dof_x = model.structure.Dof(static_cast<int>(i), 0), dof_y = model.structure.Dof(static_cast<int>(i), 1);
    const int dof_rotation = model.structure.Dofs().Dof(static_cast<int>(i), Field::kRotation, 0);
    const double fx = dof_x < 0 ? 0.0 : holding[dof_x], fy = dof_y < 0 ? 0.0 : holding[dof_y];
    const double moment = dof_rotation < 0 ? 0.0 : model.scaling.length * holding[dof_rotation];
    if (fx == 0.0 && fy == 0.0 && moment == 0.0) continue;
    scene.loads.push_back({scene.nodes[i].name, fx, fy, true, moment});
    scene.loads.push_back({scene.nodes[i].name, -fx, -fy, false, -moment});
  }
  return scene;
}

}  // namespace

Preload TracePreload(const Model& model, int max_increments, const MethodFactory& make_method,
                     const std::function<bool()>& cancelled) {
  Preload preload;
  preload.point = model.InitialPoint();
  Eigen::VectorXd holding(model.structure.NumDofs());
  model.structure.InternalForce(preload.point.u, holding);
  for (std::size_t i = 0; i < model.laws.size(); ++i) {
    const PortReals forces = model.laws.Of(preload.point.forces, i);
    if (forces == PortReals{}) continue;
    PortsAt at;
    model.laws[i].Evaluate(preload.point.u, preload.point.s, preload.point.modes[i].piece, {}, &at);
    for (std::size_t p = 0; p < model.laws[i].NumPorts(); ++p)
      at.AddForce(at[p].gradient, -forces[p] * at[p].factor, &holding);
  }
  // Stiff parts have forces that rounding of the positions makes.
  const bool stressed = (holding.array().abs() >
                         (tolerances::kMargin * model.structure.ForceRounding().array()).max(tolerances::kRounding))
                            .any();
  const double constant = model.structure.Loads().Constant().lpNorm<Eigen::Infinity>();
  const std::vector<double> overlaps = OverlapsAt(model, preload.point);
  const bool fits = std::any_of(overlaps.begin(), overlaps.end(), [](double overlap) { return overlap > 0.0; });
  if (!stressed && !fits && constant <= 0.0) {
    preload.done = true;
    return preload;
  }

  if (!stressed) holding.setZero();
  const Scene scene = PreloadScene(model, model.scaling.force * holding, overlaps);
  Scaling scaling = model.scaling;
  scaling.load_factor = LoadFactorScale(scene, model.index, scaling.length, scaling.force);
  const Model preload_model(scene, model.configuration, scaling);
  preload.point = preload_model.InitialPoint();
  const double target = 1.0 / scaling.load_factor;
  const std::unique_ptr<PathMethod> method = make_method(preload_model, target);
  const auto end = [&preload](EndReason reason, const Causes& causes) {
    preload.end = {reason, {{sentences::kConstantLoads}}};
    Append(causes, &preload.end.causes);
    return preload;
  };
  IncrementFindings found;
  if (const std::optional<End> none = method->Start(preload.point, &found)) return end(none->reason, none->causes);
  for (int i = 0; i < max_increments; ++i) {
    if (cancelled && cancelled()) return end(EndReason::kCancelled, {{sentences::kCancelled}});
    Advance advance = method->Next(preload.point);
    if (advance.increment) {
      preload.point = std::move(advance.increment->point);
      const IncrementKind kind = advance.increment->kind;
      if (IsAtTarget(preload.point.s, target)) {
        preload.point.s = 0.0;
        preload.done = true;
        return preload;
      }
      if (kind == IncrementKind::kSmoothLimit || kind == IncrementKind::kCornerLimit ||
          (advance.end && advance.end->reason == EndReason::kAtLimit))
        return end(EndReason::kPathEnd, {{sentences::kLimitPointOfLoads, {}, preload.point.s / target}});
    }
    if (advance.end) return end(advance.end->reason, advance.end->causes);
  }
  return end(EndReason::kMaxIncrements, {{sentences::kTooManyIncrements}});
}

Preload TraceStart(const Model& model, Accuracy accuracy, const std::function<bool()>& cancelled) {
  Scene resting = model.scene;
  resting.support_motions.clear();
  const bool moves = !model.structure.PrescribedDofs().empty();
  const std::unique_ptr<const Model> other =
      moves ? std::make_unique<const Model>(resting, model.configuration, model.scaling) : nullptr;
  const Model& start = moves ? *other : model;
  const MethodFactory make_method = [&](const Model& of, double target) -> std::unique_ptr<PathMethod> {
    TraceOptions upwards;
    upwards.accuracy = accuracy;
    upwards.stability = DefaultTrue::kFalse;
    BranchOptions options = BranchOptions::For(upwards, AutomaticStepGrowth(of));
    options.load_factor = target;
    options.forward = true;
    options.at_limit = AtLimit::kStop;  // a limit point ends it
    return std::make_unique<BranchMethod>(of, options, cancelled);
  };
  Preload preload = TracePreload(start, kMostIncrements, make_method, cancelled);
  if (preload.done) {
    if (moves) preload.point = model.Transfer(start, preload.point);
    return preload;
  }
  const double force = ActiveSetTolerance::For(0.0, 0.0).force;
  if (IsStuck(preload.end.reason))
    if (const std::string free = FreeMotionQuestion(start, preload.point, force); !free.empty())
      preload.end.causes.push_back({sentences::kFreeNodes, free});
  if (preload.end.reason == EndReason::kMaxIncrements) preload.end.reason = EndReason::kNumericalFailure;
  NameInvertedElement(start, preload.point, &preload.end);
  return preload;
}

}  // namespace contact_path
