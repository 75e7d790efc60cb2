// Contacts of one node that hold it more than once.
#ifndef CONTACT_PATH_BRANCH_REDUNDANT_CONTACTS_H_
#define CONTACT_PATH_BRANCH_REDUNDANT_CONTACTS_H_

#include <Eigen/Core>
#include <cstddef>
#include <map>
#include <vector>

#include "contact_path/contact/contact_pair.h"
#include "contact_path/contact/contact_state.h"
#include "contact_path/contact/path_point.h"

namespace contact_path {

// Where several walls touch a node, as in a guide, some states have more equations for its motion than the node has
// unknowns, and their reactions are not unique. Such states are not needed: each force that the walls can exert is a
// sum of forces along at most two edges of friction cones (Caratheodory), and states without redundancy exert it, too.
// States without redundancy leave out one case: walls that face each other and squeeze the node between them. In a
// guide without clearance one wall carries at a time.
class RedundantContacts {
 public:
  // contacts must outlive this. A gap up to `gap`, scaled, touches at the point.
  RedundantContacts(const ContactPairs& contacts, const PathPoint& point, double gap);

  // Whether, with these states, the conditions on the motion of some node, or the reactions on it, depend on each
  // other. Also true for a single contact that sticks at a node with one direction of motion.
  bool Among(const std::vector<ContactState>& states) const;
  // The candidates that touch at each node where several do.
  std::vector<std::vector<std::size_t>> AtEachNode() const;
  // Whether they are among every combination of these options, by candidate, at some node.
  bool AmongAll(const std::vector<ContactModes>& options) const;

 private:
  struct Touching {
    std::size_t contact;
    PairVector gap_gradient, xi_gradient;
  };

  bool AtNode(const std::vector<Touching>& node, const std::vector<ContactState>& states) const;

  const ContactPairs& contacts_;
  std::map<std::vector<int>, std::vector<Touching>> nodes_;  // by dofs: those that can be redundant
};

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_REDUNDANT_CONTACTS_H_
