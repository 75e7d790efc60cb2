// Reads the rows of a bag that a trace is to go on from.
#ifndef CONTACT_PATH_ROS_BAG_ROWS_H_
#define CONTACT_PATH_ROS_BAG_ROWS_H_

#include <string>
#include <vector>

#include "contact_path/path/increment.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

struct RecordedRows {
  TraceRequest request;
  std::vector<Increment> rows;  // those of the path, from row 0; the bag proves them
};

// Throws std::runtime_error, one line, for a bag that cannot be read, one whose rows are not proved (verify/), and one
// with regular rows that have no state: they could not be written again.
RecordedRows ReadRows(const std::string& bag);

}  // namespace contact_path

#endif  // CONTACT_PATH_ROS_BAG_ROWS_H_
