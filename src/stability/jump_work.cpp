#include "stability/jump_work.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace contact_path {

void WorkOfMotion::Add(const PathPoint& from, const MotionStep& step, bool pushed, Work* work) const {
  bool impact = pushed;
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    impact =
        impact || step.closed_after[i] != 0.0 ||
        (from.states[i] != ContactState::kOpen && !contacts_[i]->Seamless() && from.Patch(i) != step.point.Patch(i));
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    if (contacts_[i]->Frictional()) work->friction += OfContact(i, from, step, impact, work);
  work->after_impact = impact;
  const PathPoint& to = step.point;
  const Eigen::VectorXd du = to.u - from.u;
  work->loads += 0.5 * (from.s + to.s) * structure_.ReferenceLoad().dot(du) + structure_.ConstantLoad().dot(du);
}

double WorkOfMotion::OfContact(std::size_t i, const PathPoint& from, const MotionStep& step, bool impact,
                               Work* work) const {
  const ContactPair& pair = *contacts_[i];
  const PathPoint& to = step.point;
  const auto k = static_cast<Eigen::Index>(i);
  const auto slip = [&] { return pair.Slip(from.u, from.s, from.Patch(i), to.u - from.u, to.s - from.s, to.Patch(i)); };
  if (pair.HasTotalLaw()) return -0.5 * (from.rt[k] + to.rt[k]) * slip();
  const bool known = from.states[i] != ContactState::kOpen && !work->after_impact;  // the force at the start
  Work::Slide& slide = work->slides[i];
  const double owed = std::exchange(slide.owed, 0.0), length_before = std::exchange(slide.length, 0.0),
               before = pair.Friction() * from.rn[k];
  const std::optional<double> behind = std::exchange(slide.behind, std::nullopt);
  if (Slips(to.states[i])) {
    const double length = std::abs(slip() * (1.0 - step.closed_after[i])), after = pair.Friction() * to.rn[k];
    if (impact && from.states[i] == ContactState::kOpen) {
      slide.owed = length;
      return 0.0;
    }
    if (impact) return (known ? std::min(before, after) : after) * (length + owed);
    if (!known) {
      slide.owed = length + owed;
      return after * (length + owed);
    }
    const double slope = length > 0.0 ? (before - after) / length : 0.0;
    double work_done = 0.5 * (before + after) * length + std::max(0.5 * slope * owed, -before) * owed;
    if (length_before > 0.0) {
      // The force is before - slope x + bend x (length - x), and the mean of that stays between those at the ends.
      const double bend = (slope - slide.slope) / (length + length_before), most = 3.0 * std::abs(slope);
      work_done += std::clamp(bend * length, -most, most) * length * length / 6.0;
      if (behind && std::abs(bend) * std::max(*behind, length_before / 3.0) <= std::abs(slide.slope))
        work_done +=
            bend * (std::pow(length_before, 3) / 6.0 - *behind * *behind * (0.5 * length_before + *behind / 3.0));
    } else {
      slide.behind = owed;
    }
    slide.slope = slope;
    slide.length = length;
    return work_done;
  }
  const double force = pair.Friction() * (to.states[i] == ContactState::kOpen ? from : to).rn[k];
  if (to.states[i] != ContactState::kOpen || !Slips(from.states[i])) return 0.0;
  // It slides until nothing presses it: as far as its force falls on as it has fallen.
  const double length = std::abs(slip());
  return 0.5 * force * (slide.slope > 0.0 ? std::min(length, force / slide.slope) : length);
}

}  // namespace contact_path
