// The largest reaction so far, by which tolerances of reactions are measured.
#ifndef CONTACT_PATH_PATH_LARGEST_REACTION_H_
#define CONTACT_PATH_PATH_LARGEST_REACTION_H_

#include <algorithm>

#include "contact_path/contact/contact_pair.h"
#include "contact_path/law/path_point.h"

namespace contact_path {

// Of all |r_n| and |r_t| of the points noted, in the force unit of each contact.
struct LargestReactionSoFar {
  double of_trace = 0.0;
  double of_stage = 0.0;  // set to 0 where a stage begins

  void Note(const Laws& laws, const PathPoint& point) {
    of_stage = std::max(of_stage, laws.LargestForce(point));
    of_trace = std::max(of_trace, of_stage);
  }
};

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_LARGEST_REACTION_H_
