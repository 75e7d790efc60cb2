// The states that contacts can take on from a point of the path, and the patches on which they do so.
#ifndef CONTACT_PATH_BRANCH_STATE_OPTIONS_H_
#define CONTACT_PATH_BRANCH_STATE_OPTIONS_H_

#include "contact_path/branch/active_set_tolerance.h"
#include "contact_path/contact/contact_mode.h"
#include "contact_path/contact/contact_pair.h"
#include "contact_path/contact/path_point.h"

namespace contact_path {

// Of the candidate: one mode if the contact is not weakly active. The state that it has at `point` comes first, if it
// is among them. Where two patches meet, slip leads to the patch that lies ahead, a frictionless contact may go either
// way, as one that slips by the total law of friction may, and stick and open contacts keep their patch. Over the end
// of an open surface nothing slides. By the total law, where the node is tells whether it sticks, and to which side it
// has slipped.
ContactModes StateOptions(const ContactPair& contact, const PathPoint& point, std::size_t candidate,
                          const ActiveSetTolerance& tolerance);

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_STATE_OPTIONS_H_
