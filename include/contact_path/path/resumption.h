// Where an earlier trace can be gone on from.
#ifndef CONTACT_PATH_PATH_RESUMPTION_H_
#define CONTACT_PATH_PATH_RESUMPTION_H_

#include <optional>
#include <vector>

#include "contact_path/path/increment.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

struct Resumption {
  const std::vector<Increment>* increments = nullptr;  // of the earlier trace
  const Increment* before = nullptr;                   // of its stage, with its state on record
  const Increment* from = nullptr;
  int events = 0;  // passed up to there
};

// The last increment that a trace can go on from; nothing: none can. increments must outlive the answer.
std::optional<Resumption> FindResumption(const std::vector<Increment>& increments);

// Throws std::invalid_argument, which names the number, for an increment that cannot belong to the request, which is
// expanded.
void RequireIncrementsOf(const TraceRequest& request, const std::vector<Increment>& increments);

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_RESUMPTION_H_
