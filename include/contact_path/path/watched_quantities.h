// The values at which steps of a path end: those that a request asks for, and where the scene itself comes to an end.
#ifndef CONTACT_PATH_PATH_WATCHED_QUANTITIES_H_
#define CONTACT_PATH_PATH_WATCHED_QUANTITIES_H_

#include <cstddef>
#include <optional>
#include <vector>

#include "contact_path/branch/arc_target.h"
#include "contact_path/equations/fixed_mode_system.h"
#include "contact_path/law/path_point.h"
#include "contact_path/path/end.h"
#include "contact_path/path/machine_limit.h"
#include "contact_path/path/model.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

struct SceneEnd {
  ArcTarget target;  // of (u, s), scaled; one value
  double beyond;     // sign of the way beyond the value
  Cause cause;
};

// Paths end where a coefficient of friction has fallen to 1e-6 of that at the load factor 0 of the stage: where nothing
// is left, contacts that stick have no equations of their own. For these load factors, the nearest one on either side
// of 0.
// They end where the angle by which a tendon is wrapped round a roller has fallen to nothing, or that by which a drum
// is wound: beyond, the string would be pushed by the roller from inside; where a roller with friction that turns has
// carried along what was the middle of the arc at the start to an end of it; and before a piece of a tendon between
// unequal rollers has turned by half a turn since the start, where its angle is no longer known.
std::vector<SceneEnd> SceneEnds(const Model& model);

// Why a path ends at the point; nothing: it may go on.
std::optional<Cause> EndOfScene(const Model& model, const PathPoint& point);

// Of options.at, of the exact criteria of options.stop, and SceneEnds(); scaled by the
// unit of each quantity. model: of a stage of the request, from 0; setting: of its machine; system: of the arcs. All
// must outlive the result.
ArcTargets WatchedQuantities(const Model& model, const TraceRequest& request, std::size_t stage,
                             const MachineSetting& setting, const FixedModeSystem& system);

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_WATCHED_QUANTITIES_H_
