// What increments and events of large structures cost, in factorisations of their tangent by CHOLMOD as it is set up
// best: supernodal, ordered by METIS. A square lattice beside a rough floor, with a candidate for each node of its
// edge; a frame and a solid without contact.
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "contact_path/branch/mode_arc.h"
#include "contact_path/linear/blas.h"
#include "contact_path/path/branch_method.h"
#include "contact_path/path/model.h"
#include "contact_path/path/mpec_method.h"
#include "contact_path/scene/expand.h"
#include "lattices.h"

namespace contact_path {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kIncrements = 4;
constexpr double kNear = 1e-3;  // of a cell: gap of the floor where contacts are to touch soon

double Seconds(Clock::time_point since) { return std::chrono::duration<double>(Clock::now() - since).count(); }

double PeakMebibytes() {
  struct rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

void Report(const Model& model, const PathPoint& point, double time, double peak, benchmark::State* state) {
  state->SetIterationTime(time);
  const double cholmod = CholmodTime(model.structure, point.u);
  state->counters["dofs"] = static_cast<double>(model.structure.NumDofs());
  state->counters["contacts"] = static_cast<double>(model.contacts.size());
  state->counters["cholmod_ms"] = 1e3 * cholmod;
  state->counters["per_cholmod"] = time / cholmod;
  state->counters["peak_MiB"] = peak;
  state->SetLabel(LoadedBlas());
}

// Mean of the regular increments before the first contact touches, or mean of the first events.
void AlongThePath(const TraceRequest& given, bool events, benchmark::State& state) {
  const OneBlasThread one_thread;
  const TraceRequest request = Expand(given).request;
  const Model model(request.scene, CharacteristicScales(request.scene));
  for (auto iteration : state) {
    BranchMethod method(model, BranchOptions::For(request.options, AutomaticStepGrowth(model)), nullptr);
    PathPoint point = model.InitialPoint();
    IncrementFindings found;
    if (method.Start(point, &found)) throw std::runtime_error("the path cannot start");
    double seconds = 0.0, factorisations = 0.0;
    // The first increment finds the ordering.
    for (int counted = -1; counted < kIncrements;) {
      const Clock::time_point start = Clock::now();
      const Advance advance = method.Next(point);
      const double time = Seconds(start);
      if (!advance.increment) throw std::runtime_error("no increment");
      const AcceptedPoint& increment = *advance.increment;
      point = increment.point;
      if ((increment.kind == IncrementKind::kRegular) == events) continue;
      if (++counted == 0) continue;
      seconds += time / kIncrements;
      factorisations += static_cast<double>(increment.solve.factorisations) / kIncrements;
    }
    state.counters["factorisations"] = factorisations;
    Report(model, point, seconds, PeakMebibytes(), &state);
  }
}

int Size(const benchmark::State& state) { return static_cast<int>(state.range(0)); }

void SmoothIncrement(benchmark::State& state) { AlongThePath(BlockOf(Size(state), 0, 5.0), false, state); }
void Event(benchmark::State& state) { AlongThePath(BlockOf(Size(state), 0, kNear), true, state); }
void FrameIncrement(benchmark::State& state) { AlongThePath(FrameOf(Size(state)), false, state); }
void SolidIncrement(benchmark::State& state) {
  const int cells = static_cast<int>(std::lround(std::sqrt(0.5 * Size(state))));
  AlongThePath(SolidOf(cells, MaterialModel::kNeoHookean, PlaneState::kStrain), false, state);
}

// Assembly of the tangent of 10^4 elements of four nodes, away from their start.
void Assembly(benchmark::State& state) {
  constexpr int kCells = 100;
  const OneBlasThread one_thread;
  const auto model_of_material = static_cast<MaterialModel>(state.range(0));
  const TraceRequest request = SolidOf(kCells, model_of_material, static_cast<PlaneState>(state.range(1)));
  const Model model(request.scene, CharacteristicScales(request.scene));
  PathPoint point = model.InitialPoint();
  for (Eigen::Index i = 0; i < point.u.size(); ++i) point.u[i] += 1e-4 * std::sin(1.7 * static_cast<double>(i));
  Eigen::SparseMatrix<double> tangent = model.structure.TangentPattern();
  for (auto iteration : state) {
    double least = 1e9;
    for (int i = 0; i < 3; ++i) {  // as often as CHOLMOD
      const Clock::time_point start = Clock::now();
      model.structure.Tangent(point.u, &tangent);
      least = std::min(least, Seconds(start));
    }
    Report(model, point, least, PeakMebibytes(), &state);
  }
}

// A start with so many contacts that touch without a reaction: any of them can open, stick or slide.
void EventOfContacts(benchmark::State& state) {
  const OneBlasThread one_thread;
  const TraceRequest request = BlockOf(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)), 0.0);
  const Model model(request.scene, CharacteristicScales(request.scene));
  for (auto iteration : state) {
    BranchMethod method(model, BranchOptions::For(request.options, AutomaticStepGrowth(model)), nullptr);
    const PathPoint point = model.InitialPoint();
    IncrementFindings found;
    const Clock::time_point start = Clock::now();
    if (method.Start(point, &found)) throw std::runtime_error("the path cannot start");
    const double time = Seconds(start);
    Report(model, point, time, PeakMebibytes(), &state);
  }
}

