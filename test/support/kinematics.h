// Kinematics of a contact candidate as the tests want them.
#ifndef CONTACT_PATH_TEST_SUPPORT_KINEMATICS_H_
#define CONTACT_PATH_TEST_SUPPORT_KINEMATICS_H_

#include <Eigen/Core>

#include "contact_path/contact/contact_pair.h"

namespace contact_path {

// With xi measured from 0.
inline Kinematics KinematicsAt(const ContactPair& pair, const Eigen::VectorXd& u, double s, int patch = 0) {
  Kinematics kinematics;
  pair.Evaluate(u, s, patch, 0.0, &kinematics);
  return kinematics;
}

inline double GapRate(const ContactPair& pair, const Eigen::VectorXd& u, double s, const Eigen::VectorXd& du,
                      double ds) {
  const Kinematics at = KinematicsAt(pair, u, s);
  return at.Rate(at.gap_gradient, du, ds);
}

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SUPPORT_KINEMATICS_H_
