#include "branch/rates_by_forces.h"

#include <cmath>

#include "contact_path/branch/complementarity.h"
#include "contact_path/tolerances.h"

namespace contact_path {
RatesByForces::RatesByForces(const Structure& structure, const Laws& laws, const PathPoint& point, const Modes& modes,
                             const std::vector<int>& weakly_active, const RatePairs& pairs)
    : held_(structure, laws, point, modes, weakly_active), pairs_(pairs) {
  exists_ = NumberForces();
  if (!exists_) return;
  AddForces();
  AddPairs();
}

// Forces are those of held ports and those of pairs: of a port that may slip both ways against the slip, of another one
// w where it slips one way.
bool RatesByForces::NumberForces() {
  const std::vector<RatePairs::Pair>& pairs = pairs_.pairs();
  slip_of_.assign(pairs.size(), -1);
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    if (pairs[p].first_of_two) slip_of_[p] = num_slips_++;
    if (p > 0 && pairs[p - 1].first_of_two) slip_of_[p] = slip_of_[p - 1];
  }
  const auto num_pairs = static_cast<Eigen::Index>(pairs.size());
  force_.resize(held_.Ports().size());
  for (std::size_t d = 0; d < force_.size(); ++d)
    if (pairs_.TurnOf(static_cast<Eigen::Index>(d)) == RatePairs::kHeld)
      force_[d].push_back({held_.system().NumUnknowns() - 1 + num_held_++, 1.0});
  const Eigen::Index first = held_.system().NumUnknowns() - 1 + num_held_ + num_pairs + num_slips_;
  for (std::size_t p = 0; p < pairs.size(); ++p)
    force_[static_cast<std::size_t>(pairs[p].port)].push_back(
        {first + static_cast<Eigen::Index>(p), slip_of_[p] >= 0 ? -pairs[p].sign : pairs[p].sign});
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    if (pairs[p].other < 0) continue;
    const std::vector<Term>& other = force_[static_cast<std::size_t>(pairs[p].other)];
    if (other.empty()) return false;
    if (slip_of_[p] < 0)
      for (const Term& term : other)
        force_[static_cast<std::size_t>(pairs[p].port)].push_back(
            {term.column, -pairs[p].sign * pairs[p].weight * term.share});
  }
  return true;
}

void RatesByForces::AddForces() {
  for (std::size_t d = 0; d < force_.size(); ++d) {
    const LawDofs& dofs = held_.LawOf(static_cast<Eigen::Index>(d)).dofs;
    const PortAt& port = held_.At(static_cast<Eigen::Index>(d));
    for (const Term& term : force_[d])
      for (std::size_t a = 0; a < dofs.size(); ++a)
        entries_.emplace_back(dofs[a], term.column,
                              -term.share * port.factor * port.gradient[static_cast<Eigen::Index>(a)]);
  }
}

void RatesByForces::AddPairs() {
  const std::vector<RatePairs::Pair>& pairs = pairs_.pairs();
  const auto count = static_cast<Eigen::Index>(pairs.size()) + num_slips_;
  Eigen::Index row = held_.system().NumUnknowns() - 1;
  for (std::size_t d = 0; d < force_.size(); ++d)
    if (pairs_.TurnOf(static_cast<Eigen::Index>(d)) == RatePairs::kHeld)
      AddMotion(row++, static_cast<Eigen::Index>(d), 1.0);
  // w less what it is.
  for (Eigen::Index i = 0; i < count; ++i) entries_.emplace_back(row + i, row + i, 1.0);
  const Eigen::Index slips = row + static_cast<Eigen::Index>(pairs.size());
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const Eigen::Index equation = row + static_cast<Eigen::Index>(p);
    AddMotion(equation, pairs[p].port, slip_of_[p] >= 0 ? pairs[p].sign : -pairs[p].sign);
    if (slip_of_[p] < 0) continue;
    const Eigen::Index slip = slips + slip_of_[p];
    entries_.emplace_back(equation, slip + count, -1.0);
    entries_.emplace_back(slip, equation + count, 1.0);
    if (pairs[p].first_of_two)
      for (const Term& term : force_[static_cast<std::size_t>(pairs[p].other)])
        entries_.emplace_back(slip, term.column, -pairs[p].weight * term.share);
  }
}

