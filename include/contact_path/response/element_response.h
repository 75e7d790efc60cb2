// Section forces of bars and beams, and stresses of solids, at a point of a path.
#ifndef CONTACT_PATH_RESPONSE_ELEMENT_RESPONSE_H_
#define CONTACT_PATH_RESPONSE_ELEMENT_RESPONSE_H_

#include <Eigen/Core>
#include <memory>
#include <tuple>
#include <vector>

#include "contact_path/scene/configuration.h"
#include "contact_path/scene/field.h"
#include "contact_path/scene/scaling.h"
#include "contact_path/scene/scene.h"
#include "contact_path/scene/scene_index.h"
#include "contact_path/structure/dof_map.h"
#include "contact_path/structure/element.h"

namespace contact_path {

// Of a bar, or of a straight segment of a beam from its first to its second node, t along it where it is now, n = t
// turned by 90 degrees counterclockwise: the part behind the section exerts N t + Q n and the moment M on the part
// before it. dM/ds = -Q along a segment. A bar has N alone.
struct SectionForces {
  double N = 0.0;   // > 0: tension [force]
  double Q = 0.0;   // [force]
  double M = 0.0;   // in the middle, > 0: bends counterclockwise from the first to the second node [force length]
  double M1 = 0.0;  // at the first node
  double M2 = 0.0;  // at the second node
};

template <typename P>
constexpr auto Fields(Of<SectionForces>) {
  return std::tuple(Member("N", &P::N), Member("Q", &P::Q), Member("M", &P::M), Member("M1", &P::M1),
                    Member("M2", &P::M2));
}

template <typename P>
constexpr auto Fields(Of<SolidStress>) {
  return std::tuple(Member("sxx", &P::sxx), Member("syy", &P::syy), Member("sxy", &P::sxy), Member("szz", &P::szz),
                    Member("mises", &P::mises), Member("energy", &P::energy));
}

class ElementResponse {
 public:
  // scaled, configuration: of the model, in scaled units and counted from its origin. index: of the scene. dofs: of the
  // structure. scaling: brings forces to the units of the scene.
  ElementResponse(const Scene& scaled, const SceneIndex& index, const Configuration& configuration, const DofMap& dofs,
                  const Scaling& scaling);

  // values: Structure::AllValues(). Sections and elements in the order of scene/scene_index.h.
  std::vector<SectionForces> Sections(const Eigen::VectorXd& values) const;
  std::vector<SolidStress> Stresses(const Eigen::VectorXd& values) const;

 private:
  struct Placed {
    std::unique_ptr<const Element> element;
    std::vector<int> components;  // by local dof: into the values
    std::size_t pieces = 1;       // from node to node, with the same forces
    bool is_tendon = false;
  };

  Scaling scaling_;
  std::vector<Placed> sections_;
  std::vector<Placed> elements_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_RESPONSE_ELEMENT_RESPONSE_H_
