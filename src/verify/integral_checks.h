// What must hold between the recorded states of an arc: arc length, work, dissipation, and the balance of energies.
#ifndef CONTACT_PATH_SRC_VERIFY_INTEGRAL_CHECKS_H_
#define CONTACT_PATH_SRC_VERIFY_INTEGRAL_CHECKS_H_

#include <array>
#include <cstddef>
#include <vector>

#include "contact_path/check/residuals.h"
#include "contact_path/path/increment.h"
#include "contact_path/verify/verify_path.h"
#include "verify/findings.h"
#include "verify/three_points.h"
#include "verify/verified_stage.h"

namespace contact_path {

// Integrals are computed anew by the quadratics through three states: begin and end of the increment, and its inner
// state, or else the state before or after on the same arc. Their errors are bounded by what the quadratics add to the
// trapezoids: see kShare.
class IntegralChecks {
 public:
  // All must outlive the checks.
  IntegralChecks(const VerifiedStage& stage, Findings* findings, Verification* result)
      : stage_(stage), findings_(*findings), result_(*result) {}

  // From `before` to `increment`, both with states. earlier, after: the increments with states before and after these
  // two; null: there is none. next: `increment` is the one after `before`, with none without a state in between.
  void Check(const Increment* earlier, const Increment& before, const Increment& increment, const Increment* after,
             bool next);
  // Over F L, of the increments from the start of the stage on.
  void CheckEnergy(const Increment& start, const Increment& increment);

 private:
  using ThreeStates = std::array<CheckedState, 3>;

  // From one increment to the other: arc length, and energies over F L.
  struct Recorded {
    Recorded(const Increment& before, const Increment& increment, const VerifiedStage& stage);
    double arc, work, dissipation, stored;
    double rounding;  // of forces and motions
  };
  struct Integrals {
    double t = 0.0;  // the place of the third state
    Integral arc, work, dissipation;
  };

  // Whether one smooth arc leads from `before` through `at` to `after`.
  bool GoesOn(const Increment& before, const Increment& at, const Increment& after) const;
  void Compare(const Recorded& recorded, const Integrals& anew, const Increment& increment, double rounding_of_arc);
  Integrals Integrate(const ThreeStates& states, const Increment& increment) const;
  Integral Work(const ThreeStates& states, const ThreePoints& rule) const;
  Integral Dissipation(const ThreeStates& states, const ThreePoints& rule, const Increment& increment) const;

  const VerifiedStage& stage_;
  Findings& findings_;
  Verification& result_;
  double open_ = 0.0;     // sum of what integrals of increments by Ipopt leave open, over F L
  double pressed_ = 0.0;  // largest work of reactions along gaps that are left, over F L
  bool balanced_ = true;  // so far
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_VERIFY_INTEGRAL_CHECKS_H_
