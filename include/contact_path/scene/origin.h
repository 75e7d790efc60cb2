// From where coordinates are counted.
#ifndef CONTACT_PATH_SCENE_ORIGIN_H_
#define CONTACT_PATH_SCENE_ORIGIN_H_

#include <array>

#include "contact_path/scene/configuration.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

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

#endif  // CONTACT_PATH_SCENE_ORIGIN_H_
