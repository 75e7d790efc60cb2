// A small scene with every kind of part, for the tests of assembly and derivatives.
#ifndef CONTACT_PATH_TEST_SUPPORT_MIXED_SCENE_H_
#define CONTACT_PATH_TEST_SUPPORT_MIXED_SCENE_H_

#include "contact_path/scene/scene.h"

namespace contact_path {

// Five nodes of which one is fixed, one held along x and one along y: free components b.x, b.y, c.y, d.x, d.y, e.x, in
// this order. Bars of all three strains, superelements of one and of two nodes, scaled and constant loads, obstacles
// that are slanted and not normalised. Nothing touches at the start. Contacts, in order:
//   b@slope   frictional, both components of b
//   b@wall    frictionless, both components of b
//   c@slope   frictional, c slides along y only
//   d@ceiling frictional, n = (0, -1)
//   e@slope   frictional, e slides along x only
//   c@floor   the floor is rough, but c cannot move along it: frictionless
inline Scene MixedScene() {
  Scene scene;
  scene.name = "mixed";
  scene.nodes = {{"a", 0.0, 0.1, true, true},
                 {"b", 1.1, 0.3, false, false},
                 {"c", 1.4, 1.2, true, false},
                 {"d", 0.2, 1.3, false, false},
                 {"e", 0.7, 0.9, false, true}};
  scene.bars = {{{"a", "b"}, 1.3, 0.0, StrainMeasure::kBiot},
                {{"b", "c"}, 0.8, 1.1, StrainMeasure::kGreenLagrange},
                {{"d", "c"}, 1.7, 0.0, StrainMeasure::kLogarithmic},
                {{"e", "a"}, 0.9, 1.0, StrainMeasure::kBiot},
                {{"d", "e"}, 1.1, 0.6, StrainMeasure::kLogarithmic}};
  scene.superelements = {{{"d", "a"},
                          {4.0, 1.0, -2.0, 0.5,  //
                           1.0, 3.0, 0.3, -1.0,  //
                           -2.0, 0.3, 5.0, 0.7,  //
                           0.5, -1.0, 0.7, 2.0}},
                         {{"b"}, {1.0, -0.5, -0.5, 2.0}}};
  scene.loads = {{"b", 0.3, -0.2, false}, {"d", 0.1, 0.0, true}, {"b", 0.2, 0.0, false}, {"c", 5.0, 0.7, true}};
  scene.obstacles = {{"slope", ObstacleShape::kHalfPlane, 0.0, -0.6, 3.0, 4.0, 0.3},
                     {"wall", ObstacleShape::kHalfPlane, 1.9, 0.0, -2.0, 0.5, 0.0},
                     {"ceiling", ObstacleShape::kHalfPlane, 0.0, 1.8, 0.0, -1.0, 0.6},
                     {"floor", ObstacleShape::kHalfPlane, 0.0, -0.2, 0.0, 1.0, 0.4}};
  scene.contacts = {{"b", "slope"}, {"b", "wall"}, {"c", "slope"}, {"d", "ceiling"}, {"e", "slope"}, {"c", "floor"}};
  return scene;
}

// The same with a support and three obstacles that move: free components a.x, a.y, and those above.
inline Scene MovingScene() {
  Scene scene = MixedScene();
  scene.support_motions = {{"a", 0.3, -0.2}};
  scene.obstacle_motions = {{"slope", 0.4, 0.1}, {"wall", -0.2, 0.3}, {"ceiling", 0.5, 0.0}};
  return scene;
}

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SUPPORT_MIXED_SCENE_H_
