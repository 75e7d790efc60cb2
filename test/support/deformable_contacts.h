// Nodes against deformable boundaries, for the tests of everything that is derived from gap and xi.
#ifndef CONTACT_PATH_TEST_SUPPORT_DEFORMABLE_CONTACTS_H_
#define CONTACT_PATH_TEST_SUPPORT_DEFORMABLE_CONTACTS_H_

#include <Eigen/Core>
#include <memory>
#include <utility>
#include <vector>

#include "contact_path/contact/deformable_pair.h"

namespace contact_path {

// A boundary of `count` nodes, open along the x axis or closed around the origin, clockwise so that its outside is
// admissible, and a node beside it. Dofs: those of the nodes in turn, then those of the node beside.
struct DeformableContact {
  DeformableContact(int count, bool closed, double radius, double friction = 0.3, bool hold_some = false) {
    std::vector<NodePlace> nodes;
    std::vector<Eigen::Vector2d> start;
    int dofs = 0;
    const auto place = [&](const Eigen::Vector2d& at, bool held) {
      NodePlace node = {{held ? -1 : dofs, held ? -1 : dofs + 1}, at};
      if (!held) dofs += 2;
      start.push_back(at);
      return node;
    };
    for (int i = 0; i < count; ++i) {
      const double angle = 6.283185307179586 * i / count;
      const Eigen::Vector2d at = closed ? Eigen::Vector2d(std::sin(angle), 0.8 * std::cos(angle))
                                        : Eigen::Vector2d(0.6 * i + 0.05 * (i % 2), 0.1 * (i % 3));
      nodes.push_back(place(at, hold_some && i == 1));
    }
    const std::vector<Eigen::Vector2d> of_boundary = start;
    const NodePlace beside = place({0.3, 1.3}, false);
    boundary = std::make_shared<DeformableBoundary>(std::move(nodes), of_boundary, closed, radius);
    pair = std::make_unique<DeformablePair>(boundary, AdmissiblePatches(boundary->Spline()), beside, friction);
    u = Eigen::VectorXd::Zero(dofs);
    std::size_t node = 0;
    for (const NodePlace& of : boundary->Nodes()) {
      if (of.dofs[0] >= 0) u.segment<2>(of.dofs[0]) = of_boundary[node];
      ++node;
    }
    u.tail<2>() = start.back();
  }
  // With all its patches.
  BoundaryAt Shape() const { return {*boundary, u, AdmissiblePatches(boundary->Spline())}; }
  // Puts the node beside a patch, at a share of its length and at a distance from the surface.
  void PutBeside(int patch, double share, double gap) {
    const BoundaryAt at = Shape();
    const XiRange range = at.RangeOf(patch);
    const Eigen::Vector2d foot = at.PointAt(range.begin + share * (range.end - range.begin));
    const Eigen::Vector2d normal = at.Project(foot, patch).normal;
    u.tail<2>() = foot + (gap + boundary->Radius()) * normal;
  }

  std::shared_ptr<const DeformableBoundary> boundary;
  std::unique_ptr<const DeformablePair> pair;
  Eigen::VectorXd u;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SUPPORT_DEFORMABLE_CONTACTS_H_
