// Whether a trace can have ended for the reason that its record gives.
#ifndef CONTACT_PATH_VERIFY_VERIFY_END_H_
#define CONTACT_PATH_VERIFY_VERIFY_END_H_

#include <string>
#include <string_view>
#include <vector>

#include "contact_path/path/increment.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

// What speaks against it, in a line; empty: nothing does. reason: "stop_criterion", ..., of a trace whose increments
// these are. Looked at: stop_criterion (one holds in the last increment, or the program is done), max_increments (their
// number), path_end (no branch is taken from the last increment, and mpec cannot tell that; or no contact is left, and
// the load is zero or beyond minus its target) and closed_path (an earlier increment of the stage has the state of the
// last one).
std::string EndContradicted(const TraceRequest& request, const std::vector<Increment>& increments,
                            std::string_view reason);

}  // namespace contact_path

#endif  // CONTACT_PATH_VERIFY_VERIFY_END_H_
