// The rules of obstacles and contact candidates.
#ifndef CONTACT_PATH_SRC_SCENE_CONTACT_RULES_H_
#define CONTACT_PATH_SRC_SCENE_CONTACT_RULES_H_

#include <unordered_set>

#include "scene/checker.h"

namespace contact_path {

class ContactRules {
 public:
  explicit ContactRules(Checker* checker) : checker_(*checker), scene_(checker->GetScene()) {}

  void CheckObstacles();
  // After CheckObstacles(). length: the characteristic length, 0 where it is not known.
  void CheckContacts(double length);

 private:
  void CheckGeometry(const KeyPath& path, const ContactCandidate& contact, const Node& node, const Obstacle& obstacle,
                     double length);

  Checker& checker_;
  const Scene& scene_;
  std::unordered_set<const Obstacle*> usable_obstacles_;  // with a shape that can be computed with
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_SCENE_CONTACT_RULES_H_
