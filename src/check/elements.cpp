#include "check/elements.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <unsupported/Eigen/AutoDiff>

#include "check/tendons.h"

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
      : Element(Kind::kBar, nodes),
        first_(nodes.at(0)),
        second_(nodes.at(1)),
        EA_(bar.EA),
        rest_(bar.rest_length),
        strain_(bar.strain),
        sense_(bar.sense) {
    if (bar.rest_length == 0.0) rest_ = Length(NodePosition(reference, second_) - NodePosition(reference, first_));
  }

  Real Stiffness() const override { return EA_ / rest_; }

  void AddEnergy(const std::vector<double>& positions, Real* energy) const override {
    const BarLengths lengths = Measure(positions);
    const Real strain = StrainOf(lengths);
    *energy += EA_ * lengths.rest * strain * strain / 2.0L;
  }

  void AddForce(const std::vector<double>& positions, std::vector<Real>* forces) const override {
    const BarLengths lengths = Measure(positions);
    // N = dW/dl = EA l0 e de/dl, along the bar: N / l times its span.
    const Real strain = StrainOf(lengths);
    if (strain == 0.0L) return;
    const Real per_length = EA_ * lengths.rest * strain * StrainRatePerLength(strain_, lengths);
    AddTo(forces, first_, -per_length * lengths.span);
    AddTo(forces, second_, per_length * lengths.span);
  }

 private:
  // 0 where the bar is slack.
  Real StrainOf(const BarLengths& lengths) const {
    const Real strain = Strain(strain_, lengths);
    if (sense_ == BarSense::kTension) return std::max<Real>(strain, 0.0L);
    return sense_ == BarSense::kCompression ? std::min<Real>(strain, 0.0L) : strain;
  }

  BarLengths Measure(const std::vector<double>& positions) const {
    const Vector span = NodePosition(positions, second_) - NodePosition(positions, first_);
    return {Length(span), rest_, span};
  }

  std::size_t first_, second_;
  Real EA_, rest_;
  StrainMeasure strain_;
  BarSense sense_;
};

// W = (x - X)' K (x - X) / 2.
class LinearPart : public Element {
 public:
  LinearPart(const Superelement& part, const std::vector<std::size_t>& nodes, const std::vector<double>& reference)
      : Element(Kind::kLinearPart, nodes),
        stiffness_(part.stiffness.begin(), part.stiffness.end()),
        rest_(part.rest_positions.begin(), part.rest_positions.end()) {
    if (rest_.empty())
      for (const std::size_t node : nodes) rest_.insert(rest_.end(), {reference[2 * node], reference[2 * node + 1]});
  }

  bool Turns() const override { return false; }

  Real Stiffness() const override {
    Real largest = 0.0L;
    for (const Real entry : stiffness_) largest = std::max(largest, std::abs(entry));
    return largest;
  }

  void AddEnergy(const std::vector<double>& positions, Real* energy) const override {
    const std::vector<Real> displacements = Displacements(positions), forces = Forces(displacements);
    for (std::size_t i = 0; i < forces.size(); ++i) *energy += forces[i] * displacements[i] / 2.0L;
  }

  void AddForce(const std::vector<double>& positions, std::vector<Real>* forces) const override {
    const std::vector<Real> elastic = Forces(Displacements(positions));
    for (std::size_t i = 0; i < Nodes().size(); ++i) AddTo(forces, Nodes()[i], {elastic[2 * i], elastic[2 * i + 1]});
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
    for (std::size_t row = 0; row < size; ++row)
      for (std::size_t column = 0; column < size; ++column)
        forces[row] += stiffness_[row * size + column] * displacements[column];
    return forces;
  }

  std::vector<Real> stiffness_;  // row by row
  std::vector<double> rest_;     // x0, y0, x1, ...
};

// A segment of a beam: the stretching of the chord and the bending by what its ends turn more than the chord does.
// Forces by automatic differentiation of the energy.
class Segment : public Element {
 public:
  // first_turns, second_turns: whether the end turns with its node, or is hinged.
  Segment(const Beam& beam, std::size_t first, std::size_t second, bool first_turns, bool second_turns,
          const std::vector<double>& reference)
      : Element(Kind::kSegment, {first, second}),
        beam_(beam),
        turns_{first_turns, second_turns},
        places_{2 * first,  2 * first + 1,  reference.size() + first,
                2 * second, 2 * second + 1, reference.size() + second},
        chord_(NodePosition(reference, second) - NodePosition(reference, first)) {}

  Real Stiffness() const override {
    const Real length = Length(chord_);
    return beam_.EA / length + 12.0L * beam_.EI / (length * length * length);
  }

