// Tendons and their eyes as the check sees them.
#ifndef CONTACT_PATH_SRC_CHECK_TENDONS_H_
#define CONTACT_PATH_SRC_CHECK_TENDONS_H_

#include <memory>
#include <vector>

#include "check/contacts.h"
#include "check/elements.h"
#include "contact_path/scene/scene.h"

namespace contact_path::check {

// Of a tendon, or a piece of one in the expanded scene: its energy where its tension is > 0, its force, and that on
// what slides. reference: places of the nodes at the start, and a rotation of 0 for each.
std::unique_ptr<const Element> MakeTendon(const Tendon& tendon, const Scene& scene, const NodeNumbers& numbers,
                                          const std::vector<double>& reference);

// Of an eye of the pieces: what keeps even the strains of a slack tendon on both sides.
std::unique_ptr<const Element> MakeEvenStrain(const ContactCandidate& eye, const Scene& scene,
                                              const NodeNumbers& numbers, const std::vector<double>& reference);

// r_n is the sum of the tensions before the eye and behind it, r_t the first less the second.
std::unique_ptr<const Contact> MakeEye(const ContactCandidate& eye, const Scene& scene, const NodeNumbers& numbers);

}  // namespace contact_path::check

#endif  // CONTACT_PATH_SRC_CHECK_TENDONS_H_
