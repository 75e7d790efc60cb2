#include "contact_path/structure/place.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace contact_path {
namespace {

// Adds turn border' + border turn' + factor turn turn'.
void AddTurn(const LawVector& turn, const LawVector& border, double factor, LawMatrix* sum) {
  *sum += turn * border.transpose();
  *sum += border * turn.transpose();
  *sum += factor * turn * turn.transpose();
}

}  // namespace

LawVector LocalOf(const LawDofs& dofs, const Eigen::Ref<const Eigen::VectorXd>& u, double s) {
  LawVector q(static_cast<Eigen::Index>(dofs.size()) + 1);
  Eigen::Index k = 0;
  for (const int dof : dofs) q[k++] = u[dof];
  q[k] = s;
  return q;
}

MovingPlace::MovingPlace(const FixedPoint& point) : MovingPlace(nullptr, point, nullptr) {}

MovingPlace MovingPlace::Between(const FixedPoint& from, const FixedPoint& to) { return {&from, to, nullptr}; }

MovingPlace MovingPlace::SeenFrom(const MovingFrame& frame, const FixedPoint& point) {
  return {nullptr, point, &frame};
}

MovingPlace::MovingPlace(const FixedPoint* from, const FixedPoint& to, const MovingFrame* seen_from) {
  std::vector<int> dofs;
  for (const MovingFrame* const frame : {from != nullptr ? &from->frame : nullptr, &to.frame, seen_from})
    if (frame != nullptr)
      for (const Coordinate& of : {frame->origin[0], frame->origin[1], frame->angle})
        if (of.dof >= 0) dofs.push_back(of.dof);
  std::sort(dofs.begin(), dofs.end());
  dofs.erase(std::unique(dofs.begin(), dofs.end()), dofs.end());
  for (const int dof : dofs) dofs_.push_back(dof);
  Term origins = NewTerm();
  AddOrigin(to.frame, 1.0, &origins);
  if (from != nullptr) AddOrigin(from->frame, -1.0, &origins);
  if (seen_from != nullptr) {
    AddOrigin(*seen_from, -1.0, &origins);
    AddAngle(seen_from->angle, -1.0, &origins);
    origins.about = seen_from->about;
    constant_ = seen_from->start;
  }
  Add(std::move(origins));
  if (from != nullptr) AddArm(*from, -1.0, seen_from);
  AddArm(to, 1.0, seen_from);
}

MovingPlace::Term MovingPlace::NewTerm() const {
  const auto size = static_cast<Eigen::Index>(dofs_.size()) + 1;
  Term term;
  term.motion = Motion::Zero(2, size);
  term.turn = LawVector::Zero(size);
  return term;
}

Eigen::Index MovingPlace::EntryOf(int dof) const {
  return dof < 0 ? static_cast<Eigen::Index>(dofs_.size()) : std::find(dofs_.begin(), dofs_.end(), dof) - dofs_.begin();
}

void MovingPlace::AddOrigin(const MovingFrame& frame, double sign, Term* term) const {
  for (const Eigen::Index axis : {0, 1}) {
    const Coordinate& of = frame.origin[static_cast<std::size_t>(axis)];
    term->motion(axis, EntryOf(of.dof)) += sign * (of.dof >= 0 ? 1.0 : of.rate);
    if (of.dof < 0) term->held[axis] += sign * of.held;
  }
}

void MovingPlace::AddAngle(const Coordinate& angle, double sign, Term* term) const {
  if (angle.dof < 0) term->angle += sign * angle.held;
  if (!angle.Moves()) return;
  term->turns = true;
  term->turn[EntryOf(angle.dof)] += sign * (angle.dof >= 0 ? 1.0 : angle.rate);
}

void MovingPlace::AddArm(const FixedPoint& point, double sign, const MovingFrame* seen_from) {
  if (point.arm.isZero(0.0)) return;
  Term arm = NewTerm();
  arm.held = sign * point.arm;
  AddAngle(point.frame.angle, 1.0, &arm);
  if (seen_from != nullptr) AddAngle(seen_from->angle, -1.0, &arm);
  Add(std::move(arm));
}

void MovingPlace::Add(Term term) {
  const Eigen::Index last = term.turn.size() - 1;
  if (!term.turns && term.angle != 0.0) {  // turned once and for all
    const Eigen::Matrix2d rotation = term.Rotation(LawVector::Zero(last + 1));
    term.held = rotation * term.held;
    term.about = rotation * term.about;
    term.motion = rotation * term.motion;
    term.angle = 0.0;
  }
  if (!term.turns && !terms_.empty()) {
    constant_ += term.held;
    return;
  }
  if (term.turns && term.turn.head(last).isZero(0.0)) term.rate = std::exchange(term.turn[last], 1.0);
  terms_.push_back(std::move(term));
}

