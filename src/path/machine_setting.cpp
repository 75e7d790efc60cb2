#include "contact_path/path/machine_setting.h"

namespace contact_path {

MachineSetting::MachineSetting(const Model& model, double stiffness) {
  const Model::LoadSize loads = model.SizeOfLoads();
  if (!(stiffness > 0.0) || loads.norm == 0.0) return;
  machine_.stiffness = stiffness / loads.unit_of_stiffness;
  unit_ = loads.unit_of_displacement;
  row_ = machine_.Row(model.structure);
  row_ *= model.structure.ReferenceLoad().norm() / (loads.norm * row_.head(model.structure.NumDofs()).norm());
}

PathParameter MachineSetting::Parameter(double sense) const {
  return row_.size() == 0 ? PathParameter(sense) : PathParameter(row_, sense);
}

double MachineSetting::At(const Eigen::VectorXd& u, double s) const {
  if (row_.size() == 0) return 0.0;
  return unit_ * (row_.head(u.size()).dot(u) + row_[u.size()] * s) - origin_;
}

}  // namespace contact_path
