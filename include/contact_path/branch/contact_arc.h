// The arcs of a structure in contact.
#ifndef CONTACT_PATH_BRANCH_CONTACT_ARC_H_
#define CONTACT_PATH_BRANCH_CONTACT_ARC_H_

#include <vector>

#include "contact_path/branch/smooth_arc.h"
#include "contact_path/equations/fixed_state_system.h"

namespace contact_path {

// An arc of the fixed-state equations, and these.
class ContactArc : public SmoothArc {
 public:
  // Both must outlive the arc.
  ContactArc(const Structure& structure, const ContactPairs& contacts)
      : SmoothArc(&system_), system_(structure, contacts) {}

  // Fixes the states; stick and slip are measured from the tangential positions at `from`. rests: see Begin().
  void SetStates(const std::vector<ContactState>& states, const PathPoint& from, bool rests = false) {
    system_.SetStatesFrom(from, states);
    Begin(rests);
  }
  const FixedStateSystem& system() const { return system_; }

 private:
  FixedStateSystem system_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_CONTACT_ARC_H_
