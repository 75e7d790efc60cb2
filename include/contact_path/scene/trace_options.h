// The options of a trace as plain data. As scene.h: each struct is followed by the description of its fields.
#ifndef CONTACT_PATH_SCENE_TRACE_OPTIONS_H_
#define CONTACT_PATH_SCENE_TRACE_OPTIONS_H_

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "contact_path/scene/field.h"
#include "contact_path/scene/words.h"

namespace contact_path {

enum class Method {
  kBranch,  // piecewise smooth continuation with located events
  kMpec,    // Algorithm 3.2 of Kanno & Martins 2005
};
constexpr auto WordsOf(Method) { return WordList("branch", "mpec"); }

enum class Accuracy { kFast, kBalanced, kAccurate };
constexpr auto WordsOf(Accuracy) { return WordList("fast", "balanced", "accurate"); }
constexpr Accuracy DefaultOf(Accuracy) { return Accuracy::kBalanced; }

// From where on a contact that slides is said to have moved.
enum class FrictionLaw {
  kIncremental,  // Coulomb's law: the motion since the last increment
  kTotal,        // holonomic friction (deformation theory): the motion since the start of the program
};
constexpr auto WordsOf(FrictionLaw) { return WordList("incremental", "total"); }

// What a path does where the machine that loads the structure can go no further on a stable path.
enum class AtLimit {
  kFollow,  // goes on over the limit point, as an arc-length method does
  kStop,    // ends
  kJump,    // moves, over-damped, to the next stable equilibrium, and goes on from there
};
constexpr auto WordsOf(AtLimit) { return WordList("follow", "stop", "jump"); }

// Which branch a path takes at an event.
enum class BranchRule {
  kAutomatic,    // kForward in stages with a target and where supports or obstacles move, else kDissipation
  kForward,      // where the path parameter goes on: one on which it goes on, else one on which it rests
  kDissipation,  // the one that dissipates most
};
constexpr auto WordsOf(BranchRule) { return WordList("automatic", "forward", "dissipation"); }

// A flag that is true where it is left out. Words in files and messages, since a message has no such flag.
enum class DefaultTrue {
  kTrue,
  kFalse,
};
constexpr auto WordsOf(DefaultTrue) { return WordList("true", "false"); }

// Holds when `quantity` comes to `value` from the side that `when` does not name, or lies beyond.
struct StopCriterion {
  std::string quantity;  // "b.x", "b@floor.rn", "load_factor", ... (quantity.h)
  std::string when;      // ">" or "<"
  double value = 0.0;
  DefaultTrue exact =
      DefaultTrue::kTrue;  // the last increment is located at the value; false: the next increment beyond
};

template <typename P>
constexpr auto Fields(Of<StopCriterion>) {
  return std::tuple(Member("quantity", &P::quantity).Naming(TextKind::kQuantity), Member("when", &P::when),
                    Member("value", &P::value), Member("exact", &P::exact));
}

// Values of a quantity, each of which has an increment of its own wherever the path comes to it.
struct Samples {
  std::string quantity;        // as of StopCriterion
  std::vector<double> values;  // empty: `count` values at equal distances instead
  double from = 0.0;
  double to = 0.0;
  int count = 0;  // 0 with `values`; 1: `from` alone

