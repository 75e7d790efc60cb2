// The increment length of scenes of many degrees of freedom.
#ifndef CONTACT_PATH_PATH_AUTOMATIC_STEP_H_
#define CONTACT_PATH_PATH_AUTOMATIC_STEP_H_

#include "contact_path/path/model.h"

namespace contact_path {

// Factor on the length of a preset. Arc length is a sum over all components: where all of them move alike, it grows
// with the root of their number. Beyond a hundred of them a node moves as far in an increment as it does among a
// hundred. The inner nodes of a beam move with it: they count together as one node, so that increments do not depend on
// the number of segments.
double AutomaticStepGrowth(const Model& model);

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_AUTOMATIC_STEP_H_
