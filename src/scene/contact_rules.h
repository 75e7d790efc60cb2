// The rules of obstacles, contact candidates, and the surfaces that these touch.
#ifndef CONTACT_PATH_SRC_SCENE_CONTACT_RULES_H_
#define CONTACT_PATH_SRC_SCENE_CONTACT_RULES_H_

#include <array>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "contact_path/geometry/surface.h"
#include "contact_path/scene/boundary_curve.h"
#include "scene/checker.h"

namespace contact_path {

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
