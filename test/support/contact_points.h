// Points and modes of structures whose laws are contacts, by contact.
#ifndef CONTACT_PATH_TEST_SUPPORT_CONTACT_POINTS_H_
#define CONTACT_PATH_TEST_SUPPORT_CONTACT_POINTS_H_

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "contact_path/contact/contact_pair.h"

namespace contact_path {

inline Modes ModesOf(const std::vector<ContactState>& states, const std::vector<int>& patches = {}) {
  Modes modes;
  for (std::size_t i = 0; i < states.size(); ++i)
    modes.push_back({NumberOf(states[i]), patches.empty() ? 0 : patches[i]});
  return modes;
}

inline std::vector<ContactState> ContactStatesOf(const Modes& modes) { return ContactStatesOf(modes, modes.size()); }

// By port, of what contacts have in the tangential direction, and in both.
inline Eigen::VectorXd ByPort(const Eigen::VectorXd& normal, const Eigen::VectorXd& tangential) {
  Eigen::VectorXd by_port(2 * tangential.size());
  for (Eigen::Index i = 0; i < tangential.size(); ++i) by_port.segment<2>(2 * i) << normal[i], tangential[i];
  return by_port;
}
inline Eigen::VectorXd ByPort(const Eigen::VectorXd& tangential) {
  return ByPort(Eigen::VectorXd::Zero(tangential.size()), tangential);
}

// (r_n, r_t), columns, by contact.
inline Eigen::Matrix<double, Eigen::Dynamic, 2> ReactionsOf(const PathPoint& point) {
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>>(point.forces.data(),
                                                                                     point.forces.size() / 2, 2);
}

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SUPPORT_CONTACT_POINTS_H_
