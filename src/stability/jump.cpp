#include "contact_path/stability/jump.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "contact_path/branch/contact_arc.h"
#include "contact_path/linear/generic_vector.h"
#include "contact_path/tolerances.h"
#include "stability/motion_step.h"

namespace contact_path {
namespace {

// A motion that ends within so many pushes has come back.
constexpr double kBack = 10.0;
// Largest motion of a step, of the extent of the structure and of the way from the start.
constexpr double kStride = 0.01;
// Steps on the way of a jump, at least. Half as long steps change the work of friction by less than 1e-3 of itself: by
// up to 5e-4 in scenes/snap_hook.yaml, by 1e-5 in scenes/rough_arch.yaml, by nothing where one contact slides straight.
constexpr double kLeastSteps = 200.0;
// The same with inertia: a swing goes along the way once forth and back, and implicit Euler damps a swing of n steps
// by pi / n of critical.
constexpr double kLeastStepsOfSwing = 40.0;
// Of critical, for the slowest motion.
constexpr double kLightDrag = 0.03;
// Kinetic energy that does not lift the structure out of a valley any more, of the largest on the way.
constexpr double kAtRest = 1e-3;
// Extents of the structure: what goes farther flies off.
constexpr double kFar = 1e3;
// Ratio of the speeds of two steps, 1 / (1 - lambda h) by implicit Euler: beyond, growth is taken for decay. A step of
// twice the length stays below this ratio if the ratio now is below kSlowGrowth. Decay by this ratio settles within few
// steps.
constexpr double kMostGrowth = 2.0, kSlowGrowth = 2.0 * kMostGrowth / (kMostGrowth + 1.0);
// First step: drag is so many times the stiffness, so that each contact alone decides on its state.
constexpr double kFirstDrag = 10.0;
constexpr double kOverStride = 1.5;   // a step that is longer than it should be by less is not made again
constexpr int kMostShortenings = 12;  // of a step for its quality; kinks of the motion stay
constexpr int kEasyIterations = 6;    // of Newton's method in a step that may become longer
constexpr int kEasyRounds = 2;        // of the active set
constexpr int kMostSteps = 20000;

double Largest(const Eigen::VectorXd& change) { return change.size() == 0 ? 0.0 : change.lpNorm<Eigen::Infinity>(); }

// Largest range of a coordinate of the nodes, at least 1.
double ExtentOf(const Structure& structure, const Eigen::VectorXd& u) {
  const Eigen::VectorXd values = structure.AllValues(u);
  const std::vector<DofMap::Component>& components = structure.Dofs().Components();
  double extent = 1.0;
  for (int axis = 0; axis < kPositionComponents; ++axis) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (std::size_t i = 0; i < components.size(); ++i) {
      if (components[i].field != Field::kPosition || components[i].component != axis) continue;
      least = std::min(least, values[static_cast<Eigen::Index>(i)]);
      most = std::max(most, values[static_cast<Eigen::Index>(i)]);
    }
    extent = std::max(extent, most - least);
  }
  return extent;
}

Eigen::VectorXd DiagonalStiffness(const Structure& structure, const Eigen::VectorXd& u) {
  Eigen::SparseMatrix<double> tangent = structure.TangentPattern();
  structure.Tangent(u, &tangent);
  return tangent.diagonal().cwiseAbs();
}

// Where a node has no stiffness it has the share of it that does not count.
Eigen::VectorXd StiffnessOfNodes(const Structure& structure, const Eigen::VectorXd& diagonal) {
  const auto key = [](const DofMap::Component& of) {
    return static_cast<std::size_t>(2 * of.node + (of.field == Field::kRotation ? 1 : 0));
  };
  std::vector<double> largest;
  for (const DofMap::Component& of : structure.Dofs().Components()) {
    largest.resize(std::max(largest.size(), key(of) + 1), 0.0);
    if (of.dof >= 0) largest[key(of)] = std::max(largest[key(of)], diagonal[of.dof]);
  }
  const double most = std::max(diagonal.maxCoeff(), std::numeric_limits<double>::min());
  Eigen::VectorXd share = Eigen::VectorXd::Ones(diagonal.size());
  for (const DofMap::Component& of : structure.Dofs().Components())
    if (of.dof >= 0) share[of.dof] = std::max(largest[key(of)] / most, tolerances::kSmallShare);
  return share;
}

Eigen::VectorXd DefaultPush(const Structure& structure, double s) {
  if (!structure.ReferenceLoad().isZero(0.0)) return (s < 0.0 ? -1.0 : 1.0) * structure.ReferenceLoad();
  if (!structure.ConstantLoad().isZero(0.0)) return structure.ConstantLoad();
  return GenericVector(structure.NumDofs());
}

// M u'' + C u' resist the motion. By unknown; supports move as they are driven.
struct Resistance {
  Eigen::VectorXd mass, drag;

