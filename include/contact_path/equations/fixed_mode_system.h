// The equations of equilibrium with every law in a mode: a smooth system.
#ifndef CONTACT_PATH_EQUATIONS_FIXED_MODE_SYSTEM_H_
#define CONTACT_PATH_EQUATIONS_FIXED_MODE_SYSTEM_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <map>
#include <optional>
#include <vector>

#include "contact_path/equations/arc_equations.h"
#include "contact_path/equations/rigid_modes.h"
#include "contact_path/law/laws.h"
#include "contact_path/law/reach_tracker.h"
#include "contact_path/structure/structure.h"

namespace contact_path {

// Unknowns x = (u, s, forces of the ports that are held, reactions of the prescribed components). Equations:
//   phi(u, s) - sum of force * factor * gradient over all ports = 0     NumDofs()                     (eq. 1)
//   u = start + rate s                                                  each prescribed component
//   motion - reference + compliance * force = 0                         each port that is held        (eqs. 2, 3)
// and one equation "limit = 0" for each limit of SetActive(), and s = value where the load factor is active. With
// nothing active there is one unknown more than equations: the solutions are a curve where the rank is full. Forces of
// ports that follow are eliminated.
class FixedModeSystem : public ArcEquations {
 public:
  // Both must outlive the system.
  FixedModeSystem(const Structure& structure, const Laws& laws);

  // references: by port, or none, which is all 0.
  void SetModes(const Modes& modes, const Eigen::VectorXd& references = Eigen::VectorXd());
  // For an arc that sets out from a point, in its modes: motions are measured from those there. The modes may hold
  // motions that are not 0 but count as such: RoundingOf() then knows the forces that this changes.
  void SetModesFrom(const PathPoint& from);
  void SetActive(const std::vector<Limit>& limits);
  void FixLoadFactor(double value);  // until the next SetModes()

  Eigen::Index NumUnknowns() const override { return num_unknowns_; }
  Eigen::Index NumEquations() const override { return num_equations_; }
  Eigen::Index NumMotion() const override { return NumDofs() + 1; }
  Eigen::Index NumDofs() const { return structure_.NumDofs(); }
  const Modes& modes() const { return modes_; }
  const std::vector<std::size_t>& Acting() const { return acting_; }  // laws that are not idle, ascending
  const Laws& laws() const { return laws_; }

  Eigen::VectorXd Pack(const PathPoint& point) const;
  // Idle laws are as points have them (Law::OfPoint).
  PathPoint Unpack(const Eigen::VectorXd& x) const;

  void Residual(const Eigen::VectorXd& x, Eigen::VectorXd* residual) const override;
  // Forces of the parts by the rounding of the coordinates, loads and reactions, and lengths, by their own.
  Eigen::VectorXd Rounding(const Eigen::VectorXd& x) const override;
  // The largest entry of a residual; equations of equilibrium are measured in Structure::ResidualUnits().
  double Largest(const Eigen::VectorXd& residual) const;
  // Strain energy of the structure and of the laws [force length].
  double Energy(const Eigen::VectorXd& x) const;
  // Forces relative to the largest of load factor and forces, motions to the largest coordinate, each + 1.
  bool Hold(const Eigen::VectorXd& x, const Eigen::VectorXd& residual) const override;
  // The largest of Structure::ResidualUnits().
  double ResidualUnit() const override { return residual_unit_; }
  // Of the force on a moved support the component along its motion counts: whether the component across it is an
  // unknown depends on the axes. Forces that small compliances tell count by how far these give way: rounding of the
  // coordinates changes such forces by more than anything else.
  Eigen::VectorXd Counted(const Eigen::VectorXd& change) const override;
  double Norm(const Eigen::VectorXd& change) const override {
    return structure_.ObliqueSupports().empty() && !gives_ ? change.norm() : Counted(change).norm();
  }
  // Whether forces are told by small compliances alone.
  bool Gives() const { return gives_; }
  // The pattern is the same until the next set or pin.
  const Eigen::SparseMatrix<double>& TransposedJacobian(const Eigen::VectorXd& x) override;
  bool Mixed() const override { return structure_.Mixed(); }
  const Eigen::SparseMatrix<double>& MixedJacobian(const Eigen::VectorXd& x, const Eigen::VectorXd& from,
                                                   const Eigen::VectorXd& to) override;
  bool MayMoveFreely() const override;
  Eigen::MatrixXd FreeMotions(const Eigen::VectorXd& x, const Eigen::SparseMatrix<double>& transposed) override;

  // The system among those of other modes, for BorderedSolver; until the next set or pin. Null where the system is
  // small, or has active limits or a fixed load factor, or where very many laws act, or one couples unknowns.
  const Frame* InFrame() override;

