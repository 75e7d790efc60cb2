// The path between two events: a smooth curve of the fixed-state equations.
#ifndef CONTACT_PATH_BRANCH_SMOOTH_ARC_H_
#define CONTACT_PATH_BRANCH_SMOOTH_ARC_H_

#include <Eigen/Core>
#include <array>
#include <map>
#include <optional>
#include <vector>

#include "contact_path/branch/crossing.h"
#include "contact_path/branch/polynomial.h"
#include "contact_path/contact/reach_tracker.h"
#include "contact_path/equations/fixed_state_system.h"
#include "contact_path/equations/jet.h"
#include "contact_path/equations/rigid_modes.h"
#include "contact_path/linear/bordered_solver.h"

namespace contact_path {

// A point of the curve with its derivatives by arc length |(du, ds)|. All vectors: unknowns of the fixed-state system.
struct CurvePoint {
  Eigen::VectorXd x;
  Eigen::VectorXd first;     // |(u, s) part| = 1
  Eigen::VectorXd second;    // orthogonal to first in (u, s)
  Eigen::Index nullity = 0;  // null directions of the equations besides the tangent
  int determinant_sign = 0;  // of the equations with the tangent as last row; 0 = singular
  int side = 0;  // determinant_sign; where it is 0 at a regular point, by rounding, `side` of the step's start
  double load_error = 0.0;  // of first of the load factor, where that is small: what rounding leaves of it
  // Sign of that rate; where it cannot be told from zero, the one that was told last on the arc, and at a limit point
  // the one beyond. 0: not told yet.
  int load_sense = 0;
  bool is_limit = false;     // located where the rate of the load factor is zero
  bool is_crossing = false;  // located where another curve crosses

  // The equations are singular here and not along the arc, whatever rounding says.
  void BeSingular() { determinant_sign = side = 0; }
};

// Turns the point onto another curve through it.
inline void TakeCurve(const Eigen::VectorXd& first, const Eigen::VectorXd& second, Eigen::Index load,
                      CurvePoint* point) {
  point->first = first;
  point->second = second;
  point->load_sense = SignBeyond(first[load], point->load_error);
  point->is_limit = point->is_crossing = false;
}

struct Correction {
  bool converged = false;
  Eigen::VectorXd x;
  int iterations = 0;
  double first_step = 0.0;    // norm of the first Newton step: the error of the guess
  double contraction = 0.0;   // ratio of the second step to the first
  std::vector<double> steps;  // norms of all Newton steps
};

class SmoothArc {
 public:
  // Both must outlive the arc.
  SmoothArc(const Structure& structure, const ContactPairs& contacts);

  // Fixes the states; stick and slip are measured from the tangential positions at `from`. rests: part of the structure
  // stands still at a limit point of its own (Branch::rests), so that the equations are singular all along the arc.
  void SetStates(const std::vector<ContactState>& states, const PathPoint& from, bool rests = false);
  const FixedStateSystem& system() const { return system_; }
  bool Rests() const { return rests_; }
  Eigen::Index NumMotion() const { return system_.NumDofs() + 1; }  // size of (u, s)

  // Derivatives at a point x of the curve, along the direction with a positive component on `towards` (NumMotion()).
  // False where they do not exist: singular element, or no direction along `towards`.
  bool Derivatives(const Eigen::VectorXd& x, const Eigen::VectorXd& towards, CurvePoint* point);

  // The point of the curve that a step is to begin at: Newton's method looks for points near it from now on.
  void SetOut(const CurvePoint& at);
  // Newton's method for the point of the curve with row . x = value, from guess. row: unknowns.
  Correction Correct(const Eigen::VectorXd& guess, const Eigen::VectorXd& row, double value);
  // Newton's method for the point of the curve on the plane through guess with this normal in (u, s), near the tangent.
  // It sets out with the factors of the last Derivatives() of these states, and factorises anew where these do not
  // lead on fast.
  Correction CorrectOnPlane(const Eigen::VectorXd& guess, const Eigen::VectorXd& normal);
  // Newton's method for the point of the curve where an inequality of the states is exactly zero, from guess.
  Correction CorrectOnto(const Constraint& constraint, const Eigen::VectorXd& guess);

  // What rounding leaves of a rate gradient . first at the point of the last Derivatives(): rounding of the equations
  // that the tangent solves, and of the point, M d = rounding with M = [J; row], which changes the rate by y . F''(t,
  // d), M' y = gradient.
  double ErrorOfRate(const Eigen::VectorXd& gradient, const CurvePoint& at);
  // How far rounding of the equations may move a point x of the curve on the plane with this normal in (u, s).
  double MovedByRounding(const Eigen::VectorXd& x, const Eigen::VectorXd& normal);

  // J x = (forces, 0), one solution of many that differ along the tangent, by the factors of the last Derivatives(): of
  // its point where nothing else was solved since. Empty: they are singular. forces: NumDofs().
  Eigen::VectorXd MotionUnder(const Eigen::VectorXd& forces) const;

  // Where another curve crosses, or nearly crosses, the arc near guess, whose tangent in (u, s) is about `tangent`.
  std::optional<Crossing> FindCrossing(const Eigen::VectorXd& guess, const Eigen::VectorXd& tangent);

  // Of the touching contacts, and the gaps at x that an increment of length `reach` may close.
  // open_ends: the ends of the patches that open candidates in reach are beside.
  std::vector<Constraint> InequalitiesInReach(const Eigen::VectorXd& x, double reach,
                                              std::vector<Constraint>* open_ends) {
    const Eigen::Index s = system_.NumDofs();
    in_reach_ = tracker_.InReach(x.head(s), x[s], reach);
    system_.PlaceOpen(in_reach_, x);
    *open_ends = system_.PatchEndsOfOpen(in_reach_);
    return system_.InequalitiesOf(in_reach_);
  }
  // Whether a candidate of the last InequalitiesInReach() that is open is behind its surface at x, on another patch
  // than its own.
  bool BehindOtherPatch(const Eigen::VectorXd& x) const { return system_.BehindOtherPatch(in_reach_, x); }

