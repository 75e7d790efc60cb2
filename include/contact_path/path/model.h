// A scene made ready for the solvers: scaled, assembled, with its contacts, and the increment length that suits it.
#ifndef CONTACT_PATH_PATH_MODEL_H_
#define CONTACT_PATH_PATH_MODEL_H_

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "contact_path/check/residuals.h"
#include "contact_path/contact/contact_pair.h"
#include "contact_path/law/laws.h"
#include "contact_path/law/pin_joint.h"
#include "contact_path/law/slack_bar.h"
#include "contact_path/path/increment.h"
#include "contact_path/response/contact_pressure.h"
#include "contact_path/response/element_response.h"
#include "contact_path/response/reactions.h"
#include "contact_path/scene/configuration.h"
#include "contact_path/scene/scaling.h"
#include "contact_path/scene/scene.h"
#include "contact_path/scene/scene_index.h"
#include "contact_path/structure/structure.h"

namespace contact_path {

// Not to be copied or moved: the solvers keep references to its parts.
struct Model {
  // `scene` must be sound. scaling: CharacteristicScales() of the scene, or of the scene with other loads.
  // configuration: in scene units; where not given, Configuration::Of(scene).
  Model(const Scene& scene, const Scaling& scaling);
  Model(const Scene& scene, const Configuration& configuration, const Scaling& scaling);
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;

  // The initial configuration at load factor 0 without reactions. Candidates that touch: stick, or closed if
  // frictionless.
  PathPoint InitialPoint() const;
  // A point of another model with the same nodes, contacts and scales of length and force, as this one sees it at load
  // factor 0: where supports and obstacles are must agree.
  PathPoint Transfer(const Model& other, const PathPoint& point) const;
  // The point in the units of the scene, as the check and the records want it. Fixed components are as in the scene.
  CheckedState InSceneUnits(const PathPoint& point) const;
  // The inverse of InSceneUnits(), with one rounding, for an increment that has positions and contacts.
  PathPoint FromIncrement(const Increment& increment) const;
  // r_t by contact, scaled.
  std::vector<double> TangentialReactions(const PathPoint& point) const;
  // Of supports, obstacles and surfaces, in the units of the scene.
  Reactions ReactionsAt(const PathPoint& point) const;
  // Made when they are first asked for. Not by two threads at once.
  const ElementResponse& Elements() const;
  const PressureProblem& PressuresOfContacts() const;
  // By check/, of `now` reached from `before`.
  Residuals Check(const PathPoint& before, const PathPoint& now) const;

  // Of the loads f that the load factor scales: |f|, scaled, the norm of the forces, or of the moments where there are
  // no forces; the unit of x = f . u / |f|, of length, or 1 [rad] of moments alone; and K of TraceOptions over the
  // scaled k of s = k (Q - f . u).
  struct LoadSize {
    double norm = 0.0;  // 0: there are no such loads
    double unit_of_displacement = 1.0;
    double unit_of_stiffness = 1.0;
  };
  LoadSize SizeOfLoads() const;
  // x0, y0, x1, ... over the nodes of a motion of the unknowns from u, both of NumDofs() or more entries: 0 where
  // nothing moves.
  std::vector<double> ComponentsOf(const Eigen::VectorXd& u, const Eigen::VectorXd& motion) const;

  // Places among the laws.
  std::size_t LawOfBar(std::size_t bar) const { return contacts.size() + bar; }
  std::size_t LawOfPin(std::size_t pin) const { return LawOfBar(bars.size()) + pin; }

  // As sentences name it: of a contact, of a bar or a tendon, of a pin.
  std::string NameOfLaw(std::size_t law) const;
  // Of the pins, two forces each, scaled.
  std::vector<PortReals> ForcesOfPins(const PathPoint& point) const;

  // Of the bars among the modes of all laws.
  std::vector<BarState> BarStatesIn(const Modes& modes) const;

  // Puts each law on the piece where it is, in its state.
  void NotePieces(PathPoint* point) const;

  const Scene scene;       // as the user wrote it
  const SceneIndex index;  // of the scene: the scaled one has the same names
  const Configuration configuration;
  const Scaling scaling;
  const Origin origin;  // of the coordinates of all scaled quantities
  const Scene scaled;
  const Configuration scaled_configuration;
  const Structure structure;                                // of the scaled scene
  const ContactPairs contacts;                              // of the scaled scene
  const std::vector<std::unique_ptr<const SlackBar>> bars;  // that bear in one sense alone, of the scaled scene
  const std::vector<std::unique_ptr<const PinJoint>> pins;  // of the scaled scene
  const Laws laws;                                          // the contacts, then these bars, then the pins
  const ReactionProblem reactions;
  const ResidualCheck check;  // of the scene

 private:
  mutable std::unique_ptr<const ElementResponse> elements_;
  mutable std::unique_ptr<const PressureProblem> pressures_;
};

// Factor on the length of a preset. Arc length is a sum over all components: where all of them move alike, it grows
// with the root of their number. Beyond a hundred of them a node moves as far in an increment as it does among a
// hundred. The inner nodes of a beam move with it: they count together as one node, so that increments do not depend on
// the number of segments.
double AutomaticStepGrowth(const Model& model);

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_MODEL_H_
