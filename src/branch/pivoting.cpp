#include "contact_path/branch/pivoting.h"

#include <algorithm>

namespace contact_path {
namespace {

constexpr int kBlockPivots = 20;
constexpr int kSinglePivots = 200;

// The state that a contact takes on where the rate of the constraint is negative.
ContactState Next(const Constraint& constraint, ContactState touching, ContactState now) {
  switch (constraint.inequality) {
    case Inequality::kGap: return touching;
    case Inequality::kNormalReaction: return ContactState::kOpen;
    case Inequality::kConePlus: return ContactState::kSlipPlus;
    case Inequality::kConeMinus: return ContactState::kSlipMinus;
    case Inequality::kSlip:
    case Inequality::kTotalSlip: return ContactState::kStick;
    case Inequality::kPatchBegin:
    case Inequality::kPatchEnd: return now;  // not asked
  }
  return ContactState::kOpen;
}

}  // namespace

std::optional<std::vector<ContactState>> Pivot(const std::vector<ContactState>& touching,
                                               std::vector<ContactState> states, const BrokenBy& broken_by) {
  for (int round = 0; round < kBlockPivots + kSinglePivots; ++round) {
    std::optional<std::vector<Constraint>> broken = broken_by(states);
    if (!broken) return std::nullopt;
    // At the end of a patch another patch is wanted, and no other state.
    broken->erase(std::remove_if(broken->begin(), broken->end(),
                                 [](const Constraint& constraint) { return KeepsPatch(constraint.inequality); }),
                  broken->end());
    if (broken->empty()) return states;
    if (round >= kBlockPivots) broken->resize(1);
    for (const Constraint& constraint : *broken) {
      const auto i = static_cast<std::size_t>(constraint.contact);
      states[i] = Next(constraint, touching[i], states[i]);
    }
  }
  return std::nullopt;
}

}  // namespace contact_path
