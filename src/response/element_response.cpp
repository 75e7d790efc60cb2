#include "contact_path/response/element_response.h"

#include <cstddef>
#include <utility>

#include "contact_path/structure/scene_elements.h"

namespace contact_path {
namespace {

template <typename Placed>
Eigen::VectorXd ValuesOf(const Placed& placed, const Eigen::VectorXd& values) {
  Eigen::VectorXd own(static_cast<Eigen::Index>(placed.components.size()));
  for (Eigen::Index i = 0; i < own.size(); ++i) own[i] = values[placed.components[static_cast<std::size_t>(i)]];
  return own;
}

// Of the forces on the ends of a straight element.
SectionForces SectionOf(const Element& element, bool is_tendon, const Eigen::VectorXd& x) {
  Eigen::VectorXd force(x.size());
  element.Force(x, force);
  Eigen::Vector2d begin, end, on_end;
  SectionForces section;
  if (is_tendon) {  // the same all along
    section.N = force.head<2>().norm();
    return section;
  }
  Eigen::Index i = 0;
  for (const LocalDof& local : element.Dofs()) {
    const bool is_end = local.node == 1;
    if (local.field == Field::kRotation) {
      (is_end ? section.M2 : section.M1) = is_end ? force[i] : -force[i];
    } else {
      (is_end ? end : begin)[local.component] = x[i];
      if (is_end) on_end[local.component] = force[i];
    }
    ++i;
  }
  const Eigen::Vector2d chord = end - begin;
  if (const double length = chord.norm(); length > 0.0) {
    section.N = on_end.dot(chord) / length;
    section.Q = (on_end.y() * chord.x() - on_end.x() * chord.y()) / length;
  }
  section.M = 0.5 * (section.M1 + section.M2);
  return section;
}

}  // namespace

ElementResponse::ElementResponse(const Scene& scaled, const SceneIndex& index, const Configuration& configuration,
                                 const DofMap& dofs, const Scaling& scaling)
    : scaling_(scaling) {
  Scene slender = scaled;
  slender.superelements.clear();
  slender.contacts.clear();
  slender.solids.clear();
  slender.pins.clear();
  const auto place = [&dofs](std::vector<PlacedElement> elements, std::vector<Placed>* to) {
    for (PlacedElement& placed : elements) {
      std::vector<int> components;
      for (const LocalDof& local : placed.element->Dofs())
        components.push_back(
            dofs.Index(placed.nodes[static_cast<std::size_t>(local.node)], local.field, local.component));
      to->push_back({std::move(placed.element), std::move(components)});
    }
  };
  place(MakeElements(slender, index, configuration.reference, OneSided::kElements), &sections_);
  for (std::size_t k = 0; k < scaled.tendons.size(); ++k) {
    Placed& placed = sections_[sections_.size() - scaled.tendons.size() + k];
    placed.is_tendon = true;
    placed.pieces = scaled.tendons[k].nodes.size() - 1;
  }
  for (const Solid& solid : scaled.solids)
    place(MakeSolidElements(solid, scaled, index, configuration.reference), &elements_);
}

std::vector<SectionForces> ElementResponse::Sections(const Eigen::VectorXd& values) const {
  const double force = scaling_.force, moment = scaling_.force * scaling_.length;
  std::vector<SectionForces> sections;
  sections.reserve(sections_.size());
  for (const auto& placed : sections_) {
    const SectionForces of = SectionOf(*placed.element, placed.is_tendon, ValuesOf(placed, values));
    sections.insert(sections.end(), placed.pieces,
                    {force * of.N, force * of.Q, moment * of.M, moment * of.M1, moment * of.M2});
  }
  return sections;
}

std::vector<SolidStress> ElementResponse::Stresses(const Eigen::VectorXd& values) const {
  // Forces of a plane scene are of its thickness, which is scaled as a length is.
  const double stress = scaling_.force / (scaling_.length * scaling_.length), energy = scaling_.force * scaling_.length;
  std::vector<SolidStress> stresses;
  stresses.reserve(elements_.size());
  for (const auto& placed : elements_) {
    const SolidStress of = placed.element->MeanStress(ValuesOf(placed, values));
    stresses.push_back(
        {stress * of.sxx, stress * of.syy, stress * of.sxy, stress * of.szz, stress * of.mises, energy * of.energy});
  }
  return stresses;
}

}  // namespace contact_path
