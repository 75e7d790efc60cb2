// The equations of equilibrium with every law in a mode: a smooth system.
#ifndef CONTACT_PATH_EQUATIONS_FIXED_MODE_SYSTEM_H_
#define CONTACT_PATH_EQUATIONS_FIXED_MODE_SYSTEM_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <map>
#include <optional>
#include <vector>

#include "contact_path/equations/arc_equations.h"
#include "contact_path/equations/fixed_mode_frame.h"
#include "contact_path/equations/fixed_mode_jacobian.h"
#include "contact_path/equations/fixed_mode_layout.h"
#include "contact_path/equations/laws_in_modes.h"
#include "contact_path/equations/mode_limits.h"
#include "contact_path/equations/rigid_modes.h"
#include "contact_path/law/laws.h"
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
  // Both must outlive the system, whose parts refer to each other.
  FixedModeSystem(const Structure& structure, const Laws& laws);
  FixedModeSystem(const FixedModeSystem&) = delete;

  // references: by port, or none, which is all 0.
  void SetModes(const Modes& modes, const Eigen::VectorXd& references = Eigen::VectorXd());
  // For an arc that sets out from a point, in its modes: motions are measured from those there. The modes may hold
  // motions that are not 0 but count as such: RoundingOf() then knows the forces that this changes.
  void SetModesFrom(const PathPoint& from);
  void SetActive(const std::vector<Limit>& limits) { SetLayout(limits, layout_.load_factor_fixed); }
  void FixLoadFactor(double value);  // until the next SetModes()

  Eigen::Index NumUnknowns() const override { return layout_.num_unknowns; }
  Eigen::Index NumEquations() const override { return layout_.num_equations; }
  Eigen::Index NumMotion() const override { return NumDofs() + 1; }
  Eigen::Index NumDofs() const { return structure_.NumDofs(); }
  const LawsInModes& laws_in_modes() const { return laws_; }
  const ModeLimits& mode_limits() const { return limits_; }
  const Modes& modes() const { return laws_.modes(); }
  const std::vector<std::size_t>& Acting() const { return laws_.Acting(); }
  const Laws& laws() const { return laws_.laws(); }

  Eigen::VectorXd Pack(const PathPoint& point) const;
  PathPoint Unpack(const Eigen::VectorXd& x) const { return laws_.Unpack(x); }

  void Residual(const Eigen::VectorXd& x, Eigen::VectorXd* residual) const override;
  // Forces of the parts by the rounding of the coordinates, loads and reactions, and lengths, by their own.
  Eigen::VectorXd Rounding(const Eigen::VectorXd& x) const override;
  // Rigid parts give way in contacts and pins.
  Eigen::VectorXd Imperfection(const Eigen::VectorXd& x) const override;
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
    return structure_.ObliqueSupports().empty() && !layout_.gives ? change.norm() : Counted(change).norm();
  }
  // Whether forces are told by small compliances alone.
  bool Gives() const override { return layout_.gives; }
  // The pattern is the same until the next set or pin.
  const Eigen::SparseMatrix<double>& TransposedJacobian(const Eigen::VectorXd& x) override;
  bool Mixed() const override { return structure_.Mixed(); }
  const Eigen::SparseMatrix<double>& MixedJacobian(const Eigen::VectorXd& x, const Eigen::VectorXd& from,
                                                   const Eigen::VectorXd& to) override;
  bool MayMoveFreely() const override;
  Eigen::MatrixXd FreeMotions(const Eigen::VectorXd& x, const Eigen::SparseMatrix<double>& transposed) override;

  // Until the next set or pin.
  const Frame* InFrame() override { return frame_.Get(); }

  std::vector<Limit> LimitsInReach(const Eigen::VectorXd& x, double reach, std::vector<Limit>* near) override {
    return limits_.InReach(x, reach, near);
  }
  bool BeyondReach(const Eigen::VectorXd& x) const override { return limits_.BeyondReach(x); }
  bool IsOfRate(const Limit& limit) const override { return limits_.RuleOf(limit).OfRate(); }
  double RoundingOf(const Limit& limit, double of_forces) const override;
  double UnitOf(const Limit& limit) const override { return limits_.RuleOf(limit).unit; }
  double Value(const Limit& limit, const Eigen::VectorXd& x) const override { return limits_.Value(limit, x); }
  Eigen::VectorXd Gradient(const Limit& limit, const Eigen::VectorXd& x) const override {
    return limits_.Gradient(limit, x, NumUnknowns());
  }
  Jet ValueAlong(const Limit& limit, const Eigen::VectorXd& x, const Eigen::VectorXd& first,
                 const Eigen::VectorXd& second) const override {
    return limits_.ValueAlong(limit, x, first, second);
  }
  // The force that moving supports and obstacles exert along their motion, along such a curve: their work is its
  // integral over s.
  Jet DrivingForceAlong(const Eigen::VectorXd& x, const Eigen::VectorXd& first, const Eigen::VectorXd& second) const;
  Eigen::VectorXd SecondDerivative(const Eigen::VectorXd& x, const Eigen::VectorXd& dx) override;

 private:
  const RigidModes& FreeModes() const;
  void SetLayout(const std::vector<Limit>& active, bool load_factor_fixed);

  const Structure& structure_;
  LawsInModes laws_;
  ModeLimits limits_;
  FixedModeLayout layout_;
  FixedModeJacobian jacobian_;
  FixedModeFrame frame_;
  double residual_unit_ = 1.0;  // the largest
  double load_factor_ = 0.0;    // where it is fixed
  Eigen::SparseMatrix<double> tangent_;
  std::map<int, double> moved_forces_;  // by law that the modes hold where it has moved: see SetModesFrom()
  mutable std::optional<const RigidModes> free_modes_;  // made where it is asked for
};

}  // namespace contact_path

#endif  // CONTACT_PATH_EQUATIONS_FIXED_MODE_SYSTEM_H_
