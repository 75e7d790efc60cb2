#include "support/reference_cases.h"

#include <cmath>

namespace contact_path {
namespace sliding_bar {

Scene MakeScene() {
  Scene scene;
  scene.name = "sliding_bar";
  scene.nodes = {{"a", 0.0, kHeight, true, true}, {"b", -kHeight, 0.0, false, false}};
  scene.bars = {{{"a", "b"}, kEA, 0.0, StrainMeasure::kBiot}};
  scene.loads = {{"b", 1.0, 0.0, false}};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, kFriction}};
  scene.contacts = {{"b", "floor"}};
  return scene;
}

double LoadFactor(double x) {
  return kEA * (1.0 / std::hypot(x, kHeight) - 1.0 / kRestLength) * (kHeight * kFriction - x);
}

double LoadFactorSlope(double x) {
  const double l = std::hypot(x, kHeight);
  return -kEA * (x / (l * l * l) * (kHeight * kFriction - x) + 1.0 / l - 1.0 / kRestLength);
}

double NormalReaction(double x) { return kEA * kHeight * (1.0 / std::hypot(x, kHeight) - 1.0 / kRestLength); }

double Dissipation(double x) {
  const auto antiderivative = [](double at) { return std::asinh(at / kHeight) - at / kRestLength; };
  return kFriction * kEA * kHeight * (antiderivative(x) - antiderivative(-kHeight));
}

}  // namespace sliding_bar

namespace rough_truss {
namespace {

const double kRestLength = std::hypot(kHalfSpan, kRise);
const double kSlope = std::atan(1.0 / kFriction);
const double kCornerLength = kHalfSpan / std::cos(kSlope);

}  // namespace

double CornerLoad() { return 2.0 * std::sin(kSlope) * (1.0 - kCornerLength / kRestLength); }

double StickingLoad(double apex_y) { return 2.0 * apex_y * (1.0 / std::hypot(kHalfSpan, apex_y) - 1.0 / kRestLength); }

// The apex stays over the middle of the feet, the left one at -b.
double SlidingLoad(double foot_x) {
  const double length = 0.5 * (foot_x + kHalfSpan) / std::cos(kSlope);
  return 2.0 * std::sin(kSlope) * (1.0 - length / kRestLength);
}

// The integral of mu r_n = mu s / 2 over the distance that the foot slides.
double Dissipation(double foot_x) {
  return 0.25 * kFriction * (CornerLoad() + SlidingLoad(foot_x)) * (foot_x - kHalfSpan);
}

double TotalDissipation() { return std::pow(std::cos(kSlope) * (kRestLength - kCornerLength), 2) / kRestLength; }

}  // namespace rough_truss

namespace von_mises {

double BiotLimit(double half_span, double rise) {
  return 2.0 * std::pow(1.0 - std::pow(half_span / std::hypot(half_span, rise), 2.0 / 3.0), 1.5);
}

double GreenLagrangeLimit(double half_span, double rise) {
  return 2.0 * std::pow(rise / std::hypot(half_span, rise), 3) / (3.0 * std::sqrt(3.0));
}

double BiotLoad(double half_span, double rise, double apex_y) {
  return 2.0 * apex_y * (1.0 / std::hypot(half_span, apex_y) - 1.0 / std::hypot(half_span, rise));
}

}  // namespace von_mises
}  // namespace contact_path
