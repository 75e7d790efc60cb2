#include "contact_path/contact/fixed_state_system.h"

#include <algorithm>
#include <cmath>

namespace contact_path {
namespace {}  // namespace

FixedStateSystem::FixedStateSystem(const Structure& structure, const std::vector<ContactGeometry>& contacts)
    : structure_(structure), contacts_(contacts), tangent_(structure.TangentPattern()) {
  SetStates(std::vector<ContactState>(contacts.size(), ContactState::kOpen),
            Eigen::VectorXd::Zero(static_cast<Eigen::Index>(contacts.size())));
}

void FixedStateSystem::SetStates(const std::vector<ContactState>& states, const Eigen::VectorXd& tangential_reference) {
  states_ = states;
  tangential_reference_ = tangential_reference;
  active_.clear();
  load_factor_fixed_ = false;
  rn_unknown_.assign(contacts_.size(), -1);
  rt_unknown_.assign(contacts_.size(), -1);
  num_unknowns_ = NumDofs() + 1;
  touching_.clear();
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    if (states_[i] == ContactState::kOpen) continue;
    touching_.push_back(i);
    rn_unknown_[i] = num_unknowns_++;
    if (states_[i] == ContactState::kStick) rt_unknown_[i] = num_unknowns_++;
  }
  first_support_ = num_unknowns_;
  num_unknowns_ += static_cast<Eigen::Index>(structure_.PrescribedDofs().size());
  Rebuild();
}

void FixedStateSystem::SetActive(const std::vector<Constraint>& limits) {
  active_ = limits;
  Rebuild();
}

void FixedStateSystem::FixLoadFactor(double value) {
  load_factor_fixed_ = true;
  load_factor_ = value;
  Rebuild();
}

void FixedStateSystem::FreeLoadFactor() {
  load_factor_fixed_ = false;
  Rebuild();
}

void FixedStateSystem::AddFunction(const SparseLinear& function, double sign, LinearEquation* equation) const {
  for (std::size_t a = 0; a < 2; ++a)
    if (function.dofs[a] >= 0) equation->Add(function.dofs[a], sign * function.coefficients[a]);
  if (function.load != 0.0) equation->Add(NumDofs(), sign * function.load);
  equation->constant = sign * function.offset;
}

FixedStateSystem::LinearEquation FixedStateSystem::Gap(std::size_t contact) const {
  LinearEquation equation;
  AddFunction(contacts_[contact].gap, 1.0, &equation);
  return equation;
}

FixedStateSystem::LinearEquation FixedStateSystem::TangentialMotion(std::size_t contact, double sign) const {
  LinearEquation equation;
  AddFunction(contacts_[contact].tangential, sign, &equation);
  equation.constant -= sign * tangential_reference_[static_cast<Eigen::Index>(contact)];
  return equation;
}

FixedStateSystem::LinearEquation FixedStateSystem::InequalityAsEquation(const Constraint& limit) const {
  const auto i = static_cast<std::size_t>(limit.contact);
  LinearEquation equation;
  switch (limit.inequality) {
    case Inequality::kGap: return Gap(i);
    case Inequality::kSlip: return TangentialMotion(i, states_[i] == ContactState::kSlipPlus ? 1.0 : -1.0);
    case Inequality::kNormalReaction: equation.Add(rn_unknown_[i], 1.0); break;
    case Inequality::kConePlus:
    case Inequality::kConeMinus:
      equation.Add(rn_unknown_[i], contacts_[i].friction);
      equation.Add(rt_unknown_[i], limit.inequality == Inequality::kConePlus ? 1.0 : -1.0);
      break;
  }
  return equation;
}

