// The increment problem of Kanno & Martins 2005, regularised: eq. (10), as a nonlinear program.
#ifndef CONTACT_PATH_MPEC_INCREMENT_PROBLEM_H_
#define CONTACT_PATH_MPEC_INCREMENT_PROBLEM_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <optional>
#include <vector>

#include "contact_path/contact/contact_pair.h"
#include "contact_path/law/path_point.h"
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

// Variables, with dz = (du, ds) = S y and reactions over S:
//   y (NumDofs() + 1), r_n / S by contact, then r_t / S and lambda / S by frictional contact, then the reactions of the
//   prescribed components over S. A law that always acts has its first force among r_n / S, its second among r_t / S.
// Objective, eq. (4) over gamma_2 S^2 at gamma2_factor 1:
//   w g . y / |g| - (1 - w) direction . y + gamma2_factor |y|^2 / 2,   g . y = sum of r_t^k xi', by (u, s),
// with gamma_1 and gamma_2 such that the unconstrained minimum is no longer than S for any w: neither one term nor all
// terms together ask for more than the wanted length.
// Constraints, all over S (products over S^2): equilibrium = 0; gaps >= 0; gap r_n <= eps; lambda -+ du_t >= 0;
// mu r_n -+ r_t >= 0; lambda mu r_n + du_t r_t <= eps; prescribed components where they have to be. Frictionless
// contacts have neither r_t nor lambda. A law of one port, as a bar that bears one sense alone, is such a contact.
// Where ports that are held give way, gap and slip are those of the held ports: gap - reference + compliance r_n, and
// xi - reference + compliance r_t. A law that always acts, of one or two ports, has such a motion = 0 for each, with
// forces of any sign. By the total law of friction, xi - xi_0 at the end of the increment takes the place of du_t in
// the constraints.
class IncrementProblem : public NonlinearProgram {
 public:
  // working_set: the laws that take part, ascending, with all that always act. laws: the contacts, then laws of one
  // port and laws that always act. All arguments but the last two must outlive the problem.
  IncrementProblem(const Structure& structure, const ContactPairs& contacts, const Laws& laws, const PathPoint& from,
                   std::vector<int> working_set, IncrementGoal goal);

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

  Eigen::Index NumVariables() const override { return num_variables_; }
  Eigen::Index NumConstraints() const override { return num_constraints_; }
  ProgramBounds Bounds() const override;
  double Objective(const Eigen::VectorXd& x) const override;
  Eigen::VectorXd Gradient(const Eigen::VectorXd& x) const override;
  Eigen::VectorXd Constraints(const Eigen::VectorXd& x) const override;
  MatrixEntries Jacobian(const Eigen::VectorXd& x) const override;
  MatrixEntries Hessian(const Eigen::VectorXd& x, double factor, const Eigen::VectorXd& multipliers) const override;

 private:
  // Where a law of the working set keeps its variables and constraints.
  struct Slot {
    const Law* law;
    const ContactPair* pair;      // the same, of a contact; else null
    Eigen::Index port;            // the first one, among those of all laws
    int held;                     // state in which the gap is zero and nothing slides
    bool always;                  // acts: there is no other state
    PortReals compliance;         // of the ports, where all are held
    int start_patch;              // where the increment starts
    LawDofs dofs;                 // of the patches that it may end on
    PortsAt at_start;             // of the increment
    PortReals reference;          // from which motions are measured
    Eigen::Index rn, rt, lambda;  // variables; -1: none
    Eigen::Index gap_row;         // constraints: gap, gap r_n; motions of the ports of what always acts
    Eigen::Index friction_row;    // lambda - y_t, lambda + y_t, mu r_n - r_t, mu r_n + r_t, product; -1 if frictionless

    bool Frictional() const { return lambda >= 0; }
    Eigen::Index ForceOf(std::size_t of) const { return of == 0 ? rn : rt; }
    std::size_t NumForces() const { return rt < 0 ? 1 : 2; }
  };

  struct Support {
    const PrescribedDof* prescribed;
    Eigen::Index reaction;  // variable
    Eigen::Index row;       // constraint
  };

  // What is zero at a point, one of a complementary pair.
  struct Zero {
    Eigen::Index row;     // constraint, or NumConstraints() + variable
    double factor = 0.0;  // in the relaxed product
  };
  using Zeros = std::vector<Zero>;  // of one product
  std::vector<Zeros> ZerosAt(const PathPoint& point, const Eigen::VectorXd& x) const;
  // Puts a slot with its variables and constraints behind the others. rn: its first variable.
  Slot& AddSlot(std::size_t number, Eigen::Index rn);
  // By y, forces and the dofs of the slot: motions with what compliances give, over S; gradients as they are, Hessians
  // and gradients of factors times S.
  PortsAt ScaledKinematics(const Slot& slot, const Eigen::VectorXd& x) const;
  // Where the node is. The structure of the matrices is fixed: of a deformable surface, the next patches are prolonged.
  int PatchOf(const Slot& slot, const Eigen::VectorXd& u, double s) const;
  // Calls visit(variable, k) for each variable that moves a law, a port of it; k: its number in the q of the slot.
  template <typename Visit>
  void ForEachVariable(const Slot& slot, Visit visit) const;
  template <typename Visit>
  void ForEachVariableOf(const Slot& slot, std::size_t port, Visit visit) const;
  // Entries of the Jacobian: of the first port, its gap and product; of what always acts; of friction.
  void AddGap(const Slot& slot, const PortsAt& at, const Eigen::VectorXd& x, MatrixEntries* entries) const;
  void AddHeld(const Slot& slot, const PortsAt& at, MatrixEntries* entries) const;
  void AddFriction(const Slot& slot, const PortsAt& at, const Eigen::VectorXd& x, MatrixEntries* entries) const;
  // What the curvature of a law adds to the Hessian.
  void AddCurvature(const Slot& slot, const PortsAt& at, const Eigen::VectorXd& x, const Eigen::VectorXd& multipliers,
                    MatrixEntries* entries) const;

  const Structure& structure_;
  const ContactPairs& contacts_;
  const Laws& laws_;
  const PathPoint& from_;
  std::vector<int> working_set_;
  IncrementGoal goal_;
  double eps_ = 0.0;
  Eigen::Index num_variables_ = 0;
  Eigen::Index num_constraints_ = 0;
  std::vector<Slot> slots_;
  std::vector<Support> supports_;
  Eigen::VectorXd linear_objective_;             // NumDofs() + 1
  mutable Eigen::SparseMatrix<double> tangent_;  // scratch
};

}  // namespace contact_path

#endif  // CONTACT_PATH_MPEC_INCREMENT_PROBLEM_H_
