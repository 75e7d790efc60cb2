#include "contact_path/structure/structure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "contact_path/scene/expand.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

// Room for the numbers of one element; small elements cost no allocation.
class Scratch {
 public:
  Eigen::Map<Eigen::VectorXd> Vector(std::size_t size) { return {Room(size), static_cast<Eigen::Index>(size)}; }
  Eigen::Map<Eigen::MatrixXd> Square(std::size_t size) {
    return {Room(size * size), static_cast<Eigen::Index>(size), static_cast<Eigen::Index>(size)};
  }

 private:
  double* Room(std::size_t size) {
    if (size <= small_.size()) return small_.data();
    if (large_.size() < size) large_.resize(size);
    return large_.data();
  }

  std::array<double, 64> small_;
  std::vector<double> large_;
};

void Scatter(const std::vector<int>& to, const double* values, double* out) {
  for (std::size_t i = 0; i < to.size(); ++i)
    if (to[i] >= 0) out[to[i]] += values[i];
}

}  // namespace

Structure::Structure(const Scene& scene) : Structure(scene, SceneIndex(scene), Configuration::Of(scene)) {}

Structure::Structure(const Scene& scene, const SceneIndex& index, const Configuration& configuration)
    : Structure(scene, index, configuration, MakeElements(scene, index, configuration.reference)) {}

Structure::Structure(const Scene& scene, const SceneIndex& index, const Configuration& configuration,
                     std::vector<PlacedElement> elements)
    : dofs_(scene.nodes.size()) {
  NumberUnknowns(scene, index, configuration, elements);
  Attach(scene, index);
  loads_ = DeadLoads(scene, index, dofs_);
  const auto body_of = [this](int node) { return attachments_.count(node) > 0 ? attachments_.at(node).body : node; };
  for (PlacedElement& placed : elements) {
    // Superelements hold nodes to the plane.
    const bool deforms = placed.element->Linear() ||
                         std::any_of(placed.nodes.begin(), placed.nodes.end(),
                                     [&](int node) { return body_of(node) != body_of(placed.nodes.front()); });
    AddPart(AttachedElement::Wrap(std::move(placed), [this](int node) { return AttachmentOf(node); }));
    if (deforms) continue;
    Eigen::VectorXd x(static_cast<Eigen::Index>(parts_.back().dofs.size()));
    Gather(parts_.back(), start_, x);
    rigid_energy_ += parts_.back().element->Energy(x);
    parts_.pop_back();
  }
  BuildPattern();
  // Coordinates are rounded relative to their size.
  double size = 1.0;
  for (const DofMap::Component& component : dofs_.Components())
    if (component.field == Field::kPosition && component.dof >= 0)
      size = std::max(size, std::abs(start_[component.dof]));
  const Eigen::VectorXd stiffness = size * StiffnessBounds();
  residual_units_ = (tolerances::kStiffForce * stiffness).cwiseMax(1.0);
  force_rounding_ = std::numeric_limits<double>::epsilon() * stiffness;
}

