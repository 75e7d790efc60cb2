// The rates at an event as one linear complementarity problem, of the size of the contacts that may change their
// states.
#ifndef CONTACT_PATH_BRANCH_RATE_COMPLEMENTARITY_H_
#define CONTACT_PATH_BRANCH_RATE_COMPLEMENTARITY_H_

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "contact_path/branch/rate_problem.h"
#include "contact_path/contact/contact_pair.h"
#include "contact_path/contact/contact_state.h"

namespace contact_path {

struct RateSolution {
  std::vector<ContactState> states;  // by candidate; of those that are not weakly active, the first option
  bool degenerate = false;           // rates that are zero hide some of the states: others have the same rates
};

// For a rate s' = +-1 of the load, rates by the load and not by arc length. Each weakly active contact has
//   at an edge of its cone, sliding or about to with sense sigma:
//     v_n = 0, 0 <= z, 0 <= mu r_n + sigma r_t, one of them zero; v_t = sigma z
//   touching without a reaction:
//     0 <= v_n, 0 <= r_n, one of them zero; v_t = z+ - z-;
//     0 <= z+, 0 <= mu r_n + r_t, one of them zero; 0 <= z-, 0 <= mu r_n - r_t, one of them zero
// (Klarbring 1990; primes of the rates are left out). Without friction r_t = 0. Stiffnesses or compliances that connect
// motions and reactions come from the condensed rate problem. As a rule the motions are given and the reactions follow;
// where motions depend on each other, as of a node between two walls, some reactions are given.
class RateComplementarity {
 public:
  // options: of each candidate; weakly_active: candidates with several, in the order of the rate problem.
  RateComplementarity(const ContactPairs& contacts, const RateProblem& rates, const std::vector<ContactModes>& options,
                      const std::vector<int>& weakly_active);

  // False: the law of friction is not the incremental one, or the problem is singular.
  bool exists() const { return exists_; }
  // Whether the solution for each s' is the only one: all weakly active contacts are at edges of their cones or without
  // friction, and the symmetric part of the matrix is positive definite. No motion without load exists then.
  bool unique() const { return unique_; }

  // For s' = load_sense. Where the solution is not unique, those that were found; there may be more.
  std::vector<RateSolution> Solve(double load_sense) const;

 private:
  enum class Role { kFrictionless, kRough, kEdgePlus, kEdgeMinus };
  // One of the pairs: the first variable as a function of all second ones.
  struct Pair {
    Eigen::Index contact;   // among the weakly active ones
    Inequality force;       // of r_n, mu r_n + r_t or mu r_n - r_t
    bool motion_is_second;  // v_n or z; otherwise the force is

    double Sense() const { return force == Inequality::kConeMinus ? -1.0 : 1.0; }
  };

  static bool AtEdge(Role role) { return role == Role::kEdgePlus || role == Role::kEdgeMinus; }
  bool FindRoles();
  void Build(const RateProblem& rates);
  // Of motions v = A (r + v) + b s': which of them are given, and the reactions follow; nothing: singular.
  std::optional<std::vector<bool>> GivenMotions(const Eigen::MatrixXd& A) const;

  const ContactPairs& contacts_;
  const std::vector<ContactModes>& options_;
  const std::vector<int>& weakly_active_;
  std::vector<Role> roles_;
  std::vector<Pair> pairs_;
  Eigen::MatrixXd matrix_;  // scaled so that its diagonal is of the order of 1
  Eigen::VectorXd load_;    // of s' = 1
  bool exists_ = false;
  bool unique_ = false;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_RATE_COMPLEMENTARITY_H_
