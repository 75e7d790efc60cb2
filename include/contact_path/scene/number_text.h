// Numbers as parts of messages.
#ifndef CONTACT_PATH_SCENE_NUMBER_TEXT_H_
#define CONTACT_PATH_SCENE_NUMBER_TEXT_H_

#include <string>

namespace contact_path {

// The shortest text that reads back as `value`, in YAML's spelling: ".inf", ".nan". The same whatever the locale.
std::string NumberText(double value);

// `value` in so many digits, as in 1.2e-12: for a person. The same whatever the locale.
std::string RoundedText(double value, int digits = 2);

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_NUMBER_TEXT_H_
