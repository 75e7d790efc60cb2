// An element some of whose nodes move with rigid bodies.
#ifndef CONTACT_PATH_STRUCTURE_ATTACHED_ELEMENT_H_
#define CONTACT_PATH_STRUCTURE_ATTACHED_ELEMENT_H_

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

#include "contact_path/structure/element.h"
#include "contact_path/structure/place.h"
#include "contact_path/structure/scene_elements.h"

namespace contact_path {

// What a node is attached to.
struct Attachment {
  int body = 0;         // node of the body
  Eigen::Vector2d arm;  // from the reference point of the body to the node at the start [length]
};

// The energy of the element as a function of what its own nodes and the bodies have, with its derivatives by the chain
// rule. The values of a body are its x, y and rotation.
class AttachedElement : public Element {
 public:
  // attachment_of: of a node of the scene; null where it is not attached. The element itself where none of its nodes
  // is.
  static PlacedElement Wrap(PlacedElement placed, const std::function<const Attachment*(int node)>& attachment_of);

  const std::vector<LocalDof>& Dofs() const override { return dofs_; }
  bool Artificial() const override { return inner_->Artificial(); }
  double AreaRatio(const Values& z) const override { return inner_->AreaRatio(Inner(z)); }
  SolidStress MeanStress(const Values& z) const override { return inner_->MeanStress(Inner(z)); }
  double Energy(const Values& z) const override { return inner_->Energy(Inner(z)); }
  void Force(const Values& z, Eigen::Ref<Eigen::VectorXd> force) const override;
  void Tangent(const Values& z, Eigen::Ref<Eigen::MatrixXd> tangent) const override;
  bool Mixed() const override { return inner_->Mixed(); }
  void MixedTangent(const Values& z, const Values& from, const Values& to,
                    Eigen::Ref<Eigen::MatrixXd> tangent) const override;
  void TangentDerivative(const Values& z, const Values& v, Eigen::Ref<Eigen::MatrixXd> derivative) const override;

 private:
  // Inner values x, y of a node at a place, which is a function of the values z.
  struct Attached {
    Eigen::Index first_inner;
    MovingPlace place;
  };
  struct At;  // the places at z

  AttachedElement() = default;
  Eigen::VectorXd Inner(const Eigen::VectorXd& z) const;
  Eigen::VectorXd InnerForce(const At& at) const;
  // By z, of a tangent of the inner element and its force.
  Eigen::MatrixXd Outer(const At& at, const Eigen::MatrixXd& tangent, const Eigen::VectorXd& force) const;

  std::unique_ptr<const Element> inner_;
  std::vector<LocalDof> dofs_;
  std::vector<int> copied_;  // by inner value: which value of z it is, or -1: a component of a place
  std::vector<Attached> attached_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_STRUCTURE_ATTACHED_ELEMENT_H_
