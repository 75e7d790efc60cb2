// A system of equations inside a larger one that stays while equations and unknowns come and go, and orderings of such
// systems.
#ifndef CONTACT_PATH_LINEAR_FRAME_H_
#define CONTACT_PATH_LINEAR_FRAME_H_

#include <Eigen/SparseCore>
#include <algorithm>
#include <memory>
#include <vector>

namespace contact_path {

class Orderings;
struct Ordering;

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

// The last few orderings of large systems, shared by the solvers of one structure. An ordering is of the pattern of a
// frame and of the border that stands for the last row of its systems: src/linear/large_factors.h. Not for several
// threads at once.
class Orderings {
 public:
  Orderings() = default;
  Orderings(const Orderings&) = delete;
  Orderings& operator=(const Orderings&) = delete;

  // For this frame, with a border where the row, in the frame, is large; or else, where there is one, with another
  // border; or null.
  std::shared_ptr<const Ordering> Find(const Frame& frame, const Eigen::VectorXd& row) const;
  // A new one, with the border where the row is largest.
  std::shared_ptr<const Ordering> Add(const Frame& frame, const Eigen::VectorXd& row);

 private:
  std::vector<std::shared_ptr<const Ordering>> kept_;  // the newest last
};

// The first column without an entry on the diagonal, or cols(): of a transposed Jacobian, whose equations of
// equilibrium come first, the number of its motions.
inline Eigen::Index FirstWithoutDiagonal(const Eigen::SparseMatrix<double>& matrix) {
  for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
    const int* const begin = matrix.innerIndexPtr() + matrix.outerIndexPtr()[column];
    const int* const end = matrix.innerIndexPtr() + matrix.outerIndexPtr()[column + 1];
    if (!std::binary_search(begin, end, static_cast<int>(column))) return column;
  }
  return matrix.cols();
}

}  // namespace contact_path

#endif  // CONTACT_PATH_LINEAR_FRAME_H_
