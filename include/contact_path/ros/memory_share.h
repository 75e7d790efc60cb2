// How much memory the node may take.
#ifndef CONTACT_PATH_ROS_MEMORY_SHARE_H_
#define CONTACT_PATH_ROS_MEMORY_SHARE_H_

namespace contact_path {

// Data of this process, whether in memory or not [MB of 2^20 bytes]. 0 in a build with a sanitizer that reserves more
// than there is: then there is no limit either.
double DataMegabytes();

// From now on the system refuses this process data beyond `megabytes`: std::bad_alloc where more is asked for.
// 0: as much as there is. Throws std::invalid_argument where what is in use leaves too little for a small trace.
void LimitData(int megabytes);

// Of such a limit, as much as a trace may use before it is ended: what else the node does needs the rest.
constexpr double kShareOfTraces = 0.9;

}  // namespace contact_path

#endif  // CONTACT_PATH_ROS_MEMORY_SHARE_H_
