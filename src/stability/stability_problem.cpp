#include "contact_path/stability/stability_problem.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "contact_path/linear/generic_vector.h"
#include "contact_path/stability/slip_stability.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

constexpr Eigen::Index kModes = 8;     // of the softest motions, among which one whose energy falls is looked for
constexpr int kInverseIterations = 6;  // each multiplies the share of a mode by the ratio of two eigenvalues

}  // namespace

StabilityProblem::StabilityProblem(const Structure& structure, const Laws& laws)
    : structure_(structure), laws_(laws), system_(structure, laws) {}

void StabilityProblem::Set(const PathPoint& point, const Eigen::MatrixXd& null_directions) {
  Classify(point);
  const Eigen::VectorXd x = system_.Pack(point);
  const Eigen::SparseMatrix<double>& transposed = system_.TransposedJacobian(x);
  singular_ = null_directions.cols() > 0 && slips_.empty();
  null_ = null_directions;
  BuildSaddle(transposed);
  const Eigen::Index constraints = saddle_.rows() - structure_.NumDofs();
  // Forces that are not unique do not matter where nothing slides.
  regular_ = factors_.Factorize(saddle_, constraints) ||
             (slips_.empty() && symmetric_ && factors_.Factorize(saddle_, constraints, true));
  if (!regular_) return;
  // Each equation of motion is a constraint, whose multiplier makes one eigenvalue negative.
  negative_ = factors_.NegativeEigenvalues() - static_cast<Eigen::Index>(places_.size());
  regular_ = negative_ >= 0 && Condense(point, transposed);
}

bool StabilityProblem::IsSymmetric(const Modes& modes) const {
  for (std::size_t i = 0; i < modes.size(); ++i)
    if (!laws_[i].In(modes[i]).symmetric) return false;
  return true;
}

void StabilityProblem::Classify(const PathPoint& point) {
  Modes modes = point.modes;
  slips_.clear();
  covered_ = true;
  // Forces as the system numbers them, without the load factor.
  Eigen::Index next = structure_.NumDofs();
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const Law& law = laws_[i];
    const StateRule& state = law.In(modes[i]);
    if (state.idle) continue;
    covered_ = covered_ && !(law.Holonomic() && law.LargestRatio() > 0.0);
    modes[i].state = state.held;
    const StateRule& held = law.In(modes[i]);
    const Eigen::Index leading = next;
    for (std::size_t p = 0; p < law.NumPorts(); ++p) {
      if (!held.ports[p].Holds()) continue;
      if (state.ports[p].Follows())
        slips_.push_back({state.ports[p].ratio < 0.0 ? 1.0 : -1.0, std::abs(state.ports[p].ratio), leading, next});
      ++next;
    }
  }
  if (modes != system_.modes()) system_.SetModes(modes);
}

