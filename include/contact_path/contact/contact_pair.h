// A contact candidate: where its node stands relative to its surface, and how its reaction acts on the structure.
#ifndef CONTACT_PATH_CONTACT_CONTACT_PAIR_H_
#define CONTACT_PATH_CONTACT_CONTACT_PAIR_H_

#include <Eigen/Core>
#include <algorithm>
#include <bitset>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "contact_path/contact/kinematics.h"
#include "contact_path/contact/path_point.h"
#include "contact_path/geometry/surface.h"
#include "contact_path/tolerances.h"

namespace contact_path {

// Gap u_n and surface coordinate xi as functions of the unknowns that move the pair, its dofs, and of the load factor.
// The columns of the matrix T of eq. (1) are their gradients: the force r_n grad u_n + r_t c grad xi acts on the
// structure (contact/kinematics.h). Slip is c dxi. q stands for (dofs, s) throughout: m + 1 entries with m =
// Dofs(patch).size() <= kMostPairDofs, the load factor last.
class ContactPair {
 public:
  virtual ~ContactPair() = default;

  // Of a known patch.
  virtual PairDofs Dofs(int /*patch*/) const { return traits_.dofs; }
  // Whether the surface is a part of the structure: then other patches have other dofs, and c need not be 1.
  bool Deformable() const { return traits_.deformable; }
  double Friction() const { return traits_.friction; }  // mu; 0 where the pair cannot slide
  bool Frictional() const { return traits_.friction > 0.0; }
  // A power of 2 up to 1, of the order of the forces across the surface where the parts at the node are far softer than
  // the structure as a whole: reactions are compared with tolerances times this force.
  double ForceUnit() const { return traits_.force_unit; }
  // The same for the normal reaction. Where the friction coefficient is above 1, the friction force may be so much
  // larger, and the contact bears something as long as that force is not zero.
  double NormalForceUnit() const {
    // Of a rougher one, rounding would be told from zero.
    return traits_.force_unit / std::clamp(traits_.friction, 1.0, tolerances::kActive / tolerances::kUnitComponent);
  }
  // Whether the surface has patches with ends, and not one patch without ends.
  bool HasPatches() const { return traits_.has_patches; }
  // Whether a path may go from patch to patch without an event.
  bool Seamless() const { return traits_.seamless; }
  // Whether Hessians can be other than zero.
  bool Curved() const { return traits_.curved; }
  // Whether the friction force follows the motion since the start of the program, and not since the last increment.
  bool HasTotalLaw() const { return traits_.slip_origin.has_value(); }
  // Length of a closed surface; 0 of an open one.
  double Round() const { return traits_.round; }
  // Whether the gradient of the gap, of xi, can be other than zero in the entry k of q: their sparsity.
  bool MovesGap(std::size_t k) const { return traits_.moves_gap[k]; }
  bool MovesXi(std::size_t k) const { return traits_.moves_xi[k]; }
  // An upper bound of |d u_n| over |(du, ds)|; infinite where there is none.
  double LargestGapRate() const { return traits_.largest_gap_rate; }

