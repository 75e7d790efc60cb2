// Brings the constant loads on, and releases the bars whose rest length is not their initial length.
#ifndef CONTACT_PATH_PATH_PRELOAD_H_
#define CONTACT_PATH_PATH_PRELOAD_H_

#include <functional>
#include <memory>

#include "contact_path/path/end.h"
#include "contact_path/path/model.h"
#include "contact_path/path/path_method.h"

namespace contact_path {

// Makes a path method for a model on which the load factor rises to `target` (scaled).
using MethodFactory = std::function<std::unique_ptr<PathMethod>(const Model& model, double target)>;

struct Preload {
  bool done = false;
  PathPoint point;  // equilibrium at load factor 0 under the constant loads, with the friction history of getting there
  End end;          // if not done
};

// The path from the initial configuration, held by the forces that keep it there, to `model` at load factor 0: these
// forces go from 1 to 0 while the constant loads go from 0 to 1. A limit point on the way ends it: loads that are
// simply put on would jump from there. Nothing to do where both are zero. No support of `model` may move.
// cancelled is asked before every increment; may be empty.
Preload TracePreload(const Model& model, int max_increments, const MethodFactory& make_method,
                     const std::function<bool()>& cancelled = nullptr);

// The equilibrium of `model` at load factor 0 with the constant loads, before supports move: by method branch, which
// depends on the accuracy alone.
Preload TraceStart(const Model& model, Accuracy accuracy, const std::function<bool()>& cancelled);

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_PRELOAD_H_
