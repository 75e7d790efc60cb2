// Steps along an arc on which the energies agree.
#ifndef CONTACT_PATH_PATH_BALANCED_STEP_H_
#define CONTACT_PATH_PATH_BALANCED_STEP_H_

#include <optional>

#include "contact_path/branch/arc_step.h"
#include "contact_path/branch/mode_arc.h"
#include "contact_path/path/branch_options.h"
#include "contact_path/path/model.h"
#include "contact_path/path/work.h"

namespace contact_path {

struct BalancedStep {
  ArcStep at;
  Work work;
  double stored = 0.0;  // strain energy at its end [force length]
};

// The next step, of up to this length, short enough for the energies to tell, too: where only soft parts move, the load
// may change along the step by far more than what its predictor shows. stored: strain energy at its start, if known.
// Nothing: no step is accepted.
std::optional<BalancedStep> NextBalancedStep(const Model& model, const BranchOptions& options, ModeArc* arc,
                                             const CurvePoint& from, double length, const StepEnds& ends,
                                             std::optional<double> stored);

// Fills in the energies. Whether the work of the loads is what the strain energy gains and friction takes, up to a
// share that a step may be off by.
bool Balance(const Model& model, const FixedModeSystem& system, std::optional<double> stored, BalancedStep* step);

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_BALANCED_STEP_H_
