// The constraints of the increment problem, with their first and second derivatives.
#ifndef CONTACT_PATH_MPEC_INCREMENT_CONSTRAINTS_H_
#define CONTACT_PATH_MPEC_INCREMENT_CONSTRAINTS_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "contact_path/mpec/increment_slots.h"
#include "contact_path/mpec/nonlinear_program.h"

namespace contact_path {

// Where ports that are held give way, gap and slip are those of the held ports: gap - reference + compliance r_n, and
// xi - reference + compliance r_t. A law that always acts, of one or two ports, has such a motion = 0 for each, with
// forces of any sign. By the total law of friction, xi - xi_0 at the end of the increment takes the place of du_t.
class IncrementConstraints {
 public:
  // Both must outlive this.
  IncrementConstraints(const Structure& structure, const IncrementSlots& slots)
      : structure_(structure), slots_(slots), tangent_(structure.TangentPattern()) {}

  Eigen::VectorXd Values(const Eigen::VectorXd& x) const;
  MatrixEntries Jacobian(const Eigen::VectorXd& x) const;
  // Lower triangle of the sum of multipliers times Hessians, with `diagonal` added to the diagonal of y.
  MatrixEntries Hessian(const Eigen::VectorXd& x, double diagonal, const Eigen::VectorXd& multipliers) const;

 private:
  using Slot = IncrementSlots::Slot;
  using Support = IncrementSlots::Support;

  // Entries of the Jacobian: of the first port, its gap and product; of what always acts; of friction; of curvature.
  void AddGap(const Slot& slot, const PortsAt& at, const Eigen::VectorXd& x, MatrixEntries* entries) const;
  void AddHeld(const Slot& slot, const PortsAt& at, MatrixEntries* entries) const;
  void AddFriction(const Slot& slot, const PortsAt& at, const Eigen::VectorXd& x, MatrixEntries* entries) const;
  void AddTurns(const Slot& slot, const PortsAt& at, const Eigen::VectorXd& x, MatrixEntries* entries) const;
  // What the curvature of a law adds to the Hessian.
  void AddCurvature(const Slot& slot, const PortsAt& at, const Eigen::VectorXd& x, const Eigen::VectorXd& multipliers,
                    MatrixEntries* entries) const;

  const Structure& structure_;
  const IncrementSlots& slots_;
  mutable Eigen::SparseMatrix<double> tangent_;  // scratch
};

}  // namespace contact_path

#endif  // CONTACT_PATH_MPEC_INCREMENT_CONSTRAINTS_H_