void Structure::NumberUnknowns(const Scene& scene, const SceneIndex& index, const Configuration& configuration,
                               const std::vector<PlacedElement>& elements) {
  const std::vector<double>&start = configuration.start, &reference = configuration.reference;
  std::vector<bool> rotates;
  for (const Node& node : scene.nodes) rotates.push_back(IsBody(node));
  for (const PlacedElement& placed : elements)
    for (const LocalDof& local : placed.element->Dofs())
      if (local.field == Field::kRotation)
        rotates[static_cast<std::size_t>(placed.nodes[static_cast<std::size_t>(local.node)])] = true;
  std::vector<const SupportMotion*> motions(scene.nodes.size(), nullptr);
  for (const SupportMotion& motion : scene.support_motions) motions[index.Node(motion.node)] = &motion;

  std::vector<double> values, references, unknowns;
  const auto add = [&](int node, Field field, int component, double value, double at_reference, bool fixed,
                       double rate) {
    const bool rests = fixed && rate == 0.0;
    const int dof = dofs_.Add(node, field, component, rests);
    if (fixed && !rests) prescribed_.push_back({dof, value, rate});
    values.push_back(value);
    references.push_back(at_reference);
    if (!rests) unknowns.push_back(value);
  };
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    const auto number = static_cast<int>(i);
    const bool attached = IsAttached(node);
    const SupportMotion motion = attached || motions[i] == nullptr ? SupportMotion() : *motions[i];
    const std::size_t before = prescribed_.size();
    add(number, Field::kPosition, 0, start[2 * i], reference[2 * i], attached || node.fixed_x, motion.dx);
    add(number, Field::kPosition, 1, start[2 * i + 1], reference[2 * i + 1], attached || node.fixed_y, motion.dy);
    if (prescribed_.size() == before + 2) oblique_supports_.push_back(before);
    if (rotates[i])
      add(number, Field::kRotation, 0, configuration.start_rotations[i], 0.0, attached || node.fixed_rotation,
          motion.rotation);
  }
  start_values_ = Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  reference_values_ = Eigen::Map<const Eigen::VectorXd>(references.data(), start_values_.size());
  start_ = Eigen::Map<const Eigen::VectorXd>(unknowns.data(), static_cast<Eigen::Index>(unknowns.size()));
}

void Structure::Attach(const Scene& scene, const SceneIndex& index) {
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    const auto number = static_cast<int>(i);
    if (IsBody(node)) {
      bodies_.push_back({dofs_.Index(number, Field::kPosition, 0), dofs_.Index(number, Field::kPosition, 1),
                         dofs_.Index(number, Field::kRotation, 0)});
      body_starts_[number] = {node.x, node.y};
    } else if (IsAttached(node)) {
      const std::size_t body = index.Node(node.body);
      const Node& at = scene.nodes[body];
      attachments_[number] = {static_cast<int>(body), {node.x - at.x, node.y - at.y}};
    }
  }
}

void Structure::AddPart(PlacedElement placed) {
  Part part;
  for (const LocalDof& local : placed.element->Dofs()) {
    const int node = placed.nodes[static_cast<std::size_t>(local.node)];
    part.components.push_back(dofs_.Index(node, local.field, local.component));
    part.dofs.push_back(dofs_.Dof(node, local.field, local.component));
  }
  part.element = std::move(placed.element);
  mixed_ = mixed_ || part.element->Mixed();
  parts_.push_back(std::move(part));
}

void Structure::BuildPattern() {
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(static_cast<std::size_t>(NumDofs()));
  for (int i = 0; i < NumDofs(); ++i) triplets.emplace_back(i, i, 0.0);
  for (const Part& part : parts_)
    for (const int column : part.dofs)
      for (const int row : part.dofs)
        if (row >= 0 && column >= 0) triplets.emplace_back(row, column, 0.0);
  pattern_.resize(NumDofs(), NumDofs());
  pattern_.setFromTriplets(triplets.begin(), triplets.end());
  pattern_.makeCompressed();

  const int* outer = pattern_.outerIndexPtr();
  const int* inner = pattern_.innerIndexPtr();
  for (Part& part : parts_)
    for (const int column : part.dofs)
      for (const int row : part.dofs) {
        if (row < 0 || column < 0) {
          part.entries.push_back(-1);
          continue;
        }
        const int* found = std::lower_bound(inner + outer[column], inner + outer[column + 1], row);
        part.entries.push_back(static_cast<int>(found - inner));
      }
}

Eigen::Vector2d Structure::StartPosition(int node) const {
  return {start_values_[dofs_.Index(node, Field::kPosition, 0)], start_values_[dofs_.Index(node, Field::kPosition, 1)]};
}

const Attachment* Structure::AttachmentOf(int node) const {
  const auto found = attachments_.find(node);
  return found == attachments_.end() ? nullptr : &found->second;
}

