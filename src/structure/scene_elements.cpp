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
#include "contact_path/scene/tendon_route.h"
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

// A tendon or a piece of one, whose forces are asked for: W = EA (l - a)^2 / (2 a) of the length l along its nodes and
// rollers, where that is > a. Its nodes, then those whose x tells what has slid in or out, then the bodies with which
// the rollers at its ends turn.
class TendonElement : public Element {
 public:
  // sense: 1 of what slides in, -1 of what slides out; start: its x at the start.
  struct Slide {
    double sense, start;
  };
  // rest: a without what has slid. by_turn: of each of the bodies [length/rad].
  TendonElement(double EA, double rest, std::vector<RolledSpan> spans, std::vector<Slide> slides,
                std::vector<double> by_turn)
      : EA_(EA),
        rest_(rest),
        spans_(std::move(spans)),
        slides_(std::move(slides)),
        by_turn_(std::move(by_turn)),
        dofs_(PositionsOfNodes(static_cast<int>(spans_.size() + 1 + slides_.size()))) {
    for (std::size_t k = 0; k < by_turn_.size(); ++k)
      dofs_.push_back({static_cast<int>(spans_.size() + 1 + slides_.size() + k), Field::kRotation, 0});
  }

  const std::vector<LocalDof>& Dofs() const override { return dofs_; }
  double Energy(const Eigen::Ref<const Eigen::VectorXd>& x) const override {
    const double tension = Tension(x);
    return 0.5 * Rest(x) * tension * tension / EA_;
  }
  void Force(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> force) const override {
    const double tension = Tension(x);
    force.setZero();
    if (!(tension > 0.0)) return;
    Eigen::Index k = 0;
    for (const RolledSpan& span : spans_) {
      const Eigen::Vector2d pull = tension * span.Of(x.segment<2>(k + 2) - x.segment<2>(k), 0.0).tangent.normalized();
      force.segment<2>(k) -= pull;
      force.segment<2>(k + 2) += pull;
      k += 2;
    }
    k = FirstSlide();
    for (const Slide& slide : slides_) {
      force[k] = -slide.sense * tension * (1.0 + 0.5 * tension / EA_);
      k += 2;
    }
    for (const double by_turn : by_turn_) force[k++] = by_turn * tension;
  }
  // Paths are traced with its laws (law/slack_bar.h, law/tendon_span.h).
  void Tangent(const Eigen::Ref<const Eigen::VectorXd>&, Eigen::Ref<Eigen::MatrixXd> tangent) const override {
    tangent.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  void TangentDerivative(const Eigen::Ref<const Eigen::VectorXd>&, const Eigen::Ref<const Eigen::VectorXd>&,
                         Eigen::Ref<Eigen::MatrixXd> derivative) const override {
    derivative.setConstant(std::numeric_limits<double>::quiet_NaN());
  }

 private:
  Eigen::Index FirstSlide() const { return 2 * static_cast<Eigen::Index>(spans_.size() + 1); }
  double Rest(const Eigen::Ref<const Eigen::VectorXd>& x) const {
    double rest = rest_;
    Eigen::Index k = FirstSlide();
    for (const Slide& slide : slides_) {
      rest += slide.sense * (x[k] - slide.start);
      k += 2;
    }
    return rest;
  }
  double Tension(const Eigen::Ref<const Eigen::VectorXd>& x) const {
    double length = 0.0;
    Eigen::Index k = 0;
    for (const RolledSpan& span : spans_) {
      const RolledSpan::At at = span.Of(x.segment<2>(k + 2) - x.segment<2>(k), 0.0);
      length += at.tangent.norm() + at.arcs;
      k += 2;
    }
    k = FirstSlide() + 2 * static_cast<Eigen::Index>(slides_.size());
    for (const double by_turn : by_turn_) length += by_turn * x[k++];
    const double rest = Rest(x);
    return EA_ / rest * std::max(length - rest, 0.0);
  }

  double EA_, rest_;
  std::vector<RolledSpan> spans_;
  std::vector<Slide> slides_;
  std::vector<double> by_turn_;
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

void Place(const Tendon& tendon, std::vector<int> nodes, const Scene& scene, const SceneIndex& index,
           const std::vector<double>& reference, std::vector<PlacedElement>* elements) {
  const TendonRoute route = RouteOf(tendon, PointsOf(nodes, reference));
  std::vector<TendonElement::Slide> slides;
  for (const bool in : {true, false})
    if (const std::string& slide = tendon.slides[in ? 0 : 1]; !slide.empty()) {
      const std::size_t node = index.Node(slide);
      slides.push_back({in ? 1.0 : -1.0, reference[2 * node]});
      nodes.push_back(static_cast<int>(node));
    }
  std::vector<double> by_turn;
  for (const std::size_t end : {std::size_t{0}, std::size_t{1}})
    if (const std::string& body = BodyOfDrum(tendon, end, scene, index); !body.empty()) {
      by_turn.push_back(route.by_turn[end]);
      nodes.push_back(static_cast<int>(index.Node(body)));
    }
  elements->push_back(
      {std::make_unique<TendonElement>(tendon.EA, tendon.rest_length > 0.0 ? tendon.rest_length : route.length,
                                       route.spans, std::move(slides), std::move(by_turn)),
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
  std::vector<int> nodes, bodies;
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
    const Node &first = scene.nodes[index.Node(tendon.nodes[0])], &second = scene.nodes[index.Node(tendon.nodes[1])];
    const TendonRoute route = RouteOf(tendon, {{first.x, first.y}, {second.x, second.y}});
    of.rolled = route.spans[0];
    for (std::size_t k = 0; k < 2; ++k)
      if (const std::string& name = BodyOfDrum(tendon, k, scene, index); !name.empty()) {
        const auto body = static_cast<int>(index.Node(name));
        const auto known = std::find(bodies.begin(), bodies.end(), body);
        of.drums.push_back({static_cast<int>(known - bodies.begin()), route.by_turn[k]});
        if (known == bodies.end()) bodies.push_back(body);
      }
    for (std::size_t k = 0; k < 2; ++k) {
      of.nodes[k] = local(tendon.nodes[k]);
      if (const std::string& slide = tendon.slides[k]; !slide.empty())
        of.slides.push_back({local(slide), scene.nodes[index.Node(slide)].x, k == 0 ? 1.0 : -1.0});
    }
    return of;
  };
  const EvenStrain::Piece before = piece(1), behind = piece(0);
  const double stiffness = tolerances::kRootOfRounding * EA * std::min(before.rest, behind.rest);
  auto element = std::make_unique<EvenStrain>(stiffness, before, behind, static_cast<int>(nodes.size()),
                                              static_cast<int>(bodies.size()));
  nodes.insert(nodes.end(), bodies.begin(), bodies.end());
  return {std::move(element), nodes};
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
          Place(part, std::move(nodes), scene, index, reference, &elements);
        else
          Place(part, std::move(nodes), reference, &elements);
      }
    }
  });
  for (const ContactCandidate& contact : scene.contacts)
    if (contact.at_eye) elements.push_back(EvenStrainAt(contact, scene, index));
  return elements;
}

}  // namespace contact_path
