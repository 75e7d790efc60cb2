// A piece of a tendon between two nodes, at one or both of which the tendon slides through an eye with friction.
#ifndef CONTACT_PATH_LAW_TENDON_SPAN_H_
#define CONTACT_PATH_LAW_TENDON_SPAN_H_

#include <Eigen/Core>
#include <array>
#include <vector>

#include "contact_path/law/slack_bar.h"
#include "contact_path/scene/scene.h"
#include "contact_path/scene/scene_index.h"
#include "contact_path/structure/place.h"
#include "contact_path/structure/structure.h"

namespace contact_path {

// With the length l from node to node, along rollers there, and the length at rest of what is between them, a = a_0 +
// what came in at the first node - what went out at the second one, the energy is W = EA (l - a)^2 / (2 a): the tension
// is T = EA (l / a - 1), and on a it acts with -dW/da = T + T^2 / (2 EA). So that W = c r^2 / 2 with c = a_0 / EA, the
// port has the motion g = -(l - a) sqrt(a_0 / a) [length] and the force r = T sqrt(a / a_0).
class TendonSpan : public SlackBar {
 public:
  // span: from the first node to the second. EA > 0 [force]; rest_length: a_0 > 0 [length]. first, second: what slides
  // there, in or out [length]: an unknown, held at the start; with no unknown the tendon ends there.
  TendonSpan(const BarSpan& span, const Windings& windings, double EA, double rest_length, const Coordinate& first,
             const Coordinate& second);

  struct State {
    PlaceAt span;             // from node to node
    double rest;              // a
    Eigen::Vector2d tangent;  // what is free of it, from roller to roller
    double length;            // l, with the arcs and what is wound
    double wound;             // of l: by drums, and the arcs at the start
  };
  State At(const Eigen::VectorXd& u, double s) const;
  using SlackBar::Rolled;
  using SlackBar::Span;
  using SlackBar::WoundGradient;
  double Compliance() const { return RestLength() / EA(); }
  // d(a)/dq by (dofs, s) of `dofs`, which must have those of what slides.
  LawVector RestGradient(const LawDofs& dofs) const;

  void Evaluate(const Eigen::VectorXd& u, double s, int piece, const PortReals& reference,
                PortsAt* ports) const override;
  void ForceHessian(const Eigen::VectorXd& u, double s, int piece, const PortReals& forces, const LawVector& weights,
                    LawMatrix* hessian) const override;

 private:
  // d(l)/dq; direction: of the tangent.
  LawVector LengthGradient(const State& at, const Eigen::Vector2d& direction) const;

  std::array<Coordinate, 2> slides_;
};

// scene: expanded, with this piece; `structure` built from it.
TendonSpan MakeSpan(const Tendon& piece, const Scene& scene, const SceneIndex& index, const Structure& structure);

}  // namespace contact_path

#endif  // CONTACT_PATH_LAW_TENDON_SPAN_H_
