// The ports of a law: motions that do work with forces.
#ifndef CONTACT_PATH_LAW_PORTS_H_
#define CONTACT_PATH_LAW_PORTS_H_

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <initializer_list>

namespace contact_path {

// The most unknowns that move one law, and the most ports of one.
inline constexpr int kMostLawDofs = 12;
inline constexpr std::size_t kMostPorts = 4;

// By port of one law: 0 beyond the ports that it has.
using PortReals = std::array<double, kMostPorts>;

// Unknowns that move a law, as numbers into u, ascending. No allocation.
class LawDofs {
 public:
  LawDofs() = default;
  LawDofs(std::initializer_list<int> dofs) {
    for (const int dof : dofs) push_back(dof);
  }

  void push_back(int dof) { of_[size_++] = dof; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  int operator[](std::size_t k) const { return of_[k]; }
  const int* begin() const { return of_.data(); }
  const int* end() const { return of_.data() + size_; }

 private:
  std::array<int, kMostLawDofs> of_{};
  std::size_t size_ = 0;
};

// By (dofs, s): the unknowns of the law in their order, then the load factor. No allocation.
using LawVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostLawDofs + 1, 1>;
using LawMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostLawDofs + 1, kMostLawDofs + 1>;

// The entries of (u, s) that belong to a law with these dofs. u: may have more entries than dofs.
LawVector LocalOf(const LawDofs& dofs, const Eigen::Ref<const Eigen::VectorXd>& u, double s);
// By (dofs, s) of some of the dofs of another list: by all of them, with zeros.
LawVector Spread(const LawVector& vector, const LawDofs& from, const LawDofs& to);
LawMatrix Spread(const LawMatrix& matrix, const LawDofs& from, const LawDofs& to);

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
