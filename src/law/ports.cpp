#include "contact_path/law/ports.h"

namespace contact_path {

namespace {

// Place of each entry of (dofs, s) among more of them.
std::array<Eigen::Index, kMostLawDofs + 1> PlacesIn(const LawDofs& to, const LawDofs& from) {
  std::array<Eigen::Index, kMostLawDofs + 1> places{};
  std::size_t place = 0;
  for (std::size_t k = 0; k < from.size(); ++k) {
    while (to[place] != from[k]) ++place;
    places[k] = static_cast<Eigen::Index>(place);
  }
  places[from.size()] = static_cast<Eigen::Index>(to.size());
  return places;
}

}  // namespace

LawVector Spread(const LawVector& vector, const LawDofs& from, const LawDofs& to) {
  const auto places = PlacesIn(to, from);
  LawVector spread = LawVector::Zero(static_cast<Eigen::Index>(to.size()) + 1);
  for (Eigen::Index k = 0; k < vector.size(); ++k) spread[places[static_cast<std::size_t>(k)]] = vector[k];
  return spread;
}

LawVector Gathered(const LawVector& vector, const LawDofs& from, const LawDofs& to) {
  LawVector own(static_cast<Eigen::Index>(to.size()) + 1);
  for (std::size_t k = 0; k < to.size(); ++k)
    own[static_cast<Eigen::Index>(k)] = vector[std::find(from.begin(), from.end(), to[k]) - from.begin()];
  own[own.size() - 1] = vector[vector.size() - 1];
  return own;
}

LawMatrix Spread(const LawMatrix& matrix, const LawDofs& from, const LawDofs& to) {
  const auto places = PlacesIn(to, from);
  const auto size = static_cast<Eigen::Index>(to.size()) + 1;
  LawMatrix spread = LawMatrix::Zero(size, size);
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index k = 0; k < matrix.cols(); ++k)
      spread(places[static_cast<std::size_t>(i)], places[static_cast<std::size_t>(k)]) = matrix(i, k);
  return spread;
}

double PortsAt::Rate(const LawVector& gradient, const Eigen::Ref<const Eigen::VectorXd>& du, double ds) const {
  double sum = 0.0;
  Eigen::Index k = 0;
  for (const int dof : dofs) sum += gradient[k++] * du[dof];
  return sum + gradient[k] * ds;
}

void PortsAt::AddForce(const LawVector& gradient, double factor, Eigen::VectorXd* out) const {
  Eigen::Index k = 0;
  for (const int dof : dofs) (*out)[dof] += factor * gradient[k++];
}

LawMatrix PortsAt::ForceChange(const PortReals& forces) const {
  const auto size = static_cast<Eigen::Index>(dofs.size()) + 1;
  LawMatrix change = LawMatrix::Zero(size, size);
  for (std::size_t p = 0; p < kMostPorts; ++p) {
    const PortAt& port = ports[p];
    if (port.hessian.size() > 0) change += (forces[p] * port.factor) * port.hessian;
  }
  for (std::size_t p = 0; p < kMostPorts; ++p) {
    const PortAt& port = ports[p];
    if (port.factor_gradient.size() > 0) change += forces[p] * port.factor_gradient * port.gradient.transpose();
  }
  return change;
}

}  // namespace contact_path
