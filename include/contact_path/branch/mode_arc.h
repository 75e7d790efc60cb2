// The arcs of a structure with laws.
#ifndef CONTACT_PATH_BRANCH_MODE_ARC_H_
#define CONTACT_PATH_BRANCH_MODE_ARC_H_

#include "contact_path/branch/smooth_arc.h"
#include "contact_path/equations/fixed_mode_system.h"

namespace contact_path {

// An arc of the fixed-mode equations, and these.
class ModeArc : public SmoothArc {
 public:
  // Both must outlive the arc.
  ModeArc(const Structure& structure, const Laws& laws) : SmoothArc(&system_), system_(structure, laws) {}

  // Fixes the modes, those of `from`; motions are measured from those there. rests: see Begin().
  void SetModes(const PathPoint& from, bool rests = false) {
    system_.SetModesFrom(from);
    Begin(rests);
  }
  const FixedModeSystem& system() const { return system_; }

 private:
  FixedModeSystem system_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_MODE_ARC_H_
