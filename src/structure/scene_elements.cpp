#include "contact_path/structure/scene_elements.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "contact_path/scene/expand.h"
#include "contact_path/structure/bar.h"
#include "contact_path/structure/beam.h"
#include "contact_path/structure/even_strain.h"
#include "contact_path/structure/material.h"
#include "contact_path/structure/solid.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

// Linear part: W = (x - X)' K (x - X) / 2 with constant symmetric K.
class LinearSuperelement : public Element {
 public:
  // stiffness K: 2n x 2n, symmetric [force/length]; initial positions X: 2n [length].
  LinearSuperelement(Eigen::MatrixXd stiffness, Eigen::VectorXd initial)
      : stiffness_(std::move(stiffness)),
        initial_(std::move(initial)),
        dofs_(PositionsOfNodes(static_cast<int>(initial_.size() / kPositionComponents))) {}

  const std::vector<LocalDof>& Dofs() const override { return dofs_; }
  bool Linear() const override { return true; }
  double Energy(const Eigen::Ref<const Eigen::VectorXd>& x) const override {
    return 0.5 * (x - initial_).dot(stiffness_ * (x - initial_));
  }
  void Force(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> force) const override {
    force.setZero();
    for (Eigen::Index i = 0; i < x.size(); ++i) force += (x[i] - initial_[i]) * stiffness_.col(i);
  }
  void Tangent(const Eigen::Ref<const Eigen::VectorXd>&, Eigen::Ref<Eigen::MatrixXd> tangent) const override {
    tangent = stiffness_;
  }
  void TangentDerivative(const Eigen::Ref<const Eigen::VectorXd>&, const Eigen::Ref<const Eigen::VectorXd>&,
                         Eigen::Ref<Eigen::MatrixXd> derivative) const override {
    derivative.setZero();
  }

 private:
  Eigen::MatrixXd stiffness_;
  Eigen::VectorXd initial_;
  std::vector<LocalDof> dofs_;
};

// W = EA (l - l0)^2 / (2 l0) of the length l along the nodes, where it is > l0: of a tendon, whose forces are asked
// for.
class TendonElement : public Element {
 public:
  TendonElement(double EA, double rest_length, int num_nodes)
      : stiffness_(EA / rest_length), rest_length_(rest_length), dofs_(PositionsOfNodes(num_nodes)) {}

  const std::vector<LocalDof>& Dofs() const override { return dofs_; }
  double Energy(const Eigen::Ref<const Eigen::VectorXd>& x) const override {
    const double longer = Longer(x);
    return 0.5 * stiffness_ * longer * longer;
  }
  void Force(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> force) const override {
    force.setZero();
    AddPull(x, stiffness_ * Longer(x), force);
  }
  void Tangent(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::MatrixXd> tangent) const override {
    tangent.setZero();
    const double tension = stiffness_ * Longer(x);
    if (!(tension > 0.0)) return;
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(x.size());
    AddPull(x, 1.0, gradient);
    tangent = stiffness_ * gradient * gradient.transpose();
    ForEachSpan(x, [&](Eigen::Index k, const Eigen::Vector2d& direction, double length) {
      const Eigen::Matrix2d across =
          tension / length * (Eigen::Matrix2d::Identity() - direction * direction.transpose());
      tangent.block<2, 2>(k, k) += across;
      tangent.block<2, 2>(k + 2, k + 2) += across;
      tangent.block<2, 2>(k, k + 2) -= across;
      tangent.block<2, 2>(k + 2, k) -= across;
    });
  }
  // Paths are traced with its law (law/slack_bar.h).
  void TangentDerivative(const Eigen::Ref<const Eigen::VectorXd>&, const Eigen::Ref<const Eigen::VectorXd>&,
                         Eigen::Ref<Eigen::MatrixXd> derivative) const override {
    derivative.setConstant(std::numeric_limits<double>::quiet_NaN());
  }

