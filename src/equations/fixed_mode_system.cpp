#include "contact_path/equations/fixed_mode_system.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact_path/tolerances.h"

namespace contact_path {

FixedModeSystem::FixedModeSystem(const Structure& structure, const Laws& laws)
    : structure_(structure),
      laws_(laws, structure.NumDofs()),
      limits_(&laws_),
      jacobian_(structure, laws_, limits_, layout_),
      frame_(structure, laws_, layout_),
      tangent_(structure.TangentPattern()) {
  if (structure.NumDofs() > 0) residual_unit_ = structure.ResidualUnits().maxCoeff();
  Modes idle(laws.size());
  for (std::size_t i = 0; i < laws.size(); ++i)
    while (laws[i].CanBeIdle() && !laws[i].In(idle[i]).idle) ++idle[i].state;
  SetModes(idle);
}

void FixedModeSystem::SetModes(const Modes& modes, const Eigen::VectorXd& references) {
  laws_.Set(modes, references.size() > 0 ? references : Eigen::VectorXd::Zero(laws_.laws().NumPorts()));
  SetLayout({}, false);
}

void FixedModeSystem::SetModesFrom(const PathPoint& from) {
  SetModes(from.modes, laws_.laws().ReferencesAt(from));
  moved_forces_.clear();
  Eigen::VectorXd stiffness;
  for (const std::size_t i : laws_.Acting()) {
    const Law& law = laws_[i];
    const PortRule& port = laws_.StateOf(i).ports[0];
    if (!port.Holds() || port.compliance != 0.0) continue;
    const double moved = law.Motion(0, from.u, from.s, modes()[i].piece, laws_.ReferencesOf(i));
    if (!(moved > tolerances::kResidual)) continue;
    if (stiffness.size() == 0) {
      structure_.Tangent(from.u, &tangent_);
      stiffness = tangent_.diagonal().cwiseAbs();
    }
    double largest = 0.0;
    for (const int dof : law.Dofs(modes()[i].piece)) largest = std::max(largest, stiffness[dof]);
    moved_forces_[static_cast<int>(i)] = (1.0 + law.LargestRatio()) * largest * moved;
  }
}

void FixedModeSystem::SetLayout(const std::vector<Limit>& active, bool load_factor_fixed) {
  layout_ = FixedModeLayout(structure_, laws_, limits_, active, load_factor_fixed);
  jacobian_.Reset();
  frame_.Reset();
}

void FixedModeSystem::FixLoadFactor(double value) {
  load_factor_ = value;
  SetLayout(layout_.active, true);
}

Eigen::VectorXd FixedModeSystem::Pack(const PathPoint& point) const {
  Eigen::VectorXd x(NumUnknowns());
  laws_.Pack(point, &x);
  x.tail(NumUnknowns() - layout_.first_support) = structure_.SupportReactions(point.u, point.s);
  if (layout_.first_support == NumUnknowns()) return x;
  // Laws may pull at what moves as it is told.
  Eigen::VectorXd pull = Eigen::VectorXd::Zero(NumDofs());
  laws_.AddForces(x, 1.0, &pull);
  Eigen::Index k = layout_.first_support;
  for (const PrescribedDof& prescribed : structure_.PrescribedDofs()) x[k++] -= pull[prescribed.dof];
  return x;
}

void FixedModeSystem::Residual(const Eigen::VectorXd& x, Eigen::VectorXd* residual) const {
  const double s = x[NumDofs()];
  residual->resize(NumEquations());
  structure_.InternalForce(x.head(NumDofs()), residual->head(NumDofs()));
  structure_.Loads().TakeFrom(residual->head(NumDofs()), s);
  laws_.AddForces(x, -1.0, residual);
  for (const MotionEquation& of : layout_.motions) {
    (*residual)[of.equation] = laws_.ValueOf(of.motion, x);
    if (of.compliance != 0.0) (*residual)[of.equation] += of.compliance * x[of.force];
  }
  Eigen::Index k = 0;
  for (const PrescribedDof& prescribed : structure_.PrescribedDofs()) {
    (*residual)[prescribed.dof] -= x[layout_.first_support + k];
    (*residual)[layout_.first_support_equation + k] = -prescribed.start + (x[prescribed.dof] - prescribed.rate * s);
    ++k;
  }
  for (std::size_t c = 0; c < layout_.active.size(); ++c)
    if (limits_.RuleOf(layout_.active[c]).OfForces())
      (*residual)[layout_.first_active_equation + static_cast<Eigen::Index>(c)] = Value(layout_.active[c], x);
  if (layout_.load_factor_fixed) (*residual)[NumEquations() - 1] = s - load_factor_;
}

Eigen::VectorXd FixedModeSystem::Rounding(const Eigen::VectorXd& x) const {
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  Eigen::VectorXd rounding =
      Eigen::VectorXd::Constant(NumEquations(), kEpsilon * (1.0 + x.head(NumDofs() + 1).lpNorm<Eigen::Infinity>()));
  rounding.head(NumDofs()) = structure_.ForceRounding() + kEpsilon * structure_.Loads().Sizes(x[NumDofs()]);
  for (const std::size_t i : laws_.Acting()) {
    double sum = 0.0;
    for (const double force : laws_.ForcesOf(i, x)) sum += std::abs(force);
    for (const int dof : laws_[i].Dofs(modes()[i].piece)) rounding[dof] += kEpsilon * sum;
  }
  return rounding;
}

Eigen::VectorXd FixedModeSystem::Imperfection(const Eigen::VectorXd& x) const {
  Eigen::VectorXd imperfection = Rounding(x);
  for (const MotionEquation& of : layout_.motions)
    if (of.compliance != 0.0 && !laws_[of.motion.law].Elastic())
      imperfection[of.equation] += std::abs(of.compliance * x[of.force]);
  return imperfection;
}

double FixedModeSystem::Energy(const Eigen::VectorXd& x) const {
  double energy = structure_.Energy(x.head(NumDofs()));
  laws_.AddEnergy(x, &energy);
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
  const auto motions = residual.segment(NumDofs(), layout_.first_active_equation - NumDofs());
  return Largest(residual) <= tolerances::kResidual * force &&
         motions.lpNorm<Eigen::Infinity>() <= tolerances::kResidual * place;
}

Eigen::VectorXd FixedModeSystem::Counted(const Eigen::VectorXd& change) const {
  Eigen::VectorXd counted = change;
  for (const std::size_t k : structure_.ObliqueSupports()) {
    const Eigen::Vector2d motion(structure_.PrescribedDofs()[k].rate, structure_.PrescribedDofs()[k + 1].rate);
    const auto force = counted.segment<2>(layout_.first_support + static_cast<Eigen::Index>(k));
    const double along = motion.normalized().dot(force);
    counted.segment<2>(layout_.first_support + static_cast<Eigen::Index>(k)) << along, 0.0;
  }
  if (layout_.gives)
    for (const MotionEquation& of : layout_.motions)
      if (of.told_by != 0.0) counted[of.force] *= of.told_by;
  return counted;
}

const Eigen::SparseMatrix<double>& FixedModeSystem::TransposedJacobian(const Eigen::VectorXd& x) {
  structure_.Tangent(x.head(NumDofs()), &tangent_);
  return jacobian_.At(x, tangent_);
}

const Eigen::SparseMatrix<double>& FixedModeSystem::MixedJacobian(const Eigen::VectorXd& x, const Eigen::VectorXd& from,
                                                                  const Eigen::VectorXd& to) {
  structure_.MixedTangent(x.head(NumDofs()), from.head(NumDofs()), to.head(NumDofs()), &tangent_);
  return jacobian_.At(x, tangent_);
}

Eigen::VectorXd FixedModeSystem::SecondDerivative(const Eigen::VectorXd& x, const Eigen::VectorXd& dx) {
  // tangent_ is scratch between calls.
  structure_.TangentDerivative(x.head(NumDofs()), dx.head(NumDofs()), &tangent_);
  Eigen::VectorXd second = Eigen::VectorXd::Zero(NumEquations());
  second.head(NumDofs()) = tangent_ * dx.head(NumDofs());
  if (!layout_.curved) return second;
  for (const std::size_t i : laws_.Acting()) {
    const Law& law = laws_[i];
    if (!law.Curved()) continue;
    const PortsAt at = laws_.Evaluate(i, x);
    const PortReals rates = laws_.ForcesOf(i, dx);
    const LawVector along = at.Local(dx, dx[NumDofs()]);
    LawMatrix change = LawMatrix::Zero(along.size(), along.size());
    for (std::size_t p = 0; p < law.NumPorts(); ++p) change += (rates[p] * at[p].factor) * at[p].hessian;
    LawVector of_law = law.SecondDirectional(x, x[NumDofs()], modes()[i].piece, laws_.ForcesOf(i, x), along);
    for (Eigen::Index k = 0; k < along.size(); ++k) of_law += (2.0 * along[k]) * change.col(k);
    at.AddForce(of_law, -1.0, &second);
    for (std::size_t p = 0; p < law.NumPorts(); ++p)
      if (at[p].factor_gradient.size() > 0)
        at.AddForce(at[p].gradient, -2.0 * rates[p] * at[p].factor_gradient.dot(along), &second);
  }
  for (const MotionEquation& of : layout_.motions)
    if (laws_[of.motion.law].Curved())
      second[of.equation] = of.motion.sign * laws_.Bend(of.motion.port, laws_.Evaluate(of.motion.law, x), dx);
  return second;
}

Jet FixedModeSystem::DrivingForceAlong(const Eigen::VectorXd& x, const Eigen::VectorXd& first,
                                       const Eigen::VectorXd& second) const {
  Jet force;
  Eigen::Index k = layout_.first_support;
  for (const PrescribedDof& prescribed : structure_.PrescribedDofs()) {
    force.value += prescribed.rate * x[k];
    force.first += prescribed.rate * first[k];
    force.second += prescribed.rate * second[k];
    ++k;
  }
  for (const std::size_t i : laws_.Acting()) laws_.AddDrivingForce(i, x, first, second, &force);
  return force;
}

double FixedModeSystem::RoundingOf(const Limit& limit, double of_forces) const {
  double rounding = tolerances::kResidual * UnitOf(limit);
  if (limits_.RuleOf(limit).OfForces()) rounding = std::max(rounding, of_forces);
  const auto moved = moved_forces_.find(limit.law);
  return moved == moved_forces_.end() ? rounding : std::max(rounding, moved->second);
}

const RigidModes& FixedModeSystem::FreeModes() const {
  if (!free_modes_) free_modes_.emplace(structure_);
  return *free_modes_;
}

bool FixedModeSystem::MayMoveFreely() const { return FreeModes().Possible(); }

Eigen::MatrixXd FixedModeSystem::FreeMotions(const Eigen::VectorXd& x, const Eigen::SparseMatrix<double>& transposed) {
  return FreeModes().At(x.head(NumDofs()), transposed);
}

}  // namespace contact_path
