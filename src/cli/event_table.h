// The events of a path and the branches from each, as text: what branch_choices chooses from.
#ifndef CONTACT_PATH_CLI_EVENT_TABLE_H_
#define CONTACT_PATH_CLI_EVENT_TABLE_H_

#include <ostream>

#include "contact_path/path/increment.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

// request: expanded (scene/expand.h). Writes the branches from `increment`, a line each, best first; nothing where no
// branches part. Of the contacts it names those that change their state, and counts the others. load_scale: of the load
// factor, ProgramScales(request).load_factor.
void PrintBranches(const TraceRequest& request, const Increment& increment, double load_scale, std::ostream& out);

}  // namespace contact_path

#endif  // CONTACT_PATH_CLI_EVENT_TABLE_H_
