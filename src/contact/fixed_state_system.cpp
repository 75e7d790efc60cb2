#include "contact_path/contact/fixed_state_system.h"

#include <algorithm>

namespace contact_path {
namespace {

bool Slips(ContactState state) { return state == ContactState::kSlipPlus || state == ContactState::kSlipMinus; }

}  // namespace

FixedStateSystem::FixedStateSystem(const Structure& structure, const std::vector<ContactGeometry>& contacts)
    : structure_(structure), contacts_(contacts), tangent_(structure.TangentPattern()) {
  SetStates(std::vector<ContactState>(contacts.size(), ContactState::kOpen),
            Eigen::VectorXd::Zero(static_cast<Eigen::Index>(contacts.size())));
}

void FixedStateSystem::SetStates(const std::vector<ContactState>& states, const Eigen::VectorXd& tangential_reference) {
  states_ = states;
  tangential_reference_ = tangential_reference;
  pinned_.clear();
  load_factor_pinned_ = false;
  rn_unknown_.assign(contacts_.size(), -1);
  rt_unknown_.assign(contacts_.size(), -1);
  num_unknowns_ = NumDofs() + 1;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    if (states_[i] == ContactState::kOpen) continue;
    rn_unknown_[i] = num_unknowns_++;
    if (states_[i] == ContactState::kStick) rt_unknown_[i] = num_unknowns_++;
  }
  Rebuild();
}

void FixedStateSystem::Pin(const std::vector<Limit>& limits) {
  pinned_ = limits;
  Rebuild();
}

void FixedStateSystem::PinLoadFactor(double value) {
  load_factor_pinned_ = true;
  load_factor_ = value;
  Rebuild();
}

void FixedStateSystem::UnpinLoadFactor() {
  load_factor_pinned_ = false;
  Rebuild();
}

FixedStateSystem::LinearEquation FixedStateSystem::Gap(std::size_t contact) const {
  LinearEquation equation;
  const SparseLinear& gap = contacts_[contact].gap;
  for (std::size_t a = 0; a < 2; ++a)
    if (gap.dofs[a] >= 0) equation.terms.push_back({gap.dofs[a], gap.coefficients[a]});
  equation.constant = gap.offset;
  return equation;
}

FixedStateSystem::LinearEquation FixedStateSystem::TangentialMotion(std::size_t contact, double sign) const {
  LinearEquation equation;
  const SparseLinear& tangential = contacts_[contact].tangential;
  for (std::size_t a = 0; a < 2; ++a)
    if (tangential.dofs[a] >= 0) equation.terms.push_back({tangential.dofs[a], sign * tangential.coefficients[a]});
  equation.constant = sign * (tangential.offset - tangential_reference_[static_cast<Eigen::Index>(contact)]);
  return equation;
}

FixedStateSystem::LinearEquation FixedStateSystem::InequalityAsEquation(const Limit& limit) const {
  const auto i = static_cast<std::size_t>(limit.contact);
  const double friction = contacts_[i].friction;
  switch (limit.inequality) {
    case Inequality::kGap: return Gap(i);
    case Inequality::kNormalReaction: return {{{rn_unknown_[i], 1.0}}, 0.0};
    case Inequality::kConePlus: return {{{rn_unknown_[i], friction}, {rt_unknown_[i], 1.0}}, 0.0};
    case Inequality::kConeMinus: return {{{rn_unknown_[i], friction}, {rt_unknown_[i], -1.0}}, 0.0};
    case Inequality::kSlip: return TangentialMotion(i, states_[i] == ContactState::kSlipPlus ? 1.0 : -1.0);
  }
  return {};
}

void FixedStateSystem::Rebuild() {
  linear_.clear();
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    if (states_[i] == ContactState::kOpen) continue;
    linear_.push_back(Gap(i));
    if (states_[i] == ContactState::kStick) linear_.push_back(TangentialMotion(i, 1.0));
  }
  for (const Limit& limit : pinned_) linear_.push_back(InequalityAsEquation(limit));
  if (load_factor_pinned_) linear_.push_back({{{NumDofs(), 1.0}}, -load_factor_});
  num_equations_ = NumDofs() + static_cast<Eigen::Index>(linear_.size());

  // Columns of the transposed Jacobian are equations. All but the tangent is constant and is written here once.
  std::vector<Eigen::Triplet<double>> triplets;
  for (Eigen::Index column = 0; column < NumDofs(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(tangent_, column); it; ++it)
      triplets.emplace_back(it.row(), column, 0.0);
    triplets.emplace_back(NumDofs(), column, -structure_.ReferenceLoad()[column]);
  }
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    if (states_[i] == ContactState::kOpen) continue;
    const double ratio = SlipRatio(states_[i], contacts_[i].friction);
    for (std::size_t a = 0; a < 2; ++a) {
      const SparseLinear &gap = contacts_[i].gap, &tangential = contacts_[i].tangential;
      if (gap.dofs[a] >= 0) triplets.emplace_back(rn_unknown_[i], gap.dofs[a], -gap.coefficients[a]);
      if (tangential.dofs[a] < 0) continue;
      if (rt_unknown_[i] >= 0) triplets.emplace_back(rt_unknown_[i], tangential.dofs[a], -tangential.coefficients[a]);
      if (ratio != 0.0) triplets.emplace_back(rn_unknown_[i], tangential.dofs[a], -ratio * tangential.coefficients[a]);
    }
  }
  for (std::size_t e = 0; e < linear_.size(); ++e)
    for (const Term& term : linear_[e].terms)
      triplets.emplace_back(term.unknown, NumDofs() + static_cast<Eigen::Index>(e), term.coefficient);
  transposed_.resize(num_unknowns_, num_equations_);
  transposed_.setFromTriplets(triplets.begin(), triplets.end());
  transposed_.makeCompressed();
}

