// Small random trusses with contacts, for studies of many scenes.
#ifndef CONTACT_PATH_TEST_SUPPORT_RANDOM_SCENE_H_
#define CONTACT_PATH_TEST_SUPPORT_RANDOM_SCENE_H_

#include <cstddef>
#include <string>

#include "contact_path/scene/scene.h"
#include "support/decisions.h"

namespace contact_path {

// The same request for the same seed on every system. 3 to 8 nodes, at least one of them pinned; the others joined by
// two or three bars of random stiffness and strain measure; 1 to 4 contacts, some of them touching at the start,
// against half planes in any orientation; friction 0 or 0.1 to 1.2; one or two loads, towards an obstacle as a rule; in
// some scenes constant loads, bars with prestress, nodes held along one axis, structures held by a contact alone,
// wedges (two obstacles for a node). No stop criteria, default options but for the direction.
TraceRequest RandomRequest(unsigned seed);
// The same from any source of decisions. most_nodes, most_contacts: other bounds.
TraceRequest RandomRequest(Decisions* decisions, const std::string& name, std::size_t most_nodes = 8,
                           std::size_t most_contacts = 4);

// Whether every node is either fixed or free: then the scene can be turned.
bool CanBeRotated(const Scene& scene);

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SUPPORT_RANDOM_SCENE_H_