// A point of an arc, with its derivatives, where so many contacts slide or none touches.
void PointOfAnArc(benchmark::State& state) {
  const OneBlasThread one_thread;
  LatticeOptions options;
  options.kind = LatticeKind::kBlock;
  options.columns = 1000;
  options.rows = 49;
  const TraceRequest request = LatticeRequest(options);
  const Model model(request.scene, CharacteristicScales(request.scene));
  PathPoint from = model.InitialPoint();
  for (std::size_t i = 0; i < from.modes.size(); ++i) {
    const bool slides = static_cast<std::int64_t>(i) < state.range(0);
    from.modes[i].state = NumberOf(slides ? ContactState::kSlipPlus : ContactState::kOpen);
  }
  for (auto iteration : state) {
    ModeArc arc(model.structure, model.laws);
    arc.SetModes(from);
    const Eigen::VectorXd x = arc.system().Pack(from);
    const Eigen::VectorXd towards = Eigen::VectorXd::Unit(model.structure.NumDofs() + 1, model.structure.NumDofs());
    CurvePoint point;
    double time = 0.0;
    for (int counted = -1; counted < kIncrements; ++counted) {  // the first one finds the ordering
      const Clock::time_point start = Clock::now();
      if (!arc.Derivatives(x, towards, &point)) throw std::runtime_error("no tangent");
      const Eigen::VectorXd normal = point.first.head(towards.size());
      if (!arc.CorrectOnPlane(x + 1e-4 * point.first, normal).converged) throw std::runtime_error("no point");
      if (counted >= 0) time += Seconds(start) / kIncrements;
    }
    Report(model, from, time, PeakMebibytes(), &state);
  }
}

// Increments by Ipopt, out of reach of the floor or along it.
void MpecIncrement(benchmark::State& state) {
  const OneBlasThread one_thread;
  const TraceRequest request = BlockOf(static_cast<int>(state.range(0)), 0, state.range(1) == 0 ? 5.0 : kNear);
  const Model model(request.scene, CharacteristicScales(request.scene));
  for (auto iteration : state) {
    MpecMethod method(model, MpecOptions::For(request.options, AutomaticStepGrowth(model)), nullptr);
    PathPoint point = model.InitialPoint();
    double iterations = 0.0;
    const Clock::time_point start = Clock::now();
    for (int k = 0; k < kIncrements; ++k) {
      const Advance advance = method.Next(point);
      if (!advance.increment) throw std::runtime_error("no increment");
      point = advance.increment->point;
      iterations += advance.increment->solve.iterations;
    }
    const double time = Seconds(start) / kIncrements;
    state.counters["iterations"] = iterations / kIncrements;
    Report(model, point, time, PeakMebibytes(), &state);
  }
}

BENCHMARK(SmoothIncrement)
    ->Arg(1000)
    ->Arg(10000)
    ->Arg(100000)
    ->Arg(1000000)
    ->UseManualTime()
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(FrameIncrement)
    ->Arg(1000)
    ->Arg(10000)
    ->Arg(100000)
    ->UseManualTime()
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(SolidIncrement)
    ->Arg(1000)
    ->Arg(10000)
    ->Arg(100000)
    ->UseManualTime()
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(Assembly)
    ->ArgsProduct({{static_cast<int>(MaterialModel::kLinear), static_cast<int>(MaterialModel::kNeoHookean)},
                   {static_cast<int>(PlaneState::kStrain), static_cast<int>(PlaneState::kStress)}})
    ->UseManualTime()
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(Event)->Arg(1000)->Arg(10000)->Arg(100000)->UseManualTime()->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(MpecIncrement)
    ->Args({500, 0})
    ->Args({500, 1})
    ->Args({2000, 0})
    ->Args({8000, 0})
    ->UseManualTime()
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(PointOfAnArc)->Arg(0)->Arg(1000)->UseManualTime()->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(EventOfContacts)
    ->ArgsProduct({{1000, 10000, 100000}, {1, 5, 20}})
    ->UseManualTime()
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace contact_path
