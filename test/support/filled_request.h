// A request of which every field that is described (scene/field.h) has a value of its own.
#ifndef CONTACT_PATH_TEST_SUPPORT_FILLED_REQUEST_H_
#define CONTACT_PATH_TEST_SUPPORT_FILLED_REQUEST_H_

#include "contact_path/scene/scene.h"

namespace contact_path {

// Each list has two parts or values, each number and text is unlike all others, each word is unlike its default. Such a
// request keeps no rule: what reads it must not look at them.
TraceRequest FilledRequest();

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SUPPORT_FILLED_REQUEST_H_
