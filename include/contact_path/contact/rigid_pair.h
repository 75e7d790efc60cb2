// A node, or a circle of a body, against the surface of a rigid obstacle that may move.
#ifndef CONTACT_PATH_CONTACT_RIGID_PAIR_H_
#define CONTACT_PATH_CONTACT_RIGID_PAIR_H_

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "contact_path/contact/contact_pair.h"
#include "contact_path/geometry/surface.h"
#include "contact_path/structure/place.h"

namespace contact_path {

// Of a circle that rolls or slides on an obstacle.
struct Rolling {
  double radius = 0.0;         // [length]; 0: a node
  Coordinate angle, obstacle;  // of the body that carries the circle, and of the obstacle
};

// gap(q) and xi(q) are the values of the surface at x(q), where the obstacle sees the node: derivatives by x come from
// the projection (geometry/surface.h), those by q from the chain rule (structure/place.h). Of a flat surface and an
// affine place everything but the values is constant. A circle is its centre on the surface on which centres move, and
// its boundary moves along xi, besides, by its radius times the angle by which it turns there: patches end by its foot.
// Where friction changes with the load factor, mu = mu_0 + rate s, the factor of port 1 is c = mu / mu_0, and its force
// is r_t / c, at most mu_0 r_n: the equations are singular where a node sticks and c = 0. Two threads must not use the
// same pair at once.
class RigidPair : public ContactPair {
 public:
  // friction: mu, at s = 0; 0 where the node cannot slide (scene/surface.h).
  // force_bounds: of Structure::ForceBounds(); without them, the force unit is 1.
  // slip_origin: of the total law of friction, the point from whose foot slip is measured, as the obstacle sees it
  // [length]; nothing: incremental law. compliance: of its ports, where reactions need not be determined without.
  // rolls: of a circle, whose place is its centre; the surface then is that on which it moves. friction_rate: d(mu)/ds.
  RigidPair(std::shared_ptr<const Surface> surface, MovingPlace place, double friction,
            const Eigen::VectorXd& force_bounds = Eigen::VectorXd(),
            const std::optional<Eigen::Vector2d>& slip_origin = std::nullopt, double compliance = 0.0,
            const Rolling& rolls = {}, double friction_rate = 0.0, const BroughtOn& overlap = {});

  void Evaluate(const Eigen::VectorXd& u, double s, int patch, const PortReals& reference,
                PortsAt* ports) const override;
  double Gap(const Eigen::VectorXd& u, double s, int patch) const override;
  NearestFoot Nearest(const Eigen::VectorXd& u, double s) const override;
  int PatchAfter(const Eigen::VectorXd& u, double s, int from) const override;
  bool HasPatch(int patch) const override { return surface_->HasPatch(patch); }
  bool TouchesTwice(const Eigen::VectorXd& u, double s, int patch) const override;
  XiRange RangeOf(int patch) const override { return RangeBeside(*surface_, patch); }
  void ForceHessian(const Eigen::VectorXd& u, double s, int patch, const PortReals& forces, const LawVector& weights,
                    LawMatrix* hessian) const override;
  LawVector SecondDirectional(const Eigen::VectorXd& u, double s, int patch, const PortReals& forces,
                              const LawVector& direction) const override;
  Eigen::Vector3d FactorAlong(std::size_t port, const Eigen::VectorXd& u, double s, int patch, const LawVector& first,
                              const LawVector& second) const override;
  double Travel(std::size_t port, const Eigen::VectorXd& u, double s, int patch, const Eigen::VectorXd& du, double ds,
                int patch_after) const override;
  double OnRecord(const Eigen::VectorXd& /*u*/, double s, double force) const override { return force * Share(s); }
  double FromRecord(const Eigen::VectorXd& /*u*/, double s, double rt) const override { return rt / Share(s); }

 private:
  double Share(double s) const { return 1.0 + share_rate_ * s; }  // c
  // Second derivatives of weights . force, by q, with reactions that do not change.
  LawMatrix ChangeAlong(const PlaceAt& place, const Projection& at, double rn, double rt,
                        const LawVector& weights) const;
  Projection FootOf(const PlaceAt& place, const Eigen::VectorXd& u, double s, int patch) const;

  NearestFoot NearestTo(const Eigen::Vector2d& x) const;
  double FlatGap(const Eigen::VectorXd& u, double s) const;
  // A patch that the surface has: past its ends the first or the last one.
  int NearestKnown(int patch) const;

  std::shared_ptr<const Surface> surface_;
  MovingPlace place_;
  double share_rate_;  // dc/ds
  double radius_;      // of a circle
  LawVector roll_;     // d(xi)/dq by the turn of a circle
  // Of a flat surface: offset + gradient . q.
  double gap_offset_ = 0.0, xi_offset_ = 0.0;
  LawVector gap_gradient_, xi_gradient_;
  mutable int nearest_ = -1;  // what was nearest last: where the next search begins, whatever it finds
};

}  // namespace contact_path

#endif  // CONTACT_PATH_CONTACT_RIGID_PAIR_H_
