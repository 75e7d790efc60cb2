// A bar that bears in one sense alone, or a tendon, as a law: taut or slack.
#ifndef CONTACT_PATH_LAW_SLACK_BAR_H_
#define CONTACT_PATH_LAW_SLACK_BAR_H_

#include <Eigen/Core>
#include <array>
#include <memory>
#include <string_view>
#include <vector>

#include "contact_path/geometry/rolled_span.h"
#include "contact_path/law/law.h"
#include "contact_path/scene/scene.h"
#include "contact_path/scene/scene_index.h"
#include "contact_path/structure/place.h"
#include "contact_path/structure/structure.h"

namespace contact_path {

// The numbers are those of Mode::state.
enum class BarState { kTaut, kSlack };
constexpr int NumberOf(BarState state) { return static_cast<int>(state); }

// "taut", "slack".
std::string_view ToString(BarState state);

// What adds to a length by an angle: the drum at an end of a string, wound by its turn since the start.
struct Winding {
  Coordinate turn = {};
  double by_turn = 0.0;  // [length/rad]; 0: none
};
using Windings = std::array<Winding, 2>;

// From one node of a bar or tendon to the next.
struct BarSpan {
  MovingPlace apart;
  RolledSpan rolled = {};
};

// With the strain e of the length of the spans, each between two places (scene.h, StrainMeasure), and sigma = 1 of a
// bar that bears tension, -1 of one that bears compression, the port has the motion g = -sigma l0 e [length], and the
// force r >= 0 along it:
//   taut:   g + (l0 / EA) r = 0, r >= 0, so that r = sigma EA e, the force of a bar by its energy EA l0 e^2 / 2
//   slack:  r = 0, g >= 0
class SlackBar : public Law {
 public:
  // spans: from each node to the next; several, with rollers or windings only with kBiot. EA > 0 [force],
  // rest_length > 0 [length]; sense: not kBoth. They must not depend on more than kMostLawDofs unknowns.
  SlackBar(std::vector<BarSpan> spans, const Windings& windings, double EA, double rest_length, StrainMeasure strain,
           BarSense sense);

  void Evaluate(const Eigen::VectorXd& u, double s, int piece, const PortReals& reference,
                PortsAt* ports) const override;
  void ForceHessian(const Eigen::VectorXd& u, double s, int piece, const PortReals& forces, const LawVector& weights,
                    LawMatrix* hessian) const override;
  PortReals ReferenceAt(const Eigen::VectorXd& /*u*/, double /*s*/, int /*piece*/) const override { return {}; }
  double Reach(const Eigen::VectorXd& u, double s) const override { return Motion(0, u, s, 0, {}); }
  Modes ModesAt(const Eigen::VectorXd& u, double s, const Mode& now, const PortReals& forces,
                const ActiveSetTolerance& tolerance) const override;
  Mode Initial(const Eigen::VectorXd& u, double s) const override;
  std::vector<Ray> Rays(const Eigen::VectorXd& /*u*/, double /*s*/, int /*piece*/,
                        const ActiveSetTolerance& /*tolerance*/) const override {
    return {{{1.0}, {1.0}}};
  }

  double EA() const { return EA_; }  // [force]

 protected:
  // A tendon of one span with motions of its own, which every entry of `dofs` changes.
  SlackBar(const BarSpan& span, const Windings& windings, double EA, double rest_length, const LawDofs& dofs);
  // Of all that it depends on; others: besides spans and windings.
  static LawDofs DofsOf(const std::vector<BarSpan>& spans, const Windings& windings,
                        const std::array<Coordinate, 2>& others);
  const MovingPlace& Span() const { return spans_.front().apart; }
  const RolledSpan& Rolled() const { return spans_.front().rolled; }
  double RestLength() const { return rest_length_; }
  // What is wound, and its derivatives by (dofs, s).
  double Wound(const Eigen::VectorXd& u, double s) const;
  LawVector WoundGradient(const LawDofs& dofs) const;

 private:
  void SetBar(Traits traits);
  double Least() const;  // what counts as the free length of a span that has none
  // By the square of the length.
  struct Strain {
    double value, first, second, third;
  };
  Strain StrainAt(double q) const;

  std::vector<BarSpan> spans_;
  Windings windings_;
  double rest_length_, EA_, sense_;
  StrainMeasure strain_;
};

// Of the tendon, from first to last node, at the ends of which drums turn with bodies.
Windings WindingsOf(const Tendon& tendon, const Scene& scene, const SceneIndex& index, const Structure& structure);

// Of OneSidedBars() of the scene, in their order. `scene` must be sound, `structure` built from
// it. reference: x0, y0, x1, ... of the shape without stress (scene/configuration.h).
std::vector<std::unique_ptr<const SlackBar>> BuildSlackBars(const Scene& scene, const SceneIndex& index,
                                                            const Structure& structure,
                                                            const std::vector<double>& reference);

}  // namespace contact_path

#endif  // CONTACT_PATH_LAW_SLACK_BAR_H_
