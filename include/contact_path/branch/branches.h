// The branches from a point of the path: every combination of states of the laws whose one-sided rates are admissible.
#ifndef CONTACT_PATH_BRANCH_BRANCHES_H_
#define CONTACT_PATH_BRANCH_BRANCHES_H_

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "contact_path/branch/path_parameter.h"
#include "contact_path/equations/fixed_mode_system.h"
#include "contact_path/law/active_set_tolerance.h"
#include "contact_path/law/laws.h"
#include "contact_path/structure/structure.h"

namespace contact_path {

// Scaled quantities and rates by arc length |(du, ds)|.
struct Branch {
  Modes modes;                // by law, on the arc that starts here
  Eigen::VectorXd direction;  // (du, ds), unit vector, NumDofs() + 1
  Eigen::VectorXd first;      // all unknowns of the fixed-mode system: derivatives by arc length
  Eigen::VectorXd second;
  double load_rate = 0.0;         // ds
  double parameter_rate = 0.0;    // PathParameter::Rate()
  int sense = 0;                  // PathParameter::Sense()
  double dissipation_rate = 0.0;  // -r_t . du_t, >= 0
  double turn = 0.0;              // angle to the direction of arrival [rad]
  double reaction_rate = 0.0;     // norm of the rates of all reactions, each in its force unit
  bool other_reactions = false;   // the same motion has other reactions, too; these are the least ones found
  double deviation = 0.0;         // the smaller of turn and the angle to Arrival::before [rad]
  bool mechanism = false;         // one of several motions without any change of load and reactions: not to be followed
  // The whole structure, or a part of it that is at a limit point of its own, stands still while load and reactions go
  // on.
  bool rests = false;
  bool singular = false;           // such a part makes the equations singular all along the arc
  bool has_mirror = false;         // another branch has exactly these rates: each would break a symmetry of the scene
  std::optional<PathPoint> begin;  // where the reactions have to change first while nothing moves: with the new ones
};

// Where the point comes from.
struct Arrival {
  Eigen::VectorXd direction;  // (du, ds), unit vector; for a start: the load, whatever the machine is
  bool is_start = false;      // then the path parameter must go on, and there is no branch of arrival
  bool singular = false;      // another path crosses here: nearly singular counts as singular
  // After an arc that rests: the direction in which the path moved before that arc. To go on so is no turn either.
  std::optional<Eigen::VectorXd> before;
  PathParameter parameter;
  bool forward = false;  // branches on which the parameter goes on come first, then those on which it rests
  // What fails at once on the branch that was taken here, which has the states of the point: though its rate is within
  // the tolerance, that branch does not lead on.
  std::optional<Limit> failed;
};

// Why a list of branches has all branches. Of two lists together: the smaller one.
enum class Completeness {
  kNone,             // it may not have: too many combinations of states to try them all, the likely ones were
  kAllCombinations,  // all combinations of states were tried
  kOnlySolution,     // the rates have one solution for each sense of the load (rate_complementarity.h)
};

// "", "only_solution", "all_combinations".
std::string_view ToString(Completeness completeness);

struct BranchSet {
  std::vector<Branch> branches;  // best first (branch_order.h)
  int weakly_active = 0;         // laws that could change their state
  Completeness complete_by = Completeness::kAllCombinations;
  bool cancelled = false;  // before the end: nothing else counts
  int combinations = 0;    // tried
  int rigid_modes = 0;     // most motions found that change neither load nor reactions where nothing else moves
};

// All branches from `point`, an equilibrium, without the branch of arrival. Weakly active are all laws that slide, and
// each law with a limit that is zero to `tolerance`. Of branches with equal directions one is kept: the branch in which
// fewest laws slide without moving. Where all branches turn by 90 degrees or more, or, with
// Arrival::forward, on none the path parameter goes on, forces may have to change while nothing moves, as where a
// block that is carried along meets a stop. Then branches are added for all other reactions that the point can have
// (force_redistribution.h). The complementarity problem of the rates (rate_complementarity.h) tells the branches
// where its solutions are the only ones, and where there are more than 4^6 combinations of states, then also in forces
// and without condensing (rates_by_forces.h); up to 4^6 combinations are all tried otherwise, and where the solution
// for a sense of the load neither leads on nor is the branch of arrival. Where there are more of them, and those
// problems do not exist or leave a sense open, principal pivoting on the rates (rate_problem.h) selects combinations
// from several first guesses; if there is no branch then, up to 4^8 are all tried. All are tried alike. cancelled:
// asked often; may be empty.
BranchSet FindBranches(const Structure& structure, const Laws& laws, const PathPoint& point, const Arrival& arrival,
                       const ActiveSetTolerance& tolerance, const std::function<bool()>& cancelled = nullptr);

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_BRANCHES_H_
