// The inequalities within which the states of contacts are right.
#ifndef CONTACT_PATH_EQUATIONS_CONSTRAINT_H_
#define CONTACT_PATH_EQUATIONS_CONSTRAINT_H_

namespace contact_path {

// An inequality of the fixed states: what must stay >= 0 for the states to be right.
enum class Inequality {
  kGap,             // open: u_n
  kNormalReaction,  // touching: r_n
  kConePlus,        // stick: mu r_n + r_t (at zero, slip+ is next)
  kConeMinus,       // stick: mu r_n - r_t (at zero, slip- is next)
  kSlip,            // slip+-: +-(xi - xi_ref), the motion since the reference; what must be >= 0 is its rate
  kTotalSlip,       // slip+- by the total law: +-(xi - xi_ref) itself
  kPatchBegin,      // touching, not sticking, on a surface with patches: xi - begin (at zero, the patch before is next)
  kPatchEnd,        // touching, not sticking, on a surface with patches: end - xi (at zero, the patch after is next)
};

// Whether the inequality keeps a contact on its patch.
inline bool KeepsPatch(Inequality inequality) {
  return inequality == Inequality::kPatchBegin || inequality == Inequality::kPatchEnd;
}

// Whether the inequality is of a slip, whose contact sticks next at zero.
inline bool IsOfSlip(Inequality inequality) {
  return inequality == Inequality::kSlip || inequality == Inequality::kTotalSlip;
}

// Whether its value is a length, and not a force.
inline bool IsMotion(Inequality inequality) {
  return inequality == Inequality::kGap || IsOfSlip(inequality) || KeepsPatch(inequality);
}

struct Constraint {
  int contact = 0;
  Inequality inequality = Inequality::kGap;

  bool operator==(const Constraint& other) const { return contact == other.contact && inequality == other.inequality; }
};

}  // namespace contact_path

#endif  // CONTACT_PATH_EQUATIONS_CONSTRAINT_H_
