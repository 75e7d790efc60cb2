// Motions of parts as rigid bodies that change nothing: what holds a part at a point, and what does not.
#ifndef CONTACT_PATH_EQUATIONS_RIGID_MODES_H_
#define CONTACT_PATH_EQUATIONS_RIGID_MODES_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "contact_path/structure/structure.h"

namespace contact_path {

// A part is what elements connect. Its rigid motions are two translations and the rotation about its middle: they are
// known by geometry, and no singular value has to tell them from soft motions.
class RigidModes {
 public:
  // structure must outlive the object.
  explicit RigidModes(const Structure& structure);

  // Whether supports, resting or moving, leave a part a rigid motion. Otherwise At() finds none anywhere.
  bool Possible() const { return !loose_.empty(); }

  // Orthonormal columns, unknowns x modes, zero beside the positions and rotations: the rigid motions of loose parts,
  // and combinations of these, that are null vectors of the Jacobian to rounding. transposed: unknowns x equations, the
  // first NumDofs() unknowns are u.
  Eigen::MatrixXd At(const Eigen::VectorXd& u, const Eigen::SparseMatrix<double>& transposed) const;

 private:
  // Columns: translation along x and y, rotation about the mean position, of a part; rows: its components.
  Eigen::MatrixX3d MotionsOf(const std::vector<int>& part, const Eigen::VectorXd& values) const;

  const Structure& structure_;
  std::vector<std::vector<int>> loose_;  // components of each part, into Dofs().Components()
};

}  // namespace contact_path

#endif  // CONTACT_PATH_EQUATIONS_RIGID_MODES_H_
