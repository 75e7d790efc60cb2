// A point of the path as the solvers see it: scaled quantities, free components only.
#ifndef CONTACT_PATH_CONTACT_PATH_POINT_H_
#define CONTACT_PATH_CONTACT_PATH_POINT_H_

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "contact_path/contact/contact_state.h"

namespace contact_path {

// In place of the patch of an open contact: the one that is nearest, which is looked for where it is needed.
inline constexpr int kNearestPatch = std::numeric_limits<int>::min();

struct PathPoint {
  Eigen::VectorXd u;                 // current positions of the free components
  double s = 0.0;                    // load factor
  Eigen::VectorXd rn;                // normal reactions, by candidate
  Eigen::VectorXd rt;                // tangential reactions, by candidate
  std::vector<ContactState> states;  // on the arc of path that ends here, by candidate
  std::vector<int> patches = {};     // of the surface, where the node is, by candidate; empty = all 0

  int Patch(std::size_t candidate) const { return patches.empty() ? 0 : patches[candidate]; }
};

// The increment (du, ds) between two points.
inline Eigen::VectorXd Chord(const PathPoint& from, const PathPoint& to) {
  Eigen::VectorXd chord(to.u.size() + 1);
  chord << to.u - from.u, to.s - from.s;
  return chord;
}

// Length of the increment between two points in (u, s): the norm of arc length.
inline double Distance(const PathPoint& a, const PathPoint& b) {
  return std::sqrt((b.u - a.u).squaredNorm() + (b.s - a.s) * (b.s - a.s));
}

}  // namespace contact_path

#endif  // CONTACT_PATH_CONTACT_PATH_POINT_H_
