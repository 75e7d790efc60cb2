// A system of equations inside a larger one that stays while equations and unknowns come and go.
#ifndef CONTACT_PATH_LINEAR_FRAME_H_
#define CONTACT_PATH_LINEAR_FRAME_H_

#include <vector>

namespace contact_path {

class Orderings;

// The larger system has `size` unknowns and one equation less; an equation k of it that belongs to none of the system
// says that its unknown k, which then belongs to none either, is zero. All systems with one frame have one pattern, and
// their factors one ordering.
struct Frame {
  int size = 0;
  // Unknowns of the equation k, ascending: entries[starts[k]] up to entries[starts[k + 1]], k itself among them where
  // it may belong to none.
  std::vector<int> starts, entries;
  // Where the unknowns and equations of the system stand. The equations ascend.
  std::vector<int> unknowns, equations;
  bool odd = false;                // whether an odd number of exchanges sorts `unknowns`
  Orderings* orderings = nullptr;  // which the solvers of the systems of a structure share; not null
};

}  // namespace contact_path

#endif  // CONTACT_PATH_LINEAR_FRAME_H_
