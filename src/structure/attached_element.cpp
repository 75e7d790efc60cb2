#include "contact_path/structure/attached_element.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace contact_path {
namespace {

// Adds a matrix by the entries of a place to one by the values of the element.
void Scatter(const LawDofs& dofs, const LawMatrix& of_place, Eigen::Ref<Eigen::MatrixXd> out) {
  for (std::size_t i = 0; i < dofs.size(); ++i)
    for (std::size_t k = 0; k < dofs.size(); ++k)
      out(dofs[i], dofs[k]) += of_place(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
}

void Scatter(const LawDofs& dofs, const MovingPlace::Motion& of_place, Eigen::Index first, Eigen::MatrixXd* out) {
  for (std::size_t i = 0; i < dofs.size(); ++i)
    out->block<2, 1>(first, dofs[i]) += of_place.col(static_cast<Eigen::Index>(i));
}

}  // namespace

struct AttachedElement::At {
  At(const AttachedElement& of, const Eigen::VectorXd& z)
      : inner(of.copied_.size()), jacobian(Eigen::MatrixXd::Zero(inner.size(), z.size())) {
    for (std::size_t i = 0; i < of.copied_.size(); ++i) {
      if (of.copied_[i] < 0) continue;
      inner[static_cast<Eigen::Index>(i)] = z[of.copied_[i]];
      jacobian(static_cast<Eigen::Index>(i), of.copied_[i]) = 1.0;
    }
    for (const Attached& attached : of.attached_) {
      const PlaceAt& place = places.emplace_back(attached.place, z, 0.0);
      inner.segment<2>(attached.first_inner) = place.x;
      Scatter(attached.place.Dofs(), place.first, attached.first_inner, &jacobian);
    }
  }

  std::vector<PlaceAt> places;
  Eigen::VectorXd inner;
  Eigen::MatrixXd jacobian;  // of the inner values by z
};

PlacedElement AttachedElement::Wrap(PlacedElement placed,
                                    const std::function<const Attachment*(int node)>& attachment_of) {
  const std::vector<int> nodes = placed.nodes;
  if (std::none_of(nodes.begin(), nodes.end(), attachment_of)) return placed;
  auto element = std::unique_ptr<AttachedElement>(new AttachedElement());
  std::vector<int> outer_nodes;
  const auto value_of = [&](int node, Field field, int component) {
    const auto at = std::find(outer_nodes.begin(), outer_nodes.end(), node);
    const LocalDof dof = {static_cast<int>(at - outer_nodes.begin()), field, component};
    if (at == outer_nodes.end()) outer_nodes.push_back(node);
    auto& dofs = element->dofs_;
    for (std::size_t k = 0; k < dofs.size(); ++k)
      if (dofs[k].node == dof.node && dofs[k].field == field && dofs[k].component == component)
        return static_cast<int>(k);
    dofs.push_back(dof);
    return static_cast<int>(dofs.size()) - 1;
  };
  const std::vector<LocalDof>& inner = placed.element->Dofs();
  for (std::size_t i = 0; i < inner.size(); ++i) {
    const int node = nodes[static_cast<std::size_t>(inner[i].node)];
    const Attachment* const attachment = attachment_of(node);
    if (attachment == nullptr || inner[i].field == Field::kRotation) {
      element->copied_.push_back(
          value_of(attachment == nullptr ? node : attachment->body, inner[i].field, inner[i].component));
      continue;
    }
    element->copied_.push_back(-1);
    if (inner[i].component != 0) continue;  // y follows x
    FixedPoint point;
    point.arm = attachment->arm;
    for (const int axis : {0, 1})
      point.frame.origin[static_cast<std::size_t>(axis)].dof = value_of(attachment->body, Field::kPosition, axis);
    point.frame.angle.dof = value_of(attachment->body, Field::kRotation, 0);
    element->attached_.push_back({static_cast<Eigen::Index>(i), MovingPlace(point)});
  }
  element->inner_ = std::move(placed.element);
  return {std::move(element), std::move(outer_nodes)};
}

Eigen::VectorXd AttachedElement::Inner(const Eigen::VectorXd& z) const { return At(*this, z).inner; }

Eigen::VectorXd AttachedElement::InnerForce(const At& at) const {
  Eigen::VectorXd force(at.inner.size());
  inner_->Force(at.inner, force);
  return force;
}

Eigen::MatrixXd AttachedElement::Outer(const At& at, const Eigen::MatrixXd& tangent,
                                       const Eigen::VectorXd& force) const {
  // The gradients of the places change.
  Eigen::MatrixXd bend = Eigen::MatrixXd::Zero(at.jacobian.cols(), at.jacobian.cols());
  for (std::size_t k = 0; k < attached_.size(); ++k)
    Scatter(attached_[k].place.Dofs(), at.places[k].Second(force.segment<2>(attached_[k].first_inner)), bend);
  return at.jacobian.transpose() * tangent * at.jacobian + bend;
}

void AttachedElement::Force(const Values& z, Eigen::Ref<Eigen::VectorXd> force) const {
  const At at(*this, z);
  force = at.jacobian.transpose() * InnerForce(at);
}

void AttachedElement::Tangent(const Values& z, Eigen::Ref<Eigen::MatrixXd> tangent) const {
  const At at(*this, z);
  Eigen::MatrixXd inner(at.inner.size(), at.inner.size());
  inner_->Tangent(at.inner, inner);
  tangent = Outer(at, inner, InnerForce(at));
}

void AttachedElement::MixedTangent(const Values& z, const Values& from, const Values& to,
                                   Eigen::Ref<Eigen::MatrixXd> tangent) const {
  const At at(*this, z);
  Eigen::MatrixXd inner(at.inner.size(), at.inner.size());
  inner_->MixedTangent(at.inner, Inner(from), Inner(to), inner);
  tangent = Outer(at, inner, InnerForce(at));
}

void AttachedElement::TangentDerivative(const Values& z, const Values& v,
                                        Eigen::Ref<Eigen::MatrixXd> derivative) const {
  const At at(*this, z);
  const Eigen::Index size = at.inner.size();
  Eigen::MatrixXd tangent(size, size), change(size, size), jacobian_change = Eigen::MatrixXd::Zero(size, z.size());
  const Eigen::VectorXd along = at.jacobian * v, force = InnerForce(at);
  inner_->Tangent(at.inner, tangent);
  inner_->TangentDerivative(at.inner, along, change);
  derivative = Outer(at, change, tangent * along);
  for (std::size_t k = 0; k < attached_.size(); ++k) {
    const auto& [first, place] = attached_[k];
    const LawVector direction = LocalOf(place.Dofs(), v, 0.0);
    Scatter(place.Dofs(), at.places[k].FirstChange(direction), first, &jacobian_change);
    Scatter(place.Dofs(), at.places[k].SecondChange(force.segment<2>(first), direction), derivative);
  }
  const Eigen::MatrixXd mixed = jacobian_change.transpose() * tangent * at.jacobian;
  derivative += mixed + mixed.transpose();
}

}  // namespace contact_path
