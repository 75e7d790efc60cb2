// What a person should look at where a path ends early: no cause, or those that were found.
#ifndef CONTACT_PATH_PATH_DIAGNOSIS_H_
#define CONTACT_PATH_PATH_DIAGNOSIS_H_

#include <optional>
#include <vector>

#include "contact_path/path/end.h"
#include "contact_path/path/model.h"
#include "contact_path/scene/scene.h"
#include "contact_path/scene/scene_index.h"

namespace contact_path {

// Names the bar, or what a tendon has between two nodes without rollers, that has shrunk most if that is nearly to
// nothing, where its force has no direction; else empty.
// index: of the scene. positions: current x0, y0, x1, ..., 2 x nodes [length].
Causes CollapsedPart(const Scene& scene, const SceneIndex& index, const std::vector<double>& positions);

// Where numbers end a path and an element of a solid has next to no area left at one of its integration points, it
// turns inside out: that is why. point: where no increment leads on, scaled.
void NameInvertedElement(const Model& model, const PathPoint& point, End* end);

// Names the solids whose elements are too stiff, as they have few nodes and are of a nearly incompressible material in
// plane strain; empty: none are. index: of the scene.
Causes LockingSolids(const Scene& scene, const SceneIndex& index);

// A contact at whose node all parts are softer than `least`, scaled, but not without stiffness: beside the stiff parts
// the sign of their stiffness is lost in rounding. Else empty. point: where to look, scaled.
Causes ContactTooSoft(const Model& model, const PathPoint& point, double least);

// Names a contact that is pressed onto so sharp a curve of its obstacle that rounding of the coordinates turns its
// reaction by more than equilibrium admits, or that its resistance there hides the stiffness of the parts; else empty.
// point: where to look, scaled.
Causes CurveTooSharp(const Model& model, const PathPoint& point);

// Names a contact at the edge of its friction cone that is pressed onto so sharp a curve of its obstacle that the rate
// of its slip, over that of the load, is below what counts as rest: its sign is not known, and no branch can be trusted
// there. Else empty. point: where to look, scaled.
Causes HiddenSlip(const Model& model, const PathPoint& point);

// Why the residuals of a point, with which a step ends, are too large: a curve that is too sharp, holonomic friction
// beyond half a round, a node behind its boundary, a circle that touches twice, a body or pin that is clamped.
Causes WhyRefused(const Model& model, const PathPoint& point, const Residuals& residuals);

// Names a contact with a deformable surface of which another part has come over the node while it touches, from one
// point of a path to the next; else empty.
Causes OverrunContact(const Model& model, const PathPoint& from, const PathPoint& to);

// Names a contact that stands at an end of its surface, over which no branch slides, and counts the others that do;
// else empty.
Causes StandsAtEnd(const Model& model, const PathPoint& point);

// Where a contact pulls at its node, by more than rounding and by more than a share of the largest reaction so far: it
// should have opened, and did not. The sign of its reaction is not known, where the pull is below what a step sees of a
// reaction that changes its sign. largest_reaction: of the path so far, the point included, in the force unit of the
// contact.
std::optional<End> PullingContact(const Model& model, const PathPoint& point, double largest_reaction);

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_DIAGNOSIS_H_