Eigen::VectorXd FixedStateSystem::Pack(const PathPoint& point) const {
  Eigen::VectorXd x(num_unknowns_);
  x.head(NumDofs()) = point.u;
  x[NumDofs()] = point.s;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    if (rn_unknown_[i] >= 0) x[rn_unknown_[i]] = point.rn[static_cast<Eigen::Index>(i)];
    if (rt_unknown_[i] >= 0) x[rt_unknown_[i]] = point.rt[static_cast<Eigen::Index>(i)];
  }
  return x;
}

PathPoint FixedStateSystem::Unpack(const Eigen::VectorXd& x) const {
  PathPoint point;
  point.u = x.head(NumDofs());
  point.s = x[NumDofs()];
  point.rn = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(contacts_.size()));
  point.rt = point.rn;
  point.states = states_;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    if (rn_unknown_[i] >= 0) point.rn[k] = x[rn_unknown_[i]];
    if (rt_unknown_[i] >= 0)
      point.rt[k] = x[rt_unknown_[i]];
    else if (Slips(states_[i]))
      point.rt[k] = SlipRatio(states_[i], contacts_[i].friction) * point.rn[k];
  }
  return point;
}

void FixedStateSystem::Residual(const Eigen::VectorXd& x, Eigen::VectorXd* residual) const {
  const PathPoint point = Unpack(x);
  Eigen::VectorXd force;
  structure_.InternalForce(point.u, &force);
  force -= point.s * structure_.ReferenceLoad() + structure_.ConstantLoad();
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    if (states_[i] == ContactState::kOpen) continue;
    contacts_[i].gap.AddGradient(-point.rn[static_cast<Eigen::Index>(i)], &force);
    contacts_[i].tangential.AddGradient(-point.rt[static_cast<Eigen::Index>(i)], &force);
  }
  residual->resize(num_equations_);
  residual->head(NumDofs()) = force;
  for (std::size_t e = 0; e < linear_.size(); ++e) {
    double value = linear_[e].constant;
    for (const Term& term : linear_[e].terms) value += term.coefficient * x[term.unknown];
    (*residual)[NumDofs() + static_cast<Eigen::Index>(e)] = value;
  }
}

const Eigen::SparseMatrix<double>& FixedStateSystem::TransposedJacobian(const Eigen::VectorXd& x) {
  structure_.Tangent(x.head(NumDofs()), &tangent_);
  // The rows of the tangent come first in each column, in the same order.
  for (Eigen::Index column = 0; column < NumDofs(); ++column) {
    const int first = tangent_.outerIndexPtr()[column];
    const int count = tangent_.outerIndexPtr()[column + 1] - first;
    std::copy_n(tangent_.valuePtr() + first, count, transposed_.valuePtr() + transposed_.outerIndexPtr()[column]);
  }
  return transposed_;
}

std::vector<Limit> FixedStateSystem::Inequalities() const {
  std::vector<Limit> limits;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const auto contact = static_cast<int>(i);
    if (states_[i] == ContactState::kOpen) {
      limits.push_back({contact, Inequality::kGap});
      continue;
    }
    limits.push_back({contact, Inequality::kNormalReaction});
    if (states_[i] == ContactState::kStick) {
      limits.push_back({contact, Inequality::kConePlus});
      limits.push_back({contact, Inequality::kConeMinus});
    } else if (Slips(states_[i])) {
      limits.push_back({contact, Inequality::kSlip});
    }
  }
  return limits;
}

double FixedStateSystem::Value(const Limit& limit, const Eigen::VectorXd& x) const {
  const LinearEquation equation = InequalityAsEquation(limit);
  double value = equation.constant;
  for (const Term& term : equation.terms) value += term.coefficient * x[term.unknown];
  return value;
}

double FixedStateSystem::Rate(const Limit& limit, const Eigen::VectorXd& dx) const {
  double rate = 0.0;
  for (const Term& term : InequalityAsEquation(limit).terms) rate += term.coefficient * dx[term.unknown];
  return rate;
}

Eigen::VectorXd FixedStateSystem::Gradient(const Limit& limit) const {
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(num_unknowns_);
  for (const Term& term : InequalityAsEquation(limit).terms) gradient[term.unknown] += term.coefficient;
  return gradient;
}

Eigen::VectorXd FixedStateSystem::SecondDerivative(const Eigen::VectorXd& x, const Eigen::VectorXd& dx) {
  // All equations but the internal force are linear. tangent_ is scratch between calls.
  const Eigen::VectorXd du = dx.head(NumDofs());
  structure_.TangentDerivative(x.head(NumDofs()), du, &tangent_);
  Eigen::VectorXd second = Eigen::VectorXd::Zero(num_equations_);
  second.head(NumDofs()) = tangent_ * du;
  return second;
}

}  // namespace contact_path
