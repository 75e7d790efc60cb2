// Draws the increments of a trace as markers for rviz, in the plane z = 0; z only says what lies over what.
//
// Every picture is the same list of markers, by namespace and id: each is added, or deleted where there is nothing of
// its kind. So a picture replaces the one before, whatever the scene, and is whole by itself.
//
//   namespace      id  what
//   obstacles       0  strips along the boundaries, on the forbidden side
//                   1  their boundaries
//                   2  strokes on those that move, which go along
//   initial         0  bars, and all elements of two nodes, in the initial shape
//                   1  nodes
//   superelements   0  lines from the nodes to their middle; of a single node, to its rest position
//                   1  these middles
//   structure       0  bars
//                   1  nodes
//   solids          0  elements in the initial shape: their boundaries
//                   1  elements, from light where there is no energy to dark; the darkest colour is for 1 % of Young's
//                      modulus as energy per volume, or more
//                   2  their boundaries
//   supports        0  triangles away from the structure; with a stroke beyond where the node can slide along it
//   contacts        0  nodes of contact candidates: open grey, stick orange, slip+ yellow, slip- blue, closed green
//   cones           0  friction cones at contacts that touch
//   reactions       0  arrows, from the node
//   loads           0  arrows, from the node; constant loads are lighter
//   caption         0  scene, stage, increment, load factor
//                   1  arrow of full length
//                   2  the force that it stands for
#ifndef CONTACT_PATH_ROS_SCENE_MARKERS_H_
#define CONTACT_PATH_ROS_SCENE_MARKERS_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <visualization_msgs/MarkerArray.h>

#include "contact_path/ros/messages.h"
#include "contact_path/scene/scene.h"
#include "contact_path/scene/scene_index.h"
#include "contact_path/scene/surface.h"
#include "contact_path/structure/element.h"

namespace contact_path {

struct MarkerOptions {
  std::string frame_id = "contact_path";  // of all markers; their stamps are 0, the latest transform
  // 0: markers have the coordinates of the scene. Otherwise the scene is moved and scaled so that it has this size,
  // around the origin: any scene fits one view. >= 0 [length of the frame]
  double picture_size = 0.0;

  // Throws std::invalid_argument naming the field and its value.
  void Validate() const;
};

class MarkerPicture;

class SceneMarkers {
 public:
  // `request` and `options` must be sound (validate.h).
  SceneMarkers(const TraceRequest& request, const MarkerOptions& options);

  // Whether the increment is of a stage of the request and has as many positions and contacts as the scene; increments
  // that are thinned out (full_state_every) have none.
  bool Fits(const contact_path_msgs::Increment& increment) const;

  // The largest of all loads and reactions of an increment that fits [force].
  double LargestForce(const contact_path_msgs::Increment& increment) const;

  // `increment` must fit. `largest_force` [force]: of the path so far. Arrows have one scale, which is halved each time
  // that this force outgrows it: the largest so far is drawn at half of the full length or more, and lengths can be
  // compared between increments. Forces below a thousandth of the characteristic force do not get there.
  visualization_msgs::MarkerArray Draw(const contact_path_msgs::Increment& increment, double largest_force) const;

  // The scene before its first increment: the initial shape, without reactions and with all contacts open.
  visualization_msgs::MarkerArray DrawInitial() const;

 private:
  struct Support {
    std::size_t node = 0;
    Eigen::Vector2d ground = Eigen::Vector2d::Zero();  // direction to it, of unit length
    bool slides = false;                               // along the ground
  };
  // An element of a solid.
  struct Cell {
    std::vector<std::size_t> boundary;  // its nodes, counterclockwise
    std::shared_ptr<const Element> element;
    std::vector<std::size_t> nodes;  // in the order of the element
    double area = 0.0;               // at the start [length^2]
    double full_energy = 1.0;        // that has the darkest colour [force length]
  };
  struct NodalLoad {
    std::size_t node = 0;
    Eigen::Vector2d force = Eigen::Vector2d::Zero();
    bool constant = false;
    bool taken_back = false;  // by this stage, in proportion to the load factor