  bool HasMass() const { return !mass.isZero(0.0); }
  // Of a step of the time h from u with the velocity v: D (u - a), implicit Euler.
  Eigen::VectorXd Diagonal(double h) const { return mass / (h * h) + drag / h; }
  Eigen::VectorXd Anchor(double h, const Eigen::VectorXd& u, const Eigen::VectorXd& v) const {
    Eigen::VectorXd anchor = u;
    const Eigen::VectorXd diagonal = Diagonal(h);
    for (Eigen::Index i = 0; i < u.size(); ++i)
      if (mass[i] > 0.0) anchor[i] += mass[i] * v[i] / (h * diagonal[i]);
    return anchor;
  }
};

// Work along the way, by the trapezoidal rule.
class WorkAlong {
 public:
  WorkAlong(const Structure& structure, const ContactPairs& contacts)
      : structure_(structure), contacts_(contacts), slopes_(contacts.size(), 0.0), driving_(structure, contacts) {}

  void Add(const PathPoint& from, const MotionStep& step) {
    const bool impact =
        std::any_of(step.closed_after.begin(), step.closed_after.end(), [](double share) { return share > 0.0; });
    end_alone_ = impact || after_impact_;
    after_impact_ = impact;
    for (std::size_t i = 0; i < contacts_.size(); ++i)
      if (contacts_[i]->Frictional()) friction_ += OfContact(i, from, step);
    const PathPoint& to = step.point;
    const Eigen::VectorXd du = to.u - from.u;
    loads_ += 0.5 * (from.s + to.s) * structure_.ReferenceLoad().dot(du) + structure_.ConstantLoad().dot(du);
    if (to.s != from.s) loads_ += 0.5 * (DrivingForce(from) + DrivingForce(to)) * (to.s - from.s);
  }
  double friction() const { return friction_; }
  double loads() const { return loads_; }

 private:
  double OfContact(std::size_t i, const PathPoint& from, const MotionStep& step) {
    const ContactPair& pair = *contacts_[i];
    const PathPoint& to = step.point;
    const auto k = static_cast<Eigen::Index>(i);
    const auto slip = [&] {
      return pair.Slip(from.u, from.s, from.Patch(i), to.u - from.u, to.s - from.s, to.Patch(i));
    };
    if (pair.HasTotalLaw()) return -0.5 * (from.rt[k] + to.rt[k]) * slip();
    const bool touched = from.states[i] != ContactState::kOpen;
    if (Slips(to.states[i])) {
      const double length = std::abs(slip()) * (1.0 - step.closed_after[i]);
      const double after = pair.Friction() * to.rn[k],
                   before = touched && !end_alone_ ? pair.Friction() * from.rn[k] : after;
      slopes_[i] = length > 0.0 ? (before - after) / length : 0.0;
      return 0.5 * (before + after) * length;
    }
    if (to.states[i] != ContactState::kOpen || !Slips(from.states[i])) return 0.0;
    // It slides until nothing presses it: as far as its force falls on as it has fallen.
    const double force = pair.Friction() * from.rn[k], length = std::abs(slip());
    return 0.5 * force * (slopes_[i] > 0.0 ? std::min(length, force / slopes_[i]) : length);
  }
  // Of moving supports and obstacles, along their motion with s.
  double DrivingForce(const PathPoint& at) {
    driving_.SetStates(at.states, SlipReferences(contacts_, at), at.patches);
    const Eigen::VectorXd x = driving_.Pack(at), still = Eigen::VectorXd::Zero(x.size());
    return driving_.DrivingForceAlong(x, still, still).value;
  }

