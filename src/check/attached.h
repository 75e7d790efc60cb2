// Nodes that move with rigid bodies as the check sees them: written from their definition, apart from structure/.
#ifndef CONTACT_PATH_SRC_CHECK_ATTACHED_H_
#define CONTACT_PATH_SRC_CHECK_ATTACHED_H_

#include <cstddef>
#include <vector>

#include "check/elements.h"
#include "check/plane.h"
#include "contact_path/check/residuals.h"
#include "contact_path/scene/scene.h"

namespace contact_path::check {

class AttachedNodes {
 public:
  // scene: expanded.
  AttachedNodes(const Scene& scene, const NodeNumbers& numbers);

  // The state with each of these nodes where its body has it.
  CheckedState Settled(CheckedState state) const;
  // Takes the forces on these nodes to their bodies. values and forces: as ValuesOf() orders them.
  void GiveToBodies(const std::vector<double>& values, std::vector<Real>* forces) const;
  // By node of the scene, numbers >= 0: a body has those of its nodes besides its own, and its nodes have what it has.
  template <typename Number>
  void Share(std::vector<Number>* of_nodes) const {
    for (const Node& at : nodes_) (*of_nodes)[at.body] += (*of_nodes)[at.node];
    for (const Node& at : nodes_) (*of_nodes)[at.node] = (*of_nodes)[at.body];
  }

 private:
  struct Node {
    std::size_t node, body;
    Vector arm;          // from the body at the start
    bool turns = false;  // a beam turns it
  };

  std::vector<Node> nodes_;
  std::size_t num_positions_;
};

}  // namespace contact_path::check

#endif  // CONTACT_PATH_SRC_CHECK_ATTACHED_H_
