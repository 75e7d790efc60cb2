// The stages of a load program as scenes of their own.
#ifndef CONTACT_PATH_SCENE_PROGRAM_H_
#define CONTACT_PATH_SCENE_PROGRAM_H_

#include <cstddef>
#include <vector>

#include "contact_path/scene/configuration.h"
#include "contact_path/scene/scaling.h"
#include "contact_path/scene/scene.h"
#include "contact_path/scene/scene_index.h"

namespace contact_path {

// `request` must be sound (validate.h) and have the stage; `index` is of its scene.

// At least 1: a request without a program is one stage.
std::size_t NumStages(const TraceRequest& request);

// A stage of the program with its loads and motions per unit of its load factor. A stage that unloads has
// the loads and motions that the stages before have left, with the opposite sign: one load for each load of these
// stages, one motion for each support and obstacle.
Stage StageAsTraced(const TraceRequest& request, std::size_t stage);

// The scene of a stage, from 0, at whose load factor 0 all stages before have come to their targets: their loads are
// constant, their obstacles are where they were moved to. Without a program: the scene of the request.
Scene StageScene(const TraceRequest& request, const SceneIndex& index, std::size_t stage);
inline Scene StageScene(const TraceRequest& request, std::size_t stage) {
  return StageScene(request, SceneIndex(request.scene), stage);
}
// The shape of the scene, and its start in a stage: supports are where the stages before have moved them, and so are
// the points of obstacles from which the total law of friction measures slip.
Configuration StageConfiguration(const TraceRequest& request, const SceneIndex& index, std::size_t stage);
inline Configuration StageConfiguration(const TraceRequest& request, std::size_t stage) {
  return StageConfiguration(request, SceneIndex(request.scene), stage);
}

// The obstacles of a scene, which may be that of a stage, where they are at a load factor. index: of the scene.
std::vector<Obstacle> ObstaclesAt(const Scene& scene, const SceneIndex& index, double load_factor);
// Where the point p of an obstacle is at a load factor of a stage, from 0, and how far the obstacle has turned since
// the start [rad].
struct ObstaclePlace {
  double x = 0.0;
  double y = 0.0;
  double turn = 0.0;
};
ObstaclePlace PlaceOf(const TraceRequest& request, const Obstacle& obstacle, std::size_t stage, double load_factor);

// One length and one force for all stages, so that points can be handed on. A scene with bars, beams or solids gives
// both. Of beams alone the force is no less than a tenth of the sum of the loads of any stage at its target. Of linear
// parts alone the stage with the largest force at its target gives both.
Scaling ProgramScales(const TraceRequest& request, const SceneIndex& index);
inline Scaling ProgramScales(const TraceRequest& request) { return ProgramScales(request, SceneIndex(request.scene)); }

// These, with the scale of the load factor of one stage. of_program: ProgramScales(request, index).
Scaling StageScales(const TraceRequest& request, const SceneIndex& index, std::size_t stage, const Scaling& of_program);
Scaling StageScales(const TraceRequest& request, std::size_t stage);

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_PROGRAM_H_
