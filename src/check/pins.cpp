#include "check/pins.h"

#include "contact_path/scene/expand.h"

namespace contact_path::check {

Pins::Pins(const Scene& scene, const NodeNumbers& numbers, const std::vector<double>& reference) {
  const std::vector<bool> in_loops = PinsInLoops(scene);
  for (const Pin& pin : scene.pins) {
    const std::size_t first = numbers.at(pin.nodes.at(0)), second = numbers.at(pin.nodes.at(1));
    pins_.push_back(
        {first, second, NodePosition(reference, first) - NodePosition(reference, second), in_loops[pins_.size()]});
  }
}

Vector Pins::Apart(std::size_t pin, const std::vector<double>& positions) const {
  const Pinned& of = pins_[pin];
  return NodePosition(positions, of.first) - NodePosition(positions, of.second) - of.written;
}

void Pins::TakeForces(const std::vector<double>& on_first, std::vector<Real>* forces) const {
  for (std::size_t k = 0; k < pins_.size(); ++k) {
    const Vector force{on_first[2 * k], on_first[2 * k + 1]};
    AddTo(forces, pins_[k].first, -1.0L * force);
    AddTo(forces, pins_[k].second, force);
  }
}

}  // namespace contact_path::check
