#include "check/elements.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "check/solid.h"

namespace contact_path::check {
namespace {

constexpr double kStep = 0x1p-20;  // of difference quotients, of the extent of the element

struct BarLengths {
  Real current = 0.0L;
  Real rest = 0.0L;
  Vector span;  // from the first node to the second
};

// e
Real Strain(StrainMeasure measure, const BarLengths& lengths) {
  const Real stretch = lengths.current / lengths.rest;
  switch (measure) {
    case StrainMeasure::kBiot: return stretch - 1.0L;
    case StrainMeasure::kGreenLagrange: return (stretch * stretch - 1.0L) / 2.0L;
    case StrainMeasure::kLogarithmic: return std::log(stretch);
  }
  return std::numeric_limits<Real>::quiet_NaN();
}

// de/dl / l: by Green and Lagrange's measure a bar of no length has one, too.
Real StrainRatePerLength(StrainMeasure measure, const BarLengths& lengths) {
  switch (measure) {
    case StrainMeasure::kBiot: return 1.0L / (lengths.rest * lengths.current);
    case StrainMeasure::kGreenLagrange: return 1.0L / (lengths.rest * lengths.rest);
    case StrainMeasure::kLogarithmic: return 1.0L / (lengths.current * lengths.current);
  }
  return std::numeric_limits<Real>::quiet_NaN();
}

// W = EA l0 e^2 / 2.
class BarElement : public Element {
 public:
  BarElement(const Bar& bar, const std::vector<std::size_t>& nodes, const std::vector<double>& reference)
      : Element(nodes),
        first_(nodes.at(0)),
        second_(nodes.at(1)),
        EA_(bar.EA),
        rest_(bar.rest_length),
        strain_(bar.strain) {
    if (bar.rest_length == 0.0) rest_ = Length(NodePosition(reference, second_) - NodePosition(reference, first_));
  }

  void AddEnergy(const std::vector<double>& positions, Real* energy) const override {
    const BarLengths lengths = Measure(positions);
    const Real strain = Strain(strain_, lengths);
    *energy += EA_ * lengths.rest * strain * strain / 2.0L;
  }

  void AddForce(const std::vector<double>& positions, std::vector<Real>* forces) const override {
    const BarLengths lengths = Measure(positions);
    // N = dW/dl = EA l0 e de/dl, along the bar: N / l times its span.
    const Real per_length = EA_ * lengths.rest * Strain(strain_, lengths) * StrainRatePerLength(strain_, lengths);
    const Vector pull{per_length * lengths.span.x, per_length * lengths.span.y};
    (*forces)[2 * first_] -= pull.x;
    (*forces)[2 * first_ + 1] -= pull.y;
    (*forces)[2 * second_] += pull.x;
    (*forces)[2 * second_ + 1] += pull.y;
  }

 private:
  BarLengths Measure(const std::vector<double>& positions) const {
    const Vector span = NodePosition(positions, second_) - NodePosition(positions, first_);
    return {Length(span), rest_, span};
  }

  std::size_t first_, second_;
  Real EA_, rest_;
  StrainMeasure strain_;
};

// W = (x - X)' K (x - X) / 2.
class LinearPart : public Element {
 public:
  LinearPart(const Superelement& part, const std::vector<std::size_t>& nodes, const std::vector<double>& reference)
      : Element(nodes),
        stiffness_(part.stiffness.begin(), part.stiffness.end()),
        rest_(part.rest_positions.begin(), part.rest_positions.end()) {
    if (rest_.empty())
      for (const std::size_t node : nodes) rest_.insert(rest_.end(), {reference[2 * node], reference[2 * node + 1]});
  }

  bool Turns() const override { return false; }

  void AddEnergy(const std::vector<double>& positions, Real* energy) const override {
    const std::vector<Real> displacements = Displacements(positions), forces = Forces(displacements);
    for (std::size_t i = 0; i < forces.size(); ++i) *energy += forces[i] * displacements[i] / 2.0L;
  }

  void AddForce(const std::vector<double>& positions, std::vector<Real>* forces) const override {
    const std::vector<Real> elastic = Forces(Displacements(positions));
    for (std::size_t i = 0; i < Nodes().size(); ++i) {
      (*forces)[2 * Nodes()[i]] += elastic[2 * i];
      (*forces)[2 * Nodes()[i] + 1] += elastic[2 * i + 1];
    }
  }

 private:
  // x - X of the nodes, in their order.
  std::vector<Real> Displacements(const std::vector<double>& positions) const {
    std::vector<Real> displacements;
    for (std::size_t i = 0; i < Nodes().size(); ++i) {
      const Vector moved = NodePosition(positions, Nodes()[i]) - NodePosition(rest_, i);
      displacements.push_back(moved.x);
      displacements.push_back(moved.y);
    }
    return displacements;
  }

