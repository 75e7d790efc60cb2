#include "check/tendon_pieces.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "check/plane.h"

namespace contact_path::check {
namespace {

// From node to node, with what is between them at rest.
class Piece {
 public:
  Piece(const Tendon& tendon, const Scene& scene, const NodeNumbers& numbers)
      : EA_(tendon.EA), rest_(tendon.rest_length) {
    for (const std::string& node : tendon.nodes) nodes_.push_back(numbers.at(node));
    for (std::size_t end = 0; end < 2; ++end) {
      if (tendon.slides[end].empty()) continue;
      const std::size_t node = numbers.at(tendon.slides[end]);
      slides_.push_back({node, scene.nodes[node].x, end == 0 ? 1.0L : -1.0L});
      nodes_.push_back(node);
    }
  }

  // A node whose x tells what comes in, times sense.
  struct Slide {
    std::size_t node;
    Real start, sense;
  };

  const std::vector<std::size_t>& Nodes() const { return nodes_; }
  const std::vector<Slide>& Slides() const { return slides_; }
  Real EA() const { return EA_; }
  Real RestAtStart() const { return rest_; }
  Vector Span(const std::vector<double>& positions) const {
    return NodePosition(positions, nodes_[1]) - NodePosition(positions, nodes_[0]);
  }
  Real Rest(const std::vector<double>& positions) const {
    Real rest = rest_;
    for (const Slide& slide : slides_) rest += slide.sense * (positions[2 * slide.node] - slide.start);
    return rest;
  }
  // < 0 where it is slack.
  Real SignedTension(const std::vector<double>& positions) const {
    return EA_ * (Length(Span(positions)) - Rest(positions)) / Rest(positions);
  }

 private:
  Real EA_, rest_;
  std::vector<std::size_t> nodes_;
  std::vector<Slide> slides_;
};

// The piece that has the eye at its end.
Piece PieceAt(const ContactCandidate& eye, std::size_t end, const Scene& scene, const NodeNumbers& numbers) {
  return Piece(*std::find_if(scene.tendons.begin(), scene.tendons.end(),
                             [&](const Tendon& of) { return of.slides[end] == eye.node; }),
               scene, numbers);
}

// W = EA (l - a)^2 / (2 a), l the length and a that at rest, where l > a.
class PieceElement : public Element {
 public:
  explicit PieceElement(Piece piece) : Element(Kind::kTendon, piece.Nodes()), piece_(std::move(piece)) {}

  std::optional<Real> Tension(const std::vector<double>& positions) const override {
    return std::max<Real>(piece_.SignedTension(positions), 0.0L);
  }
  std::size_t NumPieces() const override { return 1; }
  Real Stiffness() const override { return 4.0L * piece_.EA() / piece_.RestAtStart(); }
  void AddEnergy(const std::vector<double>& positions, Real* energy) const override {
    const Real tension = *Tension(positions);
    *energy += 0.5L * piece_.Rest(positions) * tension * tension / piece_.EA();
  }
  void AddForce(const std::vector<double>& positions, std::vector<Real>* forces) const override {
    const Real tension = *Tension(positions);
    if (!(tension > 0.0L)) return;
    const Vector span = piece_.Span(positions);
    AddTo(forces, Nodes()[0], -tension / Length(span) * span);
    AddTo(forces, Nodes()[1], tension / Length(span) * span);
    // -dW/da = (l^2 - a^2) EA / (2 a^2)
    for (const Piece::Slide& slide : piece_.Slides())
      (*forces)[2 * slide.node] -= slide.sense * tension * (1.0L + 0.5L * tension / piece_.EA());
  }

 private:
  Piece piece_;
};

constexpr Real kSoft = 1e-8L;
constexpr Real kStraight = 1e-3L;  // [rad], round which the angle at an eye is rounded

// W = k (l1 / a1 - l2 / a2)^2 / 2, k = kSoft EA times the shorter length at rest.
class EvenStrainElement : public Element {
 public:
  EvenStrainElement(Piece before, Piece behind)
      : Element(Kind::kLinearPart, Joined(before.Nodes(), behind.Nodes())),
        before_(std::move(before)),
        behind_(std::move(behind)),
        stiffness_(kSoft * before_.EA() * std::min(before_.RestAtStart(), behind_.RestAtStart())) {}

