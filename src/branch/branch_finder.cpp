#include "branch/branch_finder.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "contact_path/equations/measured.h"
#include "contact_path/linear/bordered_solver.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

// Of two unit vectors [rad].
double AngleTo(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return std::acos(std::clamp(a.dot(b), -1.0, 1.0));
}

Measured Rate(double value) { return {value, tolerances::kRate}; }

// -force . rate of what the force works along, >= 0, of the ports that follow, with the forces of the point. A
// holonomic law, which opposes no motion but a distance, dissipates nothing: 0. direction: (du, ds).
double DissipationRate(const Laws& laws, const Modes& modes, const PathPoint& point, const Eigen::VectorXd& direction) {
  double rate = 0.0;
  for (std::size_t i = 0; i < laws.size(); ++i) {
    const StateRule& state = laws[i].In(modes[i]);
    if (!state.slides || laws[i].Holonomic()) continue;
    for (std::size_t p = 0; p < laws[i].NumPorts(); ++p)
      if (state.ports[p].Follows())
        rate -=
            point.forces[laws.FirstPort(i) + static_cast<Eigen::Index>(p)] *
            laws[i].TravelRate(p, point.u, point.s, point.modes[i].piece, direction, direction[direction.size() - 1]);
  }
  return std::max(rate, 0.0);  // rounding may leave less
}

bool SameReactions(const Branch& branch, const Branch& other) {
  return std::abs(branch.reaction_rate - other.reaction_rate) <=
         tolerances::kRate * (1.0 + std::abs(other.reaction_rate));
}

// The modes with these states: the first options of each law that have them.
Modes ModesWith(const States& states, const std::vector<Modes>& options, const PathPoint& point) {
  Modes modes;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto found = std::find_if(options[i].begin(), options[i].end(),
                                    [&](const Mode& option) { return option.state == states[i]; });
    modes.push_back(found != options[i].end() ? *found : Mode{states[i], point.modes[i].piece});
  }
  return modes;
}

}  // namespace

Branch BranchAlong(const Eigen::VectorXd& first, const Eigen::VectorXd& second, const Laws& laws, const Modes& modes,
                   const PathPoint& point, const PathParameter& parameter, const Eigen::VectorXd& arrival) {
  const Eigen::Index motion = arrival.size();
  Branch branch;
  branch.modes = modes;
  branch.direction = first.head(motion);
  branch.first = first;
  branch.second = second;
  branch.load_rate = first[motion - 1];
  branch.parameter_rate = parameter.Rate(first, motion);
  branch.dissipation_rate = DissipationRate(laws, modes, point, branch.direction);
  branch.turn = AngleTo(arrival, branch.direction);
  return branch;
}

double ForceNorm(const Laws& laws, const PathPoint& point) {
  double sum = 0.0;
  for (std::size_t i = 0; i < laws.size(); ++i) {
    double squares = 0.0;
    for (const double force : laws.Of(point.forces, i)) squares += force * force;
    sum += squares / std::pow(laws[i].ForceUnit(), 2);
  }
  return std::sqrt(sum);
}

BranchFinder::BranchFinder(const Structure& structure, const Laws& laws, const PathPoint& point, const Options& options,
                           const Arrival& arrival, const ActiveSetTolerance& tolerance,
                           const std::function<bool()>& cancelled)
    : laws_(laws),
      point_(point),
      options_(options),
      arrival_(arrival),
      tolerance_(tolerance),
      cancelled_(cancelled),
      redundant_(laws, point, tolerance.motion),
      system_(structure, laws),
      reference_(laws.ReferencesAt(point)) {}

bool BranchFinder::Cancelled() {
  was_cancelled_ = was_cancelled_ || (cancelled_ && cancelled_());
  return was_cancelled_;
}

bool BranchFinder::Try(const Modes& modes, std::vector<Branch>* branches, double load_sense) {
  if (redundant_.Among(StatesOf(modes))) return false;
  Eigen::VectorXd x;
  const Tangents tangents = TangentsOf(modes, &x);
  bool settled = false;
  for (std::size_t k = 0; k < tangents.first.size(); ++k)
    for (const double sign : {1.0, -1.0}) {
      const Eigen::VectorXd first = sign * tangents.first[k];
      const bool leads_on = Admissible(tangents, k, x, first);
      if (leads_on) Add(tangents, first, tangents.second[k], branches);
      const bool in_sense = first[NumMotion() - 1] * load_sense > 0.0;
      const bool goes_back = arrival_.is_start ? arrival_.parameter.Sense(first, NumMotion()) < 0 : IsReversed(first);
      settled = settled || (in_sense && (leads_on || goes_back));
    }
  return settled;
}

bool BranchFinder::TryStates(const States& states, std::vector<Branch>* branches, double load_sense) {
  std::set<Modes> tried;
  bool settled = false;
  for (const double sign : {1.0, -1.0})
    if (const Modes modes = OntoPieces(states, sign); !Cancelled() && tried.insert(modes).second)
      settled = Try(modes, branches, load_sense) || settled;
  return settled;
}

