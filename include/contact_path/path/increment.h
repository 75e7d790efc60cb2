// One accepted increment of a path, as data, in the units of the scene.
//
// Each struct is followed by the description of the fields (scene/field.h) that a message has under the same name: the
// conversion from and to messages goes through it. A new field of increments is a member and its description here, and
// the field of the same name in the message.
#ifndef CONTACT_PATH_PATH_INCREMENT_H_
#define CONTACT_PATH_PATH_INCREMENT_H_

#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "contact_path/check/residuals.h"
#include "contact_path/contact/contact_state.h"
#include "contact_path/law/slack_bar.h"
#include "contact_path/response/contact_pressure.h"
#include "contact_path/response/element_response.h"
#include "contact_path/response/resultant.h"
#include "contact_path/scene/field.h"
#include "contact_path/scene/scene.h"
#include "contact_path/scene/words.h"
#include "contact_path/stability/verdict.h"

namespace contact_path {

enum class IncrementKind {
  kStart,         // increment 0, or the first of a stage: the same state as in the increment before, at load factor 0
  kRegular,       // none of the other kinds
  kSmoothLimit,   // the load factor turns on a smooth arc
  kCornerLimit,   // the load factor turns where a contact changes its state, or a crossing path is taken
  kContactEvent,  // a contact changes its state, or another branch is chosen, and the load factor does not turn
  kBifurcation,   // another equilibrium path crosses, and neither of the above
  kSample,        // a quantity has a value that the request asks for, and none of the above
  kOnset,         // the equilibrium ceases to be stable, and none of the above
  kJump,          // where a jump from the increment before has landed
};

constexpr auto WordsOf(IncrementKind) {
  return WordList("start", "regular", "smooth_limit", "corner_limit", "contact_event", "bifurcation", "sample", "onset",
                  "jump");
}

// Of an increment.
struct StabilityRecord {
  Verdict stability = Verdict::kNotAsked;             // under dead loads: the load factor keeps its value
  Verdict stability_controlled = Verdict::kNotAsked;  // under the machine; without one, their displacement does
  int unstable_directions = -1;                       // under dead loads; -1 = not known
  // Above this stiffness K of the machine (TraceOptions::machine_stiffness) the point is stable; 0 = also under dead
  // loads, infinite = under no machine, -1 = not known.
  double critical_stiffness = -1.0;
  // x0, y0, x1, ... of the direction of unit norm in which a disturbance grows under dead loads; empty = none is known.
  std::vector<double> unstable_direction;
};

template <typename P>
constexpr auto Fields(Of<StabilityRecord>) {
  return std::tuple(Member("stability", &P::stability), Member("stability_controlled", &P::stability_controlled),
                    Member("unstable_directions", &P::unstable_directions),
                    Member("critical_stiffness", &P::critical_stiffness),
                    Member("unstable_direction", &P::unstable_direction));
}

// Of an increment of kind jump: the motion from the increment before to this one, with drag alone.
struct JumpRecord {
  double energy_released = 0.0;  // what the loads did, less the strain energy gained and friction [force length], >= 0
  // With landing_checks, whether motions with drag in proportion to stiffness, and with inertia and light drag, land
  // there, too.
  bool landing_robust = false;
};

template <typename P>
constexpr auto Fields(Of<JumpRecord>) {
  return std::tuple(Member("energy_released", &P::energy_released), Member("landing_robust", &P::landing_robust));
}

// A contact candidate at the end of an increment.
struct ContactRecord {
  double gap = 0.0;                          // n . (x - p) [length]
  double rn = 0.0;                           // normal reaction on the node [force], >= 0
  double rt = 0.0;                           // tangential reaction along t = (n_y, -n_x) [force]
  ContactState state = ContactState::kOpen;  // on the arc of the path that ends in this increment
};

template <typename P>
constexpr auto Fields(Of<ContactRecord>) {
  return std::tuple(Member("gap", &P::gap), Member("rn", &P::rn), Member("rt", &P::rt), Member("state", &P::state));
}

// A state on the path.
struct PathState {
  double load_factor = 0.0;       // of the stage
  std::vector<double> positions;  // current x0, y0, x1, y1, ...: 2 x nodes, in scene order [length]
  // Since the start, by node; 0 for a node that no beam turns [rad]. Empty in a scene without beams.
  std::vector<double> rotations;
  std::vector<ContactRecord> contacts;  // in scene order
  std::vector<Resultant> pins;  // force on the first node by the second, moment of the spring on it; in scene order
};

// Inside an increment, on the arc that it follows. Empty lists: there is none.
using InnerState = PathState;

template <typename P>
constexpr auto Fields(Of<PathState>) {
  return std::tuple(Member("load_factor", &P::load_factor), Member("positions", &P::positions),
                    Member("rotations", &P::rotations), Member("contacts", &P::contacts), Member("pins", &P::pins));
}

// What it took to compute the increment. Counts are of the last problem solved for it; iterations and time are sums.
struct SolveRecord {
  Method method = Method::kMpec;
  double regularisation = 0.0;  // by Ipopt: eps reached, of products of scaled quantities; 0 = not used
  bool exact = false;           // true: active set fixed and Newton's method converged on the unregularised equations
  int iterations = 0;           // of Ipopt, or of Newton's method
  int variables = 0;            // of the problem solved
  int constraints = 0;          // of the problem solved
  int rejected = 0;             // increments tried and not accepted before this one
  int factorisations = 0;       // branch: of the Jacobian
  int nullity = 0;           // branch: null directions of the equations besides the tangent (rigid modes, redundancy)
  int determinant_sign = 0;  // branch: sign of det of the Jacobian bordered by the tangent; 0 = singular; changes where
                             // another path crosses
  double contraction = 0.0;  // branch: second Newton step over the first
  double next_step = 0.0;    // length with which the next increment is tried, scaled norm; 0 = there is none
  double gamma2_factor = 1.0;  // by Ipopt: factor on gamma_2 in the next increment (Algorithm 3.2, step 4)
  double time = 0.0;           // wall time [s]

