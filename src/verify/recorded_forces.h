// Forces of supports, obstacles and surfaces, and what elements and contacts bear, as recorded and computed anew.
#ifndef CONTACT_PATH_SRC_VERIFY_RECORDED_FORCES_H_
#define CONTACT_PATH_SRC_VERIFY_RECORDED_FORCES_H_

#include <string>

#include "contact_path/check/residuals.h"
#include "contact_path/path/increment.h"
#include "contact_path/scene/scaling.h"

namespace contact_path {

// The first recorded section force, stress, pressure, length or width that differs; empty: none does. Lists
// that the increment has are as long as those of `anew`. motion: what rounding may move a node by [length].
std::string AnswersContradicted(const Increment& increment, const CheckedAnswers& anew, const Scaling& scaling,
                                double tolerance, double rounding, double motion);

// The first recorded component that differs from that of `anew` by more than `tolerance` of 1 + its size, and
// `rounding`, both of F, moments of F L; empty: none does. The lists are as long as those of `anew`.
std::string ForcesContradicted(const Increment& increment, const CheckedForces& anew, const Scaling& scaling,
                               double tolerance, double rounding);

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_VERIFY_RECORDED_FORCES_H_
