// Where the nodes of a scene are.
#ifndef CONTACT_PATH_SCENE_CONFIGURATION_H_
#define CONTACT_PATH_SCENE_CONFIGURATION_H_

#include <array>
#include <vector>

#include "contact_path/scene/scene.h"

namespace contact_path {

// x0, y0, x1, y1, ... by node [length].
struct Configuration {
  std::vector<double> reference;  // the shape from which elements take rest lengths and rest positions not given
  std::vector<double> start;      // at load factor 0: the places of supports, and of all nodes before any load

  std::vector<double> start_rotations;  // by node, at load factor 0, since the reference shape [rad]

  // Total law of friction: x, y by contact candidate [length], the place at load factor 0 of the point that is fixed to
  // the obstacle and was where the node is at the start of the program. Empty: incremental law.
  std::vector<double> slip_origins = {};

  bool HasTotalLaw() const { return !slip_origins.empty(); }
  // Both: the positions that the nodes of the scene have, not turned.
  static Configuration Of(const Scene& scene);
  // All positions over a length.
  Configuration Over(double length) const;
};

// The rounding of a coordinate grows with its distance from the origin: at 1e6 L, gaps are known to 1e-10 L only. A
// scene that is small beside its distance from (0, 0) is therefore traced from an origin of its own.
using Origin = std::array<double, 2>;  // x, y [length]

// (0, 0); where a node is farther from there than 1000 times the extent of the scene and L, the
// corner of the smallest rectangle around all nodes that has the least x and y. length: L.
Origin OriginOf(const Scene& scene, double length);

// The same scene, and the same configuration of its nodes, with all coordinates less those of the origin.
Scene CountedFrom(const Origin& origin, Scene scene);
Configuration CountedFrom(const Origin& origin, Configuration configuration);

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_CONFIGURATION_H_
