// The equations of equilibrium with the state of every contact fixed: a smooth system.
#ifndef CONTACT_PATH_EQUATIONS_FIXED_STATE_SYSTEM_H_
#define CONTACT_PATH_EQUATIONS_FIXED_STATE_SYSTEM_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <map>
#include <optional>
#include <vector>

#include "contact_path/contact/contact_pair.h"
#include "contact_path/contact/path_point.h"
#include "contact_path/contact/reach_tracker.h"
#include "contact_path/equations/arc_equations.h"
#include "contact_path/equations/rigid_modes.h"
#include "contact_path/structure/structure.h"

namespace contact_path {

// Unknowns x = (u, s, reactions of the touching contacts, reactions of the prescribed components): r_n, and r_t where
// sticking. Equations:
//   phi(u, s) - T r = 0                       NumDofs()                     (eq. 1)
//   u = start + rate s                        each prescribed component
//   u_n = 0                                   each touching contact         (eq. 2)
//   xi = xi_ref                               each sticking contact         (eq. 3)
// and one equation "inequality = 0" for each constraint of SetActive(), and s = value where the load factor is active.
// With nothing active there is one unknown more than equations: the solutions are a curve where the rank is full. Slip
// has r_t = -+mu r_n eliminated.
class FixedStateSystem : public ArcEquations {
 public:
  // Both must outlive the system.
  FixedStateSystem(const Structure& structure, const ContactPairs& contacts);

  // states, reference (xi_ref), patches of the surfaces: by candidate; no patches: all are 0.
  void SetStates(const std::vector<ContactState>& states, const Eigen::VectorXd& reference,
                 const std::vector<int>& patches = {});
  // For an arc that sets out from a point: stick and slip are measured from the tangential positions there. The states
  // may close contacts over gaps that are not 0 but count as closed: RoundingOf() then knows the forces that this
  // changes.
  void SetStatesFrom(const PathPoint& from, const std::vector<ContactState>& states);
  void SetActive(const std::vector<Constraint>& constraints);
  void FixLoadFactor(double value);  // until the next SetStates()

  Eigen::Index NumUnknowns() const override { return num_unknowns_; }
  Eigen::Index NumEquations() const override { return num_equations_; }
  Eigen::Index NumMotion() const override { return NumDofs() + 1; }
  Eigen::Index NumDofs() const { return structure_.NumDofs(); }
  const std::vector<ContactState>& states() const { return states_; }
  const std::vector<int>& patches() const { return patches_; }
  const std::vector<std::size_t>& Touching() const { return touching_; }  // candidates that are not open, ascending

  Eigen::VectorXd Pack(const PathPoint& point) const;
  // Open contacts are on kNearestPatch.
  PathPoint Unpack(const Eigen::VectorXd& x) const;

  void Residual(const Eigen::VectorXd& x, Eigen::VectorXd* residual) const override;
  // Forces of the parts by the rounding of the coordinates, loads and reactions, and lengths, by their own.
  Eigen::VectorXd Rounding(const Eigen::VectorXd& x) const override;
  // The largest entry of a residual; equations of equilibrium are measured in Structure::ResidualUnits().
  double Largest(const Eigen::VectorXd& residual) const;
  // Forces relative to the largest of load factor and reactions, motions to the largest coordinate, each + 1.
  bool Hold(const Eigen::VectorXd& x, const Eigen::VectorXd& residual) const override;
  // The largest of Structure::ResidualUnits().
  double ResidualUnit() const override { return residual_unit_; }
  // Of the force on a moved support the component along its motion counts: whether the component across it is an
  // unknown depends on the axes.
  Eigen::VectorXd Counted(const Eigen::VectorXd& change) const override;
  double Norm(const Eigen::VectorXd& change) const override {
    return structure_.ObliqueSupports().empty() ? change.norm() : Counted(change).norm();
  }
  // The pattern is the same until the next set or pin.
  const Eigen::SparseMatrix<double>& TransposedJacobian(const Eigen::VectorXd& x) override;
  bool Mixed() const override { return structure_.Mixed(); }
  const Eigen::SparseMatrix<double>& MixedJacobian(const Eigen::VectorXd& x, const Eigen::VectorXd& from,
                                                   const Eigen::VectorXd& to) override;
  bool MayMoveFreely() const override;
  Eigen::MatrixXd FreeMotions(const Eigen::VectorXd& x, const Eigen::SparseMatrix<double>& transposed) override;

  // The system among those of other contact states, for BorderedSolver; until the next set or pin. Null where the
  // system is small, or has active constraints or a fixed load factor, or where very many contacts touch, or one
  // touches a deformable surface.
  const Frame* InFrame() override;

