// What a smooth arc stands on: equations with one unknown more than there are equations, and limits.
#ifndef CONTACT_PATH_EQUATIONS_ARC_EQUATIONS_H_
#define CONTACT_PATH_EQUATIONS_ARC_EQUATIONS_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "contact_path/equations/jet.h"
#include "contact_path/law/mode.h"
#include "contact_path/linear/frame.h"

namespace contact_path {

// F(x) = 0, as a rule NumUnknowns() - 1 equations, whose solutions are a curve where the rank is full, and limits
// g(x) >= 0, or of the rate of g along the curve, within which they are right. All quantities are scaled. The first
// NumMotion() unknowns are the motion, in which arc length is measured; the last of these is the load factor.
class ArcEquations {
 public:
  virtual ~ArcEquations() = default;

  virtual Eigen::Index NumUnknowns() const = 0;
  virtual Eigen::Index NumEquations() const = 0;
  virtual Eigen::Index NumMotion() const = 0;

  // F: NumEquations(). Not finite where an element is singular.
  virtual void Residual(const Eigen::VectorXd& x, Eigen::VectorXd* residual) const = 0;
  // What rounding may leave of each entry of F at x.
  virtual Eigen::VectorXd Rounding(const Eigen::VectorXd& x) const = 0;
  // The same with what F has besides that the scene has not: a symmetric scene is symmetric in F up to so much.
  virtual Eigen::VectorXd Imperfection(const Eigen::VectorXd& x) const { return Rounding(x); }
  // The transposed Jacobian J', NumUnknowns() x NumEquations(), compressed; valid until the next call.
  virtual const Eigen::SparseMatrix<double>& TransposedJacobian(const Eigen::VectorXd& x) = 0;
  // d2/dh2 F(x + h dx) at h = 0.
  virtual Eigen::VectorXd SecondDerivative(const Eigen::VectorXd& x, const Eigen::VectorXd& dx) = 0;

  // Limits that a step of this length from x may reach. near: functions at whose zero an increment is wanted, and
  // nothing fails.
  virtual std::vector<Limit> LimitsInReach(const Eigen::VectorXd& x, double reach, std::vector<Limit>* near) = 0;
  // Whether a limit is broken at x that the last LimitsInReach() did not name.
  virtual bool BeyondReach(const Eigen::VectorXd& /*x*/) const { return false; }
  // Whether the rate of the limit has to stay >= 0, and not its value.
  virtual bool IsOfRate(const Limit& limit) const = 0;
  virtual double Value(const Limit& limit, const Eigen::VectorXd& x) const = 0;
  // By the unknowns.
  virtual Eigen::VectorXd Gradient(const Limit& limit, const Eigen::VectorXd& x) const = 0;
  // Along a curve with these derivatives at x.
  virtual Jet ValueAlong(const Limit& limit, const Eigen::VectorXd& x, const Eigen::VectorXd& first,
                         const Eigen::VectorXd& second) const = 0;
  // What tolerances of its values and rates are multiplied with.
  virtual double UnitOf(const Limit& /*limit*/) const { return 1.0; }
  // The rounding of its value: down to minus this it counts as holding. of_forces: of the unknowns that are no motion.
  virtual double RoundingOf(const Limit& limit, double of_forces) const = 0;

  // Errors of points grow with it.
  virtual double ResidualUnit() const { return 1.0; }
  // Whether small compliances alone tell some of the forces.
  virtual bool Gives() const { return false; }
  // A change of the unknowns with zeros in place of what depends on the axes alone, and the norm of that.
  virtual Eigen::VectorXd Counted(const Eigen::VectorXd& change) const { return change; }
  virtual double Norm(const Eigen::VectorXd& change) const { return Counted(change).norm(); }
  // Whether F at x is rounding.
  virtual bool Hold(const Eigen::VectorXd& x, const Eigen::VectorXd& residual) const = 0;
  // For BorderedSolver; null: none.
  virtual const Frame* InFrame() { return nullptr; }
  // Motions that change nothing, known without looking for them: orthonormal columns, null vectors of J at x. No
  // columns where MayMoveFreely() is false. transposed: J'.
  virtual bool MayMoveFreely() const { return false; }
  virtual Eigen::MatrixXd FreeMotions(const Eigen::VectorXd& /*x*/, const Eigen::SparseMatrix<double>& /*transposed*/) {
    return {};
  }
  // Whether Newton's method converges better with MixedJacobian(): J' with strains linearised at the motion `from`
  // towards the motion `to`.
  virtual bool Mixed() const { return false; }
  virtual const Eigen::SparseMatrix<double>& MixedJacobian(const Eigen::VectorXd& x, const Eigen::VectorXd& /*from*/,
                                                           const Eigen::VectorXd& /*to*/) {
    return TransposedJacobian(x);
  }
};

}  // namespace contact_path

#endif  // CONTACT_PATH_EQUATIONS_ARC_EQUATIONS_H_
