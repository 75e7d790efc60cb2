// Where the variables and constraints of an increment problem are, and the motions of its laws.
#ifndef CONTACT_PATH_MPEC_INCREMENT_SLOTS_H_
#define CONTACT_PATH_MPEC_INCREMENT_SLOTS_H_

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "contact_path/contact/contact_pair.h"
#include "contact_path/law/path_point.h"
#include "contact_path/structure/structure.h"

namespace contact_path {

// Variables, with dz = (du, ds) = S y and reactions over S:
//   y (NumDofs() + 1), r_n / S by contact, then r_t / S and lambda / S by frictional contact, then the reactions of the
//   prescribed components over S. A law that always acts has its first force among r_n / S, its second among r_t / S.
// Constraints, all over S (products over S^2): equilibrium = 0; gaps >= 0; gap r_n <= eps; lambda -+ du_t >= 0;
// mu r_n -+ r_t >= 0; lambda mu r_n + du_t r_t <= eps; prescribed components where they have to be. Frictionless
// contacts have neither r_t nor lambda. A law of one port, as a bar that bears one sense alone, is such a contact.
class IncrementSlots {
 public:
  // Of a law of the working set.
  struct Slot {
    const Law* law;
    const ContactPair* pair;      // the same, of a contact; else null
    std::size_t number;           // among all laws
    Eigen::Index port;            // the first one, among those of all laws
    int held;                     // state in which the gap is zero and nothing slides
    bool always;                  // acts: there is no other state
    PortReals compliance;         // of the ports, where all are held
    int start_patch;              // where the increment starts
    LawDofs dofs;                 // of the patches that it may end on
    PortsAt at_start;             // of the increment
    PortReals reference;          // from which motions are measured
    Eigen::Index rn, rt, lambda;  // variables; -1: none
    Eigen::Index gap_row;         // constraints: gap, gap r_n; motions of the ports of what always acts
    Eigen::Index friction_row;    // lambda - y_t, lambda + y_t, mu r_n - r_t, mu r_n + r_t, product; -1 if frictionless

    bool Frictional() const { return lambda >= 0; }
    bool Deformable() const { return pair != nullptr && pair->Deformable(); }
    Eigen::Index ForceOf(std::size_t of) const { return of == 0 ? rn : rt; }
    std::size_t NumForces() const { return rt < 0 ? 1 : 2; }
  };

  struct Support {
    const PrescribedDof* prescribed;
    Eigen::Index reaction;  // variable
    Eigen::Index row;       // constraint
  };

  // working_set: the laws that take part, ascending, with all that always act. laws: the contacts, then laws of one
  // port and laws that always act. length: S. What is referred to must outlive this.
  IncrementSlots(const Structure& structure, const ContactPairs& contacts, const Laws& laws, const PathPoint& from,
                 const std::vector<int>& working_set, double length);

  const std::vector<Slot>& All() const { return slots_; }
  const std::vector<Support>& Supports() const { return supports_; }
  Eigen::Index NumDofs() const { return from_.u.size(); }
  Eigen::Index NumVariables() const { return num_variables_; }
  Eigen::Index NumConstraints() const { return num_constraints_; }
  const PathPoint& From() const { return from_; }
  double Length() const { return length_; }
  // Where the variables are.
  Eigen::VectorXd U(const Eigen::VectorXd& x) const { return from_.u + length_ * x.head(NumDofs()); }
  double LoadFactor(const Eigen::VectorXd& x) const { return from_.s + length_ * x[NumDofs()]; }
  // By y, forces and the dofs of the slot: motions with what compliances give, over S; gradients as they are, Hessians
  // and gradients of factors times S.
  PortsAt Kinematics(const Slot& slot, const Eigen::VectorXd& x) const;
  // Where the node is. The structure of the matrices is fixed: of a deformable surface, the next patches are prolonged.
  int PatchOf(const Slot& slot, const Eigen::VectorXd& u, double s) const;
  // Calls visit(variable, k) for each variable that moves a law, a port of it; k: its number in the q of the slot.
  template <typename Visit>
  void ForEachVariable(const Slot& slot, Visit visit) const {
    Eigen::Index k = 0;
    for (const int dof : slot.dofs) visit(static_cast<Eigen::Index>(dof), k++);
    visit(NumDofs(), k);
  }
  template <typename Visit>
  void ForEachVariableOf(const Slot& slot, std::size_t port, Visit visit) const {
    ForEachVariable(slot, [&](Eigen::Index variable, Eigen::Index k) {
      if (slot.law->Moves(port, static_cast<std::size_t>(k))) visit(variable, k);
    });
  }

 private:
  // Puts a slot with its variables and constraints behind the others. rn: its first variable.
  void Add(const ContactPairs& contacts, const Laws& laws, std::size_t number, Eigen::Index rn);

  const PathPoint& from_;
  double length_;
  Eigen::Index num_variables_ = 0;
  Eigen::Index num_constraints_ = 0;
  std::vector<Slot> slots_;
  std::vector<Support> supports_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_MPEC_INCREMENT_SLOTS_H_
