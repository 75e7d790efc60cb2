// Whether what a record says of events and of the signs of determinants is what its increments show.
#ifndef CONTACT_PATH_VERIFY_VERIFY_EVENTS_H_
#define CONTACT_PATH_VERIFY_VERIFY_EVENTS_H_

#include <vector>

#include "contact_path/path/increment.h"
#include "contact_path/scene/scene.h"
#include "contact_path/verify/verify_path.h"

namespace contact_path {

// Appends to *findings, in the order of the increments, which VerifyPath() must have found sound:
// - each increment is of the method that the request wants; mpec records no events;
// - events are numbered from 1 without a gap, and only increments that branch_choices names have branches without a
//   number;
// - branches stand in the order of their dissipation rates, with rates and angles that unit directions can have, and
//   leave open what is open; from a start, their load rates are the cosines of their angles;
// - the branch taken is the one that branch_choices wants, or the first, and its rates and its angle are those of the
//   increments before and after, to what an increment may turn;
// - the sign of the determinant changes on an arc at bifurcations alone, and there is one relation between it, the sign
//   of the stiffness and the sense of the load on all of an arc.
// stiffest: by stage, the force of the stiffest node for a motion of L, over F: the load is known to its rounding.
void VerifyEvents(const TraceRequest& request, const std::vector<Increment>& increments,
                  const std::vector<double>& stiffest, std::vector<Finding>* findings);

}  // namespace contact_path

#endif  // CONTACT_PATH_VERIFY_VERIFY_EVENTS_H_
