// What lies on a path, and how it ended, in a line for a person.
#ifndef CONTACT_PATH_PATH_PATH_SUMMARY_H_
#define CONTACT_PATH_PATH_PATH_SUMMARY_H_

#include <string>
#include <string_view>
#include <vector>

#include "contact_path/path/increment.h"

namespace contact_path {

class PathSummary {
 public:
  // Takes every row, in order.
  void Add(const Increment& row);

  int rows() const { return rows_; }                  // row 0 included
  int limit_points() const { return limit_points_; }  // smooth ones and corners
  int events() const { return events_; }              // rows where contacts change their states, or could

  // "98 rows; limit points: smooth_limit at load factor 2.191505308 (row 31); 4 events". Ten limit points at most.
  std::string ToText() const;

  // The same after why the trace ended: "stop_criterion: b.x > 4.95; 98 rows; ...". reason: "" is left out.
  std::string ToText(std::string_view reason, const std::string& message) const;

 private:
  int rows_ = 0;
  int limit_points_ = 0;
  int events_ = 0;
  std::vector<std::string> listed_;  // the first limit points
};

}  // namespace contact_path

#endif  // CONTACT_PATH_PATH_PATH_SUMMARY_H_