  // u: may have more entries than dofs. patch: of the surface, prolonged beyond its ends (geometry/surface.h).
  // reference: the value of xi from which xi is measured.
  virtual void Evaluate(const Eigen::VectorXd& u, double s, int patch, double reference,
                        Kinematics* kinematics) const = 0;
  // The gap alone. Where the surface does not have such a patch, since the node is past an end of it: the distance from
  // that end.
  virtual double Gap(const Eigen::VectorXd& u, double s, int patch) const = 0;
  // Where the surface is nearest. Of a surface without patches the distance is the gap with its sign.
  virtual NearestFoot Nearest(const Eigen::VectorXd& u, double s) const = 0;
  // The patch where the surface is nearest; past an end of an open surface the number before the first patch, or after
  // the last one.
  virtual int PatchAt(const Eigen::VectorXd& u, double s) const = 0;
  // PatchAt(), with the number of a closed surface counted in the round that brings it nearest to the patch `from`.
  virtual int PatchAfter(const Eigen::VectorXd& u, double s, int from) const = 0;
  // At the start of a step, of a contact that touches and has come along the patch `from`: of a seamless surface
  // PatchAfter(), of any other `from` itself.
  int PatchNow(const Eigen::VectorXd& u, double s, int from) const {
    return Seamless() ? PatchAfter(u, s, from) : from;
  }
  // `patch` itself, or the nearest patch where `patch` is kNearestPatch. Functions with the parameter `patch` take
  // kNearestPatch, too, except HasPatch() and RangeOf().
  int KnownPatch(const Eigen::VectorXd& u, double s, int patch) const {
    return patch == kNearestPatch ? PatchAt(u, s) : patch;
  }
  virtual bool HasPatch(int patch) const = 0;
  // Whether this number stands for a node that is away from the surface (geometry/surface.h).
  bool IsAway(int patch) const { return !HasPatch(patch - 1) && !HasPatch(patch) && !HasPatch(patch + 1); }
  // The range of xi, measured from 0, on the patch; past the ends of an open surface infinite on one side.
  virtual XiRange RangeOf(int patch) const = 0;
  // *hessian = second derivatives by q of weights . (r_n grad u_n + r_t c grad xi), r_n and r_t do not change: m + 1
  // square, symmetric. Asked of curved pairs only, as SecondDirectional().
  virtual void ForceHessian(const Eigen::VectorXd& u, double s, int patch, double rn, double rt,
                            const PairVector& weights, PairMatrix* hessian) const = 0;
  // d2/dh2 of the force r_n grad u_n + r_t c grad xi along q + h direction at h = 0, by q; r_n and r_t do not change.
  // Where c is 1 throughout, the force is a gradient, and this is ForceHessian() with the direction for weights, times
  // the direction.
  virtual PairVector SecondDirectional(const Eigen::VectorXd& u, double s, int patch, double rn, double rt,
                                       const PairVector& direction) const;
  // c and its first two derivatives by h along q + h first + h^2 / 2 second.
  virtual Eigen::Vector3d SlipFactorAlong(const Eigen::VectorXd& u, double s, int patch, const PairVector& first,
                                          const PairVector& second) const;

  // Whether another part of the surface than the patch that the node touches has come over the node between u and
  // `after`: that part is now nearer to it, or the node has gone through it. Asked of deformable pairs.
  virtual bool Overrun(const Eigen::VectorXd& /*u*/, const Eigen::VectorXd& /*after*/, int /*patch*/) const {
    return false;
  }

  // The value of xi from which stick and slip are measured at (u, s): xi itself, or xi_0 of the total law, on a closed
  // surface counted in the round in which xi_0 is nearest.
  double SlipReference(const Eigen::VectorXd& u, double s, int patch) const;
  // Slip by the total law, since the start of the program: xi - xi_0. 0 by the incremental law.
  double Slipped(const Eigen::VectorXd& u, double s, int patch) const;
  // xi, measured from 0.
  double Xi(const Eigen::VectorXd& u, double s, int patch) const;
  // Slip along (du, ds) at (u, s): c grad xi . (du, ds).
  double SlipRate(const Eigen::VectorXd& u, double s, int patch, const Eigen::VectorXd& du, double ds) const;
  // Slip from (u, s) on `patch` to (u + du, s + ds) on `patch_after`. On a rigid surface: the change of xi. On a
  // deformable surface: the mean of two lengths between both feet, on its shapes before and after; past an end of the
  // surface, the foot is its end.
  virtual double Slip(const Eigen::VectorXd& u, double s, int patch, const Eigen::VectorXd& du, double ds,
                      int patch_after) const;

 protected:
  using Terms = std::bitset<kMostPairDofs + 1>;
  struct Traits {
    PairDofs dofs;  // of all patches, unless deformable
    bool deformable = false;
    double friction = 0.0;
    double force_unit = 1.0;
    bool has_patches = false, seamless = false;
    bool curved = false;
    Terms moves_gap, moves_xi;
    double largest_gap_rate = 1.0;
    std::optional<double> slip_origin;  // xi_0 of the total law
    double round = 0.0;
  };
  const PairDofs& OwnDofs() const { return traits_.dofs; }
  // What does not change; set once, by the constructor of the pair.
  void SetTraits(const Traits& traits) { traits_ = traits; }

 private:
  Traits traits_;
};

// In scene order.
using ContactPairs = std::vector<std::unique_ptr<const ContactPair>>;

// Largest of all |r_n| and |r_t|, in the force unit of the contact.
double LargestReaction(const ContactPairs& contacts, const PathPoint& point);

// SlipReference() of all candidates on the patches of the point.
Eigen::VectorXd SlipReferences(const ContactPairs& contacts, const PathPoint& point);

// bound: of the forces at play across the surface (Structure::ForceBounds()). The smallest unit that is no less than
// it, and at most 1; more only where rounding makes reactions uncertain, as Structure::ResidualUnits() tells of forces.
// A power of 2, so that scaling by it is exact.
double ForceUnitAbove(double bound);

}  // namespace contact_path

#endif  // CONTACT_PATH_CONTACT_CONTACT_PAIR_H_
