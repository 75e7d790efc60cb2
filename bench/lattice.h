// Lattice trusses of any size, with contact and friction, for measuring and testing.
#ifndef CONTACT_PATH_BENCH_LATTICE_H_
#define CONTACT_PATH_BENCH_LATTICE_H_

#include "contact_path/scene/scene.h"

namespace contact_path {

enum class LatticeKind {
  kColumn,  // stands on a rough floor, pressed down at its top by constant loads, and pushed sideways there
  kWall,    // held at its left edge above a rough floor, pressed down along its upper edge
  kBlock,   // held in the same way, pushed back and down at its right edge
};

// Cells are squares of side 1, each with all its sides and both diagonals, EA = 1, Biot strain.
struct LatticeOptions {
  LatticeKind kind = LatticeKind::kColumn;
  int columns = 10;        // cells along the edge that may touch, >= 2
  int rows = 10;           // cells across, >= 1
  int contacts = 0;        // candidates, spread evenly over that edge; 0 = every free node of it, which are the most
  int far_candidates = 0;  // candidates beside them that are never within reach
  double friction = 0.3;   // of the floor, >= 0
};

// Names: nodes "n<column>_<row>", row 0 at the edge that may touch.
TraceRequest LatticeRequest(const LatticeOptions& options);

}  // namespace contact_path

#endif  // CONTACT_PATH_BENCH_LATTICE_H_
