#include "contact_path/stability/held_stiffness.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "contact_path/linear/generic_vector.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr Eigen::Index kModes = 8;     // of the softest motions, among which one whose energy falls is looked for
constexpr int kInverseIterations = 6;  // each multiplies the share of a mode by the ratio of two eigenvalues

}  // namespace

bool HeldStiffness::Set(Eigen::Index motions, const Eigen::SparseMatrix<double>& transposed, const Frame* frame,
                        const Eigen::MatrixXd& free, bool unique) {
  nd_ = motions;
  BuildSaddle(transposed, frame, free);
  const Eigen::Index constraints = saddle_.rows() - nd_;
  if (!factors_.Factorize(saddle_, constraints) &&
      (unique || !symmetric_ || !factors_.Factorize(saddle_, constraints, true)))
    return false;
  // Each equation of motion is a constraint, whose multiplier makes one eigenvalue negative.
  negative_ = factors_.NegativeEigenvalues() - static_cast<Eigen::Index>(places_.size());
  if (negative_ < 0) return false;
  sign_ = negative_ % 2 == 0 ? 1 : -1;
  if (symmetric_) return true;
  transposed_ = transposed;
  if (!unsymmetric_.FactorizeRegular(transposed, Eigen::VectorXd::Unit(transposed.rows(), nd_))) return false;
  sign_ = unsymmetric_.DeterminantSign() * (places_.size() % 2 == 0 ? 1 : -1);
  return true;
}

void HeldStiffness::BuildSaddle(const Eigen::SparseMatrix<double>& transposed, const Frame* frame,
                                const Eigen::MatrixXd& free) {
  const Eigen::Index nd = nd_, reactions = transposed.rows() - nd - 1;
  std::vector<Eigen::Triplet<double>> entries, forces, stiffness;
  Eigen::Index size = nd + reactions;
  places_.resize(static_cast<std::size_t>(reactions));
  std::iota(places_.begin(), places_.end(), static_cast<int>(nd));
  if (frame != nullptr) {
    size = frame->size - 1;
    std::copy_n(frame->unknowns.begin() + nd + 1, reactions, places_.begin());
    std::vector<bool> acts(static_cast<std::size_t>(frame->size), false);
    for (const int place : places_) acts[static_cast<std::size_t>(place)] = true;
    for (int equation = 0; equation < nd; ++equation)
      for (int at = frame->starts[static_cast<std::size_t>(equation)];
           at < frame->starts[static_cast<std::size_t>(equation) + 1]; ++at)
        if (const int place = frame->entries[static_cast<std::size_t>(at)]; place >= nd && place < size) {
          entries.emplace_back(equation, place, 0.0);
          entries.emplace_back(place, equation, 0.0);
        }
    for (int place = static_cast<int>(nd); place < size; ++place)
      entries.emplace_back(place, place, acts[static_cast<std::size_t>(place)] ? 0.0 : 1.0);
  }
  const Eigen::SparseMatrix<double> tangent = transposed.topLeftCorner(nd, nd);
  stiffness_ = 0.5 * (tangent + Eigen::SparseMatrix<double>(tangent.transpose()));
  double largest = 0.0, skew = 0.0;
  for (Eigen::Index equation = 0; equation < nd; ++equation)
    for (Eigen::SparseMatrix<double>::InnerIterator it(transposed, equation); it; ++it) {
      if (it.row() < nd) {
        largest = std::max(largest, std::abs(it.value()));
        skew = std::max(skew, std::abs(it.value() - stiffness_.coeff(it.row(), equation)));
      } else if (it.row() > nd && it.value() != 0.0) {
        const auto reaction = static_cast<int>(it.row() - 1 - nd), place = places_[static_cast<std::size_t>(reaction)];
        entries.emplace_back(static_cast<int>(equation), place, it.value());
        entries.emplace_back(place, static_cast<int>(equation), it.value());
        forces.emplace_back(static_cast<int>(equation), reaction, -it.value());
      }
    }
  for (Eigen::Index column = 0; column < nd; ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator it(stiffness_, column); it; ++it)
      entries.emplace_back(static_cast<int>(it.row()), static_cast<int>(column), it.value());
  if (free.cols() > 0) {
    // A spring holds one component of each direction, and takes no part in motions without it.
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> places(free.transpose());
    for (Eigen::Index j = 0; j < free.cols(); ++j) {
      const int place = places.colsPermutation().indices()[j];
      entries.emplace_back(place, place, 1.0 + largest);
    }
  }
  forces_.resize(nd, reactions);
  forces_.setFromTriplets(forces.begin(), forces.end());
  symmetric_ = skew <= tolerances::kEqual * largest && ForcesActAlongMotions(transposed);
  // What a port that gives way holds is stiffness.
  for (Eigen::Index reaction = 0; reaction < reactions; ++reaction) {
    const double compliance = transposed.coeff(nd + 1 + reaction, nd + reaction);
    if (compliance == 0.0) continue;
    const int place = places_[static_cast<std::size_t>(reaction)];
    entries.emplace_back(place, place, -compliance);
    for (Eigen::SparseMatrix<double>::InnerIterator a(forces_, reaction); a; ++a)
      for (Eigen::SparseMatrix<double>::InnerIterator b(forces_, reaction); b; ++b)
        stiffness.emplace_back(static_cast<int>(a.row()), static_cast<int>(b.row()),
                               a.value() * b.value() / compliance);
  }
  if (!stiffness.empty()) {
    Eigen::SparseMatrix<double> of_ports(nd, nd);
    of_ports.setFromTriplets(stiffness.begin(), stiffness.end());
    stiffness_ += of_ports;
  }
  saddle_.resize(size, size);
  saddle_.setFromTriplets(entries.begin(), entries.end());
}