  // Limits of the laws that act, and those of idle ones that an increment of length `reach` may come to; near: the ends
  // of pieces that idle laws in reach are beside. Laws are in the modes that they have at the start of a step from x:
  // no equation changes.
  std::vector<Limit> LimitsInReach(const Eigen::VectorXd& x, double reach, std::vector<Limit>* near) override;
  // Whether an idle law of the last LimitsInReach() has passed its limit at x, on another piece than its own.
  bool BeyondReach(const Eigen::VectorXd& x) const override;
  bool IsOfRate(const Limit& limit) const override { return RuleOf(limit).OfRate(); }
  double RoundingOf(const Limit& limit, double of_forces) const override;
  // All limits of the modes, in the order of the laws, and their values at x (>= 0: holds).
  std::vector<Limit> Limits() const;
  // In the mode of its law.
  const LimitRule& RuleOf(const Limit& limit) const {
    const auto i = static_cast<std::size_t>(limit.law);
    return laws_[i].Rule(modes_[i].state, limit.id);
  }
  // Whether the rate of the limit counts at x. A limit of a rate always does.
  bool IsWeaklyActive(const Limit& limit, const Eigen::VectorXd& x, const ActiveSetTolerance& tolerance) const;
  double Value(const Limit& limit, const Eigen::VectorXd& x) const override;
  double UnitOf(const Limit& limit) const override { return RuleOf(limit).unit; }
  // Change of the value per change dx of the unknowns at x, and its gradient, NumUnknowns().
  double Rate(const Limit& limit, const Eigen::VectorXd& x, const Eigen::VectorXd& dx) const;
  Eigen::VectorXd Gradient(const Limit& limit, const Eigen::VectorXd& x) const override;
  // The value along a curve with these derivatives at x.
  Jet ValueAlong(const Limit& limit, const Eigen::VectorXd& x, const Eigen::VectorXd& first,
                 const Eigen::VectorXd& second) const override;
  // The motion of a port along such a curve, and the force of port 0 times the factor of this one: times the ratio of a
  // port that follows and d(motion), the work that it takes.
  Jet MotionAlong(std::size_t law, std::size_t port, const Eigen::VectorXd& x, const Eigen::VectorXd& first,
                  const Eigen::VectorXd& second) const;
  Jet LeadingForceAlong(std::size_t law, std::size_t port, const Eigen::VectorXd& x, const Eigen::VectorXd& first,
                        const Eigen::VectorXd& second) const;
  // The force that moving supports and obstacles exert along their motion, along such a curve: their work is its
  // integral over s.
  Jet DrivingForceAlong(const Eigen::VectorXd& x, const Eigen::VectorXd& first, const Eigen::VectorXd& second) const;
  Eigen::VectorXd SecondDerivative(const Eigen::VectorXd& x, const Eigen::VectorXd& dx) override;

 private:
  // offset + sign (motion of the port - reference).
  struct Motion {
    std::size_t law, port;
    double sign = 1.0, offset = 0.0;
  };
  struct MotionEquation {  // motion + compliance * force = 0
    Motion motion;
    Eigen::Index equation;
    double compliance = 0.0;
    Eigen::Index force = -1;  // unknown; -1 where nothing gives way
  };

  Eigen::Index UnknownOf(std::size_t law, std::size_t port) const {
    return unknown_[static_cast<std::size_t>(laws_.FirstPort(law)) + port];
  }
  Motion MotionOf(const Limit& limit) const;  // of one that is not of forces
  double MotionValue(const Motion& motion, const Eigen::VectorXd& x) const;
  // Its second derivative along dx that comes from curvature.
  double Bend(const Motion& motion, const PortsAt& at, const Eigen::VectorXd& dx) const;
  // Of the ports of an acting law; with a change of the unknowns, the change.
  PortReals ForcesOf(std::size_t law, const Eigen::VectorXd& x) const;
  PortsAt Evaluate(std::size_t law, const Eigen::VectorXd& x) const;
  const RigidModes& FreeModes() const;

  // Each calls emit(unknown, equation, value) for structural entries of the Jacobian: the entries of a motion, the
  // entries of the forces of a law in the equilibrium equations, and the change of these forces by curvature there.
  template <typename Emit>
  void ForEachMotionEntry(const MotionEquation& of, const PortsAt& at, Emit emit) const;
  template <typename Emit>
  void ForEachForceEntry(std::size_t law, const PortsAt& at, Emit emit) const;
  template <typename Emit>
  void ForEachCurvatureEntry(const PortsAt& at, const PortReals& forces, Emit emit) const;
  template <typename Emit>
  void ForEachConstantEntry(Emit emit) const;  // besides those of laws without curvature
  void NumberEquations();
  void Rebuild();
  // Puts tangent_ and the curved laws at x into transposed_.
  const Eigen::SparseMatrix<double>& WithTangent(const Eigen::VectorXd& x);
  bool FitFrame(const std::vector<std::size_t>& framed) const;
  std::vector<std::size_t> LawsToFrame() const;
  void PlaceInFrame();

  const Structure& structure_;
  const Laws& laws_;
  double residual_unit_ = 1.0;  // the largest
  Modes modes_;
  Eigen::VectorXd reference_;  // by port
  std::vector<Limit> active_;
  bool load_factor_fixed_ = false;
  double load_factor_ = 0.0;

  std::vector<std::size_t> acting_;
  std::vector<Eigen::Index> unknown_;  // by port, -1 = none
  Eigen::Index first_support_ = 0;     // unknown: reaction of the first prescribed component
  // Equations: equilibrium, then motions of the ports that are held, supports, active limits, load factor.
  std::vector<MotionEquation> motions_;
  Eigen::Index first_support_equation_ = 0;
  Eigen::Index first_active_equation_ = 0;
  Eigen::Index num_unknowns_ = 0;
  Eigen::Index num_equations_ = 0;
  bool curved_ = false, couples_ = false, gives_ = false;  // some of the laws in the equations
  Eigen::SparseMatrix<double> tangent_;
  Eigen::SparseMatrix<double> transposed_;
  Frame frame_;
  std::vector<std::size_t> framed_;     // laws that have places in it, ascending
  bool placed_ = false;                 // in the frame, as the modes are
  std::vector<std::size_t> in_reach_;   // in the last call of LimitsInReach()
  std::map<int, double> moved_forces_;  // by law that the modes hold where it has moved: see SetModesFrom()
  // Made where they are asked for.
  std::optional<ReachTracker> tracker_;
  mutable std::optional<const RigidModes> free_modes_;
  Eigen::VectorXd constant_;  // values of transposed_ that do not change; kept where some laws are curved
};

}  // namespace contact_path

#endif  // CONTACT_PATH_EQUATIONS_FIXED_MODE_SYSTEM_H_
