#include "contact_path/structure/structure.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "contact_path/structure/bar.h"
#include "contact_path/structure/superelement.h"

namespace contact_path {
namespace {

// Room for the numbers of one element; those of small elements cost no allocation.
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

Structure::Structure(const Scene& scene) {
  const auto num_nodes = static_cast<Eigen::Index>(scene.nodes.size());
  initial_positions_.resize(2 * num_nodes);
  std::vector<double> free_positions;
  std::unordered_map<std::string, const SupportMotion*> motions;
  for (const SupportMotion& motion : scene.support_motions) motions.emplace(motion.node, &motion);
  for (const Node& node : scene.nodes) {
    const auto index = static_cast<int>(node_index_.size());
    node_index_.emplace(node.name, index);
    initial_positions_[2 * index] = node.x;
    initial_positions_[2 * index + 1] = node.y;
    const auto motion = motions.find(node.name);
    const bool moves = motion != motions.end();
    for (const auto& [fixed, position, rate] : {std::tuple(node.fixed_x, node.x, moves ? motion->second->dx : 0.0),
                                                std::tuple(node.fixed_y, node.y, moves ? motion->second->dy : 0.0)}) {
      const auto dof = static_cast<int>(free_positions.size());
      const bool rests = fixed && rate == 0.0;
      dofs_.push_back(rests ? -1 : dof);
      if (fixed && !rests) prescribed_.push_back({dof, position, rate});
      if (!rests) free_positions.push_back(position);
    }
  }
  initial_ = Eigen::Map<const Eigen::VectorXd>(free_positions.data(), static_cast<Eigen::Index>(free_positions.size()));

  reference_load_ = Eigen::VectorXd::Zero(NumDofs());
  constant_load_ = Eigen::VectorXd::Zero(NumDofs());
  for (const Load& load : scene.loads) {
    Eigen::VectorXd& total = load.constant ? constant_load_ : reference_load_;
    const int node = NodeIndex(load.node);
    if (const int dof = Dof(node, 0); dof >= 0) total[dof] += load.fx;
    if (const int dof = Dof(node, 1); dof >= 0) total[dof] += load.fy;
  }

  for (const Bar& bar : scene.bars) {
    const int p = NodeIndex(bar.nodes[0]), q = NodeIndex(bar.nodes[1]);
    const double distance = (initial_positions_.segment<2>(2 * q) - initial_positions_.segment<2>(2 * p)).norm();
    AddPart(std::make_unique<BarElement>(bar.EA, bar.rest_length > 0.0 ? bar.rest_length : distance, bar.strain),
            bar.nodes);
  }
  for (const Superelement& part : scene.superelements) {
    const auto size = static_cast<Eigen::Index>(2 * part.nodes.size());
    Eigen::VectorXd rest(size);
    if (!part.rest_positions.empty())
      rest = Eigen::Map<const Eigen::VectorXd>(part.rest_positions.data(), size);
    else
      for (std::size_t i = 0; i < part.nodes.size(); ++i)
        rest.segment<2>(static_cast<Eigen::Index>(2 * i)) = initial_positions_.segment<2>(2 * NodeIndex(part.nodes[i]));
    const Eigen::Map<const Eigen::MatrixXd> stiffness(part.stiffness.data(), size, size);
    AddPart(std::make_unique<LinearSuperelement>(0.5 * (stiffness + stiffness.transpose()), std::move(rest)),
            part.nodes);
  }
  BuildPattern();
}

void Structure::AddPart(std::unique_ptr<Element> element, const std::vector<std::string>& nodes) {
  Part part;
  part.element = std::move(element);
  for (const std::string& name : nodes) {
    const int node = NodeIndex(name);
    for (const int axis : {0, 1}) {
      part.components.push_back(2 * node + axis);
      part.dofs.push_back(Dof(node, axis));
    }
  }
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

Eigen::VectorXd Structure::FullPositions(const Eigen::VectorXd& u) const {
  Eigen::VectorXd full = initial_positions_;
  for (std::size_t i = 0; i < dofs_.size(); ++i)
    if (dofs_[i] >= 0) full[static_cast<Eigen::Index>(i)] = u[dofs_[i]];
  return full;
}

void Structure::Gather(const Part& part, const Eigen::Ref<const Eigen::VectorXd>& u,
                       Eigen::Ref<Eigen::VectorXd> x) const {
  for (std::size_t i = 0; i < part.dofs.size(); ++i)
    x[static_cast<Eigen::Index>(i)] = part.dofs[i] >= 0 ? u[part.dofs[i]] : initial_positions_[part.components[i]];
}

double Structure::Energy(const Eigen::VectorXd& u) const {
  double energy = 0.0;
  Scratch x_room;
  for (const Part& part : parts_) {
    auto x = x_room.Vector(part.dofs.size());
    Gather(part, u, x);
    energy += part.element->Energy(x);
  }
  return energy;
}

void Structure::InternalForce(const Eigen::Ref<const Eigen::VectorXd>& u, Eigen::Ref<Eigen::VectorXd> force) const {
  force.setZero();
  Scratch x_room, local_room;
  for (const Part& part : parts_) {
    auto x = x_room.Vector(part.dofs.size()), local = local_room.Vector(part.dofs.size());
    Gather(part, u, x);
    part.element->Force(x, local);
    Scatter(part.dofs, local.data(), force.data());
  }
}

Eigen::VectorXd Structure::SupportReactions(const Eigen::Ref<const Eigen::VectorXd>& u, double s) const {
  Eigen::VectorXd reactions(static_cast<Eigen::Index>(prescribed_.size()));
  if (prescribed_.empty()) return reactions;
  Eigen::VectorXd force(NumDofs());
  InternalForce(u, force);
  force -= s * reference_load_ + constant_load_;
  for (std::size_t k = 0; k < prescribed_.size(); ++k)
    reactions[static_cast<Eigen::Index>(k)] = force[prescribed_[k].dof];
  return reactions;
}

void Structure::Tangent(const Eigen::Ref<const Eigen::VectorXd>& u, Eigen::SparseMatrix<double>* tangent) const {
  std::fill_n(tangent->valuePtr(), tangent->nonZeros(), 0.0);
  Scratch x_room, local_room;
  for (const Part& part : parts_) {
    auto x = x_room.Vector(part.dofs.size());
    auto local = local_room.Square(part.dofs.size());
    Gather(part, u, x);
    part.element->Tangent(x, local);
    Scatter(part.entries, local.data(), tangent->valuePtr());
  }
}

void Structure::TangentDerivative(const Eigen::Ref<const Eigen::VectorXd>& u,
                                  const Eigen::Ref<const Eigen::VectorXd>& v,
                                  Eigen::SparseMatrix<double>* derivative) const {
  std::fill_n(derivative->valuePtr(), derivative->nonZeros(), 0.0);
  Scratch x_room, direction_room, local_room;
  for (const Part& part : parts_) {
    auto x = x_room.Vector(part.dofs.size()), direction = direction_room.Vector(part.dofs.size());
    auto local = local_room.Square(part.dofs.size());
    Gather(part, u, x);
    for (std::size_t i = 0; i < part.dofs.size(); ++i)
      direction[static_cast<Eigen::Index>(i)] = part.dofs[i] >= 0 ? v[part.dofs[i]] : 0.0;
    part.element->TangentDerivative(x, direction, local);
    Scatter(part.entries, local.data(), derivative->valuePtr());
  }
}

}  // namespace contact_path
