// The elastic structure of a scene, assembled over its free components.
#ifndef CONTACT_PATH_STRUCTURE_STRUCTURE_H_
#define CONTACT_PATH_STRUCTURE_STRUCTURE_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <map>
#include <memory>
#include <vector>

#include "contact_path/linear/frame.h"
#include "contact_path/scene/configuration.h"
#include "contact_path/scene/scene.h"
#include "contact_path/scene/scene_index.h"
#include "contact_path/structure/attached_element.h"
#include "contact_path/structure/dead_loads.h"
#include "contact_path/structure/dof_map.h"
#include "contact_path/structure/element.h"
#include "contact_path/structure/place.h"
#include "contact_path/structure/scene_elements.h"

namespace contact_path {

// A component of a support whose position is prescribed: u[dof] = start + rate s. A free component otherwise, held by a
// reaction.
struct PrescribedDof {
  int dof = 0;
  double start = 0.0;  // unit of the unknown
  double rate = 0.0;   // unit of the unknown, per unit of the load factor
};

// Total potential energy Pi(u, s) = sum of element energies - (s f + f_constant) . u, phi = dPi/du (Kanno & Martins
// 2005, section 2). u: the unknowns, current positions and rotations, as DofMap numbers them: NumDofs() entries.
class Structure {
 public:
  // `scene` must be sound (scene/validate.h). index: of the scene, or of one with the same nodes. configuration: where
  // not given, Configuration::Of(scene). A node has a rotation where an element asks for it.
  explicit Structure(const Scene& scene);
  Structure(const Scene& scene, const SceneIndex& index, const Configuration& configuration);
  // elements: in place of the elements of the scene.
  Structure(const Scene& scene, const SceneIndex& index, const Configuration& configuration,
            std::vector<PlacedElement> elements);

  const DofMap& Dofs() const { return dofs_; }
  Eigen::Index NumDofs() const { return dofs_.NumDofs(); }
  // The unknown of a position (axis 0 = x, 1 = y), free or prescribed; -1 if it is fixed and rests.
  int Dof(int node, int axis) const { return dofs_.Dof(node, Field::kPosition, axis); }

  const Eigen::VectorXd& Start() const { return start_; }  // u at the start
  Eigen::Vector2d StartPosition(int node) const;           // of its components, free or not
  // Null: the node is not attached to a body.
  const Attachment* AttachmentOf(int node) const;
  FixedPoint PointOf(int node) const;
  MovingFrame FrameOfBody(int node) const;
  const DeadLoads& Loads() const { return loads_; }
  const std::vector<PrescribedDof>& PrescribedDofs() const { return prescribed_; }
  // Nodes that move obliquely: the number of their prescribed component along x; the next number is their component
  // along y.
  const std::vector<std::size_t>& ObliqueSupports() const { return oblique_supports_; }
  // Of the systems of the structure; the solvers of all of them share it.
  Orderings* SharedOrderings() const { return orderings_.get(); }
  // The forces that hold the prescribed components at (u, s), in their order: phi - s f - f_constant [force].
  Eigen::VectorXd SupportReactions(const Eigen::Ref<const Eigen::VectorXd>& u, double s) const;
  // The values of all Dofs().Components(), the unknown ones from u, those of attached nodes by where their bodies are.
  Eigen::VectorXd AllValues(const Eigen::VectorXd& u) const;
  // u, of the values of all components.
  Eigen::VectorXd UnknownsOf(const Eigen::VectorXd& values) const;
  // Calls visit(numbers) for each element and each body: which of Dofs().Components() it joins.
  template <typename Visit>
  void ForEachElement(Visit visit) const {
    for (const Part& part : parts_) visit(part.components);
    for (const std::vector<int>& components : bodies_) visit(components);
  }

  // By unknown: an upper bound of the forces on it in the reference shape per unit of a motion of the elements, and of
  // the loads. In a later stage supports have moved: elements between them and the start of a node tell nothing.
  // An element that is not linear may turn: its largest stiffness counts in all directions.
  Eigen::VectorXd ForceBounds() const;

