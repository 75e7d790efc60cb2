// Newton's method, once: how it goes on, and when it is at its end.
#ifndef CONTACT_PATH_EQUATIONS_NEWTON_LOOP_H_
#define CONTACT_PATH_EQUATIONS_NEWTON_LOOP_H_

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <vector>

#include "contact_path/iterations.h"
#include "contact_path/tolerances.h"

namespace contact_path {

struct NewtonLimits {
  int most = kMostCorrections;
  double small = tolerances::kRounding;                      // a step below this, relative to 1 + |x|, is the last one
  double stagnation = tolerances::kStagnation;               // so is one that no longer shrinks and is below this
  double slowest = std::numeric_limits<double>::infinity();  // ratio of two steps; a slower one is given up
  double unit = 1.0;                                         // ArcEquations::ResidualUnit(): stagnation grows with it
};

struct NewtonCourse {
  bool at_rounding = false;  // the last step was rounding; otherwise the method was given up
  int iterations = 0;
  std::vector<double> steps;  // their norms, in order
};

// x <- x + step until the step is rounding. step(x, refresh, &dx): the next step, with factors made anew where
// `refresh`; false: there is none. norm(dx): of a step.
template <typename StepOf, typename NormOf>
NewtonCourse NewtonLoop(const NewtonLimits& limits, bool refresh, StepOf step, NormOf norm, Eigen::VectorXd* x,
                        Eigen::VectorXd* dx) {
  NewtonCourse course;
  course.steps.reserve(static_cast<std::size_t>(limits.most));
  const bool keeps = !refresh;
  for (double previous = std::numeric_limits<double>::infinity(); course.iterations < limits.most;) {
    if (!step(*x, refresh, dx)) return course;
    const double length = norm(*dx), scale = 1.0 + x->norm();
    if (!std::isfinite(length)) return course;
    *x += *dx;
    ++course.iterations;
    course.steps.push_back(length);
    const bool stagnates = length >= 0.5 * previous && length <= limits.stagnation * limits.unit * scale;
    course.at_rounding = length <= limits.small * scale || stagnates;
    if (course.at_rounding || length > limits.slowest * previous) return course;
    refresh = !keeps && length > tolerances::kShort * scale;
    previous = length;
  }
  return course;
}

}  // namespace contact_path

#endif  // CONTACT_PATH_EQUATIONS_NEWTON_LOOP_H_
