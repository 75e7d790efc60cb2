// Orderings of large systems, shared by the solvers of one structure.
#ifndef CONTACT_PATH_LINEAR_ORDERINGS_H_
#define CONTACT_PATH_LINEAR_ORDERINGS_H_

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "contact_path/linear/frame.h"

namespace contact_path {

struct Ordering;

// The last few orderings. An ordering is of the pattern of a frame and of the border that stands for the last row of
// its systems: src/linear/large_factors.h. Not for several threads at once.
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

}  // namespace contact_path

#endif  // CONTACT_PATH_LINEAR_ORDERINGS_H_
