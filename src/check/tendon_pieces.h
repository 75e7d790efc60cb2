// The pieces of a tendon with friction and its eyes as the check sees them.
#ifndef CONTACT_PATH_SRC_CHECK_TENDON_PIECES_H_
#define CONTACT_PATH_SRC_CHECK_TENDON_PIECES_H_

#include <memory>
#include <vector>

#include "check/contacts.h"
#include "check/elements.h"
#include "contact_path/scene/scene.h"

namespace contact_path::check {

// scene: expanded. The energy of the piece where its tension is > 0, its force, and that on what slides.
std::unique_ptr<const Element> MakePiece(const Tendon& piece, const Scene& scene, const NodeNumbers& numbers);

// Of an eye of the pieces: what keeps even the strains of a slack tendon on both sides.
std::unique_ptr<const Element> MakeEvenStrain(const ContactCandidate& eye, const Scene& scene,
                                              const NodeNumbers& numbers);

// r_n is the sum of the tensions before the eye and behind it, r_t the first less the second.
std::unique_ptr<const Contact> MakeEye(const ContactCandidate& eye, const Scene& scene, const NodeNumbers& numbers);

}  // namespace contact_path::check

#endif  // CONTACT_PATH_SRC_CHECK_TENDON_PIECES_H_
