#include "contact_path/path/automatic_step.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace contact_path {
namespace {

double NumFree(const Model& model, int node) {
  double free = 0.0;
  for (const int axis : {0, 1}) free += model.structure.Dof(node, axis) >= 0 ? 1.0 : 0.0;
  return free + (model.structure.Dofs().Dof(node, Field::kRotation, 0) >= 0 ? 1.0 : 0.0);
}

}  // namespace

double AutomaticStepGrowth(const Model& model) {
  // Prescribed components do not count: how many there are depends on the axes.
  const double all =
      static_cast<double>(model.structure.NumDofs()) - static_cast<double>(model.structure.PrescribedDofs().size());
  double counted = all;
  for (const Beam& beam : model.scene.beams) {
    double inner = 0.0;
    for (std::size_t i = 1; i + 1 < beam.nodes.size(); ++i)
      inner += NumFree(model, static_cast<int>(model.index.Node(beam.nodes[i])));
    counted -= std::max(0.0, inner - kMostNodeComponents);
  }
  if (!(counted > 0.0)) return 1.0;
  return std::sqrt(all / counted * std::max(1.0, counted / 100.0));
}

}  // namespace contact_path
