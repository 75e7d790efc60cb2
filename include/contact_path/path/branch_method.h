// The exact path: smooth arcs between located events, the branch chosen by the dissipation rate.
#ifndef CONTACT_PATH_PATH_BRANCH_METHOD_H_
#define CONTACT_PATH_PATH_BRANCH_METHOD_H_

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "contact_path/branch/branches.h"
#include "contact_path/branch/smooth_arc.h"
#include "contact_path/branch/test_functions.h"
#include "contact_path/mpec/increment_solver.h"
#include "contact_path/mpec/ipopt_solver.h"
#include "contact_path/path/model.h"
#include "contact_path/path/path_method.h"
#include "contact_path/path/return_detector.h"

namespace contact_path {

// All lengths in the scaled norm.
struct BranchOptions {
  double step = 0.02;             // longest increment, > 0
  double smallest_step = 1e-9;    // below this the path ends, > 0
  double prediction = 1e-3;       // largest error of the predictor, relative to the increment
  double smallest_cosine = 0.98;  // between the tangents at both ends of an increment
  double direction = 1.0;         // sign of the first change of the load factor
  std::vector<BranchChoice> choices;
  bool keep_loading = false;     // at an event, rather than turn the load back, the best branch with which it goes on
  std::optional<double> target;  // load factor at which the path is to end, in an increment of its own
  int increments = 0;            // given before this path, of which it goes on
  int events = 0;                // passed before this path
  ReturnDetector* returns = nullptr;  // tells whether the path has come back to where it was; null: that is no end

  static BranchOptions For(const TraceOptions& options, Eigen::Index num_dofs);
};

// As messages name it: "event 3" or "increment 40".
std::string PlaceOf(const BranchChoice& choice);

class BranchMethod : public PathMethod {
 public:
  // model must outlive the method. cancelled may be empty.
  BranchMethod(const Model& model, const BranchOptions& options, std::function<bool()> cancelled);

  std::optional<EndReason> Start(const PathPoint& from, EventRecord* branches, std::string* message) override;
  bool Resume(const PathPoint& before, const PathPoint& from, const SolveRecord& record) override;
  // `from` must be the point that was given last.
  Advance Next(const PathPoint& from) override;
  int NumEvents() const override { return events_; }

 private:
  // A step from current_; nothing where it has to be shorter. prediction: largest error of the predictor, relative.
  std::optional<Step> TryStep(double length, double prediction);
  Arrival StartArrival() const;
  // Sets out on a branch from `point`.
  bool Leave(const PathPoint& point, const Branch& branch);
  // Finds the branches from `point` and sets out on one. Nothing: done. Otherwise why not, with *message.
  std::optional<EndReason> PassEvent(const PathPoint& point, const Arrival& arrival, const BranchChoice* choice,
                                     EventRecord* record, std::string* message);
  // The branch to take where the load is to go on: the best one, or if that turns back, the best that does not.
  std::size_t BestThatLoads(const std::vector<Branch>& branches) const;
  // An increment in which nothing moves: the reactions with which the branch begins.
  Advance ChangeReactions(const PathPoint& from);
  // Whether a branch is to be chosen farther on: then a path that comes back need not repeat.
  bool HasChoicesAhead() const;
  // Where the path comes back to an earlier increment on the step: its number, and the step ends there.
  std::optional<int> EndAtReturn(const PathPoint& from, Step* step);
  void NoteReactions(const PathPoint& point);
  const BranchChoice* ChoiceForEvent(int event) const;
  const BranchChoice* ChoiceForIncrement(int increment) const;
  Work WorkOf(const Step& step) const;
  // Where another path crosses the arc, at current_: records to go on and both directions of the crossing path, and
  // sets out on one of them. before: a point of the arc before. Nothing: done. Otherwise why not, with *message.
  std::optional<EndReason> PassBifurcation(const Eigen::VectorXd& before, const BranchChoice* choice,
                                           EventRecord* record, std::string* message);
  // Whether the load was going the other way at the end of the last arc than it goes at current_. level: of a unit rate
  // that counts as zero.
  bool TurnsLoad(const CurvePoint& arrival, double level) const;
  BranchRecord RecordOf(const Eigen::VectorXd& first) const;
  std::vector<double> CrossingPath(const Step& step);
  int StiffnessSign(const CurvePoint& point) const;

  const Model& model_;
  BranchOptions options_;
  std::function<bool()> cancelled_;
  IpoptSolver ipopt_;
  IncrementSolver mpec_;  // for events with very many contacts
  SmoothArc arc_;
  CurvePoint current_;
  std::optional<PathPoint> begin_;        // of the branch, where its reactions are not those of the event
  std::optional<Eigen::VectorXd> moved_;  // while the path rests: the direction in which it moved before
  double step_length_;
  int increments_;                 // given so far, increment 0 not counted
  int events_;                     // passed so far, starts not counted
  bool after_singular_ = false;    // the last increment is where another path crosses
  int events_in_place_ = 0;        // passed without moving
  bool at_start_ = true;           // not moved yet
  double largest_reaction_ = 0.0;  // of the points so far
  int iterations_ = 0;             // of the last step
  double contraction_ = 0.0;       // of the last step
};

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_BRANCH_METHOD_H_
