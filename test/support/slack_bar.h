// A bar that bears in one sense alone, as a law: taut or slack.
#ifndef CONTACT_PATH_TEST_SUPPORT_SLACK_BAR_H_
#define CONTACT_PATH_TEST_SUPPORT_SLACK_BAR_H_

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "contact_path/law/law.h"

namespace contact_path {

// Between two places, each of two unknowns, or held. Port: motion = -sense (l - l0), force = sense EA (l / l0 - 1):
// taut, motion + l0 / EA force = 0 and force >= 0; slack, motion >= 0.
class SlackBar : public Law {
 public:
  enum State { kTaut, kSlack };
  struct Place {
    std::array<int, 2> dofs = {-1, -1};  // ascending; -1: held
    Eigen::Vector2d held = Eigen::Vector2d::Zero();
  };

  // sense: 1 bears tension, -1 compression.
  SlackBar(const Place& a, const Place& b, double EA, double rest_length, double sense)
      : a_(a), b_(b), rest_length_(rest_length), sense_(sense) {
    Traits traits;
    for (const Place* place : {&a_, &b_})
      for (const int dof : place->dofs)
        if (dof >= 0) traits.dofs.push_back(dof);
    traits.couples = traits.compliant = traits.curved = true;
    for (std::size_t k = 0; k < traits.dofs.size(); ++k) traits.moves[0][k] = true;
    traits.largest_reach_rate = std::sqrt(2.0);
    std::vector<StateRule> states(2);
    states[kTaut].ports[0] = {PortRule::Kind::kHeld, 0.0, rest_length / EA};
    LimitRule pulls;
    pulls.id = 0;
    pulls.of = LimitRule::Of::kForces;
    pulls.weights[0] = 1.0;
    pulls.next = kSlack;
    states[kTaut].limits = {pulls};
    states[kTaut].held = kTaut;
    LimitRule hangs;
    hangs.id = 1;
    hangs.next = kTaut;
    states[kSlack].limits = {hangs};
    states[kSlack].held = kSlack;
    SetLaw(traits, std::move(states));
  }

  void Evaluate(const Eigen::VectorXd& u, double /*s*/, int /*piece*/, const PortReals& reference,
                PortsAt* ports) const override {
    const Eigen::Vector2d d = Span(u);
    const double l = d.norm();
    const Eigen::Vector2d n = d / l;
    ports->dofs = OwnDofs();
    PortAt& port = (*ports)[0];
    port.motion = -sense_ * (l - rest_length_) - reference[0];
    port.gradient = Spread(-sense_ * n);
    port.hessian = SpreadTwice(-sense_ / l * (Eigen::Matrix2d::Identity() - n * n.transpose()));
  }
  void ForceHessian(const Eigen::VectorXd& u, double /*s*/, int /*piece*/, const PortReals& forces,
                    const LawVector& weights, LawMatrix* hessian) const override {
    const Eigen::Vector2d d = Span(u), v = Gather(weights);
    const double l = d.norm();
    const Eigen::Vector2d n = d / l;
    const Eigen::Matrix2d across = Eigen::Matrix2d::Identity() - n * n.transpose();
    const Eigen::Vector2d w = across * v;
    // d/dh of (1 - n n') / l along v.
    *hessian = SpreadTwice(forces[0] * sense_ / (l * l) * (n.dot(v) * across + w * n.transpose() + n * w.transpose()));
  }
  PortReals ReferenceAt(const Eigen::VectorXd&, double, int) const override { return {}; }
  double Reach(const Eigen::VectorXd& u, double s) const override { return Motion(0, u, s, 0, {}); }
  Modes ModesAt(const Eigen::VectorXd& u, double s, const Mode& now, const PortReals& forces,
                const ActiveSetTolerance& tolerance) const override {
    if (Motion(0, u, s, 0, {}) > tolerance.motion) return {{kSlack, 0}};
    if (forces[0] > tolerance.force) return {{kTaut, 0}};
    return now.state == kTaut ? Modes{{kTaut, 0}, {kSlack, 0}} : Modes{{kSlack, 0}, {kTaut, 0}};
  }
  Mode Initial(const Eigen::VectorXd& u, double s) const override {
    return {Motion(0, u, s, 0, {}) > 0.0 ? kSlack : kTaut, 0};
  }
  std::vector<Ray> Rays(const Eigen::VectorXd&, double, int, const ActiveSetTolerance&) const override {
    return {{{1.0}, {1.0}}};
  }

 private:
  static Eigen::Vector2d At(const Place& place, const Eigen::VectorXd& u) {
    Eigen::Vector2d x = place.held;
    for (const int axis : {0, 1})
      if (const int dof = place.dofs[static_cast<std::size_t>(axis)]; dof >= 0) x[axis] = u[dof];
    return x;
  }
  Eigen::Vector2d Span(const Eigen::VectorXd& u) const { return At(b_, u) - At(a_, u); }
  // Which share of the span the unknowns are: rows x and y, a column each of (dofs, s).
  Eigen::Matrix<double, 2, Eigen::Dynamic> Columns() const {
    Eigen::Matrix<double, 2, Eigen::Dynamic> columns =
        Eigen::Matrix<double, 2, Eigen::Dynamic>::Zero(2, static_cast<Eigen::Index>(OwnDofs().size()) + 1);
    Eigen::Index k = 0;
    for (const auto& [place, sign] : {std::pair(&a_, -1.0), std::pair(&b_, 1.0)})
      for (const int axis : {0, 1})
        if (place->dofs[static_cast<std::size_t>(axis)] >= 0) columns(axis, k++) = sign;
    return columns;
  }
  LawVector Spread(const Eigen::Vector2d& of_span) const { return Columns().transpose() * of_span; }
  LawMatrix SpreadTwice(const Eigen::Matrix2d& of_span) const { return Columns().transpose() * of_span * Columns(); }
  Eigen::Vector2d Gather(const LawVector& q) const { return Columns() * q; }

  Place a_, b_;
  double rest_length_, sense_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SUPPORT_SLACK_BAR_H_
