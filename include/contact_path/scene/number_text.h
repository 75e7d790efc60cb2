// A number of a request as a part of a message for a person.
#ifndef CONTACT_PATH_SCENE_NUMBER_TEXT_H_
#define CONTACT_PATH_SCENE_NUMBER_TEXT_H_

#include <string>

namespace contact_path {

// The shortest text that reads back as `value`, in YAML's spelling: ".inf", ".nan". The same whatever the locale.
std::string NumberText(double value);

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_NUMBER_TEXT_H_
