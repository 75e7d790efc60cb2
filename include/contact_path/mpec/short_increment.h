// What the increment problem says of an event.
#ifndef CONTACT_PATH_MPEC_SHORT_INCREMENT_H_
#define CONTACT_PATH_MPEC_SHORT_INCREMENT_H_

#include <Eigen/Core>
#include <vector>

#include "contact_path/contact/contact_state.h"
#include "contact_path/contact/path_point.h"
#include "contact_path/mpec/increment_solver.h"

namespace contact_path {

// The contact states of increments (9) from `point` that are so short that they stand for rates, with none, half and
// all of the pull of the dissipation; at most three, as solved for. direction: of the path, unit vector (du, ds).
std::vector<std::vector<ContactState>> StatesOfShortIncrements(const PathPoint& point, const Eigen::VectorXd& direction,
                                                               IncrementSolver* solver);

}  // namespace contact_path

#endif  // CONTACT_PATH_MPEC_SHORT_INCREMENT_H_
