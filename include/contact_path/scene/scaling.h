// Characteristic length and force of a scene, and the scene in those units: what all solvers see.
#ifndef CONTACT_PATH_SCENE_SCALING_H_
#define CONTACT_PATH_SCENE_SCALING_H_

#include "contact_path/scene/scene.h"
#include "contact_path/scene/scene_index.h"

namespace contact_path {

// quantity of the scene = scaled quantity x scale. All are positive, change with the units as their quantities do, and
// depend neither on the order of the parts nor on rotation or reflection of the scene.
struct Scaling {
  // L: mean initial length of bars, beams, tendons and of all solids as one body, the root of its area. Without them,
  // the extent of the nodes of rigid bodies, or F / mean stiffness, times the power of 2 that brings it to the motion
  // by the loads, or to the extent of the nodes, whichever is less.
  double length = 1.0;
  // F: geometric mean of EA of bars and tendons, EI / length^2 of beams, E thickness L of the solids. Without them, of
  // rigid bodies their springs or loads; else the largest of the norms of reference load and constant loads, mean
  // stiffness x norm of the motions, and 1e-4 x mean stiffness x the smallest gap of a contact that does not touch.
  double force = 1.0;
  double load_factor = 1.0;  // LoadFactorScale
};

// Whether length and force follow from the elements alone: a bar, a beam, a solid or a tendon that can deform gives
// both.
bool HasForceScale(const Scene& scene);

// Twice the largest distance of a node from the mean of all nodes [length]. The scene must have a node.
double ExtentOfNodes(const Scene& scene);

// `scene` must be sound (validate.h). index: of the scene, here and below.
Scaling CharacteristicScales(const Scene& scene, const SceneIndex& index);
inline Scaling CharacteristicScales(const Scene& scene) { return CharacteristicScales(scene, SceneIndex(scene)); }

// F of a scene with HasForceScale(), whose loads are the constant ones and others of the size `loads` [force]. At most
// 1e3 times the larger one, so that light loads on stiff parts can be told from rounding. moves: supports or obstacles
// make forces besides; then, and with bars, which may be stressed from the start, the loads do not tell.
double ForceOfElements(const Scene& scene, const SceneIndex& index, double loads, bool moves);

// 1 / |(norm of the reference load on the free components / F, norm of the motions of supports and obstacles / L)|.
// Moments are forces times L, rotations motions over L.
double LoadFactorScale(const Scene& scene, const SceneIndex& index, double length, double force);

// `scene` in scaled units: positions over L, forces over F, stiffnesses over F / L, reference loads and motions of norm
// 1 together, summed by node. Normals of unit length. Names and order are kept.
Scene ScaleScene(const Scene& scene, const Scaling& scaling);

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_SCALING_H_
