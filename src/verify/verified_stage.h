// The scene of a stage, what the verification knows of it, and what rounding leaves of recorded quantities.
#ifndef CONTACT_PATH_SRC_VERIFY_VERIFIED_STAGE_H_
#define CONTACT_PATH_SRC_VERIFY_VERIFIED_STAGE_H_

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include "contact_path/check/residuals.h"
#include "contact_path/path/increment.h"
#include "contact_path/scene/configuration.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/scaling.h"
#include "contact_path/scene/scene.h"
#include "contact_path/scene/scene_index.h"
#include "contact_path/scene/validate.h"
#include "contact_path/tolerances.h"
#include "contact_path/verify/verify_path.h"

namespace contact_path {

inline constexpr double kExact = 1e-9;      // residuals of an exact increment, and all that is located, scaled
inline constexpr double kRecorded = 1e-11;  // recorded numbers against those computed anew, scaled
// A place that forces tell to second order, as next to a singular point, or against soft parts, scaled.
inline constexpr double kSingular = 1e-7;
// Of the force of a part for a motion of L: residuals and reactions are measured in no less, and the rounding of
// coordinates makes so much of it.
inline constexpr double kStiff = 1e-4;
inline constexpr double kRoundingOfParts = 1e-14;

// Over F: what residuals are measured in. stiffest: force of the stiffest node for a motion of L, over F.
inline double ResidualUnit(double stiffest) { return std::max(1.0, kStiff * stiffest); }

// Whether a contact that is not open carries nothing: it may let go.
inline bool TouchesWithoutForce(const Increment& increment, const Scaling& scaling) {
  return std::any_of(increment.contacts.begin(), increment.contacts.end(), [&](const ContactRecord& contact) {
    return contact.state != ContactState::kOpen && contact.rn <= tolerances::kActive * scaling.force;
  });
}

struct VerifiedContact {
  std::size_t node = 0;
  double friction = 0.0;  // 0 where the node cannot slide
  std::string name;
  // Forces across the contact that count as 1, over F: 1, or the forces there where these are far below F.
  double unit = 1.0;
  // Rounding of a reaction, over F times the unit. Coordinates are known to 1e-16 of their size, and the stiffness of
  // the parts turns that into forces. At least the rounding at a contact across which forces are F.
  double rounding = 0.0;
  // Rounding, or the largest force that closes a gap which counts as closed at the start and is not 0.
  double closing = 0.0;
  double of_parts = 1.0;  // forces of the parts, and of what gives way, there for a motion of L, over F, at least 1
};

// Of the loads that the load factor scales, on free components.
struct DrivingLoad {
  explicit DrivingLoad(const Scene& scene, const SceneIndex& index);

  std::vector<std::array<double, 3>> by_node;  // fx, fy, moment
  double size = 0.0;                           // |f|: of the forces, or of the moments where there are no forces
  bool moments_alone = false;
};

struct VerifiedStage {
  // index: of the scene of the request; of_program: the scales of the program; largest_load: the largest load factor
  // that the increments of the stage have.
  VerifiedStage(const TraceRequest& request, const SceneIndex& index, const Scaling& of_program, std::size_t stage,
                double largest_load);

  double Energy() const { return scaling.force * scaling.length; }  // characteristic [force length]

  bool Driven() const { return IsDriven(scene); }

  const SceneIndex& index;
  const Scene scene;
  const Configuration configuration;
  const Scaling scaling;
  const ResidualCheck check;
  const DrivingLoad driving;
  const bool located;                     // increments end where contacts change their states
  std::vector<double> rates;              // x, y by node: of the fixed components [length], per unit of the load factor
  std::vector<double> turn_rates;         // by node: of the fixed rotations [rad], per unit of the load factor
  double rounding = 0.0;                  // of recorded motions over L, and of forces over F
  double stiffest = 0.0;                  // force of the stiffest node for a motion of L, over F
  std::vector<VerifiedContact> contacts;  // in the order of the scene
};

// Whether both have the same numbers of positions, rotations and contacts.
inline bool SameSizes(const Increment& a, const Increment& b) {
  return a.positions.size() == b.positions.size() && a.rotations.size() == b.rotations.size() &&
         a.contacts.size() == b.contacts.size();
}

// Of all positions and rotations, 0 of nodes that move with a body, and of the load factor, scaled. State: Increment or
// CheckedState of the same sizes.
template <typename State>
std::vector<double> ScaledMotion(const State& from, const State& to, const Scene& scene, const Scaling& scaling) {
  std::vector<double> motion;
  motion.reserve(to.positions.size() + to.rotations.size() + 1);
  for (std::size_t i = 0; i < to.positions.size(); ++i)
    motion.push_back(IsAttached(scene.nodes[i / 2]) ? 0.0 : (to.positions[i] - from.positions[i]) / scaling.length);
  for (std::size_t i = 0; i < to.rotations.size(); ++i)
    motion.push_back(IsAttached(scene.nodes[i]) ? 0.0 : to.rotations[i] - from.rotations[i]);
  motion.push_back((to.load_factor - from.load_factor) / scaling.load_factor);
  return motion;
}

inline double Product(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

class Findings {
 public:
  // Appends to *list, up to kMostLines (scene/validate.h).
  explicit Findings(std::vector<Finding>* list) : list_(*list) {}

  // The increment that the next findings are of.
  void SetIncrement(std::size_t increment) { increment_ = increment; }

  template <typename... Parts>
  void Report(const Parts&... parts) {
    if (list_.size() >= kMostLines) return;
    std::ostringstream text;
    text.precision(6);
    (text << ... << parts);
    list_.push_back({static_cast<int>(increment_), text.str()});
  }

  // Of a value that should be zero, or less.
  void Bound(const std::string& what, double value, double tolerance) {
    if (!(value <= tolerance)) Report(what, ": ", value, " > ", tolerance);
  }

 private:
  std::vector<Finding>& list_;
  std::size_t increment_ = 0;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_VERIFY_VERIFIED_STAGE_H_
