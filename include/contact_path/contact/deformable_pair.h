// A node against the boundary of a deformable part.
#ifndef CONTACT_PATH_CONTACT_DEFORMABLE_PAIR_H_
#define CONTACT_PATH_CONTACT_DEFORMABLE_PAIR_H_

#include <Eigen/Core>
#include <memory>

#include "contact_path/contact/contact_pair.h"
#include "contact_path/contact/deformable_boundary.h"

namespace contact_path {

// The dofs belong to the node and to the control nodes of the patch. With y(tau) the spline of the boundary, p = x -
// y and p . y' = 0 at the foot: gap = p . n - radius, n on the left of y'; c = |dy/dxi| (1 - curvature radius), the
// slip along the surface per change of the material coordinate xi. The reaction acts on the node, and opposite on the
// control nodes: the two balance as forces and as moments, also where p is not zero.
class DeformablePair : public ContactPair {
 public:
  // patches: of the spline of the boundary; of a node of the boundary itself, the patches that it may touch.
  // force_bounds: of Structure::ForceBounds(); without them, the force unit is 1. told_by: of a node that is pinned to
  // a body, the compliance of that pin.
  DeformablePair(std::shared_ptr<const DeformableBoundary> boundary, const AdmissiblePatches& patches,
                 const NodePlace& node, double friction, const Eigen::VectorXd& force_bounds = Eigen::VectorXd(),
                 const BroughtOn& overlap = {}, double told_by = 0.0);

  LawDofs Dofs(int patch) const override;
  void Evaluate(const Eigen::VectorXd& u, double s, int patch, const PortReals& reference,
                PortsAt* ports) const override;
  double Gap(const Eigen::VectorXd& u, double s, int patch) const override;
  // The distance is less by the radius than that from the spline: of a node within the radius it is below 0.
  NearestFoot Nearest(const Eigen::VectorXd& u, double s) const override;
  int PatchAfter(const Eigen::VectorXd& u, double s, int from) const override;
  bool HasPatch(int patch) const override;
  XiRange RangeOf(int patch) const override;
  void ForceHessian(const Eigen::VectorXd& u, double s, int patch, const PortReals& forces, const LawVector& weights,
                    LawMatrix* hessian) const override;
  LawVector SecondDirectional(const Eigen::VectorXd& u, double s, int patch, const PortReals& forces,
                              const LawVector& direction) const override;
  Eigen::Vector3d FactorAlong(std::size_t port, const Eigen::VectorXd& u, double s, int patch, const LawVector& first,
                              const LawVector& second) const override;
  // Of the tangential port the mean of two lengths between both feet, on the shapes of the surface before and after;
  // past an end of the surface, the foot is its end.
  double Travel(std::size_t port, const Eigen::VectorXd& u, double s, int patch, const Eigen::VectorXd& du, double ds,
                int patch_after) const override;
  bool Overrun(const Eigen::VectorXd& u, const Eigen::VectorXd& after, int patch) const override;

 private:
  struct Stencil;
  struct Columns;
  BoundaryAt BoundaryAtPlaces(const Eigen::VectorXd& u) const { return {*boundary_, u, patches_}; }

  std::shared_ptr<const DeformableBoundary> boundary_;
  AdmissiblePatches patches_;
  NodePlace node_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_CONTACT_DEFORMABLE_PAIR_H_
