// What the rules of a request take for a number that was meant: the bounds of inputs, and what counts as zero.
#ifndef CONTACT_PATH_SRC_SCENE_INPUT_BOUNDS_H_
#define CONTACT_PATH_SRC_SCENE_INPUT_BOUNDS_H_

#include <cstddef>

#include "contact_path/scene/scene.h"

namespace contact_path {

// Within these bounds no product or quotient that is formed of two inputs leaves the range of double.
constexpr double kLargestInput = 1e100;
constexpr double kSmallestInput = 1e-100;  // of what must be positive

// What is left of numbers that cancel, relative to these numbers, or an angle [rad]: zero but for rounding. Far above
// rounding and far below anything meant.
constexpr double kCancelled = 1e-12;

// What inputs may be off by because they were written with few digits, relative to the largest of them; a gap, to the
// characteristic length. Far above rounding and far below anything meant, too.
constexpr double kWrittenRounding = 1e-9;

// Of a gap at the start, in a scene of this characteristic length; 0: not known.
inline bool Refuses(const ContactCandidate& contact, double gap, double length) {
  return contact.overlap == Overlap::kRefuse && length > 0.0 && gap < -kWrittenRounding * length;
}

// The most unknowns that may move the nodes of one tendon: kMostLawDofs (structure/local_vector.h).
constexpr std::size_t kMostTendonUnknowns = 12;

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_SCENE_INPUT_BOUNDS_H_
