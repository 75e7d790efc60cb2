// What method branch is asked for.
#ifndef CONTACT_PATH_PATH_BRANCH_OPTIONS_H_
#define CONTACT_PATH_PATH_BRANCH_OPTIONS_H_

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "contact_path/branch/arc_target.h"
#include "contact_path/branch/trial_step.h"
#include "contact_path/equations/fixed_mode_system.h"
#include "contact_path/path/return_detector.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

// All lengths in the scaled norm.
struct BranchOptions {
  double step = 0.02;             // longest increment, > 0
  double smallest_step = 1e-9;    // below this the path ends, > 0
  double prediction = 1e-3;       // largest error of the predictor, relative to the increment
  double smallest_cosine = 0.98;  // between the tangents at both ends of an increment
  double direction = 1.0;         // sign in which the path parameter is wanted to go
  std::vector<BranchChoice> choices;
  TrialObserver on_trial = {};
  bool inner = false;      // increments are to have a state at the middle of their steps
  bool stability = false;  // increments are to have verdicts of stability
  AtLimit at_limit = AtLimit::kFollow;
  double machine_stiffness = 0.0;          // of TraceOptions
  bool landing_checks = false;             // of TraceOptions
  bool forward = false;                    // BranchRule::kForward
  std::optional<double> load_factor = {};  // at which the path is to end
  // Quantities of the system whose values get increments of their own; empty: none.
  std::function<ArcTargets(const FixedModeSystem& system)> watch = {};
  int increments = 0;                 // given before this path, of which it goes on
  int events = 0;                     // passed before this path
  ReturnDetector* returns = nullptr;  // tells whether the path has come back to where it was; null: that is no end
  LargestReactionSoFar* largest_reaction = nullptr;  // of the trace that the path is a part of; null: of this path

  // growth: AutomaticStepGrowth() of the scene.
  static BranchOptions For(const TraceOptions& options, double growth);

  // The branch chosen for the increment, or else for the event (0 = none); null: no choice.
  const BranchChoice* ChoiceAt(int increment, int event) const;
  // Whether a branch is chosen for a later increment or event.
  bool HasChoiceAfter(int increment, int event) const;
};

// As messages name it: "event 3" or "increment 40".
std::string PlaceOf(const BranchChoice& choice);

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_BRANCH_OPTIONS_H_
