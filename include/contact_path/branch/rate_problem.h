// The rates at an event, condensed to the contacts that may change their states.
#ifndef CONTACT_PATH_BRANCH_RATE_PROBLEM_H_
#define CONTACT_PATH_BRANCH_RATE_PROBLEM_H_

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "contact_path/branch/active_set_tolerance.h"
#include "contact_path/contact/contact_pair.h"
#include "contact_path/contact/path_point.h"
#include "contact_path/equations/fixed_state_system.h"
#include "contact_path/structure/structure.h"

namespace contact_path {

// Rates by arc length |(du, ds)|, of one combination of states. By weakly_active contact, in their order.
struct CondensedRates {
  double load = 0.0;     // ds
  Eigen::VectorXd gap;   // du_n
  Eigen::VectorXd slip;  // du_t
  Eigen::VectorXd rn;
  Eigen::VectorXd rt;
};

// du = ds w + W p, w the displacement by the load and W those by unit reactions of the weakly_active contacts, all
// other contacts in their states. Springs hold the weakly_active contacts while w and W are computed, so that a
// structure that only they support can be condensed, too; their forces are then part of p. One factorisation of the
// structure serves all combinations of states.
class RateProblem {
 public:
  // states: by candidate; states of the weakly_active contacts (indices of candidates) do not matter. arrival: (du,
  // ds). structure and contacts must outlive the problem.
  RateProblem(const Structure& structure, const ContactPairs& contacts, const PathPoint& point,
              const std::vector<ContactState>& states, const std::vector<int>& weakly_active,
              const Eigen::VectorXd& arrival);

  // False: the structure is singular even with the springs, and nothing below can be asked.
  bool regular() const { return regular_; }
  // Rates of the gaps and of the slips of the weakly active contacts: rows, by ds, and by the normal and the tangential
  // force of each, the force of its springs included, which have the stiffness 1.
  const Eigen::MatrixXd& GapRates() const { return gap_; }
  const Eigen::MatrixXd& SlipRates() const { return slip_; }

  // The rates for these states of all candidates, up to their sign. Nothing where they are not unique, and where parts
  // can move as rigid bodies: in rounding such rates may look unique.
  std::optional<CondensedRates> Rates(const std::vector<ContactState>& states) const;

  // The first weakly active inequality that these rates, times sign, break by more than `tolerance` of the largest rate
  // of its kind; all such inequalities in `all`, if it is not null. active: which inequalities are weakly active. Both
  // tolerances measure reactions in the force unit of the contact, normal reactions in NormalForceUnit().
  std::optional<Constraint> Broken(const std::vector<ContactState>& states, const CondensedRates& rates, double sign,
                                   const ActiveSetTolerance& active, double tolerance,
                                   std::vector<Constraint>* all) const;

 private:
  double Unit(Eigen::Index k) const;  // force unit of a weakly active contact
  Eigen::MatrixXd Equations(const std::vector<ContactState>& states) const;
  // Whether a rigid motion of parts that only weakly active contacts may hold is free in these states.
  bool LeavesRigidMotion(const std::vector<ContactState>& states) const;

  const ContactPairs& contacts_;
  const PathPoint point_;
  std::vector<int> weakly_active_;
  bool regular_ = false;
  // Rows: weakly_active contacts; columns: ds, then the normal and tangential force of each weakly_active contact,
  // springs included.
  Eigen::MatrixXd gap_;
  Eigen::MatrixXd slip_;
  // The same by rigid motions of parts that nothing holds but weakly active contacts: columns.
  Eigen::MatrixXd gap_of_modes_, slip_of_modes_;
  Eigen::VectorXd slipped_;  // xi - xi_0 by the total law of friction, 0 by the incremental law
  Eigen::MatrixXd gram_;     // z . gram z = |(du, ds)|^2
  Eigen::VectorXd along_;    // along_ . z = (du, ds) . arrival
};

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_RATE_PROBLEM_H_
