// Scenes with closed forms, made for what is hard to follow: touching without pressing, ends of paths, bifurcations.
#ifndef CONTACT_PATH_TEST_BRANCH_EXAMPLE_SCENES_H_
#define CONTACT_PATH_TEST_BRANCH_EXAMPLE_SCENES_H_

#include <cmath>

#include "contact_path/scene/scene.h"
#include "support/reference_cases.h"

namespace contact_path {

// A node that passes under the top of a circle: a von Mises truss (half span 1, rise 1, load (0, -s) at the apex) and a
// node q, without load, on bars from the apex and from the active point c = (0.5, 1). The bars of q stay without
// stress, so q moves on the circle of radius 0.5 about c and is on top of it, at (0.5, 1.5), where the apex is at y =
// 0.9. Ceiling over q at the height `clearance` above the circle; 0: it touches the circle.
namespace swing {

constexpr double kCentreX = 0.5, kCentreY = 1.0, kRadius = 0.5, kApexOnTop = 0.9;
inline const double kArm = std::hypot(kCentreX, kCentreY + kRadius - kApexOnTop);  // apex to q

// Height of the apex where q is at the angle theta from the top of the circle, towards +x.
inline double ApexY(double theta) {
  const double x = kCentreX + kRadius * std::sin(theta), y = kCentreY + kRadius * std::cos(theta);
  return y - std::sqrt(kArm * kArm - x * x);
}

inline double Load(double theta) { return von_mises::BiotLoad(1.0, 1.0, ApexY(theta)); }

// Angle of q where the apex is at y = 1: by Newton's method.
inline double StartAngle() {
  double theta = 0.2;
  for (int i = 0; i < 50; ++i) {
    const double slope = (ApexY(theta + 1e-6) - ApexY(theta - 1e-6)) / 2e-6;
    theta -= (ApexY(theta) - 1.0) / slope;
  }
  return theta;
}

// Angles where q touches a ceiling below the top of the circle: +-.
inline double TouchingAngle(double clearance) { return std::acos(1.0 + clearance / kRadius); }

inline Scene MakeScene(double clearance, double friction) {
  const double theta = StartAngle();
  const double x = kCentreX + kRadius * std::sin(theta), y = kCentreY + kRadius * std::cos(theta);
  Scene scene;
  scene.name = "swing";
  scene.nodes = {{"left", -1.0, 0.0, true, true},
                 {"apex", 0.0, 1.0},
                 {"right", 1.0, 0.0, true, true},
                 {"c", kCentreX, kCentreY, true, true},
                 {"q", x, y}};
  scene.bars = {{{"left", "apex"}, 1.0},
                {{"apex", "right"}, 1.0},
                {{"c", "q"}, 1.0, kRadius, StrainMeasure::kBiot},
                {{"apex", "q"}, 1.0, kArm, StrainMeasure::kBiot}};
  scene.loads = {{"apex", 0.0, -1.0}};
  scene.obstacles = {{"ceiling", ObstacleShape::kHalfPlane, 0.0, kCentreY + kRadius + clearance, 0.0, -1.0, friction}};
  scene.contacts = {{"q", "ceiling"}};
  return scene;
}

}  // namespace swing

// A path that really ends. A block p on a floor, pressed down by the constant load 1, mu = 0.2, pushed off its start
// (1, 0) by the negative spring -3 (p.x - 1); two bars (EA = 1, l0 = 1.25, without stress) from p to nodes on the line
// x = 0 at y =
// +-0.75, drawn apart by s. The block sticks until its bars pull with 0.2, at l = 1 / 0.7; then it slides towards the
// line, at
//   l(w) = w / (1.4 - 0.7 w),  y(w)^2 = l^2 - w^2,  s(w) = (0.8 - 1 / l) y,  w = p.x,
// while the nodes come back to the floor, y = 0, at w = 4/7. There the bars pull the block least, and there it stops
// sliding. It cannot slide on, and it cannot stick: in any other position of the nodes the bars would pull more than
// friction holds. No equilibrium is near.
namespace snap_block {

constexpr double kEndX = 4.0 / 7.0;
constexpr double kFriction = 0.2;

inline double Length(double w) { return w / (1.4 - 0.7 * w); }
inline double Height(double w) { return std::sqrt(std::max(0.0, Length(w) * Length(w) - w * w)); }
inline double SlidingLoad(double w) { return (0.8 - 1.0 / Length(w)) * Height(w); }
inline double StickingLoad(double y) { return (0.8 - 1.0 / std::hypot(1.0, y)) * y; }
inline double Dissipation(double w) { return kFriction * (1.0 - w); }

inline Scene MakeScene() {
  Scene scene;
  scene.name = "snap_block";
  scene.nodes = {{"p", 1.0, 0.0}, {"up", 0.0, 0.75, true, false}, {"down", 0.0, -0.75, true, false}};
  scene.bars = {{{"p", "up"}, 1.0}, {{"p", "down"}, 1.0}};
  scene.superelements = {{{"p"}, {-3.0, 0.0, 0.0, 1.0}}};
  scene.loads = {{"up", 0.0, 1.0}, {"down", 0.0, -1.0}, {"p", 0.0, -1.0, true}};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, kFriction}};
  scene.contacts = {{"p", "floor"}};
  return scene;
}

}  // namespace snap_block

// A von Mises truss so steep that it gives way to the side before it snaps through: half span 1, rise h, EA = 1. The
// stiffness against sideways motion is zero where y^2 l0 = l^3.
namespace tall_truss {

constexpr double kRise = 2.5;
inline const double kRestLength = std::hypot(1.0, kRise);

inline double BifurcationY() {
  double y = kRise;
  for (int i = 0; i < 100; ++i) {  // Newton's method, from above
    const double l2 = 1.0 + y * y, l = std::sqrt(l2);
    y -= (y * y * kRestLength - l2 * l) / (2.0 * y * kRestLength - 3.0 * l * y);
  }
  return y;
}

inline Scene MakeScene(double rise = kRise) {
  Scene scene;
  scene.name = "tall_truss";
  scene.nodes = {{"left", -1.0, 0.0, true, true}, {"apex", 0.0, rise}, {"right", 1.0, 0.0, true, true}};
  scene.bars = {{{"left", "apex"}, 1.0}, {{"apex", "right"}, 1.0}};
  scene.loads = {{"apex", 0.0, -1.0}};
  return scene;
}

}  // namespace tall_truss

// A block on a floor, held by linear springs: K = [[2, 0], [0, 2]], pressed down by the constant load 1, mu = 0.5, load
// (s, 0).
inline Scene SpringAndBlock() {
  Scene scene;
  scene.name = "spring_and_block";
  scene.nodes = {{"p", 0.0, 0.0}};
  scene.superelements = {{{"p"}, {2.0, 0.0, 0.0, 2.0}}};
  scene.loads = {{"p", 1.0, 0.0}, {"p", 0.0, -1.0, true}};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.5}};
  scene.contacts = {{"p", "floor"}};
  return scene;
}

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_BRANCH_EXAMPLE_SCENES_H_