  // Inequalities of the touching contacts, and the gaps at x that an increment of length `reach` may close; near: the
  // ends of the patches that open candidates in reach are beside. Open candidates in reach come onto the patch that is
  // nearest at x: no equation changes.
  std::vector<Constraint> LimitsInReach(const Eigen::VectorXd& x, double reach, std::vector<Constraint>* near) override;
  // Whether a candidate of the last LimitsInReach() that is open is behind its surface at x, on another patch than its
  // own.
  bool BeyondReach(const Eigen::VectorXd& x) const override;
  bool IsOfRate(const Constraint& limit) const override { return limit.inequality == Inequality::kSlip; }
  double RoundingOf(const Constraint& limit, double of_forces) const override;
  // All inequalities of the fixed states, in contact order, and their values at x (>= 0: holds).
  std::vector<Constraint> Inequalities() const;
  double Value(const Constraint& constraint, const Eigen::VectorXd& x) const override;
  // What tolerances of the values and rates are multiplied with: 1, or for reactions the force unit of the contact
  // (NormalForceUnit() for normal reactions).
  double UnitOf(const Constraint& constraint) const override;
  // Change of the value per change dx of the unknowns at x, and its gradient, NumUnknowns().
  double Rate(const Constraint& constraint, const Eigen::VectorXd& x, const Eigen::VectorXd& dx) const;
  Eigen::VectorXd Gradient(const Constraint& constraint, const Eigen::VectorXd& x) const override;
  // The value along a curve with these derivatives at x.
  Jet ValueAlong(const Constraint& constraint, const Eigen::VectorXd& x, const Eigen::VectorXd& first,
                 const Eigen::VectorXd& second) const override;
  // r_n c of a touching contact (contact/kinematics.h) along such a curve: times mu dxi, the dissipation of its slip.
  Jet SlidingForceAlong(std::size_t contact, const Eigen::VectorXd& x, const Eigen::VectorXd& first,
                        const Eigen::VectorXd& second) const;
  // The force that moving supports and obstacles exert along their motion, along such a curve: their work is its
  // integral over s.
  Jet DrivingForceAlong(const Eigen::VectorXd& x, const Eigen::VectorXd& first, const Eigen::VectorXd& second) const;
  Eigen::VectorXd SecondDerivative(const Eigen::VectorXd& x, const Eigen::VectorXd& dx) override;

 private:
  // sign u_n, or offset + sign (xi - xi_ref), of a contact.
  struct Motion {
    std::size_t contact;
    bool is_gap;
    double sign;
    double offset = 0.0;
  };
  struct MotionEquation {  // motion = 0
    Motion motion;
    Eigen::Index equation;
  };
  // On the node of a touching contact; with a change of the unknowns, the change.
  struct Reaction {
    double rn, rt;
  };
  struct ReactionTerms {  // rn r_n + rt r_t
    double rn, rt;
  };

  Motion MotionOf(const Constraint& constraint) const;
  ReactionTerms ReactionTermsOf(const Constraint& constraint) const;  // of the other inequalities
  double MotionValue(const Motion& motion, const Eigen::VectorXd& x) const;
  // Its second derivative along dx that comes from the curvature of the surface.
  double Bend(const Motion& motion, const Kinematics& at, const Eigen::VectorXd& dx) const;
  Reaction ReactionOf(std::size_t contact, const Eigen::VectorXd& x) const;
  Kinematics Evaluate(std::size_t contact, const Eigen::VectorXd& x) const;
  const RigidModes& Modes() const;
  void AddInequalities(std::size_t contact, std::vector<Constraint>* inequalities) const;
  void AddPatchEnds(std::size_t contact, std::vector<Constraint>* inequalities) const;

  // Each calls emit(unknown, equation, value) for structural entries of the Jacobian: the entries of a motion, the
  // entries of the reactions of a contact in the equilibrium equations, and the change of these reactions by the
  // curvature of the surface there.
  template <typename Emit>
  void ForEachMotionEntry(const MotionEquation& of, const Kinematics& at, Emit emit) const;
  template <typename Emit>
  void ForEachReactionEntry(std::size_t contact, const Kinematics& at, Emit emit) const;
  template <typename Emit>
  void ForEachCurvatureEntry(const Kinematics& at, const Reaction& reaction, Emit emit) const;
  template <typename Emit>
  void ForEachConstantEntry(Emit emit) const;  // besides those of flat contacts
  void NumberEquations();
  void Rebuild();
  // Puts tangent_ and the curved contacts at x into transposed_.
  const Eigen::SparseMatrix<double>& WithTangent(const Eigen::VectorXd& x);
  bool FitFrame(std::size_t contacts) const;
  std::vector<std::size_t> ContactsToFrame() const;
  void PlaceInFrame();

  const Structure& structure_;
  const ContactPairs& contacts_;
  double residual_unit_ = 1.0;  // the largest
  std::vector<ContactState> states_;
  std::vector<int> patches_;
  Eigen::VectorXd reference_;
  std::vector<Constraint> active_;
  bool load_factor_fixed_ = false;
  double load_factor_ = 0.0;

  std::vector<std::size_t> with_patches_;  // candidates
  std::vector<std::size_t> touching_;
  std::vector<Eigen::Index> rn_unknown_;  // by candidate, -1 = none
  std::vector<Eigen::Index> rt_unknown_;
  Eigen::Index first_support_ = 0;  // unknown: reaction of the first prescribed component
  // Equations: equilibrium, then motions of the touching contacts, supports, active constraints, load factor.
  std::vector<MotionEquation> motions_;
  Eigen::Index first_support_equation_ = 0;
  Eigen::Index first_active_equation_ = 0;
  Eigen::Index num_unknowns_ = 0;
  Eigen::Index num_equations_ = 0;
  bool curved_ = false, deformable_ = false;  // some of the contacts in the equations are
  Eigen::SparseMatrix<double> tangent_;
  Eigen::SparseMatrix<double> transposed_;
  Frame frame_;
  std::vector<std::size_t> framed_;     // contacts that have places in it, ascending
  bool placed_ = false;                 // in the frame, as the states are
  std::vector<std::size_t> in_reach_;   // in the last call of LimitsInReach()
  std::map<int, double> moved_forces_;  // by contact that the states close over a gap: see SetStatesFrom()
  // Made where they are asked for.
  std::optional<ReachTracker> tracker_;
  mutable std::optional<const RigidModes> modes_;
  Eigen::VectorXd constant_;  // values of transposed_ that do not change; kept where some contacts are curved
};

}  // namespace contact_path

#endif  // CONTACT_PATH_EQUATIONS_FIXED_STATE_SYSTEM_H_
