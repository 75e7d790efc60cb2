#include "contact_path/structure/dof_map.h"

namespace contact_path {

DofMap::DofMap(std::size_t num_nodes) : index_(num_nodes) {
  for (auto& slots : index_) slots.fill(-1);
}

std::size_t DofMap::Slot(Field field, int component) {
  return static_cast<std::size_t>(field == Field::kPosition ? component : kPositionComponents);
}

int DofMap::Add(int node, Field field, int component, bool held) {
  const int dof = held ? -1 : static_cast<int>(num_dofs_++);
  index_[static_cast<std::size_t>(node)][Slot(field, component)] = static_cast<int>(components_.size());
  components_.push_back({node, field, component, dof});
  return dof;
}

int DofMap::Index(int node, Field field, int component) const {
  return index_[static_cast<std::size_t>(node)][Slot(field, component)];
}

int DofMap::Dof(int node, Field field, int component) const {
  const int index = Index(node, field, component);
  return index < 0 ? -1 : components_[static_cast<std::size_t>(index)].dof;
}

}  // namespace contact_path