  void AddEnergy(const std::vector<double>& values, Real* energy) const override {
    *energy += EnergyOf<Real>({values[places_[0]], values[places_[1]], Rotation(values, 0), values[places_[3]],
                               values[places_[4]], Rotation(values, 1)});
  }

  void AddForce(const std::vector<double>& values, std::vector<Real>* forces) const override {
    using Gradient = Eigen::Matrix<Real, 6, 1>;
    std::array<Eigen::AutoDiffScalar<Gradient>, 6> variables;
    for (std::size_t i = 0; i < variables.size(); ++i) {
      const bool rotation = i % 3 == 2;
      variables[i] = {rotation ? Rotation(values, i / 3) : Real{values[places_[i]]}, 6, static_cast<int>(i)};
    }
    const Gradient gradient = EnergyOf(variables).derivatives();
    for (std::size_t i = 0; i < variables.size(); ++i)
      if (i % 3 != 2 || turns_[i / 3]) (*forces)[places_[i]] += gradient[static_cast<Eigen::Index>(i)];
  }

 private:
  // A hinged end has nothing of the rotation of its node.
  Real Rotation(const std::vector<double>& values, std::size_t end) const {
    return turns_[end] ? Real{values[places_[3 * end + 2]]} : 0.0L;
  }

  // variables: x, y, rotation of the first node, then of the second.
  template <typename Number>
  Number EnergyOf(const std::array<Number, 6>& variables) const {
    using std::atan2;
    using std::sqrt;
    const Number dx = variables[3] - variables[0], dy = variables[4] - variables[1];
    const Number length = sqrt(dx * dx + dy * dy);
    const Real rest = Length(chord_);
    const Number stretching = beam_.EA * (length - rest) * (length - rest) / (2.0L * rest);
    if (!turns_[0] && !turns_[1]) return stretching;
    // The rotation of the chord since the start: of its values, 2 pi apart, the nearest to the rotations of the ends.
    const Number sine = chord_.x * dy - chord_.y * dx, cosine = chord_.x * dx + chord_.y * dy;
    Number turn = atan2(sine, cosine);
    const int ends = (turns_[0] ? 1 : 0) + (turns_[1] ? 1 : 0);
    Real mean = 0.0L;
    for (const std::size_t end : {std::size_t{0}, std::size_t{1}})
      if (turns_[end]) mean += ValueOf(variables[3 * end + 2]) / ends;
    turn += kTurn * std::round((mean - ValueOf(turn)) / kTurn);
    const Real shear = beam_.GA > 0.0 ? 12.0L * beam_.EI / (beam_.GA * rest * rest) : 0.0L;
    const Real near = (4.0L + shear) / (1.0L + shear), far = (2.0L - shear) / (1.0L + shear),
               half = beam_.EI / (2.0L * rest);
    if (ends == 1) {  // the hinged end turns so that no moment acts on it
      const Number bend = variables[turns_[0] ? 2 : 5] - turn;
      return stretching + half * (near - far * far / near) * bend * bend;
    }
    const Number first = variables[2] - turn, second = variables[5] - turn;
    return stretching + half * (near * first * first + 2.0L * far * first * second + near * second * second);
  }

  static Real ValueOf(Real value) { return value; }
  template <typename Number>
  static Real ValueOf(const Number& number) {
    return number.value();
  }

  static constexpr Real kTurn = 6.283185307179586476925286766559L;

  const Beam beam_;
  std::array<bool, 2> turns_;
  std::array<std::size_t, 6> places_;  // of the variables among the values
  Vector chord_;                       // at the start
};

// W = k (theta_2 - theta_1 - angle)^2 / 2: the spring of a pin, between what turns with its nodes.
class Spring : public Element {
 public:
  Spring(const Pin& pin, const std::vector<std::size_t>& turning, std::size_t num_positions)
      : Element(Kind::kSpring, turning),
        first_(num_positions + turning.at(0)),
        second_(num_positions + turning.at(1)),
        stiffness_(pin.stiffness),
        angle_(pin.angle) {}

  bool Turns() const override { return false; }
  Real Stiffness() const override { return 0.0L; }  // against motions

  void AddEnergy(const std::vector<double>& values, Real* energy) const override {
    *energy += stiffness_ * Turn(values) * Turn(values) / 2.0L;
  }
  void AddForce(const std::vector<double>& values, std::vector<Real>* forces) const override {
    (*forces)[first_] -= stiffness_ * Turn(values);
    (*forces)[second_] += stiffness_ * Turn(values);
  }

