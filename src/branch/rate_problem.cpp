#include "contact_path/branch/rate_problem.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <utility>

#include "contact_path/linear/bordered_solver.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

// Scaled stiffness of the springs: of the order of the structure's, so that neither is lost in rounding. Their forces
// are part of the unknowns, and are taken out where reactions are wanted.
constexpr double kSpring = 1.0;

// A force stiffness . motion along a gap or xi with this gradient. matrix: transposed, nd components before the load
// factor.
void AddSpring(const PairDofs& dofs, const PairVector& gradient, double stiffness, Eigen::Index nd,
               Eigen::SparseMatrix<double>* matrix) {
  const auto m = static_cast<Eigen::Index>(dofs.size());
  for (Eigen::Index a = 0; a < m; ++a) {
    const int column = dofs[static_cast<std::size_t>(a)];
    if (gradient[a] == 0.0) continue;
    if (gradient[m] != 0.0) matrix->coeffRef(nd, column) += stiffness * gradient[a] * gradient[m];
    for (Eigen::Index b = 0; b < m; ++b)
      if (gradient[b] != 0.0)
        matrix->coeffRef(dofs[static_cast<std::size_t>(b)], column) += stiffness * gradient[a] * gradient[b];
  }
}

// The change of the force r_n grad u_n + r_t c grad xi by the curvature of the surface.
void AddCurvature(const Kinematics& at, double rn, double rt, Eigen::Index nd, Eigen::SparseMatrix<double>* matrix) {
  const PairMatrix change = at.ForceChange(rn, rt);
  const auto m = static_cast<Eigen::Index>(at.dofs.size());
  for (Eigen::Index a = 0; a < m; ++a)
    for (Eigen::Index b = 0; b <= m; ++b)
      matrix->coeffRef(b < m ? at.dofs[static_cast<std::size_t>(b)] : nd, at.dofs[static_cast<std::size_t>(a)]) -=
          change(b, a);
}

}  // namespace

