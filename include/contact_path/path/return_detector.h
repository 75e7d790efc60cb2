// What is remembered of a path: its largest reaction, by which tolerances of reactions are measured, and increments
// that tell whether it has come back to where it was: from there on it repeats.
#ifndef CONTACT_PATH_PATH_RETURN_DETECTOR_H_
#define CONTACT_PATH_PATH_RETURN_DETECTOR_H_

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <vector>

#include "contact_path/branch/mode_arc.h"
#include "contact_path/law/laws.h"
#include "contact_path/law/path_point.h"
#include "contact_path/path/end.h"
#include "contact_path/path/model.h"

namespace contact_path {

// Of all |r_n| and |r_t| of the points noted, in the force unit of each contact.
struct LargestReactionSoFar {
  double of_trace = 0.0;
  double of_stage = 0.0;  // set to 0 where a stage begins

  void Note(const Laws& laws, const PathPoint& point) {
    of_stage = std::max(of_stage, laws.LargestForce(point));
    of_trace = std::max(of_trace, of_stage);
  }
};

// Positions, load factor, reactions and contact states make up the whole state: friction remembers only where contacts
// stick, which the positions tell. A path that meets an earlier point again, in the same direction, therefore repeats
// for ever. The path need not hit an increment again: it crosses the plane through it.
// It remembers some increments of a stage, evenly spread, at most 32 of them. A closed path is so found at most a
// sixteenth of its length after it has been once round.
class ReturnDetector {
 public:
  struct Return {
    int increment = 0;  // that the path came back to
    PathPoint point;    // of the path, scaled: to rounding the point of that increment
  };

  // model and largest_reaction must outlive the test. every: only increments whose index is a multiple of it are
  // remembered, > 0. largest_reaction: of_stage measures reactions that agree.
  ReturnDetector(const Model& model, int every, const LargestReactionSoFar& largest_reaction);

  // The next increment of the stage, which ends in `to`, and the point before.
  void Add(int increment, const PathPoint& from, const PathPoint& to);

  // The first return between two points on the same arc, the later one with its states. Not before there is proof:
  // positions and load factor agree to 1e-9 of the extent of the path, reactions to 1e-9 of the largest so far, the
  // contact states are equal, and the directions agree to 1e-6.
  std::optional<Return> Find(const PathPoint& from, const PathPoint& to);

 private:
  struct Reference {
    int increment;
    PathPoint point;
    Eigen::VectorXd direction;  // of the increment that ends there: unit chord in (u, s)
  };
  // Where the path crosses the plane through the reference between the two points; nothing where it does not.
  std::optional<PathPoint> CrossingOf(const Reference& reference, const PathPoint& from, const PathPoint& to);
  bool IsSame(const PathPoint& a, const PathPoint& b) const;
  // Unit tangent of the path at a point with its states, along `towards`; empty where there is none.
  Eigen::VectorXd TangentAt(const PathPoint& point, const Eigen::VectorXd& towards);

  int spacing_;
  std::vector<Reference> references_;  // in the order of the path
  ModeArc arc_;
  std::optional<PathPoint> first_;
  double extent_ = 0.0;  // largest distance from the first point
  const Laws& laws_;
  const LargestReactionSoFar& largest_reaction_;
};

// The end of a trace that comes back to an increment.
End ClosedPath(int increment);

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_RETURN_DETECTOR_H_