bool HeldStiffness::ForcesActAlongMotions(const Eigen::SparseMatrix<double>& transposed) const {
  for (Eigen::Index reaction = 0; reaction < forces_.cols(); ++reaction) {
    double motion = 0.0, force = forces_.col(reaction).squaredNorm(), work = 0.0;
    for (Eigen::SparseMatrix<double>::InnerIterator it(transposed, nd_ + reaction); it && it.row() < nd_; ++it) {
      motion += it.value() * it.value();
      work += it.value() * forces_.coeff(it.row(), reaction);
    }
    if (motion > 0.0 && work * work < (1.0 - tolerances::kEqual) * motion * force) return false;
    if (motion > 0.0 && force == 0.0) return false;
  }
  return true;
}

Eigen::MatrixXd HeldStiffness::Solve(const Eigen::MatrixXd& right) const {
  const auto reactions = static_cast<Eigen::Index>(places_.size());
  Eigen::MatrixXd unknowns(nd_ + reactions, right.cols());
  if (!symmetric_) {
    Eigen::MatrixXd with_load;
    unsymmetric_.SolveAll(right, &with_load);
    unknowns << with_load.topRows(nd_), with_load.bottomRows(reactions);
    return unknowns;
  }
  Eigen::MatrixXd in_saddle = Eigen::MatrixXd::Zero(saddle_.rows(), right.cols());
  in_saddle.topRows(nd_) = right.topRows(nd_);
  for (Eigen::Index force = nd_; force < right.rows(); ++force) in_saddle.row(PlaceOf(force)) = right.row(force);
  factors_.Solve(&in_saddle);
  unknowns.topRows(nd_) = in_saddle.topRows(nd_);
  for (Eigen::Index force = nd_; force < right.rows(); ++force) unknowns.row(force) = in_saddle.row(PlaceOf(force));
  return unknowns;
}

Eigen::MatrixXd HeldStiffness::Responses(const Eigen::VectorXd& f, const std::vector<Slip>& slips) const {
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(nd_ + static_cast<Eigen::Index>(places_.size()),
                                                1 + static_cast<Eigen::Index>(slips.size()));
  right.col(0).head(nd_) = f;
  for (std::size_t k = 0; k < slips.size(); ++k) {
    const auto [force, length] = slips[k];
    double& of_slip = right(force, static_cast<Eigen::Index>(k) + 1);
    of_slip = -length;
    if (symmetric_) continue;
    // The equations of motion are by grad xi, the columns of forces by c grad xi, slip by c dxi.
    double by_row = 0.0, by_force = 0.0;
    for (Eigen::SparseMatrix<double>::InnerIterator it(transposed_, force); it && it.row() < nd_; ++it) {
      by_row += it.value() * it.value();
      by_force += it.value() * forces_.coeff(it.row(), force - nd_);
    }
    of_slip = length * by_row / by_force;
  }
  const Eigen::MatrixXd responses = Solve(right);
  return responses.allFinite() ? responses : Eigen::MatrixXd();
}

Eigen::VectorXd HeldStiffness::Influence(const Eigen::VectorXd& weights) const {
  if (symmetric_) return Solve(weights).col(0).head(nd_);
  Eigen::VectorXd with_load = Eigen::VectorXd::Zero(transposed_.rows());
  with_load << weights.head(nd_), 0.0, weights.tail(weights.size() - nd_);
  return unsymmetric_.SolveTransposed(with_load).head(nd_);
}

double HeldStiffness::EnergyAt(Eigen::Index force, const Eigen::VectorXd& du) const {
  double stiffest = 0.0, squares = 0.0;
  for (Eigen::SparseMatrix<double>::InnerIterator dof(forces_, force - nd_); dof; ++dof) {
    squares += du[dof.row()] * du[dof.row()];
    for (Eigen::SparseMatrix<double>::InnerIterator it(saddle_, dof.row()); it && it.row() < nd_; ++it)
      stiffest = std::max(stiffest, std::abs(it.value()));
  }
  return stiffest * squares;
}

Eigen::VectorXd HeldStiffness::FallingMode(const Eigen::VectorXd& likely, const Eigen::VectorXd& f,
                                           double machine) const {
  const Eigen::Index nd = nd_, size = saddle_.rows();
  // Not more than there are motions that the laws admit: further columns of a basis would be none. What gives way
  // admits them.
  Eigen::Index rigid = 0;
  for (Eigen::Index k = nd; k < size; ++k) rigid += saddle_.coeff(k, k) == 0.0 ? 1 : 0;
  const Eigen::Index count = std::min(kModes, std::max(negative_, nd - rigid));
  Eigen::MatrixXd modes = Eigen::MatrixXd::Zero(size, count);
  for (Eigen::Index k = 0; k < count; ++k) modes.col(k).head(nd) = GenericVector(nd).array().pow(k + 1);
  if (likely.size() > 0) modes.col(0).head(nd) = likely;
  for (int i = 0; i < kInverseIterations; ++i) {
    factors_.Solve(&modes);
    if (!modes.allFinite()) return {};
    const Eigen::MatrixXd basis =
        Eigen::HouseholderQR<Eigen::MatrixXd>(modes.topRows(nd)).householderQ() * Eigen::MatrixXd::Identity(nd, count);
    const Eigen::VectorXd work = basis.transpose() * f;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(basis.transpose() * (stiffness_ * basis) +
                                                                machine * work * work.transpose());
    if (solver.eigenvalues()[0] < 0.0) return basis * solver.eigenvectors().col(0);
    modes.topRows(nd) = basis;
    modes.bottomRows(size - nd).setZero();
  }
  return {};
}

}  // namespace contact_path
