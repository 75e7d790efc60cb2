#include "contact_path/equations/fixed_mode_system.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace contact_path {

FixedModeSystem::FixedModeSystem(const Structure& structure, const Laws& laws)
    : structure_(structure), laws_(laws), tangent_(structure.TangentPattern()) {
  if (structure.NumDofs() > 0) residual_unit_ = structure.ResidualUnits().maxCoeff();
  Modes idle(laws.size());
  for (std::size_t i = 0; i < laws.size(); ++i)
    while (laws[i].CanBeIdle() && !laws[i].In(idle[i]).idle) ++idle[i].state;
  SetModes(idle);
}

void FixedModeSystem::SetModes(const Modes& modes, const Eigen::VectorXd& references) {
  modes_ = modes;
  reference_ = references.size() > 0 ? references : Eigen::VectorXd::Zero(laws_.NumPorts());
  active_.clear();
  load_factor_fixed_ = false;
  unknown_.assign(static_cast<std::size_t>(laws_.NumPorts()), -1);
  num_unknowns_ = NumDofs() + 1;
  acting_.clear();
  for (std::size_t i = 0; i < laws_.size(); ++i) {
    const StateRule& state = laws_[i].In(modes_[i]);
    if (state.idle) continue;
    acting_.push_back(i);
    for (std::size_t p = 0; p < laws_[i].NumPorts(); ++p)
      if (state.ports[p].Holds()) unknown_[static_cast<std::size_t>(laws_.FirstPort(i)) + p] = num_unknowns_++;
  }
  first_support_ = num_unknowns_;
  num_unknowns_ += static_cast<Eigen::Index>(structure_.PrescribedDofs().size());
  NumberEquations();
}

void FixedModeSystem::SetActive(const std::vector<Limit>& limits) {
  active_ = limits;
  NumberEquations();
}

void FixedModeSystem::FixLoadFactor(double value) {
  load_factor_fixed_ = true;
  load_factor_ = value;
  NumberEquations();
}

FixedModeSystem::Motion FixedModeSystem::MotionOf(const Limit& limit) const {
  const auto i = static_cast<std::size_t>(limit.law);
  const LimitRule& rule = RuleOf(limit);
  if (!rule.OfPiece()) return {i, rule.port, rule.sign};
  const double reference = laws_.Of(reference_, i)[rule.port];
  return {i, rule.port, rule.sign, rule.sign * (reference - laws_[i].BoundOf(modes_[i], limit.id))};
}

PortsAt FixedModeSystem::Evaluate(std::size_t law, const Eigen::VectorXd& x) const {
  PortsAt at;
  laws_[law].Evaluate(x, x[NumDofs()], modes_[law].piece, laws_.Of(reference_, law), &at);
  return at;
}

PortReals FixedModeSystem::ForcesOf(std::size_t law, const Eigen::VectorXd& x) const {
  const StateRule& state = laws_[law].In(modes_[law]);
  PortReals forces{};
  for (std::size_t p = 0; p < laws_[law].NumPorts(); ++p) {
    if (state.ports[p].Holds()) forces[p] = x[UnknownOf(law, p)];
    if (state.ports[p].Follows()) forces[p] = state.ports[p].ratio * forces[0];
  }
  return forces;
}

