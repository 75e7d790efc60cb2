// Writes a path as CSV: a header line, then a row per increment, doubles with 17 significant digits.
#ifndef CONTACT_PATH_PATH_CSV_H_
#define CONTACT_PATH_PATH_CSV_H_

#include <iosfwd>

#include "contact_path/path/increment.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

// Columns: index, load_factor, arc_length, kind, x_<node>, y_<node>, ..., gap_<contact>, rn_<contact>, rt_<contact>,
// state_<contact>, ..., dissipation, strain_energy, equilibrium_residual, complementarity_residual, solve_time;
// with a program, last: stage. Nodes and contacts in scene order. Errors are left in the state of the stream.
void WriteCsvHeader(const TraceRequest& request, std::ostream& out);
void WriteCsvRow(const Increment& increment, std::ostream& out);

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_CSV_H_