  // K d
  std::vector<Real> Forces(const std::vector<Real>& displacements) const {
    const std::size_t size = displacements.size();
    std::vector<Real> forces(size, 0.0L);
    for (std::size_t row = 0; row < size; ++row) {
      for (std::size_t column = 0; column < size; ++column) {
        forces[row] += stiffness_[row * size + column] * displacements[column];
      }
    }
    return forces;
  }

  std::vector<Real> stiffness_;  // row by row
  std::vector<double> rest_;     // x0, y0, x1, ...
};

// The class of each kind of element.
template <typename Part>
struct ClassOf;
template <>
struct ClassOf<Bar> {
  using Type = BarElement;
};
template <>
struct ClassOf<Superelement> {
  using Type = LinearPart;
};

using Elements = std::vector<std::unique_ptr<const Element>>;

// One element of one part.
template <typename Part>
void Append(const Part& part, const Scene&, const std::vector<std::size_t>& nodes, const std::vector<double>& reference,
            Elements* elements) {
  elements->push_back(std::make_unique<typename ClassOf<Part>::Type>(part, nodes, reference));
}

// The elements of a mesh.
void Append(const Solid& solid, const Scene& scene, const std::vector<std::size_t>& nodes,
            const std::vector<double>& reference, Elements* elements) {
  const auto material = std::find_if(scene.materials.begin(), scene.materials.end(),
                                     [&](const Material& known) { return known.name == solid.material; });
  if (material == scene.materials.end()) throw std::out_of_range("no material has the name " + solid.material);
  const std::size_t count = solid.nodes_per_element == 0 ? 3 : static_cast<std::size_t>(solid.nodes_per_element);
  std::vector<std::size_t> own;
  for (const std::size_t node : nodes) {
    own.push_back(node);
    if (own.size() < count) continue;
    elements->push_back(MakeSolid(solid, *material, own, reference));
    own.clear();
  }
}

}  // namespace

std::vector<std::unique_ptr<const Element>> MakeElements(const Scene& scene, const NodeNumbers& numbers,
                                                         const std::vector<double>& reference) {
  std::vector<std::unique_ptr<const Element>> elements;
  ForEachElementList(scene, [&](std::string_view, const auto& parts) {
    for (const auto& part : parts) {
      std::vector<std::size_t> nodes;
      for (const std::string& name : part.nodes) nodes.push_back(numbers.at(name));
      Append(part, scene, nodes, reference, &elements);
    }
  });
  return elements;
}

std::vector<StiffnessBound> BoundStiffness(const std::vector<std::unique_ptr<const Element>>& elements,
                                           const std::vector<double>& positions) {
  std::vector<StiffnessBound> bounds(positions.size() / 2);
  std::vector<double> moved = positions;
  std::vector<Real> forces(positions.size(), 0.0L);
  for (const auto& element : elements) {
    std::vector<std::size_t> components;
    Real extent = 0.0L;
    for (const std::size_t node : element->Nodes()) {
      components.insert(components.end(), {2 * node, 2 * node + 1});
      extent = std::max(extent, Length(NodePosition(positions, node) - NodePosition(positions, element->Nodes()[0])));
    }
    const double step = kStep * (extent > 0.0L ? static_cast<double>(extent) : 1.0);
    // Calls visit(i, rate of the force in the component i) for a motion of the component k.
    const auto for_each_rate = [&](std::size_t k, auto visit) {
      const auto forces_at = [&](double value) {
        for (const std::size_t i : components) forces[i] = 0.0L;
        moved[k] = value;
        element->AddForce(moved, &forces);
        std::vector<Real> own;
        own.reserve(components.size());
        for (const std::size_t i : components) own.push_back(forces[i]);
        moved[k] = positions[k];
        return own;
      };
      const double there = positions[k] + step;
      const std::vector<Real> before = forces_at(positions[k]), after = forces_at(there);
      for (std::size_t i = 0; i < components.size(); ++i)
        visit(components[i], std::abs(static_cast<double>((after[i] - before[i]) / (Real{there} - positions[k]))));
    };
    double largest = 0.0;
    for (const std::size_t k : components)
      for_each_rate(k, [&](std::size_t i, double rate) {
        largest = std::max(largest, rate);
        if (!element->Turns()) (i % 2 == 0 ? bounds[i / 2].x : bounds[i / 2].y) += rate;
      });
    if (element->Turns())
      for (const std::size_t node : element->Nodes()) bounds[node].any += largest;
  }
  return bounds;
}

}  // namespace contact_path::check
