// What the verification knows of the contacts of a scene.
#ifndef CONTACT_PATH_SRC_VERIFY_VERIFIED_CONTACTS_H_
#define CONTACT_PATH_SRC_VERIFY_VERIFIED_CONTACTS_H_

#include <cstddef>
#include <string>
#include <vector>

#include "contact_path/check/residuals.h"
#include "contact_path/scene/configuration.h"
#include "contact_path/scene/scaling.h"
#include "contact_path/scene/scene.h"
#include "contact_path/scene/scene_index.h"

namespace contact_path {

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
  double of_parts = 1.0;  // forces of the parts there for a motion of L, over F, at least 1
};

// In the order of the scene. check, configuration: of the scene. rates: x, y by node, of the fixed components [length]
// per unit of the load factor. load: largest load factor of the path.
std::vector<VerifiedContact> VerifiedContacts(const Scene& scene, const SceneIndex& index, const ResidualCheck& check,
                                              const Configuration& configuration, const Scaling& scaling,
                                              const std::vector<double>& rates, double load);

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_VERIFY_VERIFIED_CONTACTS_H_