    Eigen::Vector2d Force(double load_factor) const {
      return (constant ? (taken_back ? 1.0 - load_factor : 1.0) : load_factor) * force;
    }
  };
  struct DrawnObstacle {
    std::shared_ptr<const Surface> surface;
    Eigen::Vector2d point = Eigen::Vector2d::Zero();   // that the strokes keep to, before it has moved
    Eigen::Vector2d shift = Eigen::Vector2d::Zero();   // at load factor 0
    Eigen::Vector2d motion = Eigen::Vector2d::Zero();  // per unit of the load factor
    double friction = 0.0;
    bool moves = false;  // in any stage

    Projection ProjectAt(double load_factor, const Eigen::Vector2d& x) const {
      return surface->Project(x - shift - load_factor * motion);
    }
  };
  // A point of a boundary that is drawn.
  struct BoundaryPoint {
    Eigen::Vector2d place = Eigen::Vector2d::Zero();
    Eigen::Vector2d normal = Eigen::Vector2d::Zero();
    double xi = 0.0;
  };
  struct Candidate {
    std::size_t node = 0;
    std::size_t obstacle = 0;
  };
  // Of a stage; without a program there is one.
  struct StageParts {
    std::string title;
    std::vector<NodalLoad> loads;
    std::vector<DrawnObstacle> obstacles;
  };
  using Places = std::vector<Eigen::Vector2d>;  // by node

  void AddMesh(const Solid& solid, const Scene& scene, const SceneIndex& index);
  // Root of the mean area of the elements of solids.
  double CellSize() const;
  void FindSupports(const Scene& scene);
  void ExtendBox(const TraceRequest& request, const SceneIndex& index, double reach);
  // The boundary of an obstacle around the foot of `centre`, along the tangent. half_length [length].
  static std::vector<BoundaryPoint> BoundaryOf(const DrawnObstacle& obstacle, double load_factor,
                                               const Eigen::Vector2d& centre, double half_length);
  const StageParts& StageOf(const contact_path_msgs::Increment& increment) const;

  visualization_msgs::MarkerArray Draw(const contact_path_msgs::Increment& increment, double largest_force,
                                       const std::string& caption) const;
  void DrawObstacles(const Places& places, const contact_path_msgs::Increment& increment, MarkerPicture* picture) const;
  void DrawStructure(const Places& places, MarkerPicture* picture) const;
  void DrawMeshes(const Places& places, MarkerPicture* picture) const;
  void DrawStars(const Places& places, MarkerPicture* picture) const;
  void DrawSupports(const Places& places, MarkerPicture* picture) const;
  void DrawContacts(const Places& places, const contact_path_msgs::Increment& increment, MarkerPicture* picture) const;
  void DrawForces(const Places& places, const contact_path_msgs::Increment& increment, double full_force,
                  MarkerPicture* picture) const;
  void DrawCaption(const std::string& caption, double full_force, MarkerPicture* picture) const;

  const MarkerOptions options_;
  std::string name_;
  bool has_program_ = false;
  Places initial_;
  std::vector<std::array<std::size_t, 2>> bars_;  // elements of two nodes
  std::vector<std::vector<std::size_t>> stars_;   // elements of any other number of nodes
  std::vector<Eigen::Vector2d> rest_;             // by star: of its first node
  std::vector<Cell> cells_;                       // elements of solids
  std::vector<Support> supports_;
  std::vector<Candidate> contacts_;
  std::vector<StageParts> stages_;

  Eigen::AlignedBox2d box_;   // of the initial shape, and of where stop criteria and moving supports lead
  double size_ = 1.0;         // of the scene: the diagonal of the box [length]
  double detail_ = 1.0;       // diameter of a node; the smaller the bars, the smaller [length]
  double least_force_ = 1.0;  // arrow of full length at first [force]
};

}  // namespace contact_path

#endif  // CONTACT_PATH_ROS_SCENE_MARKERS_H_
