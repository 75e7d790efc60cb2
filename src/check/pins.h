// Pins as the check sees them: written from their definition, apart from law/.
#ifndef CONTACT_PATH_SRC_CHECK_PINS_H_
#define CONTACT_PATH_SRC_CHECK_PINS_H_

#include <cstddef>
#include <vector>

#include "check/elements.h"
#include "check/plane.h"
#include "contact_path/scene/scene.h"

namespace contact_path::check {

class Pins {
 public:
  // reference: x0, y0, x1, ... (scene/configuration.h).
  Pins(const Scene& scene, const NodeNumbers& numbers, const std::vector<double>& reference);

  std::size_t Count() const { return pins_.size(); }
  // Whether it gives way to its force, as one that is in a loop.
  bool Gives(std::size_t pin) const { return pins_[pin].gives; }
  // From its second node to the first one, less what rounding has left of that where they are written.
  Vector Apart(std::size_t pin, const std::vector<double>& positions) const;
  // Takes the forces of the pins from those on the nodes. on_first: x, y of each on its first node.
  void TakeForces(const std::vector<double>& on_first, std::vector<Real>* forces) const;

 private:
  struct Pinned {
    std::size_t first, second;  // nodes
    Vector written;
    bool gives;
  };

  std::vector<Pinned> pins_;
};

}  // namespace contact_path::check

#endif  // CONTACT_PATH_SRC_CHECK_PINS_H_
