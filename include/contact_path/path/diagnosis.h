// What a person should look at where a path ends early.
#ifndef CONTACT_PATH_PATH_DIAGNOSIS_H_
#define CONTACT_PATH_PATH_DIAGNOSIS_H_

#include <string>
#include <vector>

#include "contact_path/path/model.h"
#include "contact_path/scene/scene.h"
#include "contact_path/scene/scene_index.h"

namespace contact_path {

// The text, and what explains it, if anything does.
inline std::string After(const std::string& text, const std::string& why) {
  return why.empty() ? text : text + "; " + why;
}

// Names the bar that has shrunk most if that is nearly to nothing, where its force has no direction; else empty.
// index: of the scene. positions: current x0, y0, x1, ..., 2 x nodes [length].
std::string CollapsedBar(const Scene& scene, const SceneIndex& index, const std::vector<double>& positions);

// Tells that points of the path are known no better than this [length].
std::string MovedByRounding(double distance);

// Names the element of a solid whose area has shrunk most at one of its integration points, if that is nearly to
// nothing, where it turns inside out; else empty. The same arguments.
std::string InvertedElement(const Scene& scene, const SceneIndex& index, const std::vector<double>& positions);

// Names the solids whose elements are too stiff, as they have few nodes and are of a nearly incompressible material in
// plane strain; empty: none are. index: of the scene.
std::string LockingSolids(const Scene& scene, const SceneIndex& index);

// Names the most slender beam, where it is so stiff along its axis that its bending drowns in rounding; else empty.
std::string SlenderBeam(const Scene& scene, const SceneIndex& index);

// Names a contact at whose node all parts are softer than `least`, scaled, but not without stiffness: its reactions
// drown in the rounding of the stiff parts; else empty. point: where to look, scaled.
std::string ContactTooSoft(const Model& model, const PathPoint& point, double least);

// Names a contact that is pressed onto so sharp a curve of its obstacle that rounding of the coordinates turns its
// reaction by more than equilibrium admits, or that its resistance there hides the stiffness of the parts; else empty.
// point: where to look, scaled.
std::string CurveTooSharp(const Model& model, const PathPoint& point);

// Names a contact at the edge of its friction cone that is pressed onto so sharp a curve of its obstacle that the rate
// of its slip is below what counts as rest, in either direction: no branch can be trusted there. Else empty. point:
// where to look, scaled.
std::string HiddenSlip(const Model& model, const PathPoint& point);

// Why a point breaks the total law of friction on a closed obstacle: check/ measures slip along the shorter way round,
// so that slip changes its sign beyond half a round. Empty where this cannot be the reason.
std::string BeyondHalfRound(const Model& model, const Residuals& residuals);

// Names a contact with a deformable surface of which another part has come over the node while it touches, from one
// point of a path to the next; else empty.
std::string OverrunContact(const Model& model, const PathPoint& from, const PathPoint& to);

// Names a contact that stands at an end of its surface, over which no branch slides, and counts the others that do;
// else empty.
std::string StandsAtEnd(const Model& model, const PathPoint& point);

// Names an open contact whose node has come past an end of its deformable surface and is behind the surface; else
// empty. point: where to look, scaled.
std::string BehindSurface(const Model& model, const PathPoint& point);

// Names a contact that pulls at its node, by more than rounding and by more than a share of the largest reaction so
// far: it should have opened, and did not since its reactions are too small beside the characteristic force; else
// empty. rounding: of the reactions of the point. largest_reaction: r_n so far, at the point included. Both scaled,
// over the force unit of the contact.
std::string PullingContact(const Model& model, const PathPoint& point, double rounding, double largest_reaction);

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_DIAGNOSIS_H_
