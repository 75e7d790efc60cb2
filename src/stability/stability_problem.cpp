#include "contact_path/stability/stability_problem.h"

#include <algorithm>
#include <cmath>

#include "contact_path/law/active_set_tolerance.h"
#include "contact_path/stability/slip_stability.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

Eigen::VectorXd Normalised(const Eigen::VectorXd& du) {
  const double norm = du.norm();
  return norm > 0.0 && std::isfinite(norm) ? Eigen::VectorXd(du / norm) : Eigen::VectorXd();
}

// With the force r of a machine as one more unknown: f . du + compliance r = 0, and -f r in equilibrium.
Eigen::SparseMatrix<double> WithMachine(const Eigen::SparseMatrix<double>& transposed, const Eigen::VectorXd& f,
                                        double compliance) {
  const auto row = static_cast<int>(transposed.rows()), column = static_cast<int>(transposed.cols());
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(transposed.nonZeros() + 2 * f.size() + 1));
  for (Eigen::Index equation = 0; equation < column; ++equation)
    for (Eigen::SparseMatrix<double>::InnerIterator it(transposed, equation); it; ++it)
      entries.emplace_back(static_cast<int>(it.row()), static_cast<int>(equation), it.value());
  for (int i = 0; i < static_cast<int>(f.size()); ++i) {
    if (f[i] == 0.0) continue;
    entries.emplace_back(i, column, f[i]);
    entries.emplace_back(row, i, -f[i]);
  }
  entries.emplace_back(row, column, compliance);
  Eigen::SparseMatrix<double> with(row + 1, column + 1);
  with.setFromTriplets(entries.begin(), entries.end());
  return with;
}

}  // namespace

StabilityProblem::StabilityProblem(const Structure& structure, const Laws& laws)
    : structure_(structure), laws_(laws), system_(structure, laws) {}

void StabilityProblem::Set(const PathPoint& point, const Eigen::MatrixXd& null_directions, const PathPoint* ahead) {
  touching_ = releases_ ? TouchingAt(point, ahead == nullptr ? point : *ahead) : std::vector<Touching>();
  if (!touching_.empty()) {
    for (auto* const other : {&free_, &as_is_})
      if (!*other) {
        *other = std::make_unique<StabilityProblem>(structure_, laws_);
        (*other)->releases_ = false;
      }
    point_ = point;
    for (const Touching& law : touching_) point_.modes[law.number].state = law.idle;
    free_->Set(point_, null_directions);
    // Where nothing slides, no machine makes it worse.
    slips_.clear();
    if (free_->slips_.empty() && free_->Decide(INFINITY).verdict == Verdict::kStable) return;
    as_is_->Set(point, null_directions);
  }
  PathPoint held = point;
  for (const Touching& law : touching_) held.modes[law.number] = law.rubs ? point_.modes[law.number] : law.bears;
  Classify(held.modes);
  const Eigen::SparseMatrix<double>& transposed = system_.TransposedJacobian(system_.Pack(held));
  singular_ = null_directions.cols() > 0 && slips_.empty();
  null_ = null_directions;
  // Forces that are not unique do not matter where nothing slides.
  regular_ = held_.Set(structure_.NumDofs(), transposed, system_.InFrame(), singular_ ? null_ : Eigen::MatrixXd(),
                       !slips_.empty()) &&
             Condense(point.u);
  if (!regular_ && null_.cols() == 0) held_point_ = held;
}

bool StabilityProblem::IsSymmetric(const Modes& modes) const {
  for (std::size_t i = 0; i < modes.size(); ++i)
    if (!laws_[i].In(modes[i]).symmetric) return false;
  return true;
}

bool StabilityProblem::TouchesWithoutForce(const PathPoint& point) const { return !TouchingAt(point, point).empty(); }

std::vector<StabilityProblem::Touching> StabilityProblem::TouchingAt(const PathPoint& point,
                                                                     const PathPoint& ahead) const {
  std::vector<Touching> touching;
  const ActiveSetTolerance zero = ActiveSetTolerance::For(laws_.LargestForce(point), point.s);
  for (std::size_t i = 0; i < point.modes.size(); ++i) {
    const Law& law = laws_[i];
    if (law.NumStates() == 1) continue;
    Touching found{i, 0, law.Known(point.u, point.s, point.modes[i]), law.LargestRatio() > 0.0};
    if (law.In(found.bears).idle) {
      found.idle = found.bears.state;
      const auto motion = [&](const PathPoint& at) { return law.Motion(0, at.u, at.s, found.bears.piece, {}); };
      if (std::max(std::abs(motion(point)), motion(ahead)) > tolerances::kRootOfRounding) continue;
      while (law.In(found.bears).idle) found.bears.state = (found.bears.state + 1) % law.NumStates();
    } else {
      const Eigen::Index force = laws_.FirstPort(i);
      if (std::max(point.forces[force], ahead.forces[force]) > zero.force * law.ForceUnit()) continue;
      while (!law.In(found.idle).idle) ++found.idle;
    }
    touching.push_back(found);
  }
  return touching;
}

