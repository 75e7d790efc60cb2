#include "check/elements.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <unsupported/Eigen/AutoDiff>

namespace contact_path::check {
namespace {

constexpr double kStep = 0x1p-20;  // of difference quotients, of the extent of the element

struct BarStrain {
  Real strain;           // e
  Real rate_per_length;  // de/dl / l: by Green and Lagrange's measure a bar of no length has one, too
};

BarStrain StrainOf(StrainMeasure measure, Real length, Real rest) {
  const Real stretch = length / rest;
  switch (measure) {
    case StrainMeasure::kBiot: return {stretch - 1.0L, 1.0L / (rest * length)};
    case StrainMeasure::kGreenLagrange: return {(stretch * stretch - 1.0L) / 2.0L, 1.0L / (rest * rest)};
    case StrainMeasure::kLogarithmic: return {std::log(stretch), 1.0L / (length * length)};
  }
  constexpr Real kNaN = std::numeric_limits<Real>::quiet_NaN();
  return {kNaN, kNaN};
}

// W = EA l0 e^2 / 2.
class BarElement : public Element {
 public:
  BarElement(const Bar& bar, const std::vector<std::size_t>& nodes, const std::vector<double>& reference)
      : Element(Kind::kBar, nodes), EA_(bar.EA), rest_(bar.rest_length), measure_(bar.strain), sense_(bar.sense) {
    if (bar.rest_length == 0.0) rest_ = Length(Span(reference));
  }

  Real Stiffness() const override { return EA_ / rest_; }

  void AddEnergy(const std::vector<double>& positions, Real* energy) const override {
    const Real strain = Strain(Span(positions)).strain;
    *energy += EA_ * rest_ * strain * strain / 2.0L;
  }

  void AddForce(const std::vector<double>& positions, std::vector<Real>* forces) const override {
    const Vector span = Span(positions);
    // N = dW/dl = EA l0 e de/dl, along the bar: N / l times its span.
    const auto [strain, rate_per_length] = Strain(span);
    if (strain == 0.0L) return;
    const Real per_length = EA_ * rest_ * strain * rate_per_length;
    AddTo(forces, Nodes()[0], -per_length * span);
    AddTo(forces, Nodes()[1], per_length * span);
  }

 private:
  // 0 where the bar is slack.
  BarStrain Strain(const Vector& span) const {
    BarStrain of = StrainOf(measure_, Length(span), rest_);
    if (sense_ == BarSense::kTension) of.strain = std::max<Real>(of.strain, 0.0L);
    if (sense_ == BarSense::kCompression) of.strain = std::min<Real>(of.strain, 0.0L);
    return of;
  }

  // From the first node to the second.
  Vector Span(const std::vector<double>& positions) const {
    return NodePosition(positions, Nodes()[1]) - NodePosition(positions, Nodes()[0]);
  }

  Real EA_, rest_;
  StrainMeasure measure_;
  BarSense sense_;
};

// W = (x - X)' K (x - X) / 2.
class LinearPart : public Element {
 public:
  LinearPart(const Superelement& part, const std::vector<std::size_t>& nodes, const std::vector<double>& reference)
      : Element(Kind::kLinearPart, nodes), rest_(part.rest_positions) {
    const auto size = static_cast<Eigen::Index>(2 * nodes.size());
    using RowByRow = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    stiffness_ = Eigen::Map<const RowByRow>(part.stiffness.data(), size, size).cast<Real>();
    if (rest_.empty())
      for (const std::size_t node : nodes) rest_.insert(rest_.end(), {reference[2 * node], reference[2 * node + 1]});
  }

  bool Turns() const override { return false; }
  Real Stiffness() const override { return stiffness_.cwiseAbs().maxCoeff(); }

  void AddEnergy(const std::vector<double>& positions, Real* energy) const override {
    const Numbers displacements = Displacements(positions), forces = stiffness_.lazyProduct(displacements);
    for (Eigen::Index i = 0; i < forces.size(); ++i) *energy += forces[i] * displacements[i] / 2.0L;
  }

  void AddForce(const std::vector<double>& positions, std::vector<Real>* forces) const override {
    const Numbers elastic = stiffness_.lazyProduct(Displacements(positions));
    for (std::size_t i = 0; i < Nodes().size(); ++i) {
      const auto k = static_cast<Eigen::Index>(2 * i);
      AddTo(forces, Nodes()[i], {elastic[k], elastic[k + 1]});
    }
  }

 private:
  using Numbers = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

  // x - X of the nodes, in their order.
  Numbers Displacements(const std::vector<double>& positions) const {
    Numbers displacements(stiffness_.rows());
    for (std::size_t i = 0; i < Nodes().size(); ++i) {
      const Vector moved = NodePosition(positions, Nodes()[i]) - NodePosition(rest_, i);
      displacements.segment<2>(static_cast<Eigen::Index>(2 * i)) << moved.x, moved.y;
    }
    return displacements;
  }

  Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic> stiffness_;
  std::vector<double> rest_;  // x0, y0, x1, ...
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
    *energy += EnergyOf(VariablesIn(values));
  }

