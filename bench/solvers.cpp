// Which sparse solver: each on the same matrix of a square lattice, all nodes of its edge sticking or sliding.
#include <benchmark/benchmark.h>
#include <cholmod.h>
#include <klu.h>
#include <umfpack.h>

#include <Eigen/SPQRSupport>
#include <utility>
#include <vector>

#include "lattices.h"

namespace contact_path {
namespace {

struct System {
  System(int dofs, ContactState state)
      : request(BlockOf(dofs, 0, 0.0)),
        model(request.scene, CharacteristicScales(request.scene)),
        matrix(BorderedMatrix(model, state)) {}

  int size() const { return static_cast<int>(matrix.rows()); }

  TraceRequest request;
  Model model;
  Eigen::SparseMatrix<double> matrix;
};

ContactState StateOf(const benchmark::State& state) {
  return state.range(1) == 0 ? ContactState::kStick : ContactState::kSlipPlus;
}

// again: with the pivots of the last factorisation; what an increment costs, as the pattern stays.
void Klu(benchmark::State& state, bool again) {
  System system(static_cast<int>(state.range(0)), StateOf(state));
  int *outer = system.matrix.outerIndexPtr(), *inner = system.matrix.innerIndexPtr();
  double* values = system.matrix.valuePtr();
  klu_common common;
  klu_defaults(&common);
  common.btf = 0;
  klu_symbolic* symbolic = klu_analyze(system.size(), outer, inner, &common);
  klu_numeric* numeric = klu_factor(outer, inner, values, symbolic, &common);
  for (auto iteration : state) {
    if (again) {
      klu_refactor(outer, inner, values, symbolic, numeric, &common);
      continue;
    }
    klu_free_numeric(&numeric, &common);
    numeric = klu_factor(outer, inner, values, symbolic, &common);
  }
  klu_flops(symbolic, numeric, &common);
  state.counters["flops"] = common.flops;
  state.counters["entries"] = numeric->lnz + numeric->unz;
  klu_free_numeric(&numeric, &common);
  klu_free_symbolic(&symbolic, &common);
}

void KluAgain(benchmark::State& state) { Klu(state, true); }
void KluAnew(benchmark::State& state) { Klu(state, false); }

void Umfpack(benchmark::State& state, bool metis) {
  const System system(static_cast<int>(state.range(0)), StateOf(state));
  const int *outer = system.matrix.outerIndexPtr(), *inner = system.matrix.innerIndexPtr();
  const double* values = system.matrix.valuePtr();
  double control[UMFPACK_CONTROL], info[UMFPACK_INFO];
  umfpack_di_defaults(control);
  if (metis) {
    control[UMFPACK_ORDERING] = UMFPACK_ORDERING_METIS;
    control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
    control[UMFPACK_SINGLETONS] = 0.0;
  }
  void *symbolic = nullptr, *numeric = nullptr;
  umfpack_di_symbolic(system.size(), system.size(), outer, inner, values, &symbolic, control, info);
  for (auto iteration : state) {
    umfpack_di_numeric(outer, inner, values, symbolic, &numeric, control, info);
    umfpack_di_free_numeric(&numeric);
  }
  umfpack_di_free_symbolic(&symbolic);
}

void UmfpackMetis(benchmark::State& state) { Umfpack(state, true); }
void UmfpackDefaults(benchmark::State& state) { Umfpack(state, false); }

// Of the tangent stiffness alone, supernodal, ordered by METIS: a lower bound of what a symmetric solver could gain.
void CholmodTangent(benchmark::State& state) {
  const System system(static_cast<int>(state.range(0)), StateOf(state));
  Eigen::SparseMatrix<double> tangent = system.model.structure.TangentPattern();
  system.model.structure.Tangent(system.model.structure.Start(), &tangent);
  cholmod_common common;
  cholmod_start(&common);
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_METIS;
  common.supernodal = CHOLMOD_SUPERNODAL;
  cholmod_sparse matrix = Eigen::viewAsCholmod(std::as_const(tangent).selfadjointView<Eigen::Lower>());
  cholmod_factor* factor = cholmod_analyze(&matrix, &common);
  for (auto iteration : state) cholmod_factorize(&matrix, factor, &common);
  cholmod_free_factor(&factor, &common);
  cholmod_finish(&common);
}

void Spqr(benchmark::State& state) {
  const System system(static_cast<int>(state.range(0)), StateOf(state));
  Eigen::SPQR<Eigen::SparseMatrix<double>> solver;
  for (auto iteration : state) solver.compute(system.matrix);
}

constexpr int kSmall = 1000, kMiddle = 10000, kLarge = 100000;

BENCHMARK(CholmodTangent)->ArgsProduct({{kSmall, kMiddle, kLarge}, {0}})->Unit(benchmark::kMillisecond);
BENCHMARK(KluAgain)->ArgsProduct({{kSmall, kMiddle}, {0, 1}})->Unit(benchmark::kMillisecond);
BENCHMARK(KluAnew)->ArgsProduct({{kSmall, kMiddle}, {0, 1}})->Unit(benchmark::kMillisecond);
BENCHMARK(UmfpackMetis)->ArgsProduct({{kSmall, kMiddle, kLarge}, {0, 1}})->Unit(benchmark::kMillisecond);
BENCHMARK(UmfpackDefaults)->ArgsProduct({{kSmall, kMiddle}, {0, 1}})->Unit(benchmark::kMillisecond);
BENCHMARK(Spqr)->ArgsProduct({{kSmall}, {0, 1}})->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace contact_path