void FixedModeSystem::NumberEquations() {
  placed_ = false;
  transposed_.resize(0, 0);
  motions_.clear();
  Eigen::Index next = NumDofs();
  for (const std::size_t i : acting_)
    for (std::size_t p = 0; p < laws_[i].NumPorts(); ++p)
      if (const PortRule& port = laws_[i].In(modes_[i]).ports[p]; port.Holds())
        motions_.push_back({{i, p}, next++, port.compliance, UnknownOf(i, p)});
  first_support_equation_ = next;
  next += static_cast<Eigen::Index>(structure_.PrescribedDofs().size());
  first_active_equation_ = next;
  for (const Limit& limit : active_) {
    const LimitRule& rule = RuleOf(limit);
    const auto i = static_cast<std::size_t>(limit.law);
    if (rule.compliance != 0.0)  // the port follows the first one
      motions_.push_back({MotionOf(limit), next,
                          rule.sign * rule.compliance * laws_[i].In(modes_[i]).ports[rule.port].ratio,
                          UnknownOf(i, 0)});
    else if (!rule.OfForces())
      motions_.push_back({MotionOf(limit), next});
    ++next;
  }
  num_equations_ = next + (load_factor_fixed_ ? 1 : 0);
  const auto some = [this](auto has) {
    return std::any_of(motions_.begin(), motions_.end(),
                       [&](const MotionEquation& of) { return has(laws_[of.motion.law]); });
  };
  curved_ = some([](const Law& law) { return law.Curved(); });
  couples_ = some([](const Law& law) { return law.Couples(); });
  gives_ = some([](const Law& law) { return law.Compliant() && !law.Elastic(); });
}

template <typename Emit>
void FixedModeSystem::ForEachMotionEntry(const MotionEquation& of, const PortsAt& at, Emit emit) const {
  const Law& law = laws_[of.motion.law];
  const LawVector& gradient = at[of.motion.port].gradient;
  const std::size_t m = at.dofs.size();
  for (std::size_t k = 0; k <= m; ++k)
    if (law.Moves(of.motion.port, k))
      emit(k < m ? at.dofs[k] : NumDofs(), of.equation, of.motion.sign * gradient[static_cast<Eigen::Index>(k)]);
}

template <typename Emit>
void FixedModeSystem::ForEachForceEntry(std::size_t law, const PortsAt& at, Emit emit) const {
  const Law& of = laws_[law];
  const StateRule& state = of.In(modes_[law]);
  for (std::size_t k = 0; k < at.dofs.size(); ++k) {
    const auto e = static_cast<Eigen::Index>(k);
    for (std::size_t p = 0; p < of.NumPorts(); ++p) {
      const PortRule& port = state.ports[p];
      if (port.kind == PortRule::Kind::kFree || !of.Moves(p, k)) continue;
      if (port.Holds())
        emit(UnknownOf(law, p), at.dofs[k], -at[p].factor * at[p].gradient[e]);
      else
        emit(UnknownOf(law, 0), at.dofs[k], -(port.ratio * at[p].factor) * at[p].gradient[e]);
    }
  }
}

template <typename Emit>
void FixedModeSystem::ForEachCurvatureEntry(const PortsAt& at, const PortReals& forces, Emit emit) const {
  const LawMatrix change = at.ForceChange(forces);
  const std::size_t m = at.dofs.size();
  for (std::size_t column = 0; column < m; ++column)
    for (std::size_t row = 0; row <= m; ++row)
      emit(row < m ? at.dofs[row] : NumDofs(), at.dofs[column],
           -change(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)));
}

template <typename Emit>
void FixedModeSystem::ForEachConstantEntry(Emit emit) const {
  for (Eigen::Index column = 0; column < NumDofs(); ++column)
    emit(NumDofs(), column, -structure_.ReferenceLoad()[column]);
  Eigen::Index k = 0;
  for (const PrescribedDof& prescribed : structure_.PrescribedDofs()) {
    emit(first_support_ + k, prescribed.dof, -1.0);
    emit(prescribed.dof, first_support_equation_ + k, 1.0);
    emit(NumDofs(), first_support_equation_ + k, -prescribed.rate);
    ++k;
  }
  for (const MotionEquation& of : motions_)
    if (of.compliance != 0.0) emit(of.force, of.equation, of.compliance);
  for (std::size_t c = 0; c < active_.size(); ++c) {
    const LimitRule& rule = RuleOf(active_[c]);
    if (!rule.OfForces()) continue;
    for (std::size_t p = 0; p < rule.weights.size(); ++p)
      if (rule.weights[p] != 0.0)
        emit(UnknownOf(static_cast<std::size_t>(active_[c].law), p),
             first_active_equation_ + static_cast<Eigen::Index>(c), rule.weights[p]);
  }
  if (load_factor_fixed_) emit(NumDofs(), num_equations_ - 1, 1.0);
}

