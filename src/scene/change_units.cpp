#include "contact_path/scene/change_units.h"

namespace contact_path {
namespace {

// size * base^exponent
double Raise(double size, double base, int exponent) {
  for (; exponent > 0; --exponent) size *= base;
  for (; exponent < 0; ++exponent) size /= base;
  return size;
}

}  // namespace

double SizeOf(const Unit& unit, const UnitSizes& sizes) {
  return Raise(Raise(Raise(1.0, sizes.force, unit.force), sizes.length, unit.length), sizes.load_factor,
               unit.load_factor);
}

}  // namespace contact_path
