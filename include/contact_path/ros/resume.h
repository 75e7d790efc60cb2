// What there is of a trace that is to be gone on with, from its bag.
#ifndef CONTACT_PATH_ROS_RESUME_H_
#define CONTACT_PATH_ROS_RESUME_H_

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "contact_path/path/increment.h"
#include "contact_path/ros/messages.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

struct TraceSoFar {
  TraceRequest request;
  std::vector<Increment> increments;  // from increment 0; the bag proves them
};

// Throws std::runtime_error, one line, for a bag that cannot be read and for one whose increments are not proved
// (verify/). `cancelled` is asked often: true throws ReadingCancelled (bag_reader.h). It may be empty.
TraceSoFar ReadTraceSoFar(const std::string& bag, const std::function<bool()>& cancelled);

// The same for a request of the node that names a bag to resume: a file in `directory`, by its plain name. The limit of
// the number of increments is the request's if it has one. Throws InvalidRequest (scene/validate.h) for any other name,
// for a bag as above, and for a request that also has a scene, a program or other options.
TraceSoFar ReadTraceSoFar(const std::filesystem::path& directory, const contact_path_msgs::TraceRequest& request,
                          const std::function<bool()>& cancelled);

}  // namespace contact_path

#endif  // CONTACT_PATH_ROS_RESUME_H_
