#include "contact_path/branch/ways.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <optional>

#include "contact_path/contact/fixed_state_system.h"
#include "contact_path/contact/minimum_norm.h"

namespace contact_path {
namespace {

constexpr double kRateTolerance = 1e-9;       // of unit rates
constexpr double kCurvatureTolerance = 1e-9;  // of second derivatives, where the rate is zero
constexpr double kSameDirection = 1e-7;       // norm of the difference of unit vectors
constexpr double kRigid = 1e-9;               // singular value below which load and reactions do not change
constexpr int kMaxCombinations = 4096;        // 4^6

using States = std::vector<ContactState>;

// The states that a contact can take on from `point`: one if it is not concerned. The natural one, as it was, comes first.
States Options(const ContactGeometry& contact, const PathPoint& point, std::size_t i, double tolerance) {
  const auto k = static_cast<Eigen::Index>(i);
  const double gap = contact.gap.Value(point.u), rn = point.rn[k], rt = point.rt[k];
  if (gap > tolerance) return {ContactState::kOpen};
  const bool loaded = rn > tolerance;
  States options;
  if (!contact.Frictional()) {
    options = {ContactState::kClosed};
  } else if (!loaded) {
    options = {ContactState::kStick, ContactState::kSlipPlus, ContactState::kSlipMinus};
  } else {
    options = {ContactState::kStick};
    if (contact.friction * rn + rt <= tolerance) options.push_back(ContactState::kSlipPlus);
    if (contact.friction * rn - rt <= tolerance) options.push_back(ContactState::kSlipMinus);
  }
  if (!loaded) options.push_back(ContactState::kOpen);
  const auto natural = std::find(options.begin(), options.end(), point.states[i]);
  if (natural != options.end()) std::rotate(options.begin(), natural, natural + 1);
  return options;
}

Eigen::VectorXd TangentialPositions(const std::vector<ContactGeometry>& contacts, const Eigen::VectorXd& u) {
  Eigen::VectorXd positions(static_cast<Eigen::Index>(contacts.size()));
  for (std::size_t i = 0; i < contacts.size(); ++i) positions[static_cast<Eigen::Index>(i)] = contacts[i].tangential.Value(u);
  return positions;
}

// Columns of `basis` without what lies in the span of the rows' null space: splits a null space by what moves.
// Returns the part of basis in which the rows `from`..`from + count` vanish (still = true) or its complement.
Eigen::MatrixXd Split(const Eigen::MatrixXd& basis, Eigen::Index from, Eigen::Index count, bool still) {
  if (basis.cols() == 0) return basis;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(basis.middleRows(from, count), Eigen::ComputeFullV);
  Eigen::Index rank = 0;
  while (rank < svd.singularValues().size() && svd.singularValues()[rank] > kRigid) ++rank;
  const Eigen::MatrixXd v = still ? svd.matrixV().rightCols(basis.cols() - rank) : svd.matrixV().leftCols(rank);
  return basis * v;
}

class Finder {
 public:
  Finder(const Structure& structure, const std::vector<ContactGeometry>& contacts, const PathPoint& point,
         const Arrival& arrival, double tolerance)
      : contacts_(contacts),
        point_(point),
        arrival_(arrival),
        tolerance_(tolerance),
        system_(structure, contacts),
        reference_(TangentialPositions(contacts, point.u)) {}

  // Adds the ways with these states.
  void Try(const States& states, std::vector<Way>* ways) {
    system_.SetStates(states, reference_);
    const Eigen::VectorXd x = system_.Pack(point_);
    if (!solver_.Factorize(system_.TransposedJacobian(x))) return;
    const std::optional<Eigen::VectorXd> tangent = Tangent();
    if (!tangent) return;
    const Eigen::VectorXd second = solver_.Solve(-system_.SecondDerivative(x, *tangent));
    for (const double sign : {1.0, -1.0}) {
      const Eigen::VectorXd first = sign * *tangent;
      if (Admissible(x, first, second)) Add(first, ways);
    }
  }

 private:
  Eigen::Index NumMotion() const { return system_.NumDofs() + 1; }

