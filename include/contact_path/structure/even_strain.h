// What keeps determined how much of a slack tendon is on either side of an eye with friction.
#ifndef CONTACT_PATH_STRUCTURE_EVEN_STRAIN_H_
#define CONTACT_PATH_STRUCTURE_EVEN_STRAIN_H_

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "contact_path/geometry/rolled_span.h"
#include "contact_path/structure/element.h"

namespace contact_path {

// W = k (l1 / a1 - l2 / a2)^2 / 2 of the pieces before and behind an eye, with their lengths l from node to node, round
// rollers and on drums, and those at rest a, so soft that it is felt nowhere but where the tendon is slack: there both
// pieces have one strain, and it exerts no force. Its values are x, y of the node before, of the eye, of the node
// behind, and of the nodes whose x tells what has slid, then rotations of bodies: a1 = a1_0 + in - slid, a2 = a2_0 +
// slid - out, of those that are there.
class EvenStrain : public Element {
 public:
  struct Piece {
    double rest = 0.0;  // at the start [length]
    // By node of the element: what its x less `start` adds to the length at rest, per length.
    struct Slide {
      int node;
      double start, sense;
    };
    std::vector<Slide> slides;
    std::array<int, 2> nodes{};  // of the element
    RolledSpan rolled = {};
    // What the turn of a body adds to the length. body: among those of the element.
    struct Drum {
      int body;
      double by_turn;  // [length/rad]
    };
    std::vector<Drum> drums = {};
  };
  // stiffness: k [force length]. Of num_nodes, and behind them num_bodies whose rotations count.
  EvenStrain(double stiffness, Piece before, Piece behind, int num_nodes, int num_bodies = 0);

  const std::vector<LocalDof>& Dofs() const override { return dofs_; }
  bool Artificial() const override { return true; }
  double Energy(const Values& x) const override;
  void Force(const Values& x, Eigen::Ref<Eigen::VectorXd> force) const override;
  void Tangent(const Values& x, Eigen::Ref<Eigen::MatrixXd> tangent) const override;
  void TangentDerivative(const Values& x, const Values& v, Eigen::Ref<Eigen::MatrixXd> derivative) const override;

 private:
  template <typename Number>
  Number EnergyOf(const std::vector<Number>& values) const;
  // The Hessian of the energy, or with v its change with h along x + h v at h = 0.
  void Derive(const Values& x, const Values* v, Eigen::Ref<Eigen::MatrixXd> out) const;

  double stiffness_;
  Piece before_, behind_;
  std::size_t first_body_;  // among the values
  std::vector<LocalDof> dofs_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_STRUCTURE_EVEN_STRAIN_H_
