#include "contact_path/path/balanced_step.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr int kMostShorter = 6;  // times half as long

}  // namespace

std::optional<BalancedStep> NextBalancedStep(const Model& model, const BranchOptions& options, ModeArc* arc,
                                             const CurvePoint& from, double length, const StepEnds& ends,
                                             std::optional<double> stored) {
  const StepLimits limits = {options.smallest_step, options.step, options.prediction, options.smallest_cosine,
                             options.on_trial};
  std::optional<BalancedStep> best;
  for (int shorter = 0; shorter <= kMostShorter; ++shorter) {
    std::optional<ArcStep> at = NextStep(arc, from, length, limits, ends);
    if (!at) break;
    if (best) at->rejected += best->at.rejected + 1;
    best.emplace();
    best->at = *std::move(at);
    if (Balance(model, arc->system(), stored, &*best)) break;
    if (options.on_trial)
      options.on_trial(
          {best->at.step.length, kEnergiesOff, {}, {{"work", best->work.loads}, {"friction", best->work.friction}}});
    length = 0.5 * std::min(best->at.tried, best->at.step.length);
    if (length < options.smallest_step) break;
  }
  return best;
}

bool Balance(const Model& model, const FixedModeSystem& system, std::optional<double> stored, BalancedStep* step) {
  const Step& of = step->at.step;
  const double unit = model.scaling.force * model.scaling.length;
  const auto stored_at = [&](const Eigen::VectorXd& x) { return system.Energy(x) * unit; };
  const double before = stored ? *stored : stored_at(of.start.x);
  step->stored = before;
  if (!(of.length > 0.0)) return true;
  step->work = WorkOfStep(model, system, of);
  step->stored = stored_at(of.end.x);
  const double change = step->stored - before;
  const double taken = step->work.friction - step->work.given_back;
  const double exchanged =
      std::abs(step->work.loads) + step->work.given_back + std::abs(step->work.friction) + std::abs(change);
  return std::abs(step->work.loads - taken - change) <=
         tolerances::kEnergyOfStep * exchanged + tolerances::kEqual * (before + unit);
}

}  // namespace contact_path
