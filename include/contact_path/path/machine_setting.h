// The machine of a stage and its setting.
#ifndef CONTACT_PATH_PATH_MACHINE_SETTING_H_
#define CONTACT_PATH_PATH_MACHINE_SETTING_H_

#include <Eigen/Core>

#include "contact_path/branch/path_parameter.h"
#include "contact_path/law/path_point.h"
#include "contact_path/path/model.h"
#include "contact_path/stability/machine.h"

namespace contact_path {

// X = f . (u - u_0) / |f| + s |f| / K, the setting of the machine of TraceOptions in a stage that begins at u_0.
class MachineSetting {
 public:
  // stiffness: K of TraceOptions. Where it is 0, or the load factor scales no loads, there is no machine: the load
  // factor is what goes on, and the setting stays 0.
  MachineSetting(const Model& model, double stiffness);

  const Machine& machine() const { return machine_; }  // scaled
  // sense: +-1, in which the path is wanted to go.
  PathParameter Parameter(double sense) const;
  // From where it is `value` [length; rad where moments alone load] at the point, (u, s) scaled.
  void Begin(const PathPoint& point, double value) { origin_ += At(point.u, point.s) - value; }
  double At(const Eigen::VectorXd& u, double s) const;

 private:
  Machine machine_;
  Eigen::VectorXd row_;  // (du, ds); empty: no machine
  double unit_ = 1.0;
  double origin_ = 0.0;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_MACHINE_SETTING_H_