  // The rounding of an inequality other than of slip: down to minus this value it counts as holding.
  double RoundingOf(const Constraint& constraint) const;

  int factorisations() const { return factorisations_; }

 private:
  // at_hand: with the factors that there are; gives up where they do not lead on fast.
  Correction Newton(const Eigen::VectorXd& guess, const Eigen::VectorXd& row, double value, bool at_hand);
  // A short last step need not leave a small residual: not among stiff parts, nor by the factors of another point.
  // Newton steps with the factors at hand follow for as long as each halves the residual. What the last one would have
  // changed the reactions by is what rounding leaves of them.
  void LowerResidual(const Eigen::VectorXd& row, double value, Eigen::VectorXd* x);
  // Forces relative to the largest of load factor and reactions, motions to the largest coordinate, each + 1.
  bool EquationsHold(const Eigen::VectorXd& x);
  // Where the Jacobian has a null plane with *first in it: puts the tangent that is nearest to `towards` into *first.
  void ChooseInPlane(const Eigen::VectorXd& x, const Eigen::VectorXd& towards, Eigen::VectorXd* first);
  // Takes from *change, a solution of the singular equations, what would move the part at rest off its limit point:
  // with the null vectors n on the right, psi on the left, psi . F''(n, change) = 0.
  void HoldLimitPoint(const Eigen::VectorXd& x, Eigen::VectorXd* change);
  // States may close a contact over a gap that is not 0 but counts as closed: notes the forces that this changes.
  void NoteClosedGaps(const PathPoint& from);
  // Where elements want it, the first matrix of Newton's method from guess has the strains along the tangent of the
  // point set out from.
  void ExtrapolateStrains(const Eigen::VectorXd& guess);
  // x: where rigid motions of parts are looked for. False if the matrix is not finite.
  bool Factorize(const Eigen::VectorXd& x, const Eigen::SparseMatrix<double>& transposed, const Eigen::VectorXd& row,
                 double rank_tolerance);
  bool Factorize(const Eigen::VectorXd& x, const Eigen::VectorXd& row, double rank_tolerance = 0.0);

  const Structure& structure_;
  const ContactPairs& contacts_;
  FixedStateSystem system_;
  ReachTracker tracker_;
  BorderedSolver solver_;
  std::vector<std::size_t> in_reach_;  // in the last call of InequalitiesInReach()
  bool at_hand_ = false;  // regular factors of a point of the curve with these states, the last row along the tangent
  std::map<int, double> moved_forces_;  // by contact that the states close over a gap: see NoteClosedGaps()
  RigidModes modes_;
  // Whether rigid motions of parts are free along the arc, and springs hold them; nothing: not known yet.
  std::optional<bool> held_;
  Eigen::MatrixXd free_;         // these motions at the last point, orthonormal columns; none where held_ is not true
  double reaction_error_ = 0.0;  // of the last point that Newton's method found
  bool rests_ = false;           // part of the structure stands still at a limit point of its own (Branch::rests)
  Eigen::VectorXd residual_, step_length_;
  Eigen::VectorXd origin_, tangent_at_origin_;  // of SetOut() with these states, (u, s); empty: none
  Eigen::VectorXd strains_from_, strains_to_;   // for Structure::MixedTangent(), (u, s)
  int factorisations_ = 0;
};

// A step on an arc: both ends with derivatives, parameter t in [0, length] = the projection of (u, s) - start on the
// tangent at the start. Between the ends, quintic Hermite interpolation: error of order length^6.
struct Step {
  CurvePoint start;
  CurvePoint end;
  Eigen::VectorXd normal;  // (u, s) part of start.first
  double length = 0.0;

  // Of a function of x, from along(point): its value and its derivatives by arc length at a point of the curve.
  template <typename Along>
  Quintic Interpolate(Along along) const {
    const double c = normal.dot(end.first.head(normal.size()));
    const double bend = normal.dot(end.second.head(normal.size()));
    Jet at_end = along(end);
    at_end.first /= c;
    at_end.second = (at_end.second - at_end.first * bend) / (c * c);
    return HermiteQuintic(along(start), at_end, length);
  }
  // Of a linear function of x.
  template <typename Function>
  Quintic InterpolateLinear(Function function) const {
    return Interpolate([&function](const CurvePoint& point) {
      return Jet{function(point.x), function(point.first), function(point.second)};
    });
  }
  // All unknowns at t, and the whole point with derivatives by arc length; the rest as at the start.
  Eigen::VectorXd Point(double t) const;
  CurvePoint At(double t) const;
  // Length of the curve in (u, s), by Gauss quadrature of the interpolation.
  double ArcLength() const;
};

// Six points on the interpolation of a step, to interpolate any function of the unknowns by a quintic: a linear one
// exactly.
class QuinticNodes {
 public:
  explicit QuinticNodes(const Step& step);

  // value(x): the function.
  template <typename Value>
  Quintic Interpolate(Value value) const {
    std::array<double, 6> values{};
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = value(points_[i]);
    return QuinticThrough(values, length_);
  }

 private:
  double length_;
  std::array<Eigen::VectorXd, 6> points_;  // at QuinticNode(i, length)
};

Step MakeStep(const CurvePoint& start, const CurvePoint& end, Eigen::Index num_motion);

}  // namespace contact_path

#endif  // CONTACT_PATH_BRANCH_SMOOTH_ARC_H_
