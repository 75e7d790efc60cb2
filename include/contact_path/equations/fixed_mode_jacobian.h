// The Jacobian of a fixed-mode system.
#ifndef CONTACT_PATH_EQUATIONS_FIXED_MODE_JACOBIAN_H_
#define CONTACT_PATH_EQUATIONS_FIXED_MODE_JACOBIAN_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "contact_path/equations/fixed_mode_layout.h"
#include "contact_path/equations/laws_in_modes.h"
#include "contact_path/equations/mode_limits.h"
#include "contact_path/structure/structure.h"

namespace contact_path {

// Its pattern is the same while the layout is.
class FixedModeJacobian {
 public:
  // All must outlive this.
  FixedModeJacobian(const Structure& structure, const LawsInModes& laws, const ModeLimits& limits,
                    const FixedModeLayout& layout)
      : structure_(structure), laws_(laws), limits_(limits), layout_(layout) {}

  // The layout has changed.
  void Reset() { transposed_.resize(0, 0); }
  // The transposed Jacobian at x, of the tangent of the structure there; until the next call.
  const Eigen::SparseMatrix<double>& At(const Eigen::VectorXd& x, const Eigen::SparseMatrix<double>& tangent);

 private:
  // Each calls emit(unknown, equation, value) for structural entries: those of a motion, those of the forces of a law
  // in the equations of equilibrium, and the change of these forces by curvature there.
  template <typename Emit>
  void ForEachMotionEntry(const MotionEquation& of, const PortsAt& at, Emit emit) const;
  template <typename Emit>
  void ForEachForceEntry(std::size_t law, const PortsAt& at, Emit emit) const;
  template <typename Emit>
  void ForEachCurvatureEntry(const PortsAt& at, const PortReals& forces, Emit emit) const;
  template <typename Emit>
  void ForEachConstantEntry(Emit emit) const;  // besides those of laws without curvature
  void Rebuild(const Eigen::SparseMatrix<double>& tangent);

  const Structure& structure_;
  const LawsInModes& laws_;
  const ModeLimits& limits_;
  const FixedModeLayout& layout_;
  Eigen::SparseMatrix<double> transposed_;
  Eigen::VectorXd constant_;  // values of transposed_ that do not change; kept where some laws are curved
};

}  // namespace contact_path

#endif  // CONTACT_PATH_EQUATIONS_FIXED_MODE_JACOBIAN_H_