  const Structure& structure_;
  const ContactPairs& contacts_;
  std::vector<double> slopes_;  // by candidate: how its friction force has fallen with its slip
  FixedStateSystem driving_;
  // Reactions of a step in which a contact closes are of an impact: they hold in this step alone.
  bool after_impact_ = false, end_alone_ = false;
  double friction_ = 0.0, loads_ = 0.0;
};

// How one motion went.
struct Course {
  std::optional<Landing> landing;
  double followed = 0.0;  // largest distance from the start
  double length = 0.0;    // of the way, by the largest unknown of each step
  double norm = 0.0;      // of the way, by the Euclidean norm
  Eigen::VectorXd left;   // motion (u) with which it has left the start for good; empty where it has not
  bool came_back = false;
  bool cancelled = false;
};

class Jumper {
 public:
  Jumper(const Structure& structure, const ContactPairs& contacts, const PathPoint& from, const Machine& machine,
         const std::function<bool()>& cancelled)
      : structure_(structure),
        contacts_(contacts),
        machine_(MachineEquation::Of(structure, machine, from)),
        solver_(structure, contacts, machine_),
        arc_(structure, contacts),
        start_(solver_.WithPatches(from)),
        extent_(ExtentOf(structure, from.u)),
        diagonal_(DiagonalStiffness(structure, from.u)),
        moved_(Eigen::VectorXd::Ones(from.u.size())),
        cancelled_(cancelled) {
    for (const PrescribedDof& prescribed : structure.PrescribedDofs()) moved_[prescribed.dof] = 0.0;
  }

  JumpResult Run(const Eigen::VectorXd& push, bool checked) {
    JumpResult result;
    const double size = Largest(push);
    if (!(size > 0.0)) return result;
    // A limit point is left with the square of the distance from it, a bifurcation with the third power.
    Course course;
    for (const double share : {tolerances::kShort, tolerances::kNextToStart}) {
      Eigen::VectorXd disturbance = share * extent_ / size * push;
      course = FollowFinely(&disturbance);
      if (!course.came_back) break;
    }
    result.cancelled = course.cancelled;
    result.came_back = course.came_back;
    result.followed = course.followed;
    result.landing = result.landings[0] = course.landing;
    if (course.landing && checked) Compare(course, &result);
    return result;
  }

 private:
  // With the disturbance, or where the structure comes back against it: then it has the other sign.
  Course FollowEither(const Resistance& resistance, Eigen::VectorXd* disturbance, double stride) {
    Course course = Follow(resistance, *disturbance, stride);
    if (!course.came_back) return course;
    *disturbance = -*disturbance;
    return Follow(resistance, *disturbance, stride);
  }

  // By uniform drag, with as many steps as the way of the jump wants.
  Course FollowFinely(Eigen::VectorXd* disturbance) {
    const Resistance uniform = {0.0 * moved_, moved_};
    for (stride_ = kStride * extent_;;) {
      Course course = FollowEither(uniform, disturbance, stride_);
      const double wanted = course.length / kLeastSteps;
      if (!course.landing || wanted >= 0.99 * stride_) return course;
      stride_ = wanted;
    }
  }

  // Adds the other drags.
  void Compare(const Course& uniform, JumpResult* result) {
    const Eigen::VectorXd disturbance = tolerances::kShort * extent_ / Largest(uniform.left) * uniform.left;
    Eigen::VectorXd either = disturbance;
    const Eigen::VectorXd by_stiffness = moved_.cwiseProduct(StiffnessOfNodes(structure_, diagonal_));
    result->landings[1] = FollowEither({0.0 * moved_, by_stiffness}, &either, stride_).landing;
    // The slowest motion: the energy released, as kinetic energy of a swing over half the way.
    const double released = std::max(0.0, uniform.landing->energy_released());
    either = disturbance;
    const double rate = 2.0 * std::sqrt(2.0 * released) / uniform.norm;
    result->landings[2] =
        FollowEither({moved_, 2.0 * kLightDrag * rate * moved_}, &either, uniform.length / kLeastStepsOfSwing).landing;
    result->robust = true;
    for (const std::optional<Landing>& a : result->landings) {
      result->robust = result->robust && a.has_value();
      for (const std::optional<Landing>& b : result->landings)
        if (a && b) result->largest_difference = std::max(result->largest_difference, Largest(a->point.u - b->point.u));
    }
    result->robust = result->robust && result->largest_difference <= tolerances::kSameTangent * extent_;
    result->cancelled = Cancelled();
  }

  bool Cancelled() const { return cancelled_ && cancelled_(); }

