#include "contact_path/mpec/increment_slots.h"

#include <algorithm>
#include <set>

namespace contact_path {
namespace {

// Of a patch of a deformable surface and the patches beside it.
LawDofs DofsBeside(const ContactPair& pair, int patch) {
  std::set<int> all;
  for (const int beside : {patch - 1, patch, patch + 1})
    if (pair.HasPatch(beside))
      for (const int dof : pair.Dofs(beside)) all.insert(dof);
  LawDofs dofs;
  for (const int dof : all) dofs.push_back(dof);
  return dofs;
}

}  // namespace

IncrementSlots::IncrementSlots(const Structure& structure, const ContactPairs& contacts, const Laws& laws,
                               const PathPoint& from, const std::vector<int>& working_set, double length)
    : from_(from),
      length_(length),
      num_variables_(NumDofs() + 1 + static_cast<Eigen::Index>(working_set.size())),
      num_constraints_(NumDofs()) {
  slots_.reserve(working_set.size());
  for (std::size_t i = 0; i < working_set.size(); ++i)
    Add(contacts, laws, static_cast<std::size_t>(working_set[i]), NumDofs() + 1 + static_cast<Eigen::Index>(i));
  supports_.reserve(structure.PrescribedDofs().size());
  for (const PrescribedDof& prescribed : structure.PrescribedDofs())
    supports_.push_back({&prescribed, num_variables_++, num_constraints_++});
}

void IncrementSlots::Add(const ContactPairs& contacts, const Laws& laws, std::size_t number, Eigen::Index rn) {
  const Law& law = laws[number];
  const ContactPair* const pair = number < contacts.size() ? contacts[number].get() : nullptr;
  const Mode mode = law.Known(from_.u, from_.s, from_.modes[number]);
  Slot slot;
  slot.law = &law;
  slot.pair = pair;
  slot.number = number;
  slot.port = laws.FirstPort(number);
  slot.held = pair != nullptr ? NumberOf(ContactState::kClosed) : law.AllHeld();
  slot.always = !law.CanBeIdle();
  slot.compliance = {};
  for (std::size_t p = 0; p < law.NumPorts(); ++p) slot.compliance[p] = law.In(law.AllHeld()).ports[p].compliance;
  slot.start_patch = mode.piece;
  slot.dofs = pair != nullptr && pair->Deformable() ? DofsBeside(*pair, mode.piece) : law.Dofs(mode.piece);
  law.Evaluate(from_.u, from_.s, mode.piece, {}, &slot.at_start);
  slot.reference = law.ReferenceOf(from_.u, from_.s, mode, laws.Of(from_.forces, number));
  slot.rn = rn;
  slot.rt = slot.lambda = slot.friction_row = -1;
  slot.gap_row = num_constraints_;
  if (slot.always) {
    if (law.NumPorts() > 1) slot.rt = num_variables_++;
    num_constraints_ += static_cast<Eigen::Index>(slot.NumForces());
  } else {
    num_constraints_ += 2;
  }
  if (pair != nullptr && pair->Frictional()) {
    slot.rt = num_variables_++;
    slot.lambda = num_variables_++;
    slot.friction_row = num_constraints_;
    num_constraints_ += 5;
  }
  slots_.push_back(slot);
}

PortsAt IncrementSlots::Kinematics(const Slot& slot, const Eigen::VectorXd& x) const {
  const Eigen::Index nd = NumDofs();
  PortReals given{};
  for (std::size_t p = 0; p < slot.NumForces(); ++p) given[p] = slot.compliance[p] * x[slot.ForceOf(p)];
  PortsAt at;
  if (!slot.law->Curved()) {
    at.dofs = slot.dofs;
    for (std::size_t p = 0; p < slot.law->NumPorts(); ++p) {
      at[p].gradient = slot.at_start[p].gradient;
      at[p].motion = (slot.at_start[p].motion - slot.reference[p]) / length_ +
                     at.Rate(at[p].gradient, x.head(nd), x[nd]) + given[p];
    }
    return at;
  }
  const Eigen::VectorXd u = U(x);
  const double s = LoadFactor(x);
  slot.law->Evaluate(u, s, PatchOf(slot, u, s), slot.reference, &at);
  for (std::size_t p = 0; p < slot.law->NumPorts(); ++p) {
    at[p].motion = at[p].motion / length_ + given[p];
    at[p].hessian *= length_;
    at[p].factor_gradient *= length_;
    if (!slot.Deformable()) continue;
    at[p].gradient = Spread(at[p].gradient, at.dofs, slot.dofs);
    at[p].hessian = Spread(at[p].hessian, at.dofs, slot.dofs);
    if (at[p].factor_gradient.size() > 0) at[p].factor_gradient = Spread(at[p].factor_gradient, at.dofs, slot.dofs);
  }
  if (slot.Deformable()) at.dofs = slot.dofs;
  return at;
}

int IncrementSlots::PatchOf(const Slot& slot, const Eigen::VectorXd& u, double s) const {
  if (slot.pair == nullptr) return slot.start_patch;
  const int patch = slot.pair->PatchAfter(u, s, slot.start_patch);
  return slot.Deformable() ? std::clamp(patch, slot.start_patch - 1, slot.start_patch + 1) : patch;
}

}  // namespace contact_path
