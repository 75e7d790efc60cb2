// Text from a request as a part of a message for a person.
#ifndef CONTACT_PATH_SCENE_ONE_LINE_H_
#define CONTACT_PATH_SCENE_ONE_LINE_H_

#include <string>

namespace contact_path {

// `text` on one line and not much longer than a line: what is no UTF-8, control characters and line separators are
// shown as \xNN, byte by byte; beyond 160 bytes "..." stands for the rest.
std::string OneLine(const std::string& text);

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_ONE_LINE_H_
