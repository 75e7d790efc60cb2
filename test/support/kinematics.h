// Ports of a contact candidate as the tests want them.
#ifndef CONTACT_PATH_TEST_SUPPORT_KINEMATICS_H_
#define CONTACT_PATH_TEST_SUPPORT_KINEMATICS_H_

#include <Eigen/Core>

#include "contact_path/contact/contact_pair.h"

namespace contact_path {

// With xi measured from 0.
inline PortsAt KinematicsAt(const ContactPair& pair, const Eigen::VectorXd& u, double s, int patch = 0) {
  PortsAt ports;
  pair.Evaluate(u, s, patch, {}, &ports);
  return ports;
}

inline double GapRate(const ContactPair& pair, const Eigen::VectorXd& u, double s, const Eigen::VectorXd& du,
                      double ds) {
  const PortsAt at = KinematicsAt(pair, u, s);
  return at.Rate(at[kNormal].gradient, du, ds);
}

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SUPPORT_KINEMATICS_H_
