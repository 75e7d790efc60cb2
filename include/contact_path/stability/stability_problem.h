// Whether an equilibrium with laws that slide, at rest, is stable.
#ifndef CONTACT_PATH_STABILITY_STABILITY_PROBLEM_H_
#define CONTACT_PATH_STABILITY_STABILITY_PROBLEM_H_

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <vector>

#include "contact_path/equations/fixed_mode_system.h"
#include "contact_path/law/laws.h"
#include "contact_path/stability/held_stiffness.h"
#include "contact_path/stability/verdict.h"
#include "contact_path/structure/structure.h"

namespace contact_path {

// Of one equilibrium under one machine. Vectors: unknowns u of the structure.
struct Stability {
  Verdict verdict = Verdict::kNotProved;
  int directions = -1;        // in which a disturbance grows; -1 = not known
  Eigen::VectorXd direction;  // one of them, of unit norm; empty = none is known
  bool artificial = false;    // not proved, and stable where artificial stiffness counts
};

// A disturbance grows by divergence if for some growth rate a >= 0 there are motions v and changes rho of the forces of
// the ports other than 0 with
//   (a^2 M + a C + K) v = N rho_n + T rho_t
// n, t: leading port and port that follows it. K: tangent at fixed load factor, curvature of laws included (Martins,
// Barbarin, Raous & Pinto da Costa 1999).
//   what is held (D): v = 0
//   sliding or about to with the sense sigma, at the edge of a cone mu (S):
//     v_n = 0, 0 <= z = sigma v_t, 0 <= w = sigma rho_t + mu rho_n, z w = 0
// M and C: of nodes, equal in both directions of a node. With K condensed onto the slips z, w = H z.
//
// Unstable, whatever M and C are: the degree of this problem at a = 0 is not 1, its degree for large a. The degree is
// (-1)^n0 times that of H, n0: negative eigenvalues of K where S is held. Without S also where n0 is even, and not 0,
// and with one port in S where n0 is not 0: one of the senses of a mode keeps w >= 0. Stable, whatever masses and
// drags the nodes of S have, if all other nodes follow at once: sym H is strictly copositive, since z .
// (a^2 M + a C + H) z = 0 for a growing motion, and n0 is 0. Masses of other nodes may let go what H holds. That is
// shown where it is so without what artificial elements add to H, and as much again.
//
// What touches without force may move apart: where it does not rub it is in S, v_n in place of z and rho_n in place of
// w. The equilibrium is stable if it is so with all of that idle. What rubs counts as idle, and a growing motion makes
// the equilibrium unstable if it moves all of that apart, or if one grows in the states of the arc as well.
class StabilityProblem {
 public:
  // Both must outlive the problem.
  StabilityProblem(const Structure& structure, const Laws& laws);

  // Looks at an equilibrium inside an arc, or at an end of it with the modes of the arc: ports that follow are S, all
  // that are held are D. null_directions: of the tangent, columns du, where the equations are known to be
  // singular; else none.
  // ahead: a point next to it on the arc that leaves; null: on all arcs, it is in question. What touches there is what
  // touches all along.
  void Set(const PathPoint& point, const Eigen::MatrixXd& null_directions, const PathPoint* ahead = nullptr);

  // Under s = (Q - f . u) / compliance, f the reference load, for Q at rest: infinite = dead loads, 0 = displacement
  // control. Without reference loads the machine is rigid already: as with dead loads.
  Stability Under(double compliance);
  // Whether the tangent is symmetric in these modes.
  bool IsSymmetric(const Modes& modes) const;
  // Whether something touches without force.
  bool TouchesWithoutForce(const PathPoint& point) const;
  // Whether something slides, or touches without force and may let go.
  bool HasSlips() const { return !slips_.empty(); }

 private:
  struct Slip {
    double sense;                     // sigma
    double ratio;                     // mu
    Eigen::Index leading, following;  // unknowns of the forces of its ports, without the load factor
  };

  // What touches without force: a law, its states where it is idle and where it bears, and whether a port follows in
  // another one.
  struct Touching {
    std::size_t number;
    int idle;
    Mode bears;
    bool rubs;
  };

  std::vector<Touching> TouchingAt(const PathPoint& point, const PathPoint& ahead) const;
  void Classify(Modes modes);
  Stability Decide(double compliance);
  // Where the equations are singular without it: the machine is one more law, which gives way.
  Stability HeldByMachine(double compliance);
  // Whether the direction, or where nothing slides its reverse, moves apart all that touches and rubs without force.
  bool Opens(Eigen::VectorXd* direction) const;
  bool Condense(const Eigen::VectorXd& u);
  // The sense in which the slips of the null direction are those of the contacts; 0: in none.
  double PossibleSense() const;

  const Structure& structure_;
  const Laws& laws_;
  FixedModeSystem system_;
  HeldStiffness held_;

  std::vector<Touching> touching_;
  bool releases_ = true;  // looks for them
  // The same problem with all of them idle, and the point then; the same with all of them in the states of the arc.
  std::unique_ptr<StabilityProblem> free_, as_is_;
  PathPoint point_;
  PathPoint held_point_;  // with S held, where the equations are singular

  std::vector<Slip> slips_;
  bool covered_ = true;            // by the theory: no holonomic law
  bool regular_ = false;           // the held stiffness is; n0 and the sign are of it
  bool singular_ = false;          // the point is known to be; n0 then is besides its null direction
  double load_compliance_ = 0.0;   // f . by_load_
  double stiff_compliance_ = 0.0;  // the same if only components that are loaded moved, one at a time
  Eigen::VectorXd by_load_;        // du by a unit of s
  Eigen::MatrixXd motions_;        // by unit slips, columns
  Eigen::MatrixXd H_;
  double stiffest_slip_ = 0.0;     // largest term of an entry of H, whose terms may cancel
  Eigen::VectorXd slip_rounding_;  // of the diagonal of H
  Eigen::VectorXd w_of_load_;      // of by_load_
  Eigen::VectorXd load_of_slips_;  // f . motions
  Eigen::MatrixXd artificial_;     // what artificial elements add to w_of_load_ and, behind it, H
  Eigen::MatrixXd null_;           // columns du; none where the equations are not known to be singular
};

}  // namespace contact_path

#endif  // CONTACT_PATH_STABILITY_STABILITY_PROBLEM_H_
