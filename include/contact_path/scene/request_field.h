// A field of a request by its path, as studies name it: "obstacles.floor.friction", "bars.0.EA", "options.step".
#ifndef CONTACT_PATH_SCENE_REQUEST_FIELD_H_
#define CONTACT_PATH_SCENE_REQUEST_FIELD_H_

#include <string>
#include <string_view>

#include "contact_path/scene/scene.h"

namespace contact_path {

// A path is made of words between points. It begins with a field of the scene, with "options" or with "program"; then
// follow fields of parts, and elements of lists: by the name of the part, or by their place, from 0.

struct FoundField {
  std::string key;        // the same for all paths to a field: "scene.bars[0].EA"
  std::string_view kind;  // "number", "integer", "truth", or "text": a word of an enumeration, too
};

// Throws std::invalid_argument where the request has no such value; what() is what the path must do, with the nearest
// name.
FoundField FindField(std::string_view path, const TraceRequest& request);

// Gives the field a value as it is written in a scene file, text without quotes. `request` is not validated again.
// Throws std::invalid_argument as FindField(), and where `value` is not of the field's type.
void SetField(std::string_view path, const std::string& value, TraceRequest* request);

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_REQUEST_FIELD_H_
