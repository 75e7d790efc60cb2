#include "contact_path/scene/configuration.h"

namespace contact_path {

Configuration Configuration::Of(const Scene& scene) {
  Configuration configuration;
  for (const Node& node : scene.nodes) configuration.reference.insert(configuration.reference.end(), {node.x, node.y});
  configuration.start = configuration.reference;
  configuration.start_rotations.assign(scene.nodes.size(), 0.0);
  return configuration;
}

Configuration Configuration::Over(double length) const {
  Configuration scaled = *this;
  for (std::vector<double>* const positions : {&scaled.reference, &scaled.start, &scaled.slip_origins})
    for (double& position : *positions) position /= length;
  return scaled;
}

}  // namespace contact_path
