// The rules of surfaces that contact candidates touch.
#ifndef CONTACT_PATH_SRC_SCENE_BOUNDARY_RULES_H_
#define CONTACT_PATH_SRC_SCENE_BOUNDARY_RULES_H_

#include <array>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

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

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_SCENE_BOUNDARY_RULES_H_
