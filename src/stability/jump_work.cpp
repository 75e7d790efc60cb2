#include "stability/jump_work.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace contact_path {

void WorkOfMotion::Add(const PathPoint& from, const MotionStep& step, bool pushed, Work* work) {
  bool impact = pushed;
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    impact = impact || step.closed_after[i] != 0.0 ||
             (from.states[i] != ContactState::kOpen && from.Patch(i) != step.point.Patch(i));
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    if (contacts_[i]->Frictional()) work->friction += OfContact(i, from, step, impact, work);
  work->after_impact = impact;
  const PathPoint& to = step.point;
  const Eigen::VectorXd du = to.u - from.u;
  work->loads += 0.5 * (from.s + to.s) * structure_.ReferenceLoad().dot(du) + structure_.ConstantLoad().dot(du);
  if (to.s != from.s) work->loads += 0.5 * (DrivingForce(from) + DrivingForce(to)) * (to.s - from.s);
}

double WorkOfMotion::OfContact(std::size_t i, const PathPoint& from, const MotionStep& step, bool impact,
                               Work* work) const {
  const ContactPair& pair = *contacts_[i];
  const PathPoint& to = step.point;
  const auto k = static_cast<Eigen::Index>(i);
  const auto slip = [&] { return pair.Slip(from.u, from.s, from.Patch(i), to.u - from.u, to.s - from.s, to.Patch(i)); };
  if (pair.HasTotalLaw()) return -0.5 * (from.rt[k] + to.rt[k]) * slip();
  const bool known = from.states[i] != ContactState::kOpen && !work->after_impact;  // the force at the start
  const double owed = std::exchange(work->owed[i], 0.0), before = pair.Friction() * from.rn[k];
  if (Slips(to.states[i])) {
    const double length = std::abs(slip() * (1.0 - step.closed_after[i])), after = pair.Friction() * to.rn[k];
    if (impact && from.states[i] == ContactState::kOpen) {
      work->owed[i] = length;
      return 0.0;
    }
    if (impact) return (known ? std::min(before, after) : after) * (length + owed);
    if (!known) {
      work->owed[i] = length + owed;
      return after * (length + owed);
    }
    const double slope = work->slopes[i] = length > 0.0 ? (before - after) / length : 0.0;
    return 0.5 * (before + after) * length + 0.5 * slope * owed * owed;
  }
  const double force = pair.Friction() * (to.states[i] == ContactState::kOpen ? from : to).rn[k];
  if (to.states[i] != ContactState::kOpen || !Slips(from.states[i])) return 0.0;
  // It slides until nothing presses it: as far as its force falls on as it has fallen.
  const double length = std::abs(slip());
  return 0.5 * force * (work->slopes[i] > 0.0 ? std::min(length, force / work->slopes[i]) : length);
}

double WorkOfMotion::DrivingForce(const PathPoint& at) {
  driving_.SetStates(at.states, SlipReferences(contacts_, at), at.patches);
  const Eigen::VectorXd x = driving_.Pack(at), still = Eigen::VectorXd::Zero(x.size());
  return driving_.DrivingForceAlong(x, still, still).value;
}

}  // namespace contact_path
