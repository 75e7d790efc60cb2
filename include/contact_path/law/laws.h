// The laws of a structure, and what a point of the path holds of them.
#ifndef CONTACT_PATH_LAW_LAWS_H_
#define CONTACT_PATH_LAW_LAWS_H_

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "contact_path/law/law.h"
#include "contact_path/law/path_point.h"

namespace contact_path {

// In their order; each has its ports one after the other among those of all. Laws are kept by whoever made them, and
// must outlive this.
class Laws {
 public:
  void Add(const Law* law);
  std::size_t size() const { return laws_.size(); }
  const Law& operator[](std::size_t i) const { return *laws_[i]; }

  Eigen::Index NumPorts() const { return num_ports_; }
  Eigen::Index FirstPort(std::size_t i) const { return first_port_[i]; }
  // Those of one law among values by port.
  PortReals Of(const Eigen::VectorXd& by_port, std::size_t i) const;
  void Put(const PortReals& values, std::size_t i, Eigen::VectorXd* by_port) const;

  // All idle laws are on the piece that they have there; all others on that of the point.
  Modes ModesAt(const PathPoint& point, std::size_t i, const ActiveSetTolerance& tolerance) const {
    return laws_[i]->ModesAt(point.u, point.s, point.modes[i], Of(point.forces, i), tolerance);
  }
  // By port, from the motions at the point.
  Eigen::VectorXd ReferencesAt(const PathPoint& point) const;
  double Energy(const PathPoint& point) const;
  // Largest force of a port, in the force unit of its law.
  double LargestForce(const PathPoint& point) const;

 private:
  std::vector<const Law*> laws_;
  std::vector<Eigen::Index> first_port_;
  Eigen::Index num_ports_ = 0;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_LAW_LAWS_H_
