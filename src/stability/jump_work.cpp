#include "stability/jump_work.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace contact_path {

namespace {

// |force| of the port p per force of port 0 where it slides, the largest of the states; 0: it does not, in any state.
double RatioOf(const Law& law, std::size_t p) {
  double largest = 0.0;
  for (int state = 0; state < law.NumStates(); ++state)
    if (const PortRule& port = law.In(state).ports[p]; port.Follows())
      largest = std::max(largest, std::abs(port.ratio));
  return largest;
}

// The work of a port of the law i.
double OfPort(const Laws& laws, std::size_t i, std::size_t p, const PathPoint& from, const MotionStep& step,
              bool impact, Work* work) {
  const Law& law = laws[i];
  const PathPoint& to = step.point;
  const Eigen::Index leads = laws.FirstPort(i), follows = leads + static_cast<Eigen::Index>(p);
  const StateRule &was = law.In(from.modes[i]), &is = law.In(to.modes[i]);
  const double ratio = RatioOf(law, p);
  const auto travel = [&] {
    return law.Travel(p, from.u, from.s, from.modes[i].piece, to.u - from.u, to.s - from.s, to.modes[i].piece);
  };
  if (law.Holonomic()) return -0.5 * (from.forces[follows] + to.forces[follows]) * travel();
  const bool known = !was.idle && !work->after_impact;  // the force at the start
  Work::Slide& slide = work->slides[static_cast<std::size_t>(follows)];
  const double owed = std::exchange(slide.owed, 0.0), length_before = std::exchange(slide.length, 0.0),
               before = ratio * from.forces[leads];
  const std::optional<double> behind = std::exchange(slide.behind, std::nullopt);
  if (is.ports[p].Follows()) {
    const double length = std::abs(travel() * (1.0 - step.acts_after[i])), after = ratio * to.forces[leads];
    if (impact && was.idle) {
      slide.owed = length;
      return 0.0;
    }
    if (impact) return (known ? std::min(before, after) : after) * (length + owed);
    if (!known) {
      slide.owed = length + owed;
      return after * (length + owed);
    }
    const double slope = length > 0.0 ? (before - after) / length : 0.0;
    double work_done = 0.5 * (before + after) * length + 0.5 * slope * owed * owed;
    if (length_before > 0.0) {
      // The force is before - slope x + bend x (length - x), and the mean of that stays between those at the ends.
      const double bend = (slope - slide.slope) / (length + length_before), most = 3.0 * std::abs(slope);
      work_done += std::clamp(bend * length, -most, most) * length * length / 6.0;
      if (behind)
        work_done +=
            bend * (std::pow(length_before, 3) / 6.0 - *behind * *behind * (0.5 * length_before + *behind / 3.0));
    } else {
      slide.behind = owed;
    }
    slide.slope = slope;
    slide.length = length;
    return work_done;
  }
  const double force = ratio * (is.idle ? from : to).forces[leads];
  if (!is.idle || !was.ports[p].Follows()) return 0.0;
  // It slides until nothing presses it: as far as its force falls on as it has fallen.
  const double length = std::abs(travel());
  return 0.5 * force * (slide.slope > 0.0 ? std::min(length, force / slide.slope) : length);
}

}  // namespace

void AddWork(const Structure& structure, const Laws& laws, const PathPoint& from, const MotionStep& step, bool pushed,
             Work* work) {
  const PathPoint& to = step.point;
  bool impact = pushed;
  for (std::size_t i = 0; i < laws.size(); ++i)
    impact = impact || step.acts_after[i] != 0.0 ||
             (!laws[i].In(from.modes[i]).idle && laws[i].ChangesPiece(from.modes[i].piece, to.modes[i].piece));
  for (std::size_t i = 0; i < laws.size(); ++i)
    for (std::size_t p = 1; p < laws[i].NumPorts(); ++p)
      if (laws[i].LargestRatio() > 0.0) work->dissipation += OfPort(laws, i, p, from, step, impact, work);
  work->after_impact = impact;
  const Eigen::VectorXd du = to.u - from.u;
  work->loads += structure.Loads().Work(from.s, to.s, du);
}

}  // namespace contact_path
