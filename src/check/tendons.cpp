// Tendons and their eyes as the check sees them.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "check/contacts.h"
#include "check/elements.h"
#include "check/plane.h"

namespace contact_path::check {
namespace {

// A tendon, or a piece of one: its way by the points where it touches its rollers and the arcs between them.
class String {
 public:
  String(const Tendon& tendon, const Scene& scene, const NodeNumbers& numbers, const std::vector<double>& reference)
      : EA_(tendon.EA), rest_(tendon.rest_length), num_positions_(2 * scene.nodes.size()) {
    for (const std::string& node : tendon.nodes) nodes_.push_back(numbers.at(node));
    const std::size_t last = nodes_.size() - 1;
    for (std::size_t i = 0; i <= last; ++i)
      radii_.push_back(tendon.radii.empty() ? 0.0L : tendon.turns[i] < 0.0 ? -tendon.radii[i] : tendon.radii[i]);
    for (std::size_t i = 0; i < last; ++i) at_start_.push_back(SpanAt(reference, i).direction);
    for (std::size_t i = 0; i <= last; ++i) {
      Real angle = 0.0L;
      if (radii_[i] != 0.0L && tendon.IsPiece())
        angle = tendon.wrapped[i];
      else if (radii_[i] != 0.0L && (i == 0 || i == last))
        angle = 2.0L * kPi * std::abs(tendon.turns[i]);
      else if (radii_[i] != 0.0L) {
        angle = std::copysign(1.0L, radii_[i]) * AngleBetween(at_start_[i - 1], at_start_[i]);
        angle += 2.0L * kPi * (std::abs(tendon.turns[i]) - (angle < 0.0L ? 0.0L : 1.0L));
      }
      wrapped_.push_back(angle);
      const std::string& body = scene.nodes[nodes_[i]].body;
      bodies_.push_back(radii_[i] != 0.0L && (i == 0 || i == last) && !body.empty()
                            ? std::optional<std::size_t>(numbers.at(body))
                            : std::nullopt);
    }
    if (rest_ == 0.0L) rest_ = LengthIn(reference);
    all_nodes_ = nodes_;
    for (std::size_t end = 0; end < 2; ++end) {
      if (tendon.slides[end].empty()) continue;
      const std::size_t node = numbers.at(tendon.slides[end]);
      slides_.push_back({node, scene.nodes[node].x, end == 0 ? 1.0L : -1.0L});
      all_nodes_.push_back(node);
    }
  }

  // A node whose x tells what comes in, times sense.
  struct Slide {
    std::size_t node;
    Real start, sense;
  };

  // With those of what slides.
  const std::vector<std::size_t>& Nodes() const { return all_nodes_; }
  std::size_t NumSpans() const { return nodes_.size() - 1; }
  const std::vector<Slide>& Slides() const { return slides_; }
  Real EA() const { return EA_; }
  Real RestAtStart() const { return rest_; }
  Real Radius(std::size_t node) const { return radii_[node]; }  // < 0: clockwise round it
  Real WrappedAtStart(std::size_t node) const { return wrapped_[node]; }
  Vector Direction(const std::vector<double>& values, std::size_t span) const { return SpanAt(values, span).direction; }
  // By how much the direction turned since the start.
  Real Turned(const std::vector<double>& values, std::size_t span) const {
    return AngleBetween(at_start_[span], SpanAt(values, span).direction);
  }
  Real Rest(const std::vector<double>& values) const {
    Real rest = rest_;
    for (const Slide& slide : slides_) rest += slide.sense * (values[2 * slide.node] - slide.start);
    return rest;
  }
  Real LengthIn(const std::vector<double>& values) const {
    Real sum = 0.0L;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (i > 0) sum += SpanAt(values, i - 1).free;
      if (radii_[i] == 0.0L) continue;
      sum += std::abs(radii_[i]) * wrapped_[i];
      if (i + 1 < nodes_.size()) sum += radii_[i] * Turned(values, i);
      if (i > 0) sum -= radii_[i] * Turned(values, i - 1);
      if (bodies_[i]) sum += (i == 0 ? -1.0L : 1.0L) * radii_[i] * values[num_positions_ + *bodies_[i]];
    }
    return sum;
  }
  // < 0 where it is slack.
  Real SignedTension(const std::vector<double>& values) const {
    return EA_ * (LengthIn(values) - Rest(values)) / Rest(values);
  }
  // Of a pull along it: on the nodes, at the points that it touches on the bodies, and on what slides.
  void AddPull(const std::vector<double>& values, Real pull, Real on_slides, std::vector<Real>* forces) const {
    for (std::size_t i = 0; i + 1 < nodes_.size(); ++i) {
      const Vector force = pull * SpanAt(values, i).direction;
      AddTo(forces, nodes_[i], -1.0L * force);
      AddTo(forces, nodes_[i + 1], force);
      for (const std::size_t end : {i, i + 1})
        if (bodies_[end]) {
          const Vector arm = -radii_[end] * Left(SpanAt(values, i).direction);
          (*forces)[num_positions_ + *bodies_[end]] += Cross(arm, (end == i ? -1.0L : 1.0L) * force);
        }
    }
    for (const Slide& slide : slides_) (*forces)[2 * slide.node] -= slide.sense * on_slides;
  }

