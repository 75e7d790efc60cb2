#include "contact_path/structure/scene_elements.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
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
  double Energy(const Values& x) const override { return 0.5 * (x - initial_).dot(stiffness_ * (x - initial_)); }
  void Force(const Values& x, Eigen::Ref<Eigen::VectorXd> force) const override {
    force.setZero();
    for (Eigen::Index i = 0; i < x.size(); ++i) force += (x[i] - initial_[i]) * stiffness_.col(i);
  }
  void Tangent(const Values&, Eigen::Ref<Eigen::MatrixXd> tangent) const override { tangent = stiffness_; }
  void TangentDerivative(const Values&, const Values&, Eigen::Ref<Eigen::MatrixXd> derivative) const override {
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
  // x: a value of the element; sense: 1 of what slides in, -1 of what slides out; start: x at the start.
  struct Slide {
    Eigen::Index x;
    double sense, start;
  };
  // turn: a value of the element, of a body [rad]; by_turn: [length/rad].
  struct Drum {
    Eigen::Index turn;
    double by_turn;
  };
  // rest: a without what has slid.
  TendonElement(double EA, double rest, std::vector<RolledSpan> spans, std::vector<Slide> slides,
                std::vector<Drum> drums)
      : EA_(EA),
        rest_(rest),
        spans_(std::move(spans)),
        slides_(std::move(slides)),
        drums_(std::move(drums)),
        dofs_(PositionsOfNodes(static_cast<int>(spans_.size() + 1 + slides_.size()))) {
    for (std::size_t k = 0; k < drums_.size(); ++k)
      dofs_.push_back({static_cast<int>(spans_.size() + 1 + slides_.size() + k), Field::kRotation, 0});
  }

  const std::vector<LocalDof>& Dofs() const override { return dofs_; }
  double Energy(const Values& x) const override {
    const double tension = Tension(x);
    return 0.5 * Rest(x) * tension * tension / EA_;
  }
  void Force(const Values& x, Eigen::Ref<Eigen::VectorXd> force) const override {
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
    for (const Slide& slide : slides_) force[slide.x] = -slide.sense * tension * (1.0 + 0.5 * tension / EA_);
    for (const Drum& drum : drums_) force[drum.turn] = drum.by_turn * tension;
  }
  // Paths are traced with its laws (law/slack_bar.h, law/tendon_span.h).
  void Tangent(const Values&, Eigen::Ref<Eigen::MatrixXd> tangent) const override {
    tangent.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  void TangentDerivative(const Values&, const Values&, Eigen::Ref<Eigen::MatrixXd> derivative) const override {
    derivative.setConstant(std::numeric_limits<double>::quiet_NaN());
  }

 private:
  double Rest(const Values& x) const {
    double rest = rest_;
    for (const Slide& slide : slides_) rest += slide.sense * (x[slide.x] - slide.start);
    return rest;
  }
  double Tension(const Values& x) const {
    double length = 0.0;
    Eigen::Index k = 0;
    for (const RolledSpan& span : spans_) {
      const RolledSpan::At at = span.Of(x.segment<2>(k + 2) - x.segment<2>(k), 0.0);
      length += at.tangent.norm() + at.arcs;
      k += 2;
    }
    for (const Drum& drum : drums_) length += drum.by_turn * x[drum.turn];
    const double rest = Rest(x);
    return EA_ / rest * std::max(length - rest, 0.0);
  }

  double EA_, rest_;
  std::vector<RolledSpan> spans_;
  std::vector<Slide> slides_;
  std::vector<Drum> drums_;
  std::vector<LocalDof> dofs_;
};

// W = k (theta_1 - theta_0 - angle)^2 / 2 of the rotations of two nodes: the spring of a pin.
class RotationalSpring : public Element {
 public:
  RotationalSpring(double stiffness, double angle)
      : stiffness_(stiffness), angle_(angle), dofs_({{0, Field::kRotation, 0}, {1, Field::kRotation, 0}}) {}

  const std::vector<LocalDof>& Dofs() const override { return dofs_; }
  bool Linear() const override { return true; }
  double Energy(const Values& x) const override { return 0.5 * stiffness_ * Turn(x) * Turn(x); }
  void Force(const Values& x, Eigen::Ref<Eigen::VectorXd> force) const override {
    force[1] = stiffness_ * Turn(x);
    force[0] = -force[1];
  }
  void Tangent(const Values&, Eigen::Ref<Eigen::MatrixXd> tangent) const override {
    tangent << stiffness_, -stiffness_, -stiffness_, stiffness_;
  }
  void TangentDerivative(const Values&, const Values&, Eigen::Ref<Eigen::MatrixXd> derivative) const override {
    derivative.setZero();
  }

 private:
  double Turn(const Values& x) const { return x[1] - x[0] - angle_; }

  double stiffness_, angle_;
  std::vector<LocalDof> dofs_;
};

// Adds the elements of parts one after the other.
class ElementList {
 public:
  ElementList(const Scene& scene, const SceneIndex& index, const std::vector<double>& reference, OneSided bars)
      : scene_(scene), index_(index), reference_(reference), bars_(bars) {}

  void Add(const Bar& bar) {
    if (bar.sense != BarSense::kBoth && bars_ == OneSided::kLaws) return;
    const std::vector<int> nodes = Numbers(bar.nodes);
    const Eigen::Vector4d ends = PositionsOf(nodes);
    const double distance = std::hypot(ends[2] - ends[0], ends[3] - ends[1]);
    const double rest_length = bar.rest_length > 0.0 ? bar.rest_length : distance;
    Put(std::make_unique<BarElement>(bar.EA, rest_length, bar.strain, bar.sense), nodes);
  }

  void Add(const Tendon& tendon) {
    if (bars_ == OneSided::kLaws) return;
    std::vector<int> nodes = Numbers(tendon.nodes);
    const TendonRoute route = RouteOf(tendon, PointsOf(nodes, reference_));
    std::vector<TendonElement::Slide> slides;
    for (const bool in : {true, false})
      if (const std::string& slide = tendon.slides[in ? 0 : 1]; !slide.empty()) {
        slides.push_back(
            {2 * static_cast<Eigen::Index>(nodes.size()), in ? 1.0 : -1.0, reference_[2 * index_.Node(slide)]});
        nodes.push_back(Number(slide));
      }
    std::vector<TendonElement::Drum> drums;
    Eigen::Index turn = 2 * static_cast<Eigen::Index>(nodes.size());
    for (const std::size_t end : {std::size_t{0}, std::size_t{1}})
      if (const std::string& body = BodyOfDrum(tendon, end, scene_, index_); !body.empty()) {
        drums.push_back({turn++, route.by_turn[end]});
        nodes.push_back(Number(body));
      }
    const double rest = tendon.rest_length > 0.0 ? tendon.rest_length : route.length;
    Put(std::make_unique<TendonElement>(tendon.EA, rest, route.spans, std::move(slides), std::move(drums)), nodes);
  }

  void Add(const Superelement& part) {
    const std::vector<int> nodes = Numbers(part.nodes);
    const auto size = static_cast<Eigen::Index>(2 * nodes.size());
    Eigen::VectorXd rest = PositionsOf(nodes);
    if (!part.rest_positions.empty()) rest = Eigen::Map<const Eigen::VectorXd>(part.rest_positions.data(), size);
    const Eigen::Map<const Eigen::MatrixXd> stiffness(part.stiffness.data(), size, size);
    Put(std::make_unique<LinearSuperelement>(0.5 * (stiffness + stiffness.transpose()), std::move(rest)), nodes);
  }

  // One element for each segment.
  void Add(const Beam& beam) {
    const BeamSegment::Stiffness stiffness = {beam.EA, beam.EI, beam.GA};
    const std::vector<int> nodes = Numbers(beam.nodes);
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
      const Eigen::Vector4d ends = PositionsOf({nodes[i], nodes[i + 1]});
      const Eigen::Vector2d chord = ends.tail<2>() - ends.head<2>();
      Put(std::make_unique<BeamSegment>(stiffness, chord, !TurnsNode(beam, i), !TurnsNode(beam, i + 1)),
          {nodes[i], nodes[i + 1]});
    }
  }

  void Add(const Solid& solid) {
    const PlaneMaterial material(scene_.materials[index_.Material(solid.material)], solid.plane);
    std::vector<int> nodes;
    for (const std::string& name : solid.nodes) {
      nodes.push_back(Number(name));
      if (nodes.size() < solid.NodesPerElement()) continue;
      const Eigen::VectorXd positions = PositionsOf(nodes);
      Put(MakeSolidElement(material, solid.Thickness(), {positions.begin(), positions.end()}),
          std::exchange(nodes, {}));
    }
  }

  void Add(const Pin& pin) {
    if (pin.stiffness == 0.0) return;
    std::vector<int> nodes;
    for (const std::string& name : pin.nodes) nodes.push_back(Number(TurnsWith(scene_.nodes[index_.Node(name)])));
    Put(std::make_unique<RotationalSpring>(pin.stiffness, pin.angle), std::move(nodes));
  }

  void AddEvenStrain(const ContactCandidate& eye) {
    std::vector<int> nodes, bodies;
    const auto local = [&](const std::string& name, std::vector<int>* among) {
      const int number = Number(name);
      const auto found = std::find(among->begin(), among->end(), number);
      const auto place = static_cast<int>(found - among->begin());
      if (found == among->end()) among->push_back(number);
      return place;
    };
    const auto piece = [&](const Tendon& tendon) {
      EvenStrain::Piece of;
      of.rest = tendon.rest_length;
      const TendonRoute route = RouteIn(scene_, index_, tendon);
      of.rolled = route.spans[0];
      for (std::size_t k = 0; k < 2; ++k) {
        if (const std::string& body = BodyOfDrum(tendon, k, scene_, index_); !body.empty())
          of.drums.push_back({local(body, &bodies), route.by_turn[k]});
        of.nodes[k] = local(tendon.nodes[k], &nodes);
        if (const std::string& slide = tendon.slides[k]; !slide.empty())
          of.slides.push_back({local(slide, &nodes), scene_.nodes[index_.Node(slide)].x, k == 0 ? 1.0 : -1.0});
      }
      return of;
    };
    const EvenStrain::Piece before = piece(PieceAtEye(scene_, eye.node, 1)),
                            behind = piece(PieceAtEye(scene_, eye.node, 0));
    const double stiffness =
        tolerances::kRootOfRounding * PieceAtEye(scene_, eye.node, 0).EA * std::min(before.rest, behind.rest);
    auto element = std::make_unique<EvenStrain>(stiffness, before, behind, static_cast<int>(nodes.size()),
                                                static_cast<int>(bodies.size()));
    nodes.insert(nodes.end(), bodies.begin(), bodies.end());
    Put(std::move(element), std::move(nodes));
  }

  std::vector<PlacedElement> Take() { return std::move(elements_); }

 private:
  int Number(const std::string& node) const { return static_cast<int>(index_.Node(node)); }
  std::vector<int> Numbers(const std::vector<std::string>& nodes) const {
    std::vector<int> numbers;
    numbers.reserve(nodes.size());
    for (const std::string& node : nodes) numbers.push_back(Number(node));
    return numbers;
  }
  // In the reference shape.
  Eigen::VectorXd PositionsOf(const std::vector<int>& nodes) const {
    Eigen::VectorXd positions(2 * static_cast<Eigen::Index>(nodes.size()));
    Eigen::Index k = 0;
    for (const int node : nodes) {
      positions[k++] = reference_[2 * static_cast<std::size_t>(node)];
      positions[k++] = reference_[2 * static_cast<std::size_t>(node) + 1];
    }
    return positions;
  }
  void Put(std::unique_ptr<const Element> element, std::vector<int> nodes) {
    elements_.push_back({std::move(element), std::move(nodes)});
  }

  const Scene& scene_;
  const SceneIndex& index_;
  const std::vector<double>& reference_;
  OneSided bars_;
  std::vector<PlacedElement> elements_;
};

}  // namespace

std::vector<PlacedElement> MakeSolidElements(const Solid& solid, const Scene& scene, const SceneIndex& index,
                                             const std::vector<double>& reference) {
  ElementList elements(scene, index, reference, OneSided::kLaws);
  elements.Add(solid);
  return elements.Take();
}

std::vector<PlacedElement> MakeElements(const Scene& scene, const SceneIndex& index,
                                        const std::vector<double>& reference, OneSided bars) {
  ElementList elements(scene, index, reference, bars);
  ForEachElementList(scene, [&](std::string_view, const auto& parts) {
    for (const auto& part : parts) elements.Add(part);
  });
  for (const ContactCandidate& contact : scene.contacts)
    if (contact.at_eye) elements.AddEvenStrain(contact);
  return elements.Take();
}

}  // namespace contact_path
