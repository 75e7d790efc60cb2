// A contact candidate: where its node stands relative to its surface, and how its reaction acts on the structure.
#ifndef CONTACT_PATH_CONTACT_CONTACT_PAIR_H_
#define CONTACT_PATH_CONTACT_CONTACT_PAIR_H_

#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "contact_path/contact/contact_state.h"
#include "contact_path/geometry/surface.h"
#include "contact_path/law/laws.h"
#include "contact_path/tolerances.h"

namespace contact_path {

// What is taken back of an overlap at the start as s grows: the gap is more than between the places by at_0 + rate s.
struct BroughtOn {
  double at_0 = 0.0;  // [length]
  double rate = 0.0;
};

// Gap u_n and surface coordinate xi as functions of the unknowns that move the pair, its dofs, and of the load factor.
// The columns of the matrix T of eq. (1) are their gradients: the force r_n grad u_n + r_t c grad xi acts on the
// structure (contact/contact_state.h). Slip is c dxi. Pieces of the law are patches of the surface, prolonged beyond
// their ends (geometry/surface.h). Functions with the parameter `patch` take kNearestPatch, too, except HasPatch() and
// RangeOf().
class ContactPair : public Law {
 public:
  // Whether the surface is a part of the structure: then other patches have other dofs, and c need not be 1.
  bool Deformable() const { return surface_traits_.deformable; }
  double Friction() const { return LargestRatio(); }  // mu; 0 where the pair cannot slide
  bool Frictional() const { return Friction() > 0.0; }
  // The force unit for the normal reaction. Where the friction coefficient is above 1, the friction force may be so
  // much larger, and the contact bears something as long as that force is not zero.
  double NormalForceUnit() const {
    // Of a rougher one, rounding would be told from zero.
    return ForceUnit() / std::clamp(Friction(), 1.0, tolerances::kActive / tolerances::kUnitComponent);
  }
  // Whether the surface has patches with ends, and not one patch without ends.
  bool HasPatches() const { return surface_traits_.has_patches; }
  // Whether a path may go from patch to patch without an event.
  bool Seamless() const { return surface_traits_.seamless; }
  // Length of a closed surface; 0 of an open one.
  double Round() const { return surface_traits_.round; }

  // The gap alone. Where the surface does not have such a patch, since the node is past an end of it: the distance from
  // that end.
  virtual double Gap(const Eigen::VectorXd& u, double s, int patch) const = 0;
  // Where the surface is nearest. Of a surface without patches the distance is the gap with its sign.
  virtual NearestFoot Nearest(const Eigen::VectorXd& u, double s) const = 0;
  // The patch where the surface is nearest; past an end of an open surface the number before the first patch, or after
  // the last one.
  int PatchAt(const Eigen::VectorXd& u, double s) const { return PatchAfter(u, s, kNearestPatch); }
  // PatchAt(), with the number of a closed surface counted in the round that brings it nearest to the patch `from`.
  // This function, HasPatch() and RangeOf() are by default those of one patch without ends.
  virtual int PatchAfter(const Eigen::VectorXd& /*u*/, double /*s*/, int /*from*/) const { return 0; }
  // `patch` itself, or the nearest patch where `patch` is kNearestPatch.
  int KnownPatch(const Eigen::VectorXd& u, double s, int patch) const {
    return patch == kNearestPatch ? PatchAt(u, s) : patch;
  }
  virtual bool HasPatch(int /*patch*/) const { return true; }
  // Where a node touches that is on an end of its surface: by rounding, the foot may be past the end.
  int PatchOfTouching(int patch) const;
  // Whether this number stands for a node that is away from the surface (geometry/surface.h).
  bool IsAway(int patch) const { return !HasPatch(patch - 1) && !HasPatch(patch) && !HasPatch(patch + 1); }
  // The range of xi, measured from 0, on the patch; past the ends of an open surface infinite on one side.
  virtual XiRange RangeOf(int /*patch*/) const { return {}; }

  // Whether another part of the surface than the patch that the node touches has come over the node between u and
  // `after`: that part is now nearer to it, or the node has gone through it. Asked of deformable pairs.
  virtual bool Overrun(const Eigen::VectorXd& /*u*/, const Eigen::VectorXd& /*after*/, int /*patch*/) const {
    return false;
  }
  // Whether a circle that touches on a patch has come upon another part of the surface.
  virtual bool TouchesTwice(const Eigen::VectorXd& /*u*/, double /*s*/, int /*patch*/) const { return false; }

  // The value of xi from which stick and slip are measured at (u, s): xi itself, or xi_0 of the total law, on a closed
  // surface counted in the round in which xi_0 is nearest.
  double SlipReference(const Eigen::VectorXd& u, double s, int patch) const;
  // Slip by the total law, since the start of the program: xi - xi_0. 0 by the incremental law.
  double Slipped(const Eigen::VectorXd& u, double s, int patch) const;
  // xi, measured from 0.
  double Xi(const Eigen::VectorXd& u, double s, int patch) const { return Law::Motion(kTangent, u, s, patch, {}); }
  // Where the foot is on the surface, as RangeOf() counts: xi, unless a circle rolls.
  std::size_t FootPort() const { return surface_traits_.rolls ? kFoot : kTangent; }
  double FootXi(const Eigen::VectorXd& u, double s, int patch) const {
    return Law::Motion(FootPort(), u, s, patch, {});
  }

