// The states that contacts can take on from a point of the path, and the patches on which they do so.
#ifndef CONTACT_PATH_BRANCH_STATE_OPTIONS_H_
#define CONTACT_PATH_BRANCH_STATE_OPTIONS_H_

#include "contact_path/branch/active_set_tolerance.h"
#include "contact_path/contact/contact_pair.h"
#include "contact_path/contact/contact_state.h"
#include "contact_path/contact/path_point.h"

namespace contact_path {

// The modes of the candidate: one mode if the contact is not weakly active. The state at `point` comes first, if it is
// among the modes. Where two patches meet, slip leads to the patch ahead, and contacts that stick or are open keep
// their patch. Frictionless contacts, and contacts that slip by the total law of friction, may take either patch.
// Nothing slides over the end of an open surface. By the total law, the place of the node tells whether the contact
// sticks, and to which side it has slipped.
ContactModes StateOptions(const ContactPair& contact, const PathPoint& point, std::size_t candidate,
                          const ActiveSetTolerance& tolerance);

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_STATE_OPTIONS_H_
