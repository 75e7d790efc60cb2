// The rates at an event as one linear complementarity problem, of the size of the laws that may change their states.
#ifndef CONTACT_PATH_BRANCH_RATE_COMPLEMENTARITY_H_
#define CONTACT_PATH_BRANCH_RATE_COMPLEMENTARITY_H_

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "contact_path/branch/rate_problem.h"
#include "contact_path/law/laws.h"

namespace contact_path {

// For a rate s' = +-1 of the load, rates by the load and not by arc length. Each weakly active law has a base state, in
// which most of its ports are held, and limits of forces in it that are at zero. Each of these is the first of a pair,
// whose second is the motion of the state beyond:
//   0 <= w, 0 <= z, one of them zero; w = sum of weight * force over the ports, z = sign * motion of a port
// A contact at an edge of its cone, sliding or about to with sense sigma:
//     v_n = 0; w = mu r_n + sigma r_t, z = sigma v_t
// a contact that touches without a reaction: w = r_n, z = v_n, and v_t = z+ - z- with two pairs, mu r_n +- r_t and z+-
// (Klarbring 1990; primes of the rates are left out); r_t = 0 where mu is. Stiffnesses or compliances that connect
// motions and forces come from the condensed rate problem. As a rule the motions are given and the forces follow; where
// motions depend on each other, as of a node between two walls, some forces are given.
class RateComplementarity {
 public:
  // options: of each law; weakly_active: laws with several, in the order of the rate problem.
  RateComplementarity(const Laws& laws, const RateProblem& rates, const std::vector<Modes>& options,
                      const std::vector<int>& weakly_active);

  // False: some law is holonomic, or has no such pairs, or the problem is singular.
  bool exists() const { return exists_; }
  // Whether the solution for each s' is the only one: no port has two pairs, and the symmetric part of the matrix is
  // positive definite. No motion without load exists then.
  bool unique() const { return unique_; }

  // For s' = load_sense: states by law, of those that are not weakly active the first option. Where the solution is not
  // unique, those that were found; there may be more.
  std::vector<States> Solve(double load_sense) const;
  // The same where a share of the springs of the rate problem, > 0, holds the ports. The variables are forces, and for
  // a contact without a reaction (Stewart & Trinkle 1996)
  //   0 <= lambda - sign v_t, 0 <= the force against this slip; 0 <= mu r_n - both of these, 0 <= lambda
  // Where all laws touch without a reaction and the other forces have symmetric derivatives, the matrix is copositive,
  // and Lemke's method does not end on a ray but by rounding.
  std::vector<States> SolveByForces(double load_sense, double share) const;

 private:
  // When it is decided whether the motion of a port is given.
  enum Turn { kHeld, kAlone, kWithOther, kFree };
  // One of the pairs: the first variable as a function of all second ones. Directions are ports of the rate problem.
  struct Pair {
    std::size_t law;                // among the weakly active ones
    Eigen::Index port;              // of z
    double sign;                    // of z, and the weight of the force of this port in w
    Eigen::Index other = -1;        // the port whose force has another weight in w; -1: none has
    double weight = 0.0;            // of that force
    int next = 0;                   // state beyond
    bool motion_is_second = false;  // z; otherwise w is
    bool first_of_two = false;      // the next pair is of the same port, the other way
  };

  bool FindPairs(const RateProblem& rates);
  void Build(const RateProblem& rates);
  // Of motions v = A (r + v) + b s': which of them are given, and the forces follow; nothing: singular.
  std::optional<std::vector<bool>> GivenMotions(const Eigen::MatrixXd& A) const;

  // Of the weakly active laws the base states.
  States AtBase() const;

  const Laws& laws_;
  const RateProblem& rates_;
  const std::vector<Modes>& options_;
  const std::vector<int>& weakly_active_;
  std::vector<int> base_;  // state, by weakly active law
  std::vector<Pair> pairs_;
  std::vector<int> turn_;       // by port: when it is decided whether its motion is given
  Eigen::VectorXd compliance_;  // by port, times the stiffness of its spring
  Eigen::MatrixXd matrix_;      // scaled so that its diagonal is of the order of 1
  Eigen::VectorXd load_;        // of s' = 1
  bool exists_ = false;
  bool unique_ = false;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_RATE_COMPLEMENTARITY_H_
