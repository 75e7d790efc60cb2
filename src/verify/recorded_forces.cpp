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

std::string AnswersContradicted(const Increment& increment, const CheckedAnswers& anew, const Scaling& scaling,
                                double tolerance, double rounding, double motion) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  // part: what the number is of, counted from 1. off: of the unit, what rounding may leave.
  const auto differs = [&](const char* name, const char* part, std::size_t i, double is, double be, double unit,
                           double off) {
    if (std::abs(is - be) / unit <= tolerance * (1.0 + std::abs(be) / unit) + off) return false;
    text << name << " of " << part << " " << i + 1 << " is recorded as " << is << ", but is " << be;
    return true;
  };
  const double force = scaling.force, length = scaling.length;
  for (std::size_t i = 0; i < increment.sections.size(); ++i) {
    const SectionForces& of = increment.sections[i];
    const std::array<double, 5>& be = anew.sections[i];
    if (differs("N", "section", i, of.N, be[0], force, rounding) ||
        differs("Q", "section", i, of.Q, be[1], force, rounding) ||
        differs("M", "section", i, of.M, be[2], force * length, rounding) ||
        differs("M1", "section", i, of.M1, be[3], force * length, rounding) ||
        differs("M2", "section", i, of.M2, be[4], force * length, rounding))
      return text.str();
  }
  const double stress = force / (length * length);
  for (std::size_t i = 0; i < increment.stresses.size(); ++i) {
    const SolidStress& of = increment.stresses[i];
    const std::array<double, 6>& be = anew.stresses[i];
    const double off = anew.stress_per_motion[i] * motion / stress;
    if (differs("sxx", "element", i, of.sxx, be[0], stress, off) ||
        differs("syy", "element", i, of.syy, be[1], stress, off) ||
        differs("sxy", "element", i, of.sxy, be[2], stress, off) ||
        differs("szz", "element", i, of.szz, be[3], stress, off) ||
        differs("mises", "element", i, of.mises, be[4], stress, off) ||
        differs("energy", "element", i, of.energy, be[5], force * length, rounding))
      return text.str();
  }
  std::vector<double> widths(increment.widths.size());
  for (std::size_t i = 0; i < increment.pressures.size(); ++i) {
    const ContactPressure& of = increment.pressures[i];
    const ContactRecord& contact = increment.contacts[i];
    const double be = anew.lengths[i], pressure = be > 0.0 ? contact.rn / be : 0.0,
                 traction = be > 0.0 ? contact.rt / be : 0.0;
    const double unit = be > 0.0 ? force / be : force / length;
    if (differs("length", "contact", i, of.length, be, length, rounding) ||
        differs("pressure", "contact", i, of.pressure, pressure, unit, rounding) ||
        differs("traction", "contact", i, of.traction, traction, unit, rounding))
      return text.str();
    if (contact.state != ContactState::kOpen) widths[anew.boundaries[i]] += be;
  }
  for (std::size_t i = 0; i < widths.size(); ++i)
    if (differs("width", "boundary", i, increment.widths[i], widths[i], length, rounding)) break;
  return text.str();
}

}  // namespace contact_path
