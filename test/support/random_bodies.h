// Two small random bodies that are pressed on each other and dragged, for studies of many scenes.
#ifndef CONTACT_PATH_TEST_SUPPORT_RANDOM_BODIES_H_
#define CONTACT_PATH_TEST_SUPPORT_RANDOM_BODIES_H_

#include <string>

#include "contact_path/scene/scene.h"
#include "support/decisions.h"

namespace contact_path {

// The same request for the same seed on every system. The lower body is a block of 3 or 4 by 1 or 2 quadrilaterals with
// its lower edge held, or an arch of 4 to 7 segments of a beam, clamped at both ends; the upper body a block of 2 by 1
// or 2 quadrilaterals, or a hanging arch of 4 to 6 segments. Nodes of blocks are shifted at random. The lower nodes of
// the upper body are candidates against the surface of the lower one, in some scenes the nodes of the lower body
// against the upper one, too; friction is 0 or 0.1 to 1. A program presses the upper body down, drags it aside, and, in
// some scenes, lifts it, by the motion of its upper edge; that of some blocks hangs on springs and is loaded instead.
TraceRequest RandomBodies(unsigned seed);
// The same from any source of decisions.
TraceRequest RandomBodies(Decisions* decisions, const std::string& name);

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SUPPORT_RANDOM_BODIES_H_