 private:
  template <typename Visit>
  static void ForEachSpan(const Eigen::Ref<const Eigen::VectorXd>& x, Visit&& visit) {
    for (Eigen::Index k = 0; k + 2 < x.size(); k += 2) {
      const Eigen::Vector2d span = x.segment<2>(k + 2) - x.segment<2>(k);
      if (const double length = span.norm(); length > 0.0) visit(k, span / length, length);
    }
  }
  // By how much than l0; 0 where it is slack.
  double Longer(const Eigen::Ref<const Eigen::VectorXd>& x) const {
    double sum = 0.0;
    ForEachSpan(x, [&](Eigen::Index, const Eigen::Vector2d&, double length) { sum += length; });
    return std::max(sum - rest_length_, 0.0);
  }
  static void AddPull(const Eigen::Ref<const Eigen::VectorXd>& x, double tension, Eigen::Ref<Eigen::VectorXd> force) {
    ForEachSpan(x, [&](Eigen::Index k, const Eigen::Vector2d& direction, double) {
      force.segment<2>(k) -= tension * direction;
      force.segment<2>(k + 2) += tension * direction;
    });
  }

  double stiffness_, rest_length_;
  std::vector<LocalDof> dofs_;
};

// A piece of a tendon with friction, whose tension is asked for: of two nodes, and then of those whose x tells what has
// slid in or out.
class PieceElement : public Element {
 public:
  // senses: 1 of what slides in, -1 of what slides out; at the start: at `starts`.
  PieceElement(double EA, double rest_length, std::vector<double> senses, std::vector<double> starts)
      : EA_(EA),
        rest_length_(rest_length),
        senses_(std::move(senses)),
        starts_(std::move(starts)),
        dofs_(PositionsOfNodes(2 + static_cast<int>(senses_.size()))) {}

  const std::vector<LocalDof>& Dofs() const override { return dofs_; }
  double Energy(const Eigen::Ref<const Eigen::VectorXd>& x) const override {
    const double tension = Tension(x);
    return 0.5 * Rest(x) * tension * tension / EA_;
  }
  void Force(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> force) const override {
    const double tension = Tension(x);
    const Eigen::Vector2d span = x.segment<2>(2) - x.head<2>();
    force.setZero();
    if (!(tension > 0.0)) return;
    force.head<2>() = -tension * span.normalized();
    force.segment<2>(2) = tension * span.normalized();
    for (std::size_t k = 0; k < senses_.size(); ++k)
      force[4 + 2 * static_cast<Eigen::Index>(k)] = -senses_[k] * tension * (1.0 + 0.5 * tension / EA_);
  }
  // Paths are traced with its law (law/tendon_span.h).
  void Tangent(const Eigen::Ref<const Eigen::VectorXd>&, Eigen::Ref<Eigen::MatrixXd> tangent) const override {
    tangent.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  void TangentDerivative(const Eigen::Ref<const Eigen::VectorXd>&, const Eigen::Ref<const Eigen::VectorXd>&,
                         Eigen::Ref<Eigen::MatrixXd> derivative) const override {
    derivative.setConstant(std::numeric_limits<double>::quiet_NaN());
  }

 private:
  double Rest(const Eigen::Ref<const Eigen::VectorXd>& x) const {
    double rest = rest_length_;
    for (std::size_t k = 0; k < senses_.size(); ++k)
      rest += senses_[k] * (x[4 + 2 * static_cast<Eigen::Index>(k)] - starts_[k]);
    return rest;
  }
  double Tension(const Eigen::Ref<const Eigen::VectorXd>& x) const {
    return EA_ * std::max((x.segment<2>(2) - x.head<2>()).norm() / Rest(x) - 1.0, 0.0);
  }

  double EA_, rest_length_;
  std::vector<double> senses_, starts_;
  std::vector<LocalDof> dofs_;
};

// W = k (theta_1 - theta_0 - angle)^2 / 2 of the rotations of two nodes: the spring of a pin.
class RotationalSpring : public Element {
 public:
  RotationalSpring(double stiffness, double angle)
      : stiffness_(stiffness), angle_(angle), dofs_({{0, Field::kRotation, 0}, {1, Field::kRotation, 0}}) {}

  const std::vector<LocalDof>& Dofs() const override { return dofs_; }
  bool Linear() const override { return true; }
  double Energy(const Eigen::Ref<const Eigen::VectorXd>& x) const override {
    return 0.5 * stiffness_ * Turn(x) * Turn(x);
  }
  void Force(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> force) const override {
    force[1] = stiffness_ * Turn(x);
    force[0] = -force[1];
  }
  void Tangent(const Eigen::Ref<const Eigen::VectorXd>&, Eigen::Ref<Eigen::MatrixXd> tangent) const override {
    tangent << stiffness_, -stiffness_, -stiffness_, stiffness_;
  }
  void TangentDerivative(const Eigen::Ref<const Eigen::VectorXd>&, const Eigen::Ref<const Eigen::VectorXd>&,
                         Eigen::Ref<Eigen::MatrixXd> derivative) const override {
    derivative.setZero();
  }

