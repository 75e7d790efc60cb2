// Pressure of contacts: their reactions over the length of the boundary that their nodes stand for.
#ifndef CONTACT_PATH_RESPONSE_CONTACT_PRESSURE_H_
#define CONTACT_PATH_RESPONSE_CONTACT_PRESSURE_H_

#include <Eigen/Core>
#include <cstddef>
#include <tuple>
#include <vector>

#include "contact_path/contact/contact_state.h"
#include "contact_path/scene/field.h"
#include "contact_path/scene/scaling.h"
#include "contact_path/scene/scene.h"
#include "contact_path/scene/scene_index.h"
#include "contact_path/structure/dof_map.h"

namespace contact_path {

struct ContactPressure {
  double pressure = 0.0;  // rn over length [force/length]; 0 where the length is 0
  double traction = 0.0;  // rt over length
  double length = 0.0;    // of the boundary where it is now [length]
};

template <typename P>
constexpr auto Fields(Of<ContactPressure>) {
  return std::tuple(Member("pressure", &P::pressure), Member("traction", &P::traction), Member("length", &P::length));
}

struct Pressures {
  std::vector<ContactPressure> contacts;  // in scene order
  std::vector<double> widths;             // of TouchedBoundaries(): sum of the lengths of the contacts that touch it
};

// A candidate stands for the integral of its shape function along the edges that have candidates of one obstacle, or of
// one surface, at all of their nodes: edges of solids that are no edges between elements, and segments of beams. So
// a constant pressure has the same nodal pressure everywhere, also where edges have nodes in their middle.
class PressureProblem {
 public:
  // scene: expanded, in any units. dofs: of the structure. scaling: brings forces and lengths to the units of the
  // scene.
  PressureProblem(const Scene& scene, const SceneIndex& index, const DofMap& dofs, const Scaling& scaling);

  // values: Structure::AllValues() of the point; rt: by contact, scaled.
  Pressures At(const Eigen::VectorXd& values, const PathPoint& point, const std::vector<double>& rt) const;

 private:
  // Of two nodes, or of three, the last in the middle.
  struct Edge {
    std::vector<Eigen::Index> x, y;     // of its nodes: into the values
    std::vector<std::size_t> contacts;  // at its nodes
  };

  Scaling scaling_;
  std::vector<Edge> edges_;
  std::vector<std::size_t> boundary_of_;  // by contact: which of TouchedBoundaries()
  std::size_t num_boundaries_ = 0;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_RESPONSE_CONTACT_PRESSURE_H_
