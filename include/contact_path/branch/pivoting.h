// Principal pivoting on the rates of contacts.
#ifndef CONTACT_PATH_BRANCH_PIVOTING_H_
#define CONTACT_PATH_BRANCH_PIVOTING_H_

#include <functional>
#include <optional>
#include <vector>

#include "contact_path/contact/contact_state.h"
#include "contact_path/equations/fixed_state_system.h"

namespace contact_path {

// The inequalities that the rates of these states break, in contact order. Nothing: there are no rates, or no more are
// wanted.
using BrokenBy = std::function<std::optional<std::vector<Constraint>>(const std::vector<ContactState>& states)>;

// From these states on: contacts whose inequalities are broken change their states, all at once at first, then only
// the first of them. touching: by candidate, the state that a contact takes on where its gap closes. Ends with states
// that break none; nothing where broken_by returns nothing, or after 220 rounds.
std::optional<std::vector<ContactState>> Pivot(const std::vector<ContactState>& touching,
                                               std::vector<ContactState> states, const BrokenBy& broken_by);

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_PIVOTING_H_