 private:
  Real Turn(const std::vector<double>& values) const { return Real{values[second_]} - values[first_] - angle_; }

  std::size_t first_, second_;  // among the values
  Real stiffness_, angle_;
};

using Elements = std::vector<std::unique_ptr<const Element>>;
using NodeList = std::vector<std::size_t>;

void Place(const Bar& bar, const Scene&, const NodeList& nodes, const std::vector<double>& reference,
           Elements* elements) {
  elements->push_back(std::make_unique<BarElement>(bar, nodes, reference));
}

void Place(const Superelement& part, const Scene&, const NodeList& nodes, const std::vector<double>& reference,
           Elements* elements) {
  elements->push_back(std::make_unique<LinearPart>(part, nodes, reference));
}

void Place(const Beam& beam, const Scene&, const NodeList& nodes, const std::vector<double>& reference,
           Elements* elements) {
  const auto hinged = [&](std::size_t end) { return !beam.hinged.empty() && beam.hinged[end]; };
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
    elements->push_back(std::make_unique<Segment>(beam, nodes[i], nodes[i + 1], i > 0 || !hinged(0),
                                                  i + 2 < nodes.size() || !hinged(1), reference));
}

void Place(const Pin& pin, const Scene& scene, const NodeList& nodes, const std::vector<double>& reference,
           Elements* elements) {
  if (pin.stiffness == 0.0) return;
  NodeList turning;
  for (const std::size_t node : nodes) {
    const std::string& body = scene.nodes[node].body;
    const auto is_body = [&](const Node& of) { return of.name == body; };
    turning.push_back(body.empty()
                          ? node
                          : static_cast<std::size_t>(std::find_if(scene.nodes.begin(), scene.nodes.end(), is_body) -
                                                     scene.nodes.begin()));
  }
  elements->push_back(std::make_unique<Spring>(pin, turning, reference.size()));
}

// The elements of a mesh.
void Place(const Solid& solid, const Scene& scene, const NodeList& nodes, const std::vector<double>& reference,
           Elements* elements) {
  const auto material = std::find_if(scene.materials.begin(), scene.materials.end(),
                                     [&](const Material& known) { return known.name == solid.material; });
  if (material == scene.materials.end()) throw std::out_of_range("no material has the name " + solid.material);
  const auto count = static_cast<std::ptrdiff_t>(solid.NodesPerElement());
  for (auto first = nodes.begin(); first != nodes.end(); first += count)
    elements->push_back(MakeSolid(solid, *material, {first, first + count}, reference));
}

}  // namespace

std::vector<std::unique_ptr<const Element>> MakeElements(const Scene& scene, const NodeNumbers& numbers,
                                                         const std::vector<double>& reference) {
  std::vector<std::unique_ptr<const Element>> elements;
  std::vector<double> unturned = reference;
  unturned.resize(3 * scene.nodes.size());
  ForEachElementList(scene, [&](std::string_view, const auto& parts) {
    for (const auto& part : parts) {
      if constexpr (std::is_same_v<std::decay_t<decltype(part)>, Tendon>) {
        elements.push_back(MakeTendon(part, scene, numbers, unturned));
      } else {
        std::vector<std::size_t> nodes;
        for (const std::string& name : part.nodes) nodes.push_back(numbers.at(name));
        Place(part, scene, nodes, reference, &elements);
      }
    }
  });
  for (const ContactCandidate& contact : scene.contacts)
    if (contact.at_eye) elements.push_back(MakeEvenStrain(contact, scene, numbers, unturned));
  return elements;
}

std::vector<StiffnessBound> BoundStiffness(const std::vector<std::unique_ptr<const Element>>& elements,
                                           const std::vector<double>& values, std::size_t num_nodes) {
  std::vector<StiffnessBound> bounds(num_nodes);
  std::vector<double> moved = values;
  std::vector<Real> forces(values.size(), 0.0L);
  for (const auto& element : elements) {
    std::vector<std::size_t> components;
    Real extent = 0.0L;
    for (const std::size_t node : element->Nodes()) {
      components.insert(components.end(), {2 * node, 2 * node + 1});
      extent = std::max(extent, Length(NodePosition(values, node) - NodePosition(values, element->Nodes()[0])));
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
        moved[k] = values[k];
        return own;
      };
      const double there = values[k] + step;
      const std::vector<Real> before = forces_at(values[k]), after = forces_at(there);
      for (std::size_t i = 0; i < components.size(); ++i)
        visit(components[i], std::abs(static_cast<double>((after[i] - before[i]) / (Real{there} - values[k]))));
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