Eigen::Matrix2d MovingPlace::Term::Rotation(const LawVector& q) const {
  const double by = angle + rate * turn.dot(q);
  Eigen::Matrix2d rotation;
  rotation << std::cos(by), -std::sin(by), std::sin(by), std::cos(by);
  return rotation;
}

bool MovingPlace::Affine() const {
  return std::none_of(terms_.begin(), terms_.end(), [](const Term& term) { return term.turns; });
}

bool MovingPlace::Moves(Eigen::Index k) const {
  return std::any_of(terms_.begin(), terms_.end(),
                     [k](const Term& term) { return term.turn[k] != 0.0 || !term.motion.col(k).isZero(0.0); });
}

Eigen::Vector2d MovingPlace::At(const Eigen::VectorXd& u, double s) const {
  const LawVector q = LocalOf(dofs_, u, s);
  Eigen::Vector2d x = constant_;
  for (const Term& term : terms_) x += term.turns ? Eigen::Vector2d(term.Rotation(q) * term.Arm(q)) : term.Arm(q);
  return x;
}

PlaceAt::PlaceAt(const MovingPlace& place, const Eigen::VectorXd& u, double s) : x(place.constant_) {
  const LawVector q = LocalOf(place.dofs_, u, s);
  first = MovingPlace::Motion::Zero(2, q.size());
  for (const MovingPlace::Term& term : place.terms_) {
    if (!term.turns) {
      x += term.Arm(q);
      first += term.motion;
      continue;
    }
    Turned& turned = turned_.emplace_back();
    turned.term = &term;
    turned.arm = term.Arm(q);
    auto& rotation = turned.rotation;
    rotation[0] = term.Rotation(q);
    for (std::size_t k = 1; k < rotation.size(); ++k)
      rotation[k] << -term.rate * rotation[k - 1].row(1), term.rate * rotation[k - 1].row(0);
    x += rotation[0] * turned.arm;
    first += rotation[0] * term.motion;
    first += (rotation[1] * turned.arm) * term.turn.transpose();
  }
}

LawMatrix PlaceAt::Second(const Eigen::Vector2d& weights) const {
  LawMatrix second = LawMatrix::Zero(first.cols(), first.cols());
  for (const auto& [term, rotation, arm] : turned_) {
    const LawVector border = term->motion.transpose() * (rotation[1].transpose() * weights);
    AddTurn(term->turn, border, weights.dot(rotation[2] * arm), &second);
  }
  return second;
}

MovingPlace::Motion PlaceAt::FirstChange(const LawVector& direction) const {
  MovingPlace::Motion change = MovingPlace::Motion::Zero(2, first.cols());
  for (const auto& [term, rotation, arm] : turned_) {
    const double by = term->turn.dot(direction);
    change += by * rotation[1] * term->motion;
    change += (rotation[1] * (term->motion * direction) + by * (rotation[2] * arm)) * term->turn.transpose();
  }
  return change;
}

LawMatrix PlaceAt::SecondChange(const Eigen::Vector2d& weights, const LawVector& direction) const {
  LawMatrix change = LawMatrix::Zero(first.cols(), first.cols());
  for (const auto& [term, rotation, arm] : turned_) {
    const double by = term->turn.dot(direction);
    const LawVector border = by * (term->motion.transpose() * (rotation[2].transpose() * weights));
    AddTurn(term->turn, border, weights.dot(by * (rotation[3] * arm) + rotation[2] * (term->motion * direction)),
            &change);
  }
  return change;
}

LawMatrix PlaceAt::Hessian(const Eigen::Vector2d& gradient, const Eigen::Matrix2d& hessian) const {
  LawMatrix second = first.transpose() * hessian * first;
  if (!turned_.empty()) second += Second(gradient);
  return second;
}

LawMatrix PlaceAt::HessianChange(const Eigen::Vector2d& gradient, const Eigen::Matrix2d& hessian,
                                 const Eigen::Matrix2d& change, const LawVector& direction) const {
  if (turned_.empty()) return first.transpose() * change * first;
  const LawMatrix mixed = FirstChange(direction).transpose() * hessian * first;
  return LawMatrix(first.transpose() * change * first) + mixed + mixed.transpose() +
         Second(hessian * (first * direction)) + SecondChange(gradient, direction);
}

}  // namespace contact_path
