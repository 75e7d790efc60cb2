// Contact candidates as the check sees them, and what they and the elements answer for.
#ifndef CONTACT_PATH_SRC_CHECK_CONTACTS_H_
#define CONTACT_PATH_SRC_CHECK_CONTACTS_H_

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "check/boundary.h"
#include "check/elements.h"
#include "check/plane.h"
#include "contact_path/check/residuals.h"
#include "contact_path/scene/scene.h"

namespace contact_path::check {

// A state with its boundaries where their nodes are, each made when it is first asked for.
class PlacedState {
 public:
  // Both arguments must outlive it. boundaries: of the surfaces of the scene.
  PlacedState(const CheckedState& state, const std::vector<Boundary>& boundaries)
      : state_(state), boundaries_(boundaries), shapes_(boundaries.size()) {}

  const std::vector<double>& Positions() const { return state_.positions; }
  Vector Place(std::size_t node) const { return NodePosition(state_.positions, node); }
  std::vector<double> Values() const { return ValuesOf(state_.positions, state_.rotations); }
  Real Rotation(std::size_t node) const { return state_.rotations[node]; }
  Real LoadFactor() const { return state_.load_factor; }
  const BoundaryShape& Shape(std::size_t surface) const {
    if (!shapes_[surface]) shapes_[surface].emplace(boundaries_[surface], state_.positions);
    return *shapes_[surface];
  }

 private:
  const CheckedState& state_;
  const std::vector<Boundary>& boundaries_;
  mutable std::vector<std::optional<BoundaryShape>> shapes_;
};

class Contact {
 public:
  virtual ~Contact() = default;

  std::size_t Node() const { return node_; }
  Real Friction() const { return friction_; }
  // The largest |r_t| / r_n in a state.
  virtual Real FrictionIn(const PlacedState&) const { return friction_; }
  // What works along the slip over r_t.
  virtual Real Stretch(Real /*rn*/) const { return 1.0L; }
  // r_n, where the place alone tells it, as at an eye.
  virtual std::optional<Real> NormalByPlace(const PlacedState&) const { return std::nullopt; }
  // What a contact that gives way along t does so to: r_t over the share that is left of its friction.
  Real GivesTo(const PlacedState& state, Real rt) const {
    const Real now = FrictionIn(state);
    return now == friction_ ? rt : rt * friction_ / now;
  }
  // Whether it gives way, being one of a body.
  virtual bool Gives() const { return false; }
  // By its place in the scene; nothing of an obstacle.
  virtual std::optional<std::size_t> TouchedSurface() const { return std::nullopt; }

  // True: the gap is > 0, told at once of most nodes that are far away. False tells nothing.
  virtual bool SurelyOpen(const PlacedState&) const { return false; }
  // What is taken back of an overlap at the start belongs to it.
  Real Gap(const PlacedState& state) const {
    return overlap_at_0_ == 0.0L ? Distance(state)
                                 : Distance(state) + overlap_at_0_ + overlap_rate_ * state.LoadFactor();
  }
  // The same, if a node that is over an end of the surface to rounding counts as past it.
  virtual Real GapPastEnd(const PlacedState& state) const { return Gap(state); }
  // Towards the admissible side.
  virtual Vector Normal(const PlacedState& state) const = 0;
  // Motion along t, as the partner of the node sees it [length].
  virtual Real Slip(const PlacedState& from, const PlacedState& to) const = 0;
  // By the total law of friction: slip since the start of the program; by the incremental law nothing.
  virtual std::optional<Real> TotalSlip(const PlacedState&) const { return std::nullopt; }
  // The slip that friction opposes: the total one, or that from one state to another.
  Real LawfulSlip(const PlacedState& from, const PlacedState& to) const {
    const std::optional<Real> total = TotalSlip(to);
    return total ? *total : Slip(from, to);
  }
  // Adds the forces of r_n and r_t, times factor, to *forces: x0, y0, x1, ... by node.
  virtual void AddForces(const PlacedState& state, Real rn, Real rt, Real factor, std::vector<Real>* forces) const = 0;
  // By how much the force of r_t that is added may differ where the curvature jumps, and the contact gives way.
  virtual Real Uncertain(const PlacedState&, Real /*rt*/) const { return 0.0L; }
  // Force on the node, and its moment about the point p of an obstacle where it is now, or about the first node of a
  // surface.
  struct OnNode {
    Vector force;
    Real moment = 0.0L;
  };
  virtual OnNode ForceOnNode(const PlacedState& state, Real rn, Real rt) const = 0;
  // Velocity of what the node touches and is fixed to a moving obstacle, per unit of the load factor.
  virtual Vector Velocity(const PlacedState&) const { return {}; }
  // How far the forces on all nodes are from balance, and their moments about the node over `length`; 0 for an
  // obstacle, which the ground holds.
  virtual Real Imbalance(const PlacedState&, Real, Real, Real) const { return 0.0L; }

 protected:
  Contact(std::size_t node, Real friction, const ContactCandidate& of)
      : node_(node), friction_(friction), overlap_at_0_(of.overlap_at_0), overlap_rate_(of.overlap_rate) {}

  bool IsBroughtOn() const { return overlap_at_0_ != 0.0L; }
  // From what the node touches [length].
  virtual Real Distance(const PlacedState& state) const = 0;

 private:
  std::size_t node_;
  Real friction_, overlap_at_0_, overlap_rate_;
};

// By surface of the scene.
std::vector<Boundary> MakeBoundaries(const Scene& scene, const NodeNumbers& numbers);

// In the order of the scene. slip_origins: of Configuration. size: of coordinates. Throws std::out_of_range or
// std::invalid_argument for a name that the scene does not have.
std::vector<std::unique_ptr<const Contact>> MakeContacts(const Scene& scene, const NodeNumbers& numbers,
                                                         const std::vector<double>& slip_origins, Real size);

// Of an eye of a tendon: r_n is the sum of the tensions before it and behind it, r_t the first less the second.
std::unique_ptr<const Contact> MakeEye(const ContactCandidate& eye, const Scene& scene, const NodeNumbers& numbers);

// N, Q, M, M1, M2 of bars and segments of beams, in the order of the elements. values: as ValuesOf() orders them.
// num_positions: of the values, those before the rotations.
std::vector<std::array<double, 5>> Sections(const std::vector<std::unique_ptr<const Element>>& elements,
                                            const std::vector<double>& values, std::size_t num_positions);

// An edge along which contacts of one boundary are, from one end to the other: two nodes, or three, the second in the
// middle.
struct ContactEdge {
  std::vector<std::size_t> nodes;
  std::vector<std::size_t> contacts;  // at these nodes
};

// Edges of one element of a solid alone, and segments of beams, all of whose nodes have a contact with one boundary.
// boundary_of: by contact, the boundary that it may touch.
std::vector<ContactEdge> ContactEdges(const std::vector<std::unique_ptr<const Element>>& elements,
                                      const std::vector<std::unique_ptr<const Contact>>& contacts,
                                      const std::vector<std::size_t>& boundary_of);

// By contact: the integral of the shape function of its node along the edges, by Gauss's rule of three points [length].
std::vector<double> ContactLengths(const std::vector<ContactEdge>& edges, std::size_t num_contacts,
                                   const std::vector<double>& positions);

}  // namespace contact_path::check

#endif  // CONTACT_PATH_SRC_CHECK_CONTACTS_H_
