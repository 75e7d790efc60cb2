// Straight segment of a beam between two nodes that turn with it.
#ifndef CONTACT_PATH_STRUCTURE_BEAM_H_
#define CONTACT_PATH_STRUCTURE_BEAM_H_

#include <Eigen/Core>
#include <vector>

#include "contact_path/structure/element.h"

namespace contact_path {

// Co-rotational (Crisfield 1991, section 7): the linear beam in the frame of the chord. With l the length of the chord,
// L its length at the start, and the rotations of the ends against the chord, a = phi_1 - beta and b = phi_2 - beta,
//   W = EA (l - L)^2 / (2 L) + EI (k a^2 + 2 m a b + k b^2) / (2 L),
//   k = (4 + p) / (1 + p), m = (2 - p) / (1 + p), p = 12 EI / (GA L^2), 0 without shear deformation.
// beta is the rotation of the chord since the start; of all its values, 2 pi apart, that which is nearest to the
// rotations of the ends: turns of any number. At a hinge no moment acts, and the node has nothing of the rotation of
// the end: that is what makes W least.
class BeamSegment : public Element {
 public:
  struct Stiffness {
    double EA = 0.0;  // [force], > 0
    double EI = 0.0;  // [force length^2], > 0
    double GA = 0.0;  // [force]; 0 = no shear deformation
  };

  // chord: from the first node to the second at the start, not zero [length].
  BeamSegment(const Stiffness& stiffness, const Eigen::Vector2d& chord, bool hinged_first, bool hinged_second);

  const std::vector<LocalDof>& Dofs() const override { return dofs_; }
  double Energy(const Values& x) const override;
  void Force(const Values& x, Eigen::Ref<Eigen::VectorXd> force) const override;
  void Tangent(const Values& x, Eigen::Ref<Eigen::MatrixXd> tangent) const override;
  // Of the axial force.
  bool Mixed() const override { return true; }
  void MixedTangent(const Values& x, const Values& from, const Values& to,
                    Eigen::Ref<Eigen::MatrixXd> tangent) const override;
  void TangentDerivative(const Values& x, const Values& v, Eigen::Ref<Eigen::MatrixXd> derivative) const override;

 private:
  // The span d of the nodes and the rotations of both ends; a hinged one counts as zero.
  using Coordinates = Eigen::Vector4d;
  using Square = Eigen::Matrix4d;
  struct Chord;
  struct At;
  // A value in a coordinate.
  struct Share {
    Eigen::Index coordinate;
    double sign;
  };

  Coordinates CoordinatesOf(const Values& x) const;
  // The tangent by the coordinates, with these forces.
  Square TangentOf(const At& at, const Eigen::Vector3d& forces) const;
  void Spread(const Square& of_coordinates, Eigen::Ref<Eigen::MatrixXd> out) const;

  double EA_, length_;
  Eigen::Matrix3d stiffnesses_;  // d2W by l, a and b
  Eigen::Vector2d along_;        // the chord at the start, of length 1
  bool hinged_first_, hinged_second_;
  std::vector<LocalDof> dofs_;
  std::vector<Share> shares_;  // by value
};

}  // namespace contact_path

#endif  // CONTACT_PATH_STRUCTURE_BEAM_H_
