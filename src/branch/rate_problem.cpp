#include "contact_path/branch/rate_problem.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <utility>

#include "contact_path/branch/held_by_springs.h"
#include "contact_path/linear/bordered_solver.h"
#include "contact_path/tolerances.h"

namespace contact_path {

RateProblem::RateProblem(const Structure& structure, const Laws& laws, const PathPoint& point, const Modes& modes,
                         const std::vector<int>& weakly_active, const Eigen::VectorXd& arrival)
    : laws_(laws), point_(point), weakly_active_(weakly_active) {
  HeldBySprings held(structure, laws, point, modes, weakly_active);
  num_ports_ = held.NumPorts();
  springs_ = held.Springs();
  FixedModeSystem& system = held.system();
  const Eigen::Index nd = system.NumDofs();
  const Eigen::MatrixXd modes_of_parts =
      system.FreeMotions(held.x(), Eigen::SparseMatrix<double>(system.TransposedJacobian(held.x())));
  free_.resize(num_ports_, modes_of_parts.cols());
  for (std::size_t k = 0; k < weakly_active_.size(); ++k) {
    const PortsAt& at = held.Ports(k);
    first_port_.push_back(held.FirstPort(k));
    for (std::size_t p = 0; p < laws[static_cast<std::size_t>(weakly_active_[k])].NumPorts(); ++p)
      for (Eigen::Index j = 0; j < modes_of_parts.cols(); ++j)
        free_(first_port_[k] + static_cast<Eigen::Index>(p), j) = at.Rate(at[p].gradient, modes_of_parts.col(j), 0.0);
  }
  BorderedSolver solver;
  // Springs among unknowns that elements do not couple have places of their own in the matrix.
  if (!solver.Factorize(held.TransposedJacobian(1.0), Eigen::VectorXd::Unit(system.NumUnknowns(), nd),
                        held.couples() ? nullptr : system.InFrame()) ||
      solver.DeterminantSign() == 0)
    return;

  Eigen::MatrixXd motions(nd, num_ports_ + 1);
  motions.col(0) = solver.Solve(Eigen::VectorXd::Zero(system.NumEquations()), 1.0).head(nd);
  for (std::size_t k = 0; k < weakly_active_.size(); ++k) {
    const PortsAt& at = held.Ports(k);
    const auto count = static_cast<Eigen::Index>(laws[static_cast<std::size_t>(weakly_active_[k])].NumPorts());
    Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(system.NumEquations(), count), moved;
    for (Eigen::Index p = 0; p < count; ++p)
      for (std::size_t a = 0; a < at.dofs.size(); ++a)
        forces(at.dofs[a], p) = springs_[first_port_[k] + p] * at[static_cast<std::size_t>(p)].factor *
                                at[static_cast<std::size_t>(p)].gradient[static_cast<Eigen::Index>(a)];
    solver.SolveAll(forces, &moved);
    motions.middleCols(1 + first_port_[k], count) = moved.topRows(nd);
  }
  if (!motions.allFinite()) return;
  motion_.resize(num_ports_, motions.cols());
  for (std::size_t k = 0; k < weakly_active_.size(); ++k) {
    const auto i = static_cast<std::size_t>(weakly_active_[k]);
    const PortsAt& at = held.Ports(k);
    for (std::size_t p = 0; p < laws[i].NumPorts(); ++p) {
      const Eigen::Index row = first_port_[k] + static_cast<Eigen::Index>(p);
      for (Eigen::Index j = 0; j < motions.cols(); ++j)
        motion_(row, j) = at.Rate(at[p].gradient, motions.col(j), j == 0 ? 1.0 : 0.0);
    }
  }
  gram_ = motions.transpose() * motions;
  gram_(0, 0) += 1.0;
  along_ = motions.transpose() * arrival.head(nd);
  along_[0] += arrival[nd];
  regular_ = true;
}

Eigen::MatrixXd RateProblem::Equations(const States& states) const {
  const Eigen::Index columns = motion_.cols();
  Eigen::MatrixXd equations(num_ports_, columns);
  // The force of a port, over the stiffness of its spring, is the whole force less that of its spring.
  const auto force = [&](Eigen::Index port) {
    Eigen::RowVectorXd row = -motion_.row(port);
    row[1 + port] += 1.0;
    return row;
  };
  for (std::size_t k = 0; k < weakly_active_.size(); ++k) {
    const StateRule& state = StateIn(states, k);
    const Eigen::Index last = k + 1 < first_port_.size() ? first_port_[k + 1] : num_ports_;
    for (Eigen::Index port = first_port_[k]; port < last; ++port) {
      const PortRule& rule = state.ports[static_cast<std::size_t>(port - first_port_[k])];
      if (!rule.Holds())
        equations.row(port) = force(port);
      else
        equations.row(port) = motion_.row(port);
      if (rule.Holds() && rule.compliance != 0.0) equations.row(port) += rule.compliance * springs_[port] * force(port);
      if (rule.Follows())
        equations.row(port) -= rule.ratio * (springs_[first_port_[k]] / springs_[port]) * force(first_port_[k]);
    }
  }
  return equations;
}

bool RateProblem::LeavesRigidMotion(const States& states) const {
  if (free_.cols() == 0) return false;
  Eigen::MatrixXd held = Eigen::MatrixXd::Zero(free_.rows(), free_.cols());
  for (std::size_t k = 0; k < weakly_active_.size(); ++k) {
    const StateRule& state = StateIn(states, k);
    const Eigen::Index last = k + 1 < first_port_.size() ? first_port_[k + 1] : num_ports_;
    for (Eigen::Index port = first_port_[k]; port < last; ++port)
      if (state.ports[static_cast<std::size_t>(port - first_port_[k])].Holds()) held.row(port) = free_.row(port);
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(held);
  qr.setThreshold(tolerances::kDependent);
  return qr.rank() < free_.cols();
}

std::optional<CondensedRates> RateProblem::Rates(const States& states) const {
  if (LeavesRigidMotion(states)) return std::nullopt;
  const Eigen::MatrixXd equations = Equations(states);
  // Nearly always they are not orthogonal to the arrival.
  Eigen::MatrixXd square(equations.cols(), equations.cols());
  square << equations, along_.transpose();
  const Eigen::PartialPivLU<Eigen::MatrixXd> bordered(square);
  Eigen::VectorXd z;
  if (bordered.rcond() > tolerances::kDependent) {
    z = bordered.solve(Eigen::VectorXd::Unit(square.cols(), square.cols() - 1));
  } else {
    Eigen::FullPivLU<Eigen::MatrixXd> lu(equations);
    lu.setThreshold(tolerances::kDependent);
    if (lu.dimensionOfKernel() != 1) return std::nullopt;
    z = lu.kernel();
  }
  const double norm = std::sqrt(z.dot(gram_ * z));
  if (!(norm > 0.0) || !std::isfinite(norm)) return std::nullopt;
  z /= norm;
  CondensedRates rates;
  rates.load = z[0];
  rates.motion = motion_ * z;
  rates.force = springs_.cwiseProduct(z.tail(num_ports_) - rates.motion);
  return rates;
}

std::optional<Limit> RateProblem::Broken(const States& states, const CondensedRates& rates, double sign,
                                         const ActiveSetTolerance& active, double tolerance,
                                         std::vector<Limit>* all) const {
  double force = 1.0;  // largest rate of a force, in the unit of its law
  for (std::size_t k = 0; k < weakly_active_.size(); ++k) {
    const Law& law = laws_[static_cast<std::size_t>(weakly_active_[k])];
    const auto forces = rates.force.segment(first_port_[k], static_cast<Eigen::Index>(law.NumPorts()));
    force = std::max(force, 1.0 + forces.lpNorm<Eigen::Infinity>() / law.ForceUnit());
  }
  std::optional<Limit> first;
  for (std::size_t k = 0; k < weakly_active_.size(); ++k) {
    const StateRule& state = StateIn(states, k);
    const auto i = static_cast<std::size_t>(weakly_active_[k]);
    const PortReals forces = laws_.Of(point_.forces, i);
    for (const LimitRule& rule : state.limits) {
      if (rule.OfPiece()) continue;
      double value = 0.0, rate = 0.0;
      if (rule.OfForces()) {
        for (std::size_t p = 0; p < laws_[i].NumPorts(); ++p) {
          value += rule.weights[p] * forces[p];
          rate += rule.weights[p] * rates.force[first_port_[k] + static_cast<Eigen::Index>(p)];
        }
        if (value > active.force * rule.unit) continue;
      } else {
        const Eigen::Index port = first_port_[k] + static_cast<Eigen::Index>(rule.port);
        rate = rule.sign * (rates.motion[port] + rule.compliance * rates.force[port]);
      }
      if (sign * rate >= -tolerance * (rule.OfForces() ? force * rule.unit : 1.0)) continue;
      const Limit broken = {static_cast<int>(i), rule.id};
      if (all == nullptr) return broken;
      if (!first) first = broken;
      all->push_back(broken);
    }
  }
  return first;
}

}  // namespace contact_path
