// Two points that stay together, as a law.
#ifndef CONTACT_PATH_LAW_PIN_JOINT_H_
#define CONTACT_PATH_LAW_PIN_JOINT_H_

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <vector>

#include "contact_path/law/law.h"
#include "contact_path/scene/scene.h"
#include "contact_path/scene/scene_index.h"
#include "contact_path/structure/place.h"
#include "contact_path/structure/structure.h"

namespace contact_path {

// The ports have the motions x_1 - x_2 - (X_1 - X_2) along x and y [length], X_1 and X_2 the same point but for the
// rounding of its coordinates, and the force r on the first point by the second. There is one state:
//   x_1 - x_2 - (X_1 - X_2) + compliance r = 0
class PinJoint : public Law {
 public:
  // apart: from the second point to the first; at_start: X_1 - X_2. compliance: of its ports, where forces need not be
  // determined without.
  PinJoint(MovingPlace apart, const Eigen::Vector2d& at_start, double compliance);

  void Evaluate(const Eigen::VectorXd& u, double s, int piece, const PortReals& reference,
                PortsAt* ports) const override;
  void ForceHessian(const Eigen::VectorXd& u, double s, int piece, const PortReals& forces, const LawVector& weights,
                    LawMatrix* hessian) const override;
  PortReals ReferenceAt(const Eigen::VectorXd& /*u*/, double /*s*/, int /*piece*/) const override { return {}; }
  double Reach(const Eigen::VectorXd& /*u*/, double /*s*/) const override {
    return std::numeric_limits<double>::infinity();  // never idle
  }
  Modes ModesAt(const Eigen::VectorXd& /*u*/, double /*s*/, const Mode& now, const PortReals& /*forces*/,
                const ActiveSetTolerance& /*tolerance*/) const override {
    return {now};
  }
  Mode Initial(const Eigen::VectorXd& /*u*/, double /*s*/) const override { return {}; }
  std::vector<Ray> Rays(const Eigen::VectorXd& u, double s, int piece,
                        const ActiveSetTolerance& tolerance) const override;

 private:
  MovingPlace apart_;
  Eigen::Vector2d at_start_;
};

// Of the pins of the scene. `scene` must be sound, `structure` built from it. reference: x0, y0, x1, ... of the shape
// without stress (scene/configuration.h).
std::vector<std::unique_ptr<const PinJoint>> BuildPins(const Scene& scene, const SceneIndex& index,
                                                       const Structure& structure,
                                                       const std::vector<double>& reference);

}  // namespace contact_path

#endif  // CONTACT_PATH_LAW_PIN_JOINT_H_