 private:
  struct Span {
    Vector direction;
    Real free;  // from where it leaves a roller to where it comes to the next one
  };
  Span SpanAt(const std::vector<double>& values, std::size_t i) const {
    const Vector first = NodePosition(values, nodes_[i]), second = NodePosition(values, nodes_[i + 1]),
                 d = second - first;
    const Real apart = radii_[i + 1] - radii_[i], length = Length(d);
    if (apart == 0.0L) return {1.0L / length * d, length};
    const Real turn = std::asin(apart / length), c = std::cos(turn) / length, s = std::sin(turn) / length;
    const Vector direction{c * d.x + s * d.y, c * d.y - s * d.x};
    return {direction, Length(second - radii_[i + 1] * Left(direction) - (first - radii_[i] * Left(direction)))};
  }

  Real EA_, rest_;
  std::size_t num_positions_;
  std::vector<std::size_t> nodes_, all_nodes_;
  std::vector<Real> radii_, wrapped_;               // by node
  std::vector<std::optional<std::size_t>> bodies_;  // by node: with which a roller at an end turns
  std::vector<Vector> at_start_;                    // direction of each span
  std::vector<Slide> slides_;
};

// The piece that has the eye at its end.
String PieceAt(const ContactCandidate& eye, std::size_t end, const Scene& scene, const NodeNumbers& numbers,
               const std::vector<double>& reference) {
  return String(*std::find_if(scene.tendons.begin(), scene.tendons.end(),
                              [&](const Tendon& of) { return of.slides[end] == eye.node; }),
                scene, numbers, reference);
}

// W = EA (l - a)^2 / (2 a), l the length and a that at rest, where l > a.
class TendonElement : public Element {
 public:
  explicit TendonElement(String string) : Element(Kind::kTendon, string.Nodes()), string_(std::move(string)) {}

  std::optional<Real> Tension(const std::vector<double>& values) const override {
    return std::max<Real>(string_.SignedTension(values), 0.0L);
  }
  std::size_t NumPieces() const override { return string_.NumSpans(); }
  Real Stiffness() const override { return 4.0L * string_.EA() / string_.RestAtStart(); }
  void AddEnergy(const std::vector<double>& values, Real* energy) const override {
    const Real tension = *Tension(values);
    *energy += 0.5L * string_.Rest(values) * tension * tension / string_.EA();
  }
  void AddForce(const std::vector<double>& values, std::vector<Real>* forces) const override {
    const Real tension = *Tension(values);
    // -dW/da = (l^2 - a^2) EA / (2 a^2)
    if (tension > 0.0L) string_.AddPull(values, tension, tension * (1.0L + 0.5L * tension / string_.EA()), forces);
  }

 private:
  String string_;
};

constexpr Real kSoft = 1e-8L;
constexpr Real kStraight = 1e-3L;  // [rad], round which angles are rounded

// W = k (l1 / a1 - l2 / a2)^2 / 2, k = kSoft EA times the shorter length at rest.
class EvenStrainElement : public Element {
 public:
  EvenStrainElement(String before, String behind)
      : Element(Kind::kLinearPart, Joined(before.Nodes(), behind.Nodes())),
        before_(std::move(before)),
        behind_(std::move(behind)),
        stiffness_(kSoft * before_.EA() * std::min(before_.RestAtStart(), behind_.RestAtStart())) {}