FixedPoint Structure::PointOf(int node) const {
  const Attachment* const attachment = AttachmentOf(node);
  if (attachment != nullptr) return {FrameOfBody(attachment->body), attachment->arm};
  const Eigen::Vector2d start = StartPosition(node);
  return {{{Coordinate{Dof(node, 0), start.x()}, Coordinate{Dof(node, 1), start.y()}}}};
}

MovingFrame Structure::FrameOfBody(int node) const {
  const Eigen::Vector2d at = StartPosition(node);
  const double angle = start_values_[dofs_.Index(node, Field::kRotation, 0)];
  return {{Coordinate{Dof(node, 0), at.x()}, Coordinate{Dof(node, 1), at.y()}},
          {dofs_.Dof(node, Field::kRotation, 0), angle},
          Eigen::Vector2d::Zero(),
          body_starts_.at(node)};
}

Eigen::VectorXd Structure::AllValues(const Eigen::VectorXd& u) const {
  Eigen::VectorXd values = start_values_;
  Eigen::Index k = 0;
  for (const DofMap::Component& component : dofs_.Components()) {
    if (component.dof >= 0) values[k] = u[component.dof];
    ++k;
  }
  for (const auto& [node, attachment] : attachments_) {
    values.segment<2>(dofs_.Index(node, Field::kPosition, 0)) = MovingPlace(PointOf(node)).At(u, 0.0);
    if (const int rotation = dofs_.Index(node, Field::kRotation, 0); rotation >= 0)
      values[rotation] = values[dofs_.Index(attachment.body, Field::kRotation, 0)];
  }
  return values;
}

Eigen::VectorXd Structure::UnknownsOf(const Eigen::VectorXd& values) const {
  Eigen::VectorXd u(NumDofs());
  Eigen::Index k = 0;
  for (const DofMap::Component& component : dofs_.Components()) {
    if (component.dof >= 0) u[component.dof] = values[k];
    ++k;
  }
  return u;
}

void Structure::Gather(const Part& part, const Eigen::Ref<const Eigen::VectorXd>& u,
                       Eigen::Ref<Eigen::VectorXd> x) const {
  for (std::size_t i = 0; i < part.dofs.size(); ++i)
    x[static_cast<Eigen::Index>(i)] = part.dofs[i] >= 0 ? u[part.dofs[i]] : start_values_[part.components[i]];
}

template <typename Visit>
void Structure::ForEachPart(const Eigen::Ref<const Eigen::VectorXd>& u, Visit visit) const {
  Scratch room;
  for (const Part& part : parts_) {
    auto x = room.Vector(part.dofs.size());
    Gather(part, u, x);
    visit(part, x);
  }
}

template <typename Fill>
void Structure::Assemble(const Eigen::Ref<const Eigen::VectorXd>& u, Fill fill,
                         Eigen::SparseMatrix<double>* sum) const {
  std::fill_n(sum->valuePtr(), sum->nonZeros(), 0.0);
  Scratch room;
  ForEachPart(u, [&](const Part& part, const auto& x) {
    auto local = room.Square(part.dofs.size());
    fill(part, x, local);
    Scatter(part.entries, local.data(), sum->valuePtr());
  });
}

double Structure::Energy(const Eigen::VectorXd& u) const {
  double energy = rigid_energy_;
  ForEachPart(u, [&](const Part& part, const auto& x) { energy += part.element->Energy(x); });
  return energy;
}

void Structure::InternalForce(const Eigen::Ref<const Eigen::VectorXd>& u, Eigen::Ref<Eigen::VectorXd> force) const {
  force.setZero();
  Scratch room;
  ForEachPart(u, [&](const Part& part, const auto& x) {
    auto local = room.Vector(part.dofs.size());
    part.element->Force(x, local);
    Scatter(part.dofs, local.data(), force.data());
  });
}