void StabilityProblem::Classify(Modes modes) {
  slips_.clear();
  covered_ = true;
  // Forces as the system numbers them, without the load factor.
  Eigen::Index next = structure_.NumDofs();
  auto touching = touching_.begin();
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const Law& law = laws_[i];
    const StateRule& state = law.In(modes[i]);
    const bool touches = touching != touching_.end() && touching->number == i;
    if (touches) ++touching;
    if (state.idle) continue;
    covered_ = covered_ && !(law.Holonomic() && law.LargestRatio() > 0.0);
    modes[i].state = state.held;
    const StateRule& held = law.In(modes[i]);
    const Eigen::Index leading = next;
    for (std::size_t p = 0; p < law.NumPorts(); ++p) {
      if (!held.ports[p].Holds()) continue;
      if (p == 0 && touches) slips_.push_back({1.0, 0.0, leading, leading});
      if (state.ports[p].Follows())
        slips_.push_back({state.ports[p].ratio < 0.0 ? 1.0 : -1.0, std::abs(state.ports[p].ratio), leading, next});
      ++next;
    }
  }
  if (modes != system_.modes()) system_.SetModes(modes);
}

bool StabilityProblem::Condense(const Eigen::VectorXd& u) {
  const Eigen::Index nd = structure_.NumDofs();
  const auto count = static_cast<Eigen::Index>(slips_.size());
  const Eigen::VectorXd& f = structure_.Loads().Reference();

  std::vector<HeldStiffness::Slip> slips;
  slips.reserve(slips_.size());
  for (const Slip& slip : slips_) slips.push_back({slip.following, slip.sense});
  const Eigen::MatrixXd responses = held_.Responses(f, slips);
  if (responses.size() == 0) return false;
  by_load_ = responses.col(0).head(nd);
  load_compliance_ = f.dot(by_load_);
  stiff_compliance_ = 0.0;
  for (Eigen::Index i = 0; i < nd; ++i) {
    if (f[i] == 0.0) continue;
    const double stiffness = held_.StiffnessOf(i);
    stiff_compliance_ += f[i] * f[i] / (stiffness > 0.0 ? stiffness : 1.0);
  }
  motions_ = responses.block(0, 1, nd, count);
  load_of_slips_ = motions_.transpose() * f;
  stiffest_slip_ = 0.0;
  H_.resize(count, count);
  w_of_load_.resize(count);
  slip_rounding_.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Slip& slip = slips_[static_cast<std::size_t>(i)];
    // Beside that of the terms, what forces within rounding make: a cord without tension has such a stiffness.
    slip_rounding_[i] = tolerances::kEqual * held_.EnergyAt(slip.following, motions_.col(i)) +
                        tolerances::kRounding * motions_.col(i).squaredNorm();
    const Eigen::RowVectorXd along = slip.sense * responses.row(slip.following),
                             across = slip.ratio * responses.row(slip.leading);
    H_.row(i) = (along + across).tail(count);
    stiffest_slip_ =
        std::max({stiffest_slip_, along.tail(count).cwiseAbs().maxCoeff(), across.tail(count).cwiseAbs().maxCoeff()});
    w_of_load_[i] = along[0] + across[0];
  }
  const Eigen::MatrixXd forces = structure_.ArtificialForces(u, responses.topRows(nd));
  artificial_ = Eigen::MatrixXd::Zero(count, 1 + count);
  if (forces.isZero(0.0)) return true;
  for (Eigen::Index i = 0; i < count; ++i) {
    const Slip& slip = slips_[static_cast<std::size_t>(i)];
    Eigen::VectorXd w = Eigen::VectorXd::Zero(responses.rows());
    w[slip.following] = slip.sense;
    w[slip.leading] = slip.ratio;
    artificial_.row(i) = -held_.Influence(w).transpose() * forces;
  }
  return true;
}

double StabilityProblem::PossibleSense() const {
  Eigen::VectorXd slips(static_cast<Eigen::Index>(slips_.size()));
  for (Eigen::Index k = 0; k < slips.size(); ++k) {
    const Slip& slip = slips_[static_cast<std::size_t>(k)];
    slips[k] = slip.sense * held_.Motion(slip.following, null_.col(0));
  }
  const double rounding = tolerances::kSameTangent * null_.col(0).norm();
  if (slips.minCoeff() >= -rounding) return 1.0;
  return slips.maxCoeff() <= rounding ? -1.0 : 0.0;
}

