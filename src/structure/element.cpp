#include "contact_path/structure/element.h"

namespace contact_path {

std::vector<LocalDof> PositionsOfNodes(int num_nodes) {
  std::vector<LocalDof> dofs;
  for (int node = 0; node < num_nodes; ++node)
    for (int component = 0; component < kPositionComponents; ++component)
      dofs.push_back({node, Field::kPosition, component});
  return dofs;
}

}  // namespace contact_path
