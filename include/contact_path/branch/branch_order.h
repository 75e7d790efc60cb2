// The order of the branches at an event, best first.
#ifndef CONTACT_PATH_BRANCH_BRANCH_ORDER_H_
#define CONTACT_PATH_BRANCH_BRANCH_ORDER_H_

#include <vector>

#include "contact_path/branch/branches.h"

namespace contact_path {

// Marks mirror branches and sorts: larger dissipation rate, then without mirror branch, then smaller deviation, then
// the larger rate of the load factor in its wanted sense, then fewer changes of state in the first contacts. Values
// that are equal to rounding count as equal: they are grouped, sorted by value, where a gap larger than rounding
// begins a new group. Groups do not depend on the order in which the branches are given, so neither does the result.
// arrival: states by candidate, before the event. load_sense: +-1.
void SortBranches(const std::vector<ContactState>& arrival, double load_sense, std::vector<Branch>* branches);

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_BRANCH_ORDER_H_
