// The unit in which the reactions of a contact are compared with tolerances.
#ifndef CONTACT_PATH_SRC_CONTACT_FORCE_UNIT_H_
#define CONTACT_PATH_SRC_CONTACT_FORCE_UNIT_H_

namespace contact_path {

// bound: of the forces at play across the surface (Structure::ForceBounds()). The smallest unit that is no less than
// it, and at most 1; more only where rounding makes reactions uncertain, as Structure::ResidualUnits() tells of forces.
// A power of 2, so that scaling by it is exact.
double ForceUnitAbove(double bound);

}  // namespace contact_path

#endif  // CONTACT_PATH_SRC_CONTACT_FORCE_UNIT_H_
