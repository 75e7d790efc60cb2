// What the search for branches tries one after the other.
#ifndef CONTACT_PATH_SRC_BRANCH_BRANCH_FINDER_H_
#define CONTACT_PATH_SRC_BRANCH_BRANCH_FINDER_H_

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "contact_path/branch/branches.h"
#include "contact_path/branch/rate_problem.h"
#include "contact_path/branch/redundant_laws.h"
#include "contact_path/branch/tangents.h"
#include "contact_path/equations/fixed_mode_system.h"

namespace contact_path {

// With these derivatives by arc length at the point; arrival: (du, ds), from which the turn is measured.
Branch BranchAlong(const Eigen::VectorXd& first, const Eigen::VectorXd& second, const Laws& laws, const Modes& modes,
                   const PathPoint& point, const PathParameter& parameter, const Eigen::VectorXd& arrival);

// Of the forces of a point, or of their rates, each in the force unit of its law.
double ForceNorm(const Laws& laws, const PathPoint& point);

// Tries combinations of the states that laws may take on from a point, and keeps the branches that lead on: along
// them no limit has a negative leading sign, that is the sign of the first of its rate, its second derivative, and
// its rate a little farther along that is known beyond its error.
class BranchFinder {
 public:
  using Options = std::vector<Modes>;  // of each law

  // All arguments must outlive it.
  BranchFinder(const Structure& structure, const Laws& laws, const PathPoint& point, const Options& options,
               const Arrival& arrival, const ActiveSetTolerance& tolerance, const std::function<bool()>& cancelled);

  // Adds the branches with these modes. Whether they settle this sense of the load: a direction in which the load
  // changes so leads on, or is the branch of arrival.
  bool Try(const Modes& modes, std::vector<Branch>* branches, double load_sense = 1.0);
  // Try() with these states, on the pieces onto which each direction leads.
  bool TryStates(const States& states, std::vector<Branch>* branches, double load_sense = 1.0);

  // Principal pivoting from these states to some that break no limit where the load changes in this sense: laws whose
  // limits are broken change their states, all at once. condensed: null, or the rate problem whose rates tell what is
  // broken. Nothing: there are no rates, or states come back.
  std::optional<States> PivotFrom(States states, double load_sense, const RateProblem* condensed);

  // Whether laws are redundant with these states, or their rates are broken in both directions by far more than
  // rounding, or the structure starts as a mechanism with them.
  bool Excluded(const States& states, const RateProblem& condensed) const;

  int rigid_modes() const { return rigid_modes_; }

  // Once true, stays so.
  bool Cancelled();

 private:
  Eigen::Index NumMotion() const { return system_.NumDofs() + 1; }

  // The system takes on these modes; *x: the point.
  Tangents TangentsOf(const Modes& modes, Eigen::VectorXd* x);
  // The modes with these states, each on the piece onto which the first tangent leads. sign: of the tangent, relative
  // to the direction of arrival. On other pieces the tangent may be another one: until modes come back.
  Modes OntoPieces(const States& states, double sign);

  // Whether the tangent k, or its opposite, is a branch.
  bool Admissible(const Tangents& tangents, std::size_t k, const Eigen::VectorXd& x, const Eigen::VectorXd& first);
  // In the order of the laws, at most so many, the limits with a negative leading sign along a curve.
  std::vector<Limit> Broken(const Eigen::VectorXd& x, const Eigen::VectorXd& first, const Eigen::VectorXd& second,
                            std::size_t most);
  // The same by the first tangent of these states, or by condensed rates.
  std::optional<std::vector<Limit>> BrokenOf(const States& states, double load_sense, const RateProblem* condensed);
  // Whether the load starts to change in the wanted sense, by more than `error`: a motion without load is a mechanism.
  // At a smooth limit point the load rests, and its curvature tells; where that is zero as well, as of a load across
  // straight bars, the rate a little farther along does.
  bool SetsOut(const Eigen::VectorXd& x, const Eigen::VectorXd& first, const Eigen::VectorXd& second, double error);

  // The tangent of the curve a little farther along; nothing where there is none. The error of the Taylor polynomial is
  // of a higher order than the change of a rate.
  struct Ahead {
    Eigen::VectorXd x, first;
  };
  std::optional<Ahead> LookAhead(const Eigen::VectorXd& x, const Eigen::VectorXd& first, const Eigen::VectorXd& second);

  bool IsReversed(const Eigen::VectorXd& first) const;
  // How many ports slide by name along the branch and do not move.
  int SlidingAtRest(const Branch& branch) const;
  // Of two branches with one direction of motion: whether the first is to be kept. Walls that hold a node have several
  // states that do; those with the least forces are kept, whatever the order of the laws, and whichever way the
  // tangents of the walls point.
  bool IsPlainer(const Branch& branch, const Branch& other) const;
  void Add(const Tangents& tangents, const Eigen::VectorXd& first, const Eigen::VectorXd& second,
           std::vector<Branch>* branches) const;

  const Laws& laws_;
  const PathPoint& point_;
  const Options& options_;
  const Arrival& arrival_;
  ActiveSetTolerance tolerance_;
  const std::function<bool()>& cancelled_;
  bool was_cancelled_ = false;
  RedundantLaws redundant_;
  FixedModeSystem system_;
  Eigen::VectorXd reference_;
  TangentSolvers solvers_;
  int rigid_modes_ = 0;  // most of all tangents that are rigid modes
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_BRANCH_BRANCH_FINDER_H_
