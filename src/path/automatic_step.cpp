#include "contact_path/path/automatic_step.h"

#include <algorithm>
#include <cmath>

namespace contact_path {

double AutomaticStepGrowth(const Model& model) {
  constexpr double kDofsOfNode = 3.0;
  const auto all = static_cast<double>(model.structure.NumDofs());
  double counted = all;
  for (const Beam& beam : model.scene.beams)
    if (beam.nodes.size() > 3) counted -= kDofsOfNode * static_cast<double>(beam.nodes.size() - 3);
  if (!(counted > 0.0)) return 1.0;
  return std::sqrt(all / counted * std::max(1.0, counted / 100.0));
}

}  // namespace contact_path
