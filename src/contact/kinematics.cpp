#include "contact_path/contact/kinematics.h"

namespace contact_path {

namespace {

// Place of each entry of (dofs, s) among more of them.
std::array<Eigen::Index, kMostPairDofs + 1> PlacesIn(const PairDofs& to, const PairDofs& from) {
  std::array<Eigen::Index, kMostPairDofs + 1> places{};
  std::size_t place = 0;
  for (std::size_t k = 0; k < from.size(); ++k) {
    while (to[place] != from[k]) ++place;
    places[k] = static_cast<Eigen::Index>(place);
  }
  places[from.size()] = static_cast<Eigen::Index>(to.size());
  return places;
}

}  // namespace

PairVector Spread(const PairVector& vector, const PairDofs& from, const PairDofs& to) {
  const auto places = PlacesIn(to, from);
  PairVector spread = PairVector::Zero(static_cast<Eigen::Index>(to.size()) + 1);
  for (Eigen::Index k = 0; k < vector.size(); ++k) spread[places[static_cast<std::size_t>(k)]] = vector[k];
  return spread;
}

PairMatrix Spread(const PairMatrix& matrix, const PairDofs& from, const PairDofs& to) {
  const auto places = PlacesIn(to, from);
  const auto size = static_cast<Eigen::Index>(to.size()) + 1;
  PairMatrix spread = PairMatrix::Zero(size, size);
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index k = 0; k < matrix.cols(); ++k)
      spread(places[static_cast<std::size_t>(i)], places[static_cast<std::size_t>(k)]) = matrix(i, k);
  return spread;
}

PairVector LocalOf(const PairDofs& dofs, const Eigen::Ref<const Eigen::VectorXd>& u, double s) {
  PairVector q(static_cast<Eigen::Index>(dofs.size()) + 1);
  Eigen::Index k = 0;
  for (const int dof : dofs) q[k++] = u[dof];
  q[k] = s;
  return q;
}

double Kinematics::Rate(const PairVector& gradient, const Eigen::Ref<const Eigen::VectorXd>& du, double ds) const {
  double sum = 0.0;
  Eigen::Index k = 0;
  for (const int dof : dofs) sum += gradient[k++] * du[dof];
  return sum + gradient[k] * ds;
}

void Kinematics::AddForce(const PairVector& gradient, double factor, Eigen::VectorXd* out) const {
  Eigen::Index k = 0;
  for (const int dof : dofs) (*out)[dof] += factor * gradient[k++];
}

PairMatrix Kinematics::ForceChange(double rn, double rt) const {
  PairMatrix change = rn * gap_hessian + (rt * slip_factor) * xi_hessian;
  if (slip_factor_gradient.size() > 0) change += rt * slip_factor_gradient * xi_gradient.transpose();
  return change;
}

}  // namespace contact_path
