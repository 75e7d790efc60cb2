#include "contact_path/stability/jump.h"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "contact_path/branch/mode_arc.h"
#include "contact_path/iterations.h"
#include "contact_path/linear/generic_vector.h"
#include "contact_path/stability/stability_problem.h"
#include "contact_path/tolerances.h"
#include "stability/jump_work.h"
#include "stability/motion_step.h"

namespace contact_path {
namespace {

// Largest motion of a step, of the extent of the structure and of the way from the start.
constexpr double kStride = 0.01;
// Steps on the way of a jump, at least. Half as long steps change the work of what slides by less than 1e-3 of itself:
// by up to 5e-4 in scenes/snap_hook.yaml, by 6e-5 in scenes/stick_slip_chain.yaml, by 2e-5 in scenes/rough_arch.yaml.
constexpr double kLeastSteps = 200.0;
// The same with inertia: a swing goes along the way once forth and back, and implicit Euler damps a swing of n steps
// by pi / n of critical.
constexpr double kLeastStepsOfSwing = 40.0;
// Of critical, for the slowest motion.
constexpr double kLightDrag = 0.03;
// Extents of the structure: what goes farther flies off.
constexpr double kFar = 1e3;
// Disturbances, of the extent, or of the way so far. What is stable stays where it is disturbed by as much as rounding
// leaves of a place where the energy is flat: one that barely holds is passed.
const std::vector<double> kLeft = {tolerances::kShort, tolerances::kNextToStart}, kHeld = {tolerances::kShort};
// Ratio of two lengths or speeds of steps, one behind the other. Of the speeds it is 1 / (1 - lambda h) by implicit
// Euler: beyond, growth is taken for decay. Decay by this ratio settles within few steps.
constexpr double kMostGrowth = 2.0;

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

// Of the equations of motion at a point, with the curvature of what is touched.
Eigen::VectorXd DiagonalStiffness(const Structure& structure, const Laws& laws, const PathPoint& at) {
  FixedModeSystem system(structure, laws);
  system.SetModes(at.modes, laws.ReferencesAt(at));
  const Eigen::SparseMatrix<double>& jacobian = system.TransposedJacobian(system.Pack(at));
  return Eigen::VectorXd(jacobian.diagonal()).head(structure.NumDofs()).cwiseAbs();
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

// How one motion went.
struct Course {
  PathPoint now;
  Work work;
  std::optional<Landing> landing;
  int steps = 0;
  double followed = 0.0;      // largest distance from the start
  double length = 0.0;        // of the way, by the largest unknown of each step
  double norm = 0.0;          // of the way, by the Euclidean norm
  Eigen::VectorXd left = {};  // disturbance (u) with which it has left the start
  bool rests = false;         // at an equilibrium; without a landing where that is singular
  bool came_back = false;     // no farther from where it was left than it was pushed
  bool cancelled = false;
};

class Jumper {
 public:
  Jumper(const Structure& structure, const Laws& laws, const PathPoint& from, const Machine& machine,
         const std::function<bool()>& cancelled)
      : structure_(structure),
        laws_(laws),
        compliance_(machine.Compliance()),
        machine_(MachineEquation::Of(structure, machine, from)),
        solver_(structure, laws, machine_),
        arc_(structure, laws),
        stability_(structure, laws),
        start_(solver_.AsOfArc(from)),
        extent_(ExtentOf(structure, from.u)),
        diagonal_(DiagonalStiffness(structure, laws, start_)),
        moved_(Eigen::VectorXd::Ones(from.u.size())),
        cancelled_(cancelled) {
    for (const PrescribedDof& prescribed : structure.PrescribedDofs()) moved_[prescribed.dof] = 0.0;
  }

  JumpResult Run(const Eigen::VectorXd& push, bool checked) {
    JumpResult result;
    const Resistance uniform = {0.0 * moved_, moved_};
    stride_ = kStride * extent_;
    Course course = Follow(uniform, push, stride_);
    // With as many steps as the way wants.
    while (course.landing && course.length / kLeastSteps < 0.99 * stride_) {
      stride_ = course.length / kLeastSteps;
      course = Follow(uniform, course.left, stride_);
    }
    result.cancelled = course.cancelled;
    result.came_back = course.came_back;
    result.followed = course.followed;
    result.landing = result.landings[0] = course.landing;
    if (course.landing && checked) Compare(course, &result);
    return result;
  }

 private:
  // From the start to where the structure is stable: from where it is not it moves on.
  Course Follow(const Resistance& resistance, const Eigen::VectorXd& push, double stride) {
    Course course{start_, Work(laws_), std::nullopt};
    Stability at = StabilityOf(start_);
    std::vector<Eigen::VectorXd> directions = {push};
    if (at.verdict != Verdict::kStable) directions.push_back(at.direction);
    for (;;) {
      const bool is_stable = course.landing && at.verdict == Verdict::kStable;
      Course next = Leave(resistance, course, directions, is_stable ? kHeld : kLeft, stride);
      if (is_stable && Largest(next.now.u - course.now.u) <= tolerances::kNextToStart * extent_) return course;
      if (next.came_back) {
        // It is held here. Where that is known to be wrong, it has not landed.
        course.came_back = course.steps == 0;
        if (at.verdict == Verdict::kUnstable) course.landing.reset();
        return course;
      }
      course = std::move(next);
      if (!course.rests) return course;
      at = StabilityOf(course.now);
      directions = {at.direction, GenericVector(moved_.size())};
    }
  }

  // By the first disturbance from which the structure does not come back. A limit point is left with the square of the
  // distance from it, a bifurcation with the third power.
  Course Leave(const Resistance& resistance, const Course& from, const std::vector<Eigen::VectorXd>& directions,
               const std::vector<double>& shares, double stride) {
    for (const double share : shares) {
      for (const Eigen::VectorXd& direction : directions) {
        if (direction.size() == 0 || direction.cwiseProduct(moved_).isZero(0.0)) continue;
        const Eigen::VectorXd free = direction.cwiseProduct(moved_),
                              disturbance = share * std::max(extent_, from.followed) / Largest(free) * free;
        for (const double sense : {1.0, -1.0}) {
          Course course = Move(resistance, from, sense * disturbance, stride);
          if (!course.came_back) return course;
        }
      }
    }
    Course back = from;
    back.came_back = true;
    return back;
  }

  // Adds the other drags.
  void Compare(const Course& uniform, JumpResult* result) {
    const Eigen::VectorXd by_stiffness = moved_.cwiseProduct(StiffnessOfNodes(structure_, diagonal_));
    result->landings[1] = Follow({0.0 * moved_, by_stiffness}, uniform.left, stride_).landing;
    // The slowest motion: the energy released, as kinetic energy of a swing over half the way.
    const double rate = 2.0 * std::sqrt(2.0 * uniform.landing->energy_released()) / uniform.norm;
    result->landings[2] =
        Follow({moved_, 2.0 * kLightDrag * rate * moved_}, uniform.left, uniform.length / kLeastStepsOfSwing).landing;
    result->robust = true;
    for (const std::optional<Landing>& a : result->landings) {
      result->robust = result->robust && a.has_value();
      for (const std::optional<Landing>& b : result->landings)
        if (a && b) result->largest_difference = std::max(result->largest_difference, Largest(a->point.u - b->point.u));
    }
    result->robust = result->robust && result->largest_difference <= tolerances::kSameTangent * extent_;
    result->cancelled = Cancelled();
  }

  Stability StabilityOf(const PathPoint& point) {
    stability_.Set(point, {});
    return stability_.Under(compliance_);
  }

  bool Cancelled() const { return cancelled_ && cancelled_(); }

  // The time of the first step: drag is so many times the stiffness that each law alone decides on its state.
  double FirstTime(const Resistance& resistance) const {
    double largest = 0.0;  // stiffness over drag or mass
    const Eigen::VectorXd& by = resistance.HasMass() ? resistance.mass : resistance.drag;
    for (Eigen::Index i = 0; i < by.size(); ++i)
      if (by[i] > 0.0) largest = std::max(largest, diagonal_[i] / by[i]);
    largest = std::max(largest, 1.0) / tolerances::kSmallShare;
    return resistance.HasMass() ? 1.0 / std::sqrt(largest) : 1.0 / largest;
  }

  // One motion on its way.
  struct Motion {
    const Resistance& resistance;
    const Eigen::VectorXd& disturbance;
    const PathPoint& from;
    double stride;  // largest motion of a step within the extent of the structure
    Course course;
    Eigen::VectorXd velocity;
    double time = 0.0;       // of the next step
    double pushed = 0.0;     // how far; 0: not yet
    bool shortened = false;  // the next step was
    // Of the last step, and the largest so far. A push moves the structure from rest to rest.
    double speed = 0.0, most_kinetic = 0.0;
    double growth = 0.0;  // of the speed, from the step before

    bool Swings() const { return resistance.HasMass(); }
    double Distance() const { return Largest(course.now.u - from.u); }
  };

  Course Move(const Resistance& resistance, const Course& from, const Eigen::VectorXd& disturbance, double stride) {
    Motion motion{resistance, disturbance, from.now, stride, from, 0.0 * start_.u};
    const double first = FirstTime(resistance), shortest = first * tolerances::kRootOfRounding,
                 late = first / tolerances::kDependentColumn;
    motion.time = first;
    Course& course = motion.course;
    course.landing.reset();
    course.rests = false;
    if (course.left.size() == 0) course.left = disturbance;
    while (course.steps < 100 * static_cast<int>(kLeastSteps)) {
      course.cancelled = Cancelled();
      if (course.cancelled || course.followed > kFar * extent_ || motion.time < shortest) break;
      const std::optional<MotionStep> step = Try(motion);
      // Where the equations become singular, no step is found that is not rounding.
      course.rests = !step && motion.time > tolerances::kSmallShare * late &&
                     motion.speed * motion.time <= tolerances::kNextToStart * motion.pushed;
      if (course.rests) break;
      if (!step || IsTooLong(motion, *step)) {
        motion.time *= step ? 0.5 : 0.25;
        motion.shortened = true;
        continue;
      }
      const double length = Largest(step->point.u - course.now.u);
      const bool settles = Accept(*step, &motion);
      // A step by which more than half of what is left decays has more behind it than before it.
      if (settles) Land(length, &course);
      course.rests =
          course.landing || (settles && motion.time > late && length <= tolerances::kNextToStart * motion.pushed);
      if (course.rests) break;
      ChooseTime(*step, length, &motion);
    }
    course.came_back = course.rests && motion.Distance() <= motion.pushed;
    return course;
  }

  std::optional<MotionStep> Try(const Motion& motion) {
    const PathPoint& now = motion.course.now;
    Eigen::VectorXd anchor = motion.resistance.Anchor(motion.time, now.u, motion.velocity);
    if (motion.pushed == 0.0) anchor += motion.disturbance;
    return solver_.Solve(now, motion.resistance.Diagonal(motion.time), anchor);
  }

  // Largest motion of a step: beyond the structure it grows with the way.
  double Admitted(const Motion& motion) const {
    return std::max(motion.stride, kStride * (motion.course.followed - extent_));
  }

  bool IsTooLong(const Motion& motion, const MotionStep& step) {
    const Eigen::VectorXd du = step.point.u - motion.course.now.u;
    if (motion.pushed == 0.0) return false;
    if (Largest(du) > kMostGrowth * Admitted(motion)) return true;
    // Within so short a step nothing grows: the motion has a kink.
    if (Largest(du) <= tolerances::kNextToStart * motion.Distance()) return false;
    return motion.speed > 0.0 &&
           du.norm() > kMostGrowth * motion.speed * motion.time + tolerances::kRootOfRounding * extent_;
  }

  // Goes to the end of the step. Whether the motion comes to rest.
  bool Accept(const MotionStep& step, Motion* motion) {
    Course& course = motion->course;
    const Eigen::VectorXd du = step.point.u - course.now.u;
    const double speed = du.norm() / motion->time;
    AddWork(structure_, laws_, course.now, step, motion->pushed == 0.0, &course.work);
    ++course.steps;
    course.length += Largest(du);
    course.norm += du.norm();
    course.now = step.point;
    course.followed = std::max(course.followed, Largest(step.point.u - start_.u));
    if (motion->pushed == 0.0) {
      motion->pushed = std::max(Largest(motion->disturbance), Largest(du));
      return false;
    }
    bool settles = kMostGrowth * speed <= motion->speed;
    if (motion->Swings()) {
      motion->velocity = du / motion->time;
      const double kinetic = 0.5 * speed * speed;
      motion->most_kinetic = std::max(motion->most_kinetic, kinetic);
      // What is left does not lift the structure out of a valley any more.
      settles = kinetic <= tolerances::kEnergyOfStep * motion->most_kinetic;
    }
    motion->growth = motion->speed > 0.0 ? speed / motion->speed : 0.0;
    motion->speed = speed;
    return settles;
  }

  // The time of the step after this one of the given length.
  void ChooseTime(const MotionStep& step, double length, Motion* motion) const {
    const bool easy = !motion->shortened && 2 * step.iterations <= kMostCorrections;
    // A step of twice the length has at most kMostGrowth.
    const bool slow = motion->growth * (kMostGrowth + 1.0) <= 2.0 * kMostGrowth;
    motion->time *= std::min(easy && slow ? 2.0 : 1.0, Admitted(*motion) / length);
    motion->shortened = false;
  }

  // The equilibrium at a point where the motion comes to rest: the step of infinite time, with the states that there
  // are, to a point that is near.
  void Land(double near, Course* course) {
    const PathPoint& at = course->now;
    const std::optional<MotionStep> step = solver_.Solve(at, 0.0 * moved_, at.u);
    if (!step || step->changed || Largest(step->point.u - at.u) > near) return;
    PathPoint from = at;
    from.modes = step->point.modes;
    arc_.SetModes(from);
    const FixedModeSystem& system = arc_.system();
    const Correction correction =
        arc_.Correct(system.Pack(step->point), machine_.Row(system.NumUnknowns()), machine_.value);
    if (!correction.converged || !InequalitiesHold(correction.x)) return;
    MotionStep last = *step;
    last.point = system.Unpack(correction.x);
    AddWork(structure_, laws_, at, last, false, &course->work);
    course->now = last.point;
    Landing landing;
    landing.point = last.point;
    landing.loads = course->work.loads;
    landing.stored = Energy(last.point) - Energy(start_);
    // Drag takes energy: what slides is found to take beyond the rest is the error of its integral, and small.
    const double left = landing.loads - landing.stored, taken = course->work.dissipation;
    if (taken - left >
        tolerances::kEnergyOfStep * (std::abs(landing.loads) + std::abs(landing.stored) + std::abs(taken)) +
            tolerances::kEqual * (1.0 + Energy(start_)))
      return;
    landing.dissipated = std::min(taken, std::max(0.0, left));
    course->landing = landing;
  }

  double Energy(const PathPoint& point) const { return structure_.Energy(point.u) + laws_.Energy(point); }

  bool InequalitiesHold(const Eigen::VectorXd& x) const {
    const std::vector<Limit> inequalities = arc_.system().mode_limits().All();
    return std::all_of(inequalities.begin(), inequalities.end(), [&](const Limit& constraint) {
      return arc_.system().Value(constraint, x) >= -arc_.RoundingOf(constraint);
    });
  }

  const Structure& structure_;
  const Laws& laws_;
  const double compliance_;  // of the machine
  const MachineEquation machine_;
  MotionStepSolver solver_;
  ModeArc arc_;
  StabilityProblem stability_;
  const PathPoint start_;
  const double extent_;
  const Eigen::VectorXd diagonal_;  // of the stiffness at the start
  Eigen::VectorXd moved_;           // 1, and 0 for components of supports
  const std::function<bool()>& cancelled_;
  double stride_ = 0.0;
};

}  // namespace

JumpResult Jump(const Structure& structure, const Laws& laws, const PathPoint& from, const Eigen::VectorXd& push,
                const Machine& machine, bool checked, const std::function<bool()>& cancelled) {
  return Jumper(structure, laws, from, machine, cancelled).Run(push, checked);
}

}  // namespace contact_path