  // By unknown, in a scaled structure: what residuals of equilibrium are measured in. 1, and more where the structure
  // is so stiff in its reference shape that the rounding of coordinates alone makes forces (tolerances::kStiffForce).
  const Eigen::VectorXd& ResidualUnits() const { return residual_units_; }
  // At most what rounding of the positions changes a force by, by dof. Scaled.
  const Eigen::VectorXd& ForceRounding() const { return force_rounding_; }

  // Strain energy [force length].
  double Energy(const Eigen::VectorXd& u) const;
  // Gradient of the strain energy, NumDofs().
  void InternalForce(const Eigen::Ref<const Eigen::VectorXd>& u, Eigen::Ref<Eigen::VectorXd> force) const;

  // Square, compressed, column-major, structurally symmetric, sorted; every diagonal entry is part of the pattern.
  const Eigen::SparseMatrix<double>& TangentPattern() const { return pattern_; }
  // Hessian of the strain energy; `tangent` must have the pattern and keeps it.
  void Tangent(const Eigen::Ref<const Eigen::VectorXd>& u, Eigen::SparseMatrix<double>* tangent) const;
  // By unknown: of the artificial elements, the changes of their forces at u by motions, columns.
  Eigen::MatrixXd ArtificialForces(const Eigen::VectorXd& u, const Eigen::MatrixXd& motions) const;
  // The same with Element::MixedTangent() where an element has one; Mixed(): whether one has.
  bool Mixed() const { return mixed_; }
  void MixedTangent(const Eigen::Ref<const Eigen::VectorXd>& u, const Eigen::Ref<const Eigen::VectorXd>& from,
                    const Eigen::Ref<const Eigen::VectorXd>& to, Eigen::SparseMatrix<double>* tangent) const;
  // d/dh Tangent(u + h v) at h = 0, on the same pattern; symmetric; also the gradient of Tangent(u) v.
  void TangentDerivative(const Eigen::Ref<const Eigen::VectorXd>& u, const Eigen::Ref<const Eigen::VectorXd>& v,
                         Eigen::SparseMatrix<double>* derivative) const;

 private:
  struct Part {
    std::unique_ptr<const Element> element;
    std::vector<int> components;  // by local dof: into Dofs().Components()
    std::vector<int> dofs;        // by local dof: into u, or -1
    std::vector<int> entries;     // into the values of the pattern, or -1: a square, column-major
  };

  void NumberUnknowns(const Scene& scene, const SceneIndex& index, const Configuration& configuration,
                      const std::vector<PlacedElement>& elements);
  void Attach(const Scene& scene, const SceneIndex& index);
  void AddPart(PlacedElement placed);
  void BuildPattern();
  // By unknown: the sum of the largest stiffnesses of the elements there, in the reference shape.
  Eigen::VectorXd StiffnessBounds() const;
  void Gather(const Part& part, const Eigen::Ref<const Eigen::VectorXd>& u, Eigen::Ref<Eigen::VectorXd> x) const;
  // Calls visit(part, x) for each part, with its values at u.
  template <typename Visit>
  void ForEachPart(const Eigen::Ref<const Eigen::VectorXd>& u, Visit visit) const;
  // On the pattern, the sum of the matrices of all parts, which fill(part, x, matrix) sets.
  template <typename Fill>
  void Assemble(const Eigen::Ref<const Eigen::VectorXd>& u, Fill fill, Eigen::SparseMatrix<double>* sum) const;

  DofMap dofs_;
  Eigen::VectorXd start_values_;      // of all components
  Eigen::VectorXd reference_values_;  // the same in the reference shape
  Eigen::VectorXd start_;
  DeadLoads loads_;
  std::vector<PrescribedDof> prescribed_;
  std::vector<std::size_t> oblique_supports_;
  std::vector<Part> parts_;                     // without elements all of whose nodes are of one body
  double rigid_energy_ = 0.0;                   // of those
  std::vector<std::vector<int>> bodies_;        // components of each
  std::map<int, Eigen::Vector2d> body_starts_;  // by node, of the scene
  std::map<int, Attachment> attachments_;       // by node
  Eigen::SparseMatrix<double> pattern_;
  Eigen::VectorXd residual_units_;
  Eigen::VectorXd force_rounding_;
  bool mixed_ = false;
  std::unique_ptr<Orderings> orderings_ = std::make_unique<Orderings>();
};

}  // namespace contact_path

#endif  // CONTACT_PATH_STRUCTURE_STRUCTURE_H_
