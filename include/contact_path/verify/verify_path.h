// Whether a recorded path is what it says it is: every number that can be computed anew from the scene, is; and whether
// it can have ended for the reason that its record gives.
#ifndef CONTACT_PATH_VERIFY_VERIFY_PATH_H_
#define CONTACT_PATH_VERIFY_VERIFY_PATH_H_

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "contact_path/check/residuals.h"
#include "contact_path/path/increment.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

// What is wrong with an increment.
struct Finding {
  int increment = 0;  // its place in the record, from 0
  std::string what;   // one line
};

struct Verification {
  std::vector<Finding> findings;  // none: the path is proved; in the order of the increments, at most kMostLines
  int increments = 0;
  int full_increments = 0;      // with positions and contacts: increments without them can only be counted
  int exact_increments = 0;     // of the full ones, those that solve the unregularised equations
  int proved_integrals = 0;     // full increments that move and have a third state on their arc, for the integrals
  int proved_verdicts = 0;      // increments whose stability was found anew by second differences
  int open_verdicts = 0;        // those that are recorded as stable or unstable, and were not looked at
  int open_integrals = 0;       // those that have none: chord and energy balance tell. Increments by Ipopt: neither
  Residuals exact;              // largest of the exact increments, computed anew
  Residuals regularised;        // of the other ones
  double energy_balance = 0.0;  // largest |work of the loads - change of strain energy - dissipation| / (F L)
  // What that is to be compared with: sum of |work of the loads|, and of what friction gives back by the total law, of
  // all increments / (F L).
  double work = 0.0;
  double largest_reaction = 0.0;       // normal, over F, or where parts are far softer, over the forces there
  std::map<IncrementKind, int> kinds;  // number of increments of each
};

// Request: valid. Increments: all that were recorded, in their order; regular increments that full_state_every leaves
// out have empty positions and contacts.
//
// Checked of each state, inner states included: fixed nodes are where they have to be; the residuals, computed from the
// scene alone, are within the tolerance of the method (1e-9, regularised 1e-5); gaps; the contact states against gaps,
// reactions and motions; of increments, residuals, strain energy, forces and lists as recorded. From increment to
// increment: arc length, work and dissipation against integrals through three states on one arc, to what the quadratics
// leave open (method.md), increments by Ipopt against trapezoids; the energy balance, to 1 % of the work done; states
// change only at events, the load factor turns at limit points and only there, and the branch taken at an event is the
// one that follows; stages follow each other at their targets, in the same state. Over a jump: the balance of energies
// with what was released, and the work of the loads under the machine, to 1e-9; no law of friction between its ends.
// Verdicts of stability of structures of up to 400 components (method.md). A contact that pulls with more than 0.02 of
// the largest reaction so far is a finding, however small both are. Where nothing of all that is found, events and
// signs are looked at (VerifyEvents()). Not checked: rates of branches that were not taken, landing_robust, counters
// and times.
//
// before_each: called before each increment is checked; what it throws leaves VerifyPath(). May be empty.
Verification VerifyPath(const TraceRequest& request, const std::vector<Increment>& increments,
                        const std::function<void()>& before_each = {});

// Whether the increment is at the target of its stage; false without a program.
bool AtTarget(const TraceRequest& request, const Increment& increment);

// Appends to *findings, in the order of the increments, which VerifyPath() must have found sound:
// - each increment is of the method that the request wants; mpec records no events;
// - events are numbered from 1 without a gap, and only increments that branch_choices names have branches without a
//   number;
// - branches stand in the order of their dissipation rates, with rates and angles that unit directions can have, and
//   leave open what is open; from a start, their load rates are the cosines of their angles;
// - the branch taken is the one that branch_choices wants, or the first, and its rates and its angle are those of the
//   increments before and after, to what an increment may turn;
// - the sign of the determinant changes on an arc at bifurcations alone, and there is one relation between it, the sign
//   of the stiffness and the sense of the load on all of an arc.
// stiffest: by stage, the force of the stiffest node for a motion of L, over F: the load is known to its rounding.
void VerifyEvents(const TraceRequest& request, const std::vector<Increment>& increments,
                  const std::vector<double>& stiffest, std::vector<Finding>* findings);

// What speaks against it, in a line; empty: nothing does. reason: "stop_criterion", ..., of a trace whose increments
// these are. Looked at: stop_criterion (one holds in the last increment, or the program is done), max_increments (their
// number), path_end (no branch is taken from the last increment, and mpec cannot tell that; or no contact is left, and
// the load is zero or beyond minus its target) and closed_path (an earlier increment of the stage has the state of the
// last one).
std::string EndContradicted(const TraceRequest& request, const std::vector<Increment>& increments,
                            std::string_view reason);

}  // namespace contact_path

#endif  // CONTACT_PATH_VERIFY_VERIFY_PATH_H_