 private:
  double Turn(const Eigen::Ref<const Eigen::VectorXd>& x) const { return x[1] - x[0] - angle_; }

  double stiffness_, angle_;
  std::vector<LocalDof> dofs_;
};

// Places of the nodes of an element in the reference shape.
Eigen::VectorXd PositionsOf(const std::vector<int>& nodes, const std::vector<double>& reference) {
  Eigen::VectorXd positions(2 * static_cast<Eigen::Index>(nodes.size()));
  Eigen::Index k = 0;
  for (const int node : nodes) {
    positions[k++] = reference[2 * static_cast<std::size_t>(node)];
    positions[k++] = reference[2 * static_cast<std::size_t>(node) + 1];
  }
  return positions;
}

void Place(const Bar& bar, std::vector<int> nodes, const std::vector<double>& reference,
           std::vector<PlacedElement>* elements) {
  const Eigen::Vector4d ends = PositionsOf(nodes, reference);
  const double distance = std::hypot(ends[2] - ends[0], ends[3] - ends[1]);
  const double rest_length = bar.rest_length > 0.0 ? bar.rest_length : distance;
  elements->push_back({std::make_unique<BarElement>(bar.EA, rest_length, bar.strain, bar.sense), std::move(nodes)});
}

void Place(const Tendon& tendon, std::vector<int> nodes, const std::vector<double>& reference,
           std::vector<PlacedElement>* elements) {
  const Eigen::VectorXd places = PositionsOf(nodes, reference);
  if (tendon.IsPiece()) {
    std::vector<double> senses, starts;
    for (const bool in : {true, false})
      if (!tendon.slides[in ? 0 : 1].empty()) {
        starts.push_back(places[4 + 2 * static_cast<Eigen::Index>(senses.size())]);
        senses.push_back(in ? 1.0 : -1.0);
      }
    elements->push_back(
        {std::make_unique<PieceElement>(tendon.EA, tendon.rest_length, std::move(senses), std::move(starts)),
         std::move(nodes)});
    return;
  }
  double length = 0.0;
  for (Eigen::Index k = 0; k + 2 < places.size(); k += 2)
    length += (places.segment<2>(k + 2) - places.segment<2>(k)).norm();
  elements->push_back(
      {std::make_unique<TendonElement>(tendon.EA, tendon.rest_length > 0.0 ? tendon.rest_length : length,
                                       static_cast<int>(nodes.size())),
       std::move(nodes)});
}

void Place(const Superelement& part, std::vector<int> nodes, const std::vector<double>& reference,
           std::vector<PlacedElement>* elements) {
  const auto size = static_cast<Eigen::Index>(2 * nodes.size());
  Eigen::VectorXd rest = PositionsOf(nodes, reference);
  if (!part.rest_positions.empty()) rest = Eigen::Map<const Eigen::VectorXd>(part.rest_positions.data(), size);
  const Eigen::Map<const Eigen::MatrixXd> stiffness(part.stiffness.data(), size, size);
  elements->push_back({std::make_unique<LinearSuperelement>(0.5 * (stiffness + stiffness.transpose()), std::move(rest)),
                       std::move(nodes)});
}

// One element for each segment. nodes: of all segments.
void Place(const Beam& beam, const std::vector<int>& nodes, const std::vector<double>& reference,
           std::vector<PlacedElement>* elements) {
  const BeamSegment::Stiffness stiffness = {beam.EA, beam.EI, beam.GA};
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    const Eigen::Vector4d ends = PositionsOf({nodes[i], nodes[i + 1]}, reference);
    const Eigen::Vector2d chord = ends.tail<2>() - ends.head<2>();
    elements->push_back({std::make_unique<BeamSegment>(stiffness, chord, !TurnsNode(beam, i), !TurnsNode(beam, i + 1)),
                         {nodes[i], nodes[i + 1]}});
  }
}

