// What a disturbance of an increment meets, by differences of the forces of check/.
#ifndef CONTACT_PATH_SRC_VERIFY_DIFFERENCES_H_
#define CONTACT_PATH_SRC_VERIFY_DIFFERENCES_H_

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <set>
#include <vector>

#include "contact_path/check/residuals.h"
#include "contact_path/path/increment.h"
#include "verify/disturbance.h"
#include "verify/verified_stage.h"

namespace contact_path {

// Scaled by L, F and F L, and each unknown by the root of what is stiffest there: soft parts beside stiff ones tell.
struct DisturbedIncrement {
  Disturbed disturbed;
  Eigen::VectorXd load;                 // by a unit of the load factor
  Eigen::VectorXd units;                // of the unknowns, over L
  std::vector<std::size_t> components;  // of the unknowns: as CheckedState has them, then rotations
};

class Differences {
 public:
  // The stage must outlive it.
  explicit Differences(const VerifiedStage& stage);

  // Nothing of more than 400 unknowns, and where friction is holonomic and slides.
  std::optional<DisturbedIncrement> At(const Increment& increment);

 private:
  // Of Unbalance() by components that move together, each by its own motion.
  struct Change {
    Eigen::VectorXd forces;
    Eigen::VectorXd bend;  // less that of a straight line
    std::vector<double> motions;
  };
  std::vector<std::size_t> FreeComponents() const;
  // step: to either side, over the unit of the component.
  Change ChangeBy(const CheckedState& at, const std::vector<std::size_t>& components, double step) const;
  // The same by one number of the state: forces per unit of it.
  Eigen::VectorXd ForcesBy(const CheckedState& at, double* (*number)(CheckedState*, std::size_t), std::size_t place,
                           double step) const;
  std::size_t NodeOf(std::size_t component) const;
  double UnitOf(std::size_t component) const;
  // Nodes on whose forces a node has an influence, and groups of nodes that have none on the same.
  void FindCouplings(const Increment& increment, double step);
  void MakeGroups();
  // bend: by how much it differs on both sides; may be null.
  Eigen::MatrixXd Stiffness(const CheckedState& at, const std::vector<std::size_t>& components, double step,
                            Eigen::MatrixXd* bend) const;
  // Leaves out what nothing moves with, but for bodies.
  void KeepMoving(DisturbedIncrement* found) const;
  // Reactions of contacts and pins.
  void AddReactions(const Increment& increment, const CheckedState& at, double step, DisturbedIncrement* found) const;
  Eigen::VectorXd FrictionByPlace(std::size_t contact, const CheckedState& at,
                                  const std::vector<std::size_t>& components, double step) const;

  const VerifiedStage& stage_;
  std::vector<bool> turns_;  // by node: whether it has a rotation
  std::vector<std::set<std::size_t>> coupled_;
  std::vector<std::vector<std::size_t>> groups_;
  std::vector<BarState> bars_of_groups_;  // slack ones couple nothing
  std::vector<bool> touching_in_groups_;  // by contact: nor do open ones
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_VERIFY_DIFFERENCES_H_
