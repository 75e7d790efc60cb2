// Verdicts of stability, by second differences of the energy.
#ifndef CONTACT_PATH_SRC_VERIFY_STABILITY_CHECKS_H_
#define CONTACT_PATH_SRC_VERIFY_STABILITY_CHECKS_H_

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <set>
#include <vector>

#include "contact_path/path/increment.h"
#include "contact_path/verify/verify_path.h"
#include "verify/verified_stage.h"

namespace contact_path {

// Of regular increments of structures of up to 400 components whose contacts are open, or stick to obstacles: such a
// contact is a pin, and an equilibrium is stable if the stiffness of all other components is positive definite. Where
// contacts slip, or touch surfaces that deform, the verdict is not looked at.
class StabilityChecks {
 public:
  // All must outlive the checks.
  StabilityChecks(const VerifiedStage& stage, Findings* findings, Verification* result);

  void Check(const Increment& increment);

 private:
  // Components that are free at the increment, as CheckedState has them, then rotations; nothing where it is not
  // covered.
  std::optional<std::vector<std::size_t>> FreeComponents(const Increment& increment) const;
  // Of Unbalance() by components that move together, each by its own motion; the number of all components: the load
  // factor. step: to either side, over the unit of the component.
  struct Change {
    Eigen::VectorXd forces;
    std::vector<double> motions;
  };
  Change ChangeBy(const Increment& increment, const std::vector<std::size_t>& components, double step) const;
  std::size_t NodeOf(std::size_t component) const;
  // Nodes on whose forces a node has an influence, and groups of nodes that have none on the same.
  void FindCouplings(const Increment& increment, double step);
  Eigen::MatrixXd Stiffness(const Increment& increment, const std::vector<std::size_t>& components, double step) const;

  const VerifiedStage& stage_;
  Findings& findings_;
  Verification& result_;
  std::vector<bool> of_surfaces_;  // by candidate: what it touches deforms
  std::vector<std::set<std::size_t>> coupled_;
  std::vector<std::vector<std::size_t>> groups_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_VERIFY_STABILITY_CHECKS_H_
