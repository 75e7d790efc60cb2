// The increment problem of Kanno & Martins 2005, regularised: eq. (10), as a nonlinear program.
#ifndef CONTACT_PATH_MPEC_INCREMENT_PROBLEM_H_
#define CONTACT_PATH_MPEC_INCREMENT_PROBLEM_H_

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "contact_path/contact/contact_pair.h"
#include "contact_path/law/path_point.h"
#include "contact_path/mpec/increment_constraints.h"
#include "contact_path/mpec/increment_slots.h"
#include "contact_path/mpec/nonlinear_program.h"
#include "contact_path/structure/structure.h"

namespace contact_path {

// What an increment is asked to do. In scaled quantities.
struct IncrementGoal {
  double length = 0.0;         // wanted length S of (du, ds), > 0
  Eigen::VectorXd direction;   // of the last increment: unit vector (du, ds), NumDofs() + 1
  double dissipation = 0.0;    // share w of the dissipation term, 0..1
  double gamma2_factor = 1.0;  // factor >= 1 on gamma_2 from the lengths of earlier increments
};

// Variables and constraints: IncrementSlots.
// Objective, eq. (4) over gamma_2 S^2 at gamma2_factor 1:
//   w g . y / |g| - (1 - w) direction . y + gamma2_factor |y|^2 / 2,   g . y = sum of r_t^k xi', by (u, s),
// with gamma_1 and gamma_2 such that the unconstrained minimum is no longer than S for any w: neither one term nor all
// terms together ask for more than the wanted length.
class IncrementProblem : public NonlinearProgram {
 public:
  // working_set: as IncrementSlots has it. All arguments but the last two must outlive the problem.
  IncrementProblem(const Structure& structure, const ContactPairs& contacts, const Laws& laws, const PathPoint& from,
                   const std::vector<int>& working_set, IncrementGoal goal);
  IncrementProblem(const IncrementProblem&) = delete;  // its pieces refer to each other
  IncrementProblem& operator=(const IncrementProblem&) = delete;

  void SetRegularisation(double eps) { eps_ = eps; }

  // Variables for the guess from + S y with the reactions of the contacts at a point; without any, with those of
  // `from`.
  Eigen::VectorXd StartingPoint(const Eigen::VectorXd& y, const PathPoint& reactions) const;
  Eigen::VectorXd StartingPoint(const Eigen::VectorXd& y) const { return StartingPoint(y, from_); }
  // For a point that solves the equations of its states, is stationary for (9) on them and keeps their inequalities:
  // the variables and multipliers next to it that solve (10) with this barrier parameter, to the first order of the
  // regularisation. Nothing where the equations are singular.
  std::optional<PrimalDual> CentralPoint(const PathPoint& point, double barrier) const;
  // The point that variables stand for. States: the larger side of each complementary pair (open or touching, stick or
  // slip).
  PathPoint Point(const Eigen::VectorXd& x) const;
  // The unconstrained minimum of the objective, (u, s): what an increment would be if nothing were in its way.
  Eigen::VectorXd UnconstrainedMinimiser() const;

  Eigen::Index NumVariables() const override { return slots_.NumVariables(); }
  Eigen::Index NumConstraints() const override { return slots_.NumConstraints(); }
  ProgramBounds Bounds() const override;
  double Objective(const Eigen::VectorXd& x) const override;
  Eigen::VectorXd Gradient(const Eigen::VectorXd& x) const override;
  Eigen::VectorXd Constraints(const Eigen::VectorXd& x) const override { return constraints_.Values(x); }
  MatrixEntries Jacobian(const Eigen::VectorXd& x) const override { return constraints_.Jacobian(x); }
  MatrixEntries Hessian(const Eigen::VectorXd& x, double factor, const Eigen::VectorXd& multipliers) const override {
    return constraints_.Hessian(x, factor * goal_.gamma2_factor, multipliers);
  }

 private:
  using Slot = IncrementSlots::Slot;
  using Support = IncrementSlots::Support;

  // What is zero at a point, one of a complementary pair.
  struct Zero {
    Eigen::Index row;     // constraint, or NumConstraints() + variable
    double factor = 0.0;  // in the relaxed product
  };
  using Zeros = std::vector<Zero>;  // of one product
  std::vector<Zeros> ZerosAt(const PathPoint& point, const Eigen::VectorXd& x) const;

  const Laws& laws_;
  const PathPoint& from_;
  IncrementGoal goal_;
  IncrementSlots slots_;
  IncrementConstraints constraints_;
  double eps_ = 0.0;
  Eigen::VectorXd linear_objective_;  // NumDofs() + 1
};

}  // namespace contact_path

#endif  // CONTACT_PATH_MPEC_INCREMENT_PROBLEM_H_