  Real Stiffness() const override { return kSoft * before_.EA() / before_.RestAtStart(); }
  void AddEnergy(const std::vector<double>& values, Real* energy) const override {
    const Real uneven = Ratio(before_, values) - Ratio(behind_, values);
    *energy += 0.5L * stiffness_ * uneven * uneven;
  }
  void AddForce(const std::vector<double>& values, std::vector<Real>* forces) const override {
    const Real force = stiffness_ * (Ratio(before_, values) - Ratio(behind_, values));
    for (const auto& [piece, sign] : {std::pair(&before_, 1.0L), std::pair(&behind_, -1.0L)}) {
      const Real pull = sign * force / piece->Rest(values);
      piece->AddPull(values, pull, pull * Ratio(*piece, values), forces);
    }
  }

 private:
  static Real Ratio(const String& piece, const std::vector<double>& values) {
    return piece.LengthIn(values) / piece.Rest(values);
  }
  static std::vector<std::size_t> Joined(std::vector<std::size_t> nodes, const std::vector<std::size_t>& more) {
    for (const std::size_t node : more)
      if (std::find(nodes.begin(), nodes.end(), node) == nodes.end()) nodes.push_back(node);
    return nodes;
  }

  String before_, behind_;
  Real stiffness_;
};

class EyeContact : public Contact {
 public:
  EyeContact(std::size_t node, const ContactCandidate& of, String before, String behind)
      : Contact(node, of.friction, of), before_(std::move(before)), behind_(std::move(behind)) {}

  Real FrictionIn(const PlacedState& state) const override {
    const std::vector<double> values = state.Values();
    Real turn = AngleBetween(before_.Direction(values, 0), behind_.Direction(values, 0));
    if (const Real sense = before_.Radius(1); sense != 0.0L) {
      turn = std::copysign(1.0L, sense) * (behind_.Turned(values, 0) - before_.Turned(values, 0));
      turn += before_.WrappedAtStart(1) + behind_.WrappedAtStart(0);
    }
    turn = std::abs(turn);
    return std::tanh(0.5L * Friction() * (turn + kStraight * std::log1p(std::exp(-2.0L * turn / kStraight))));
  }
  Vector Normal(const PlacedState&) const override { return {0.0L, 1.0L}; }
  Real Slip(const PlacedState& from, const PlacedState& to) const override {
    return to.Place(Node()).x - from.Place(Node()).x;
  }
  // The string stretches, and slides by 1 + tension / EA of its length at rest: the mean of both sides.
  void AddForces(const PlacedState&, Real rn, Real rt, Real factor, std::vector<Real>* forces) const override {
    (*forces)[2 * Node()] += factor * rt * Stretch(rn);
  }
  Real Stretch(Real rn) const override { return 1.0L + 0.5L * rn / before_.EA(); }
  std::optional<Real> NormalByPlace(const PlacedState& state) const override {
    const std::vector<double> values = state.Values();
    return before_.SignedTension(values) + behind_.SignedTension(values);
  }
  OnNode ForceOnNode(const PlacedState&, Real, Real) const override { return {}; }
  Real Imbalance(const PlacedState& state, Real rn, Real, Real) const override {
    const std::vector<double> values = state.Values();
    return std::abs(rn - before_.SignedTension(values) - behind_.SignedTension(values));
  }

 private:
  // What is missing of a length that bears.
  Real Distance(const PlacedState& state) const override {
    const std::vector<double> values = state.Values();
    return std::max<Real>(
        0.0L, before_.Rest(values) - before_.LengthIn(values) + behind_.Rest(values) - behind_.LengthIn(values));
  }

  String before_, behind_;
};

}  // namespace

std::unique_ptr<const Element> MakeTendon(const Tendon& tendon, const Scene& scene, const NodeNumbers& numbers,
                                          const std::vector<double>& reference) {
  return std::make_unique<TendonElement>(String(tendon, scene, numbers, reference));
}

std::unique_ptr<const Element> MakeEvenStrain(const ContactCandidate& eye, const Scene& scene,
                                              const NodeNumbers& numbers, const std::vector<double>& reference) {
  return std::make_unique<EvenStrainElement>(PieceAt(eye, 1, scene, numbers, reference),
                                             PieceAt(eye, 0, scene, numbers, reference));
}

std::unique_ptr<const Contact> MakeEye(const ContactCandidate& eye, const Scene& scene, const NodeNumbers& numbers) {
  std::vector<double> reference;
  for (const Node& node : scene.nodes) reference.insert(reference.end(), {node.x, node.y});
  reference.resize(reference.size() + scene.nodes.size());  // nothing is turned
  return std::make_unique<EyeContact>(numbers.at(eye.node), eye, PieceAt(eye, 1, scene, numbers, reference),
                                      PieceAt(eye, 0, scene, numbers, reference));
}

}  // namespace contact_path::check
