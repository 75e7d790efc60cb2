// Work done in one increment.
#ifndef CONTACT_PATH_PATH_WORK_H_
#define CONTACT_PATH_PATH_WORK_H_

#include "contact_path/branch/step.h"
#include "contact_path/equations/fixed_mode_system.h"
#include "contact_path/law/path_point.h"
#include "contact_path/path/model.h"

namespace contact_path {

// In scene units [force length].
struct Work {
  double friction = 0.0;  // against friction: dissipated, >= 0; by the total law given back, < 0, on the way back
  double loads = 0.0;     // of all loads, constant and scaled, and of moving supports and obstacles
  // By contacts that slide and give way by more than they slide, >= 0: part of the balance of a step.
  double given_back = 0.0;
};

// From `from` to `to` by the trapezoidal rule: second order in the increment. A contact that slips in the state of `to`
// dissipates mu r_n |du_t| with the mean of r_n; all others nothing. By the total law of friction, each does -r_t .
// du_t with the mean of r_t.
Work WorkOfIncrement(const Model& model, const PathPoint& from, const PathPoint& to);

// Of a step on an arc of the system: exact for the interpolation of the step.
Work WorkOfStep(const Model& model, const FixedModeSystem& system, const Step& step);

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_WORK_H_
