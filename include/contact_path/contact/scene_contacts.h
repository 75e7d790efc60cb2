// The contact candidates of a scene.
#ifndef CONTACT_PATH_CONTACT_SCENE_CONTACTS_H_
#define CONTACT_PATH_CONTACT_SCENE_CONTACTS_H_

#include <vector>

#include "contact_path/contact/contact_pair.h"
#include "contact_path/scene/scene.h"
#include "contact_path/scene/scene_index.h"
#include "contact_path/structure/structure.h"

namespace contact_path {

// All candidates in scene order. `scene` must be sound, and `structure` built from it. index: of the scene, or of one
// with the same nodes and obstacles; where not given, one is made. slip_origins: of the configuration, as the scene is
// scaled.
ContactPairs BuildContacts(const Scene& scene, const SceneIndex& index, const Structure& structure,
                           const std::vector<double>& slip_origins = {});
ContactPairs BuildContacts(const Scene& scene, const Structure& structure);

}  // namespace contact_path

#endif  // CONTACT_PATH_CONTACT_SCENE_CONTACTS_H_