Stability StabilityProblem::Under(double compliance) {
  if (touching_.empty()) return Decide(compliance);
  Stability found = free_->Under(compliance);
  if (found.verdict == Verdict::kStable) return found;
  found = Decide(compliance);
  if (found.verdict == Verdict::kStable || (found.verdict == Verdict::kUnstable && Opens(&found.direction)))
    return found;
  found = as_is_->Under(compliance);
  return found.verdict == Verdict::kUnstable ? found : Stability();
}

bool StabilityProblem::Opens(Eigen::VectorXd* direction) const {
  const auto opens = [&](const Touching& law, double sense) {
    const auto motion = [&](double way) {
      return laws_[law.number].Motion(0, point_.u + way * *direction, point_.s, law.bears.piece, {});
    };
    return !law.rubs ||
           motion(sense * tolerances::kNextToStart) > motion(0.0) + tolerances::kSmallShare * tolerances::kNextToStart;
  };
  const bool rubs = std::any_of(touching_.begin(), touching_.end(), [](const Touching& law) { return law.rubs; });
  if (!rubs || direction->size() == 0) return !rubs;
  for (const double sense : {1.0, -1.0}) {
    if (sense < 0.0 && !slips_.empty()) break;
    if (!std::all_of(touching_.begin(), touching_.end(), [&](const Touching& law) { return opens(law, sense); }))
      continue;
    *direction *= sense;
    return true;
  }
  return false;
}

Stability StabilityProblem::HeldByMachine(double compliance) {
  const Eigen::SparseMatrix<double>& transposed = system_.TransposedJacobian(system_.Pack(held_point_));
  regular_ = held_.Set(structure_.NumDofs(), WithMachine(transposed, structure_.Loads().Reference(), compliance),
                       nullptr, {}, !slips_.empty()) &&
             Condense(held_point_.u);
  Stability found;
  if (regular_) found = Decide(INFINITY);
  regular_ = false;
  return found;
}

Stability StabilityProblem::Decide(double compliance) {
  Stability found;
  if (!covered_) return found;
  const bool dead = !std::isfinite(compliance) || structure_.Loads().Reference().isZero(0.0);
  // A machine may hold one of the null directions.
  const Eigen::VectorXd work = null_.transpose() * structure_.Loads().Reference();
  const bool one_held = !dead && null_.cols() > 0 &&
                        work.cwiseAbs().maxCoeff() > tolerances::kSameTangent * structure_.Loads().Reference().norm();
  const Eigen::Index free = null_.cols() - (one_held ? 1 : 0);
  const bool level = free > 0;
  if (!regular_ && null_.cols() == 0 && !dead) return HeldByMachine(compliance);
  if (!regular_ && (singular_ || !level)) return found;
  if (level && !singular_) {
    // Slips set out along it with the growth rate 0, if they are possible.
    const double sense = PossibleSense();
    if (sense == 0.0) return found;
    found.verdict = Verdict::kUnstable;
    found.direction = Normalised(sense * null_.col(0));
    const bool held = !std::isfinite(compliance) && !structure_.Loads().Reference().isZero(0.0);
    if (const int directions = held ? Decide(0.0).directions : -1; directions >= 0) found.directions = directions + 1;
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
  if (slips_.empty() && held_.negative() == 0) machine = std::abs(machine);
  const double share = dead ? 0.0 : 1.0 / machine;
  const auto falling_mode = [&] {
    const double stiffness = dead ? 0.0 : 1.0 / std::max(compliance, tolerances::kRootOfRounding * stiff_compliance_);
    return held_.FallingMode(load_compliance_ < 0.0 ? by_load_ : Eigen::VectorXd(), structure_.Loads().Reference(),
                             stiffness);
  };
  const Eigen::Index n0 = held_.negative() - (!dead && !(singular_ && one_held) && machine < 0.0 ? 1 : 0);
  if (singular_) {
    found.directions = static_cast<int>(n0 + free);
    found.verdict = found.directions > 0 ? Verdict::kUnstable : Verdict::kStable;
    if (level)
      found.direction =
          Normalised(one_held ? Eigen::VectorXd(null_.col(0) * work[1] - null_.col(1) * work[0]) : null_.col(0));
    return found;
  }
  const int sign = dead || machine > 0.0 ? held_.sign() : -held_.sign();

  if (slips_.empty()) {
    found.directions = static_cast<int>(n0);
    if (n0 == 0 && sign > 0) {
      found.verdict = Verdict::kStable;
    } else if (held_.symmetric() || sign < 0) {
      found.verdict = Verdict::kUnstable;
    }
    if (n0 > 0) found.direction = falling_mode();
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
  } else if (n0 > 0) {
    found.direction = falling_mode();
  }
  return found;
}

}  // namespace contact_path
