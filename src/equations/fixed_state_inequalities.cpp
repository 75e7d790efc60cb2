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
  const ContactPair& pair = *contacts_[contact];
  if (!pair.HasPatches() || pair.Seamless() || patches_[contact] == kNearestPatch) return;
  const XiRange range = pair.RangeOf(patches_[contact]);
  const auto i = static_cast<int>(contact);
  if (std::isfinite(range.begin)) inequalities->push_back({i, Inequality::kPatchBegin});
  if (std::isfinite(range.end)) inequalities->push_back({i, Inequality::kPatchEnd});
}

void FixedStateSystem::SetStatesFrom(const PathPoint& from, const std::vector<ContactState>& states) {
  SetStates(states, SlipReferences(contacts_, from), from.patches);
  moved_forces_.clear();
  Eigen::VectorXd stiffness;
  for (const std::size_t i : touching_) {
    const double gap = contacts_[i]->Gap(from.u, from.s, from.Patch(i));
    if (!(gap > tolerances::kResidual)) continue;
    if (stiffness.size() == 0) {
      structure_.Tangent(from.u, &tangent_);
      stiffness = tangent_.diagonal().cwiseAbs();
    }
    double largest = 0.0;
    for (const int dof : contacts_[i]->Dofs(from.Patch(i))) largest = std::max(largest, stiffness[dof]);
    moved_forces_[static_cast<int>(i)] = (1.0 + contacts_[i]->Friction()) * largest * gap;
  }
}

double FixedStateSystem::RoundingOf(const Constraint& limit, double of_forces) const {
  double rounding = tolerances::kResidual * UnitOf(limit);
  if (!IsMotion(limit.inequality)) rounding = std::max(rounding, of_forces);
  const auto moved = moved_forces_.find(limit.contact);
  return moved == moved_forces_.end() ? rounding : std::max(rounding, moved->second);
}

std::vector<Constraint> FixedStateSystem::LimitsInReach(const Eigen::VectorXd& x, double reach,
                                                        std::vector<Constraint>* near) {
  const double s = x[NumDofs()];
  if (!tracker_) tracker_.emplace(contacts_);
  in_reach_ = tracker_->InReach(x.head(NumDofs()), s, reach);
  near->clear();
  for (const std::size_t i : touching_) patches_[i] = contacts_[i]->PatchNow(x, s, patches_[i]);
  for (const std::size_t i : in_reach_) {
    if (states_[i] != ContactState::kOpen) continue;
    if (contacts_[i]->HasPatches()) patches_[i] = contacts_[i]->PatchAt(x, s);
    AddPatchEnds(i, near);
  }
  std::vector<std::size_t> all;
  std::set_union(touching_.begin(), touching_.end(), in_reach_.begin(), in_reach_.end(), std::back_inserter(all));
  std::vector<Constraint> inequalities;
  for (const std::size_t i : all) AddInequalities(i, &inequalities);
  return inequalities;
}

bool FixedStateSystem::BeyondReach(const Eigen::VectorXd& x) const {
  return std::any_of(in_reach_.begin(), in_reach_.end(), [&](std::size_t i) {
    if (states_[i] != ContactState::kOpen || !contacts_[i]->HasPatches() || contacts_[i]->Seamless()) return false;
    const ContactPair& pair = *contacts_[i];
    const int patch = pair.PatchAt(x, x[NumDofs()]);
    if (patch == patches_[i]) return false;
    const bool behind = pair.Gap(x, x[NumDofs()], patch) < -tolerances::kResidual;
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

const RigidModes& FixedStateSystem::Modes() const {
  if (!modes_) modes_.emplace(structure_);
  return *modes_;
}

bool FixedStateSystem::MayMoveFreely() const { return Modes().Possible(); }

Eigen::MatrixXd FixedStateSystem::FreeMotions(const Eigen::VectorXd& x, const Eigen::SparseMatrix<double>& transposed) {
  return Modes().At(x.head(NumDofs()), transposed);
}

}  // namespace contact_path
