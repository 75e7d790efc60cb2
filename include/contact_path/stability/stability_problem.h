// Whether an equilibrium with contacts and friction, at rest, is stable.
#ifndef CONTACT_PATH_STABILITY_STABILITY_PROBLEM_H_
#define CONTACT_PATH_STABILITY_STABILITY_PROBLEM_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "contact_path/contact/contact_pair.h"
#include "contact_path/contact/path_point.h"
#include "contact_path/equations/fixed_state_system.h"
#include "contact_path/linear/bordered_solver.h"
#include "contact_path/linear/symmetric_factors.h"
#include "contact_path/stability/verdict.h"
#include "contact_path/structure/structure.h"

namespace contact_path {

// Of one equilibrium under one machine. Vectors: unknowns u of the structure.
struct Stability {
  Verdict verdict = Verdict::kNotProved;
  int directions = -1;        // in which a disturbance grows; -1 = not known
  Eigen::VectorXd direction;  // one of them, of unit norm; empty = none is known
};

// A disturbance grows by divergence if for some growth rate a >= 0 there are motions v and changes rho of the reactions
// other than 0 with
//   (a^2 M + a C + K) v = N rho_n + T rho_t
// K: tangent at fixed load factor, contacts' curvature included (Martins, Barbarin, Raous & Pinto da Costa 1999).
//   inside the cone (D): v_n = v_t = 0; without friction: v_n = 0
//   at the edge of the cone, sliding or about to with the sense sigma (S):
//     v_n = 0, 0 <= z = sigma v_t, 0 <= w = sigma rho_t + mu rho_n, z w = 0
// M and C: of nodes, equal in both directions of a node. With K condensed onto the slips z, w = H z.
//
// Unstable, whatever M and C are: the degree of this problem at a = 0 is not 1, its degree for large a. The degree is
// (-1)^n0 times that of H, n0: negative eigenvalues of K where S sticks. Without S also where n0 is even, and not 0,
// and with one contact in S where n0 is not 0: one of the senses of a mode keeps w >= 0. Stable, whatever masses and
// drags the nodes of the contacts S have, if all other nodes follow at once: sym H is strictly copositive, since z .
// (a^2 M + a C + H) z = 0 for a growing motion, and n0 is 0. Masses of other nodes may let contacts go that H holds.
class StabilityProblem {
 public:
  // Both must outlive the problem.
  StabilityProblem(const Structure& structure, const ContactPairs& contacts);

  // Looks at an equilibrium inside an arc, or at an end of it with the states of the arc: contacts that slip are S, all
  // others that stick are D. null_directions: of the tangent, columns du, where the equations are known to be
  // singular; else none.
  void Set(const PathPoint& point, const Eigen::MatrixXd& null_directions);

  // Under s = (Q - f . u) / compliance, f the reference load, for Q at rest: infinite = dead loads, 0 = displacement
  // control. Without reference loads the machine is rigid already: as with dead loads.
  Stability Under(double compliance) const;
  // Whether the tangent is symmetric at a point with these states: no contact slides, or sticks where it is curved.
  bool IsSymmetric(const PathPoint& point) const;
  // Whether contacts are at the edge of their cones.
  bool HasSlips() const { return !slips_.empty(); }

 private:
  struct Slip {
    std::size_t contact;
    double sense;  // sigma
    double friction;
    Eigen::Index normal, tangent;  // unknowns of its reactions among those of the saddle
  };

  void Classify(const PathPoint& point);
  void BuildSaddle(const Eigen::SparseMatrix<double>& transposed);
  bool Condense(const Eigen::SparseMatrix<double>& transposed);
  // A motion without slip whose energy falls, among the softest ones, by inverse iterations of a subspace; empty: none
  // is found.
  Eigen::VectorXd FallingMode() const;
  // The sense in which the slips of the null direction are those of the contacts; 0: in none.
  double PossibleSense() const;
  Eigen::VectorXd Normalised(const Eigen::VectorXd& du) const;

  const Structure& structure_;
  const ContactPairs& contacts_;
  FixedStateSystem system_;
  SymmetricFactors factors_;
  BorderedSolver unsymmetric_;

  std::vector<Slip> slips_;
  bool covered_ = true;                                      // by the theory: no contact with the total law of friction
  bool regular_ = false;                                     // the saddle is
  bool singular_ = false;                                    // the point is known to be
  bool symmetric_ = true;                                    // K is
  Eigen::SparseMatrix<double> saddle_, stiffness_, forces_;  // symmetric K and columns of reactions
  Eigen::Index negative_ = 0;      // n0; where the point is singular, besides its null direction
  int sign_ = 1;                   // of det K where S sticks
  double load_compliance_ = 0.0;   // f . by_load_
  double stiff_compliance_ = 0.0;  // the same if only components that are loaded moved, one at a time
  Eigen::VectorXd by_load_;        // du by a unit of s
  Eigen::MatrixXd motions_;        // by unit slips, columns
  Eigen::MatrixXd H_;
  double stiffest_slip_ = 0.0;     // largest term of an entry of H, whose terms may cancel
  Eigen::VectorXd w_of_load_;      // of by_load_
  Eigen::VectorXd load_of_slips_;  // f . motions
  Eigen::MatrixXd null_;           // columns du; none where the equations are not known to be singular
};

}  // namespace contact_path

#endif  // CONTACT_PATH_STABILITY_STABILITY_PROBLEM_H_
