// The unknowns of a structure: which there are, and in which unit.
#ifndef CONTACT_PATH_STRUCTURE_DOF_MAP_H_
#define CONTACT_PATH_STRUCTURE_DOF_MAP_H_

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

namespace contact_path {

// What a node has.
enum class Field {
  kPosition,  // components 0 = x, 1 = y [length]
  kRotation,  // component 0, counterclockwise [rad]
};

inline constexpr int kPositionComponents = 2;
inline constexpr int kMostNodeComponents = kPositionComponents + 1;

// The scene unit of a scaled value of this field: value of the scene = scaled value x unit. length: L.
inline double UnitOf(Field field, double length) { return field == Field::kPosition ? length : 1.0; }

// Numbers the values of all nodes, free ones and held ones, and the unknowns among them, both in the order of Add().
// Arc length is the Euclidean norm of the scaled unknowns and the scaled load factor: the unit of an unknown is also
// what one unit of arc length is worth in it.
class DofMap {
 public:
  struct Component {
    int node = 0;
    Field field = Field::kPosition;
    int component = 0;
    int dof = -1;  // unknown; -1 = held
  };

  explicit DofMap(std::size_t num_nodes) : index_(num_nodes) {
    for (auto& slots : index_) slots.fill(-1);
  }

  // Gives a node a value that it does not have yet. Returns its unknown, or -1 if it is held.
  int Add(int node, Field field, int component, bool held) {
    const int dof = held ? -1 : static_cast<int>(num_dofs_++);
    index_[static_cast<std::size_t>(node)][Slot(field, component)] = static_cast<int>(components_.size());
    components_.push_back({node, field, component, dof});
    return dof;
  }

  Eigen::Index NumDofs() const { return num_dofs_; }
  // The unknown; -1 if the value is held or the node has none.
  int Dof(int node, Field field, int component) const {
    const int index = Index(node, field, component);
    return index < 0 ? -1 : components_[static_cast<std::size_t>(index)].dof;
  }
  // The value among Components(); -1 if the node has none.
  int Index(int node, Field field, int component) const {
    return index_[static_cast<std::size_t>(node)][Slot(field, component)];
  }
  const std::vector<Component>& Components() const { return components_; }

 private:
  static std::size_t Slot(Field field, int component) {
    return static_cast<std::size_t>(field == Field::kPosition ? component : kPositionComponents);
  }

  std::vector<std::array<int, kMostNodeComponents>> index_;  // by node and slot: into components_, or -1
  std::vector<Component> components_;
  Eigen::Index num_dofs_ = 0;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_STRUCTURE_DOF_MAP_H_
