// Which sparse solver: each on the same matrix of a lattice wall, all candidates sticking or sliding.
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
      : request(WallOf(dofs)),
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
void Klu(benchmark::State& state, bool again, int ordering, int btf) {
  System system(static_cast<int>(state.range(0)), StateOf(state));
  int *outer = system.matrix.outerIndexPtr(), *inner = system.matrix.innerIndexPtr();
  double* values = system.matrix.valuePtr();
  klu_common common;
  klu_defaults(&common);
  common.ordering = ordering;
  common.btf = btf;
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

void KluAgain(benchmark::State& state) { Klu(state, true, 0, 0); }
void KluAnew(benchmark::State& state) { Klu(state, false, 0, 0); }
void KluBlocks(benchmark::State& state) { Klu(state, false, 0, 1); }
void KluColamd(benchmark::State& state) { Klu(state, false, 1, 0); }

void Umfpack(benchmark::State& state) {
  const System system(static_cast<int>(state.range(0)), StateOf(state));
  const int *outer = system.matrix.outerIndexPtr(), *inner = system.matrix.innerIndexPtr();
  const double* values = system.matrix.valuePtr();
  double control[UMFPACK_CONTROL], info[UMFPACK_INFO];
  umfpack_di_defaults(control);
  void *symbolic = nullptr, *numeric = nullptr;
  umfpack_di_symbolic(system.size(), system.size(), outer, inner, values, &symbolic, control, info);
  for (auto iteration : state) {
    umfpack_di_numeric(outer, inner, values, symbolic, &numeric, control, info);
    umfpack_di_free_numeric(&numeric);
  }
  umfpack_di_free_symbolic(&symbolic);
}

// Of the tangent stiffness alone: a lower bound of what a symmetric solver could gain.
void CholmodTangent(benchmark::State& state) {
  const System system(static_cast<int>(state.range(0)), StateOf(state));
  Eigen::SparseMatrix<double> tangent = system.model.structure.TangentPattern();
  system.model.structure.Tangent(system.model.structure.Start(), &tangent);
  cholmod_common common;
  cholmod_start(&common);
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

constexpr int kSmall = 1000, kMiddle = 10000;

BENCHMARK(KluAgain)->ArgsProduct({{kSmall, kMiddle, 100000}, {0, 1}})->Unit(benchmark::kMillisecond);
BENCHMARK(KluAnew)->ArgsProduct({{kSmall, kMiddle, 100000}, {0, 1}})->Unit(benchmark::kMillisecond);
BENCHMARK(KluBlocks)->ArgsProduct({{kSmall, kMiddle}, {0, 1}})->Unit(benchmark::kMillisecond);
BENCHMARK(KluColamd)->ArgsProduct({{kSmall, kMiddle}, {0, 1}})->Unit(benchmark::kMillisecond);
BENCHMARK(CholmodTangent)->ArgsProduct({{kSmall, kMiddle, 100000}, {0}})->Unit(benchmark::kMillisecond);
BENCHMARK(Umfpack)->ArgsProduct({{kSmall, kMiddle}, {0, 1}})->Unit(benchmark::kMillisecond);
BENCHMARK(Spqr)->Args({kSmall, 0})->Args({kSmall, 1})->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace contact_path
