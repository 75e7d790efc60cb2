// What recorded increments must fulfil: each state by itself, what lies between the states of an arc, and verdicts of
// stability.
#ifndef CONTACT_PATH_SRC_VERIFY_CHECKS_H_
#define CONTACT_PATH_SRC_VERIFY_CHECKS_H_

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "contact_path/check/residuals.h"
#include "contact_path/path/increment.h"
#include "contact_path/verify/verify_path.h"
#include "verify/differences.h"
#include "verify/verified_stage.h"

namespace contact_path {

// Residuals, supports, gaps, contact states and recorded numbers of the increments of one stage.
class PointChecks {
 public:
  // All must outlive the checks.
  PointChecks(const VerifiedStage& stage, Findings* findings, Verification* result)
      : stage_(stage), findings_(*findings), result_(*result) {}

  // before: the last increment that has its state; null: there is none.
  void Check(const Increment* before, const Increment& increment);

 private:
  // What holds for inner states, too. in_one_piece: what happened since `before` is one arc of the path.
  void CheckState(const Increment& before, const Increment& at, bool in_one_piece, const Residuals& residuals);
  void CheckInner(const Increment& before, const Increment& increment);
  // Numbers of the increment that follow from its state. with_law: the residual of the friction law, too.
  void CheckRecorded(const Increment& increment, const Residuals& residuals, bool with_law);
  // Forces of supports and boundaries, and what elements and contacts bear.
  void CheckForces(const Increment& increment);
  void CheckSupports(const Increment& at);
  // Whether bars that bear in one sense alone are taut and slack as recorded.
  void CheckBars(const Increment& at, double tolerance);
  // Gap and state of a contact. slip: what the law of friction is about, over L. Tolerances: scaled.
  void CheckContact(std::size_t i, const ContactRecord& contact, const CheckedState& state, double slip,
                    double tolerance, double tolerance_of_slip);
  // Equilibrium across the surfaces and the laws of reactions where F is no measure of them.
  void CheckSoftContacts(const Increment& increment);
  // Where reactions are so small that residuals over F cannot tell: against what contacts have pushed with.
  void CheckPull(const Increment& at);

  const VerifiedStage& stage_;
  Findings& findings_;
  Verification& result_;
};

// Of a quantity: at the begin of the increment, at its end, and at a third state of the same arc.
using ThreeValues = std::array<double, 3>;

// A sum of integrals.
struct Integral {
  double value = 0.0;
  double open = 0.0;   // what the quadratics add to the trapezoids, or what the trapezoids leave open
  double force = 0.0;  // sum of the sizes of the forces

  void Add(const Integral& other) {
    value += other.value;
    open += other.open;
    force += other.force;
  }

  // Of two rules for one integral: the value of the first, and the larger error of both.
  void Take(const Integral& other, bool first) {
    const double larger = first ? other.open : std::max(open, other.open);
    if (first) *this = other;
    open = larger;
  }
};

// With a third state at the parameter t, which is 0 at the begin and 1 at the end; t = 0: there is none, and quantities
// are linear. With t = 1/2 the rule is Simpson's.
class ThreePoints {
 public:
  explicit ThreePoints(double t) : t_(t) {}

  double t() const { return t_; }
  bool HasThird() const { return t_ != 0.0; }

  // Of f dx. A quantity is f0 + (f1 - f0) t + F t (1 - t); what is open adds up the terms
  // with F, each by its size, for they may cancel.
  Integral Of(const ThreeValues& f, const ThreeValues& x) const {
    const double df = f[1] - f[0], dx = x[1] - x[0], bend_f = Bend(f), bend_x = Bend(x);
    const double mean = 0.5 * (f[0] + f[1]);
    if (!HasThird()) return {mean * dx, 0.5 * std::abs(df * dx)};
    return {mean * dx + (bend_f * dx - bend_x * df) / 6.0,
            (std::abs(bend_f * dx) + std::abs(bend_x * df) + std::abs(bend_f * bend_x)) / 6.0};
  }

 private:
  double Bend(const ThreeValues& f) const {
    return HasThird() ? (f[2] - f[0] - t_ * (f[1] - f[0])) / (t_ * (1.0 - t_)) : 0.0;
  }

  double t_;
};

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
  // The same over a jump: energies by what was released, and the work of the loads, which the machine prescribes. The
  // machine: of TraceOptions. before: null if the increment before has no state.
  void CheckJump(const Increment& last, const Increment* before, const Increment& landing, double machine_stiffness);
  // The setting of the machine of TraceOptions, which both increments have on record with their states.
  void CheckSetting(const Increment& before, const Increment& increment, double machine_stiffness);
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
  double released_ = 0.0;  // by jumps so far, over F L
  double open_ = 0.0;      // sum of what integrals of increments by Ipopt leave open, over F L
  double given_ = 0.0;     // what contacts that give way have stored at events, over F L
  double pressed_ = 0.0;   // largest work of reactions along gaps that are left, over F L
  bool balanced_ = true;   // so far
};

// Of regular increments of structures of up to 400 components: the verdict from the eigenvalues of the stiffness of the
// motions that contacts, pins and eyes leave, and from what slides.
class StabilityChecks {
 public:
  // All must outlive the checks.
  StabilityChecks(const VerifiedStage& stage, Findings* findings, Verification* result);

  void Check(const Increment& increment, double machine_stiffness);

 private:
  void CheckDirection(const Increment& increment, const DisturbedIncrement& found, const FreeMotions& dead);
  // The verdict under the machine, and the stiffness of the one that just holds.
  void CheckMachine(const Increment& increment, const DisturbedIncrement& found, const FreeMotions& dead,
                    double machine_stiffness);

  const VerifiedStage& stage_;
  Findings& findings_;
  Verification& result_;
  Differences differences_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_VERIFY_CHECKS_H_
