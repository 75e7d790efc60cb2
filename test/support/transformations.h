// The same problem in other words: other units, another frame, another order. Its path must be the same path.
#ifndef CONTACT_PATH_TEST_SUPPORT_TRANSFORMATIONS_H_
#define CONTACT_PATH_TEST_SUPPORT_TRANSFORMATIONS_H_

#include "contact_path/path/increment.h"
#include "contact_path/scene/scene.h"
#include "support/traced_path.h"

namespace contact_path {

// In units that make every length `length` times and every force `force` times its number. The load factor stays.
TraceRequest ChangeUnits(TraceRequest request, double length, double force);
TracedPath UndoUnits(TracedPath path, double length, double force);

// Turned counter-clockwise about the origin. No node may be held along one axis only, no stop criterion look at a
// position: such a request cannot be said in the turned frame.
TraceRequest Rotate(TraceRequest request, double angle);
TracedPath UndoRotation(TracedPath path, double angle);

// Mirrored at the y axis: towards +t becomes towards -t.
TraceRequest Mirror(TraceRequest request);
TracedPath UndoMirror(TracedPath path);

// All lists backwards, and the ends of bars, beams and pins, the nodes of superelements and the elements of solids too;
// each of those begins at its next corner.
TraceRequest Reverse(TraceRequest request);
TracedPath UndoReversal(TracedPath path);

// Increment by increment: the same kinds and states, and numbers that differ by no more than `tolerance`, lengths by
// the characteristic length, forces by the characteristic force of `expected`.
void ExpectSamePath(const TracedPath& actual, const TracedPath& expected, double tolerance);

// The path of this request is the same in other units, with all lists backwards, and mirrored.
void ExpectSameInOtherWords(const TraceRequest& request, const TracedPath& path, double tolerance);

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SUPPORT_TRANSFORMATIONS_H_
