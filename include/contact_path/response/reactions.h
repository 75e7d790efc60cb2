// The forces that supports, obstacles and surfaces exert on a structure at a point of its path.
#ifndef CONTACT_PATH_RESPONSE_REACTIONS_H_
#define CONTACT_PATH_RESPONSE_REACTIONS_H_

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "contact_path/contact/contact_pair.h"
#include "contact_path/law/path_point.h"
#include "contact_path/law/pin_joint.h"
#include "contact_path/response/resultant.h"
#include "contact_path/scene/configuration.h"
#include "contact_path/scene/scaling.h"
#include "contact_path/scene/scene.h"
#include "contact_path/scene/scene_index.h"
#include "contact_path/structure/structure.h"

namespace contact_path {

struct Reactions {
  std::vector<Resultant> supports;    // by SupportedNodes(); 0 in components that are free
  std::vector<Resultant> boundaries;  // by TouchedBoundaries()
};

// Loads, supports and boundaries are in balance: phi - s f - f_constant - T r (eq. 1) at a fixed component is the force
// of the support. Answers come from a structure without supports, in which every component is an unknown.
class ReactionProblem {
 public:
  // scaled, configuration: of the model, in scaled units and counted from its origin. index: of the scene.
  // scaling: brings forces to the units of the scene.
  ReactionProblem(const Scene& scaled, const SceneIndex& index, const Configuration& configuration,
                  const Scaling& scaling);

  // values: Structure::AllValues() of the point in the structure with its supports. The moment of a support is that at
  // its node. Of a boundary: all reactions on nodes, and their moment about the point p of an obstacle where it is
  // now, or about the first node of a surface where it is now. pins: their two forces each, scaled.
  Reactions At(const Eigen::VectorXd& values, const PathPoint& point, const std::vector<PortReals>& pins) const;

 private:
  // Where moments of the boundary are about.
  Eigen::Vector2d Centre(const TouchedBoundary& boundary, const Eigen::VectorXd& u, double s) const;
  Eigen::Vector2d PlaceOf(std::size_t node, const Eigen::VectorXd& u) const;

  struct MovingPoint {
    Eigen::Vector2d at;  // at load factor 0
    Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
    double turn = 0.0;  // about a point, before the motion by the velocity
    Eigen::Vector2d about = Eigen::Vector2d::Zero();
    std::optional<MovingPlace> carried;  // by a body
  };

  Scaling scaling_;
  Structure released_;
  ContactPairs contacts_;                              // of the structure without supports
  std::vector<std::unique_ptr<const PinJoint>> pins_;  // of that structure, too
  std::vector<std::size_t> nodes_;                     // by contact
  std::vector<double> radii_;                          // by contact: of a circle that rolls, else 0
  std::vector<SupportedNode> supports_;
  std::vector<TouchedBoundary> boundaries_;
  std::vector<std::size_t> boundary_of_;  // by contact: into boundaries_
  std::vector<MovingPoint> points_;       // p of each obstacle
  std::vector<std::size_t> first_nodes_;  // of each surface
};

}  // namespace contact_path

#endif  // CONTACT_PATH_RESPONSE_REACTIONS_H_
