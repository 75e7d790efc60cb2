// The order of the branches at an event, best first.
#ifndef CONTACT_PATH_BRANCH_BRANCH_ORDER_H_
#define CONTACT_PATH_BRANCH_BRANCH_ORDER_H_

#include <vector>

#include "contact_path/branch/branches.h"

namespace contact_path {

// Marks mirror branches and sorts: where the path is driven forward (Arrival::forward), branches on which the path
// parameter goes on, then those on which it rests, then those on which it goes back; among these, or else among all,
// the paper's rule (4): larger dissipation rate, then without mirror branch, then smaller deviation, then the larger
// rate of the path parameter, then fewer changes of state in the first laws. Values that are equal to rounding
// count as equal: they are grouped, sorted by value, where a gap larger than rounding begins a new group. Groups do not
// depend on the order in which the branches are given, so neither does the result. arrival: modes before the
// event.
void SortBranches(const Modes& arrival, bool forward, std::vector<Branch>* branches);

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_BRANCH_ORDER_H_
