// The rates at an event, condensed to the laws that may change their modes.
#ifndef CONTACT_PATH_BRANCH_RATE_PROBLEM_H_
#define CONTACT_PATH_BRANCH_RATE_PROBLEM_H_

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "contact_path/branch/held_by_springs.h"
#include "contact_path/equations/fixed_mode_system.h"
#include "contact_path/law/active_set_tolerance.h"
#include "contact_path/law/laws.h"
#include "contact_path/structure/structure.h"

namespace contact_path {

// Rates by arc length |(du, ds)|, of one combination of states. By port of the weakly active laws, in their order.
struct CondensedRates {
  double load = 0.0;       // ds
  Eigen::VectorXd motion;  // d(motion)
  Eigen::VectorXd force;
};

// du = ds w + W p, w the displacement by the load and W those by unit forces of the ports of the weakly active laws,
// all other laws in their modes. Springs hold these ports while w and W are computed, so that a structure that only
// they support can be condensed, too; their forces are then part of p. One factorisation of the structure serves all
// combinations of states.
class RateProblem {
 public:
  // modes: by law; those of the weakly active ones tell their pieces alone. arrival: (du, ds). structure and laws must
  // outlive the problem.
  RateProblem(const Structure& structure, const Laws& laws, const PathPoint& point, const Modes& modes,
              const std::vector<int>& weakly_active, const Eigen::VectorXd& arrival);

  // False: the structure is singular even with the springs, and nothing below can be asked.
  bool regular() const { return regular_; }
  // Rates of the motions of the ports of the weakly active laws: rows, by ds, and by the force of each of these ports,
  // the force of its spring included, over the stiffness of the spring.
  const Eigen::MatrixXd& MotionRates() const { return motion_; }
  // By port: scaled stiffness of its spring.
  const Eigen::VectorXd& Springs() const { return springs_; }

  // The rates for these states of all laws, up to their sign. Nothing where they are not unique, and where parts can
  // move as rigid bodies: in rounding such rates may look unique.
  std::optional<CondensedRates> Rates(const States& states) const;

  // The first weakly active limit that these rates, times sign, break by more than `tolerance` of the largest rate of
  // its kind; all such limits in `all`, if it is not null. active: which limits are weakly active. Both tolerances
  // measure forces in the unit of the limit.
  std::optional<Limit> Broken(const States& states, const CondensedRates& rates, double sign,
                              const ActiveSetTolerance& active, double tolerance, std::vector<Limit>* all) const;

 private:
  const Law& LawOf(Eigen::Index port) const { return laws_[IndexOf(port)]; }
  std::size_t IndexOf(Eigen::Index port) const {
    return static_cast<std::size_t>(weakly_active_[ports_[static_cast<std::size_t>(port)].law]);
  }
  const PortRule& RuleOf(const States& states, Eigen::Index port) const {
    return LawOf(port).In(states[IndexOf(port)]).ports[ports_[static_cast<std::size_t>(port)].of_law];
  }
  Eigen::MatrixXd Equations(const States& states) const;
  // Whether a rigid motion of parts that only weakly active laws may hold is free in these states.
  bool LeavesRigidMotion(const States& states) const;

  const Laws& laws_;
  const PathPoint point_;
  std::vector<int> weakly_active_;
  std::vector<HeldBySprings::Port> ports_;
  bool regular_ = false;
  Eigen::VectorXd springs_;
  Eigen::MatrixXd motion_;  // MotionRates()
  Eigen::MatrixXd free_;    // the same by rigid motions of parts that nothing holds but these laws: columns
  Eigen::MatrixXd gram_;    // z . gram z = |(du, ds)|^2
  Eigen::VectorXd along_;   // along_ . z = (du, ds) . arrival
};

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_RATE_PROBLEM_H_
