#include "contact_path/branch/held_by_springs.h"

#include <algorithm>
#include <cmath>

namespace contact_path {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

// Scaled stiffness of the spring of a port: of the order of the structure's, so that neither is lost in rounding, and
// of a port that gives way by less the mean, by its logarithm, of that and of the port's own stiffness.
double SpringOf(const Law& law, std::size_t port) {
  for (int state = 0; state < law.NumStates(); ++state)
    if (const PortRule& rule = law.In(state).ports[port]; rule.Holds() && rule.compliance > 0.0)
      return std::max(1.0, 1.0 / std::sqrt(rule.compliance));
  return 1.0;
}

// A force stiffness . motion along a port with this gradient. Transposed, nd components before the load factor.
void AddSpring(const LawDofs& dofs, const LawVector& gradient, double stiffness, Eigen::Index nd, Triplets* entries) {
  const auto m = static_cast<Eigen::Index>(dofs.size());
  for (Eigen::Index a = 0; a < m; ++a) {
    const int column = dofs[static_cast<std::size_t>(a)];
    if (gradient[a] == 0.0) continue;
    if (gradient[m] != 0.0) entries->emplace_back(nd, column, stiffness * gradient[a] * gradient[m]);
    for (Eigen::Index b = 0; b < m; ++b)
      if (gradient[b] != 0.0)
        entries->emplace_back(dofs[static_cast<std::size_t>(b)], column, stiffness * gradient[a] * gradient[b]);
  }
}

// The change of the forces of the ports by curvature.
void AddCurvature(const PortsAt& at, const PortReals& forces, Eigen::Index nd, Triplets* entries) {
  const LawMatrix change = at.ForceChange(forces);
  const auto m = static_cast<Eigen::Index>(at.dofs.size());
  for (Eigen::Index a = 0; a < m; ++a)
    for (Eigen::Index b = 0; b <= m; ++b)
      entries->emplace_back(b < m ? at.dofs[static_cast<std::size_t>(b)] : nd, at.dofs[static_cast<std::size_t>(a)],
                            -change(b, a));
}

}  // namespace

HeldBySprings::HeldBySprings(const Structure& structure, const Laws& laws, const PathPoint& point, const Modes& modes,
                             const std::vector<int>& weakly_active)
    : system_(structure, laws), laws_(weakly_active.size()) {
  Modes idle = modes;
  for (std::size_t k = 0; k < weakly_active.size(); ++k) {
    const auto i = static_cast<std::size_t>(weakly_active[k]);
    for (idle[i].state = 0; !laws[i].In(idle[i]).idle; ++idle[i].state) {
    }
    const auto first = static_cast<Eigen::Index>(ports_.size());
    for (std::size_t p = 0; p < laws[i].NumPorts(); ++p) ports_.push_back({k, p, first});
  }
  system_.SetModes(idle);
  x_ = system_.Pack(point);
  without_ = system_.TransposedJacobian(x_);
  springs_.resize(static_cast<Eigen::Index>(ports_.size()));
  Eigen::Index port = 0;
  Triplets springs, curvature;
  for (std::size_t k = 0; k < weakly_active.size(); ++k) {
    const auto i = static_cast<std::size_t>(weakly_active[k]);
    const Law& law = laws[i];
    PortsAt& at = laws_[k];
    law.Evaluate(point.u, point.s, modes[i].piece, {}, &at);
    for (std::size_t p = 0; p < law.NumPorts(); ++p, ++port) {
      springs_[port] = SpringOf(law, p);
      AddSpring(at.dofs, at[p].gradient, springs_[port] * at[p].factor, system_.NumDofs(), &springs);
    }
    if (law.Curved()) AddCurvature(at, laws.Of(point.forces, i), system_.NumDofs(), &curvature);
    couples_ = couples_ || law.Couples();
  }
  of_springs_.resize(without_.rows(), without_.cols());
  of_springs_.setFromTriplets(springs.begin(), springs.end());
  if (curvature.empty()) return;
  Eigen::SparseMatrix<double> change(without_.rows(), without_.cols());
  change.setFromTriplets(curvature.begin(), curvature.end());
  without_ += change;
}

Eigen::MatrixXd HeldBySprings::Rates(const Eigen::MatrixXd& du, double ds) const {
  Eigen::MatrixXd rates(springs_.size(), du.cols());
  for (Eigen::Index port = 0; port < rates.rows(); ++port)
    for (Eigen::Index j = 0; j < rates.cols(); ++j)
      rates(port, j) = LawOf(port).Rate(At(port).gradient, du.col(j), j == 0 ? ds : 0.0);
  return rates;
}

Eigen::SparseMatrix<double> HeldBySprings::TransposedJacobian(double share) const {
  return without_ + share * of_springs_;
}

}  // namespace contact_path