std::optional<States> BranchFinder::PivotFrom(States states, double load_sense, const RateProblem* condensed) {
  std::set<States> seen;
  while (!Cancelled() && seen.insert(states).second) {
    std::optional<std::vector<Limit>> broken = BrokenOf(states, load_sense, condensed);
    if (!broken) return std::nullopt;
    const auto rule_of = [&, now = states](const Limit& limit) -> const LimitRule& {
      const auto i = static_cast<std::size_t>(limit.law);
      return laws_[i].Rule(now[i], limit.id);
    };
    // At the end of a piece another piece is wanted, and no other state.
    broken->erase(
        std::remove_if(broken->begin(), broken->end(), [&](const Limit& limit) { return rule_of(limit).OfPiece(); }),
        broken->end());
    if (broken->empty()) return states;
    for (const Limit& limit : *broken) states[static_cast<std::size_t>(limit.law)] = rule_of(limit).next;
  }
  return std::nullopt;
}

bool BranchFinder::Excluded(const States& states, const RateProblem& condensed) const {
  if (redundant_.Among(states)) return true;
  const std::optional<CondensedRates> rates = condensed.Rates(states);
  if (!rates) return false;
  if (arrival_.is_start && arrival_.parameter.IsLoadFactor() && std::abs(rates->load) <= tolerances::kUnitComponent)
    return true;
  return condensed.Broken(states, *rates, 1.0, tolerance_, tolerances::kSameTangent, nullptr) &&
         condensed.Broken(states, *rates, -1.0, tolerance_, tolerances::kSameTangent, nullptr);
}

Tangents BranchFinder::TangentsOf(const Modes& modes, Eigen::VectorXd* x) {
  system_.SetModes(modes, reference_);
  *x = system_.Pack(point_);
  Tangents tangents = FindTangents(*x, arrival_.direction, arrival_.singular, &system_, &solvers_);
  rigid_modes_ = std::max(rigid_modes_, tangents.rigid_modes);
  return tangents;
}

Modes BranchFinder::OntoPieces(const States& states, double sign) {
  Modes modes = ModesWith(states, options_, point_);
  bool choice = false;
  for (std::size_t i = 0; i < modes.size() && !choice; ++i)
    choice = std::any_of(options_[i].begin(), options_[i].end(), [&](const Mode& other) {
      return other.state == modes[i].state && other.piece != modes[i].piece;
    });
  if (!choice) return modes;
  std::set<Modes> seen;
  while (!Cancelled() && seen.insert(modes).second) {
    Eigen::VectorXd x;
    const Tangents tangents = TangentsOf(modes, &x);
    if (tangents.first.empty()) break;
    const double along = tangents.first[0].head(NumMotion()).dot(arrival_.direction);
    const Eigen::VectorXd first = (along < 0.0 ? -sign : sign) * tangents.first[0];
    for (const Limit& limit : system_.mode_limits().All()) {
      if (!system_.mode_limits().RuleOf(limit).OfPiece() || !system_.mode_limits().IsWeaklyActive(limit, x, tolerance_))
        continue;
      const Jet value = system_.ValueAlong(limit, x, first, tangents.second[0]);
      if (LeadingSign({Rate(value.first), Rate(value.second)}) >= 0) continue;
      const auto i = static_cast<std::size_t>(limit.law);
      const Mode next = laws_[i].Next(modes[i], limit.id);
      if (std::find(options_[i].begin(), options_[i].end(), next) != options_[i].end()) modes[i] = next;
    }
  }
  return modes;
}

std::optional<std::vector<Limit>> BranchFinder::BrokenOf(const States& states, double load_sense,
                                                         const RateProblem* condensed) {
  if (condensed != nullptr) {
    const std::optional<CondensedRates> rates = condensed->Rates(states);
    if (!rates) return std::nullopt;
    std::vector<Limit> broken;
    condensed->Broken(states, *rates, rates->load < 0.0 ? -load_sense : load_sense, tolerance_, tolerances::kRate,
                      &broken);
    return broken;
  }
  Eigen::VectorXd x;
  const Tangents tangents = TangentsOf(ModesWith(states, options_, point_), &x);
  if (tangents.first.empty()) return std::nullopt;
  const double sign = tangents.first[0][NumMotion() - 1] < 0.0 ? -load_sense : load_sense;
  return Broken(x, sign * tangents.first[0], tangents.second[0], laws_.size());
}

bool BranchFinder::Admissible(const Tangents& tangents, std::size_t k, const Eigen::VectorXd& x,
                              const Eigen::VectorXd& first) {
  const Eigen::VectorXd& second = tangents.second[k];
  // Under a dead load nothing tells which way a part moves that nothing resists; a machine takes it along.
  const bool loose = tangents.rigid && arrival_.parameter.IsLoadFactor();
  if (arrival_.is_start && (loose || !SetsOut(x, first, second, tangents.load_error[k]))) return false;
  if (!arrival_.is_start && IsReversed(first)) return false;
  return Broken(x, first, second, 1).empty();
}