Eigen::VectorXd Structure::SupportReactions(const Eigen::Ref<const Eigen::VectorXd>& u, double s) const {
  Eigen::VectorXd reactions(static_cast<Eigen::Index>(prescribed_.size()));
  if (prescribed_.empty()) return reactions;
  Eigen::VectorXd force(NumDofs());
  InternalForce(u, force);
  loads_.TakeFrom(force, s);
  for (std::size_t k = 0; k < prescribed_.size(); ++k)
    reactions[static_cast<Eigen::Index>(k)] = force[prescribed_[k].dof];
  return reactions;
}

Eigen::VectorXd Structure::ForceBounds() const { return loads_.Sizes(1.0) + StiffnessBounds(); }

Eigen::VectorXd Structure::StiffnessBounds() const {
  Eigen::VectorXd bounds = Eigen::VectorXd::Zero(NumDofs());
  Scratch room, values;
  for (const Part& part : parts_) {
    auto x = values.Vector(part.dofs.size());
    for (std::size_t i = 0; i < part.dofs.size(); ++i)
      x[static_cast<Eigen::Index>(i)] = reference_values_[part.components[i]];
    auto local = room.Square(part.dofs.size());
    part.element->Tangent(x, local);
    const Eigen::MatrixXd sizes = local.cwiseAbs();
    for (std::size_t i = 0; i < part.dofs.size(); ++i)
      if (part.dofs[i] >= 0)
        bounds[part.dofs[i]] +=
            part.element->Linear() ? sizes.row(static_cast<Eigen::Index>(i)).sum() : sizes.maxCoeff();
  }
  return bounds;
}

void Structure::Tangent(const Eigen::Ref<const Eigen::VectorXd>& u, Eigen::SparseMatrix<double>* tangent) const {
  Assemble(
      u, [](const Part& part, const auto& x, auto& local) { part.element->Tangent(x, local); }, tangent);
}

Eigen::MatrixXd Structure::ArtificialForces(const Eigen::VectorXd& u, const Eigen::MatrixXd& motions) const {
  Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(motions.rows(), motions.cols());
  Scratch room;
  ForEachPart(u, [&](const Part& part, const auto& x) {
    if (!part.element->Artificial()) return;
    auto local = room.Square(part.dofs.size());
    part.element->Tangent(x, local);
    for (std::size_t i = 0; i < part.dofs.size(); ++i)
      for (std::size_t k = 0; k < part.dofs.size(); ++k)
        if (part.dofs[i] >= 0 && part.dofs[k] >= 0)
          forces.row(part.dofs[i]) +=
              local(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) * motions.row(part.dofs[k]);
  });
  return forces;
}

void Structure::MixedTangent(const Eigen::Ref<const Eigen::VectorXd>& u, const Eigen::Ref<const Eigen::VectorXd>& from,
                             const Eigen::Ref<const Eigen::VectorXd>& to, Eigen::SparseMatrix<double>* tangent) const {
  Scratch from_room, to_room;
  const auto fill = [&](const Part& part, const auto& x, auto& local) {
    if (!part.element->Mixed()) return part.element->Tangent(x, local);
    auto local_from = from_room.Vector(part.dofs.size()), local_to = to_room.Vector(part.dofs.size());
    Gather(part, from, local_from);
    Gather(part, to, local_to);
    part.element->MixedTangent(x, local_from, local_to, local);
  };
  Assemble(u, fill, tangent);
}

void Structure::TangentDerivative(const Eigen::Ref<const Eigen::VectorXd>& u,
                                  const Eigen::Ref<const Eigen::VectorXd>& v,
                                  Eigen::SparseMatrix<double>* derivative) const {
  Scratch room;
  const auto fill = [&](const Part& part, const auto& x, auto& local) {
    auto direction = room.Vector(part.dofs.size());
    for (std::size_t i = 0; i < part.dofs.size(); ++i)
      direction[static_cast<Eigen::Index>(i)] = part.dofs[i] >= 0 ? v[part.dofs[i]] : 0.0;
    part.element->TangentDerivative(x, direction, local);
  };
  Assemble(u, fill, derivative);
}

}  // namespace contact_path
