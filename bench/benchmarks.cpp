// What an increment costs: against one factorisation of its matrix, and with candidates that are far away.
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <ctime>
#include <memory>
#include <stdexcept>
#include <utility>

#include "contact_path/linear/bordered_solver.h"
#include "contact_path/path/branch_method.h"
#include "contact_path/path/model.h"
#include "contact_path/path/recorder.h"
#include "lattices.h"
#include "process/process.h"

namespace contact_path {
namespace {

constexpr int kIncrements = 12;
constexpr double kOutOfReach = 5.0;  // lengths of a bar: for these increments
constexpr int kFarDofs = 20400;      // of a wall with 10,000 free nodes

// Of the processor: other work on the machine spoils it less than the time of day.
double Seconds(std::clock_t since) { return static_cast<double>(std::clock() - since) / CLOCKS_PER_SEC; }

// One factorisation of the matrix of the increments at `point`, pattern and pivots known.
double FactorisationTime(const Model& model, const PathPoint& point) {
  FixedModeSystem system(model.structure, model.laws);
  system.SetModesFrom(point);
  const Eigen::SparseMatrix<double> transposed = system.TransposedJacobian(system.Pack(point));
  const Eigen::VectorXd increment = Eigen::VectorXd::LinSpaced(system.NumUnknowns(), 0.5, 1.0);
  BorderedSolver solver;
  solver.Factorize(transposed, increment);
  double least = 1e9;
  for (int i = 0; i < 3; ++i) {
    const std::clock_t start = std::clock();
    solver.Factorize(transposed, increment);
    least = std::min(least, Seconds(start));
  }
  return least;
}

// Mean of the regular increments of a wall that bends towards the floor, or along it where that is as near as it is;
// with what it takes to record them.
void RegularIncrements(benchmark::State& state, TraceRequest request, double floor_lowered_by) {
  request.scene.obstacles.front().py -= floor_lowered_by;
  const Model model(request.scene, CharacteristicScales(request.scene));
  double factorisation = 0.0, increment = 0.0, factorisations = 0.0;
  for (auto iteration : state) {
    BranchMethod method(model, BranchOptions::For(request.options, AutomaticStepGrowth(model)), nullptr);
    PathPoint point = model.InitialPoint();
    AcceptedPoint first;
    first.point = point;
    if (method.Start(point, &first)) throw std::runtime_error("the path cannot start");
    Recorder recorder(Method::kBranch, LongLists(), false, nullptr);
    recorder.Start(model, 0, first, 0.0);
    double seconds = 0.0;
    int regular = 0, factorised = 0;
    while (regular < kIncrements) {
      const std::clock_t start = std::clock();
      const Advance advance = method.Next(point);
      if (advance.increment) recorder.Append(model, *advance.increment, 0.0);
      const double time = Seconds(start);
      if (!advance.increment) throw std::runtime_error("no increment");
      point = advance.increment->point;
      if (advance.increment->kind != IncrementKind::kRegular) continue;
      seconds += time;
      factorised += advance.increment->solve.factorisations;
      ++regular;
    }
    state.SetIterationTime(seconds / regular);
    increment = seconds / regular;
    factorisations = static_cast<double>(factorised) / regular;
    factorisation = FactorisationTime(model, point);
  }
  struct rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["dofs"] = static_cast<double>(model.structure.NumDofs());
  state.counters["candidates"] = static_cast<double>(model.contacts.size());
  state.counters["factorisations"] = factorisations;
  state.counters["per_factorisation"] = increment / factorisation;
  state.counters["peak_MiB"] = static_cast<double>(usage.ru_maxrss) / 1024.0;
}

int Dofs(const benchmark::State& state) { return static_cast<int>(state.range(0)); }
int FarCandidates(const benchmark::State& state) { return static_cast<int>(state.range(1)); }

void IncrementInContact(benchmark::State& state) { RegularIncrements(state, WallOf(Dofs(state)), 0.0); }
void IncrementWithFarCandidates(benchmark::State& state) {
  RegularIncrements(state, WallOf(Dofs(state), FarCandidates(state)), kOutOfReach);
}
void IncrementWithFarCurve(benchmark::State& state) {
  TraceRequest request = WallOf(Dofs(state));
  AddFarCurve(FarCandidates(state), &request.scene);
  RegularIncrements(state, std::move(request), kOutOfReach);
}

BENCHMARK(IncrementInContact)->Arg(1000)->Arg(3000)->UseManualTime()->Iterations(3)->Unit(benchmark::kMillisecond);
BENCHMARK(IncrementWithFarCandidates)
    ->Args({kFarDofs, 0})
    ->Args({kFarDofs, 10000})
    ->UseManualTime()
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(IncrementWithFarCurve)
    ->Args({kFarDofs, 0})
    ->Args({kFarDofs, 10000})
    ->UseManualTime()
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace contact_path

int main(int argc, char** argv) {
  contact_path::KeepMemory();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
