// A point of the path as the solvers see it: scaled quantities, free components only.
#ifndef CONTACT_PATH_LAW_PATH_POINT_H_
#define CONTACT_PATH_LAW_PATH_POINT_H_

#include <Eigen/Core>
#include <cmath>
#include <cstddef>

#include "contact_path/law/mode.h"

namespace contact_path {

struct PathPoint {
  Eigen::VectorXd u;       // current positions of the free components
  double s = 0.0;          // load factor
  Eigen::VectorXd forces;  // of the ports of all laws
  Modes modes;             // on the arc of path that ends here, by law
};

// The states of these modes; the pieces stay.
inline void TakeStates(const Modes& modes, PathPoint* point) {
  for (std::size_t i = 0; i < modes.size(); ++i) point->modes[i].state = modes[i].state;
}

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

#endif  // CONTACT_PATH_LAW_PATH_POINT_H_