void StabilityProblem::BuildSaddle(const Eigen::SparseMatrix<double>& transposed) {
  const Eigen::Index nd = structure_.NumDofs(), reactions = transposed.rows() - nd - 1;
  std::vector<Eigen::Triplet<double>> entries, forces, stiffness;
  Eigen::Index size = nd + reactions;
  places_.resize(static_cast<std::size_t>(reactions));
  std::iota(places_.begin(), places_.end(), static_cast<int>(nd));
  if (const Frame* frame = system_.InFrame()) {
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
  double largest = 0.0, skew = 0.0;
  for (Eigen::Index equation = 0; equation < nd; ++equation) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(transposed, equation); it; ++it) {
      const Eigen::Index unknown = it.row();
      if (unknown < nd) {
        stiffness.emplace_back(static_cast<int>(equation), static_cast<int>(unknown), 0.5 * it.value());
        stiffness.emplace_back(static_cast<int>(unknown), static_cast<int>(equation), 0.5 * it.value());
        largest = std::max(largest, std::abs(it.value()));
      } else if (unknown > nd && it.value() != 0.0) {
        const Eigen::Index reaction = unknown - 1 - nd;
        const int place = places_[static_cast<std::size_t>(reaction)];
        entries.emplace_back(static_cast<int>(equation), place, it.value());
        entries.emplace_back(place, static_cast<int>(equation), it.value());
        forces.emplace_back(static_cast<int>(equation), static_cast<int>(reaction), -it.value());
      }
    }
  }
  stiffness_.resize(nd, nd);
  stiffness_.setFromTriplets(stiffness.begin(), stiffness.end());
  for (Eigen::Index equation = 0; equation < nd; ++equation)
    for (Eigen::SparseMatrix<double>::InnerIterator it(transposed, equation); it && it.row() < nd; ++it)
      if (it.row() != equation) skew = std::max(skew, std::abs(it.value() - stiffness_.coeff(it.row(), equation)));
  for (Eigen::Index column = 0; column < nd; ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator it(stiffness_, column); it; ++it)
      entries.emplace_back(static_cast<int>(it.row()), static_cast<int>(column), it.value());
  if (singular_) {
    // A spring holds one component of each null direction, and takes no part in motions without it.
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> places(null_.transpose());
    for (Eigen::Index j = 0; j < null_.cols(); ++j) {
      const int place = places.colsPermutation().indices()[j];
      entries.emplace_back(place, place, 1.0 + largest);
    }
  }
  forces_.resize(nd, reactions);
  forces_.setFromTriplets(forces.begin(), forces.end());
  symmetric_ = skew <= tolerances::kEqual * largest && ForcesActAlongMotions(transposed);
  // What a port that gives way holds is stiffness.
  stiffness.clear();
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

bool StabilityProblem::ForcesActAlongMotions(const Eigen::SparseMatrix<double>& transposed) const {
  const Eigen::Index nd = structure_.NumDofs();
  for (Eigen::Index reaction = 0; reaction < forces_.cols(); ++reaction) {
    double motion = 0.0, force = forces_.col(reaction).squaredNorm(), work = 0.0;
    for (Eigen::SparseMatrix<double>::InnerIterator it(transposed, nd + reaction); it && it.row() < nd; ++it) {
      motion += it.value() * it.value();
      work += it.value() * forces_.coeff(it.row(), reaction);
    }
    if (motion > 0.0 && work * work < (1.0 - tolerances::kEqual) * motion * force) return false;
    if (motion > 0.0 && force == 0.0) return false;
  }
  return true;
}

