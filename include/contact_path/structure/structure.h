// The elastic structure of a scene, assembled over its free components.
#ifndef CONTACT_PATH_STRUCTURE_STRUCTURE_H_
#define CONTACT_PATH_STRUCTURE_STRUCTURE_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "contact_path/scene/scene.h"
#include "contact_path/structure/element.h"

namespace contact_path {

// Total potential energy Pi(u, s) = sum of element energies - (s f + f_constant) . u, phi = dPi/du (Kanno & Martins
// 2005, section 2). u: current positions of the free components, in node order, x before y: NumDofs() entries.
// A component of a support whose position is prescribed: u[dof] = start + rate s. A free component otherwise, held by a
// reaction.
struct PrescribedDof {
  int dof = 0;
  double start = 0.0;  // [length]
  double rate = 0.0;   // [length] per unit of the load factor
};

class Structure {
 public:
  // `scene` must be sound (scene/validate.h).
  explicit Structure(const Scene& scene);

  Eigen::Index NumDofs() const { return initial_.size(); }
  // Index of a free or prescribed component in u (axis 0 = x, 1 = y); -1 if it is fixed and rests.
  int Dof(int node, int axis) const {
    return dofs_[2 * static_cast<std::size_t>(node) + static_cast<std::size_t>(axis)];
  }
  int NodeIndex(const std::string& name) const { return node_index_.at(name); }

  const Eigen::VectorXd& InitialPositions() const { return initial_; }      // of the components in u
  const Eigen::VectorXd& ReferenceLoad() const { return reference_load_; }  // f, scaled by the load factor
  const Eigen::VectorXd& ConstantLoad() const { return constant_load_; }    // f_constant
  const std::vector<PrescribedDof>& PrescribedDofs() const { return prescribed_; }
  // The forces that hold the prescribed components at (u, s), in their order: phi - s f - f_constant [force].
  Eigen::VectorXd SupportReactions(const Eigen::Ref<const Eigen::VectorXd>& u, double s) const;
  // All positions x0, y0, x1, ... with the free components from u.
  Eigen::VectorXd FullPositions(const Eigen::VectorXd& u) const;

  // Strain energy [force length].
  double Energy(const Eigen::VectorXd& u) const;
  // Gradient of the strain energy, NumDofs().
  void InternalForce(const Eigen::Ref<const Eigen::VectorXd>& u, Eigen::Ref<Eigen::VectorXd> force) const;

  // Square, compressed, column-major, structurally symmetric, sorted; every diagonal entry is part of the pattern.
  const Eigen::SparseMatrix<double>& TangentPattern() const { return pattern_; }
  // Hessian of the strain energy; `tangent` must have the pattern and keeps it.
  void Tangent(const Eigen::Ref<const Eigen::VectorXd>& u, Eigen::SparseMatrix<double>* tangent) const;
  // d/dh Tangent(u + h v) at h = 0, on the same pattern; symmetric; also the gradient of Tangent(u) v.
  void TangentDerivative(const Eigen::Ref<const Eigen::VectorXd>& u, const Eigen::Ref<const Eigen::VectorXd>& v,
                         Eigen::SparseMatrix<double>* derivative) const;

 private:
  struct Part {
    std::unique_ptr<Element> element;
    std::vector<int> components;  // index into the full positions, 2n
    std::vector<int> dofs;        // index into u or -1, 2n
    std::vector<int> entries;     // index into the values of the pattern or -1, 2n x 2n column-major
  };

  void AddPart(std::unique_ptr<Element> element, const std::vector<std::string>& nodes);
  void BuildPattern();
  void Gather(const Part& part, const Eigen::Ref<const Eigen::VectorXd>& u, Eigen::Ref<Eigen::VectorXd> x) const;

  std::unordered_map<std::string, int> node_index_;
  std::vector<int> dofs_;              // 2 x nodes
  Eigen::VectorXd initial_positions_;  // 2 x nodes
  Eigen::VectorXd initial_;
  Eigen::VectorXd reference_load_;
  Eigen::VectorXd constant_load_;
  std::vector<PrescribedDof> prescribed_;
  std::vector<Part> parts_;
  Eigen::SparseMatrix<double> pattern_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_STRUCTURE_STRUCTURE_H_
