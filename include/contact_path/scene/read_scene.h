// Requests as YAML: read from scene files, and written as such.
#ifndef CONTACT_PATH_SCENE_READ_SCENE_H_
#define CONTACT_PATH_SCENE_READ_SCENE_H_

#include <string>

#include "contact_path/scene/scene.h"

namespace contact_path {

// The request in `text`, validated. A key that is missing or null has its default. `file_name` is used in messages
// only. Throws InvalidRequest: not YAML, unknown or repeated keys, values of the wrong type, or any rule of Validate().
TraceRequest ReadTraceRequest(const std::string& text, const std::string& file_name);

// The same from a file. Throws InvalidRequest also where the file cannot be read.
TraceRequest ReadTraceRequestFile(const std::string& path);

// YAML, one part a line, full double precision: ReadTraceRequest() of it gives the same request to the last bit. Fields
// that have their default are left out.
std::string WriteTraceRequest(const TraceRequest& request);

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_READ_SCENE_H_
