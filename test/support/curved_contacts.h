// Contacts with curved surfaces, for the tests of everything that is derived from gap and xi.
#ifndef CONTACT_PATH_TEST_SUPPORT_CURVED_CONTACTS_H_
#define CONTACT_PATH_TEST_SUPPORT_CURVED_CONTACTS_H_

#include <Eigen/Core>
#include <memory>

#include "contact_path/contact/contact_pair.h"
#include "contact_path/contact/rigid_pair.h"
#include "contact_path/geometry/surface.h"
#include "contact_path/scene/scene_index.h"
#include "contact_path/structure/structure.h"
#include "support/curved_surfaces.h"
#include "support/mixed_scene.h"
#include "support/points.h"

namespace contact_path {

// MovingScene() with contacts of its own, in this order:
//   b   on a disc below it, mu = 0.3, the disc moves        d   on a spiral, mu = 0.5
//   c   on a disc beside it, c slides along y only, mu = 0.4   e   on a flat floor, mu = 0.2, the floor moves
//   b   on a disc above it, frictionless
// All gaps are between 0 and 0.6 at the start.
inline ContactPairs CurvedContacts(const Structure& structure) {
  const Scene scene = MovingScene();
  const SceneIndex index(scene);
  ContactPairs contacts;
  const auto add = [&](const char* name, std::shared_ptr<const Surface> surface, const Eigen::Vector2d& velocity,
                       double friction) {
    const auto node = static_cast<int>(index.Node(name));
    contacts.push_back(std::make_unique<RigidPair>(
        std::move(surface), MovingPlace::SeenFrom(MovedFrame(velocity), structure.PointOf(node)), friction));
  };
  const Eigen::Vector2d at_rest = Eigen::Vector2d::Zero();
  add("b", std::make_shared<DiscOutside>(Eigen::Vector2d(1.4, -0.9), 1.0), {0.3, -0.2}, 0.3);
  add("d", std::make_shared<Spiral>(0.3, -0.4, 0.5), at_rest, 0.5);
  add("c", std::make_shared<DiscOutside>(Eigen::Vector2d(2.3, 0.7), 0.7), at_rest, 0.4);
  add("e", std::make_shared<HalfPlane>(Eigen::Vector2d(0.0, 0.7), Eigen::Vector2d(0.1, 1.0)), {0.2, 0.1}, 0.2);
  add("b", std::make_shared<DiscOutside>(Eigen::Vector2d(0.8, 1.3), 0.6), at_rest, 0.0);
  return contacts;
}

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SUPPORT_CURVED_CONTACTS_H_
