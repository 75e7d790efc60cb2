#include "contact_path/branch/rate_problem.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <utility>

#include "contact_path/linear/bordered_solver.h"
#include "contact_path/tolerances.h"

namespace contact_path {

RateProblem::RateProblem(const Structure& structure, const Laws& laws, const PathPoint& point, const Modes& modes,
                         const std::vector<int>& weakly_active, const Eigen::VectorXd& arrival)
    : laws_(laws), point_(point), weakly_active_(weakly_active) {
  HeldBySprings held(structure, laws, point, modes, weakly_active);
  ports_ = held.Ports();
  springs_ = held.Springs();
  FixedModeSystem& system = held.system();
  const Eigen::Index nd = system.NumDofs();
  free_ =
      held.Rates(system.FreeMotions(held.x(), Eigen::SparseMatrix<double>(system.TransposedJacobian(held.x()))), 0.0);
  BorderedSolver solver;
  // Springs among unknowns that elements do not couple have places of their own in the matrix.
  if (!solver.Factorize(held.TransposedJacobian(1.0), Eigen::VectorXd::Unit(system.NumUnknowns(), nd),
                        held.couples() ? nullptr : system.InFrame()) ||
      solver.DeterminantSign() == 0)
    return;

  Eigen::MatrixXd motions(nd, springs_.size() + 1);
  motions.col(0) = solver.Solve(Eigen::VectorXd::Zero(system.NumEquations()), 1.0).head(nd);
  for (Eigen::Index first = 0, count = 0; first < springs_.size(); first += count) {
    const LawDofs& dofs = held.LawOf(first).dofs;
    count = static_cast<Eigen::Index>(LawOf(first).NumPorts());
    Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(system.NumEquations(), count), moved;
    for (Eigen::Index p = 0; p < count; ++p)
      for (std::size_t a = 0; a < dofs.size(); ++a)
        forces(dofs[a], p) =
            springs_[first + p] * held.At(first + p).factor * held.At(first + p).gradient[static_cast<Eigen::Index>(a)];
    solver.SolveAll(forces, &moved);
    motions.middleCols(1 + first, count) = moved.topRows(nd);
  }
  if (!motions.allFinite()) return;
  motion_ = held.Rates(motions, 1.0);
  gram_ = motions.transpose() * motions;
  gram_(0, 0) += 1.0;
  along_ = motions.transpose() * arrival.head(nd);
  along_[0] += arrival[nd];
  regular_ = true;
}

Eigen::MatrixXd RateProblem::Equations(const States& states) const {
  const Eigen::Index columns = motion_.cols();
  Eigen::MatrixXd equations(springs_.size(), columns);
  // The force of a port, over the stiffness of its spring, is the whole force less that of its spring.
  const auto force = [&](Eigen::Index port) {
    Eigen::RowVectorXd row = -motion_.row(port);
    row[1 + port] += 1.0;
    return row;
  };
  for (Eigen::Index port = 0; port < springs_.size(); ++port) {
    const PortRule& rule = RuleOf(states, port);
    const Eigen::Index first = ports_[static_cast<std::size_t>(port)].first;
    if (!rule.Holds())
      equations.row(port) = force(port);
    else
      equations.row(port) = motion_.row(port);
    if (rule.Holds() && rule.compliance != 0.0) equations.row(port) += rule.compliance * springs_[port] * force(port);
    if (rule.Follows()) equations.row(port) -= rule.ratio * (springs_[first] / springs_[port]) * force(first);
  }
  return equations;
}

bool RateProblem::LeavesRigidMotion(const States& states) const {
  if (free_.cols() == 0) return false;
  Eigen::MatrixXd held = Eigen::MatrixXd::Zero(free_.rows(), free_.cols());
  for (Eigen::Index port = 0; port < springs_.size(); ++port)
    if (RuleOf(states, port).Holds()) held.row(port) = free_.row(port);
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
  rates.force = springs_.cwiseProduct(z.tail(springs_.size()) - rates.motion);
  return rates;
}

std::optional<Limit> RateProblem::Broken(const States& states, const CondensedRates& rates, double sign,
                                         const ActiveSetTolerance& active, double tolerance,
                                         std::vector<Limit>* all) const {
  double force = 1.0;  // largest rate of a force, in the unit of its law
  for (Eigen::Index port = 0; port < springs_.size(); ++port)
    force = std::max(force, 1.0 + std::abs(rates.force[port]) / LawOf(port).ForceUnit());
  std::optional<Limit> first;
  Eigen::Index first_port = 0;
  for (const int law : weakly_active_) {
    const auto i = static_cast<std::size_t>(law);
    const PortReals forces = laws_.Of(point_.forces, i);
    for (const LimitRule& rule : laws_[i].In(states[i]).limits) {
      if (rule.OfPiece()) continue;
      double value = 0.0, rate = 0.0;
      if (rule.OfForces()) {
        for (std::size_t p = 0; p < laws_[i].NumPorts(); ++p) {
          value += rule.weights[p] * forces[p];
          rate += rule.weights[p] * rates.force[first_port + static_cast<Eigen::Index>(p)];
        }
        if (value > active.ForceOf(rule.unit)) continue;
      } else {
        const Eigen::Index port = first_port + static_cast<Eigen::Index>(rule.port);
        rate = rule.sign * (rates.motion[port] + rule.compliance * rates.force[port]);
      }
      if (sign * rate >= -tolerance * (rule.OfForces() ? force * rule.unit : 1.0)) continue;
      const Limit broken = {law, rule.id};
      if (all == nullptr) return broken;
      if (!first) first = broken;
      all->push_back(broken);
    }
    first_port += static_cast<Eigen::Index>(laws_[i].NumPorts());
  }
  return first;
}

}  // namespace contact_path
