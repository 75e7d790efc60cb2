// Gap and surface coordinate of a contact candidate with their derivatives.
#ifndef CONTACT_PATH_CONTACT_KINEMATICS_H_
#define CONTACT_PATH_CONTACT_KINEMATICS_H_

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <initializer_list>

namespace contact_path {

// The most unknowns that move one candidate.
inline constexpr int kMostPairDofs = 12;

// Unknowns that move a candidate, as numbers into u, ascending. No allocation.
class PairDofs {
 public:
  PairDofs() = default;
  PairDofs(std::initializer_list<int> dofs) {
    for (const int dof : dofs) push_back(dof);
  }

  void push_back(int dof) { of_[size_++] = dof; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  int operator[](std::size_t k) const { return of_[k]; }
  const int* begin() const { return of_.data(); }
  const int* end() const { return of_.data() + size_; }

 private:
  std::array<int, kMostPairDofs> of_{};
  std::size_t size_ = 0;
};

// By (dofs, s): the unknowns of the pair in their order, then the load factor. No allocation.
using PairVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostPairDofs + 1, 1>;
using PairMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostPairDofs + 1, kMostPairDofs + 1>;

// The entries of (u, s) that belong to a pair with these dofs. u: may have more entries than dofs.
PairVector LocalOf(const PairDofs& dofs, const Eigen::Ref<const Eigen::VectorXd>& u, double s);
// By (dofs, s) of some of the dofs of another list: by all of them, with zeros.
PairVector Spread(const PairVector& vector, const PairDofs& from, const PairDofs& to);
PairMatrix Spread(const PairMatrix& matrix, const PairDofs& from, const PairDofs& to);

// The reaction exerts the force r_n grad u_n + r_t c grad xi. c = d(slip) / d(xi) is 1 where xi is the arc length along
// the surface, and is other than that on a surface that stretches.
struct Kinematics {
  double gap = 0.0;                      // u_n [length]
  double xi = 0.0;                       // u_t: motion along the surface since a reference [length]
  PairDofs dofs;                         // that everything here is by
  PairVector gap_gradient, xi_gradient;  // by (dofs, s)
  PairMatrix gap_hessian, xi_hessian;    // by (dofs, s), symmetric; empty where both are zero throughout
  double slip_factor = 1.0;              // c
  PairVector slip_factor_gradient;       // by (dofs, s); empty where c is 1 throughout

  // The entries of (u, s) that belong to the pair. u: may have more entries than dofs, here and below.
  PairVector Local(const Eigen::Ref<const Eigen::VectorXd>& u, double s) const { return LocalOf(dofs, u, s); }
  // gradient . (du, ds), the gradient by (dofs, s).
  double Rate(const PairVector& gradient, const Eigen::Ref<const Eigen::VectorXd>& du, double ds) const;
  // out += factor * gradient by u.
  void AddForce(const PairVector& gradient, double factor, Eigen::VectorXd* out) const;
  // Change of the force with (dofs, s) while r_n and r_t stay. Row: of which component of (dofs, s); column: of the
  // force. Hessians are there.
  PairMatrix ForceChange(double rn, double rt) const;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_CONTACT_KINEMATICS_H_
