// How a path leaves a point at which branches part.
#ifndef CONTACT_PATH_PATH_DEPARTURE_H_
#define CONTACT_PATH_PATH_DEPARTURE_H_

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "contact_path/branch/branches.h"
#include "contact_path/branch/mode_arc.h"
#include "contact_path/branch/path_parameter.h"
#include "contact_path/law/active_set_tolerance.h"
#include "contact_path/law/path_point.h"
#include "contact_path/path/branch_options.h"
#include "contact_path/path/end.h"
#include "contact_path/path/increment.h"
#include "contact_path/path/model.h"
#include "contact_path/path/return_detector.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

// Adds what an event has on record of these branches.
void RecordBranches(const Model& model, const std::vector<Branch>& branches, EventRecord* record);

// Index of the branch that was chosen, or else of the preferred one; nothing, and *end, where there is no such branch.
std::optional<std::size_t> ChosenOf(const std::vector<Branch>& branches, const BranchChoice* choice,
                                    std::size_t preferred, End* end);

class Departure {
 public:
  // model and options must outlive the departure. cancelled may be empty.
  Departure(const Model& model, const BranchOptions& options, const PathParameter& parameter,
            std::function<bool()> cancelled);

  // Takes the reactions of a point of the path into account: the tolerances of active sets follow the largest.
  void NoteReactions(const PathPoint& point);
  ActiveSetTolerance ToleranceAt(const PathPoint& point) const;

  // That of a path that begins.
  Arrival StartArrival() const;
  // Finds the branches from `point`, an equilibrium, and puts *arc and *current, with which the path arrives there,
  // where it sets out on one of them: on the one chosen, or the best. Nothing: done. Otherwise the path ends.
  std::optional<End> Leave(const PathPoint& point, Arrival arrival, const BranchChoice* choice, ModeArc* arc,
                           CurvePoint* current, EventRecord* record);

  // Whether the branch that was taken last begins with other reactions than the point has, and these, once.
  bool ChangesReactions() const { return begin_.has_value(); }
  // Nothing of the path so far counts for a path that begins anew.
  void Restart() {
    begin_.reset();
    moved_.reset();
  }
  PathPoint TakeBegin() { return *std::exchange(begin_, std::nullopt); }
  // Whether a branch that was taken could have other reactions.
  bool other_reactions() const { return other_reactions_; }
  // StandsAtEnd() of the first start or event at which a contact did, and the path went on; else empty.
  const Causes& AtEnds() const { return at_ends_; }

 private:
  bool SetOut(const PathPoint& point, const Branch& branch, ModeArc* arc, CurvePoint* current) const;

  const Model& model_;
  const BranchOptions& options_;
  const PathParameter parameter_;
  std::function<bool()> cancelled_;
  std::optional<PathPoint> begin_;
  std::optional<Eigen::VectorXd> moved_;  // while the path rests: the direction in which it moved before
  bool other_reactions_ = false;
  Causes at_ends_;
  LargestReactionSoFar own_;  // where the options have none
  LargestReactionSoFar* const largest_reaction_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_DEPARTURE_H_
