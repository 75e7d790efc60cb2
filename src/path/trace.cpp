#include "contact_path/path/trace.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "contact_path/path/branch_method.h"
#include "contact_path/path/model.h"
#include "contact_path/path/mpec_method.h"
#include "contact_path/path/path_method.h"
#include "contact_path/path/preload.h"
#include "contact_path/path/stop.h"
#include "contact_path/scene/validate.h"

namespace contact_path {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kStartTolerance = 1e-9;        // residuals of row 0
constexpr int kMostPreloadIncrements = 100000;  // to bring the constant loads on; not counted with the others

double Seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

// Turns accepted points into rows and hands them out.
class Recorder {
 public:
  Recorder(const Model& model, const TraceControl& control) : model_(model), control_(control) {}

  const Increment& row() const { return row_; }
  int rows() const { return rows_; }

  void Start(const PathPoint& point, const Residuals& residuals, const EventRecord& ways, double time) {
    AcceptedPoint accepted;
    accepted.kind = RowKind::kStart;
    accepted.residuals = residuals;
    accepted.solve.exact = true;
    accepted.event = ways;
    Fill(point, accepted, time);
    Give();
  }

  void Append(const AcceptedPoint& accepted, double time) {
    row_.dissipation += accepted.work.friction;
    row_.external_work += accepted.work.loads;
    row_.arc_length += accepted.arc_length;
    Fill(accepted.point, accepted, time);
    Give();
  }

 private:
  void Fill(const PathPoint& point, const AcceptedPoint& accepted, double time) {
    CheckedState state = model_.InSceneUnits(point);
    row_.index = rows_;
    row_.load_factor = state.load_factor;
    row_.kind = accepted.kind;
    row_.positions = std::move(state.positions);
    row_.contacts.resize(model_.contacts.size());
    for (std::size_t i = 0; i < model_.contacts.size(); ++i)
      row_.contacts[i] = {model_.contacts[i].gap.Value(point.u) * model_.scaling.length, state.rn[i], state.rt[i],
                          point.states[i]};
    row_.strain_energy = model_.structure.Energy(point.u) * model_.scaling.force * model_.scaling.length;
    row_.residuals = accepted.residuals;
    row_.solve = accepted.solve;
    row_.solve.time = time;
    row_.event = accepted.event;
  }

  void Give() {
    ++rows_;
    if (control_.on_increment) control_.on_increment(row_);
  }

  const Model& model_;
  const TraceControl& control_;
  Increment row_;
  int rows_ = 0;
};

std::unique_ptr<PathMethod> MakeMethod(const Model& model, const TraceOptions& options, const TraceControl& control) {
  if (options.method == Method::kBranch)
    return std::make_unique<BranchMethod>(model, BranchOptions::For(options, model.structure.NumDofs()),
                                          control.cancelled);
  return std::make_unique<MpecMethod>(model, MpecOptions::For(options, model.structure.NumDofs()), control.cancelled);
}

// From row 0 on, until something ends the trace. result: reason and message.
void Follow(const TraceRequest& request, const TraceControl& control, PathPoint point, PathMethod* method,
            Recorder* recorder, TraceResult* result) {
  const auto end = [result](EndReason reason, std::string message) {
    result->reason = reason;
    result->message = std::move(message);
  };
  const StopTest stop(request);
  const int most_increments = request.options.MaxIncrements();
  for (;;) {
    if (control.cancelled && control.cancelled()) return end(EndReason::kCancelled, "cancelled by the caller");
    if (recorder->rows() > most_increments)
      return end(EndReason::kMaxIncrements, "the wanted number of increments was accepted");
    const Clock::time_point start = Clock::now();
    Advance advance = method->Next(point);
    const auto rows = static_cast<double>(std::max<std::size_t>(1, advance.rows.size()));
    const double time = Seconds(Clock::now() - start) / rows;
    for (AcceptedPoint& row : advance.rows) {
      recorder->Append(row, time);
      point = std::move(row.point);
      if (const StopCriterion* criterion = stop.FirstThatHolds(recorder->row()))
        return end(EndReason::kStopCriterion, ToText(*criterion));
      if (recorder->rows() > most_increments) break;
    }
    if (advance.ended && recorder->rows() <= most_increments) return end(advance.reason, advance.message);
  }
}

TraceResult TraceSound(const TraceRequest& request, const TraceControl& control) {
  const TraceOptions& options = request.options;
  const Model model(request.scene, CharacteristicScales(request.scene));
  TraceResult result;

  const Clock::time_point start = Clock::now();
  // The start does not depend on how the path from there is traced, but for the accuracy.
  const MethodFactory make_preload_method = [&](const Model& of) {
    TraceOptions upwards;
    upwards.accuracy = options.accuracy;
    return MakeMethod(of, upwards, control);
  };
  Preload preload = TracePreload(model, kMostPreloadIncrements, make_preload_method, control.cancelled);
  if (!preload.done) {
    result.reason = preload.reason == EndReason::kMaxIncrements ? EndReason::kNumericalFailure : preload.reason;
    result.message = preload.message;
    return result;
  }
  PathPoint point = std::move(preload.point);
  const Residuals residuals = model.Check(point, point);
  if (!(std::max(residuals.equilibrium, residuals.Contact()) <= kStartTolerance)) {
    result.message = "the start is not an equilibrium";
    return result;
  }

  Recorder recorder(model, control);
  const std::unique_ptr<PathMethod> method = MakeMethod(model, options, control);
  EventRecord ways;
  const std::optional<EndReason> not_started = method->Start(point, &ways, &result.message);
  recorder.Start(point, residuals, ways, Seconds(Clock::now() - start));
  if (not_started)
    result.reason = *not_started;
  else
    Follow(request, control, std::move(point), method.get(), &recorder, &result);
  result.increments = recorder.rows();
  if (const std::string remark = method->Remark(); !remark.empty()) result.message += "; " + remark;
  return result;
}

}  // namespace

std::string_view ToString(EndReason reason) {
  switch (reason) {
    case EndReason::kNumericalFailure: return "numerical_failure";
    case EndReason::kStopCriterion: return "stop_criterion";
    case EndReason::kMaxIncrements: return "max_increments";
    case EndReason::kPathEnd: return "path_end";
    case EndReason::kStepTooSmall: return "step_too_small";
    case EndReason::kCancelled: return "cancelled";
  }
  return "";
}

TraceResult Trace(const TraceRequest& request, const TraceControl& control) {
  std::vector<Violation> violations = Validate(request);
  if (!violations.empty()) throw InvalidRequest(std::move(violations));
  return TraceSound(request, control);
}

}  // namespace contact_path
