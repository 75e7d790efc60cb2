// The rate equations at an event, with springs in place of the laws that may change their modes.
#ifndef CONTACT_PATH_BRANCH_HELD_BY_SPRINGS_H_
#define CONTACT_PATH_BRANCH_HELD_BY_SPRINGS_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cstddef>
#include <vector>

#include "contact_path/equations/fixed_mode_system.h"
#include "contact_path/law/laws.h"
#include "contact_path/law/ports.h"
#include "contact_path/structure/structure.h"

namespace contact_path {

// A structure that only weakly active laws support can be solved for, too, where springs hold their ports.
class HeldBySprings {
 public:
  // modes: by law; those of the weakly active ones tell their pieces alone. structure and laws must outlive this.
  HeldBySprings(const Structure& structure, const Laws& laws, const PathPoint& point, const Modes& modes,
                const std::vector<int>& weakly_active);

  // Ports of the weakly active laws, in their order.
  Eigen::Index NumPorts() const { return springs_.size(); }
  Eigen::Index FirstPort(std::size_t k) const { return first_port_[k]; }
  const PortsAt& Ports(std::size_t k) const { return ports_[k]; }
  // By port: scaled stiffness of its spring.
  const Eigen::VectorXd& Springs() const { return springs_; }

  // The laws that are not weakly active in their modes, the others idle.
  FixedModeSystem& system() { return system_; }
  const FixedModeSystem& system() const { return system_; }
  const Eigen::VectorXd& x() const { return x_; }
  // Of the system, the forces of the weakly active laws and a share of the springs: unknowns x equations, compressed.
  Eigen::SparseMatrix<double> TransposedJacobian(double share) const;
  // Whether springs couple unknowns that the system need not couple.
  bool couples() const { return couples_; }

 private:
  FixedModeSystem system_;
  Eigen::VectorXd x_;
  std::vector<PortsAt> ports_;  // by weakly active law
  std::vector<Eigen::Index> first_port_;
  Eigen::VectorXd springs_;
  Eigen::SparseMatrix<double> without_, of_springs_;
  bool couples_ = false;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_HELD_BY_SPRINGS_H_