void FixedStateSystem::Rebuild() {
  linear_.clear();
  for (const std::size_t i : touching_) {
    linear_.push_back(Gap(i));
    if (states_[i] == ContactState::kStick) linear_.push_back(TangentialMotion(i, 1.0));
  }
  for (const PrescribedDof& prescribed : structure_.PrescribedDofs()) {
    LinearEquation& equation = linear_.emplace_back();
    equation.Add(prescribed.dof, 1.0);
    equation.Add(NumDofs(), -prescribed.rate);
    equation.constant = -prescribed.start;
  }
  for (const Constraint& limit : active_) linear_.push_back(InequalityAsEquation(limit));
  if (load_factor_fixed_) {
    linear_.emplace_back().Add(NumDofs(), 1.0);
    linear_.back().constant = -load_factor_;
  }
  num_equations_ = NumDofs() + static_cast<Eigen::Index>(linear_.size());

  // Columns of the transposed Jacobian are equations. All but the tangent is constant and is written here once.
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(static_cast<std::size_t>(tangent_.nonZeros() + NumDofs()) + 8 * linear_.size());
  for (Eigen::Index column = 0; column < NumDofs(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(tangent_, column); it; ++it)
      triplets.emplace_back(it.row(), column, 0.0);
    triplets.emplace_back(NumDofs(), column, -structure_.ReferenceLoad()[column]);
  }
  for (const std::size_t i : touching_) {
    const double ratio = SlipRatio(states_[i], contacts_[i].friction);
    for (std::size_t a = 0; a < 2; ++a) {
      const SparseLinear &gap = contacts_[i].gap, &tangential = contacts_[i].tangential;
      if (gap.dofs[a] >= 0) triplets.emplace_back(rn_unknown_[i], gap.dofs[a], -gap.coefficients[a]);
      if (tangential.dofs[a] < 0) continue;
      if (rt_unknown_[i] >= 0) triplets.emplace_back(rt_unknown_[i], tangential.dofs[a], -tangential.coefficients[a]);
      if (ratio != 0.0) triplets.emplace_back(rn_unknown_[i], tangential.dofs[a], -ratio * tangential.coefficients[a]);
    }
  }
  for (std::size_t k = 0; k < structure_.PrescribedDofs().size(); ++k)
    triplets.emplace_back(first_support_ + static_cast<Eigen::Index>(k), structure_.PrescribedDofs()[k].dof, -1.0);
  for (std::size_t e = 0; e < linear_.size(); ++e)
    for (std::size_t k = 0; k < linear_[e].count; ++k)
      triplets.emplace_back(linear_[e].terms[k].unknown, NumDofs() + static_cast<Eigen::Index>(e),
                            linear_[e].terms[k].coefficient);
  transposed_.resize(num_unknowns_, num_equations_);
  transposed_.setFromTriplets(triplets.begin(), triplets.end());
  transposed_.makeCompressed();
}

Eigen::VectorXd FixedStateSystem::Pack(const PathPoint& point) const {
  Eigen::VectorXd x(num_unknowns_);
  x.head(NumDofs()) = point.u;
  x[NumDofs()] = point.s;
  for (const std::size_t i : touching_) {
    x[rn_unknown_[i]] = point.rn[static_cast<Eigen::Index>(i)];
    if (rt_unknown_[i] >= 0) x[rt_unknown_[i]] = point.rt[static_cast<Eigen::Index>(i)];
  }
  x.tail(num_unknowns_ - first_support_) = structure_.SupportReactions(point.u, point.s);
  return x;
}

PathPoint FixedStateSystem::Unpack(const Eigen::VectorXd& x) const {
  PathPoint point;
  point.u = x.head(NumDofs());
  point.s = x[NumDofs()];
  point.rn = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(contacts_.size()));
  point.rt = point.rn;
  point.states = states_;
  for (const std::size_t i : touching_) {
    const auto k = static_cast<Eigen::Index>(i);
    point.rn[k] = x[rn_unknown_[i]];
    if (rt_unknown_[i] >= 0)
      point.rt[k] = x[rt_unknown_[i]];
    else if (Slips(states_[i]))
      point.rt[k] = SlipRatio(states_[i], contacts_[i].friction) * point.rn[k];
  }
  return point;
}

