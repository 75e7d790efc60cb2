// The complementarity problem of the rates in forces, with springs that hold what nothing else does.
#ifndef CONTACT_PATH_SRC_BRANCH_RATES_BY_FORCES_H_
#define CONTACT_PATH_SRC_BRANCH_RATES_BY_FORCES_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cstddef>
#include <optional>
#include <vector>

#include "contact_path/branch/complementarity.h"
#include "contact_path/branch/held_by_springs.h"
#include "contact_path/branch/rate_pairs.h"

namespace contact_path {

// The variables are forces, and for a contact without a reaction (Stewart & Trinkle 1996)
//   0 <= lambda - sign v_t, 0 <= the force against this slip; 0 <= mu r_n - both of these, 0 <= lambda
// Where all laws touch without a reaction and the other forces have symmetric derivatives, the condensed matrix is
// copositive, and Lemke's method does not end on a ray but by rounding.
class RatesByForces {
 public:
  // pairs must exist.
  RatesByForces(const Structure& structure, const Laws& laws, const PathPoint& point, const Modes& modes,
                const std::vector<int>& weakly_active, const RatePairs& pairs);

  // For s' = load_sense and a share of the springs, > 0: states by law; nothing where none were found. near: a solution
  // for another share to start from, or empty, and this one.
  std::optional<States> Solve(double load_sense, double share, ComplementaritySolution* near) const;

 private:
  // A share of a column.
  struct Term {
    Eigen::Index column;
    double share;
  };

  bool NumberForces();
  void AddForces();
  void AddPairs();
  void AddMotion(Eigen::Index equation, Eigen::Index port, double factor);
  void Scale(double share, Eigen::SparseMatrix<double>* equations, Eigen::VectorXd* changes) const;

  HeldBySprings held_;
  const RatePairs& pairs_;
  std::vector<Eigen::Index> slip_of_;     // by pair: among the slips of ports that may move both ways; -1: none
  std::vector<std::vector<Term>> force_;  // by port
  Eigen::Index num_held_ = 0, num_slips_ = 0;
  // Without those of the structure. Columns: its unknowns but s, forces of held ports, w, z; s comes last.
  std::vector<Eigen::Triplet<double>> entries_;
  bool exists_ = false;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_BRANCH_RATES_BY_FORCES_H_
