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
#include "contact_path/branch/redundant_contacts.h"
#include "contact_path/branch/tangents.h"
#include "contact_path/contact/contact_state.h"
#include "contact_path/equations/fixed_state_system.h"

namespace contact_path {

// Of the reactions of a point, or of their rates, each in its force unit.
double ReactionNorm(const ContactPairs& contacts, const PathPoint& point);

// The modes with these states: the first options of each candidate that have them.
ContactModes ModesWith(const std::vector<ContactState>& states, const std::vector<ContactModes>& options,
                       const PathPoint& point);

// Tries combinations of the states that contacts may take on from a point, and keeps the branches that lead on: along
// them no inequality has a negative leading sign, that is the sign of the first of its rate, its second derivative, and
// its rate a little farther along that is known beyond its error.
class BranchFinder {
 public:
  using States = std::vector<ContactState>;
  using Options = std::vector<ContactModes>;  // of each candidate

  // All arguments must outlive it.
  BranchFinder(const Structure& structure, const ContactPairs& contacts, const PathPoint& point, const Options& options,
               const Arrival& arrival, const ActiveSetTolerance& tolerance, const std::function<bool()>& cancelled);

  // Adds the branches with these modes. Whether they settle this sense of the load: a direction in which the load
  // changes so leads on, or is the branch of arrival.
  bool Try(const ContactModes& modes, std::vector<Branch>* branches, double load_sense = 1.0);
  // Try() with these states, on the patches onto which each direction leads.
  bool TryStates(const States& states, std::vector<Branch>* branches, double load_sense = 1.0);
  // TryStates() with the solution of the rates for this sense of the load, whose rates hide some of the states if it is
  // degenerate: then those, too, to which the leading signs lead from there.
  bool TrySolution(const States& states, bool degenerate, double load_sense, std::vector<Branch>* branches);

  // Principal pivoting from these states to some that break no inequality where the load changes in this sense:
  // contacts whose inequalities are broken change their states, all at once until states come back, from then on only
  // the first of them. condensed: null, or the rate problem whose rates tell what is broken. Nothing: there are no
  // rates, or no end.
  std::optional<States> PivotFrom(States states, double load_sense, const RateProblem* condensed);

  // Whether contacts are redundant with these states, or their rates are broken in both directions by far more than
  // rounding, or the structure starts as a mechanism with them.
  bool Excluded(const States& states, const RateProblem& condensed) const;

  // Where several contacts hold a node, others of their states may hold it with less: tries them, node by node.
  void TryOtherStatesAtNodes(std::vector<Branch>* branches);

  // Whether each combination of the options has contacts that are redundant.
  bool AllRedundant() const { return redundant_.AmongAll(options_); }

  int rigid_modes() const { return rigid_modes_; }

  // Once true, stays so.
  bool Cancelled();

 private:
  Eigen::Index NumMotion() const { return system_.NumDofs() + 1; }

  // The system takes on these modes; *x: the point.
  Tangents TangentsOf(const ContactModes& modes, Eigen::VectorXd* x);
  // The modes with these states, each on the patch onto which the first tangent leads. sign: of the tangent, relative
  // to the direction of arrival. On other patches the tangent may be another one: until modes come back.
  ContactModes OntoPatches(const States& states, double sign);

  // Whether the tangent k, or its opposite, is a branch.
  bool Admissible(const Tangents& tangents, std::size_t k, const Eigen::VectorXd& x, const Eigen::VectorXd& first);
  // In contact order, at most so many, the inequalities with a negative leading sign along a curve.
  std::vector<Constraint> Broken(const Eigen::VectorXd& x, const Eigen::VectorXd& first, const Eigen::VectorXd& second,
                                 std::size_t most);
  // The same by the first tangent of these states, or by condensed rates.
  std::optional<std::vector<Constraint>> BrokenOf(const States& states, double load_sense,
                                                  const RateProblem* condensed);
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
  // Whether a contact that stuck slides on a curve, however little, other than back: over a sharp one the load changes
  // far more than the node moves.
  bool SetsSliding(const Eigen::VectorXd& first) const;

  // Contacts that slip by name but do not move.
  int IdleSlips(const Branch& branch) const;
  // Of two branches with one direction of motion: whether the first is to be kept. Walls that hold a node have several
  // states that do; those with the least reactions are kept, whatever the order of the contacts, and whichever way the
  // tangents of the walls point.
  bool IsPlainer(const Branch& branch, const Branch& other) const;
  void Add(const Tangents& tangents, const Eigen::VectorXd& first, const Eigen::VectorXd& second,
           std::vector<Branch>* branches) const;

  const ContactPairs& contacts_;
  const PathPoint& point_;
  const Options& options_;
  const Arrival& arrival_;
  ActiveSetTolerance tolerance_;
  const std::function<bool()>& cancelled_;
  bool was_cancelled_ = false;
  RedundantContacts redundant_;
  FixedStateSystem system_;
  Eigen::VectorXd reference_;
  TangentSolvers solvers_;
  int rigid_modes_ = 0;  // most of all tangents that are rigid modes
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_BRANCH_BRANCH_FINDER_H_
