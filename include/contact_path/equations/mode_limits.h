// The limits within which modes are admissible.
#ifndef CONTACT_PATH_EQUATIONS_MODE_LIMITS_H_
#define CONTACT_PATH_EQUATIONS_MODE_LIMITS_H_

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "contact_path/equations/jet.h"
#include "contact_path/equations/laws_in_modes.h"
#include "contact_path/law/reach_tracker.h"

namespace contact_path {

// Unknowns x: as of LawsInModes.
class ModeLimits {
 public:
  // laws: must outlive this; LimitsInReach() moves the modes of its laws on to where a step starts.
  explicit ModeLimits(LawsInModes* laws) : laws_(*laws) {}

  // All limits of the modes, in the order of the laws.
  std::vector<Limit> All() const;
  // Limits of the laws that act, and those of idle ones that an increment of length `reach` may come to; near: the ends
  // of pieces that idle laws in reach are beside.
  std::vector<Limit> InReach(const Eigen::VectorXd& x, double reach, std::vector<Limit>* near);
  // Whether an idle law of the last InReach() has passed its limit at x, on another piece than its own.
  bool BeyondReach(const Eigen::VectorXd& x) const;

  // In the mode of its law.
  const LimitRule& RuleOf(const Limit& limit) const {
    const auto i = static_cast<std::size_t>(limit.law);
    return laws_[i].Rule(laws_.modes()[i].state, limit.id);
  }
  // Of one that is not of forces.
  PortMotion MotionOf(const Limit& limit) const;
  // Whether the rate of the limit counts at x. A limit of a rate always does.
  bool IsWeaklyActive(const Limit& limit, const Eigen::VectorXd& x, const ActiveSetTolerance& tolerance) const;
  // At x, >= 0: holds.
  double Value(const Limit& limit, const Eigen::VectorXd& x) const;
  // Change of the value per change dx of the unknowns at x, and its gradient by `size` unknowns.
  double Rate(const Limit& limit, const Eigen::VectorXd& x, const Eigen::VectorXd& dx) const;
  Eigen::VectorXd Gradient(const Limit& limit, const Eigen::VectorXd& x, Eigen::Index size) const;
  // The value along a curve with these derivatives at x.
  Jet ValueAlong(const Limit& limit, const Eigen::VectorXd& x, const Eigen::VectorXd& first,
                 const Eigen::VectorXd& second) const;

 private:
  LawsInModes& laws_;
  std::optional<ReachTracker> tracker_;  // made where it is asked for
  std::vector<std::size_t> in_reach_;    // in the last call of InReach()
};

}  // namespace contact_path

#endif  // CONTACT_PATH_EQUATIONS_MODE_LIMITS_H_