  // The time of the first step.
  double FirstTime(const Resistance& resistance) const {
    double largest = 0.0;  // stiffness over drag or mass
    const Eigen::VectorXd& by = resistance.HasMass() ? resistance.mass : resistance.drag;
    for (Eigen::Index i = 0; i < by.size(); ++i)
      if (by[i] > 0.0) largest = std::max(largest, diagonal_[i] / by[i]);
    largest = kFirstDrag * std::max(largest, 1.0);
    return resistance.HasMass() ? 1.0 / std::sqrt(largest) : 1.0 / largest;
  }

  // One motion on its way.
  struct Motion {
    const Resistance& resistance;
    const Eigen::VectorXd& disturbance;
    double stride;  // largest motion of a step within the extent of the structure
    PathPoint now;
    Eigen::VectorXd velocity;
    WorkAlong work;
    double time = 0.0;  // of the next step
    bool pushed = false;
    int shortened = 0;  // how often the next step was, for its quality
    // Of the last step, and the largest so far. A push moves the structure from rest to rest.
    double speed = 0.0, most_kinetic = 0.0, fastest = 0.0;
    double growth = 0.0;  // of the speed, from the step before
    Course course = {};

    bool Swings() const { return resistance.HasMass(); }
    double Nearby() const { return kBack * Largest(disturbance); }
    // Swings slow down and speed up; only on its way from the start does a motion that is too long a step look so.
    bool IsEarly() const { return !Swings() || course.followed < stride; }
  };

  Course Follow(const Resistance& resistance, const Eigen::VectorXd& disturbance, double stride) {
    Motion motion{resistance, disturbance, stride, start_, 0.0 * start_.u, WorkAlong(structure_, contacts_)};
    const double first = FirstTime(resistance);
    // A drag below the rounding of the stiffness lets everything come to rest.
    const double longest = first / tolerances::kUnitComponent, shortest = first * tolerances::kRootOfRounding;
    motion.time = first;
    Course& course = motion.course;
    for (int count = 0; count < kMostSteps; ++count) {
      course.cancelled = Cancelled();
      if (course.cancelled) break;
      const std::optional<MotionStep> step = Try(motion);
      if (!step || IsTooLong(motion, *step)) {
        motion.time *= step ? 0.5 : 0.25;
        motion.shortened += step ? 1 : 0;
        if (motion.time < shortest) break;
        continue;
      }
      const double length = Largest(step->point.u - motion.now.u);
      const bool settles = Accept(*step, &motion) && length <= Admitted(motion);
      const double distance = Largest(motion.now.u - start_.u);
      if (course.followed > kFar * extent_) break;
      if (course.left.size() == 0 && distance > motion.Nearby()) course.left = motion.now.u - start_.u;
      if (settles && distance > motion.Nearby()) course.landing = Land(motion.now, stride, motion.work);
      if (course.landing) break;
      course.came_back = motion.time > longest && distance <= motion.Nearby();
      if (motion.time > longest) break;
      ChooseTime(*step, length, &motion);
    }
    return course;
  }

  std::optional<MotionStep> Try(const Motion& motion) {
    Eigen::VectorXd anchor = motion.resistance.Anchor(motion.time, motion.now.u, motion.velocity);
    if (!motion.pushed) anchor += motion.disturbance;
    return solver_.Solve(motion.now, motion.resistance.Diagonal(motion.time), anchor);
  }

  // Largest motion of a step: beyond the structure it grows with the way.
  double Admitted(const Motion& motion) const {
    return std::max(motion.stride, kStride * (motion.course.followed - extent_));
  }

  bool IsTooLong(const Motion& motion, const MotionStep& step) {
    if (motion.shortened >= kMostShortenings) return false;
    if (step.determinant_sign * SignOfDrag(step.point) < 0) return true;
    const Eigen::VectorXd du = step.point.u - motion.now.u;
    if (Largest(du) > kOverStride * Admitted(motion)) return true;
    return motion.IsEarly() && motion.speed > 0.0 && !step.changed &&
           du.norm() / motion.time > kMostGrowth * motion.speed;
  }

