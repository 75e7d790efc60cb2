#include "contact_path/equations/fixed_state_system.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>

#include "contact_path/equations/frame_around.h"
#include "contact_path/linear/bordered_solver.h"

namespace contact_path {
namespace {

// Times the contacts in a frame, against the dofs: more of them would make factors large.
constexpr double kMostInFrame = 4.0;

}  // namespace

FixedStateSystem::FixedStateSystem(const Structure& structure, const ContactPairs& contacts)
    : structure_(structure), contacts_(contacts), tangent_(structure.TangentPattern()) {
  for (std::size_t i = 0; i < contacts.size(); ++i)
    if (contacts[i]->HasPatches()) with_patches_.push_back(i);
  if (structure.NumDofs() > 0) residual_unit_ = structure.ResidualUnits().maxCoeff();
  SetStates(std::vector<ContactState>(contacts.size(), ContactState::kOpen),
            Eigen::VectorXd::Zero(static_cast<Eigen::Index>(contacts.size())));
}

void FixedStateSystem::SetStates(const std::vector<ContactState>& states, const Eigen::VectorXd& reference,
                                 const std::vector<int>& patches) {
  states_ = states;
  patches_ = patches.empty() ? std::vector<int>(states.size(), 0) : patches;
  reference_ = reference;
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

void FixedStateSystem::SetActive(const std::vector<Constraint>& constraints) {
  active_ = constraints;
  Rebuild();
}

void FixedStateSystem::FixLoadFactor(double value) {
  load_factor_fixed_ = true;
  load_factor_ = value;
  Rebuild();
}

FixedStateSystem::Motion FixedStateSystem::MotionOf(const Constraint& constraint) const {
  const auto i = static_cast<std::size_t>(constraint.contact);
  if (KeepsPatch(constraint.inequality)) {
    const XiRange range = contacts_[i]->RangeOf(patches_[i]);
    const double reference = reference_[constraint.contact];
    return constraint.inequality == Inequality::kPatchBegin ? Motion{i, false, 1.0, reference - range.begin}
                                                            : Motion{i, false, -1.0, range.end - reference};
  }
  const bool is_gap = constraint.inequality == Inequality::kGap;
  return {i, is_gap, is_gap || states_[i] == ContactState::kSlipPlus ? 1.0 : -1.0};
}

FixedStateSystem::ReactionTerms FixedStateSystem::ReactionTermsOf(const Constraint& constraint) const {
  const auto i = static_cast<std::size_t>(constraint.contact);
  switch (constraint.inequality) {
    case Inequality::kConePlus: return {contacts_[i]->Friction(), 1.0};
    case Inequality::kConeMinus: return {contacts_[i]->Friction(), -1.0};
    default: return {1.0, 0.0};
  }
}

Kinematics FixedStateSystem::Evaluate(std::size_t contact, const Eigen::VectorXd& x) const {
  Kinematics at;
  contacts_[contact]->Evaluate(x, x[NumDofs()], patches_[contact], reference_[static_cast<Eigen::Index>(contact)], &at);
  return at;
}

FixedStateSystem::Reaction FixedStateSystem::ReactionOf(std::size_t contact, const Eigen::VectorXd& x) const {
  const double rn = x[rn_unknown_[contact]];
  const double rt = rt_unknown_[contact] >= 0 ? x[rt_unknown_[contact]]
                                              : SlipRatio(states_[contact], contacts_[contact]->Friction()) * rn;
  return {rn, rt};
}

void FixedStateSystem::NumberEquations() {
  motions_.clear();
  Eigen::Index next = NumDofs();
  for (const std::size_t i : touching_) {
    motions_.push_back({{i, true, 1.0}, next++});
    if (states_[i] == ContactState::kStick) motions_.push_back({{i, false, 1.0}, next++});
  }
  first_support_equation_ = next;
  next += static_cast<Eigen::Index>(structure_.PrescribedDofs().size());
  first_active_equation_ = next;
  for (const Constraint& constraint : active_) {
    if (IsMotion(constraint.inequality)) motions_.push_back({MotionOf(constraint), next});
    ++next;
  }
  num_equations_ = next + (load_factor_fixed_ ? 1 : 0);
  const auto some = [this](auto has) {
    return std::any_of(motions_.begin(), motions_.end(),
                       [&](const MotionEquation& of) { return has(*contacts_[of.motion.contact]); });
  };
  curved_ = some([](const ContactPair& pair) { return pair.Curved(); });
  deformable_ = some([](const ContactPair& pair) { return pair.Deformable(); });
}

template <typename Emit>
void FixedStateSystem::ForEachMotionEntry(const MotionEquation& of, const Kinematics& at, Emit emit) const {
  const ContactPair& pair = *contacts_[of.motion.contact];
  const PairVector& gradient = of.motion.is_gap ? at.gap_gradient : at.xi_gradient;
  const std::size_t m = at.dofs.size();
  for (std::size_t k = 0; k <= m; ++k)
    if (of.motion.is_gap ? pair.MovesGap(k) : pair.MovesXi(k))
      emit(k < m ? at.dofs[k] : NumDofs(), of.equation, of.motion.sign * gradient[static_cast<Eigen::Index>(k)]);
}

template <typename Emit>
void FixedStateSystem::ForEachReactionEntry(std::size_t contact, const Kinematics& at, Emit emit) const {
  const ContactPair& pair = *contacts_[contact];
  const Eigen::Index rn = rn_unknown_[contact], rt = rt_unknown_[contact];
  const double ratio = SlipRatio(states_[contact], pair.Friction());
  for (std::size_t k = 0; k < at.dofs.size(); ++k) {
    const auto e = static_cast<Eigen::Index>(k);
    if (pair.MovesGap(k)) emit(rn, at.dofs[k], -at.gap_gradient[e]);
    if (!pair.MovesXi(k)) continue;
    if (rt >= 0) emit(rt, at.dofs[k], -at.slip_factor * at.xi_gradient[e]);
    if (ratio != 0.0) emit(rn, at.dofs[k], -(ratio * at.slip_factor) * at.xi_gradient[e]);
  }
}

template <typename Emit>
void FixedStateSystem::ForEachCurvatureEntry(const Kinematics& at, const Reaction& reaction, Emit emit) const {
  const PairMatrix change = at.ForceChange(reaction.rn, reaction.rt);
  const std::size_t m = at.dofs.size();
  for (std::size_t column = 0; column < m; ++column)
    for (std::size_t row = 0; row <= m; ++row)
      emit(row < m ? at.dofs[row] : NumDofs(), at.dofs[column],
           -change(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)));
}

template <typename Emit>
void FixedStateSystem::ForEachConstantEntry(Emit emit) const {
  for (Eigen::Index column = 0; column < NumDofs(); ++column)
    emit(NumDofs(), column, -structure_.ReferenceLoad()[column]);
  Eigen::Index k = 0;
  for (const PrescribedDof& prescribed : structure_.PrescribedDofs()) {
    emit(first_support_ + k, prescribed.dof, -1.0);
    emit(prescribed.dof, first_support_equation_ + k, 1.0);
    emit(NumDofs(), first_support_equation_ + k, -prescribed.rate);
    ++k;
  }
  for (std::size_t c = 0; c < active_.size(); ++c) {
    if (IsMotion(active_[c].inequality)) continue;
    const auto i = static_cast<std::size_t>(active_[c].contact);
    const Eigen::Index equation = first_active_equation_ + static_cast<Eigen::Index>(c);
    const ReactionTerms terms = ReactionTermsOf(active_[c]);
    emit(rn_unknown_[i], equation, terms.rn);
    if (terms.rt != 0.0) emit(rt_unknown_[i], equation, terms.rt);
  }
  if (load_factor_fixed_) emit(NumDofs(), num_equations_ - 1, 1.0);
}

void FixedStateSystem::Rebuild() {
  NumberEquations();
  placed_ = false;
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(static_cast<std::size_t>(tangent_.nonZeros() + NumDofs()) + 6 * touching_.size() +
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
  // Derivatives of flat contacts are the same everywhere. Those of curved ones come with each point.
  Eigen::VectorXd anywhere = Eigen::VectorXd::Zero(NumDofs() + 1);
  anywhere.head(NumDofs()) = structure_.Start();
  for (const std::size_t i : touching_) {
    const Kinematics at = Evaluate(i, anywhere);
    if (contacts_[i]->Curved()) {
      ForEachReactionEntry(i, at, add_place);
      ForEachCurvatureEntry(at, {0.0, 0.0}, add_place);
    } else {
      ForEachReactionEntry(i, at, add);
    }
  }
  for (const MotionEquation& of : motions_) {
    const Kinematics at = Evaluate(of.motion.contact, anywhere);
    if (contacts_[of.motion.contact]->Curved())
      ForEachMotionEntry(of, at, add_place);
    else
      ForEachMotionEntry(of, at, add);
  }
  transposed_.resize(num_unknowns_, num_equations_);
  transposed_.setFromTriplets(triplets.begin(), triplets.end());
  transposed_.makeCompressed();
  if (curved_) constant_ = Eigen::Map<const Eigen::VectorXd>(transposed_.valuePtr(), transposed_.nonZeros());
}

const Frame* FixedStateSystem::InFrame() {
  if (num_unknowns_ < kLargeSystem || num_equations_ + 1 != num_unknowns_ || load_factor_fixed_ || !active_.empty() ||
      deformable_)
    return nullptr;
  if (placed_) return &frame_;
  if (frame_.size == 0 || !std::includes(framed_.begin(), framed_.end(), touching_.begin(), touching_.end())) {
    framed_ = ContactsToFrame();
    frame_ = FitFrame(framed_.size()) ? FrameAround(structure_, contacts_, framed_, tangent_) : Frame();
  }
  if (frame_.size == 0) return nullptr;
  PlaceInFrame();
  return &frame_;
}

bool FixedStateSystem::FitFrame(std::size_t contacts) const {
  return kMostInFrame * static_cast<double>(contacts) <= static_cast<double>(NumDofs());
}

// All candidates where they are few; otherwise those that touch, and those that did before while they are few.
std::vector<std::size_t> FixedStateSystem::ContactsToFrame() const {
  std::vector<std::size_t> all;
  if (FitFrame(contacts_.size())) {
    all.resize(contacts_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return all;
  }
  std::set_union(framed_.begin(), framed_.end(), touching_.begin(), touching_.end(), std::back_inserter(all));
  return FitFrame(all.size()) ? all : touching_;
}

void FixedStateSystem::PlaceInFrame() {
  const auto nd = static_cast<int>(NumDofs());
  const auto contact_place = [this, nd](std::size_t contact) {
    return nd + 2 * static_cast<int>(std::lower_bound(framed_.begin(), framed_.end(), contact) - framed_.begin());
  };
  frame_.unknowns.assign(static_cast<std::size_t>(num_unknowns_), 0);
  frame_.equations.assign(static_cast<std::size_t>(num_equations_), 0);
  for (int k = 0; k < nd; ++k)
    frame_.unknowns[static_cast<std::size_t>(k)] = frame_.equations[static_cast<std::size_t>(k)] = k;
  frame_.unknowns[static_cast<std::size_t>(nd)] = frame_.size - 1;
  for (const std::size_t i : touching_) {
    frame_.unknowns[static_cast<std::size_t>(rn_unknown_[i])] = contact_place(i);
    if (rt_unknown_[i] >= 0) frame_.unknowns[static_cast<std::size_t>(rt_unknown_[i])] = contact_place(i) + 1;
  }
  for (const MotionEquation& of : motions_)
    frame_.equations[static_cast<std::size_t>(of.equation)] =
        contact_place(of.motion.contact) + (of.motion.is_gap ? 0 : 1);
  int place = nd + 2 * static_cast<int>(framed_.size());
  for (std::size_t k = 0; k < structure_.PrescribedDofs().size(); ++k, ++place) {
    frame_.unknowns[static_cast<std::size_t>(first_support_) + k] = place;
    frame_.equations[static_cast<std::size_t>(first_support_equation_) + k] = place;
  }
  frame_.odd = (num_unknowns_ - 1 - NumDofs()) % 2 != 0;
  placed_ = true;
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
  for (const std::size_t i : with_patches_) {
    if (point.patches.empty()) point.patches = patches_;
    if (states_[i] == ContactState::kOpen) point.patches[i] = kNearestPatch;
  }
  for (const std::size_t i : touching_) {
    const auto k = static_cast<Eigen::Index>(i);
    point.rn[k] = x[rn_unknown_[i]];
    if (rt_unknown_[i] >= 0)
      point.rt[k] = x[rt_unknown_[i]];
    else if (Slips(states_[i]))
      point.rt[k] = SlipRatio(states_[i], contacts_[i]->Friction()) * point.rn[k];
  }
  return point;
}

void FixedStateSystem::Residual(const Eigen::VectorXd& x, Eigen::VectorXd* residual) const {
  const double s = x[NumDofs()];
  residual->resize(num_equations_);
  structure_.InternalForce(x.head(NumDofs()), residual->head(NumDofs()));
  residual->head(NumDofs()) -= s * structure_.ReferenceLoad() + structure_.ConstantLoad();
  for (const std::size_t i : touching_) {
    const Kinematics at = Evaluate(i, x);
    const Reaction reaction = ReactionOf(i, x);
    at.AddForce(at.gap_gradient, -reaction.rn, residual);
    at.AddForce(at.xi_gradient, -reaction.rt * at.slip_factor, residual);
  }
  for (const MotionEquation& of : motions_) (*residual)[of.equation] = MotionValue(of.motion, x);
  Eigen::Index k = 0;
  for (const PrescribedDof& prescribed : structure_.PrescribedDofs()) {
    (*residual)[prescribed.dof] -= x[first_support_ + k];
    (*residual)[first_support_equation_ + k] = -prescribed.start + (x[prescribed.dof] - prescribed.rate * s);
    ++k;
  }
  for (std::size_t c = 0; c < active_.size(); ++c)
    if (!IsMotion(active_[c].inequality))
      (*residual)[first_active_equation_ + static_cast<Eigen::Index>(c)] = Value(active_[c], x);
  if (load_factor_fixed_) (*residual)[num_equations_ - 1] = s - load_factor_;
}

Eigen::VectorXd FixedStateSystem::Rounding(const Eigen::VectorXd& x) const {
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  Eigen::VectorXd rounding =
      Eigen::VectorXd::Constant(num_equations_, kEpsilon * (1.0 + x.head(NumDofs() + 1).lpNorm<Eigen::Infinity>()));
  rounding.head(NumDofs()) =
      structure_.ForceRounding() + kEpsilon * (std::abs(x[NumDofs()]) * structure_.ReferenceLoad().cwiseAbs() +
                                               structure_.ConstantLoad().cwiseAbs());
  for (const std::size_t i : touching_) {
    const Reaction reaction = ReactionOf(i, x);
    for (const int dof : contacts_[i]->Dofs(patches_[i]))
      rounding[dof] += kEpsilon * (std::abs(reaction.rn) + std::abs(reaction.rt));
  }
  return rounding;
}

double FixedStateSystem::Largest(const Eigen::VectorXd& residual) const {
  double largest = 0.0;
  for (Eigen::Index i = 0; i < residual.size(); ++i)
    largest = std::max(largest, std::abs(residual[i]) / (i < NumDofs() ? structure_.ResidualUnits()[i] : 1.0));
  return largest;
}

bool FixedStateSystem::Hold(const Eigen::VectorXd& x, const Eigen::VectorXd& residual) const {
  const double force = 1.0 + x.tail(x.size() - NumDofs()).lpNorm<Eigen::Infinity>();
  const double place = 1.0 + x.head(NumMotion()).lpNorm<Eigen::Infinity>();
  const auto motions = residual.segment(NumDofs(), first_active_equation_ - NumDofs());
  return Largest(residual) <= tolerances::kResidual * force &&
         motions.lpNorm<Eigen::Infinity>() <= tolerances::kResidual * place;
}

Eigen::VectorXd FixedStateSystem::Counted(const Eigen::VectorXd& change) const {
  Eigen::VectorXd counted = change;
  for (const std::size_t k : structure_.ObliqueSupports()) {
    const Eigen::Vector2d motion(structure_.PrescribedDofs()[k].rate, structure_.PrescribedDofs()[k + 1].rate);
    const auto force = counted.segment<2>(first_support_ + static_cast<Eigen::Index>(k));
    const double along = motion.normalized().dot(force);
    counted.segment<2>(first_support_ + static_cast<Eigen::Index>(k)) << along, 0.0;
  }
  return counted;
}

const Eigen::SparseMatrix<double>& FixedStateSystem::TransposedJacobian(const Eigen::VectorXd& x) {
  structure_.Tangent(x.head(NumDofs()), &tangent_);
  return WithTangent(x);
}

const Eigen::SparseMatrix<double>& FixedStateSystem::MixedJacobian(const Eigen::VectorXd& x,
                                                                   const Eigen::VectorXd& from,
                                                                   const Eigen::VectorXd& to) {
  structure_.MixedTangent(x.head(NumDofs()), from.head(NumDofs()), to.head(NumDofs()), &tangent_);
  return WithTangent(x);
}

const Eigen::SparseMatrix<double>& FixedStateSystem::WithTangent(const Eigen::VectorXd& x) {
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
  for (const std::size_t i : touching_) {
    if (!contacts_[i]->Curved()) continue;
    const Kinematics at = Evaluate(i, x);
    ForEachReactionEntry(i, at, add);
    ForEachCurvatureEntry(at, ReactionOf(i, x), add);
  }
  for (const MotionEquation& of : motions_)
    if (contacts_[of.motion.contact]->Curved()) ForEachMotionEntry(of, Evaluate(of.motion.contact, x), add);
  return transposed_;
}

double FixedStateSystem::MotionValue(const Motion& motion, const Eigen::VectorXd& x) const {
  const double value = motion.is_gap ? contacts_[motion.contact]->Gap(x, x[NumDofs()], patches_[motion.contact])
                                     : Evaluate(motion.contact, x).xi;
  return motion.offset + motion.sign * value;
}

double FixedStateSystem::Value(const Constraint& constraint, const Eigen::VectorXd& x) const {
  if (IsMotion(constraint.inequality)) return MotionValue(MotionOf(constraint), x);
  const ReactionTerms terms = ReactionTermsOf(constraint);
  const Reaction reaction = ReactionOf(static_cast<std::size_t>(constraint.contact), x);
  return terms.rn * reaction.rn + terms.rt * reaction.rt;
}

double FixedStateSystem::UnitOf(const Constraint& constraint) const {
  if (IsMotion(constraint.inequality)) return 1.0;
  const ContactPair& contact = *contacts_[static_cast<std::size_t>(constraint.contact)];
  return constraint.inequality == Inequality::kNormalReaction ? contact.NormalForceUnit() : contact.ForceUnit();
}

double FixedStateSystem::Rate(const Constraint& constraint, const Eigen::VectorXd& x, const Eigen::VectorXd& dx) const {
  if (!IsMotion(constraint.inequality)) return Value(constraint, dx);
  const Motion motion = MotionOf(constraint);
  const Kinematics at = Evaluate(motion.contact, x);
  return motion.sign * at.Rate(motion.is_gap ? at.gap_gradient : at.xi_gradient, dx, dx[NumDofs()]);
}

Eigen::VectorXd FixedStateSystem::Gradient(const Constraint& constraint, const Eigen::VectorXd& x) const {
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(num_unknowns_);
  const auto i = static_cast<std::size_t>(constraint.contact);
  if (IsMotion(constraint.inequality)) {
    ForEachMotionEntry({MotionOf(constraint), 0}, Evaluate(i, x),
                       [&gradient](Eigen::Index unknown, Eigen::Index, double value) { gradient[unknown] += value; });
  } else {
    const ReactionTerms terms = ReactionTermsOf(constraint);
    gradient[rn_unknown_[i]] = terms.rn;
    if (terms.rt != 0.0) gradient[rt_unknown_[i]] = terms.rt;
  }
  return gradient;
}

Eigen::VectorXd FixedStateSystem::SecondDerivative(const Eigen::VectorXd& x, const Eigen::VectorXd& dx) {
  // tangent_ is scratch between calls.
  structure_.TangentDerivative(x.head(NumDofs()), dx.head(NumDofs()), &tangent_);
  Eigen::VectorXd second = Eigen::VectorXd::Zero(num_equations_);
  second.head(NumDofs()) = tangent_ * dx.head(NumDofs());
  if (!curved_) return second;
  for (const std::size_t i : touching_) {
    const ContactPair& pair = *contacts_[i];
    if (!pair.Curved()) continue;
    const Kinematics at = Evaluate(i, x);
    const Reaction reaction = ReactionOf(i, x), rate = ReactionOf(i, dx);
    const PairVector along = at.Local(dx, dx[NumDofs()]);
    at.AddForce(pair.SecondDirectional(x, x[NumDofs()], patches_[i], reaction.rn, reaction.rt, along) +
                    2.0 * (rate.rn * at.gap_hessian + (rate.rt * at.slip_factor) * at.xi_hessian) * along,
                -1.0, &second);
    if (pair.Deformable()) at.AddForce(at.xi_gradient, -2.0 * rate.rt * at.slip_factor_gradient.dot(along), &second);
  }
  for (const MotionEquation& of : motions_)
    if (contacts_[of.motion.contact]->Curved())
      second[of.equation] = of.motion.sign * Bend(of.motion, Evaluate(of.motion.contact, x), dx);
  return second;
}

}  // namespace contact_path
