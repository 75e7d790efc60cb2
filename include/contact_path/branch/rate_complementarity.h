// The rates at an event as one linear complementarity problem, of the size of the laws that may change their states.
#ifndef CONTACT_PATH_BRANCH_RATE_COMPLEMENTARITY_H_
#define CONTACT_PATH_BRANCH_RATE_COMPLEMENTARITY_H_

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "contact_path/branch/rate_pairs.h"
#include "contact_path/branch/rate_problem.h"

namespace contact_path {

// For a rate s' = +-1 of the load, rates by the load and not by arc length, of the pairs of the weakly active laws.
// Stiffnesses or compliances that connect motions and forces come from the condensed rate problem. As a rule the
// motions are given and the forces follow; where motions depend on each other, as of a node between two walls, some
// forces are given.
class RateComplementarity {
 public:
  // The pairs must exist and outlive the problem; the rates must be regular.
  RateComplementarity(const RatePairs& pairs, const RateProblem& rates);

  // False: the problem is singular.
  bool exists() const { return exists_; }
  // Whether the solution for each s' is the only one: no port has two pairs, and the symmetric part of the matrix is
  // positive definite. No motion without load exists then.
  bool unique() const { return unique_; }

  // For s' = load_sense: states by law, of those that are not weakly active the first option. Where the solution is not
  // unique, those that were found; there may be more.
  std::vector<States> Solve(double load_sense) const;

 private:
  // Of motions v = A (r + v) + b s': which of them are given, and the forces follow; nothing: singular.
  std::optional<std::vector<bool>> GivenMotions(const Eigen::MatrixXd& A) const;

  const RatePairs& pairs_;
  std::vector<bool> motion_is_second_;  // by pair: z; otherwise w is
  Eigen::VectorXd compliance_;          // by port, times the stiffness of its spring
  Eigen::MatrixXd matrix_;              // scaled so that its diagonal is of the order of 1
  Eigen::VectorXd load_;                // of s' = 1
  bool exists_ = false;
  bool unique_ = false;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_RATE_COMPLEMENTARITY_H_