RateProblem::RateProblem(const Structure& structure, const ContactPairs& contacts, const PathPoint& point,
                         const std::vector<ContactState>& states, const std::vector<int>& weakly_active,
                         const Eigen::VectorXd& arrival)
    : contacts_(contacts), point_(point), weakly_active_(weakly_active) {
  std::vector<ContactState> base = states;
  for (const int i : weakly_active_) base[static_cast<std::size_t>(i)] = ContactState::kOpen;
  FixedStateSystem system(structure, contacts);
  system.SetStates(base, Eigen::VectorXd::Zero(static_cast<Eigen::Index>(contacts.size())), point.patches);
  const Eigen::VectorXd x = system.Pack(point);
  const Eigen::Index nd = system.NumDofs();
  std::vector<Kinematics> kinematics(weakly_active_.size());
  Eigen::SparseMatrix<double> transposed = system.TransposedJacobian(x);
  const Eigen::MatrixXd modes = system.FreeMotions(x, transposed);
  gap_of_modes_.resize(static_cast<Eigen::Index>(weakly_active_.size()), modes.cols());
  slip_of_modes_.resize(gap_of_modes_.rows(), modes.cols());
  bool deformable = false;
  for (std::size_t k = 0; k < weakly_active_.size(); ++k) {
    const int i = weakly_active_[k];
    const ContactPair& pair = *contacts[static_cast<std::size_t>(i)];
    Kinematics& at = kinematics[k];
    pair.Evaluate(point.u, point.s, point.Patch(static_cast<std::size_t>(i)), 0.0, &at);
    for (Eigen::Index j = 0; j < modes.cols(); ++j) {
      gap_of_modes_(static_cast<Eigen::Index>(k), j) = at.Rate(at.gap_gradient, modes.col(j), 0.0);
      slip_of_modes_(static_cast<Eigen::Index>(k), j) = at.Rate(at.xi_gradient, modes.col(j), 0.0);
    }
    AddSpring(at.dofs, at.gap_gradient, kSpring, nd, &transposed);
    AddSpring(at.dofs, at.xi_gradient, kSpring * at.slip_factor, nd, &transposed);
    if (pair.Curved()) AddCurvature(at, point.rn[i], point.rt[i], nd, &transposed);
    deformable = deformable || pair.Deformable();
  }
  transposed.makeCompressed();
  BorderedSolver solver;
  // Springs between a node and a deformable surface have places of their own in the matrix.
  if (!solver.Factorize(transposed, Eigen::VectorXd::Unit(system.NumUnknowns(), nd),
                        deformable ? nullptr : system.InFrame()) ||
      solver.DeterminantSign() == 0)
    return;

  const auto count = static_cast<Eigen::Index>(weakly_active_.size());
  Eigen::MatrixXd motions(nd, 2 * count + 1);
  motions.col(0) = solver.Solve(Eigen::VectorXd::Zero(system.NumEquations()), 1.0).head(nd);
  Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(system.NumEquations(), 2), moved;
  for (Eigen::Index k = 0; k < count; ++k) {
    const Kinematics& at = kinematics[static_cast<std::size_t>(k)];
    const auto set = [&](double value) {
      for (std::size_t a = 0; a < at.dofs.size(); ++a) {
        forces(at.dofs[a], 0) = value * at.gap_gradient[static_cast<Eigen::Index>(a)];
        forces(at.dofs[a], 1) = value * at.slip_factor * at.xi_gradient[static_cast<Eigen::Index>(a)];
      }
    };
    set(1.0);
    solver.SolveAll(forces, &moved);
    motions.middleCols<2>(1 + 2 * k) = moved.topRows(nd);
    set(0.0);
  }
  if (!motions.allFinite()) return;
  gap_.resize(count, motions.cols());
  slip_.resize(count, motions.cols());
  slipped_.resize(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto i = static_cast<std::size_t>(weakly_active_[static_cast<std::size_t>(k)]);
    const ContactPair& pair = *contacts[i];
    const Kinematics& at = kinematics[static_cast<std::size_t>(k)];
    slipped_[k] = pair.Slipped(point.u, point.s, point.Patch(i));
    for (Eigen::Index j = 0; j < motions.cols(); ++j) {
      const double ds = j == 0 ? 1.0 : 0.0;
      gap_(k, j) = at.Rate(at.gap_gradient, motions.col(j), ds);
      slip_(k, j) = at.Rate(at.xi_gradient, motions.col(j), ds);
    }
  }
  gram_ = motions.transpose() * motions;
  gram_(0, 0) += 1.0;
  along_ = motions.transpose() * arrival.head(nd);
  along_[0] += arrival[nd];
  regular_ = true;
}

double RateProblem::Unit(Eigen::Index k) const {
  return contacts_[static_cast<std::size_t>(weakly_active_[static_cast<std::size_t>(k)])]->ForceUnit();
}

Eigen::MatrixXd RateProblem::Equations(const std::vector<ContactState>& states) const {
  const Eigen::Index count = gap_.rows(), columns = gap_.cols();
  // A reaction is the force less that of its spring.
  const auto reaction = [&](Eigen::Index column, const auto& rate) {
    Eigen::RowVectorXd row = -kSpring * rate;
    row[column] += 1.0;
    return row;
  };
  Eigen::MatrixXd equations(2 * count, columns);
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto i = static_cast<std::size_t>(weakly_active_[static_cast<std::size_t>(k)]);
    const Eigen::RowVectorXd rn = reaction(1 + 2 * k, gap_.row(k)), rt = reaction(2 + 2 * k, slip_.row(k));
    if (states[i] == ContactState::kOpen) {
      equations.row(2 * k) = rn;
      equations.row(2 * k + 1) = rt;
      continue;
    }
    equations.row(2 * k) = gap_.row(k);
    if (states[i] == ContactState::kStick)
      equations.row(2 * k + 1) = slip_.row(k);
    else
      equations.row(2 * k + 1) = rt - SlipRatio(states[i], contacts_[i]->Friction()) * rn;
  }
  return equations;
}