  // Whether another path crosses right there. Nullity tells such a point from redundant contacts, which make the
  // equations singular all along an arc.
  bool AtSingularPoint() const { return method == Method::kBranch && determinant_sign == 0 && nullity == 0; }
};

// All fields except the time, which the message calls solve_time.
template <typename P>
constexpr auto Fields(Of<SolveRecord>) {
  return std::tuple(
      Member("method", &P::method), Member("regularisation", &P::regularisation), Member("exact", &P::exact),
      Member("iterations", &P::iterations), Member("variables", &P::variables), Member("constraints", &P::constraints),
      Member("rejected", &P::rejected), Member("factorisations", &P::factorisations), Member("nullity", &P::nullity),
      Member("determinant_sign", &P::determinant_sign), Member("contraction", &P::contraction),
      Member("next_step", &P::next_step), Member("gamma2_factor", &P::gamma2_factor));
}

// One branch from an event: states and rates, by arc length in the scaled norm.
struct BranchRecord {
  std::vector<ContactState> states;  // by candidate, in scene order
  double load_rate = 0.0;            // of the scaled load factor, -1..1
  double parameter_rate = 0.0;       // of the path parameter in its wanted sense, over its largest, -1..1
  double dissipation_rate = 0.0;     // scaled, >= 0; by the total law of friction 0
  double turn = 0.0;                 // angle to the direction of arrival [rad]
  std::vector<BarState> bars;        // of OneSidedBars() of the scene
};

template <typename P>
constexpr auto Fields(Of<BranchRecord>) {
  return std::tuple(Member("states", &P::states), Member("load_rate", &P::load_rate),
                    Member("parameter_rate", &P::parameter_rate), Member("dissipation_rate", &P::dissipation_rate),
                    Member("turn", &P::turn), Member("bars", &P::bars));
}

// What was found at an increment where branches part; empty elsewhere.
struct EventRecord {
  int number = 0;                      // of the event, from 1; 0 = not one that the method came upon
  std::vector<BranchRecord> branches;  // all admissible branches but the branch of arrival, best first
  int taken = 0;                       // number of the branch, from 1; 0 = none
  int weakly_active = 0;               // contacts and bars that could change their state
  bool complete = true;                // false: there may be more branches than these
  std::string
      complete_by;  // why there are no more: only_solution, all_combinations; empty where no branches are listed
  std::vector<double> null_vector;  // where another path crosses: x0, y0, x1, ... of its unit direction; else empty
};

template <typename P>
constexpr auto Fields(Of<EventRecord>) {
  return std::tuple(Member("number", &P::number), Member("branches", &P::branches), Member("taken", &P::taken),
                    Member("weakly_active", &P::weakly_active), Member("complete", &P::complete),
                    Member("complete_by", &P::complete_by), Member("null_vector", &P::null_vector));
}

// What a method found of the state at the end of an increment.
struct IncrementFindings {
  IncrementKind kind = IncrementKind::kRegular;
  double setting = 0.0;  // X of the machine (TraceOptions::machine_stiffness), 0 where the stage begins
  Residuals residuals;   // by check/, from the scene alone
  SolveRecord solve;
  EventRecord event;
  StabilityRecord stability;
  JumpRecord jump;
};

struct Increment : PathState, IncrementFindings {
  int index = 0;
  int stage = 0;                      // of the program, from 1; 0 = there is none
  double arc_length = 0.0;            // since increment 0, in the scaled norm
  std::vector<Resultant> supports;    // on the structure, by SupportedNodes() of the scene (scene/scene_index.h)
  std::vector<Resultant> boundaries;  // of all contacts with it, by TouchedBoundaries() of the scene
  // Where the request wants them, else empty: in the order of scene/scene_index.h.
  std::vector<SectionForces> sections;
  std::vector<SolidStress> stresses;
  std::vector<ContactPressure> pressures;  // in scene order
  std::vector<double> widths;              // of TouchedBoundaries() [length]
  InnerState inner;                        // at the middle of the step, where the request wants it and there is a step
  double dissipation = 0.0;                // since increment 0, by friction; total law: work against it [force length]
  double strain_energy = 0.0;              // now [force length]
  double external_work = 0.0;              // of all loads since increment 0 [force length]
  std::vector<BarState> bars;              // of OneSidedBars() of the scene, on the arc of the path that ends here
};

// All fields except positions, rotations, contacts, residuals, stability and jump: a message has them in another form,
// or leaves them out.
template <typename P>
constexpr auto Fields(Of<Increment>) {
  return std::tuple(Member("index", &P::index), Member("stage", &P::stage), Member("load_factor", &P::load_factor),
                    Member("setting", &P::setting), Member("arc_length", &P::arc_length), Member("kind", &P::kind),
                    Member("dissipation", &P::dissipation), Member("strain_energy", &P::strain_energy),
                    Member("external_work", &P::external_work), Member("supports", &P::supports),
                    Member("boundaries", &P::boundaries), Member("sections", &P::sections),
                    Member("stresses", &P::stresses), Member("pressures", &P::pressures), Member("widths", &P::widths),
                    Member("inner", &P::inner), Member("event", &P::event), Member("bars", &P::bars),
                    Member("pins", &P::pins));
}

// What check/ looks at.
CheckedState StateOf(const PathState& recorded);

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_INCREMENT_H_
