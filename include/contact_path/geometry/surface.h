// Curves that bound the admissible points of the plane: where a point stands relative to one, and what follows from its
// foot.
#ifndef CONTACT_PATH_GEOMETRY_SURFACE_H_
#define CONTACT_PATH_GEOMETRY_SURFACE_H_

#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "contact_path/tolerances.h"

namespace contact_path {

// The foot of a point x on a curve c(xi) of unit speed, x = c(xi) + gap n(xi). Along the curve the tangent t = c' and
// the normal n, on the left of t, turn by t' = curvature n and n' = -curvature t: a hollow has positive curvature, the
// outside of a disc negative curvature. Every derivative of gap and xi by x follows from these numbers. Not finite
// where a point has no foot, as the centre of a circle.
struct Projection {
  double gap = 0.0;                                   // signed distance [length], >= 0 on the admissible side
  double xi = 0.0;                                    // arc coordinate of the foot [length]
  Eigen::Vector2d normal = Eigen::Vector2d::UnitY();  // at the foot, towards the admissible side; t = (n_y, -n_x)
  double curvature = 0.0;                             // [1/length]
  double curvature_first = 0.0;                       // its derivatives by xi [1/length^2, 1/length^3]
  double curvature_second = 0.0;
};

// t of a normal n: n is on the left of t.
inline Eigen::Vector2d TangentOf(const Eigen::Vector2d& normal) { return {normal.y(), -normal.x()}; }

// Derivatives of gap and xi by x, with m = 1 - curvature gap and k, k' for the curvature and its derivative:
//   grad gap = n, grad xi = t / m, hess gap = -k t t' / m,
//   hess xi = (k / m^2) (n t' + t n') + (k' gap / m^3) t t'.
Eigen::Vector2d XiGradient(const Projection& at);
Eigen::Matrix2d GapHessian(const Projection& at);
Eigen::Matrix2d XiHessian(const Projection& at);
// d/dh of both Hessians along x + h v at h = 0.
Eigen::Matrix2d GapHessianChange(const Projection& at, const Eigen::Vector2d& v);
Eigen::Matrix2d XiHessianChange(const Projection& at, const Eigen::Vector2d& v);

// In place of a patch: the one that is nearest, which is looked for where it is needed.
inline constexpr int kNearestPatch = std::numeric_limits<int>::min();

// Values of the arc coordinate [length].
struct XiRange {
  double begin = -std::numeric_limits<double>::infinity();
  double end = std::numeric_limits<double>::infinity();
};

// The point of a curve that is nearest to a point of the plane.
struct NearestFoot {
  int patch = 0;
  double distance = 0.0;  // >= 0 [length]
  bool is_end = false;    // it is an end of the curve, and not the foot of a perpendicular
  bool is_away = false;   // the point is so far behind the curve that it is not behind it: it went round an end
};

// The nearest one of feet on patches, offered in any order; of equally near ones that on the first patch.
struct NearestOfPatches {
  NearestFoot foot = {0, std::numeric_limits<double>::infinity()};
  double most = std::numeric_limits<double>::infinity();  // what is farther is not nearer

  void OfferFoot(int patch, double distance) { Offer({patch, distance}, distance); }
  // An end of the patch. Where the curve goes on, the foot on the next patch is as far, to rounding, and comes first.
  void OfferEnd(int patch, double distance, bool goes_on) {
    Offer({patch, distance, !goes_on}, goes_on ? (1.0 + tolerances::kActive) * distance : distance);
  }

 private:
  void Offer(const NearestFoot& offered, double counted) {
    if (!(counted < most || (counted == most && offered.patch < foot.patch))) return;
    most = counted;
    foot = offered;
  }
};

// A curve with a tangent that is continuous, walked with the admissible side on the left. It consists of patches, on
// which it is as smooth as a path needs it: from one patch to the next, curvature may jump, unless the curve is
// seamless. The arc coordinate is continuous over all patches. Patches are numbered from 0 along the curve. On a closed
// curve any number is a patch: patch + NumPatches() is the same place after one more round, and xi is larger by the
// length of the curve. Patches may be left out: the curve has ends there, too.
class Surface {
 public:
  virtual ~Surface() = default;

  // Whether the curvature is zero everywhere: then gap and xi are affine in x.
  virtual bool Flat() const { return false; }
  virtual bool Closed() const { return false; }
  // Whether the curvature has all derivatives also where patches meet: which of them a foot is on decides nothing.
  virtual bool Seamless() const { return false; }
  virtual int NumPatches() const { return 1; }  // of one round
  virtual XiRange RangeOf(int /*patch*/) const { return {}; }
  // Of a closed curve a patch of the first round, 0 to NumPatches() - 1. By default that of one patch without ends.
  virtual NearestFoot Nearest(const Eigen::Vector2d& x) const { return {0, std::abs(Project(x, 0).gap), false}; }
  // Nearest(), found faster where the foot is on the patch `near` or not far from it. near: a patch of the first round;
  // -1 = not known.
  virtual NearestFoot NearestFrom(const Eigen::Vector2d& x, int /*near*/) const { return Nearest(x); }
  // The foot on one patch, which is prolonged smoothly beyond both of its ends: xi tells where the foot is.
  virtual Projection Project(const Eigen::Vector2d& x, int patch) const = 0;
  // xi: of a point between the begin of the first patch and the end of the last one.
  virtual Eigen::Vector2d PointAt(double xi) const = 0;

  // From the begin of the first patch to the end of the last one.
  XiRange Range() const { return {RangeOf(0).begin, RangeOf(NumPatches() - 1).end}; }
  virtual bool HasPatch(int patch) const { return Closed() || (patch >= 0 && patch < NumPatches()); }
  Projection ProjectOnNearest(const Eigen::Vector2d& x) const { return Project(x, Nearest(x).patch); }
};

// The patch where a surface is nearest to x. Past an end of the surface: the number before the patch that begins at
// this end, or after the patch that ends there; the surface has no patch of this number. Away from the surface: a
// number whose neighbours the surface does not have either. On a closed surface in the first round, or in the round
// that brings it nearest to the patch `from`.
int PatchBeside(const Surface& surface, const Eigen::Vector2d& x, int from = kNearestPatch);
// Of xi on a patch; past an end of the surface infinite on one side.
XiRange RangeBeside(const Surface& surface, int patch);
// The gap on a patch. Where the surface does not have such a patch: the distance from the surface.
double GapBeside(const Surface& surface, const Eigen::Vector2d& x, int patch);

// Admissible side: n . (x - p) >= 0; xi = t . x.
class HalfPlane : public Surface {
 public:
  // normal: of any length > 0.
  HalfPlane(const Eigen::Vector2d& point, const Eigen::Vector2d& normal);

  bool Flat() const override { return true; }
  Projection Project(const Eigen::Vector2d& x, int patch) const override;
  Eigen::Vector2d PointAt(double xi) const override { return offset_ * normal_ + xi * TangentOf(normal_); }

 private:
  Eigen::Vector2d normal_;
  double offset_;  // n . p
};

}  // namespace contact_path

#endif  // CONTACT_PATH_GEOMETRY_SURFACE_H_
