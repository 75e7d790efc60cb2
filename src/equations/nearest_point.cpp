#include "contact_path/equations/nearest_point.h"

#include "contact_path/equations/newton_loop.h"
#include "contact_path/linear/bordered_solver.h"
#include "contact_path/linear/generic_vector.h"
#include "contact_path/linear/minimum_norm.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

// Weight of the reactions in the norm of a step. They take no part in what is wanted; the weight only makes a step
// unique where reactions are redundant, and acts on steps, so it leaves the converged point untouched.
constexpr double kReactionWeight = 1.0 / 32.0;

// Shortest solutions of underdetermined equations. As a rule they describe a curve: then by LU, with a row added that
// is not orthogonal to it, less what lies along the curve; otherwise by a rank-revealing QR.
class ShortestStep {
 public:
  // transposed: unknowns x equations. frame: of the system. False if the matrix is not finite.
  bool Factorize(const Eigen::SparseMatrix<double>& transposed, const Frame* frame) {
    const Eigen::Index unknowns = transposed.rows();
    curve_ = lu_.FactorizeRegular(transposed, GenericVector(unknowns), tolerances::kRootOfRounding, frame);
    if (!curve_) return qr_.Factorize(transposed);
    along_ = lu_.Solve(Eigen::VectorXd::Zero(transposed.cols()), 1.0).normalized();
    rank_ = transposed.cols();
    return true;
  }
  Eigen::VectorXd Solve(const Eigen::VectorXd& right) const {
    if (!curve_) return qr_.Solve(right);
    const Eigen::VectorXd step = lu_.Solve(right, 0.0);
    return step - along_.dot(step) * along_;
  }
  Eigen::Index Rank() const { return curve_ ? rank_ : qr_.Rank(); }

 private:
  BorderedSolver lu_;
  MinimumNormSolver qr_;
  bool curve_ = false;
  Eigen::VectorXd along_;
  Eigen::Index rank_ = 0;
};

}  // namespace

NearestPoint FindNearestPoint(FixedModeSystem* system, const Eigen::VectorXd& start, const Eigen::VectorXd& wanted) {
  const Eigen::Index size = wanted.size();
  const Eigen::Index reactions = system->NumUnknowns() - size;
  NearestPoint result;
  result.x = start;
  ShortestStep solver;
  Eigen::SparseMatrix<double> scaled;
  Eigen::VectorXd residual, step;
  const auto next = [&](const Eigen::VectorXd& x, bool, Eigen::VectorXd* dx) {
    system->Residual(x, &residual);
    scaled = system->TransposedJacobian(x);
    for (Eigen::Index column = 0; column < scaled.cols(); ++column)
      for (Eigen::SparseMatrix<double>::InnerIterator it(scaled, column); it; ++it)
        if (it.row() >= size) it.valueRef() /= kReactionWeight;
    if (!residual.allFinite() || !solver.Factorize(scaled, system->InFrame())) return false;
    result.rank = solver.Rank();
    // Towards what is wanted, then back onto the linearised equations by the shortest step.
    dx->setZero(system->NumUnknowns());
    dx->head(size) = wanted - x.head(size);
    *dx += solver.Solve(-residual - scaled.transpose() * *dx);
    dx->tail(reactions) /= kReactionWeight;
    return true;
  };
  NewtonLimits limits;
  limits.most = kMostIterations;
  limits.unit = system->ResidualUnit();
  const NewtonCourse course = NewtonLoop(
      limits, true, next, [&](const Eigen::VectorXd& dx) { return system->Gives() ? system->Norm(dx) : dx.norm(); },
      &result.x, &step);
  system->Residual(result.x, &residual);
  result.residual = system->Largest(residual);
  result.converged = course.at_rounding && result.residual <= tolerances::kStagnation;
  return result;
}

}  // namespace contact_path