void FixedStateSystem::Residual(const Eigen::VectorXd& x, Eigen::VectorXd* residual) const {
  residual->resize(num_equations_);
  structure_.InternalForce(x.head(NumDofs()), residual->head(NumDofs()));
  residual->head(NumDofs()) -= x[NumDofs()] * structure_.ReferenceLoad() + structure_.ConstantLoad();
  for (const std::size_t i : touching_) {
    const double rn = x[rn_unknown_[i]];
    const double rt = rt_unknown_[i] >= 0 ? x[rt_unknown_[i]] : SlipRatio(states_[i], contacts_[i].friction) * rn;
    contacts_[i].gap.AddGradient(-rn, residual);
    contacts_[i].tangential.AddGradient(-rt, residual);
  }
  for (std::size_t k = 0; k < structure_.PrescribedDofs().size(); ++k)
    (*residual)[structure_.PrescribedDofs()[k].dof] -= x[first_support_ + static_cast<Eigen::Index>(k)];
  for (std::size_t e = 0; e < linear_.size(); ++e)
    (*residual)[NumDofs() + static_cast<Eigen::Index>(e)] = linear_[e].constant + linear_[e].Rate(x);
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

void FixedStateSystem::AddInequalities(std::size_t contact, std::vector<Constraint>* limits) const {
  const auto i = static_cast<int>(contact);
  if (states_[contact] == ContactState::kOpen) {
    limits->push_back({i, Inequality::kGap});
    return;
  }
  limits->push_back({i, Inequality::kNormalReaction});
  if (states_[contact] == ContactState::kStick) {
    limits->push_back({i, Inequality::kConePlus});
    limits->push_back({i, Inequality::kConeMinus});
  } else if (Slips(states_[contact])) {
    limits->push_back({i, Inequality::kSlip});
  }
}

std::vector<Constraint> FixedStateSystem::Inequalities() const {
  std::vector<Constraint> limits;
  for (std::size_t i = 0; i < contacts_.size(); ++i) AddInequalities(i, &limits);
  return limits;
}

std::vector<Constraint> FixedStateSystem::InequalitiesInReach(const Eigen::VectorXd& x, double reach) const {
  std::vector<Constraint> limits;
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    if (states_[i] != ContactState::kOpen ||
        contacts_[i].gap.Value(x, x[NumDofs()]) <= reach * (1.0 + std::abs(contacts_[i].gap.load)))
      AddInequalities(i, &limits);
  return limits;
}

double FixedStateSystem::Value(const Constraint& limit, const Eigen::VectorXd& x) const {
  const LinearEquation equation = InequalityAsEquation(limit);
  return equation.constant + equation.Rate(x);
}

double FixedStateSystem::DrivingForce(const Eigen::VectorXd& x) const {
  double force = 0.0;
  for (std::size_t k = 0; k < structure_.PrescribedDofs().size(); ++k)
    force += structure_.PrescribedDofs()[k].rate * x[first_support_ + static_cast<Eigen::Index>(k)];
  for (const std::size_t i : touching_) {
    const double rn = x[rn_unknown_[i]];
    const double rt = rt_unknown_[i] >= 0 ? x[rt_unknown_[i]] : SlipRatio(states_[i], contacts_[i].friction) * rn;
    force -= rn * contacts_[i].gap.load + rt * contacts_[i].tangential.load;
  }
  return force;
}

double FixedStateSystem::Rate(const Constraint& limit, const Eigen::VectorXd& dx) const {
  return InequalityAsEquation(limit).Rate(dx);
}

Eigen::VectorXd FixedStateSystem::Gradient(const Constraint& limit) const {
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(num_unknowns_);
  const LinearEquation equation = InequalityAsEquation(limit);
  for (std::size_t k = 0; k < equation.count; ++k) gradient[equation.terms[k].unknown] += equation.terms[k].coefficient;
  return gradient;
}

Eigen::VectorXd FixedStateSystem::SecondDerivative(const Eigen::VectorXd& x, const Eigen::VectorXd& dx) {
  // All equations but the internal force are linear. tangent_ is scratch between calls.
  structure_.TangentDerivative(x.head(NumDofs()), dx.head(NumDofs()), &tangent_);
  Eigen::VectorXd second = Eigen::VectorXd::Zero(num_equations_);
  second.head(NumDofs()) = tangent_ * dx.head(NumDofs());
  return second;
}

}  // namespace contact_path
