// The equations of equilibrium with the state of every contact fixed: a smooth system.
#ifndef CONTACT_PATH_EQUATIONS_FIXED_STATE_SYSTEM_H_
#define CONTACT_PATH_EQUATIONS_FIXED_STATE_SYSTEM_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "contact_path/contact/contact_pair.h"
#include "contact_path/contact/path_point.h"
#include "contact_path/equations/jet.h"
#include "contact_path/linear/frame.h"
#include "contact_path/structure/structure.h"

namespace contact_path {

// An inequality of the fixed states: what must stay >= 0 for the states to be right.
enum class Inequality {
  kGap,             // open: u_n
  kNormalReaction,  // touching: r_n
  kConePlus,        // stick: mu r_n + r_t (at zero, slip+ is next)
  kConeMinus,       // stick: mu r_n - r_t (at zero, slip- is next)
  kSlip,            // slip+-: +-(xi - xi_ref), the motion since the reference; what must be >= 0 is its rate
  kTotalSlip,       // slip+- by the total law: +-(xi - xi_ref) itself
  kPatchBegin,      // touching, not sticking, on a surface with patches: xi - begin (at zero, the patch before is next)
  kPatchEnd,        // touching, not sticking, on a surface with patches: end - xi (at zero, the patch after is next)
};

// Whether the inequality keeps a contact on its patch.
inline bool KeepsPatch(Inequality inequality) {
  return inequality == Inequality::kPatchBegin || inequality == Inequality::kPatchEnd;
}

// Whether the inequality is of a slip, whose contact sticks next at zero.
inline bool IsOfSlip(Inequality inequality) {
  return inequality == Inequality::kSlip || inequality == Inequality::kTotalSlip;
}

// Whether its value is a length, and not a force.
inline bool IsMotion(Inequality inequality) {
  return inequality == Inequality::kGap || IsOfSlip(inequality) || KeepsPatch(inequality);
}

struct Constraint {
  int contact = 0;
  Inequality inequality = Inequality::kGap;

  bool operator==(const Constraint& other) const { return contact == other.contact && inequality == other.inequality; }
};

// Unknowns x = (u, s, reactions of the touching contacts, reactions of the prescribed components): r_n, and r_t where
// sticking. Equations:
//   phi(u, s) - T r = 0                       NumDofs()                     (eq. 1)
//   u = start + rate s                        each prescribed component
//   u_n = 0                                   each touching contact         (eq. 2)
//   xi = xi_ref                               each sticking contact         (eq. 3)
// and one equation "inequality = 0" for each constraint of SetActive(), and s = value where the load factor is active.
// With nothing active there is one unknown more than equations: the solutions are a curve where the rank is full. Slip
// has r_t = -+mu r_n eliminated.
class FixedStateSystem {
 public:
  // Both must outlive the system.
  FixedStateSystem(const Structure& structure, const ContactPairs& contacts);

  // states, reference (xi_ref), patches of the surfaces: by candidate; no patches: all are 0.
  void SetStates(const std::vector<ContactState>& states, const Eigen::VectorXd& reference,
                 const std::vector<int>& patches = {});
  // Puts each of these candidates that is open on the patch that is nearest at x: no equation changes.
  void PlaceOpen(const std::vector<std::size_t>& candidates, const Eigen::VectorXd& x);
  // Whether one of these candidates, if it is open, is behind its surface at x, on another patch than the one it is on.
  bool BehindOtherPatch(const std::vector<std::size_t>& candidates, const Eigen::VectorXd& x) const;
  void SetActive(const std::vector<Constraint>& constraints);
  void FixLoadFactor(double value);
  void FreeLoadFactor();

  Eigen::Index NumUnknowns() const { return num_unknowns_; }
  Eigen::Index NumEquations() const { return num_equations_; }
  Eigen::Index NumDofs() const { return structure_.NumDofs(); }
  const std::vector<ContactState>& states() const { return states_; }
  const std::vector<int>& patches() const { return patches_; }
  const std::vector<std::size_t>& Touching() const { return touching_; }  // candidates that are not open, ascending

  Eigen::VectorXd Pack(const PathPoint& point) const;
  // Open contacts are on kNearestPatch.
  PathPoint Unpack(const Eigen::VectorXd& x) const;

