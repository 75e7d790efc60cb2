// The pairs of complementary rates at an event.
#ifndef CONTACT_PATH_BRANCH_RATE_PAIRS_H_
#define CONTACT_PATH_BRANCH_RATE_PAIRS_H_

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "contact_path/law/laws.h"

namespace contact_path {

// Each weakly active law has a base state, in which most of its ports are held, and limits of forces in it that are at
// zero. Each of these is the first of a pair, whose second is the motion of the state beyond:
//   0 <= w, 0 <= z, one of them zero; w = sum of weight * force over the ports, z = sign * motion of a port
// A contact at an edge of its cone, sliding or about to with sense sigma:
//     v_n = 0; w = mu r_n + sigma r_t, z = sigma v_t
// a contact that touches without a reaction: w = r_n, z = v_n, and v_t = z+ - z- with two pairs, mu r_n +- r_t and z+-
// (Klarbring 1990; primes of the rates are left out); r_t = 0 where mu is.
class RatePairs {
 public:
  // When it is decided whether the motion of a port is given.
  enum Turn { kHeld, kAlone, kWithOther, kFree };
  // Ports are those of the weakly active laws, in their order.
  struct Pair {
    std::size_t law;            // among the weakly active ones
    Eigen::Index port;          // of z
    double sign;                // of z, and the weight of the force of this port in w
    Eigen::Index other = -1;    // the port whose force has another weight in w; -1: none has
    double weight = 0.0;        // of that force
    int next = 0;               // state beyond
    bool first_of_two = false;  // the next pair is of the same port, the other way
  };

  // options: of each law; weakly_active: laws with several. Both must outlive the pairs.
  RatePairs(const Laws& laws, const std::vector<Modes>& options, const std::vector<int>& weakly_active);

  // False: some law is holonomic, or has no such pairs.
  bool exist() const { return exist_; }
  const std::vector<Pair>& pairs() const { return pairs_; }
  Turn TurnOf(Eigen::Index port) const { return turn_[static_cast<std::size_t>(port)]; }
  // By port, of those that are held in the base states.
  const Eigen::VectorXd& Compliances() const { return compliance_; }
  // Whether a port may move both ways.
  bool BothWays() const;

  // States by law where the laws of these pairs, ascending, are beyond; of laws that are not weakly active the first
  // option. Of several pairs of a law the first one counts.
  States StatesBeyond(const std::vector<bool>& beyond) const;

 private:
  bool Find(const Laws& laws);
  bool Add(const Law& law, std::size_t k, Eigen::Index first, const LimitRule& limit);

  const std::vector<Modes>& options_;
  const std::vector<int>& weakly_active_;
  std::vector<int> base_;  // state, by weakly active law
  std::vector<Pair> pairs_;
  std::vector<Turn> turn_;
  Eigen::VectorXd compliance_;
  bool exist_ = false;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_RATE_PAIRS_H_