bool StabilityProblem::Condense(const PathPoint& point, const Eigen::SparseMatrix<double>& transposed) {
  const Eigen::Index nd = structure_.NumDofs(), size = saddle_.rows();
  const auto count = static_cast<Eigen::Index>(slips_.size());
  const Eigen::VectorXd& f = structure_.ReferenceLoad();

  Eigen::MatrixXd solutions = Eigen::MatrixXd::Zero(size, 1 + count);  // by the load, and by unit slips
  solutions.col(0).head(nd) = f;
  for (Eigen::Index k = 0; k < count; ++k)
    solutions(PlaceOf(slips_[static_cast<std::size_t>(k)].following), 1 + k) =
        -slips_[static_cast<std::size_t>(k)].sense;
  factors_.Solve(&solutions);
  if (!solutions.allFinite()) return false;
  by_load_ = solutions.col(0).head(nd);
  load_compliance_ = f.dot(by_load_);
  stiff_compliance_ = 0.0;
  for (Eigen::Index i = 0; i < nd; ++i) {
    if (f[i] == 0.0) continue;
    const double stiffness = stiffness_.col(i).norm();
    stiff_compliance_ += f[i] * f[i] / (stiffness > 0.0 ? stiffness : 1.0);
  }
  sign_ = negative_ % 2 == 0 ? 1 : -1;
  H_.resize(count, count);
  stiffest_slip_ = 0.0;
  load_of_slips_.resize(count);
  if (count == 0 && symmetric_) return true;

  motions_ = solutions.block(0, 1, nd, count);
  load_of_slips_ = motions_.transpose() * f;
  if (!symmetric_) {
    if (!unsymmetric_.FactorizeRegular(transposed, Eigen::VectorXd::Unit(transposed.rows(), nd))) return false;
    sign_ = unsymmetric_.DeterminantSign() * ((transposed.rows() - nd - 1) % 2 == 0 ? 1 : -1);
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(transposed.cols(), 1 + count), all;
    right.col(0).head(nd) = f;
    // The equations of motion are by grad xi, the columns of forces by c grad xi, slip by c dxi.
    for (Eigen::Index k = 0; k < count; ++k) {
      const Slip& slip = slips_[static_cast<std::size_t>(k)];
      double by_row = 0.0, by_force = 0.0;
      for (Eigen::SparseMatrix<double>::InnerIterator it(transposed, slip.following); it && it.row() < nd; ++it) {
        by_row += it.value() * it.value();
        by_force += it.value() * forces_.coeff(it.row(), slip.following - nd);
      }
      right(slip.following, 1 + k) = slip.sense * by_row / by_force;
    }
    unsymmetric_.SolveAll(right, &all);
    by_load_ = all.col(0).head(nd);
    load_compliance_ = f.dot(by_load_);
    motions_ = all.block(0, 1, nd, count);
    load_of_slips_ = motions_.transpose() * f;
    solutions.topRows(nd) = all.topRows(nd);
    for (std::size_t k = 0; k < places_.size(); ++k)
      solutions.row(places_[k]) = all.row(nd + 1 + static_cast<Eigen::Index>(k));
  }
  w_of_load_.resize(count);
  slip_rounding_.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Slip& slip = slips_[static_cast<std::size_t>(i)];
    slip_rounding_[i] = tolerances::kEqual * EnergyAt(slip, motions_.col(i));
    const Eigen::RowVectorXd along = slip.sense * solutions.row(PlaceOf(slip.following)).segment(1, count),
                             across = slip.ratio * solutions.row(PlaceOf(slip.leading)).segment(1, count);
    H_.row(i) = along + across;
    stiffest_slip_ = std::max({stiffest_slip_, along.cwiseAbs().maxCoeff(), across.cwiseAbs().maxCoeff()});
    w_of_load_[i] =
        slip.sense * solutions(PlaceOf(slip.following), 0) + slip.ratio * solutions(PlaceOf(slip.leading), 0);
  }
  FindArtificial(point, transposed);
  return H_.allFinite();
}

void StabilityProblem::FindArtificial(const PathPoint& point, const Eigen::SparseMatrix<double>& transposed) {
  const Eigen::Index nd = structure_.NumDofs(), count = motions_.cols();
  Eigen::MatrixXd motions(nd, 1 + count);
  motions << by_load_, motions_;
  const Eigen::MatrixXd forces = structure_.ArtificialForces(point.u, motions);
  artificial_ = Eigen::MatrixXd::Zero(count, 1 + count);
  if (forces.isZero(0.0)) return;
  for (Eigen::Index k = 0; k < count; ++k) {
    const Slip& slip = slips_[static_cast<std::size_t>(k)];
    Eigen::MatrixXd w = Eigen::MatrixXd::Zero(symmetric_ ? saddle_.rows() : transposed.rows(), 1);
    w(symmetric_ ? PlaceOf(slip.following) : slip.following + 1, 0) = slip.sense;
    w(symmetric_ ? PlaceOf(slip.leading) : slip.leading + 1, 0) = slip.ratio;
    if (symmetric_)
      factors_.Solve(&w);
    else
      w = unsymmetric_.SolveTransposed(w);
    artificial_.row(k) = -w.topRows(nd).transpose() * forces;
  }
}