  // residual: NumEquations(). Not finite where an element is singular.
  void Residual(const Eigen::VectorXd& x, Eigen::VectorXd* residual) const;
  // What rounding may leave of each entry of the residual at x: forces of the parts by the rounding of the coordinates,
  // loads and reactions, and lengths, by their own. NumEquations().
  Eigen::VectorXd Rounding(const Eigen::VectorXd& x) const;
  // The largest entry of a residual; equations of equilibrium are measured in Structure::ResidualUnits().
  double Largest(const Eigen::VectorXd& residual) const;
  // The largest entry in the equations of touching contacts and of prescribed components.
  double LargestOfMotions(const Eigen::VectorXd& residual) const;
  // The largest of Structure::ResidualUnits(): rounding of residuals, and the error of points by it, grow with it.
  double ResidualUnit() const { return residual_unit_; }
  // Norm of a change of the unknowns. Of the force on a moved support the component along its motion counts: whether
  // the component across it is an unknown depends on the axes.
  double Norm(const Eigen::VectorXd& change) const;
  // Transposed Jacobian, NumUnknowns() x NumEquations(), compressed; the pattern is the same until the next set or pin.
  const Eigen::SparseMatrix<double>& TransposedJacobian(const Eigen::VectorXd& x);
  // Transposed Jacobian with Structure::MixedTangent(): strains linearised at the motion `from` towards the motion
  // `to`.
  const Eigen::SparseMatrix<double>& MixedJacobian(const Eigen::VectorXd& x, const Eigen::VectorXd& from,
                                                   const Eigen::VectorXd& to);

  // The system among those of other contact states, for BorderedSolver; until the next set or pin. Null where the
  // system is small, or has active constraints or a fixed load factor, or where very many contacts touch, or one
  // touches a deformable surface.
  const Frame* InFrame();

  // All inequalities of the fixed states, in contact order, and their values at x (>= 0: holds).
  std::vector<Constraint> Inequalities() const;
  // Inequalities of the touching contacts and of these candidates, ascending, alone.
  std::vector<Constraint> InequalitiesOf(const std::vector<std::size_t>& candidates) const;
  // Both ends of the patch of each of these candidates that is open. They are no inequalities of the states, since an
  // open contact may pass over them, but Value() has their values.
  std::vector<Constraint> PatchEndsOfOpen(const std::vector<std::size_t>& candidates) const;
  double Value(const Constraint& constraint, const Eigen::VectorXd& x) const;
  // What tolerances of the values and rates are multiplied with: 1, or for reactions the force unit of the contact
  // (NormalForceUnit() for normal reactions).
  double UnitOf(const Constraint& constraint) const;
  // Change of the value per change dx of the unknowns at x, and its gradient, NumUnknowns().
  double Rate(const Constraint& constraint, const Eigen::VectorXd& x, const Eigen::VectorXd& dx) const;
  Eigen::VectorXd Gradient(const Constraint& constraint, const Eigen::VectorXd& x) const;
  // The value along a curve with these derivatives at x.
  Jet ValueAlong(const Constraint& constraint, const Eigen::VectorXd& x, const Eigen::VectorXd& first,
                 const Eigen::VectorXd& second) const;
  // r_n c of a touching contact (contact/kinematics.h) along such a curve: times mu dxi, the dissipation of its slip.
  Jet SlidingForceAlong(std::size_t contact, const Eigen::VectorXd& x, const Eigen::VectorXd& first,
                        const Eigen::VectorXd& second) const;
  // The force that moving supports and obstacles exert along their motion, along such a curve: their work is its
  // integral over s.
  Jet DrivingForceAlong(const Eigen::VectorXd& x, const Eigen::VectorXd& first, const Eigen::VectorXd& second) const;
  // Second derivative of the residual along dx, d2/dh2 residual(x + h dx) at h = 0: NumEquations().
  Eigen::VectorXd SecondDerivative(const Eigen::VectorXd& x, const Eigen::VectorXd& dx);

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
  std::vector<std::size_t> framed_;  // contacts that have places in it, ascending
  bool placed_ = false;              // in the frame, as the states are
  Eigen::VectorXd constant_;         // values of transposed_ that do not change; kept where some contacts are curved
};

}  // namespace contact_path

#endif  // CONTACT_PATH_EQUATIONS_FIXED_STATE_SYSTEM_H_
