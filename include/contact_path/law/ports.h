// The ports of a law: motions that do work with forces.
#ifndef CONTACT_PATH_LAW_PORTS_H_
#define CONTACT_PATH_LAW_PORTS_H_

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "contact_path/structure/local_vector.h"

namespace contact_path {

// The most ports of one law.
inline constexpr std::size_t kMostPorts = 4;

// By port of one law: 0 beyond the ports that it has.
using PortReals = std::array<double, kMostPorts>;

// By (dofs, s) of some of the dofs of another list: by all of them, with zeros.
LawVector Spread(const LawVector& vector, const LawDofs& from, const LawDofs& to);
LawMatrix Spread(const LawMatrix& matrix, const LawDofs& from, const LawDofs& to);
// The entries of a vector by (dofs, s) that belong to some of them.
LawVector Gathered(const LawVector& vector, const LawDofs& from, const LawDofs& to);

// A force of the port exerts force * factor * gradient on the structure. factor * d(motion) is what the force works
// along: the factor is other than 1 where the motion is not a length, as along a surface that stretches.
struct PortAt {
  double motion = 0.0;  // since a reference [length]
  LawVector gradient;   // by (dofs, s)
  LawMatrix hessian;    // by (dofs, s), symmetric; empty where it is zero throughout
  double factor = 1.0;
  LawVector factor_gradient;  // by (dofs, s); empty where the factor is 1 throughout
};

// The ports of a law at a place.
struct PortsAt {
  LawDofs dofs;  // that everything here is by
  std::array<PortAt, kMostPorts> ports;

  PortAt& operator[](std::size_t port) { return ports[port]; }
  const PortAt& operator[](std::size_t port) const { return ports[port]; }

  // The entries of (u, s) that belong to the law. u: may have more entries than dofs, here and below.
  LawVector Local(const Eigen::Ref<const Eigen::VectorXd>& u, double s) const { return LocalOf(dofs, u, s); }
  // gradient . (du, ds), the gradient by (dofs, s).
  double Rate(const LawVector& gradient, const Eigen::Ref<const Eigen::VectorXd>& du, double ds) const;
  // out += factor * gradient by u.
  void AddForce(const LawVector& gradient, double factor, Eigen::VectorXd* out) const;
  // Change of the force with (dofs, s) while the forces of the ports, which have Hessians, stay. Row: of which
  // component of (dofs, s); column: of the force.
  LawMatrix ForceChange(const PortReals& forces) const;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_LAW_PORTS_H_
