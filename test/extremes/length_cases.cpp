// Increments from tiny to as large as the scene, and very long traces.

#include "extremes/extreme_case.h"
#include "support/reference_cases.h"

namespace contact_path {
namespace {

double SlidingBarError(const TraceRequest&, const Increment& increment) {
  const double x = increment.positions[2];
  return Largest({increment.load_factor - sliding_bar::LoadFactor(x), increment.positions[3],
                  increment.contacts[0].rn - sliding_bar::NormalReaction(x)});
}

ExtremeCase StepOf(double step) {
  ExtremeCase extreme{"length of the increments", "step " + Text(step)};
  extreme.request = Until(sliding_bar::MakeScene(), "b.x", ">", 4.9, step, 1000);
  extreme.exact = "closed form";
  extreme.error = SlidingBarError;
  return extreme;
}

// Both limit points of the path are within it.
ExtremeCase ManyIncrements(int count) {
  ExtremeCase extreme{"number of increments", Text(count)};
  extreme.request = Until(sliding_bar::MakeScene(), "b.x", ">", 4.9, 1.75 / count, count);
  extreme.exact = "closed form";
  // The dissipation of method branch is an integral along the path, that of mpec a sum of products.
  extreme.error = [](const TraceRequest& request, const Increment& increment) {
    const double dissipation = sliding_bar::Dissipation(increment.positions[2]);
    return Largest({SlidingBarError(request, increment),
                    increment.solve.method == Method::kBranch ? increment.dissipation - dissipation : 0.0});
  };
  extreme.long_run = true;
  extreme.most_seconds = 120.0;
  return extreme;
}

}  // namespace

void AddLengthCases(std::vector<ExtremeCase>* cases) {
  for (const double step : {1e-8, 1e-6, 1e-4, 1e-2, 0.1, 1.0}) cases->push_back(StepOf(step));
  cases->push_back(ManyIncrements(1000000));
}

}  // namespace contact_path
