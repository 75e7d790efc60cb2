#include "contact_path/path/friction_end.h"

#include <cmath>

#include "contact_path/path/sentences.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr double kLeft = 1e-6;  // of the friction at the load factor 0

double RoundingOf(double s) { return tolerances::kEqual * (1.0 + std::abs(s)); }

}  // namespace

FrictionEnds::FrictionEnds(const Model& model) : unknown_(model.structure.NumDofs()) {
  for (const FrictionChange& change : model.scene.friction_changes) {
    const Obstacle& obstacle = model.scene.obstacles[model.index.Obstacle(change.obstacle)];
    for (const ContactCandidate& contact : model.scene.contacts) {
      if (contact.OnSurface() || contact.at_eye || contact.obstacle != change.obstacle) continue;
      const double load_factor = -contact.FrictionWith(obstacle) / change.rate;
      const FrictionEnd end{change.obstacle, load_factor, (1.0 - kLeft) * load_factor / model.scaling.load_factor};
      auto beside = ends_.begin();  // on the same side
      while (beside != ends_.end() && beside->s * end.s <= 0.0) ++beside;
      if (beside == ends_.end())
        ends_.push_back(end);
      else if (std::abs(end.s) < std::abs(beside->s))
        *beside = end;
    }
  }
}

void FrictionEnds::AddTo(ArcTargets* targets) const {
  for (const FrictionEnd& end : ends_) {
    ArcTarget& target = targets->emplace_back();
    target.unknown = unknown_;
    target.of = [i = unknown_](const Eigen::VectorXd& x) { return x[i]; };
    target.values = {end.s};
    target.rounding = RoundingOf(end.s);
  }
}

std::vector<double> FrictionEnds::LoadFactors() const {
  std::vector<double> load_factors;
  for (const FrictionEnd& end : ends_) load_factors.push_back(end.s);
  return load_factors;
}

std::optional<Cause> FrictionEnds::At(const PathPoint& point) const {
  for (const FrictionEnd& end : ends_)
    if (point.s * end.s > 0.0 && std::abs(point.s) >= std::abs(end.s) - RoundingOf(end.s))
      return Cause{sentences::kFrictionEnds, end.obstacle, end.load_factor};
  return std::nullopt;
}

}  // namespace contact_path
