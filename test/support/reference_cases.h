// Closed forms of the reference cases, written from their statements, in the units of the cases.
#ifndef CONTACT_PATH_TEST_SUPPORT_REFERENCE_CASES_H_
#define CONTACT_PATH_TEST_SUPPORT_REFERENCE_CASES_H_

#include "contact_path/scene/scene.h"

namespace contact_path {

// Kanno & Martins 2005, Example 4.1 (scenes/sliding_bar.yaml): the foot b of a bar slides on a rough floor towards +x
// under the pinned end, at height h above the floor.
namespace sliding_bar {

constexpr double kHeight = 5.0;
constexpr double kFriction = 0.3;
constexpr double kEA = 14.142135623730951;
constexpr double kRestLength = 7.0710678118654755;
// Smooth limit points.
constexpr double kFirstLimitX = -1.9858302481884527, kFirstLimit = 2.191505308;
constexpr double kSecondLimitX = 3.23254263015269, kSecondLimit = -0.650152200;

Scene MakeScene();
double LoadFactor(double x);       // s = EA (1/l - 1/l0) (h mu - x)
double LoadFactorSlope(double x);  // ds/dx
double NormalReaction(double x);   // EA h (1/l - 1/l0)
double Dissipation(double x);      // integral of mu r_n from the start to x

}  // namespace sliding_bar

// Von Mises truss with the right foot on a rough floor (scenes/rough_truss.yaml).
namespace rough_truss {

constexpr double kHalfSpan = 1.0;
constexpr double kRise = 1.2;
constexpr double kFriction = 1.0;

double CornerLoad();                 // where the slope of the bars is 1 / mu
double StickingLoad(double apex_y);  // load with the feet where they are
double SlidingLoad(double foot_x);   // load with the bars at the slope 1 / mu, sliding outwards
double Dissipation(double foot_x);   // while sliding from the corner
double TotalDissipation();           // until the load is zero

}  // namespace rough_truss

// Von Mises truss without contact, half span b and rise h, EA = 1.
namespace von_mises {

double BiotLimit(double half_span, double rise);           // 2 (1 - c^(2/3))^(3/2), c = b / l0
double GreenLagrangeLimit(double half_span, double rise);  // 2 (h / l0)^3 / (3 sqrt 3)
double BiotLoad(double half_span, double rise, double apex_y);

}  // namespace von_mises

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SUPPORT_REFERENCE_CASES_H_