  // The direction of the piece: of the null space, what is neither a rigid mode (no change of load and reactions) nor a
  // redundant reaction (no motion). A mechanism has rigid modes only: with one of them it moves that way, with more it is
  // loose, and the one nearest to the arrival stands for all.
  std::optional<Eigen::VectorXd> Tangent() {
    loose_ = false;
    const Eigen::MatrixXd null_space = solver_.NullSpace();
    const Eigen::Index motion = NumMotion();
    Eigen::VectorXd tangent;
    if (null_space.cols() == 1) {
      tangent = null_space.col(0);
    } else {
      const Eigen::MatrixXd moving = Split(null_space, 0, motion, false);
      const Eigen::MatrixXd rigid = Split(moving, motion - 1, system_.NumUnknowns() - motion + 1, true);
      Eigen::MatrixXd proper = Split(moving, motion - 1, system_.NumUnknowns() - motion + 1, false);
      // Shortest motion: nothing of the rigid modes.
      for (Eigen::Index k = 0; k < rigid.cols(); ++k) {
        const Eigen::VectorXd mode = rigid.col(k).head(motion).normalized();
        for (Eigen::Index j = 0; j < proper.cols(); ++j) {
          Eigen::VectorXd column = proper.col(j);
          column.head(motion) -= mode.dot(column.head(motion)) * mode;
          proper.col(j) = column;
        }
      }
      const Eigen::MatrixXd& candidates = proper.cols() > 0 ? proper : rigid;
      if (candidates.cols() == 0) return std::nullopt;
      loose_ = proper.cols() == 0 && rigid.cols() > 1;
      if (candidates.cols() == 1)
        tangent = candidates.col(0);
      else  // nearest to the arrival
        tangent = candidates * candidates.topRows(motion).colPivHouseholderQr().solve(arrival_.direction);
    }
    const double norm = tangent.head(motion).norm();
    if (!(norm > kRigid)) return std::nullopt;
    tangent /= norm;
    return tangent;
  }

  bool Admissible(const Eigen::VectorXd& x, const Eigen::VectorXd& first, const Eigen::VectorXd& second) const {
    const Eigen::Index n = NumMotion();
    if (arrival_.is_start) {
      if (first[n - 1] * arrival_.direction[n - 1] <= kRateTolerance) return false;
    } else if ((first.head(n) + arrival_.direction).norm() < kSameDirection) {
      return false;
    }
    for (const Limit& limit : system_.Inequalities()) {
      double rate = system_.Rate(limit, first), curvature = system_.Rate(limit, second);
      if (limit.inequality != Inequality::kSlip && system_.Value(limit, x) > tolerance_) continue;
      if (rate < -kRateTolerance) return false;
      if (rate <= kRateTolerance && curvature < -kCurvatureTolerance) return false;
    }
    return true;
  }

  void Add(const Eigen::VectorXd& first, std::vector<Way>* ways) const {
    const Eigen::Index n = NumMotion();
    Way way;
    way.states = system_.states();
    way.loose = loose_;
    way.direction = first.head(n);
    for (const Way& other : *ways)
      if ((other.direction - way.direction).norm() < kSameDirection) return;
    way.load_rate = first[n - 1];
    const PathPoint rates = system_.Unpack(first);
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      const double slip = contacts_[i].tangential.Rate(rates.u);
      if (way.states[i] == ContactState::kOpen || way.states[i] == ContactState::kStick) continue;
      way.dissipation_rate -= point_.rt[k] * slip;
    }
    way.turn = std::acos(std::clamp(way.direction.dot(arrival_.direction), -1.0, 1.0));
    ways->push_back(std::move(way));
  }

  const std::vector<ContactGeometry>& contacts_;
  const PathPoint& point_;
  const Arrival& arrival_;
  double tolerance_;
  FixedStateSystem system_;
  Eigen::VectorXd reference_;
  MinimumNormSolver solver_;
  bool loose_ = false;  // of the last tangent
};

// Two ways with the same rates are images of each other under a symmetry of the scene, and break it.
void FindTwins(std::vector<Way>* ways) {
  const auto same = [](double a, double b) { return std::abs(a - b) <= kRateTolerance; };
  for (Way& a : *ways)
    for (Way& b : *ways)
      if (&a != &b && same(a.dissipation_rate, b.dissipation_rate) && same(a.load_rate, b.load_rate) &&
          same(std::cos(a.turn), std::cos(b.turn)))
        a.has_twin = true;
}

bool Better(const Way& a, const Way& b) {
  if (std::abs(a.dissipation_rate - b.dissipation_rate) > kRateTolerance) return a.dissipation_rate > b.dissipation_rate;
  if (a.has_twin != b.has_twin) return b.has_twin;
  return a.turn < b.turn - kRateTolerance;
}

}  // namespace

WaysOn FindWays(const Structure& structure, const std::vector<ContactGeometry>& contacts, const PathPoint& point,
                const Arrival& arrival, double tolerance) {
  WaysOn result;
  std::vector<States> options;
  States states;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    options.push_back(Options(contacts[i], point, i, tolerance));
    states.push_back(options[i].front());
    if (options[i].size() > 1) ++result.concerned;
  }
  Finder finder(structure, contacts, point, arrival, tolerance);
  // An odometer over the options: the last contact turns fastest.
  std::vector<std::size_t> digits(contacts.size(), 0);
  for (;;) {
    finder.Try(states, &result.ways);
    if (++result.combinations >= kMaxCombinations) result.complete = false;
    for (std::size_t i = contacts.size(); i-- > 0;) {
      digits[i] = (digits[i] + 1) % options[i].size();
      states[i] = options[i][digits[i]];
      if (digits[i] != 0) break;
    }
    const bool turned = std::any_of(digits.begin(), digits.end(), [](std::size_t digit) { return digit != 0; });
    if (!turned || !result.complete) break;
  }
  FindTwins(&result.ways);
  std::stable_sort(result.ways.begin(), result.ways.end(), Better);
  return result;
}

}  // namespace contact_path