double StabilityProblem::EnergyAt(const Slip& slip, const Eigen::VectorXd& motion) const {
  const Eigen::Index nd = structure_.NumDofs();
  double stiffest = 0.0, squares = 0.0;
  for (Eigen::SparseMatrix<double>::InnerIterator dof(forces_, slip.following - nd); dof; ++dof) {
    squares += motion[dof.row()] * motion[dof.row()];
    for (Eigen::SparseMatrix<double>::InnerIterator it(saddle_, dof.row()); it && it.row() < nd; ++it)
      stiffest = std::max(stiffest, std::abs(it.value()));
  }
  return stiffest * squares;
}

Eigen::VectorXd StabilityProblem::Normalised(const Eigen::VectorXd& du) const {
  const double norm = du.norm();
  return norm > 0.0 && std::isfinite(norm) ? Eigen::VectorXd(du / norm) : Eigen::VectorXd();
}

Eigen::VectorXd StabilityProblem::FallingMode() const {
  const Eigen::Index nd = structure_.NumDofs(), size = saddle_.rows();
  // Not more than there are motions that the laws admit: further columns of a basis would be none. What gives way
  // admits them.
  Eigen::Index rigid = 0;
  for (Eigen::Index k = nd; k < size; ++k) rigid += saddle_.coeff(k, k) == 0.0 ? 1 : 0;
  const Eigen::Index count = std::min(kModes, std::max(negative_, nd - rigid));
  Eigen::MatrixXd modes = Eigen::MatrixXd::Zero(size, count);
  for (Eigen::Index k = 0; k < count; ++k) modes.col(k).head(nd) = GenericVector(nd).array().pow(k + 1);
  if (load_compliance_ < 0.0) modes.col(0).head(nd) = by_load_;
  for (int i = 0; i < kInverseIterations; ++i) {
    factors_.Solve(&modes);
    if (!modes.allFinite()) return {};
    const Eigen::MatrixXd basis =
        Eigen::HouseholderQR<Eigen::MatrixXd>(modes.topRows(nd)).householderQ() * Eigen::MatrixXd::Identity(nd, count);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(basis.transpose() * (stiffness_ * basis));
    if (solver.eigenvalues()[0] < 0.0) return basis * solver.eigenvectors().col(0);
    modes.topRows(nd) = basis;
    modes.bottomRows(size - nd).setZero();
  }
  return {};
}

double StabilityProblem::PossibleSense() const {
  Eigen::VectorXd slips(static_cast<Eigen::Index>(slips_.size()));
  for (Eigen::Index k = 0; k < slips.size(); ++k) {
    const Slip& slip = slips_[static_cast<std::size_t>(k)];
    slips[k] = slip.sense * forces_.col(slip.following - structure_.NumDofs()).dot(null_.col(0));
  }
  const double rounding = tolerances::kSameTangent * null_.col(0).norm();
  if (slips.minCoeff() >= -rounding) return 1.0;
  return slips.maxCoeff() <= rounding ? -1.0 : 0.0;
}

