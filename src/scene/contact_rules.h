// The rules of obstacles and contact candidates.
#ifndef CONTACT_PATH_SRC_SCENE_CONTACT_RULES_H_
#define CONTACT_PATH_SRC_SCENE_CONTACT_RULES_H_

#include <memory>
#include <unordered_map>
#include <unordered_set>

#include "contact_path/geometry/surface.h"
#include "scene/boundary_rules.h"
#include "scene/checker.h"

namespace contact_path {

class ContactRules {
 public:
  explicit ContactRules(Checker* checker) : checker_(*checker), scene_(checker->GetScene()), boundaries_(checker) {}

  void CheckObstacles();
  // After CheckObstacles(). length: the characteristic length, 0 where it is not known.
  void CheckContacts(double length);

 private:
  // Which of its fields a contact has.
  void CheckPartner(const KeyPath& path, const ContactCandidate& contact);

  void CheckGeometry(const KeyPath& path, const ContactCandidate& contact, const Node& node, const Obstacle& obstacle,
                     double length);

  // Of another shape than a half plane. Past the ends of an open curve there is nothing to penetrate.
  void CheckOnCurve(const KeyPath& path, const ContactCandidate& contact, const Node& node, const Obstacle& obstacle,
                    double length);

  Checker& checker_;
  const Scene& scene_;
  BoundaryRules boundaries_;
  std::unordered_set<const Obstacle*> usable_obstacles_;  // with a shape that can be computed with
  std::unordered_map<const Obstacle*, std::unique_ptr<const Surface>> surfaces_;  // of those that are no half planes
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_SCENE_CONTACT_RULES_H_
