// Laws that hold the same unknowns more than once.
#ifndef CONTACT_PATH_BRANCH_REDUNDANT_LAWS_H_
#define CONTACT_PATH_BRANCH_REDUNDANT_LAWS_H_

#include <Eigen/Core>
#include <cstddef>
#include <map>
#include <vector>

#include "contact_path/law/laws.h"

namespace contact_path {

// Where several laws are of the same dofs, as walls that touch a node in a guide, some modes have more equations for
// its motion than there are unknowns, and their forces are not unique. Such modes are not needed: each force that they
// can exert is a sum of forces along few rays of their cones (Caratheodory), and modes without redundancy exert it,
// too. Modes without redundancy leave out one case: walls that face each other and squeeze the node between them. In a
// guide without clearance one wall carries at a time.
class RedundantLaws {
 public:
  // laws must outlive this. A motion of port 0 up to `gap`, scaled, is none at the point.
  RedundantLaws(const Laws& laws, const PathPoint& point, double gap);

  // Whether, with these states, the motions that are held of the same dofs, or the forces on them, depend on each
  // other. Also true for one law that holds more than it has dofs.
  bool Among(const States& states) const;

 private:
  struct Holding {
    std::size_t law;
    std::vector<LawVector> gradients;  // by port
    std::vector<double> factors;
  };

  bool AmongThese(const std::vector<Holding>& laws, const States& states) const;

  const Laws& laws_;
  std::map<std::vector<int>, std::vector<Holding>> by_dofs_;  // those that can be redundant
};

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_REDUNDANT_LAWS_H_
