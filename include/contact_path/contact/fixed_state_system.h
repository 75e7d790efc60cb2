// The equations of equilibrium with the state of every contact fixed: a smooth system.
#ifndef CONTACT_PATH_CONTACT_FIXED_STATE_SYSTEM_H_
#define CONTACT_PATH_CONTACT_FIXED_STATE_SYSTEM_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <vector>

#include "contact_path/contact/contact_geometry.h"
#include "contact_path/contact/path_point.h"
#include "contact_path/structure/structure.h"

namespace contact_path {

// An inequality of the fixed states: what must stay >= 0 for the states to be right.
enum class Inequality {
  kGap,             // open: u_n
  kNormalReaction,  // touching: r_n
  kConePlus,        // stick: mu r_n + r_t (at zero, slip+ is next)
  kConeMinus,       // stick: mu r_n - r_t (at zero, slip- is next)
  kSlip,            // slip+-: +-(u_t - u_t,ref), the motion since the reference
};

struct Constraint {
  int contact = 0;
  Inequality inequality = Inequality::kGap;
};

// Unknowns x = (u, s, reactions of the touching contacts, reactions of the prescribed components): r_n, and r_t where
// sticking. Equations:
//   phi(u, s) - T r = 0                       NumDofs()                     (eq. 1)
//   u = start + rate s                        each prescribed component
//   u_n = 0                                   each touching contact         (eq. 2)
//   u_t = u_t,ref                             each sticking contact         (eq. 3)
// and one equation "inequality = 0" for each limit that is active, and s = value where the load factor is active. With
// nothing active there is one unknown more than equations: the solutions are a curve where the rank is full.
// Slip has r_t = -+mu r_n eliminated.
class FixedStateSystem {
 public:
  // Both must outlive the system.
  FixedStateSystem(const Structure& structure, const std::vector<ContactGeometry>& contacts);

  // states, tangential_reference (u_t,ref): by candidate.
  void SetStates(const std::vector<ContactState>& states, const Eigen::VectorXd& tangential_reference);
  void SetActive(const std::vector<Constraint>& limits);
  void FixLoadFactor(double value);
  void FreeLoadFactor();

  Eigen::Index NumUnknowns() const { return num_unknowns_; }
  Eigen::Index NumEquations() const { return num_equations_; }
  Eigen::Index NumDofs() const { return structure_.NumDofs(); }
  const std::vector<ContactState>& states() const { return states_; }
  const std::vector<std::size_t>& Touching() const { return touching_; }  // candidates that are not open, ascending

  Eigen::VectorXd Pack(const PathPoint& point) const;
  PathPoint Unpack(const Eigen::VectorXd& x) const;

  // residual: NumEquations(). Not finite where an element is singular.
  void Residual(const Eigen::VectorXd& x, Eigen::VectorXd* residual) const;
  // Transposed Jacobian, NumUnknowns() x NumEquations(), compressed; the pattern is the same until the next set or pin.
  const Eigen::SparseMatrix<double>& TransposedJacobian(const Eigen::VectorXd& x);

  // All inequalities of the fixed states, in contact order, and their values at x (>= 0: holds).
  std::vector<Constraint> Inequalities() const;
  // The same without the gaps at x that an increment of length `reach` cannot close.
  std::vector<Constraint> InequalitiesInReach(const Eigen::VectorXd& x, double reach) const;
  double Value(const Constraint& limit, const Eigen::VectorXd& x) const;
  // The force that moving supports and obstacles exert along their motion: their work is its integral over s. Linear in
  // x; with a change of the unknowns, its change.
  double DrivingForce(const Eigen::VectorXd& x) const;
  // Change of the value per change dx of the unknowns, and its gradient, NumUnknowns().
  double Rate(const Constraint& limit, const Eigen::VectorXd& dx) const;
  Eigen::VectorXd Gradient(const Constraint& limit) const;
  // Second derivative of the residual along dx, d2/dh2 residual(x + h dx) at h = 0: NumEquations().
  Eigen::VectorXd SecondDerivative(const Eigen::VectorXd& x, const Eigen::VectorXd& dx);

 private:
  struct Term {
    Eigen::Index unknown;
    double coefficient;
  };
  struct LinearEquation {
    std::array<Term, 3> terms = {};  // the first `count`, ascending unknowns
    std::size_t count = 0;
    double constant = 0.0;

    void Add(Eigen::Index unknown, double coefficient) { terms[count++] = {unknown, coefficient}; }
    double Rate(const Eigen::VectorXd& dx) const {
      double sum = 0.0;
      for (std::size_t k = 0; k < count; ++k) sum += terms[k].coefficient * dx[terms[k].unknown];
      return sum;
    }
  };

  void AddFunction(const SparseLinear& function, double sign, LinearEquation* equation) const;
  LinearEquation Gap(std::size_t contact) const;
  LinearEquation TangentialMotion(std::size_t contact, double sign) const;
  LinearEquation InequalityAsEquation(const Constraint& limit) const;
  void AddInequalities(std::size_t contact, std::vector<Constraint>* limits) const;
  void Rebuild();

  const Structure& structure_;
  const std::vector<ContactGeometry>& contacts_;
  std::vector<ContactState> states_;
  Eigen::VectorXd tangential_reference_;
  std::vector<Constraint> active_;
  bool load_factor_fixed_ = false;
  double load_factor_ = 0.0;

  std::vector<std::size_t> touching_;
  std::vector<Eigen::Index> rn_unknown_;  // by candidate, -1 = none
  std::vector<Eigen::Index> rt_unknown_;
  Eigen::Index first_support_ = 0;      // unknown: reaction of the first prescribed component
  std::vector<LinearEquation> linear_;  // all equations but equilibrium
  Eigen::Index num_unknowns_ = 0;
  Eigen::Index num_equations_ = 0;
  Eigen::SparseMatrix<double> tangent_;
  Eigen::SparseMatrix<double> transposed_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_CONTACT_FIXED_STATE_SYSTEM_H_
