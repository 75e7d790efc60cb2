// Linear systems of a smooth arc: the Jacobian of the fixed-mode equations with one row added.
#ifndef CONTACT_PATH_LINEAR_BORDERED_SOLVER_H_
#define CONTACT_PATH_LINEAR_BORDERED_SOLVER_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>
#include <optional>

#include "contact_path/linear/frame.h"
#include "contact_path/linear/large_system.h"
#include "contact_path/tolerances.h"

namespace contact_path {

// M = [J; row], J equations x unknowns. Square and regular as a rule: sparse LU, with the ordering kept for as long as
// the pattern is the same; by KLU, and where it is large by UMFPACK. Where it is singular or not square (rigid modes,
// redundant contacts): the shortest solution, by a rank-revealing sparse QR factorisation, or where null vectors are
// known by LU as well.
class BorderedSolver {
 public:
  BorderedSolver();
  ~BorderedSolver();
  BorderedSolver(const BorderedSolver&) = delete;
  BorderedSolver& operator=(const BorderedSolver&) = delete;

  // transposed: J', unknowns x equations; row: NumUnknowns entries. False if the matrix is not finite.
  // frame: of the system, which saves large ones orderings, or null.
  bool Factorize(const Eigen::SparseMatrix<double>& transposed, const Eigen::VectorXd& row,
                 const Frame* frame = nullptr);
  // LU only: false if M is singular, not square, or its pivots are further apart than `regular` admits.
  bool FactorizeRegular(const Eigen::SparseMatrix<double>& transposed, const Eigen::VectorXd& row,
                        double regular = tolerances::kSingularPivot, const Frame* frame = nullptr);
  // Where the columns of `modes` (orthonormal, unknowns x modes) are null vectors of J, each with a component at an
  // unknown that has the number of an equation: a spring holds the motion there, which leaves consistent equations as
  // they are since its force is zero. LU of M with these springs; solutions are then freed of null vectors of M, so
  // that they are the shortest. False if M is singular beyond the modes. *tangent: M x = (0, 1), with springs that bear
  // nothing; empty where only the springs solve this, and then nothing below can be asked.
  bool FactorizeHeld(const Eigen::SparseMatrix<double>& transposed, const Eigen::VectorXd& row,
                     const Eigen::MatrixXd& modes, const Frame* frame, Eigen::VectorXd* tangent);
  // The factors of the same J with another row; false where they do not serve: of small systems they never do.
  bool ReplaceRow(const Eigen::VectorXd& row);
  // Solves M x = (b, last). The second one allocates nothing where M is regular and *x has its size.
  Eigen::VectorXd Solve(const Eigen::VectorXd& b, double last) const;
  void Solve(const Eigen::VectorXd& b, double last, Eigen::VectorXd* x) const;
  // Solves M x = (b, 0) for each column of B, where M is regular; *x: unknowns x columns.
  void SolveAll(const Eigen::MatrixXd& B, Eigen::MatrixXd* x) const;

  // Whether M was factorised by LU: regular, or held.
  bool HasLu() const;
  // Solves M' y = c by LU; where M is held, with the springs. y: of the equations and of the row.
  Eigen::VectorXd SolveTransposed(const Eigen::VectorXd& c) const;

  // Of a singular M: bases of {x: M x = 0} and {y: M' y = 0}, the second one not after FactorizeHeld().
  Eigen::MatrixXd NullSpace() const;
  Eigen::MatrixXd LeftNullSpace() const;
  // unknowns - rank of M: 0 if regular.
  Eigen::Index Nullity() const;
  // Sign of the determinant of M; 0 if M is singular or not square.
  int DeterminantSign() const;
  // Of a regular M with large factors, whose first `motions` unknowns have symmetric entries in as many equations, and
  // whose further equations are constraints of these unknowns with multipliers among the further unknowns, but one: the
  // negative eigenvalues of these entries on what the constraints admit, where the factors tell.
  std::optional<Eigen::Index> NegativeEigenvalues(Eigen::Index motions) const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_LINEAR_BORDERED_SOLVER_H_