void FixedModeSystem::Rebuild() {
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(static_cast<std::size_t>(tangent_.nonZeros() + NumDofs()) + 6 * acting_.size() +
                   4 * static_cast<std::size_t>(num_equations_ - NumDofs()));
  const auto add = [&triplets](Eigen::Index unknown, Eigen::Index equation, double value) {
    triplets.emplace_back(unknown, equation, value);
  };
  const auto add_place = [&triplets](Eigen::Index unknown, Eigen::Index equation, double) {
    triplets.emplace_back(unknown, equation, 0.0);
  };
  for (Eigen::Index column = 0; column < NumDofs(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator it(tangent_, column); it; ++it) add(it.row(), column, 0.0);
  ForEachConstantEntry(add);
  // Derivatives of laws without curvature are the same everywhere. Those of others come with each point.
  Eigen::VectorXd anywhere = Eigen::VectorXd::Zero(NumDofs() + 1);
  anywhere.head(NumDofs()) = structure_.Start();
  for (const std::size_t i : acting_) {
    const PortsAt at = Evaluate(i, anywhere);
    if (laws_[i].Curved()) {
      ForEachForceEntry(i, at, add_place);
      ForEachCurvatureEntry(at, {}, add_place);
    } else {
      ForEachForceEntry(i, at, add);
    }
  }
  for (const MotionEquation& of : motions_) {
    const PortsAt at = Evaluate(of.motion.law, anywhere);
    if (laws_[of.motion.law].Curved())
      ForEachMotionEntry(of, at, add_place);
    else
      ForEachMotionEntry(of, at, add);
  }
  transposed_.resize(num_unknowns_, num_equations_);
  transposed_.setFromTriplets(triplets.begin(), triplets.end());
  transposed_.makeCompressed();
  if (curved_) constant_ = Eigen::Map<const Eigen::VectorXd>(transposed_.valuePtr(), transposed_.nonZeros());
}

Eigen::VectorXd FixedModeSystem::Pack(const PathPoint& point) const {
  Eigen::VectorXd x(num_unknowns_);
  x.head(NumDofs()) = point.u;
  x[NumDofs()] = point.s;
  for (std::size_t port = 0; port < unknown_.size(); ++port)
    if (unknown_[port] >= 0) x[unknown_[port]] = point.forces[static_cast<Eigen::Index>(port)];
  x.tail(num_unknowns_ - first_support_) = structure_.SupportReactions(point.u, point.s);
  if (first_support_ == num_unknowns_) return x;
  // Laws may pull at what moves as it is told.
  Eigen::VectorXd pull = Eigen::VectorXd::Zero(NumDofs());
  for (const std::size_t i : acting_) {
    const PortsAt at = Evaluate(i, x);
    const PortReals forces = ForcesOf(i, x);
    for (std::size_t p = 0; p < laws_[i].NumPorts(); ++p) at.AddForce(at[p].gradient, forces[p] * at[p].factor, &pull);
  }
  Eigen::Index k = first_support_;
  for (const PrescribedDof& prescribed : structure_.PrescribedDofs()) x[k++] -= pull[prescribed.dof];
  return x;
}

PathPoint FixedModeSystem::Unpack(const Eigen::VectorXd& x) const {
  PathPoint point;
  point.u = x.head(NumDofs());
  point.s = x[NumDofs()];
  point.forces = Eigen::VectorXd::Zero(laws_.NumPorts());
  for (const std::size_t i : acting_) laws_.Put(ForcesOf(i, x), i, &point.forces);
  point.modes.reserve(modes_.size());
  for (std::size_t i = 0; i < modes_.size(); ++i) point.modes.push_back(laws_[i].OfPoint(modes_[i]));
  return point;
}

void FixedModeSystem::Residual(const Eigen::VectorXd& x, Eigen::VectorXd* residual) const {
  const double s = x[NumDofs()];
  residual->resize(num_equations_);
  structure_.InternalForce(x.head(NumDofs()), residual->head(NumDofs()));
  residual->head(NumDofs()) -= s * structure_.ReferenceLoad() + structure_.ConstantLoad();
  for (const std::size_t i : acting_) {
    const PortsAt at = Evaluate(i, x);
    const PortReals forces = ForcesOf(i, x);
    for (std::size_t p = 0; p < laws_[i].NumPorts(); ++p)
      at.AddForce(at[p].gradient, -forces[p] * at[p].factor, residual);
  }
  for (const MotionEquation& of : motions_) {
    (*residual)[of.equation] = MotionValue(of.motion, x);
    if (of.compliance != 0.0) (*residual)[of.equation] += of.compliance * x[of.force];
  }
  Eigen::Index k = 0;
  for (const PrescribedDof& prescribed : structure_.PrescribedDofs()) {
    (*residual)[prescribed.dof] -= x[first_support_ + k];
    (*residual)[first_support_equation_ + k] = -prescribed.start + (x[prescribed.dof] - prescribed.rate * s);
    ++k;
  }
  for (std::size_t c = 0; c < active_.size(); ++c)
    if (RuleOf(active_[c]).OfForces())
      (*residual)[first_active_equation_ + static_cast<Eigen::Index>(c)] = Value(active_[c], x);
  if (load_factor_fixed_) (*residual)[num_equations_ - 1] = s - load_factor_;
}

Eigen::VectorXd FixedModeSystem::Rounding(const Eigen::VectorXd& x) const {
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  Eigen::VectorXd rounding =
      Eigen::VectorXd::Constant(num_equations_, kEpsilon * (1.0 + x.head(NumDofs() + 1).lpNorm<Eigen::Infinity>()));
  rounding.head(NumDofs()) =
      structure_.ForceRounding() + kEpsilon * (std::abs(x[NumDofs()]) * structure_.ReferenceLoad().cwiseAbs() +
                                               structure_.ConstantLoad().cwiseAbs());
  for (const std::size_t i : acting_) {
    double sum = 0.0;
    for (const double force : ForcesOf(i, x)) sum += std::abs(force);
    for (const int dof : laws_[i].Dofs(modes_[i].piece)) rounding[dof] += kEpsilon * sum;
  }
  return rounding;
}

double FixedModeSystem::Energy(const Eigen::VectorXd& x) const {
  double energy = structure_.Energy(x.head(NumDofs()));
  for (const std::size_t i : acting_) energy += laws_[i].EnergyAt(x, x[NumDofs()], modes_[i], ForcesOf(i, x));
  return energy;
}

double FixedModeSystem::Largest(const Eigen::VectorXd& residual) const {
  double largest = 0.0;
  for (Eigen::Index i = 0; i < residual.size(); ++i)
    largest = std::max(largest, std::abs(residual[i]) / (i < NumDofs() ? structure_.ResidualUnits()[i] : 1.0));
  return largest;
}

bool FixedModeSystem::Hold(const Eigen::VectorXd& x, const Eigen::VectorXd& residual) const {
  const double force = 1.0 + x.tail(x.size() - NumDofs()).lpNorm<Eigen::Infinity>();
  const double place = 1.0 + x.head(NumMotion()).lpNorm<Eigen::Infinity>();
  const auto motions = residual.segment(NumDofs(), first_active_equation_ - NumDofs());
  return Largest(residual) <= tolerances::kResidual * force &&
         motions.lpNorm<Eigen::Infinity>() <= tolerances::kResidual * place;
}

Eigen::VectorXd FixedModeSystem::Counted(const Eigen::VectorXd& change) const {
  Eigen::VectorXd counted = change;
  for (const std::size_t k : structure_.ObliqueSupports()) {
    const Eigen::Vector2d motion(structure_.PrescribedDofs()[k].rate, structure_.PrescribedDofs()[k + 1].rate);
    const auto force = counted.segment<2>(first_support_ + static_cast<Eigen::Index>(k));
    const double along = motion.normalized().dot(force);
    counted.segment<2>(first_support_ + static_cast<Eigen::Index>(k)) << along, 0.0;
  }
  if (gives_)
    for (const MotionEquation& of : motions_)
      if (of.equation < first_support_equation_ && of.compliance != 0.0 && !laws_[of.motion.law].Elastic())
        counted[of.force] *= of.compliance;
  return counted;
}

const Eigen::SparseMatrix<double>& FixedModeSystem::TransposedJacobian(const Eigen::VectorXd& x) {
  structure_.Tangent(x.head(NumDofs()), &tangent_);
  return WithTangent(x);
}

const Eigen::SparseMatrix<double>& FixedModeSystem::MixedJacobian(const Eigen::VectorXd& x, const Eigen::VectorXd& from,
                                                                  const Eigen::VectorXd& to) {
  structure_.MixedTangent(x.head(NumDofs()), from.head(NumDofs()), to.head(NumDofs()), &tangent_);
  return WithTangent(x);
}

const Eigen::SparseMatrix<double>& FixedModeSystem::WithTangent(const Eigen::VectorXd& x) {
  if (transposed_.rows() == 0) Rebuild();
  if (curved_) std::copy_n(constant_.data(), constant_.size(), transposed_.valuePtr());
  // The places of the tangent are among the places of transposed_, in the same order.
  for (Eigen::Index column = 0; column < NumDofs(); ++column) {
    Eigen::Index place = transposed_.outerIndexPtr()[column];
    for (Eigen::SparseMatrix<double>::InnerIterator it(tangent_, column); it; ++it, ++place) {
      while (transposed_.innerIndexPtr()[place] != it.row()) ++place;
      transposed_.valuePtr()[place] = it.value();
    }
  }
  if (!curved_) return transposed_;
  const auto add = [this](Eigen::Index unknown, Eigen::Index equation, double value) {
    transposed_.coeffRef(unknown, equation) += value;
  };
  for (const std::size_t i : acting_) {
    if (!laws_[i].Curved()) continue;
    const PortsAt at = Evaluate(i, x);
    ForEachForceEntry(i, at, add);
    ForEachCurvatureEntry(at, ForcesOf(i, x), add);
  }
  for (const MotionEquation& of : motions_)
    if (laws_[of.motion.law].Curved()) ForEachMotionEntry(of, Evaluate(of.motion.law, x), add);
  return transposed_;
}

Eigen::VectorXd FixedModeSystem::SecondDerivative(const Eigen::VectorXd& x, const Eigen::VectorXd& dx) {
  // tangent_ is scratch between calls.
  structure_.TangentDerivative(x.head(NumDofs()), dx.head(NumDofs()), &tangent_);
  Eigen::VectorXd second = Eigen::VectorXd::Zero(num_equations_);
  second.head(NumDofs()) = tangent_ * dx.head(NumDofs());
  if (!curved_) return second;
  for (const std::size_t i : acting_) {
    const Law& law = laws_[i];
    if (!law.Curved()) continue;
    const PortsAt at = Evaluate(i, x);
    const PortReals rates = ForcesOf(i, dx);
    const LawVector along = at.Local(dx, dx[NumDofs()]);
    LawMatrix change = LawMatrix::Zero(along.size(), along.size());
    for (std::size_t p = 0; p < law.NumPorts(); ++p) change += (rates[p] * at[p].factor) * at[p].hessian;
    LawVector of_law = law.SecondDirectional(x, x[NumDofs()], modes_[i].piece, ForcesOf(i, x), along);
    for (Eigen::Index k = 0; k < along.size(); ++k) of_law += (2.0 * along[k]) * change.col(k);
    at.AddForce(of_law, -1.0, &second);
    for (std::size_t p = 0; p < law.NumPorts(); ++p)
      if (at[p].factor_gradient.size() > 0)
        at.AddForce(at[p].gradient, -2.0 * rates[p] * at[p].factor_gradient.dot(along), &second);
  }
  for (const MotionEquation& of : motions_)
    if (laws_[of.motion.law].Curved())
      second[of.equation] = of.motion.sign * Bend(of.motion, Evaluate(of.motion.law, x), dx);
  return second;
}

}  // namespace contact_path