Stability StabilityProblem::Under(double compliance) const {
  Stability found;
  if (!covered_) return found;
  const bool dead = !std::isfinite(compliance) || structure_.ReferenceLoad().isZero(0.0);
  // A machine may hold one of the null directions.
  const Eigen::VectorXd work = null_.transpose() * structure_.ReferenceLoad();
  const bool one_held = !dead && null_.cols() > 0 &&
                        work.cwiseAbs().maxCoeff() > tolerances::kSameTangent * structure_.ReferenceLoad().norm();
  const Eigen::Index free = null_.cols() - (one_held ? 1 : 0);
  const bool level = free > 0;
  if (!regular_ && (singular_ || !level)) return found;
  if (level && !singular_) {
    // Slips set out along it with the growth rate 0, if they are possible.
    const double sense = PossibleSense();
    if (sense == 0.0) return found;
    found.verdict = Verdict::kUnstable;
    found.direction = Normalised(sense * null_.col(0));
    const bool held = !std::isfinite(compliance) && !structure_.ReferenceLoad().isZero(0.0);
    if (const int directions = held ? Under(0.0).directions : -1; directions >= 0) found.directions = directions + 1;
    return found;
  }
  // f . du per unit of Q - f . u. Where the loads act on what the laws hold, a rigid machine is taken for a very
  // stiff one.
  double machine = load_compliance_ + compliance;
  if (!dead) {
    double flexible = std::max(std::abs(load_compliance_), stiff_compliance_);
    for (Eigen::Index i = 0; i < H_.rows(); ++i)
      flexible = std::max(flexible, load_of_slips_[i] * load_of_slips_[i] / stiffest_slip_);
    if (flexible == 0.0) flexible = 1.0;
    if (std::abs(machine) <= tolerances::kRootOfRounding * flexible) machine = tolerances::kRootOfRounding * flexible;
  }
  // What rounding leaves of a compliance that is not negative: of a stiffness without a falling direction.
  if (slips_.empty() && negative_ == 0) machine = std::abs(machine);
  const double share = dead ? 0.0 : 1.0 / machine;
  const Eigen::Index n0 = negative_ - (!dead && !(singular_ && one_held) && machine < 0.0 ? 1 : 0);
  if (singular_) {
    found.directions = static_cast<int>(n0 + free);
    found.verdict = found.directions > 0 ? Verdict::kUnstable : Verdict::kStable;
    if (level)
      found.direction =
          Normalised(one_held ? Eigen::VectorXd(null_.col(0) * work[1] - null_.col(1) * work[0]) : null_.col(0));
    return found;
  }
  const int sign = dead || machine > 0.0 ? sign_ : -sign_;

  if (slips_.empty()) {
    found.directions = static_cast<int>(n0);
    if (n0 == 0 && sign > 0) {
      found.verdict = Verdict::kStable;
    } else if (symmetric_ || sign < 0) {
      found.verdict = Verdict::kUnstable;
    }
    if (n0 > 0 && dead) found.direction = FallingMode();
    if (found.verdict == Verdict::kNotProved) found.directions = -1;
    return found;
  }

  const Eigen::MatrixXd of_slips = H_ - share * w_of_load_ * load_of_slips_.transpose();
  // No energy opposes a slip, as of a disc that spins in its place: rounding would tell the sign.
  if ((of_slips.diagonal().cwiseAbs().array() <= slip_rounding_.array()).any()) return found;
  const double least = H_.cwiseAbs().maxCoeff() * tolerances::kRootOfRounding;
  const Eigen::VectorXd scale = H_.diagonal().cwiseAbs().cwiseMax(least).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd H = scale.asDiagonal() * of_slips * scale.asDiagonal();
  const Eigen::MatrixXd artificial =
      artificial_.rightCols(H.cols()) - share * artificial_.col(0) * load_of_slips_.transpose();
  if (n0 == 0 && IsStrictlyCopositive(H)) {
    const Eigen::MatrixXd without = H - 2.0 * scale.asDiagonal() * artificial.cwiseAbs() * scale.asDiagonal();
    found.artificial = !artificial.isZero(0.0) && !IsStrictlyCopositive(without);
    if (found.artificial) return found;
    found.verdict = Verdict::kStable;
    found.directions = 0;
    return found;
  }
  const std::vector<GrowingSlip> growing = GrowingSlips(H);
  const std::optional<int> degree = ComplementarityDegree(H);
  if ((!degree || sign * *degree == 1) && !(n0 > 0 && slips_.size() == 1)) return found;
  found.verdict = Verdict::kUnstable;
  if (const std::optional<int> count = CountGrowing(H, growing)) found.directions = static_cast<int>(n0) + *count;
  if (found.directions == 0) found.directions = -1;
  if (!growing.empty()) {
    const auto fastest =
        std::max_element(growing.begin(), growing.end(), [](const auto& a, const auto& b) { return a.rate < b.rate; });
    const Eigen::VectorXd z = scale.asDiagonal() * fastest->z;
    found.direction = Normalised(motions_ * z - (dead ? 0.0 : share * load_of_slips_.dot(z)) * by_load_);
  } else if (n0 > 0 && dead) {
    found.direction = FallingMode();
  }
  return found;
}

}  // namespace contact_path
