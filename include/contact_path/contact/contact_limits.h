// The limits of a contact.
#ifndef CONTACT_PATH_CONTACT_CONTACT_LIMITS_H_
#define CONTACT_PATH_CONTACT_CONTACT_LIMITS_H_

namespace contact_path {

// The ports of a contact: gap u_n with the normal reaction r_n, and xi, the surface coordinate, with the tangential
// reaction r_t. Slip is the factor of the port times dxi. Of a circle that rolls over patches, xi has the turn of the
// circle in it; where its foot is on the patches is a motion without a force, behind the ports.
inline constexpr unsigned kNormal = 0, kTangent = 1, kFoot = 2;

// Limit::id of a contact.
enum class ContactLimit {
  kGap,             // open: u_n
  kNormalReaction,  // touching: r_n
  kConePlus,        // stick: mu r_n + r_t (at zero, slip+ is next)
  kConeMinus,       // stick: mu r_n - r_t (at zero, slip- is next)
  kSlip,            // slip+-: +-(xi - xi_ref), the motion since the reference; what must be >= 0 is its rate
  kTotalSlip,       // slip+- by the total law: +-(xi - xi_ref) itself
  kPatchBegin,      // not sticking, on a surface with patches: xi - begin (at zero, the patch before is next)
  kPatchEnd,        // not sticking, on a surface with patches: end - xi (at zero, the patch after is next)
};

inline int NumberOf(ContactLimit limit) { return static_cast<int>(limit); }

}  // namespace contact_path

#endif  // CONTACT_PATH_CONTACT_CONTACT_LIMITS_H_
