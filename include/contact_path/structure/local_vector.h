// Vectors and matrices by the few unknowns that move one thing.
#ifndef CONTACT_PATH_STRUCTURE_LOCAL_VECTOR_H_
#define CONTACT_PATH_STRUCTURE_LOCAL_VECTOR_H_

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <initializer_list>

namespace contact_path {

// The most unknowns that move one law, or one place.
inline constexpr int kMostLawDofs = 12;

// Unknowns that move a law or a place, as numbers into u, ascending. No allocation.
class LawDofs {
 public:
  LawDofs() = default;
  LawDofs(std::initializer_list<int> dofs) {
    for (const int dof : dofs) push_back(dof);
  }

  void push_back(int dof) { of_.at(size_++) = dof; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  int operator[](std::size_t k) const { return of_[k]; }
  const int* begin() const { return of_.data(); }
  const int* end() const { return of_.data() + size_; }

 private:
  std::array<int, kMostLawDofs> of_{};
  std::size_t size_ = 0;
};

// By (dofs, s): the unknowns in their order, then the load factor. No allocation.
using LawVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostLawDofs + 1, 1>;
using LawMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostLawDofs + 1, kMostLawDofs + 1>;

// The entries of (u, s) that belong to these dofs. u: may have more entries than dofs.
LawVector LocalOf(const LawDofs& dofs, const Eigen::Ref<const Eigen::VectorXd>& u, double s);

}  // namespace contact_path

#endif  // CONTACT_PATH_STRUCTURE_LOCAL_VECTOR_H_