  std::vector<double> Values() const {
    if (!values.empty()) return values;
    std::vector<double> between;
    between.reserve(static_cast<std::size_t>(std::max(count, 0)));
    for (int i = 0; i < count; ++i) between.push_back(count == 1 ? from : from + (to - from) * i / (count - 1));
    return between;
  }
};

template <typename P>
constexpr auto Fields(Of<Samples>) {
  return std::tuple(Member("quantity", &P::quantity).Naming(TextKind::kQuantity), Member("values", &P::values),
                    Member("from", &P::from), Member("to", &P::to),
                    Member("count", &P::count).Within(Range::kNotNegative));
}

// Takes another branch than the best one (method branch): at the n-th event, or at an increment, which then counts as
// an event.
struct BranchChoice {
  int event = 0;      // n, from 1; 0 = `increment` is meant
  int increment = 0;  // index of the increment, from 0; used where event = 0
  int branch = 0;     // number of the branch in the record of that event, from 1; 0 = 1, the best
};

template <typename P>
constexpr auto Fields(Of<BranchChoice>) {
  return std::tuple(Member("event", &P::event).Within(Range::kNotNegative),
                    Member("increment", &P::increment).Within(Range::kNotNegative).Formerly("row"),
                    Member("branch", &P::branch).Within(Range::kNotNegative).Formerly("way"));
}

struct TraceOptions {
  Method method = Method::kBranch;
  Accuracy accuracy = Accuracy::kBalanced;
  double direction = 0.0;  // sign of the first change of the load factor; 0 = +1
  double step = 0.0;       // target increment length in the scaled norm, >= 0; 0 = automatic (by accuracy)
  int max_increments = 0;  // of the whole path, >= 0; 0 = 1000 for each stage
  // Of messages and bags, not of the CSV: every n-th regular increment has positions and contacts, and all located
  // increments have; all further ones leave them empty. >= 0; 0 = 1, all of them.
  int full_state_every = 0;
  std::vector<StopCriterion> stop;
  std::vector<Samples> at;
  // Long lists that increments, bags and the CSV carry: "sections", of bars and beams; "stresses", of solids;
  // "pressures", of contacts. And "inner", a state inside each increment, which bags carry for verify.
  std::vector<std::string> record;
  BranchRule branch_rule = BranchRule::kAutomatic;
  std::vector<BranchChoice> branch_choices;
  FrictionLaw friction_law = FrictionLaw::kIncremental;
  DefaultTrue stability = DefaultTrue::kTrue;  // the verdict of stability of each increment is looked for
  AtLimit at_limit = AtLimit::kFollow;
  // K of the machine that loads the structure: with loads f it keeps s |f| = K (X - x), X growing, x = f . (u - u_0) /
  // |f|, u_0 where the stage begins. |f|: the norm of the forces, or of the moments where there are no forces. >= 0; 0
  // = dead loads, infinite = x is prescribed [force / length, or moment / rad].
  double machine_stiffness = 0.0;
  bool landing_checks = false;  // whether other motions land where a jump lands is looked for

  // Of the whole path. stages: of the program, 0 = there is none.
  std::size_t MaxIncrements(std::size_t stages) const {
    return max_increments == 0 ? 1000 * std::max<std::size_t>(stages, 1) : static_cast<std::size_t>(max_increments);
  }
  // The index that ends the path, of a stage whose first increment has the index `first`.
  int LastIncrement(int first) const { return max_increments == 0 ? first + 1000 : max_increments; }
  double Direction() const { return direction < 0.0 ? -1.0 : 1.0; }
  bool Records(std::string_view list) const { return std::find(record.begin(), record.end(), list) != record.end(); }
  // Whether BranchRule::kForward holds. driven: in a stage with a target, or where supports or obstacles move.
  bool DrivesForward(bool driven) const {
    return branch_rule == BranchRule::kForward || (branch_rule == BranchRule::kAutomatic && driven && LocatesEvents());
  }
  // Whether corners are located, each at the end of an increment, and on record as events.
  bool LocatesEvents() const { return method == Method::kBranch; }
};

template <typename P>
constexpr auto Fields(Of<TraceOptions>) {
  return std::tuple(Member("method", &P::method), Member("accuracy", &P::accuracy), Member("direction", &P::direction),
                    Member("step", &P::step).Within(Range::kNotNegative),
                    Member("max_increments", &P::max_increments).Within(Range::kNotNegative),
                    Member("full_state_every", &P::full_state_every).Within(Range::kNotNegative),
                    Member("stop", &P::stop), Member("at", &P::at), Member("record", &P::record),
                    Member("branch_rule", &P::branch_rule), Member("branch_choices", &P::branch_choices),
                    Member("friction_law", &P::friction_law), Member("stability", &P::stability),
                    Member("at_limit", &P::at_limit),
                    Member("machine_stiffness", &P::machine_stiffness).Within(Range::kNotNegativeOrInfinite),
                    Member("landing_checks", &P::landing_checks));
}

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_TRACE_OPTIONS_H_
