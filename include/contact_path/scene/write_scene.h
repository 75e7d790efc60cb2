// Writes a request in the form that read_scene.h reads.
#ifndef CONTACT_PATH_SCENE_WRITE_SCENE_H_
#define CONTACT_PATH_SCENE_WRITE_SCENE_H_

#include <string>

#include "contact_path/scene/scene.h"

namespace contact_path {

// YAML, one part a line, full double precision: ReadTraceRequest() of it gives the same request to the last bit. Fields
// that have their default are left out.
std::string WriteTraceRequest(const TraceRequest& request);

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_WRITE_SCENE_H_
