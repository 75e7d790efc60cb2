// The rules of loads, motions and load programs.
#ifndef CONTACT_PATH_SRC_SCENE_LOADING_RULES_H_
#define CONTACT_PATH_SRC_SCENE_LOADING_RULES_H_

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "scene/checker.h"

namespace contact_path {

// What the stages of a program have brought on, summed by component: whether a stage that unloads has anything to take
// back. Takes time in proportion to what is added.
class BroughtOn {
 public:
  enum class Kind { kLoad, kSupport, kObstacle };

  // part: the place of the node or obstacle.
  void Add(Kind kind, std::size_t part, int component, double value);
  void TakeBack(double share);
  bool IsNothing() const { return sums_.empty(); }
  bool Has(Kind kind) const {
    const auto first = sums_.lower_bound({kind, 0, 0});
    return first != sums_.end() && std::get<0>(first->first) == kind;
  }

 private:
  struct Sum {
    double value = 0.0, largest = 0.0;
  };
  std::map<std::tuple<Kind, std::size_t, int>, Sum> sums_;  // over left_
  double left_ = 1.0;
};

class LoadingRules {
 public:
  explicit LoadingRules(Checker* checker);

  // The loads of the scene, and whether anything changes with the load factor.
  void CheckSceneLoads();
  void CheckSceneMotions();
  void CheckProgram();

 private:
  // loading: as of Checker::LoadPlace.
  void CheckLoads(const KeyPath& where, std::size_t loading, const std::vector<Load>& loads);
  void CheckWhatMoves();
  // A machine and motions in one stage have no one path parameter.
  void CheckMachine(const KeyPath& where, const std::vector<Load>& loads, const std::vector<SupportMotion>& supports,
                    const std::vector<ObstacleMotion>& obstacles);
  void CheckMotions(const KeyPath& where, std::size_t loading, const std::vector<SupportMotion>& supports,
                    const std::vector<ObstacleMotion>& obstacles);
  void CheckSupportMotion(const KeyPath& path, const SupportMotion& motion, std::unordered_set<std::string>* moved);
  // Of a support or an obstacle.
  bool CheckMotion(const KeyPath& path, double dx, double dy, double turn, const char* name_of_turn);
  // What an obstacle with friction drags along must be able to follow it, or its reaction is not determined.
  void CheckNodesCanFollow(const KeyPath& path, const ObstacleMotion& motion, const Obstacle& obstacle);
  void CheckStage(const KeyPath& path, std::size_t number);
  // sound: the numbers of the stage are.
  void CheckUnloading(const KeyPath& path, const Stage& stage, bool sound);
  // Nothing of a request that is not sound.
  void NoteBroughtOn(const Stage& stage);
  // Whether the loads that the load factor scales, summed by node, leave something on a free component.
  bool HasReferenceLoad(const std::vector<Load>& loads) const;

  Checker& checker_;
  const Scene& scene_;
  std::unordered_set<std::string_view> contact_nodes_;                    // candidates
  std::unordered_map<std::string_view, std::string_view> surface_nodes_;  // of surfaces that candidates may touch
  std::unordered_map<const Obstacle*, const Node*> held_;  // the first candidate of each that cannot follow it
  bool loads_are_sound_ = true;                            // as far as checked
  BroughtOn brought_on_;                                   // by the stages so far
  std::string turned_;                                     // an obstacle that they have turned, or empty
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_SCENE_LOADING_RULES_H_
