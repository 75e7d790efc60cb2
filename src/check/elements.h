// The elements of a scene as the check sees them: written from their definitions (scene/scene.h), apart from
// structure/.
#ifndef CONTACT_PATH_SRC_CHECK_ELEMENTS_H_
#define CONTACT_PATH_SRC_CHECK_ELEMENTS_H_

#include <cstddef>
#include <memory>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "check/plane.h"
#include "contact_path/scene/scene.h"

namespace contact_path::check {

// What elements depend on: x0, y0, x1, ... of all nodes of the scene, then their rotations where there are beams.
inline std::vector<double> ValuesOf(std::vector<double> positions, const std::vector<double>& rotations) {
  positions.insert(positions.end(), rotations.begin(), rotations.end());
  return positions;
}

// Means over the volume of an element of a solid.
struct MeanStress {
  Real xx = 0.0L, yy = 0.0L, xy = 0.0L, zz = 0.0L;  // Cauchy [force/length^2]
  Real energy = 0.0L;                               // of the whole element [force length]
  Real per_motion = 0.0L;  // at least the change of a stress by a motion of the nodes [force/length^3]
};

// values and forces: as ValuesOf() orders them.
class Element {
 public:
  virtual ~Element() = default;

  enum class Kind { kBar, kSegment, kLinearPart, kSolid, kTendon, kSpring };
  Kind GetKind() const { return kind_; }
  const std::vector<std::size_t>& Nodes() const { return nodes_; }
  // Whether the directions of its forces turn with the motion.
  virtual bool Turns() const { return true; }
  // Of an element of a solid; nothing of another one.
  virtual std::optional<MeanStress> Stress(const std::vector<double>&) const { return std::nullopt; }
  // Of a tendon [force]; nothing of another element.
  virtual std::optional<Real> Tension(const std::vector<double>&) const { return std::nullopt; }
  // From node to node, of a tendon.
  virtual std::size_t NumPieces() const { return nodes_.size() - 1; }
  // At least the largest force per motion that it exerts at the start [force/length].
  virtual Real Stiffness() const = 0;
  // Adds the strain energy W to *energy [force length].
  virtual void AddEnergy(const std::vector<double>& values, Real* energy) const = 0;
  // Adds dW by the values to *forces [force, force length].
  virtual void AddForce(const std::vector<double>& values, std::vector<Real>* forces) const = 0;

 protected:
  Element(Kind kind, std::vector<std::size_t> nodes) : kind_(kind), nodes_(std::move(nodes)) {}

 private:
  Kind kind_;
  std::vector<std::size_t> nodes_;
};

// Upper bounds of the forces that elements exert on a node per unit of a motion of theirs [force/length]: along x and
// y, and, of elements that turn, in any direction.
struct StiffnessBound {
  double x = 0.0, y = 0.0, any = 0.0;

  StiffnessBound& operator+=(const StiffnessBound& other) {
    x += other.x;
    y += other.y;
    any += other.any;
    return *this;
  }
};

// By node, at `values`, by difference quotients of the forces.
std::vector<StiffnessBound> BoundStiffness(const std::vector<std::unique_ptr<const Element>>& elements,
                                           const std::vector<double>& values, std::size_t num_nodes);

using NodeNumbers = std::unordered_map<std::string_view, std::size_t>;  // by name

// In the order of the scene. reference: x0, y0, x1, ... (scene/configuration.h). Throws std::out_of_range for a name
// that `numbers` does not have.
std::vector<std::unique_ptr<const Element>> MakeElements(const Scene& scene, const NodeNumbers& numbers,
                                                         const std::vector<double>& reference);

// Of a tendon, or a piece of one in the expanded scene: its energy where its tension is > 0, its force, and that on
// what slides. reference: places of the nodes at the start, and a rotation of 0 for each.
std::unique_ptr<const Element> MakeTendon(const Tendon& tendon, const Scene& scene, const NodeNumbers& numbers,
                                          const std::vector<double>& reference);

// Of an eye of the pieces: what keeps even the strains of a slack tendon on both sides.
std::unique_ptr<const Element> MakeEvenStrain(const ContactCandidate& eye, const Scene& scene,
                                              const NodeNumbers& numbers, const std::vector<double>& reference);

// nodes: of one element of the solid. reference: x0, y0, x1, ... of all nodes of the scene. Energy and forces are NaN
// where the element is turned inside out, and where plane stress has no solution.
std::unique_ptr<const Element> MakeSolid(const Solid& solid, const Material& material, std::vector<std::size_t> nodes,
                                         const std::vector<double>& reference);

}  // namespace contact_path::check

#endif  // CONTACT_PATH_SRC_CHECK_ELEMENTS_H_