  Real Stiffness() const override { return kSoft * before_.EA() / before_.RestAtStart(); }
  void AddEnergy(const std::vector<double>& positions, Real* energy) const override {
    const Real uneven = Ratio(before_, positions) - Ratio(behind_, positions);
    *energy += 0.5L * stiffness_ * uneven * uneven;
  }
  void AddForce(const std::vector<double>& positions, std::vector<Real>* forces) const override {
    const Real force = stiffness_ * (Ratio(before_, positions) - Ratio(behind_, positions));
    for (const auto& [piece, sign] : {std::pair(&before_, 1.0L), std::pair(&behind_, -1.0L)}) {
      const Vector span = piece->Span(positions);
      const Real rest = piece->Rest(positions);
      const Vector pull = sign * force / (rest * Length(span)) * span;
      AddTo(forces, piece->Nodes()[0], -1.0L * pull);
      AddTo(forces, piece->Nodes()[1], pull);
      for (const Piece::Slide& slide : piece->Slides())
        (*forces)[2 * slide.node] -= sign * force * slide.sense * Ratio(*piece, positions) / rest;
    }
  }

 private:
  static Real Ratio(const Piece& piece, const std::vector<double>& positions) {
    return Length(piece.Span(positions)) / piece.Rest(positions);
  }
  static std::vector<std::size_t> Joined(std::vector<std::size_t> nodes, const std::vector<std::size_t>& more) {
    for (const std::size_t node : more)
      if (std::find(nodes.begin(), nodes.end(), node) == nodes.end()) nodes.push_back(node);
    return nodes;
  }

  Piece before_, behind_;
  Real stiffness_;
};

class EyeContact : public Contact {
 public:
  EyeContact(std::size_t node, Real friction, Piece before, Piece behind)
      : Contact(node, friction), before_(std::move(before)), behind_(std::move(behind)) {}

  Real FrictionIn(const PlacedState& state) const override {
    const Vector in = before_.Span(state.Positions()), out = behind_.Span(state.Positions());
    const Real turn = std::abs(std::atan2(in.x * out.y - in.y * out.x, Dot(in, out)));
    return std::tanh(0.5L * Friction() * (turn + kStraight * std::log1p(std::exp(-2.0L * turn / kStraight))));
  }
  // What is missing of a length that bears.
  Real Gap(const PlacedState& state) const override {
    return std::max<Real>(
        0.0L, -before_.SignedTension(state.Positions()) / before_.EA() * before_.Rest(state.Positions()) -
                  behind_.SignedTension(state.Positions()) / behind_.EA() * behind_.Rest(state.Positions()));
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
  OnNode ForceOnNode(const PlacedState&, Real, Real) const override { return {}; }
  Real Imbalance(const PlacedState& state, Real rn, Real, Real) const override {
    return std::abs(rn - before_.SignedTension(state.Positions()) - behind_.SignedTension(state.Positions()));
  }

 private:
  Piece before_, behind_;
};

}  // namespace

std::unique_ptr<const Element> MakePiece(const Tendon& piece, const Scene& scene, const NodeNumbers& numbers) {
  return std::make_unique<PieceElement>(Piece(piece, scene, numbers));
}

std::unique_ptr<const Element> MakeEvenStrain(const ContactCandidate& eye, const Scene& scene,
                                              const NodeNumbers& numbers) {
  return std::make_unique<EvenStrainElement>(PieceAt(eye, 1, scene, numbers), PieceAt(eye, 0, scene, numbers));
}

std::unique_ptr<const Contact> MakeEye(const ContactCandidate& eye, const Scene& scene, const NodeNumbers& numbers) {
  return std::make_unique<EyeContact>(numbers.at(eye.node), eye.friction, PieceAt(eye, 1, scene, numbers),
                                      PieceAt(eye, 0, scene, numbers));
}

}  // namespace contact_path::check
