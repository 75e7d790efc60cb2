// The rules of a request: of nodes, elements and materials; of what stands for several nodes; of obstacles, contact
// candidates and the surfaces that these touch; of loads, motions and the program.
#ifndef CONTACT_PATH_SRC_SCENE_RULES_H_
#define CONTACT_PATH_SRC_SCENE_RULES_H_

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "contact_path/geometry/surface.h"
#include "contact_path/scene/boundary_curve.h"
#include "scene/checker.h"

namespace contact_path {

// All that Expand() (scene/expand.h) asks of the beams and bodies of a request.
void CheckParts(Checker* checker);

// All that Expand() asks of groups, loads and contacts. The request of the checker has expanded beams, the loads and
// contacts of the user, and num_nodes nodes that are listed.
void CheckGroups(Checker* checker);

void CheckStructure(Checker* checker);

// Whether these are the names of two nodes that are not at the same point.
void CheckTwoNodes(Checker* checker, const KeyPath& key, const std::vector<std::string>& nodes);

void CheckMaterials(Checker* checker);

// What the description of the fields does not tell. sound: the fields are. path: of the solid.
void CheckSolid(const KeyPath& path, const Solid& solid, bool sound, Checker* checker);

class BoundaryRules {
 public:
  explicit BoundaryRules(Checker* checker) : checker_(*checker), scene_(checker->GetScene()) {}

  // length: the characteristic length, 0 where it is not known.
  void CheckContact(const KeyPath& path, const ContactCandidate& contact, const Node& node,
                    const BoundarySurface& surface, double length);

 private:
  using Edge = std::pair<std::string_view, std::string_view>;  // from a node to a node

  // A surface that a contact names is judged once.
  struct Judged {
    bool sound = false;
    bool can_move = false;                 // one of its nodes can
    std::vector<Eigen::Vector2d> places;   // of its nodes
    std::array<int, 2> across = {-1, -1};  // SymmetryAxes()
    std::optional<BoundaryCurve> curve;
  };
  const Judged& Judge(const BoundarySurface& surface);
  // Whether it is a boundary.
  bool CheckEdges(const KeyPath& path, const BoundarySurface& surface);
  // Whether its curve, and that at the distance of its radius, are smooth at the start.
  bool CheckBends(const KeyPath& path, const BoundarySurface& surface);
  // Whether a node behind an open surface is deeper than its part reaches.
  bool IsAway(const Node& node, const BoundarySurface& surface, const BoundaryCurve::Foot& foot) const;
  // What is wrong with an edge of a surface, or nothing.
  std::string FaultOf(const Edge& edge) const;
  // The edges of all elements.
  void FindEdges();

  Checker& checker_;
  const Scene& scene_;
  bool edges_are_known_ = false;
  std::set<Edge> of_solids_;  // counterclockwise round the elements
  std::set<Edge> of_lines_;   // of bars and beams, in both directions
  std::unordered_map<const BoundarySurface*, Judged> judged_;
};

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
  void CheckRolling(const KeyPath& path, const ContactCandidate& contact, const Obstacle& circle,
                    const Obstacle& obstacle, double length);
  void CheckOnCurve(const KeyPath& path, const ContactCandidate& contact, const Node& node, const Obstacle& obstacle,
                    double length);

  Checker& checker_;
  const Scene& scene_;
  BoundaryRules boundaries_;
  std::unordered_set<const Obstacle*> usable_obstacles_;  // with a shape that can be computed with
  std::unordered_map<const Obstacle*, std::unique_ptr<const Surface>> surfaces_;  // of those that are no half planes
};

// What the stages of a program have brought on, summed by component: whether a stage that unloads has anything to take
// back. Takes time in proportion to what is added.
class BroughtOn {
 public:
  enum class Kind { kLoad, kSupport, kObstacle, kFriction };

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
  // A machine, and motions or changes of friction, in one stage have no one path parameter. Loading: Scene or Stage.
  template <typename Loading>
  void CheckMachine(const KeyPath& where, const Loading& of);
  void CheckFrictionChanges(const KeyPath& where, const std::vector<FrictionChange>& changes);
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

#endif  // CONTACT_PATH_SRC_SCENE_RULES_H_
