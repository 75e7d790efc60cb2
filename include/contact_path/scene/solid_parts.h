// What a scene says of solids and of surfaces that deform. Structs and descriptions of their fields are as in scene.h.
#ifndef CONTACT_PATH_SCENE_SOLID_PARTS_H_
#define CONTACT_PATH_SCENE_SOLID_PARTS_H_

#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

#include "contact_path/scene/field.h"
#include "contact_path/scene/words.h"

namespace contact_path {

// Strain energy of a solid per initial volume: structure/material.h.
enum class MaterialModel {
  kNeoHookean,
  kStVenantKirchhoff,
  kCiarletGeymonat,
  kLinear,  // small displacements
};
constexpr auto WordsOf(MaterialModel) {
  return WordList("neo_hookean", "st_venant_kirchhoff", "ciarlet_geymonat", "linear");
}

// What a plane solid does across the plane.
enum class PlaneState {
  kStrain,  // it keeps its thickness
  kStress,  // no stress acts there
};
constexpr auto WordsOf(PlaneState) { return WordList("strain", "stress"); }

// Elastic material of solids, by E and nu or by lambda and mu (LameOf()).
struct Material {
  std::string name;
  MaterialModel model = MaterialModel::kNeoHookean;
  double E = 0.0;       // Young's modulus [force/length^2], > 0; 0 = lambda and mu are given
  double nu = 0.0;      // Poisson's ratio, > -1 and < 0.5
  double lambda = 0.0;  // Lame's first parameter [force/length^2]; used where E = 0
  double mu = 0.0;      // shear modulus [force/length^2], > 0; used where E = 0
  double a = 0.0;       // of ciarlet_geymonat alone [force/length^2], max(0, mu/2 - lambda/4) <= a <= mu/2
};

template <typename P>
constexpr auto Fields(Of<Material>) {
  return std::tuple(Member("name", &P::name).Naming(TextKind::kNewName), Member("model", &P::model),
                    Member("E", &P::E).In(units::kStress).Within(Range::kZeroOrPositive), Member("nu", &P::nu),
                    Member("lambda", &P::lambda).In(units::kStress),
                    Member("mu", &P::mu).In(units::kStress).Within(Range::kZeroOrPositive),
                    Member("a", &P::a).In(units::kStress).Within(Range::kNotNegative));
}

// Mesh of plane elements of one material. The nodes of each element in turn: corners counterclockwise, then mid-sides,
// the first of them after the first corner.
struct Solid {
  std::string name;  // for people
  std::string material;
  double thickness = 0.0;  // [length]; 0 = 1, in the unit of the scene
  PlaneState plane = PlaneState::kStrain;
  int nodes_per_element = 0;  // 3, 4, 6 or 8; 0 = 3
  std::vector<std::string> nodes;

  std::size_t NodesPerElement() const {
    return nodes_per_element == 0 ? 3 : static_cast<std::size_t>(nodes_per_element);
  }
  double Thickness() const { return thickness == 0.0 ? 1.0 : thickness; }
};

template <typename P>
constexpr auto Fields(Of<Solid>) {
  return std::tuple(Member("name", &P::name), Member("material", &P::material).Naming(TextKind::kMaterial),
                    Member("thickness", &P::thickness).In(units::kLength).Within(Range::kZeroOrPositive),
                    Member("plane", &P::plane), Member("nodes_per_element", &P::nodes_per_element),
                    Member("nodes", &P::nodes).Naming(TextKind::kNode));
}

// Part of the boundary of a solid, or the axis of a beam: nodes in order, the material on the right of who walks along
// them. Mid-side nodes stand between the corners of their edge. To contacts, the surface is the quadratic B-spline of
// the current positions of its nodes, or the curve at the distance `radius` on the left of it.
struct BoundarySurface {
  std::string name;
  std::vector<std::string> nodes;
  bool closed = false;  // from the last node back to the first
  double radius = 0.0;  // half of the thickness of a beam whose axis this is [length]
};

template <typename P>
constexpr auto Fields(Of<BoundarySurface>) {
  return std::tuple(Member("name", &P::name).Naming(TextKind::kNewName),
                    Member("nodes", &P::nodes).Naming(TextKind::kNode), Member("closed", &P::closed),
                    Member("radius", &P::radius).In(units::kLength).Within(Range::kNotNegative));
}

// Lame's parameters [force/length^2].
struct Lame {
  double lambda = 0.0;
  double mu = 0.0;
};

// lambda = E nu / ((1 + nu) (1 - 2 nu)), mu = E / (2 (1 + nu)), where the scene gives E.
inline Lame LameOf(const Material& material) {
  if (material.E == 0.0) return {material.lambda, material.mu};
  const double mu = material.E / (2.0 * (1.0 + material.nu));
  return {2.0 * mu * material.nu / (1.0 - 2.0 * material.nu), mu};
}

// E = mu (3 lambda + 2 mu) / (lambda + mu) [force/length^2].
inline double YoungModulus(const Lame& of) { return of.mu * (3.0 * of.lambda + 2.0 * of.mu) / (of.lambda + of.mu); }

// nu = lambda / (2 (lambda + mu)).
inline double PoissonRatio(const Lame& of) { return of.lambda / (2.0 * (of.lambda + of.mu)); }

}  // namespace contact_path

#endif  // CONTACT_PATH_SCENE_SOLID_PARTS_H_