std::vector<Limit> BranchFinder::Broken(const Eigen::VectorXd& x, const Eigen::VectorXd& first,
                                        const Eigen::VectorXd& second, std::size_t most) {
  std::vector<Limit> broken, level;
  for (const Limit& limit : system_.mode_limits().All()) {
    if (broken.size() == most) return broken;
    if (!system_.mode_limits().IsWeaklyActive(limit, x, tolerance_)) continue;
    const Jet along = system_.ValueAlong(limit, x, first, second);
    const double unit = system_.UnitOf(limit);
    Measured rate = Rate(along.first / unit);
    const Measured bend = Rate(along.second / unit);
    // A graze is located to the root of rounding only: a value that is past its minimum before it counts as negative.
    if (!system_.IsOfRate(limit))
      rate.error = std::max(rate.error, std::sqrt(2.0 * std::max(bend.value, 0.0) * tolerances::kNoMove));
    if (rate.value < 0.0 && arrival_.failed == limit && SameStates(system_.modes(), point_.modes)) rate.error = 0.0;
    const int sign = LeadingSign({rate, bend});
    if (sign < 0) broken.push_back(limit);
    if (sign == 0) level.push_back(limit);
  }
  if (!broken.empty() || level.empty()) return broken;
  const std::optional<Ahead> ahead = LookAhead(x, first, second);
  if (!ahead) return broken;
  for (const Limit& limit : level)
    if (Rate(system_.mode_limits().Rate(limit, ahead->x, ahead->first) / system_.UnitOf(limit)).Sign() < 0)
      broken.push_back(limit);
  return broken;
}

bool BranchFinder::SetsOut(const Eigen::VectorXd& x, const Eigen::VectorXd& first, const Eigen::VectorXd& second,
                           double error) {
  const PathParameter& parameter = arrival_.parameter;
  int sense = parameter.Sense(first, second, NumMotion(), error);
  if (sense == 0)
    if (const std::optional<Ahead> ahead = LookAhead(x, first, second))
      sense = parameter.Sense(ahead->first, NumMotion());
  return sense > 0;
}

std::optional<BranchFinder::Ahead> BranchFinder::LookAhead(const Eigen::VectorXd& x, const Eigen::VectorXd& first,
                                                           const Eigen::VectorXd& second) {
  const Eigen::Index n = NumMotion();
  const double length = tolerances::kNextToStart;
  Ahead ahead{x + length * first + 0.5 * length * length * second, {}};
  Eigen::VectorXd row = Eigen::VectorXd::Zero(system_.NumUnknowns());
  row.head(n) = first.head(n);
  BorderedSolver solver;
  if (!solver.FactorizeRegular(system_.TransposedJacobian(ahead.x), row, tolerances::kRegularPivot, system_.InFrame()))
    return std::nullopt;
  ahead.first = solver.Solve(Eigen::VectorXd::Zero(system_.NumEquations()), 1.0);
  ahead.first /= ahead.first.head(n).norm();
  return ahead;
}

bool BranchFinder::IsReversed(const Eigen::VectorXd& first) const {
  return (first.head(NumMotion()) + arrival_.direction).norm() < tolerances::kSameTangent;
}

int BranchFinder::SlidingAtRest(const Branch& branch) const {
  int ports = 0;
  for (std::size_t i = 0; i < laws_.size(); ++i) {
    const StateRule& state = laws_[i].In(branch.modes[i]);
    for (std::size_t p = 0; state.slides && p < laws_[i].NumPorts(); ++p)
      if (state.ports[p].Follows() && Rate(laws_[i].TravelRate(p, point_.u, point_.s, point_.modes[i].piece,
                                                               branch.direction, branch.direction[NumMotion() - 1]))
                                              .Sign() == 0)
        ++ports;
  }
  return ports;
}

bool BranchFinder::IsPlainer(const Branch& branch, const Branch& other) const {
  const int idle = SlidingAtRest(branch), others = SlidingAtRest(other);
  if (idle != others) return idle < others;
  return branch.reaction_rate < other.reaction_rate && !SameReactions(branch, other);
}

void BranchFinder::Add(const Tangents& tangents, const Eigen::VectorXd& first, const Eigen::VectorXd& second,
                       std::vector<Branch>* branches) const {
  const Eigen::VectorXd bend = second - first.head(NumMotion()).dot(second.head(NumMotion())) * first;
  Branch branch = BranchAlong(first, bend, laws_, system_.modes(), point_, arrival_.parameter, arrival_.direction);
  branch.mechanism = tangents.mechanism;
  branch.singular = tangents.rests;
  branch.rests = tangents.rests || first.head(NumMotion() - 1).norm() <= tolerances::kRate;
  branch.sense = arrival_.parameter.Sense(first, NumMotion());
  branch.reaction_rate = ForceNorm(laws_, system_.Unpack(first));
  branch.deviation = arrival_.before ? std::min(branch.turn, AngleTo(*arrival_.before, branch.direction)) : branch.turn;
  for (Branch& other : *branches) {
    if ((other.direction - branch.direction).norm() >= tolerances::kSameDirection) continue;
    const bool others = other.other_reactions || !SameReactions(branch, other);
    if (IsPlainer(branch, other)) other = std::move(branch);
    other.other_reactions = others;
    return;
  }
  branches->push_back(std::move(branch));
}

}  // namespace contact_path
