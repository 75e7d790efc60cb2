// A node against the surface of a rigid obstacle that may move.
#ifndef CONTACT_PATH_CONTACT_RIGID_PAIR_H_
#define CONTACT_PATH_CONTACT_RIGID_PAIR_H_

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>

#include "contact_path/contact/contact_pair.h"
#include "contact_path/geometry/surface.h"

namespace contact_path {

// The position of the node, p = (dofs, or where a component is held its place), as the obstacle sees it, which has been
// turned about a point a by the angle turn s and then moved by velocity s:
//   x = a + R(-turn s) (p - a - velocity s), R(angle) a rotation counterclockwise; without a turn x = p - velocity s.
struct NodeMotion {
  std::array<int, 2> dofs = {-1, -1};                  // of x and y, ascending; -1 = held
  Eigen::Vector2d held = Eigen::Vector2d::Zero();      // positions of what is held [length]
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // of the obstacle [length] per unit of the load factor
  double turn = 0.0;                                   // of the obstacle [rad] per unit of the load factor
  Eigen::Vector2d about = Eigen::Vector2d::Zero();     // a, before the obstacle has moved [length]
};

// gap(q) and xi(q) are the values of the surface at x(q): derivatives by x come from the projection
// (geometry/surface.h), derivatives by q follow by the chain rule. Without a turn x(q) is affine, and of a flat
// surface everything but the values is constant. Two threads must not use the same pair at once.
class RigidPair : public ContactPair {
 public:
  // friction: mu; 0 where the node cannot slide (scene/surface.h).
  // force_bounds: of Structure::ForceBounds(); without them, the force unit is 1.
  // slip_origin: of the total law of friction, the point from whose foot slip is measured, as the obstacle sees it
  // [length]; nothing: incremental law.
  RigidPair(std::shared_ptr<const Surface> surface, const NodeMotion& motion, double friction,
            const Eigen::VectorXd& force_bounds = Eigen::VectorXd(),
            const std::optional<Eigen::Vector2d>& slip_origin = std::nullopt);

  void Evaluate(const Eigen::VectorXd& u, double s, int patch, const PortReals& reference,
                PortsAt* ports) const override;
  double Gap(const Eigen::VectorXd& u, double s, int patch) const override;
  NearestFoot Nearest(const Eigen::VectorXd& u, double s) const override;
  int PatchAt(const Eigen::VectorXd& u, double s) const override;
  int PatchAfter(const Eigen::VectorXd& u, double s, int from) const override;
  bool HasPatch(int patch) const override { return surface_->HasPatch(patch); }
  XiRange RangeOf(int patch) const override { return RangeBeside(*surface_, patch); }
  void ForceHessian(const Eigen::VectorXd& u, double s, int patch, const PortReals& forces, const LawVector& direction,
                    LawMatrix* derivative) const override;

 private:
  using Motion = Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, 3>;

  // x(q), or its derivatives by s: so often differentiates the rotation.
  struct Frame;

  Eigen::Vector2d Position(const Eigen::VectorXd& u, double s) const;
  Eigen::Vector2d Unturned(const Eigen::VectorXd& u, double s) const;  // p - velocity s
  NearestFoot NearestTo(const Eigen::Vector2d& x) const;
  double FlatGap(const Eigen::VectorXd& u, double s) const;
  // A patch that the surface has: past its ends the first or the last one.
  int NearestKnown(int patch) const;

  std::shared_ptr<const Surface> surface_;
  Eigen::Vector2d held_;
  Motion motion_;  // dx/dq, without the turn
  double turn_;
  Eigen::Vector2d about_;
  // Of a flat surface: offset + gradient . q.
  double gap_offset_ = 0.0, xi_offset_ = 0.0;
  LawVector gap_gradient_, xi_gradient_;
  mutable int nearest_ = -1;  // what was nearest last: where the next search begins, whatever it finds
};

}  // namespace contact_path

#endif  // CONTACT_PATH_CONTACT_RIGID_PAIR_H_