  // Goes to the end of the step. Whether the motion comes to rest, in states that stay.
  bool Accept(const MotionStep& step, Motion* motion) const {
    const Eigen::VectorXd du = step.point.u - motion->now.u;
    const double speed = du.norm() / motion->time;
    motion->work.Add(motion->now, step);
    motion->course.length += Largest(du);
    motion->course.norm += du.norm();
    motion->now = step.point;
    motion->course.followed = std::max(motion->course.followed, Largest(step.point.u - start_.u));
    if (!motion->pushed) {
      motion->pushed = true;
      return false;
    }
    bool settles = kMostGrowth * speed <= motion->speed;
    if (motion->Swings()) {
      motion->velocity = du / motion->time;
      motion->fastest = std::max(motion->fastest, Largest(motion->velocity));
      const double kinetic = 0.5 * speed * speed;
      motion->most_kinetic = std::max(motion->most_kinetic, kinetic);
      settles = kinetic <= kAtRest * motion->most_kinetic;
    }
    motion->growth = motion->speed > 0.0 ? speed / motion->speed : 0.0;
    motion->speed = speed;
    return settles && !step.changed;
  }

  // The time of the step after this one of the given length.
  void ChooseTime(const MotionStep& step, double length, Motion* motion) const {
    const bool easy = motion->shortened == 0 && step.iterations <= kEasyIterations && step.rounds <= kEasyRounds;
    const bool slow = !motion->IsEarly() || motion->growth <= kSlowGrowth;
    if (easy && slow && length < 0.5 * Admitted(*motion)) motion->time *= 2.0;
    if (motion->fastest > 0.0) motion->time = std::min(motion->time, motion->stride / motion->fastest);
    motion->shortened = 0;
  }

  // The equilibrium at a point where the motion comes to rest: the step of infinite time, with the states that there
  // are, to a point that is near and that nothing drives away from.
  std::optional<Landing> Land(const PathPoint& at, double near, WorkAlong work) {
    const std::optional<MotionStep> step = solver_.Solve(at, 0.0 * moved_, at.u);
    if (!step || step->changed || Largest(step->point.u - at.u) > near) return std::nullopt;
    PathPoint from = at;
    from.patches = step->point.patches;
    arc_.SetStates(step->point.states, from);
    const FixedStateSystem& system = arc_.system();
    const Correction correction =
        arc_.Correct(system.Pack(step->point), machine_.Row(system.NumUnknowns()), machine_.value);
    if (!correction.converged || !InequalitiesHold(correction.x)) return std::nullopt;
    MotionStep last = *step;
    last.point = system.Unpack(correction.x);
    const int sign = solver_.DeterminantSign(last.point, 0.0 * moved_);
    if (sign * SignOfDrag(last.point) < 0) return std::nullopt;
    work.Add(at, last);
    Landing landing;
    landing.point = last.point;
    landing.friction = work.friction();
    landing.loads = work.loads();
    landing.stored = structure_.Energy(last.point.u) - structure_.Energy(start_.u);
    return landing;
  }

  // Sign of the determinant with so much drag that nothing drives away from the point. A step by implicit Euler from
  // which the same drag drives the structure has the same sign; where it has the other one it is so long that growth is
  // taken for decay.
  int SignOfDrag(const PathPoint& point) {
    if (point.states != states_of_sign_) {
      const double stiff = kFirstDrag / tolerances::kRootOfRounding * std::max(1.0, diagonal_.maxCoeff());
      sign_ = solver_.DeterminantSign(point, stiff * moved_);
      states_of_sign_ = point.states;
    }
    return sign_;
  }

  bool InequalitiesHold(const Eigen::VectorXd& x) const {
    const std::vector<Constraint> inequalities = arc_.system().Inequalities();
    return std::all_of(inequalities.begin(), inequalities.end(), [&](const Constraint& constraint) {
      return arc_.system().Value(constraint, x) >= -std::max(arc_.RoundingOf(constraint), tolerances::kActive);
    });
  }

  const Structure& structure_;
  const ContactPairs& contacts_;
  const MachineEquation machine_;
  MotionStepSolver solver_;
  ContactArc arc_;
  const PathPoint start_;
  const double extent_;
  const Eigen::VectorXd diagonal_;  // of the stiffness at the start
  Eigen::VectorXd moved_;           // 1, and 0 for components of supports
  const std::function<bool()>& cancelled_;
  double stride_ = 0.0;
  std::vector<ContactState> states_of_sign_;  // for which sign_ is known
  int sign_ = 0;
};

}  // namespace

JumpResult Jump(const Structure& structure, const ContactPairs& contacts, const PathPoint& from,
                const Eigen::VectorXd& push, const Machine& machine, bool checked,
                const std::function<bool()>& cancelled) {
  const Eigen::VectorXd along = push.size() > 0 ? push : DefaultPush(structure, from.s);
  return Jumper(structure, contacts, from, machine, cancelled).Run(along, checked);
}

}  // namespace contact_path
