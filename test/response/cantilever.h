// A cantilever under a force at its tip.
#ifndef CONTACT_PATH_TEST_RESPONSE_CANTILEVER_H_
#define CONTACT_PATH_TEST_RESPONSE_CANTILEVER_H_

#include "contact_path/scene/scene.h"
#include "support/beams.h"

namespace contact_path {

// From (1, 2), where it is clamped, to its tip, which bears (0.3 s, -s) up to s = 1.5.
inline TraceRequest Cantilever(const Node& tip) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.nodes = {{"root", 1.0, 2.0, true, true, true}, tip};
  scene.beams = {Between("arm", "root", tip.name, 1e3, 3.0, 0)};  // segments by default
  scene.loads = {{tip.name, 0.3, -1.0}};
  request.options.stop = {{"load_factor", ">", 1.5}};
  return request;
}

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_RESPONSE_CANTILEVER_H_
