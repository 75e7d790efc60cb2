// Residuals of an increment of a path, computed from the scene alone: the expanded scene and its units are shared with
// the code that solved for the increment, and no mechanics.
#ifndef CONTACT_PATH_CHECK_RESIDUALS_H_
#define CONTACT_PATH_CHECK_RESIDUALS_H_

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "contact_path/scene/configuration.h"
#include "contact_path/scene/scaling.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

// All without unit: forces over the characteristic force F, lengths over the characteristic length L (scene/scaling.h).
struct Residuals {
  // max |phi - T r| over the free components / F, of moments / (F L) (eq. 1). In place of F, 1e-4 of the stiffness of
  // the elements at the node times L where this is larger: 1e11 times the rounding of coordinates. Reactions have the
  // same unit.
  double equilibrium = 0.0;
  double penetration = 0.0;       // max (-gap) / L, 0 if none
  double tensile_reaction = 0.0;  // max (-r_n) / F, 0 if none
  // max |min(gap / L, r / F)| (eq. 2), where r is r_n, or |r_t| where this is larger: at an open gap there is neither.
  double complementarity = 0.0;
  double cone = 0.0;  // max (|r_t| - mu r_n) / F, 0 if inside
  // Friction law (eq. 3) with rt = r_t / F, rn = r_n / F, d = du_t / L: max |rt - clamp(rt - d, -mu rn, mu rn)|:
  // no slip inside the cone, slip opposed to r_t on its boundary. By the total law, d is the slip since the start of
  // the program.
  double friction_law = 0.0;
  // max distance of a fixed component from where it has to be, or of the nodes of a pin from each other but for what
  // the pin gives way, / L, of rotations [rad].
  double support = 0.0;

  static constexpr std::array<double Residuals::*, 7> kAll = {
      &Residuals::equilibrium, &Residuals::penetration,  &Residuals::tensile_reaction, &Residuals::complementarity,
      &Residuals::cone,        &Residuals::friction_law, &Residuals::support};

  // Largest residual of contacts: the column complementarity_residual.
  double Contact() const;
  // Largest of all.
  double Largest() const;
};

// What the check looks at: positions x0, y0, x1, ... (2 x nodes) [length], r_n and r_t by contact candidate [force].
struct CheckedState {
  double load_factor = 0.0;
  std::vector<double> positions;
  std::vector<double> rotations;  // by node, since the reference shape [rad]; empty in a scene without beams
  std::vector<double> rn;
  std::vector<double> rt;
  std::vector<double> pins;  // of each pin the force x, y on its first node by the second [force]
};

// What holds the structure: x, y [force] and moment [force length], on the structure.
struct CheckedForces {
  std::vector<std::array<double, 3>> supports;    // of SupportedNodes() (scene/scene_index.h); 0 in free components
  std::vector<std::array<double, 3>> boundaries;  // of TouchedBoundaries(): sum of all contacts, the moment about the
                                                  // point p of an obstacle, or about the first node of a surface
};

// What the elements bear, and the lengths that contacts stand for.
struct CheckedAnswers {
  std::vector<std::array<double, 5>> sections;  // of bars and segments of beams: N, Q [force], M, M1, M2 [force length]
  std::vector<std::array<double, 6>>
      stresses;                           // of solids: xx, yy, xy, zz, mises [force/length^2], energy [force length]
  std::vector<double> stress_per_motion;  // at least its change by a motion of the nodes [force/length^3]
  std::vector<double> lengths;            // by contact candidate [length]
  std::vector<std::size_t> boundaries;    // by contact candidate: which of TouchedBoundaries()
};

// Upper bounds of the forces at a contact candidate [force].
struct ContactForceBound {
  double on_node = 0.0;       // on its node, across the contact
  double of_all_parts = 0.0;  // across all contacts of its node, and of the surfaces that they touch
};

// The check of one scene, with its names resolved once.
class ResidualCheck {
 public:
  // scaling: characteristic force and length that residuals are divided by. Without scaling and configuration the check
  // takes the scales and the shape of the scene. Throws std::invalid_argument or std::out_of_range for a name that the
  // scene does not have.
  explicit ResidualCheck(const Scene& scene);
  ResidualCheck(const Scene& scene, const Configuration& configuration, const Scaling& scaling);
  ~ResidualCheck();
  ResidualCheck(const ResidualCheck&) = delete;
  ResidualCheck& operator=(const ResidualCheck&) = delete;

  // Residuals of `now`, reached from `before` in one increment (for the first increment: `before` = `now`).
  // Throws std::invalid_argument where the sizes do not fit the scene.
  Residuals Check(const CheckedState& before, const CheckedState& now) const;
  // phi - T r by component x0, y0, x1, ... [force], and after them by rotation where there are beams [force length]; of
  // a fixed component, the force that holds it.
  std::vector<double> Unbalance(const CheckedState& state) const;
  // Of supports, obstacles and surfaces.
  CheckedForces Forces(const CheckedState& state) const;
  CheckedAnswers Answers(const CheckedState& state) const;
  // The force that moving supports and obstacles exert along their motion per unit of the load factor [force length]:
  // the integral over the load factor is their work.
  double DrivingForce(const CheckedState& state) const;
  // Gap of a contact candidate in a state [length], and its slip between two: tangential motion along the obstacle, as
  // the obstacle sees it [length].
  double Gap(std::size_t contact, const CheckedState& state) const;
  // Gap() where a node that is over an end of the surface to rounding counts as past the end: of a surface with a
  // radius, the gap changes by the radius there.
  double GapPastEnd(std::size_t contact, const CheckedState& state) const;
  double Slip(std::size_t contact, const CheckedState& from, const CheckedState& to) const;
  // The largest |rt| / rn, and what works along the slip where the contact slides [force].
  double Friction(std::size_t contact, const CheckedState& state) const;
  double SlidingForce(std::size_t contact, const CheckedState& given) const;
  // rn where the place alone tells it, as at an eye of a tendon [force].
  std::optional<double> NormalByPlace(std::size_t contact, const CheckedState& given) const;
  // What forces may be off by where curvatures jump below contacts that give way [force].
  double Uncertain(const CheckedState& state) const;
  // Motion by which a contact gives way to a force [length/force]; 0 where it is not of a rigid body. Of a pin; 0 where
  // it is in no loop.
  double Give(std::size_t contact) const;
  double GiveOfPin(std::size_t pin) const;
  // The force that it gives way to along t: rt over the share that is left of its friction [force].
  double GivesTo(std::size_t contact, const CheckedState& state) const;
  // By the total law of friction, slip since the start of the program; round a closed obstacle the shorter way. Throws
  // std::invalid_argument where the configuration has no slip_origins.
  double TotalSlip(std::size_t contact, const CheckedState& state) const;
  // The normal of the obstacle at the foot of a contact candidate, of length 1, towards the admissible side.
  std::array<double, 2> Normal(std::size_t contact, const CheckedState& state) const;
  // By contact candidate, at the start, for a motion of `length` of the elements and for the loads at `load_factor`.
  std::vector<ContactForceBound> BoundContactForces(double length, double load_factor) const;
  // At least the largest force per motion that the elements at a node exert at the start [force/length].
  double LargestStiffness() const;
  // Strain energy of the structure [force length]. rotations: as in CheckedState.
  double StrainEnergy(const std::vector<double>& positions, const std::vector<double>& rotations = {}) const;

 private:
  struct Prepared;
  std::unique_ptr<const Prepared> prepared_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_CHECK_RESIDUALS_H_
