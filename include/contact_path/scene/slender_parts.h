// What a scene says of bars, tendons, pins, linear parts and beams. Structs and descriptions of their fields are as in
// scene.h.
#ifndef CONTACT_PATH_SCENE_SLENDER_PARTS_H_
#define CONTACT_PATH_SCENE_SLENDER_PARTS_H_

#include <array>
#include <string>
#include <tuple>
#include <vector>

#include "contact_path/scene/field.h"
#include "contact_path/scene/words.h"

namespace contact_path {

// Strain of a bar of current length l and rest length l0.
enum class StrainMeasure {
  kBiot,           // l / l0 - 1
  kGreenLagrange,  // ((l / l0)^2 - 1) / 2
  kLogarithmic,    // ln(l / l0)
};
constexpr auto WordsOf(StrainMeasure) { return WordList("biot", "green_lagrange", "logarithmic"); }

// What a bar bears.
enum class BarSense { kBoth, kTension, kCompression };
constexpr auto WordsOf(BarSense) { return WordList("both", "tension", "compression"); }

// Straight bar with energy EA l0 e^2 / 2, e by `strain`; without energy where it is slack.
struct Bar {
  std::vector<std::string> nodes;  // two names
  double EA = 0.0;                 // axial stiffness [force], > 0
  double rest_length = 0.0;        // [length]; 0 = distance of the nodes at the start
  StrainMeasure strain = StrainMeasure::kBiot;
  BarSense sense = BarSense::kBoth;
  std::string name = {};  // of the column of its state; empty = "bar<place in the list, from 1>"
};

template <typename P>
constexpr auto Fields(Of<Bar>) {
  return std::tuple(Member("nodes", &P::nodes).Naming(TextKind::kNode),
                    Member("EA", &P::EA).In(units::kForce).Within(Range::kPositive),
                    Member("rest_length", &P::rest_length).In(units::kLength).Within(Range::kZeroOrPositive),
                    Member("strain", &P::strain), Member("sense", &P::sense), Member("name", &P::name));
}

// Whether friction acts at the round rollers of a tendon, or they turn with it.
enum class Pulley { kFixed, kFree };
constexpr auto WordsOf(Pulley) { return WordList("fixed", "free"); }

// String from its first node through the others, along which it slides, to the last one. It bears tension alone.
// Without friction: energy EA l0 e^2 / 2, e = l / l0 - 1 >= 0 with the length l from node to node and round the rollers
// about nodes. With friction each piece from node to node has an energy of its own, and the tensions before and behind
// a node round which the string turns by phi differ by at most the factor exp(friction phi). On a drum, a roller at an
// end of it, the string is wound.
struct Tendon {
  std::string name;                // of the column of its state; empty = "tendon<place in the list, from 1>"
  std::vector<std::string> nodes;  // two names at least; a name may come again
  double EA = 0.0;                 // [force], > 0
  double rest_length = 0.0;        // l0 [length]; 0 = l at the start
  double friction = 0.0;           // Coulomb's coefficient at each node but the first and the last
  // Of round rollers about the nodes [length], 0: none; empty = none at all. Drums, at the ends, and rollers with
  // friction turn with the body of their node.
  std::vector<double> radii = {};
  // By node, of a roller: > 0 where the string goes round it counterclockwise, < 0 clockwise; 1 and -1 between the ends
  // wrap less than a whole turn at the start, each one more is a turn more; at an end the turns wound at the start.
  std::vector<double> turns = {};
  Pulley pulley = Pulley::kFixed;  // free: there is no friction at rollers

  // Of one of the pieces that a tendon with friction is in an expanded scene: the nodes whose x tells what has slid
  // through its first eye and its second one; empty at an end of the tendon. No field.
  std::array<std::string, 2> slides = {};
  // Of a piece: the angles by which it is wrapped round its rollers at the start [rad], >= 0. No field.
  std::array<double, 2> wrapped = {};
  bool IsPiece() const { return !slides[0].empty() || !slides[1].empty(); }
};

template <typename P>
constexpr auto Fields(Of<Tendon>) {
  return std::tuple(Member("name", &P::name), Member("nodes", &P::nodes).Naming(TextKind::kNode),
                    Member("EA", &P::EA).In(units::kForce).Within(Range::kPositive),
                    Member("rest_length", &P::rest_length).In(units::kLength).Within(Range::kZeroOrPositive),
                    Member("friction", &P::friction).Within(Range::kZeroOrPositive),
                    Member("radii", &P::radii).In(units::kLength).Within(Range::kZeroOrPositive),
                    Member("turns", &P::turns), Member("pulley", &P::pulley));
}

// Two nodes that stay together, and turn freely against each other or by a rotational spring between what turns with
// them, a body or the end of a beam: energy k (theta_2 - theta_1 - angle)^2 / 2 of their rotations since the start.
struct Pin {
  std::vector<std::string> nodes;  // two names, at the same point at the start
  double stiffness = 0.0;          // k [force length/rad]; 0 = no spring
  double angle = 0.0;              // relative turn from the first node to the second without moment [rad]
  std::string name = {};           // of its columns; empty = "pin<place in the list, from 1>"
};

template <typename P>
constexpr auto Fields(Of<Pin>) {
  return std::tuple(Member("nodes", &P::nodes).Naming(TextKind::kNode),
                    Member("stiffness", &P::stiffness).In(units::kMoment).Within(Range::kZeroOrPositive),
                    Member("angle", &P::angle), Member("name", &P::name));
}

// Linear elastic part: force = K (x - X), both ordered x0, y0, x1, y1, ... over `nodes`.
struct Superelement {
  std::vector<std::string> nodes;           // n names
  std::vector<double> stiffness;            // K, row-major, 2n x 2n, symmetric [force/length]
  std::vector<double> rest_positions = {};  // X, 2n [length]; empty = the initial positions of the nodes
};

template <typename P>
constexpr auto Fields(Of<Superelement>) {
  return std::tuple(Member("nodes", &P::nodes).Naming(TextKind::kNode),
                    Member("stiffness", &P::stiffness).In(units::kStiffness),
                    Member("rest_positions", &P::rest_positions).In(units::kLength));
}

// Beam, stress-free as an arc of a circle, of so many straight segments between nodes on that arc. Large displacements
// and rotations, small strains (structure/beam.h). The inner nodes are "<name>/1" to "<name>/<segments - 1>", from the
// first node to the second.
struct Beam {
  std::string name;                // empty = "beam<place in the list, from 1>"
  std::vector<std::string> nodes;  // two names
  double EA = 0.0;                 // axial stiffness [force], > 0
  double EI = 0.0;                 // bending stiffness [force length^2], > 0
  double GA = 0.0;                 // shear stiffness [force]; 0 = no shear deformation
  int segments = 0;                // 0 = 20
  double angle = 0.0;  // turn of the arc from the first node to the second [rad], > 0 to the left; 0 = straight
  std::vector<bool> hinged = {};  // at the first and the second node; empty = at none
};

template <typename P>
constexpr auto Fields(Of<Beam>) {
  return std::tuple(Member("name", &P::name), Member("nodes", &P::nodes).Naming(TextKind::kNode),
                    Member("EA", &P::EA).In(units::kForce).Within(Range::kPositive),
                    Member("EI", &P::EI).In(units::kBending).Within(Range::kPositive),
                    Member("GA", &P::GA).In(units::kForce).Within(Range::kZeroOrPositive),
                    Member("segments", &P::segments).Within(Range::kNotNegative), Member("angle", &P::angle),
                    Member("hinged", &P::hinged));
}

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_SLENDER_PARTS_H_
