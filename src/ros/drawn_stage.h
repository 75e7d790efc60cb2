// What the markers draw of a stage: its loads and obstacles.
#ifndef CONTACT_PATH_SRC_ROS_DRAWN_STAGE_H_
#define CONTACT_PATH_SRC_ROS_DRAWN_STAGE_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "contact_path/geometry/surface.h"
#include "contact_path/scene/scene.h"
#include "contact_path/scene/scene_index.h"

namespace contact_path {

struct DrawnLoad {
  std::size_t node = 0;
  Eigen::Vector2d force = Eigen::Vector2d::Zero();
  double moment = 0.0;  // counterclockwise
  bool constant = false;
  bool taken_back = false;  // by this stage, in proportion to the load factor

  double Share(double load_factor) const { return constant ? (taken_back ? 1.0 - load_factor : 1.0) : load_factor; }
};

// In a stage: turned about a point by `turn` times the load factor, then moved by `motion` times the load factor.
struct DrawnObstacle {
  std::shared_ptr<const Surface> surface;            // at load factor 0
  Eigen::Vector2d point = Eigen::Vector2d::Zero();   // of a half plane: that the strokes keep to, at load factor 0
  Eigen::Vector2d motion = Eigen::Vector2d::Zero();  // per unit of the load factor
  double turn = 0.0;                                 // [rad] per unit of the load factor
  Eigen::Vector2d about = Eigen::Vector2d::Zero();
  bool moves = false;  // in any stage

  Eigen::Rotation2Dd Rotation(double load_factor) const { return Eigen::Rotation2Dd(load_factor * turn); }
  // A point of the plane as the obstacle sees it, and back.
  Eigen::Vector2d Seen(double load_factor, const Eigen::Vector2d& x) const {
    return about + Rotation(load_factor).inverse() * (x - about - load_factor * motion);
  }
  Eigen::Vector2d Placed(double load_factor, const Eigen::Vector2d& x) const {
    return about + Rotation(load_factor) * (x - about) + load_factor * motion;
  }
  Projection ProjectAt(double load_factor, const Eigen::Vector2d& x) const {
    Projection at = surface->ProjectOnNearest(Seen(load_factor, x));
    at.normal = Rotation(load_factor) * at.normal;
    return at;
  }
};

// Of a stage; without a program there is one.
struct DrawnStage {
  std::string title;
  std::vector<DrawnLoad> loads;
  std::vector<DrawnObstacle> obstacles;
};

// The stages of a request. Each is made where it is asked for: a path may end in the first of very many.
class DrawnStages {
 public:
  // `request` must be expanded (expand.h).
  explicit DrawnStages(const TraceRequest& request);

  // From 0. Of several threads.
  std::shared_ptr<const DrawnStage> At(std::size_t stage) const;

 private:
  DrawnStage Make(std::size_t stage) const;

  const TraceRequest request_;
  const SceneIndex index_;
  std::vector<bool> moves_;  // by obstacle: in any stage
  mutable std::mutex mutex_;
  mutable std::size_t last_ = 0;
  mutable std::shared_ptr<const DrawnStage> last_made_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_ROS_DRAWN_STAGE_H_
