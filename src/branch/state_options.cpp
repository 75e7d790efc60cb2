#include "contact_path/branch/state_options.h"

#include <algorithm>
#include <cmath>

namespace contact_path {
namespace {

std::vector<ContactState> AdmissibleStates(const ContactPair& contact, const PathPoint& point, std::size_t candidate,
                                           int patch, const ActiveSetTolerance& tolerance) {
  const auto k = static_cast<Eigen::Index>(candidate);
  const double gap = contact.Gap(point.u, point.s, patch), rn = point.rn[k], rt = point.rt[k];
  if (gap > tolerance.gap) return {ContactState::kOpen};
  const double force = tolerance.force * contact.ForceUnit();
  const bool loaded = rn > tolerance.force * contact.NormalForceUnit();
  const double slipped = contact.Slipped(point.u, point.s, patch);
  std::vector<ContactState> options;
  if (!contact.Frictional()) {
    options = {ContactState::kClosed};
  } else if (std::abs(slipped) > tolerance.gap) {
    options = {slipped > 0.0 ? ContactState::kSlipPlus : ContactState::kSlipMinus};
  } else if (!loaded) {
    options = {ContactState::kStick, ContactState::kSlipPlus, ContactState::kSlipMinus};
  } else {
    options = {ContactState::kStick};
    if (contact.Friction() * rn + rt <= force) options.push_back(ContactState::kSlipPlus);
    if (contact.Friction() * rn - rt <= force) options.push_back(ContactState::kSlipMinus);
  }
  if (!loaded) options.push_back(ContactState::kOpen);
  const auto natural = std::find(options.begin(), options.end(), point.states[candidate]);
  if (natural != options.end()) std::rotate(options.begin(), natural, natural + 1);
  return options;
}

}  // namespace

ContactModes StateOptions(const ContactPair& contact, const PathPoint& point, std::size_t candidate,
                          const ActiveSetTolerance& tolerance) {
  const int patch = contact.KnownPatch(point.u, point.s, point.Patch(candidate));
  int before = patch, after = patch;  // where slip leads
  if (contact.HasPatches() && !contact.Seamless()) {
    const double xi = contact.Xi(point.u, point.s, patch);
    const XiRange range = contact.RangeOf(patch);
    if (xi <= range.begin + tolerance.gap) --before;
    if (xi >= range.end - tolerance.gap) ++after;
  }
  ContactModes modes;
  for (const ContactState state : AdmissibleStates(contact, point, candidate, patch, tolerance)) {
    std::vector<int> patches = {patch};
    const bool either_way = state == ContactState::kClosed || (contact.HasTotalLaw() && Slips(state));
    if (either_way) {
      if (before != patch) patches.push_back(before);
      if (after != patch) patches.push_back(after);
    } else if (state == ContactState::kSlipPlus) {
      patches = {after};
    } else if (state == ContactState::kSlipMinus) {
      patches = {before};
    }
    for (const int on : patches)
      if (state == ContactState::kOpen || !contact.HasPatches() || contact.HasPatch(on)) modes.push_back({state, on});
  }
  return modes;
}

}  // namespace contact_path
