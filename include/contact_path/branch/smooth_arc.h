// The path between two events: a smooth curve of solutions.
#ifndef CONTACT_PATH_BRANCH_SMOOTH_ARC_H_
#define CONTACT_PATH_BRANCH_SMOOTH_ARC_H_

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "contact_path/branch/crossing.h"
#include "contact_path/branch/factorised.h"
#include "contact_path/branch/step.h"
#include "contact_path/equations/arc_equations.h"
#include "contact_path/equations/newton_loop.h"

namespace contact_path {

struct Correction {
  bool converged = false;
  Eigen::VectorXd x;
  int iterations = 0;
  Eigen::VectorXd first_step;  // of Newton's method: the error of the guess
  double contraction = 0.0;    // ratio of the second step to the first
  std::vector<double> steps;   // norms of all Newton steps
};

class SmoothArc {
 public:
  // equations must outlive the arc.
  explicit SmoothArc(ArcEquations* equations) : equations_(*equations) {}

  // To be called where the equations have become others. rests: part of the structure stands still at a limit point of
  // its own (Branch::rests), so that the equations are singular all along the arc.
  void Begin(bool rests);
  ArcEquations& equations() const { return equations_; }
  bool Rests() const { return rests_; }
  Eigen::Index NumMotion() const { return equations_.NumMotion(); }
  Eigen::Index LoadFactor() const { return NumMotion() - 1; }  // its place among the unknowns

  // Derivatives at a point x of the curve, along the direction with a positive component on `towards` (NumMotion()).
  // False where they do not exist: singular element, or no direction along `towards`.
  bool Derivatives(const Eigen::VectorXd& x, const Eigen::VectorXd& towards, CurvePoint* point);

  // The point of the curve that a step is to begin at: Newton's method looks for points near it from now on.
  void SetOut(const CurvePoint& at);
  // Newton's method for the point of the curve with row . x = value, from guess. row: unknowns. It sets out with the
  // factors of the last Derivatives() of these equations where they serve with this row, and factorises anew where
  // they do not lead on fast.
  Correction Correct(const Eigen::VectorXd& guess, const Eigen::VectorXd& row, double value);
  // Newton's method for the point of the curve on the plane through guess with this normal in (u, s), near the tangent.
  // It sets out with the factors of the last Derivatives() of these equations.
  Correction CorrectOnPlane(const Eigen::VectorXd& guess, const Eigen::VectorXd& normal);
  // Newton's method for the point of the curve where a limit is exactly zero, from guess.
  Correction CorrectOnto(const Limit& limit, const Eigen::VectorXd& guess);

  // What rounding leaves of a rate gradient . first at the point of the last Derivatives(): rounding of the equations
  // that the tangent solves, and of the point, M d = rounding with M = [J; row], which changes the rate by y . F''(t,
  // d), M' y = gradient.
  double ErrorOfRate(const Eigen::VectorXd& gradient, const CurvePoint& at);
  // How far rounding of the equations may move a point x of the curve on the plane with this normal in (u, s).
  double MovedByRounding(const Eigen::VectorXd& x, const Eigen::VectorXd& normal);

  // Where k other curves cross, or nearly cross, the arc near guess, whose tangent in (u, s) is about `tangent`.
  std::optional<Crossing> FindCrossing(const Eigen::VectorXd& guess, const Eigen::VectorXd& tangent, Eigen::Index k);

  // Of a large system at a point x of a curve on which the load factor is free: BorderedSolver::NegativeEigenvalues(),
  // where the factors at hand are of that point.
  std::optional<Eigen::Index> NegativeEigenvalues(const Eigen::VectorXd& x) const;

  // The rounding of a limit's value: down to minus this it counts as holding.
  double RoundingOf(const Limit& limit) const {
    return equations_.RoundingOf(limit, tolerances::kMargin * reaction_error_);
  }

  int factorisations() const { return factorisations_; }

 private:
  Correction Correct(const Eigen::VectorXd& guess, const Eigen::VectorXd& row, double value, bool at_hand);
  // at_hand: with the factors that there are; gives up where they do not lead on fast.
  Correction Newton(const Eigen::VectorXd& guess, const Eigen::VectorXd& row, double value, bool at_hand);
  // A short last step need not leave a small residual: not among stiff parts, nor by the factors of another point.
  // Newton steps with the factors at hand follow for as long as each halves the residual. What the last one would have
  // changed the reactions by is what rounding leaves of them.
  void LowerResidual(const Eigen::VectorXd& row, double value, Eigen::VectorXd* x);
  // Where the Jacobian has a null plane with *first in it: puts the tangent that is nearest to `towards` into *first.
  void ChooseInPlane(const Eigen::VectorXd& x, const Eigen::VectorXd& towards, Eigen::VectorXd* first);
  // Takes from *change, a solution of the singular equations, what would move the part at rest off its limit point:
  // with the null vectors n on the right, psi on the left, psi . F''(n, change) = 0.
  void HoldLimitPoint(const Eigen::VectorXd& x, Eigen::VectorXd* change);
  // Where the equations want it, the first matrix of Newton's method from guess has the strains along the tangent of
  // the point set out from.
  void ExtrapolateStrains(const Eigen::VectorXd& guess);
  // x: where free motions are looked for. False if the matrix is not finite.
  bool Factorize(const Eigen::VectorXd& x, const Eigen::SparseMatrix<double>& transposed, const Eigen::VectorXd& row);
  Eigen::VectorXd RowOf(const Eigen::VectorXd& motion) const;  // by all unknowns

  ArcEquations& equations_;
  Factorised factors_;
  BorderedSolver& solver_ = factors_.solver;
  bool at_hand_ = false;  // regular factors of a point of the curve, the last row along the tangent
  Eigen::VectorXd of_;    // the point whose factors they are; empty: not known
  // Whether the last factors are those of springs that hold free motions; nothing: the arc begins.
  std::optional<bool> held_;
  double reaction_error_ = 0.0;  // of the last point that Newton's method found
  bool rests_ = false;           // part of the structure stands still at a limit point of its own (Branch::rests)
  Eigen::VectorXd residual_, step_;
  Eigen::VectorXd origin_, tangent_at_origin_;  // of SetOut(), (u, s); empty: none
  Eigen::VectorXd strains_from_, strains_to_;   // for ArcEquations::MixedJacobian(), (u, s)
  int factorisations_ = 0;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_SMOOTH_ARC_H_
