#include "extremes/run_case.h"

#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <vector>

#include "contact_path/contact/contact_pair.h"
#include "contact_path/equations/fixed_mode_system.h"
#include "contact_path/path/model.h"
#include "contact_path/path/mpec_method.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/program.h"
#include "contact_path/verify/verify_path.h"
#include "support/dense.h"
#include "support/traced_path.h"

namespace contact_path {
namespace {

constexpr std::size_t kMostNumbersToVerify = 20'000'000;  // of all increments together
constexpr double kOfAttainable = 10.0;                    // error of increments that are, where rounding matters
constexpr int kFewRows = 4;                               // for fewer there is more time
constexpr double kTimeForFew = 5.0;

using Clock = std::chrono::steady_clock;

bool AllFinite(const Increment& increment) {
  bool finite = std::isfinite(increment.load_factor) && std::isfinite(increment.arc_length) &&
                std::isfinite(increment.dissipation) && std::isfinite(increment.strain_energy) &&
                std::isfinite(increment.external_work);
  for (const double position : increment.positions) finite = finite && std::isfinite(position);
  for (const ContactRecord& contact : increment.contacts)
    finite = finite && std::isfinite(contact.gap) && std::isfinite(contact.rn) && std::isfinite(contact.rt);
  return finite;
}

bool MayEnd(const ExtremeCase& extreme, Method method, EndReason reason) {
  if (reason == EndReason::kStopCriterion) return true;
  if (reason == EndReason::kMaxIncrements) return extreme.error || extreme.ends.empty();
  if (std::count(extreme.ends.begin(), extreme.ends.end(), ToString(reason)) > 0) return true;
  return method == Method::kMpec && reason != EndReason::kCancelled;
}

}  // namespace

Outcome RunCase(const ExtremeCase& extreme, Method method, Accuracy accuracy, double most_seconds) {
  TraceRequest request = extreme.request;
  request.options.method = method;
  request.options.accuracy = accuracy;
  Outcome outcome;
  std::vector<Increment> increments;
  bool finite = true;
  double exact_error = 0.0;
  const std::size_t most_rows = kMostNumbersToVerify / (request.scene.nodes.size() + request.scene.contacts.size());
  const Clock::time_point start = Clock::now();
  Clock::duration judging = {};
  TraceControl control;
  control.on_increment = [&](const Increment& increment) {
    const Clock::time_point before = Clock::now();
    ++outcome.increments;
    finite = finite && AllFinite(increment);
    if (extreme.error) {
      const double error = extreme.error(request, increment);
      outcome.error = std::max(outcome.error, std::isnan(error) ? HUGE_VAL : error);
      if (increment.solve.exact) exact_error = std::max(exact_error, std::isnan(error) ? HUGE_VAL : error);
    }
    if (increments.size() < most_rows) increments.push_back(increment);
    judging += Clock::now() - before;
  };
  control.cancelled = [&] {
    const std::chrono::duration<double> gone = Clock::now() - start - judging;
    const double seconds = outcome.increments < kFewRows ? kTimeForFew * most_seconds : most_seconds;
    outcome.out_of_time = outcome.out_of_time || gone.count() > seconds;
    return outcome.out_of_time;
  };
  control.mpec = MakeMpecMethod;
  const TraceResult result = Trace(request, control);
  outcome.reason = result.reason;
  outcome.message = result.message;
  double allowed = extreme.allowed;
  double allowed_regularised = extreme.allowed_regularised;
  if (std::isfinite(outcome.error) && (exact_error > allowed || outcome.error > allowed_regularised)) {
    allowed = std::max(allowed, kOfAttainable * AttainableError(extreme));
    allowed_regularised = std::max(allowed_regularised, allowed);
  }
  if (!finite)
    outcome.fault = "a number is not finite";
  else if (!(exact_error <= allowed) || !(outcome.error <= allowed_regularised))
    outcome.fault = "error " + Text(outcome.error);
  else if (!(outcome.out_of_time && result.reason == EndReason::kCancelled) && !MayEnd(extreme, method, result.reason))
    outcome.fault = std::string(ToString(result.reason)) + ": " + result.message;
  else if (!increments.empty() && increments.size() < most_rows) {
    for (const Finding& finding : VerifyPath(request, increments).findings)
      if (outcome.fault.empty()) outcome.fault = "increment " + std::to_string(finding.increment) + ": " + finding.what;
  }
  return outcome;
}

double AttainableError(const ExtremeCase& extreme) {
  constexpr Eigen::Index kMostUnknowns = 60;
  constexpr std::size_t kMostRows = 2000;
  constexpr int kSamples = 20;
  TraceRequest request = extreme.request;
  request.options.max_increments = static_cast<int>(std::min(request.options.MaxIncrements(1), kMostRows));
  const TraceRequest expanded = Expand(request).request;
  const Model model(StageScene(expanded, 0), StageScales(expanded, 0));
  if (model.structure.NumDofs() > kMostUnknowns) return -1.0;
  const TracedPath path = TraceIncrements(request);
  double largest = -1.0;
  for (int i = 0; i < kSamples; ++i) {
    const std::size_t index = path.increments.size() * static_cast<std::size_t>(i) / kSamples;
    if (index >= path.increments.size()) continue;
    const PathPoint point = model.FromIncrement(path.increments[index]);
    FixedModeSystem system(model.structure, model.laws);
    system.SetModes(point.modes, model.laws.ReferencesAt(point));
    const Eigen::VectorXd x = system.Pack(point);
    const SingularValueDecomposition svd = Decompose(Eigen::MatrixXd(system.TransposedJacobian(x)));
    if (svd.values.size() == 0) continue;
    const Eigen::Index rank = std::max<Eigen::Index>(1, svd.Rank(1e-14));
    largest =
        std::max(largest, std::numeric_limits<double>::epsilon() * svd.values[0] * x.norm() / svd.values[rank - 1]);
  }
  return largest;
}

}  // namespace contact_path
