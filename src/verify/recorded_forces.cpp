#include "verify/recorded_forces.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <locale>
#include <sstream>
#include <tuple>
#include <vector>

namespace contact_path {

std::string ForcesContradicted(const Increment& increment, const CheckedForces& anew, const Scaling& scaling,
                               double tolerance, double rounding) {
  const double moment = scaling.force * scaling.length;
  std::ostringstream text;
  text.imbue(std::locale::classic());
  // part: what the forces are of, numbered from 1.
  const auto differ = [&](const char* part, const std::vector<Resultant>& recorded,
                          const std::vector<std::array<double, 3>>& forces) {
    for (std::size_t i = 0; i < forces.size(); ++i)
      for (const auto& [name, is, be, unit] : {std::tuple("rx", recorded[i].rx, forces[i][0], scaling.force),
                                               std::tuple("ry", recorded[i].ry, forces[i][1], scaling.force),
                                               std::tuple("rm", recorded[i].rm, forces[i][2], moment)})
        if (!(std::abs(is - be) / unit <= tolerance * (1.0 + std::abs(be) / unit) + rounding)) {
          text << name << " of " << part << " " << i + 1 << " is recorded as " << is << ", but is " << be;
          return true;
        }
    return false;
  };
  if (!differ("support", increment.supports, anew.supports)) differ("boundary", increment.boundaries, anew.boundaries);
  return text.str();
}

}  // namespace contact_path
