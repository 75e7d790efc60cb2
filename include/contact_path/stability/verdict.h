// What is known about the stability of an equilibrium.
#ifndef CONTACT_PATH_STABILITY_VERDICT_H_
#define CONTACT_PATH_STABILITY_VERDICT_H_

#include "contact_path/scene/words.h"

namespace contact_path {

enum class Verdict {
  kNotAsked,
  // No disturbance grows by divergence, whatever the masses and dampings of the contact nodes are, if the others follow
  // at once.
  kStable,
  kUnstable,   // some disturbance grows, whatever all masses and dampings are
  kNotProved,  // neither was shown
};
constexpr auto WordsOf(Verdict) { return WordList("", "stable", "unstable", "not_proved"); }

}  // namespace contact_path

#endif  // CONTACT_PATH_STABILITY_VERDICT_H_
