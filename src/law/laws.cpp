#include "contact_path/law/laws.h"

#include <algorithm>
#include <cmath>

namespace contact_path {

void Laws::Add(const Law* law) {
  laws_.push_back(law);
  first_port_.push_back(num_ports_);
  num_ports_ += static_cast<Eigen::Index>(law->NumPorts());
}

PortReals Laws::Of(const Eigen::VectorXd& by_port, std::size_t i) const {
  PortReals values{};
  for (std::size_t p = 0; p < laws_[i]->NumPorts(); ++p)
    values[p] = by_port[first_port_[i] + static_cast<Eigen::Index>(p)];
  return values;
}

void Laws::Put(const PortReals& values, std::size_t i, Eigen::VectorXd* by_port) const {
  for (std::size_t p = 0; p < laws_[i]->NumPorts(); ++p)
    (*by_port)[first_port_[i] + static_cast<Eigen::Index>(p)] = values[p];
}

Eigen::VectorXd Laws::ReferencesAt(const PathPoint& point) const {
  Eigen::VectorXd references(num_ports_);
  for (std::size_t i = 0; i < laws_.size(); ++i)
    Put(laws_[i]->ReferenceOf(point.u, point.s, point.modes[i], Of(point.forces, i)), i, &references);
  return references;
}

double Laws::Energy(const PathPoint& point) const {
  double energy = 0.0;
  for (std::size_t i = 0; i < laws_.size(); ++i)
    energy += laws_[i]->EnergyAt(point.u, point.s, point.modes[i], Of(point.forces, i));
  return energy;
}

double Laws::LargestForce(const PathPoint& point) const {
  double largest = 0.0;
  for (std::size_t i = 0; i < laws_.size(); ++i)
    for (const double force : Of(point.forces, i)) largest = std::max(largest, std::abs(force) / laws_[i]->ForceUnit());
  return largest;
}

}  // namespace contact_path
