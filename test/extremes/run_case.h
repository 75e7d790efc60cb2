// Traces one case and judges what comes out.
#ifndef CONTACT_PATH_TEST_EXTREMES_RUN_CASE_H_
#define CONTACT_PATH_TEST_EXTREMES_RUN_CASE_H_

#include <string>

#include "contact_path/path/trace.h"
#include "extremes/extreme_case.h"

namespace contact_path {

struct Outcome {
  EndReason reason = EndReason::kNumericalFailure;
  std::string message;
  int increments = 0;
  double error = 0.0;        // largest of all increments
  bool out_of_time = false;  // cut by the limit: what came until then counts
  // What is wrong; empty: the right answer or a named end, and nothing but right increments before it. Wrong are: an
  // error above the allowed one, a number that is not finite, an increment that the check does not prove, an end that
  // is not named where it must not be, or no end at all.
  std::string fault;
};

// most_seconds: of tracing; then the trace is cancelled, but with fewer than four increments only after five times as
// long.
Outcome RunCase(const ExtremeCase& extreme, Method method, Accuracy accuracy, double most_seconds);

// What rounding alone may do to the answer: eps |J| |x| / sigma, the largest of up to 20 increments of method branch,
// with the Jacobian J of the fixed-mode equations in scaled form, its smallest singular value sigma above rounding,
// and the unknowns x; the bound on the error of the solution of equations whose entries are known to rounding.
// Negative: the system is too large for it, or there are no increments.
double AttainableError(const ExtremeCase& extreme);

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_EXTREMES_RUN_CASE_H_
