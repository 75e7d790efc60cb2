// What the markers draw of a request: its parts by index, and the size of the picture.
#ifndef CONTACT_PATH_SRC_ROS_DRAWN_SCENE_H_
#define CONTACT_PATH_SRC_ROS_DRAWN_SCENE_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "contact_path/ros/messages.h"
#include "contact_path/scene/boundary_curve.h"
#include "contact_path/scene/reacting_parts.h"
#include "contact_path/scene/scene.h"
#include "contact_path/scene/scene_index.h"
#include "contact_path/structure/element.h"
#include "ros/beam_curve.h"
#include "ros/drawn_stage.h"

namespace contact_path {

using NodePlaces = std::vector<Eigen::Vector2d>;  // by node

struct DrawnSupport {
  std::size_t node = 0;
  Eigen::Vector2d ground = Eigen::Vector2d::Zero();  // direction to it, of unit length
  bool slides = false;                               // along the ground
};

// An element of a solid.
struct DrawnCell {
  std::vector<std::size_t> boundary;  // its nodes, counterclockwise
  std::shared_ptr<const Element> element;
  std::vector<std::size_t> nodes;  // in the order of the element
  double area = 0.0;               // at the start [length^2]
  double full_energy = 1.0;        // that has the darkest colour [force length]
};

// A surface that contacts touch.
struct DrawnSurface {
  std::vector<std::size_t> nodes;
  bool closed = false;
  double radius = 0.0;
  std::array<int, 2> across = {-1, -1};  // SymmetryAxes()

  NodePlaces PlacesIn(const NodePlaces& places) const;
  BoundaryCurve At(const NodePlaces& places) const;
};

struct DrawnCandidate {
  std::size_t node = 0;
  bool on_surface = false;
  std::size_t partner = 0;  // the place of its surface among the drawn ones, or of its obstacle
  double friction = 0.0;
  std::optional<AdmissiblePatches> patches = {};  // of its surface
};

Eigen::Vector2d MiddleOf(const std::vector<std::size_t>& nodes, const NodePlaces& places);

struct DrawnScene {
  // `request` must be sound (validate.h).
  explicit DrawnScene(const TraceRequest& request);

  // Whether the increment is of a stage of the request and has as many positions and contacts as the scene, and as many
  // reactions of supports, or none.
  bool Fits(const contact_path_msgs::Increment& increment) const;
  std::shared_ptr<const DrawnStage> StageOf(const contact_path_msgs::Increment& increment) const;
  // The largest of all loads and reactions; a moment counts as a force at the distance of the size [force].
  double LargestForce(const contact_path_msgs::Increment& increment) const;
  // The increment before the first: the initial shape, without reactions and with all contacts open.
  contact_path_msgs::Increment Initial() const;

  std::string name;
  bool has_program = false;
  std::size_t num_stages = 1;
  NodePlaces initial;
  std::vector<bool> inner;                       // by node: between the ends of a beam
  std::vector<std::array<std::size_t, 2>> bars;  // elements of two nodes
  std::vector<DrawnSegment> segments;            // of beams
  std::vector<std::vector<std::size_t>> stars;   // elements of any other number of nodes
  std::vector<Eigen::Vector2d> rest;             // by star: of its first node
  std::vector<DrawnCell> cells;                  // elements of solids
  std::vector<DrawnSupport> supports;
  std::vector<SupportedNode> reacting;  // whose reactions the increments have
  std::vector<DrawnSurface> surfaces;
  std::vector<DrawnCandidate> contacts;

  Eigen::AlignedBox2d box;   // of the initial shape, and of where stop criteria and moving supports lead
  double size = 1.0;         // of the scene: the diagonal of the box [length]
  double detail = 1.0;       // diameter of a node; the smaller the bars, the smaller [length]
  double least_force = 1.0;  // arrow of full length at first [force]

 private:
  void AddElements(const Scene& scene, const SceneIndex& index);
  void AddBeam(const Beam& beam, const SceneIndex& index);
  void AddContacts(const Scene& scene, const SceneIndex& index);
  void AddMesh(const Solid& solid, const Scene& scene, const SceneIndex& index);
  // By the places where the supports come to at the ends of the stages.
  void ExtendBoxBySupports(const TraceRequest& request, const SceneIndex& index);
  void FindSupports(const Scene& scene);
  void ExtendBoxByStops(const TraceRequest& request, const SceneIndex& index, double reach);
  // Root of the mean area of the elements of solids.
  double CellSize() const;

  std::unique_ptr<const DrawnStages> stages_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_ROS_DRAWN_SCENE_H_