  // The gap, 0 where it is closed by a tension.
  virtual double GapOnRecord(const Eigen::VectorXd& u, double s, int patch) const { return Gap(u, s, patch); }
  // r_t of the force of port 1, and the other way.
  virtual double OnRecord(const Eigen::VectorXd& /*u*/, double /*s*/, double force) const { return force; }
  virtual double FromRecord(const Eigen::VectorXd& /*u*/, double /*s*/, double rt) const { return rt; }

  double Motion(std::size_t port, const Eigen::VectorXd& u, double s, int patch,
                const PortReals& reference) const override;
  PortReals ReferenceAt(const Eigen::VectorXd& u, double s, int patch) const override {
    return {0.0, SlipReference(u, s, patch)};
  }
  double Reach(const Eigen::VectorXd& u, double s) const override { return Nearest(u, s).distance; }
  // Where two patches meet, slip leads to the patch ahead, and contacts that stick or are open keep their patch.
  // Frictionless contacts, contacts that slip by the total law of friction and circles that roll may take either patch.
  // Nothing slides over the end of an open surface. By the total law, the place of the node tells whether the contact
  // sticks, and to which side it has slipped.
  Modes ModesAt(const Eigen::VectorXd& u, double s, const Mode& now, const PortReals& forces,
                const ActiveSetTolerance& tolerance) const override;
  void AddLimits(const Mode& mode, int law, std::vector<Limit>* limits) const override;
  void AddNear(const Mode& mode, int law, std::vector<Limit>* limits) const override {
    AddPatchEnds(mode, law, limits);
  }
  double BoundOf(const Mode& mode, int id) const override;
  Mode Next(const Mode& mode, int id) const override;
  Mode NextAt(const Eigen::VectorXd& u, double s, const Mode& mode, int id) const override;
  bool Exists(const Mode& mode) const override;
  Mode Initial(const Eigen::VectorXd& u, double s) const override;
  Mode InState(const Eigen::VectorXd& u, double s, int state) const override;
  Mode AtStart(const Eigen::VectorXd& u, double s, const Mode& mode) const override;
  Mode Known(const Eigen::VectorXd& u, double s, const Mode& mode) const override {
    return {mode.state, KnownPatch(u, s, mode.piece)};
  }
  Mode OfPoint(const Mode& mode) const override;
  bool Passed(const Eigen::VectorXd& u, double s, const Mode& mode) const override;
  bool ChangesPiece(int from, int to) const override { return !Seamless() && from != to; }
  std::vector<Ray> Rays(const Eigen::VectorXd& u, double s, int patch,
                        const ActiveSetTolerance& tolerance) const override;

 protected:
  struct SurfaceTraits {
    bool has_patches = false, seamless = false;
    std::optional<double> slip_origin;  // xi_0 of the total law
    double round = 0.0;                 // length of a closed surface
    bool deformable = false;
    bool rolls = false;         // over patches: the foot moves whether the contact slides or not
    double compliance = 0.0;    // of ports that are held: scaled motion per force
    bool tangent_gives = true;  // whether it is that of the tangential port, too
    BroughtOn overlap;
  };
  // Of forces that a small compliance alone tells: what rounding of coordinates makes of them.
  static double ForceUnitOf(double compliance);
  // Of a distance from the surface.
  double GapAt(double s, double distance) const {
    const BroughtOn& overlap = surface_traits_.overlap;
    return overlap.at_0 == 0.0 ? distance : distance + overlap.at_0 + overlap.rate * s;
  }
  // Takes a distance and its gradient to the gap.
  void ToGap(double s, PortAt* distance) const {
    distance->motion = GapAt(s, distance->motion);
    distance->gradient[distance->gradient.size() - 1] += surface_traits_.overlap.rate;
  }
  // Set once, by the constructor of the pair. traits.largest_ratio: mu.
  void SetContact(Traits traits, const SurfaceTraits& surface_traits);

 private:
  std::vector<ContactState> StatesAt(const Eigen::VectorXd& u, double s, int patch, ContactState now, double rn,
                                     double rt, const ActiveSetTolerance& tolerance) const;
  bool PatchesEnd() const { return HasPatches() && !Seamless(); }
  void AddPatchEnds(const Mode& mode, int law, std::vector<Limit>* limits) const;

  SurfaceTraits surface_traits_;
};

// In scene order.
using ContactPairs = std::vector<std::unique_ptr<const ContactPair>>;

Laws LawsOf(const ContactPairs& contacts);

}  // namespace contact_path

#endif  // CONTACT_PATH_CONTACT_CONTACT_PAIR_H_
