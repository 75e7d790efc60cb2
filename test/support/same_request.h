// Whether two requests are the same.
#ifndef CONTACT_PATH_TEST_SUPPORT_SAME_REQUEST_H_
#define CONTACT_PATH_TEST_SUPPORT_SAME_REQUEST_H_

#include <string>

#include "contact_path/scene/scene.h"

namespace contact_path {

// The first field in which they differ, e.g. "scene.bars[0].EA"; empty: none. Numbers are the same to the last bit, but
// 0 is -0 and no number is no number; the target of a stage is what it stands for.
std::string FirstDifference(const TraceRequest& a, const TraceRequest& b);

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SUPPORT_SAME_REQUEST_H_
