// Laws, each in a mode: their forces and motions among the unknowns of a system.
#ifndef CONTACT_PATH_EQUATIONS_LAWS_IN_MODES_H_
#define CONTACT_PATH_EQUATIONS_LAWS_IN_MODES_H_

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "contact_path/equations/jet.h"
#include "contact_path/law/laws.h"

namespace contact_path {

// offset + sign (motion of the port - its reference).
struct PortMotion {
  std::size_t law, port;
  double sign = 1.0, offset = 0.0;
};

// Unknowns x = (u, s, forces of the ports that are held, ...), scaled. Forces of ports that follow are those of port 0
// times their ratio.
class LawsInModes {
 public:
  // laws: must outlive this. num_dofs: how many components u has.
  LawsInModes(const Laws& laws, Eigen::Index num_dofs);

  // references: by port.
  void Set(const Modes& modes, const Eigen::VectorXd& references);
  // The law is in the mode that it has at the start of a step from x: no equation changes.
  void Start(std::size_t law, const Eigen::VectorXd& x);

  const Laws& laws() const { return laws_; }
  const Law& operator[](std::size_t i) const { return laws_[i]; }
  const Modes& modes() const { return modes_; }
  const std::vector<std::size_t>& Acting() const { return acting_; }  // that are not idle, ascending
  Eigen::Index NumDofs() const { return num_dofs_; }
  Eigen::Index NumUnknowns() const { return num_unknowns_; }  // u, s and the forces
  const StateRule& StateOf(std::size_t law) const { return laws_[law].In(modes_[law]); }
  PortReals ReferencesOf(std::size_t law) const { return laws_.Of(reference_, law); }
  // The unknown that is the force of the port; -1: it is not held.
  Eigen::Index UnknownOf(std::size_t law, std::size_t port) const {
    return unknown_[static_cast<std::size_t>(laws_.FirstPort(law)) + port];
  }

  // Forces of the ports of a law that acts; with a change of the unknowns, the change.
  PortReals ForcesOf(std::size_t law, const Eigen::VectorXd& x) const;
  PortsAt Evaluate(std::size_t law, const Eigen::VectorXd& x) const;
  double ValueOf(const PortMotion& motion, const Eigen::VectorXd& x) const;
  // The second derivative along dx of the motion of a port that comes from curvature.
  double Bend(std::size_t port, const PortsAt& at, const Eigen::VectorXd& dx) const;
  // energy += what the laws store [force length].
  void AddEnergy(const Eigen::VectorXd& x, double* energy) const;
  // out += sign times the forces of all laws on u.
  void AddForces(const Eigen::VectorXd& x, double sign, Eigen::VectorXd* out) const;

  // u and s of a point, and the forces of its ports that are held, to the head of x; the point, with idle laws as
  // points have them (Law::OfPoint).
  void Pack(const PathPoint& point, Eigen::VectorXd* x) const;
  PathPoint Unpack(const Eigen::VectorXd& x) const;

  // Along a curve with these derivatives at x. Of a port its motion, and the force of port 0 times the factor of this
  // one: times the ratio of a port that follows and d(motion), the work that it takes.
  Jet MotionAlong(std::size_t law, std::size_t port, const Eigen::VectorXd& x, const Eigen::VectorXd& first,
                  const Eigen::VectorXd& second) const;
  Jet LeadingForceAlong(std::size_t law, std::size_t port, const Eigen::VectorXd& x, const Eigen::VectorXd& first,
                        const Eigen::VectorXd& second) const;
  // force += the force that what moves with s exerts on the law, along its motion.
  void AddDrivingForce(std::size_t law, const Eigen::VectorXd& x, const Eigen::VectorXd& first,
                       const Eigen::VectorXd& second, Jet* force) const;

 private:
  const Laws& laws_;
  Eigen::Index num_dofs_;
  Modes modes_;
  Eigen::VectorXd reference_;  // by port
  std::vector<std::size_t> acting_;
  std::vector<Eigen::Index> unknown_;  // by port
  Eigen::Index num_unknowns_ = 0;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_EQUATIONS_LAWS_IN_MODES_H_