PlacedElement EvenStrainAt(const ContactCandidate& eye, const Scene& scene, const SceneIndex& index) {
  std::vector<int> nodes;
  const auto local = [&](const std::string& name) {
    const auto node = static_cast<int>(index.Node(name));
    const auto found = std::find(nodes.begin(), nodes.end(), node);
    const auto place = static_cast<int>(found - nodes.begin());
    if (found == nodes.end()) nodes.push_back(node);
    return place;
  };
  double EA = 0.0;
  const auto piece = [&](std::size_t end) {
    const Tendon& tendon = *std::find_if(scene.tendons.begin(), scene.tendons.end(),
                                         [&](const Tendon& known) { return known.slides[end] == eye.node; });
    EA = tendon.EA;
    EvenStrain::Piece of;
    of.rest = tendon.rest_length;
    for (std::size_t k = 0; k < 2; ++k) {
      of.nodes[k] = local(tendon.nodes[k]);
      if (const std::string& slide = tendon.slides[k]; !slide.empty())
        of.slides.push_back({local(slide), scene.nodes[index.Node(slide)].x, k == 0 ? 1.0 : -1.0});
    }
    return of;
  };
  const EvenStrain::Piece before = piece(1), behind = piece(0);
  const double stiffness = tolerances::kRootOfRounding * EA * std::min(before.rest, behind.rest);
  return {std::make_unique<EvenStrain>(stiffness, before, behind, static_cast<int>(nodes.size())), nodes};
}

}  // namespace

std::vector<PlacedElement> MakeSolidElements(const Solid& solid, const Scene& scene, const SceneIndex& index,
                                             const std::vector<double>& reference) {
  const PlaneMaterial material(scene.materials[index.Material(solid.material)], solid.plane);
  std::vector<PlacedElement> elements;
  std::vector<int> nodes;
  for (const std::string& name : solid.nodes) {
    nodes.push_back(static_cast<int>(index.Node(name)));
    if (nodes.size() < solid.NodesPerElement()) continue;
    const Eigen::VectorXd positions = PositionsOf(nodes, reference);
    std::unique_ptr<const Element> element =
        MakeSolidElement(material, solid.Thickness(), {positions.begin(), positions.end()});
    elements.push_back({std::move(element), std::exchange(nodes, {})});
  }
  return elements;
}

std::vector<PlacedElement> MakeElements(const Scene& scene, const SceneIndex& index,
                                        const std::vector<double>& reference, OneSided bars) {
  std::vector<PlacedElement> elements;
  ForEachElementList(scene, [&](std::string_view, const auto& parts) {
    for (const auto& part : parts) {
      if constexpr (std::is_same_v<std::decay_t<decltype(part)>, Solid>) {
        for (PlacedElement& own : MakeSolidElements(part, scene, index, reference)) elements.push_back(std::move(own));
      } else if constexpr (std::is_same_v<std::decay_t<decltype(part)>, Pin>) {
        if (part.stiffness == 0.0) continue;
        std::vector<int> nodes;
        for (const std::string& name : part.nodes)
          nodes.push_back(static_cast<int>(index.Node(TurnsWith(scene.nodes[index.Node(name)]))));
        elements.push_back({std::make_unique<RotationalSpring>(part.stiffness, part.angle), std::move(nodes)});
      } else {
        if constexpr (std::is_same_v<std::decay_t<decltype(part)>, Bar>)
          if (part.sense != BarSense::kBoth && bars == OneSided::kLaws) continue;
        if constexpr (std::is_same_v<std::decay_t<decltype(part)>, Tendon>)
          if (bars == OneSided::kLaws) continue;
        std::vector<int> nodes;
        for (const std::string& name : part.nodes) nodes.push_back(static_cast<int>(index.Node(name)));
        if constexpr (std::is_same_v<std::decay_t<decltype(part)>, Tendon>)
          for (const std::string& slide : part.slides)
            if (!slide.empty()) nodes.push_back(static_cast<int>(index.Node(slide)));
        Place(part, std::move(nodes), reference, &elements);
      }
    }
  });
  for (const ContactCandidate& contact : scene.contacts)
    if (contact.at_eye) elements.push_back(EvenStrainAt(contact, scene, index));
  return elements;
}

}  // namespace contact_path
