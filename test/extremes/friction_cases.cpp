// Coefficients of friction from none to a million.
#include <cmath>

#include "extremes/extreme_case.h"
#include "support/reference_cases.h"

namespace contact_path {
namespace {

// The foot of scenes/sliding_bar.yaml slides towards +x whatever the friction: s = EA (1/l - 1/l0) (h mu - x).
ExtremeCase SlidingBar(double friction) {
  ExtremeCase extreme{"coefficient of friction, sliding", "mu = " + Text(friction)};
  Scene scene = sliding_bar::MakeScene();
  scene.obstacles[0].friction = friction;
  // The load grows with mu, and the path with the load.
  extreme.request = Until(scene, "b.x", ">", 4.9, 0.02 * std::max(1.0, friction), 20000);
  extreme.exact = "closed form";
  extreme.error = [friction](const TraceRequest&, const Increment& increment) {
    if (increment.index == 0) return std::abs(increment.load_factor);
    const ContactState sliding = friction > 0.0 ? ContactState::kSlipPlus : ContactState::kClosed;
    if (increment.contacts[0].state != sliding) return HUGE_VAL;
    const double x = increment.positions[2], y = increment.positions[3];
    const double stiffness =
        sliding_bar::kEA * (1.0 / std::hypot(x, sliding_bar::kHeight) - 1.0 / sliding_bar::kRestLength);
    const double load = stiffness * (sliding_bar::kHeight * friction - x), unit = std::max(1.0, friction);
    return Largest(
        {(increment.load_factor - load) / unit, y, increment.contacts[0].rn - stiffness * sliding_bar::kHeight});
  };
  return extreme;
}

// The foot of scenes/rough_truss.yaml never slips: the truss snaps through.
ExtremeCase StickingTruss(double friction) {
  ExtremeCase extreme{"coefficient of friction, sticking", "mu = " + Text(friction)};
  Scene scene;
  scene.nodes = {{"left", -1.0, 0.0, true, true}, {"foot", 1.0, 0.0}, {"apex", 0.0, 1.2, true, false}};
  scene.bars = {{{"left", "apex"}, 1.0}, {{"apex", "foot"}, 1.0}};
  scene.loads = {{"apex", 0.0, -1.0}};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, friction}};
  scene.contacts = {{"foot", "floor"}};
  // Slope of the bars 1 / mu: there it would slip.
  extreme.request = Until(scene, "apex.y", "<", 1.01 / friction);
  extreme.exact = "closed form";
  extreme.error = [friction](const TraceRequest&, const Increment& increment) {
    const double y = increment.positions[5];
    // A last increment beyond the end slips, at the slope 1 / mu.
    if (increment.contacts[0].state == ContactState::kSlipPlus) return std::abs(y - increment.positions[2] / friction);
    if (increment.contacts[0].state != ContactState::kStick) return HUGE_VAL;
    return Largest({increment.load_factor - rough_truss::StickingLoad(y), increment.positions[2] - 1.0,
                    increment.positions[3], increment.contacts[0].rn - 0.5 * rough_truss::StickingLoad(y)});
  };
  return extreme;
}

}  // namespace

void AddFrictionCases(std::vector<ExtremeCase>* cases) {
  for (const double friction : {0.0, 1e-12, 1e-6, 1e-3, 0.3, 10.0, 1e3, 1e6}) cases->push_back(SlidingBar(friction));
  for (const double friction : {2.0, 1e3, 1e6}) cases->push_back(StickingTruss(friction));
}

}  // namespace contact_path
