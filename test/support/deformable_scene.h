// A small scene with contacts with a deformable surface, for the tests of assembly and derivatives.
#ifndef CONTACT_PATH_TEST_SUPPORT_DEFORMABLE_SCENE_H_
#define CONTACT_PATH_TEST_SUPPORT_DEFORMABLE_SCENE_H_

#include "contact_path/scene/scene.h"

namespace contact_path {

// A chain of bars from p0 to p4, both fixed, p2 held along x, is the surface `skin` with a radius. Above it hang a and
// b. Free components p1.x, p1.y, p2.y, p3.x, p3.y, a.x, a.y, b.x, b.y, in this order. Contacts: a@skin, frictional, and
// b@skin, frictionless, with gaps between 0.2 and 0.5.
inline Scene DeformableScene() {
  Scene scene;
  scene.name = "deformable";
  scene.nodes = {{"p0", 0.0, 0.0, true, true},    {"p1", 0.5, 0.1, false, false}, {"p2", 1.0, 0.0, true, false},
                 {"p3", 1.6, 0.15, false, false}, {"p4", 2.1, 0.0, true, true},   {"q", 1.1, 1.4, true, true},
                 {"a", 0.9, 0.4, false, false},   {"b", 1.4, 0.5, false, false}};
  scene.bars = {{{"p0", "p1"}, 1.3}, {{"p1", "p2"}, 0.8}, {{"p2", "p3"}, 1.1}, {{"p3", "p4"}, 0.9}, {{"p1", "q"}, 0.6},
                {{"p3", "q"}, 0.7},  {{"a", "q"}, 1.0},   {{"b", "q"}, 1.2},   {{"a", "b"}, 0.5},   {{"p2", "q"}, 0.4}};
  scene.loads = {{"a", 0.3, -1.0, false}, {"b", 0.1, -0.5, false}, {"p2", 0.0, 0.2, true}};
  scene.surfaces = {{"skin", {"p0", "p1", "p2", "p3", "p4"}, false, 0.05}};
  scene.contacts = {{"a", "", "", "skin", 0.3}, {"b", "", "", "skin", 0.0}};
  return scene;
}

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SUPPORT_DEFORMABLE_SCENE_H_
