// An elastic element: strain energy and its first three derivatives by the values of its nodes.
#ifndef CONTACT_PATH_STRUCTURE_ELEMENT_H_
#define CONTACT_PATH_STRUCTURE_ELEMENT_H_

#include <Eigen/Core>
#include <vector>

#include "contact_path/structure/dof_map.h"

namespace contact_path {

// A value that an element depends on.
struct LocalDof {
  int node = 0;  // of the element, from 0
  Field field = Field::kPosition;
  int component = 0;
};

// The positions of so many nodes: x0, y0, x1, y1, ...
inline std::vector<LocalDof> PositionsOfNodes(int num_nodes) {
  std::vector<LocalDof> dofs;
  for (int node = 0; node < num_nodes; ++node)
    for (int component = 0; component < kPositionComponents; ++component)
      dofs.push_back({node, Field::kPosition, component});
  return dofs;
}

// Of an element of a solid: means of Cauchy's stress over its current volume [force/length^2], and its strain energy
// [force length].
struct SolidStress {
  double sxx = 0.0;
  double syy = 0.0;
  double sxy = 0.0;
  double szz = 0.0;    // across the plane
  double mises = 0.0;  // of these means
  double energy = 0.0;
};

// Values, forces and directions are ordered as Dofs(), m entries; the force of a rotation is a moment [force length].
// A configuration in which the energy is not smooth (a Biot or logarithmic bar of zero length, a solid turned
// inside out) gives non-finite values.
class Element {
 public:
  using Values = Eigen::Ref<const Eigen::VectorXd>;

  virtual ~Element() = default;

  virtual const std::vector<LocalDof>& Dofs() const = 0;
  // Whether the tangent is the same everywhere, in directions that do not turn.
  virtual bool Linear() const { return false; }
  // Whether nothing real has its stiffness: it keeps determined what the parts of the scene leave free.
  virtual bool Artificial() const { return false; }
  // The smallest ratio of a current area to its initial one, over the integration points; an element with a ratio <= 0
  // is turned inside out, and its energy is not finite. 1 for an element without an area.
  virtual double AreaRatio(const Values&) const { return 1.0; }
  // Of an element of a solid; of another one zeros.
  virtual SolidStress MeanStress(const Values&) const { return {}; }
  // W(x) [force length].
  virtual double Energy(const Values& x) const = 0;
  // force = dW/dx, m [force].
  virtual void Force(const Values& x, Eigen::Ref<Eigen::VectorXd> force) const = 0;
  // tangent = d2W/dx2, m x m, symmetric [force/length].
  virtual void Tangent(const Values& x, Eigen::Ref<Eigen::MatrixXd> tangent) const = 0;
  // Whether there is a MixedTangent(): of an element much stiffer in one way than in others.
  virtual bool Mixed() const { return false; }
  // The tangent at x with the stiff internal forces that `to` has by strains linearised at `from`, in place of those at
  // x. Newton's method on strains and positions together, the strains eliminated, has this matrix (Magisano, Leonetti &
  // Garcea 2017): strains that are off by little do not pass for large forces. Zero where it is not Mixed().
  virtual void MixedTangent(const Values& /*x*/, const Values& /*from*/, const Values& /*to*/,
                            Eigen::Ref<Eigen::MatrixXd> tangent) const {
    tangent.setZero();
  }
  // derivative = d/dh tangent(x + h v) at h = 0, m x m, symmetric. It is also the gradient of tangent(x) v.
  virtual void TangentDerivative(const Values& x, const Values& v, Eigen::Ref<Eigen::MatrixXd> derivative) const = 0;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_STRUCTURE_ELEMENT_H_
