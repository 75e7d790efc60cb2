// The rates at an event where contacts are between patches of deformable surfaces.
#ifndef CONTACT_PATH_SRC_BRANCH_RATE_PROBLEMS_H_
#define CONTACT_PATH_SRC_BRANCH_RATE_PROBLEMS_H_

#include <Eigen/Core>
#include <cstddef>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "contact_path/branch/rate_problem.h"

namespace contact_path {

// A rate problem for each combination of patches that is asked for: curvatures differ.
class RateProblems {
 public:
  // All arguments must outlive it.
  RateProblems(const Structure& structure, const ContactPairs& contacts, const PathPoint& point,
               const std::vector<ContactState>& natural, const std::vector<int>& weakly_active,
               const Eigen::VectorXd& arrival)
      : structure_(structure),
        contacts_(contacts),
        point_(point),
        natural_(natural),
        weakly_active_(weakly_active),
        arrival_(arrival) {}

  // Null: it is singular, or there have been very many.
  const RateProblem* On(const std::vector<int>& patches) {
    const auto found = problems_.find(patches);
    if (found != problems_.end()) return Regular(*found->second);
    if (problems_.size() == kMostRateProblems) return nullptr;
    return Regular(*problems_.emplace(patches, std::make_unique<const Problem>(*this, patches)).first->second);
  }

 private:
  static constexpr std::size_t kMostRateProblems = 64;  // patches of six contacts

  struct Problem {
    Problem(const RateProblems& of, const std::vector<int>& patches)
        : point(OnPatches(of.point_, patches)),
          rates(of.structure_, of.contacts_, point, of.natural_, of.weakly_active_, of.arrival_) {}

    static PathPoint OnPatches(PathPoint point, const std::vector<int>& patches) {
      if (!point.patches.empty()) point.patches = patches;
      return point;
    }

    const PathPoint point;
    const RateProblem rates;
  };

  static const RateProblem* Regular(const Problem& problem) {
    return problem.rates.regular() ? &problem.rates : nullptr;
  }

  const Structure& structure_;
  const ContactPairs& contacts_;
  const PathPoint& point_;
  const std::vector<ContactState>& natural_;
  const std::vector<int>& weakly_active_;
  const Eigen::VectorXd& arrival_;
  std::map<std::vector<int>, std::unique_ptr<const Problem>> problems_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_BRANCH_RATE_PROBLEMS_H_
