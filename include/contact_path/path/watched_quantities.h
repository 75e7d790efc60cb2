// The quantities at whose values a request wants increments.
#ifndef CONTACT_PATH_PATH_WATCHED_QUANTITIES_H_
#define CONTACT_PATH_PATH_WATCHED_QUANTITIES_H_

#include "contact_path/branch/arc_target.h"
#include "contact_path/equations/fixed_mode_system.h"
#include "contact_path/path/machine_setting.h"
#include "contact_path/path/model.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

// Of options.at, of the exact criteria of options.stop, and where the scene ends (path/scene_end.h); scaled by the
// unit of each quantity. model: of a stage of the request, from 0; setting: of its machine; system: of the arcs. All
// must outlive the result.
ArcTargets WatchedQuantities(const Model& model, const TraceRequest& request, std::size_t stage,
                             const MachineSetting& setting, const FixedModeSystem& system);

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_WATCHED_QUANTITIES_H_
