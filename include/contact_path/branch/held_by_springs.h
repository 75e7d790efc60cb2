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

  // A port of the weakly active laws, all of which are numbered in their order.
  struct Port {
    std::size_t law, of_law;  // among the weakly active ones, and among the ports of the law
    Eigen::Index first;       // number of the first port of the law
  };
  const std::vector<Port>& Ports() const { return ports_; }
  const PortsAt& LawOf(Eigen::Index port) const { return laws_[ports_[static_cast<std::size_t>(port)].law]; }
  const PortAt& At(Eigen::Index port) const { return LawOf(port)[ports_[static_cast<std::size_t>(port)].of_law]; }
  // Of the motions of the ports: rows; by columns of du, with ds along the first of them.
  Eigen::MatrixXd Rates(const Eigen::MatrixXd& du, double ds) const;
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
  std::vector<PortsAt> laws_;  // by weakly active law
  std::vector<Port> ports_;
  Eigen::VectorXd springs_;
  Eigen::SparseMatrix<double> without_, of_springs_;
  bool couples_ = false;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_HELD_BY_SPRINGS_H_
