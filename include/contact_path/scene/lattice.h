// Lattice trusses of any size, with contact and friction: for measuring, testing, and as a first scene of one's own.
#ifndef CONTACT_PATH_SCENE_LATTICE_H_
#define CONTACT_PATH_SCENE_LATTICE_H_

#include <optional>
#include <string_view>

#include "contact_path/scene/scene.h"

namespace contact_path {

enum class LatticeKind {
  kColumn,  // stands on a rough floor, pressed down at its top by constant loads, and pushed sideways there
  kArch,    // pinned at both ends, its crown pressed down towards a rough floor
  kWall,    // held at its left edge above a rough floor, pressed down along its upper edge
  kBlock,   // held in the same way, pushed back and down at its right edge
};

// Cells are squares of side 1 (of the arch: about), each with all its sides and both diagonals, EA = 1, Biot strain.
struct LatticeOptions {
  LatticeKind kind = LatticeKind::kColumn;
  int columns = 10;        // cells along the edge that may touch, >= 2
  int rows = 10;           // cells across, >= 1
  int contacts = 0;        // candidates, spread evenly over that edge; 0 = every free node of it
  int far_candidates = 0;  // candidates beside them that are never within reach
  double friction = 0.3;   // of the floor, >= 0
};

// The scene and options of a trace. Names: nodes "n<column>_<row>", row 0 at the edge that may touch. Throws
// std::invalid_argument for options out of range.
TraceRequest LatticeRequest(const LatticeOptions& options);

// "column", "arch", "wall", "block"; nothing for another word.
std::optional<LatticeKind> ParseLatticeKind(std::string_view word);

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_LATTICE_H_
