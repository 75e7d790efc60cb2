// The boundaries of the rigid obstacles of a scene.
#ifndef CONTACT_PATH_SCENE_SURFACE_H_
#define CONTACT_PATH_SCENE_SURFACE_H_

#include <memory>
#include <string>
#include <string_view>

#include "contact_path/geometry/surface.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

// What does not fit the shape of its obstacle.
struct ShapeFault {
  std::string_view field;  // of the obstacle; empty: there is no fault
  std::string rule;        // what must hold
  std::string value;       // that breaks it
};

// Of numbers that keep the rules of their fields.
ShapeFault FindShapeFault(const Obstacle& obstacle);

// The surface of an obstacle without a fault. An obstacle is placed by its point (px, py). A surface that is not flat
// has a finite length, so that it can be drawn.
std::unique_ptr<const Surface> MakeSurface(const Obstacle& obstacle);

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_SURFACE_H_
