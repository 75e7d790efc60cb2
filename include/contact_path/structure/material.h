// Elastic laws of plane solids: energy of a deformation gradient, and its first three derivatives.
#ifndef CONTACT_PATH_STRUCTURE_MATERIAL_H_
#define CONTACT_PATH_STRUCTURE_MATERIAL_H_

#include <Eigen/Core>

#include "contact_path/scene/scene.h"
#include "contact_path/scene/solid_parts.h"

namespace contact_path {

// Energy W per initial volume [force/length^2] of an isotropic material with Lame's parameters lambda and mu. With C =
// F' F of three dimensions, its invariants i1, i2, i3, J = sqrt(i3) and E = (C - 1) / 2:
//   neo_hookean          W = mu/2 (i1 - 3 - 2 ln J) + lambda/2 (ln J)^2
//   st_venant_kirchhoff  W = lambda/2 (tr E)^2 + mu tr(E E)
//   ciarlet_geymonat     W = a i1 + (mu/2 - a) i2 + (lambda/4 - mu/2 + a) i3 - (lambda/2 + mu)/2 ln i3 - W(C = 1)
//   linear               W = lambda/2 (tr e)^2 + mu tr(e e), e the symmetric part of F - 1
// Plane strain: C33 = 1. Plane stress: the C33 for which W is least, where the stress across the plane is zero; all
// derivatives are of that least W.
//
// F = (F11, F12, F21, F22), Fij = dx_i/dX_j in the plane. Where the material is turned inside out, F11 F22 - F12 F21 <=
// 0, and where plane stress has no solution, all values are NaN; the linear law has a value everywhere.
class PlaneMaterial {
 public:
  using Gradient = Eigen::Vector4d;
  using Square = Eigen::Matrix4d;

  // `material` and `plane` must be sound (scene/validate.h).
  PlaneMaterial(const Material& material, PlaneState plane);

  // Whether the tangent is the same everywhere.
  bool Linear() const { return model_ == MaterialModel::kLinear; }

  double Energy(const Gradient& F) const;
  // P = dW/dF [force/length^2].
  Gradient Stress(const Gradient& F) const;
  // C33, and J times Cauchy's stress across the plane [force/length^2], which is 0 in plane stress. The linear law: 1,
  // and the stress.
  struct Across {
    double C33 = 1.0;
    double stress = 0.0;
  };
  Across AcrossPlane(const Gradient& F) const;
  // A = d2W/dF2, symmetric.
  Square Tangent(const Gradient& F) const;
  // d/dh A(F + h V) at h = 0, symmetric.
  Square TangentDerivative(const Gradient& F, const Gradient& V) const;

 private:
  // What W depends on: p = ((F11 - F22)^2 + (F12 + F21)^2) / 2 = i/2 - J, with i the trace of C in the plane, and q =
  // J - 1 (linear: q = F11 + F22 - 2). Both are zero at rest.
  struct Measures;
  // W and its derivatives by p and q.
  struct Derivatives;

  Measures MeasuresOf(const Gradient& F) const;
  Derivatives DerivativesAt(const Measures& at) const;
  Derivatives NeoHookean(const Measures& at) const;
  Derivatives CiarletGeymonat(const Measures& at) const;

  MaterialModel model_;
  PlaneState plane_;
  Lame lame_;
  double a_;
  double lambda_in_plane_;  // of laws in which C33 enters by its trace alone
};

}  // namespace contact_path

#endif  // CONTACT_PATH_STRUCTURE_MATERIAL_H_
