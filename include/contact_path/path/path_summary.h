// What lies on a path, and how it ended, in a line for a person; and how far it has come.
#ifndef CONTACT_PATH_PATH_PATH_SUMMARY_H_
#define CONTACT_PATH_PATH_PATH_SUMMARY_H_

#include <string>
#include <string_view>
#include <vector>

#include "contact_path/path/increment.h"
#include "contact_path/path/stop.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

// Where the load factor turns, or another path crosses.
struct CriticalPoint {
  int index = 0;                                     // of its increment
  int stage = 0;                                     // as in Increment
  IncrementKind kind = IncrementKind::kSmoothLimit;  // kSmoothLimit, kCornerLimit, kBifurcation
  double load_factor = 0.0;                          // of the stage
};

// A load factor for a person: ten digits, and 0 where it is rounding. scale: of the load factor of the request.
std::string LoadFactorText(double load_factor, double scale);

class PathSummary {
 public:
  // load_scale: ProgramScales(request).load_factor.
  explicit PathSummary(double load_scale) : load_scale_(load_scale) {}

  // Takes every increment, in order.
  void Add(const Increment& increment);

  int increments() const { return increments_; }                                    // increment 0 included
  const std::vector<CriticalPoint>& limit_points() const { return limit_points_; }  // in the order of the path
  int jumps() const { return jumps_; }
  int events() const { return events_; }  // increments where contacts change their states, or could

  // "98 increments; limit points: smooth_limit at load factor 2.191505308 (increment 31); 4 events". Ten points at
  // most, and likewise before the events "another path crosses: bifurcation at load factor ..." where one does; "1
  // jump" at the end where there are any.
  std::string ToText() const;

  // The same after why the trace ended: "stop_criterion: b.x > 4.95; 98 increments; ...". reason: "" is left out.
  std::string ToText(std::string_view reason, const std::string& message) const;

 private:
  double load_scale_;
  int increments_ = 0;
  int events_ = 0;
  int jumps_ = 0;
  std::vector<CriticalPoint> limit_points_;
  std::vector<CriticalPoint> crossings_;  // bifurcations, and limit points where another path crosses
};

class ProgressEstimate {
 public:
  explicit ProgressEstimate(const TraceRequest& request);  // sound (scene/validate.h)

  // Whether the request names an end: a stop criterion, a number of increments, or a program.
  bool HasEnd() const { return max_increments_ > 0 || !goals_.empty() || !targets_.empty(); }

  // Takes every increment, from increment 0 on. Part of the way done, 0 to 1: the largest over the stop criteria, from
  // their value at increment 0, the wanted number of increments, and the stages; 0 without an end. May fall: paths
  // turn.
  double Add(const Increment& increment);

 private:
  // A stop criterion as the way from where the path started to where it would end.
  struct Goal {
    Quantity quantity;
    double start = 0.0;
    double end = 0.0;
  };

  std::vector<double> targets_;  // of the stages
  int max_increments_;           // as in the request: 0 = not asked for
  std::vector<Goal> goals_;
  TraceRequest request_;  // empty where no goal is of an obstacle
};

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_PATH_SUMMARY_H_
