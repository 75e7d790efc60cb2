// The inequalities that keep the states and patches of a fixed-state system admissible.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "contact_path/equations/fixed_state_system.h"
#include "contact_path/tolerances.h"

namespace contact_path {

void FixedStateSystem::AddInequalities(std::size_t contact, std::vector<Constraint>* inequalities) const {
  const auto i = static_cast<int>(contact);
  if (states_[contact] == ContactState::kOpen) {
    // Past the ends of an open surface there is nothing to touch.
    const int patch = patches_[contact];
    if (patch == kNearestPatch || contacts_[contact]->HasPatch(patch)) inequalities->push_back({i, Inequality::kGap});
    return;
  }
  inequalities->push_back({i, Inequality::kNormalReaction});
  if (states_[contact] == ContactState::kStick) {
    inequalities->push_back({i, Inequality::kConePlus});
    inequalities->push_back({i, Inequality::kConeMinus});
  } else if (Slips(states_[contact])) {
    inequalities->push_back({i, contacts_[contact]->HasTotalLaw() ? Inequality::kTotalSlip : Inequality::kSlip});
  }
  if (states_[contact] != ContactState::kStick) AddPatchEnds(contact, inequalities);
}

void FixedStateSystem::AddPatchEnds(std::size_t contact, std::vector<Constraint>* inequalities) const {
  if (!contacts_[contact]->HasPatches() || patches_[contact] == kNearestPatch) return;
  const XiRange range = contacts_[contact]->RangeOf(patches_[contact]);
  const auto i = static_cast<int>(contact);
  if (std::isfinite(range.begin)) inequalities->push_back({i, Inequality::kPatchBegin});
  if (std::isfinite(range.end)) inequalities->push_back({i, Inequality::kPatchEnd});
}

std::vector<Constraint> FixedStateSystem::PatchEndsOfOpen(const std::vector<std::size_t>& candidates) const {
  std::vector<Constraint> ends;
  for (const std::size_t i : candidates)
    if (states_[i] == ContactState::kOpen) AddPatchEnds(i, &ends);
  return ends;
}

void FixedStateSystem::PlaceOpen(const std::vector<std::size_t>& candidates, const Eigen::VectorXd& x) {
  for (const std::size_t i : candidates)
    if (states_[i] == ContactState::kOpen && contacts_[i]->HasPatches())
      patches_[i] = contacts_[i]->PatchAt(x, x[NumDofs()]);
}

bool FixedStateSystem::BehindOtherPatch(const std::vector<std::size_t>& candidates, const Eigen::VectorXd& x) const {
  return std::any_of(candidates.begin(), candidates.end(), [&](std::size_t i) {
    if (states_[i] != ContactState::kOpen || !contacts_[i]->HasPatches()) return false;
    const ContactPair& pair = *contacts_[i];
    const int patch = pair.PatchAt(x, x[NumDofs()]);
    if (patch == patches_[i]) return false;
    const bool behind = pair.Gap(x, x[NumDofs()], patch) < -tolerances::kBroken;
    // In reach, a node from in front that is away from the surface, or the other way, may have gone through it.
    if (patches_[i] == kNearestPatch) return behind;
    if (pair.IsAway(patch)) return pair.HasPatch(patches_[i]);
    if (pair.IsAway(patches_[i])) return pair.HasPatch(patch) && !behind;
    return behind;
  });
}

std::vector<Constraint> FixedStateSystem::Inequalities() const {
  std::vector<Constraint> inequalities;
  for (std::size_t i = 0; i < contacts_.size(); ++i) AddInequalities(i, &inequalities);
  return inequalities;
}

std::vector<Constraint> FixedStateSystem::InequalitiesOf(const std::vector<std::size_t>& candidates) const {
  std::vector<std::size_t> all;
  std::set_union(touching_.begin(), touching_.end(), candidates.begin(), candidates.end(), std::back_inserter(all));
  std::vector<Constraint> inequalities;
  for (const std::size_t i : all) AddInequalities(i, &inequalities);
  return inequalities;
}

}  // namespace contact_path