bool RateProblem::LeavesRigidMotion(const std::vector<ContactState>& states) const {
  const Eigen::Index modes = gap_of_modes_.cols();
  if (modes == 0) return false;
  Eigen::MatrixXd held = Eigen::MatrixXd::Zero(2 * gap_of_modes_.rows(), modes);
  for (Eigen::Index k = 0; k < gap_of_modes_.rows(); ++k) {
    const ContactState state = states[static_cast<std::size_t>(weakly_active_[static_cast<std::size_t>(k)])];
    if (state != ContactState::kOpen) held.row(2 * k) = gap_of_modes_.row(k);
    if (state == ContactState::kStick) held.row(2 * k + 1) = slip_of_modes_.row(k);
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(held);
  qr.setThreshold(tolerances::kDependent);
  return qr.rank() < modes;
}

std::optional<CondensedRates> RateProblem::Rates(const std::vector<ContactState>& states) const {
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
  const Eigen::Index count = gap_.rows();
  const double norm = std::sqrt(z.dot(gram_ * z));
  if (!(norm > 0.0) || !std::isfinite(norm)) return std::nullopt;
  z /= norm;
  CondensedRates rates;
  rates.load = z[0];
  rates.gap = gap_ * z;
  rates.slip = slip_ * z;
  rates.rn.resize(count);
  rates.rt.resize(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    rates.rn[k] = z[1 + 2 * k] - kSpring * rates.gap[k];
    rates.rt[k] = z[2 + 2 * k] - kSpring * rates.slip[k];
  }
  return rates;
}

std::optional<Constraint> RateProblem::Broken(const std::vector<ContactState>& states, const CondensedRates& rates,
                                              double sign, const ActiveSetTolerance& active, double tolerance,
                                              std::vector<Constraint>* all) const {
  double force = 1.0;  // largest rate of a reaction, in the unit of its contact
  for (Eigen::Index k = 0; k < rates.rn.size(); ++k)
    force = std::max(force, 1.0 + std::max(std::abs(rates.rn[k]), std::abs(rates.rt[k])) / Unit(k));
  std::optional<Constraint> first;
  const auto require = [&](int contact, Inequality inequality, double rate, double scale) {
    if (sign * rate >= -tolerance * scale) return;
    if (!first) first = Constraint{contact, inequality};
    if (all != nullptr) all->push_back({contact, inequality});
  };
  for (std::size_t k = 0; k < weakly_active_.size(); ++k) {
    const int contact = weakly_active_[k];
    const auto i = static_cast<std::size_t>(contact);
    const auto e = static_cast<Eigen::Index>(k), c = static_cast<Eigen::Index>(i);
    const double friction = contacts_[i]->Friction(), rn = point_.rn[c], rt = point_.rt[c];
    if (states[i] == ContactState::kOpen) {
      require(contact, Inequality::kGap, rates.gap[e], 1.0);
      continue;
    }
    const double unit = Unit(e);
    const double normal_unit = contacts_[i]->NormalForceUnit();
    if (rn <= active.force * normal_unit)
      require(contact, Inequality::kNormalReaction, rates.rn[e], force * normal_unit);
    if (states[i] == ContactState::kStick) {
      if (friction * rn + rt <= active.force * unit)
        require(contact, Inequality::kConePlus, friction * rates.rn[e] + rates.rt[e], force * unit);
      if (friction * rn - rt <= active.force * unit)
        require(contact, Inequality::kConeMinus, friction * rates.rn[e] - rates.rt[e], force * unit);
    } else if (Slips(states[i])) {
      const double sense = states[i] == ContactState::kSlipPlus ? 1.0 : -1.0;
      if (sense * slipped_[e] <= active.gap)
        require(contact, contacts_[i]->HasTotalLaw() ? Inequality::kTotalSlip : Inequality::kSlip,
                sense * rates.slip[e], 1.0);
    }
    if (first && all == nullptr) return first;
  }
  return first;
}

}  // namespace contact_path
