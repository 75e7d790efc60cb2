#include "contact_path/branch/redundant_contacts.h"

#include <Eigen/LU>
#include <algorithm>
#include <functional>
#include <iterator>

#include "contact_path/contact/contact_state.h"
#include "contact_path/tolerances.h"

namespace contact_path {
namespace {

// Of vectors of length 1, or zero, as columns.
bool Dependent(const Eigen::MatrixXd& columns) {
  if (columns.cols() == 0) return false;
  if (columns.cols() > columns.rows()) return true;
  Eigen::FullPivLU<Eigen::MatrixXd> lu(columns);
  lu.setThreshold(tolerances::kDependent);
  return lu.rank() < columns.cols();
}

}  // namespace

RedundantContacts::RedundantContacts(const ContactPairs& contacts, const PathPoint& point, double gap)
    : contacts_(contacts) {
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const ContactPair& contact = *contacts[i];
    // What a surface that gives way holds is for the equations to tell.
    if (contact.Deformable() || contact.Dofs(0).empty() || contact.Gap(point.u, point.s, point.Patch(i)) > gap)
      continue;
    Kinematics at;
    contact.Evaluate(point.u, point.s, point.Patch(i), 0.0, &at);
    std::vector<Touching>& node = nodes_[std::vector<int>(at.dofs.begin(), at.dofs.end())];
    node.push_back({i, at.gap_gradient, at.xi_gradient});
  }
  // One contact holds a node that moves in two directions in one way.
  for (auto node = nodes_.begin(); node != nodes_.end();)
    node = node->second.size() == 1 && node->first.size() > 1 ? nodes_.erase(node) : std::next(node);
}

bool RedundantContacts::Among(const std::vector<ContactState>& states) const {
  return std::any_of(nodes_.begin(), nodes_.end(), [&](const auto& node) { return AtNode(node.second, states); });
}

std::vector<std::vector<std::size_t>> RedundantContacts::AtEachNode() const {
  std::vector<std::vector<std::size_t>> nodes;
  for (const auto& [dofs, touching] : nodes_) {
    if (touching.size() < 2) continue;
    nodes.emplace_back();
    for (const Touching& contact : touching) nodes.back().push_back(contact.contact);
  }
  return nodes;
}

bool RedundantContacts::AmongAll(const std::vector<ContactModes>& options) const {
  std::vector<ContactState> states(options.size(), ContactState::kOpen);
  // From the contact k of the node on.
  const std::function<bool(const std::vector<Touching>&, std::size_t)> in_each = [&](const std::vector<Touching>& node,
                                                                                     std::size_t k) {
    if (k == node.size()) return AtNode(node, states);
    const ContactModes& modes = options[node[k].contact];
    return std::all_of(modes.begin(), modes.end(), [&](const ContactMode& mode) {
      states[node[k].contact] = mode.state;
      return in_each(node, k + 1);
    });
  };
  return std::any_of(nodes_.begin(), nodes_.end(), [&](const auto& node) { return in_each(node.second, 0); });
}

bool RedundantContacts::AtNode(const std::vector<Touching>& node, const std::vector<ContactState>& states) const {
  const Eigen::Index q = node.front().gap_gradient.size();
  Eigen::MatrixXd motions(q, 0), forces(q - 1, 0);
  const auto append = [](Eigen::MatrixXd* columns, const auto& column) {
    columns->conservativeResize(Eigen::NoChange, columns->cols() + 1);
    columns->rightCols<1>() = column.normalized();
  };
  for (const Touching& touching : node) {
    const ContactState state = states[touching.contact];
    if (state == ContactState::kOpen) continue;
    if (motions.cols() == q) return true;  // one more is one too many
    const PairVector &gap = touching.gap_gradient, &xi = touching.xi_gradient;
    append(&motions, gap);
    const double ratio = SlipRatio(state, contacts_[touching.contact]->Friction());
    append(&forces, (gap + ratio * xi).head(q - 1));
    if (state != ContactState::kStick) continue;
    append(&motions, xi);
    append(&forces, xi.head(q - 1));
  }
  return Dependent(motions) || Dependent(forces);
}

}  // namespace contact_path
