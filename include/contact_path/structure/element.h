// An elastic element: strain energy and its first three derivatives in the positions of its nodes.
#ifndef CONTACT_PATH_STRUCTURE_ELEMENT_H_
#define CONTACT_PATH_STRUCTURE_ELEMENT_H_

#include <Eigen/Core>

namespace contact_path {

// Positions, forces and directions are ordered x0, y0, x1, y1, ... over the nodes of the element: 2n entries.
// A configuration in which the energy is not smooth (a Biot or logarithmic bar of zero length) gives non-finite values.
class Element {
 public:
  virtual ~Element() = default;

  // n, the number of nodes.
  virtual Eigen::Index NumNodes() const = 0;
  // W(x) [force length].
  virtual double Energy(const Eigen::Ref<const Eigen::VectorXd>& x) const = 0;
  // force = dW/dx, 2n [force].
  virtual void Force(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> force) const = 0;
  // tangent = d2W/dx2, 2n x 2n, symmetric [force/length].
  virtual void Tangent(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::MatrixXd> tangent) const = 0;
  // derivative = d/dh tangent(x + h v) at h = 0, 2n x 2n, symmetric. It is also the gradient of tangent(x) v.
  virtual void TangentDerivative(const Eigen::Ref<const Eigen::VectorXd>& x, const Eigen::Ref<const Eigen::VectorXd>& v,
                                 Eigen::Ref<Eigen::MatrixXd> derivative) const = 0;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_STRUCTURE_ELEMENT_H_