  void AddForce(const std::vector<double>& values, std::vector<Real>* forces) const override {
    using Gradient = Eigen::Matrix<Real, 6, 1>;
    const std::array<Real, 6> given = VariablesIn(values);
    std::array<Eigen::AutoDiffScalar<Gradient>, 6> variables;
    for (std::size_t i = 0; i < variables.size(); ++i) variables[i] = {given[i], 6, static_cast<int>(i)};
    const Gradient gradient = EnergyOf(variables).derivatives();
    for (std::size_t i = 0; i < variables.size(); ++i)
      if (!IsHinged(i)) (*forces)[places_[i]] += gradient[static_cast<Eigen::Index>(i)];
  }

 private:
  // A hinged end has nothing of the rotation of its node.
  bool IsHinged(std::size_t variable) const { return variable % 3 == 2 && !turns_[variable / 3]; }
  std::array<Real, 6> VariablesIn(const std::vector<double>& values) const {
    std::array<Real, 6> variables{};
    for (std::size_t i = 0; i < variables.size(); ++i)
      if (!IsHinged(i)) variables[i] = values[places_[i]];
    return variables;
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
    turn += 2.0L * kPi * std::round((mean - ValueOf(turn)) / (2.0L * kPi));
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

using NodeList = std::vector<std::size_t>;

struct ElementMaker {
  const Scene& scene;
  const NodeNumbers& numbers;
  const std::vector<double>& reference;
  std::vector<double> unturned;  // reference, and a rotation of 0 for each node
  std::vector<std::unique_ptr<const Element>> elements = {};

  NodeList NumbersOf(const std::vector<std::string>& names) const {
    NodeList nodes;
    for (const std::string& name : names) nodes.push_back(numbers.at(name));
    return nodes;
  }

  void Add(const Bar& bar) { elements.push_back(std::make_unique<BarElement>(bar, NumbersOf(bar.nodes), reference)); }

  void Add(const Superelement& part) {
    elements.push_back(std::make_unique<LinearPart>(part, NumbersOf(part.nodes), reference));
  }

  void Add(const Beam& beam) {
    const NodeList nodes = NumbersOf(beam.nodes);
    const auto hinged = [&](std::size_t end) { return !beam.hinged.empty() && beam.hinged[end]; };
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
      elements.push_back(std::make_unique<Segment>(beam, nodes[i], nodes[i + 1], i > 0 || !hinged(0),
                                                   i + 2 < nodes.size() || !hinged(1), reference));
  }

  void Add(const Tendon& tendon) { elements.push_back(MakeTendon(tendon, scene, numbers, unturned)); }

  void Add(const Pin& pin) {
    if (pin.stiffness == 0.0) return;
    NodeList turning;
    for (const std::size_t node : NumbersOf(pin.nodes)) {
      const std::string& body = scene.nodes[node].body;
      turning.push_back(body.empty() ? node : numbers.at(body));
    }
    elements.push_back(std::make_unique<Spring>(pin, turning, reference.size()));
  }

  // The elements of a mesh.
  void Add(const Solid& solid) {
    const NodeList nodes = NumbersOf(solid.nodes);
    const auto material = std::find_if(scene.materials.begin(), scene.materials.end(),
                                       [&](const Material& known) { return known.name == solid.material; });
    if (material == scene.materials.end()) throw std::out_of_range("no material has the name " + solid.material);
    const auto count = static_cast<std::ptrdiff_t>(solid.NodesPerElement());
    for (auto first = nodes.begin(); first != nodes.end(); first += count)
      elements.push_back(MakeSolid(solid, *material, {first, first + count}, reference));
  }
};

}  // namespace

std::vector<std::unique_ptr<const Element>> MakeElements(const Scene& scene, const NodeNumbers& numbers,
                                                         const std::vector<double>& reference) {
  ElementMaker maker{scene, numbers, reference, reference};
  maker.unturned.resize(3 * scene.nodes.size());
  ForEachElementList(scene, [&](std::string_view, const auto& parts) {
    for (const auto& part : parts) maker.Add(part);
  });
  for (const ContactCandidate& contact : scene.contacts)
    if (contact.at_eye) maker.elements.push_back(MakeEvenStrain(contact, scene, numbers, maker.unturned));
  return std::move(maker.elements);
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
    const auto forces_at = [&](std::size_t k, double value) {
      for (const std::size_t i : components) forces[i] = 0.0L;
      moved[k] = value;
      element->AddForce(moved, &forces);
      moved[k] = values[k];
      std::vector<Real> own;
      own.reserve(components.size());
      for (const std::size_t i : components) own.push_back(forces[i]);
      return own;
    };
    double largest = 0.0;
    for (const std::size_t k : components) {
      const double there = values[k] + step;
      const std::vector<Real> before = forces_at(k, values[k]), after = forces_at(k, there);
      for (std::size_t i = 0; i < components.size(); ++i) {
        const double rate = std::abs(static_cast<double>((after[i] - before[i]) / (Real{there} - values[k])));
        largest = std::max(largest, rate);
        StiffnessBound& bound = bounds[components[i] / 2];
        if (!element->Turns()) (components[i] % 2 == 0 ? bound.x : bound.y) += rate;
      }
    }
    if (element->Turns())
      for (const std::size_t node : element->Nodes()) bounds[node].any += largest;
  }
  return bounds;
}

}  // namespace contact_path::check