// factor * the motion of a port, what it gives way by included.
void RatesByForces::AddMotion(Eigen::Index equation, Eigen::Index port, double factor) {
  const LawDofs& dofs = held_.LawOf(port).dofs;
  const LawVector& gradient = held_.At(port).gradient;
  for (std::size_t a = 0; a < dofs.size(); ++a)
    entries_.emplace_back(equation, dofs[a], factor * gradient[static_cast<Eigen::Index>(a)]);
  for (const Term& term : force_[static_cast<std::size_t>(port)])
    entries_.emplace_back(equation, term.column, factor * pairs_.Compliances()[port] * term.share);
  const auto pairs = static_cast<Eigen::Index>(pairs_.pairs().size()) + num_slips_;
  entries_.emplace_back(equation, held_.system().NumUnknowns() - 1 + num_held_ + 2 * pairs,
                        factor * gradient[static_cast<Eigen::Index>(dofs.size())]);
}

// Forces over k and motions times k, k^2 the stiffness of the springs, so that motions and forces are of one size.
// changes: of motions far below what ports give way by.
void RatesByForces::Scale(double share, Eigen::SparseMatrix<double>* equations, Eigen::VectorXd* changes) const {
  const Eigen::Index nd = held_.system().NumDofs(), first = held_.system().NumUnknowns() - 1 + num_held_;
  const auto pairs = static_cast<Eigen::Index>(pairs_.pairs().size());
  const double spring = held_.Springs().maxCoeff(), k = std::sqrt(spring * share);
  const double force = kOfTies * equations->col(equations->cols() - 1).toDense().lpNorm<Eigen::Infinity>();
  Eigen::VectorXd rows = Eigen::VectorXd::Constant(equations->rows(), k);
  Eigen::VectorXd columns = Eigen::VectorXd::Constant(equations->cols(), k);
  rows.head(nd).setConstant(1.0 / k);
  rows.tail(num_slips_).setConstant(1.0 / k);
  columns.head(nd).setConstant(1.0 / k);
  columns.segment(first, pairs).setConstant(1.0 / k);
  columns.segment(first + 2 * pairs + num_slips_, num_slips_).setConstant(1.0 / k);
  columns.tail<1>().setOnes();
  *equations = Eigen::SparseMatrix<double>(rows.asDiagonal() * *equations * columns.asDiagonal());
  *changes = Eigen::VectorXd::Constant(pairs + num_slips_, force * k / spring);
  changes->tail(num_slips_).setConstant(force / k);
}

std::optional<States> RatesByForces::Solve(double load_sense, double share, ComplementaritySolution* near) const {
  if (!exists_) return std::nullopt;
  const Eigen::SparseMatrix<double> of_structure = held_.TransposedJacobian(share);
  const Eigen::Index s = held_.system().NumDofs();
  ComplementarityProblem problem;
  problem.pairs = static_cast<Eigen::Index>(pairs_.pairs().size()) + num_slips_;
  const Eigen::Index rows = of_structure.cols() + num_held_ + problem.pairs, last = rows + problem.pairs;
  std::vector<Eigen::Triplet<double>> entries = entries_;
  for (Eigen::Index equation = 0; equation < of_structure.cols(); ++equation)
    for (Eigen::SparseMatrix<double>::InnerIterator it(of_structure, equation); it; ++it)
      entries.emplace_back(equation, it.row() == s ? last : it.row() < s ? it.row() : it.row() - 1, it.value());
  Eigen::SparseMatrix<double> all(rows, last + 1);
  all.setFromTriplets(entries.begin(), entries.end());
  Scale(share, &all, &problem.changes);
  problem.right = -load_sense * all.col(last);
  problem.equations = all.leftCols(last);
  if (!problem.right.allFinite()) return std::nullopt;
  const Eigen::VectorXd cover = Eigen::VectorXd::Ones(problem.pairs);
  Eigen::VectorXd values;
  std::optional<ComplementaritySolution> forces = SolveByLemke(problem, cover, *near, &values);
  if (!forces && !near->empty()) forces = SolveByLemke(problem, cover, {}, &values);
  if (!forces) return std::nullopt;
  *near = *forces;
  // Where neither force nor motion tells, as of a part that others do not touch with a force, the port is held.
  const double moves = tolerances::kRate * values.lpNorm<Eigen::Infinity>();
  std::vector<bool> beyond;
  const std::size_t num_pairs = pairs_.pairs().size();
  for (std::size_t p = 0; p < num_pairs; ++p) {
    const std::size_t motion = slip_of_[p] < 0 ? p : num_pairs + static_cast<std::size_t>(slip_of_[p]);
    const bool may = slip_of_[p] < 0 ? !(*forces)[p] : (*forces)[p] && (*forces)[motion];
    beyond.push_back(may && values[static_cast<Eigen::Index>(motion)] > moves);
  }
  return pairs_.StatesBeyond(beyond);
}

}  // namespace contact_path
