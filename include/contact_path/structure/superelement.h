// Linear elastic part given by its stiffness matrix.
#ifndef CONTACT_PATH_STRUCTURE_SUPERELEMENT_H_
#define CONTACT_PATH_STRUCTURE_SUPERELEMENT_H_

#include <utility>
#include <vector>

#include "contact_path/structure/element.h"

namespace contact_path {

// W = (x - X)' K (x - X) / 2 with constant symmetric K.
class LinearSuperelement : public Element {
 public:
  // stiffness K: 2n x 2n, symmetric [force/length]; initial positions X: 2n [length].
  LinearSuperelement(Eigen::MatrixXd stiffness, Eigen::VectorXd initial)
      : stiffness_(std::move(stiffness)),
        initial_(std::move(initial)),
        dofs_(PositionsOfNodes(static_cast<int>(initial_.size() / kPositionComponents))) {}

  const std::vector<LocalDof>& Dofs() const override { return dofs_; }
  bool Linear() const override { return true; }
  double Energy(const Eigen::Ref<const Eigen::VectorXd>& x) const override {
    return 0.5 * (x - initial_).dot(stiffness_ * (x - initial_));
  }
  void Force(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> force) const override {
    force.setZero();
    for (Eigen::Index i = 0; i < x.size(); ++i) force += (x[i] - initial_[i]) * stiffness_.col(i);
  }
  void Tangent(const Eigen::Ref<const Eigen::VectorXd>&, Eigen::Ref<Eigen::MatrixXd> tangent) const override {
    tangent = stiffness_;
  }
  void TangentDerivative(const Eigen::Ref<const Eigen::VectorXd>&, const Eigen::Ref<const Eigen::VectorXd>&,
                         Eigen::Ref<Eigen::MatrixXd> derivative) const override {
    derivative.setZero();
  }

 private:
  Eigen::MatrixXd stiffness_;
  Eigen::VectorXd initial_;
  std::vector<LocalDof> dofs_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_STRUCTURE_SUPERELEMENT_H_
