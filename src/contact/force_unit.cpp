#include "contact/force_unit.h"

#include <cmath>

#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr int kPowersApart = 20;  // 2^20 is about 1e6: nearly all scenes have the unit 1

}  // namespace

double ForceUnitAbove(double bound) {
  const double rounding = tolerances::kStiffForce * bound;
  if (rounding > 1.0 && std::isfinite(rounding))
    return std::ldexp(1.0, static_cast<int>(std::ceil(std::log2(rounding))));
  if (!(bound > 0.0) || !(bound < 1.0)) return 1.0;
  return std::ldexp(1.0, kPowersApart * static_cast<int>(std::ceil(std::log2(bound) / kPowersApart)));
}

}  // namespace contact_path
