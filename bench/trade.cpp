// Error against time: traces each scene with many settings and measures how far their increments, and the lines between
// the increments, are from the exact path. Writes one line of CSV per setting. A path that takes too long is cut short;
// its time is then that of the whole path, by arc length.
//
// The exact path: method branch with a hundredth of the step of the preset (a tenth for big scenes), interpolated
// between its increments by a polynomial of degree 5 in arc length, which never reaches over an event.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "contact_path/path/branch_method.h"
#include "contact_path/path/model.h"
#include "contact_path/path/mpec_method.h"
#include "contact_path/path/preload.h"
#include "contact_path/path/stop.h"
#include "contact_path/scene/read_scene.h"
#include "lattice.h"
#include "process/process.h"

namespace contact_path {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kLongest = 12.0;  // seconds for one path

struct Sample {
  Eigen::VectorXd x;  // (u, s), scaled
  double load = 0.0;  // in the scene's unit
  double arc_length = 0.0;
  double dissipation = 0.0;
  bool smooth = true;  // no event here: the curve goes on without a bend
  bool limit = false;
};

struct Path {
  std::vector<Sample> increments;
  double seconds = 0.0;
  long iterations = 0, factorisations = 0, rejected = 0;
  bool stopped = false;  // by a criterion
  bool cut = false;      // for want of time
};

struct Setting {
  std::string method, accuracy;
  double step = 0.0;     // 0: of the preset
  double minimum = 0.0;  // smallest eps of mpec; 0: of the preset
  bool cold = false;     // mpec: every increment by the whole schedule of eps, not from a predicted point
};

std::unique_ptr<PathMethod> MakeMethod(const Model& model, const TraceOptions& options, const Setting& setting,
                                       const std::function<bool()>& cancelled = nullptr) {
  if (options.method == Method::kBranch)
    return std::make_unique<BranchMethod>(model, BranchOptions::For(options, AutomaticStepGrowth(model)), cancelled);
  MpecOptions mpec = MpecOptions::For(options, AutomaticStepGrowth(model));
  if (setting.minimum > 0.0) mpec.regularisation.minimum = setting.minimum;
  if (setting.cold) mpec.regularisation.predicted = false;
  return std::make_unique<MpecMethod>(model, mpec, cancelled);
}

TraceOptions OptionsOf(const TraceRequest& request, const Setting& setting) {
  TraceOptions options = request.options;
  options.method = setting.method == "branch" ? Method::kBranch : Method::kMpec;
  options.accuracy = setting.accuracy == "fast"       ? Accuracy::kFast
                     : setting.accuracy == "accurate" ? Accuracy::kAccurate
                                                      : Accuracy::kBalanced;
  options.step = setting.step;
  return options;
}

// Increment 0 is not timed: it is the same for all.
Path Follow(const TraceRequest& request, const Model& model, const PathPoint& start, const Setting& setting,
            double longest) {
  Path path;
  const TraceOptions options = OptionsOf(request, setting);
  const SceneIndex index(request.scene);
  const StopTest stop(request, index);
  const Clock::time_point begin = Clock::now();
  const auto late = [&] { return std::chrono::duration<double>(Clock::now() - begin).count() > longest; };
  const std::unique_ptr<PathMethod> method = MakeMethod(model, options, setting, late);
  const auto append = [&](const PathPoint& point, const AcceptedPoint* accepted) {
    Sample increment;
    increment.x.resize(point.u.size() + 1);
    increment.x << point.u, point.s;
    increment.load = point.s * model.scaling.load_factor;
    if (accepted != nullptr) {
      increment.arc_length = path.increments.back().arc_length + accepted->arc_length;
      increment.dissipation = path.increments.back().dissipation + accepted->work.friction;
      increment.smooth = accepted->kind == IncrementKind::kRegular || accepted->kind == IncrementKind::kSmoothLimit;
      increment.limit = accepted->kind == IncrementKind::kSmoothLimit || accepted->kind == IncrementKind::kCornerLimit;
    }
    path.increments.push_back(std::move(increment));
  };
  append(start, nullptr);
  IncrementFindings found;
  PathPoint point = start;
  bool ended = method->Start(point, &found).has_value();
  while (!ended) {
    const Advance advance = method->Next(point);
    if (advance.increment) {
      const AcceptedPoint& accepted = *advance.increment;
      point = accepted.point;
      append(point, &accepted);
      path.iterations += accepted.solve.iterations;
      path.factorisations += accepted.solve.factorisations;
      path.rejected += accepted.solve.rejected;
      Increment increment;
      const CheckedState state = model.InSceneUnits(point);
      increment.index = static_cast<int>(path.increments.size()) - 1;
      increment.load_factor = state.load_factor;
      increment.positions = state.positions;
      path.stopped = path.stopped || stop.FirstThatHolds(increment, accepted.at_criteria) != nullptr;
      ended = ended || path.stopped;
    }
    path.cut = !ended && (late() || path.increments.size() > 100000);
    ended = ended || path.cut || advance.end;
  }
  path.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  return path;
}

// The exact path as a curve.
class Curve {
 public:
  explicit Curve(const Path& path) : increments_(path.increments) {
    // First and last increment of the smooth arc that each interval between two increments belongs to.
    std::size_t begin = 0;
    for (std::size_t i = 1; i < increments_.size(); ++i)
      if (!increments_[i].smooth || i + 1 == increments_.size()) {
        for (std::size_t k = begin; k < i; ++k) pieces_.push_back({begin, i});
        begin = i;
      }
  }

  std::size_t Intervals() const { return pieces_.size(); }

  Eigen::VectorXd At(std::size_t k, double t) const {
    return Interpolate<Eigen::VectorXd>(k, t,
                                        [](const Sample& increment) -> const Eigen::VectorXd& { return increment.x; });
  }

  // From a point, looked for near and after interval *near, which becomes that of the nearest point; *dissipation:
  // there.
  double Distance(const Eigen::VectorXd& x, std::size_t* near, double reach, double* dissipation) const {
    std::size_t best = *near;
    double smallest = std::numeric_limits<double>::infinity();
    const double from = increments_[*near].arc_length;
    for (std::size_t k = *near; k < increments_.size() && increments_[k].arc_length <= from + reach; ++k) {
      const double distance = (increments_[k].x - x).squaredNorm();
      if (distance < smallest) smallest = distance, best = k;
    }
    *near = std::min(best, Intervals() - 1);
    double least = std::sqrt(smallest);
    *dissipation = increments_[best].dissipation;
    for (const std::size_t k : {best > 0 ? best - 1 : 0, std::min(best, Intervals() - 1)}) {
      double a = 0.0, b = 1.0;  // golden section
      const double ratio = 0.5 * (std::sqrt(5.0) - 1.0);
      for (int i = 0; i < 60; ++i) {
        const double c = b - ratio * (b - a), d = a + ratio * (b - a);
        ((At(k, c) - x).squaredNorm() < (At(k, d) - x).squaredNorm() ? b : a) =
            (At(k, c) - x).squaredNorm() < (At(k, d) - x).squaredNorm() ? d : c;
      }
      const double t = 0.5 * (a + b), distance = (At(k, t) - x).norm();
      if (distance >= least) continue;
      least = distance;
      *dissipation = Interpolate<double>(k, t, [](const Sample& increment) { return increment.dissipation; });
    }
    return least;
  }

 private:
  struct Piece {
    std::size_t begin, end;
  };

  // At share t of interval k, by the six increments of its piece that are nearest.
  template <typename Value, typename Get>
  Value Interpolate(std::size_t k, double t, const Get& get) const {
    const auto [begin, end] = pieces_[k];
    const std::size_t count = std::min<std::size_t>(6, end - begin + 1);
    std::size_t first = k >= begin + 2 ? k - 2 : begin;
    first = std::min(first, end + 1 - count);
    const double s = (1.0 - t) * increments_[k].arc_length + t * increments_[k + 1].arc_length;
    Value sum = 0.0 * get(increments_[k]);
    for (std::size_t i = first; i < first + count; ++i) {
      double weight = 1.0;
      for (std::size_t j = first; j < first + count; ++j)
        if (j != i) weight *= (s - increments_[j].arc_length) / (increments_[i].arc_length - increments_[j].arc_length);
      // About an increment of the interval, so that rounding is that of a difference.
      sum += weight * (get(increments_[i]) - get(increments_[k]));
    }
    return get(increments_[k]) + sum;
  }

  const std::vector<Sample>& increments_;
  std::vector<Piece> pieces_;
};

// Largest distance of the exact increments from the line through these increments, up to the end of the shorter path.
double LineError(const Path& exact, const Path& path) {
  double worst = 0.0;
  std::size_t k = 0;
  const double length = path.increments.back().arc_length;
  for (const Sample& increment : exact.increments) {
    if (increment.arc_length > 0.999 * length) break;
    double least = std::numeric_limits<double>::infinity();
    std::size_t best = k;
    for (std::size_t i = k; i + 1 < path.increments.size() && i < k + 40; ++i) {
      const Eigen::VectorXd along = path.increments[i + 1].x - path.increments[i].x,
                            to = increment.x - path.increments[i].x;
      const double square = along.squaredNorm();
      const double t = square > 0.0 ? std::clamp(along.dot(to) / square, 0.0, 1.0) : 0.0;
      const double distance = (to - t * along).norm();
      if (distance < least) least = distance, best = i;
    }
    k = best > 1 ? best - 1 : 0;
    worst = std::max(worst, least);
  }
  return worst;
}

std::vector<double> LimitLoads(const Path& path) {
  std::vector<double> loads;
  for (const Sample& increment : path.increments)
    if (increment.limit) loads.push_back(increment.load);
  return loads;
}

// Of the limit loads, relative to the largest; infinite where their number differs.
double LimitError(const Path& exact, const Path& path) {
  const std::vector<double> wanted = LimitLoads(exact), found = LimitLoads(path);
  if (wanted.size() != found.size()) return std::numeric_limits<double>::infinity();
  double worst = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    worst = std::max(worst, std::abs(wanted[i] - found[i]));
    largest = std::max(largest, std::abs(wanted[i]));
  }
  return largest > 0.0 ? worst / largest : 0.0;
}

// unit: what the steps of a small scene are multiplied by.
std::vector<Setting> AllSettings(double unit) {
  std::vector<Setting> settings;
  for (const char* method : {"branch", "mpec"})
    for (const char* accuracy : {"fast", "balanced", "accurate"}) settings.push_back({method, accuracy, 0.0, 0.0});
  for (const double step : {0.2, 0.1, 0.04, 0.01, 0.0025}) settings.push_back({"branch", "balanced", unit * step, 0.0});
  if (unit > 1.0) return settings;  // a big scene: mpec does not come to its end in the time
  for (const double step : {0.1, 0.04, 0.01}) settings.push_back({"mpec", "balanced", step, 0.0});
  for (const double minimum : {1e-4, 1e-6, 1e-10, 1e-12}) settings.push_back({"mpec", "balanced", 0.0, minimum});
  settings.push_back({"mpec", "balanced", 0.0, 0.0, true});
  return settings;
}

void Measure(const std::string& name, const TraceRequest& request) {
  const Model model(request.scene, CharacteristicScales(request.scene));
  const Preload preload = TraceStart(model, Accuracy::kBalanced, nullptr);
  if (!preload.done) {
    std::fprintf(stderr, "%s: the constant loads cannot be brought on\n", name.c_str());
    return;
  }
  const double growth = AutomaticStepGrowth(model), preset = 0.02 * growth;
  const double reference_share = growth > 1.0 ? 0.1 : 0.01;  // of the step of the preset: big scenes take long
  const Path exact = Follow(request, model, preload.point, {"branch", "balanced", reference_share * preset, 0.0},
                            std::numeric_limits<double>::infinity());
  const Curve curve(exact);
  for (const Setting& setting : AllSettings(growth)) {
    Path path = Follow(request, model, preload.point, setting, kLongest);
    const double total = path.seconds;
    for (double spent = total; spent < 0.2 && spent < 50.0 * total;) {
      const Path again = Follow(request, model, preload.point, setting, kLongest);
      path.seconds = std::min(path.seconds, again.seconds);
      spent += again.seconds;
    }
    double row_error = 0.0, dissipation_error = 0.0;
    std::size_t near = 0;
    // The last increment of a path may lie beyond the end of the exact one.
    for (const Sample& increment : path.increments)
      if (increment.arc_length <= exact.increments.back().arc_length) {
        double there = 0.0;
        row_error = std::max(row_error, curve.Distance(increment.x, &near, 4.0 * preset + 4.0 * setting.step, &there));
        dissipation_error = std::abs(increment.dissipation - there);
      }
    if (path.cut) path.seconds *= exact.increments.back().arc_length / path.increments.back().arc_length;
    const double increments = static_cast<double>(std::max<std::size_t>(path.increments.size(), 2) - 1);
    const double total_dissipation = exact.increments.back().dissipation;
    if (total_dissipation > 0.0) dissipation_error /= total_dissipation;
    std::printf("%s,%s,%s,%g,%g,%d,%zu,%.6g,%.3g,%.3g,%.3g,%.3g,%.4g,%.4g,%ld,%s\n", name.c_str(),
                setting.method.c_str(), setting.accuracy.c_str(), setting.step, setting.minimum, setting.cold ? 1 : 0,
                path.increments.size(), path.seconds, row_error, LineError(exact, path), LimitError(exact, path),
                dissipation_error, static_cast<double>(path.iterations) / increments,
                static_cast<double>(path.factorisations) / increments, path.rejected,
                path.cut       ? "cut"
                : path.stopped ? "stop"
                               : "early");
    std::fflush(stdout);
  }
}

TraceRequest LargeWall() {
  LatticeOptions lattice;
  lattice.kind = LatticeKind::kWall;
  lattice.columns = 40;
  lattice.rows = 24;
  lattice.contacts = 10;
  TraceRequest request = LatticeRequest(lattice);
  request.options.stop = {{"load_factor", ">", 0.012}};
  return request;
}

// The same wall four times, what it may touch being another matter each time.
void MeasureModels() {
  std::puts("case,method,variables,constraints,seconds");
  LatticeOptions lattice;
  lattice.kind = LatticeKind::kWall;
  lattice.columns = 20;
  lattice.rows = 4;
  lattice.contacts = 4;
  for (const char* name : {"no contact in reach", "frictionless contact", "friction on one node", "friction on all"}) {
    TraceRequest request = LatticeRequest(lattice);
    request.options = TraceOptions();
    Obstacle& floor = request.scene.obstacles.front();
    const bool reach = name[0] != 'n';
    floor.py = reach ? 0.0 : -100.0;
    floor.friction = std::string(name) == "friction on all" ? 0.3 : 0.0;
    if (std::string(name) == "friction on one node") {
      Obstacle rough = floor;
      rough.name = "rough";
      rough.friction = 0.3;
      request.scene.contacts.back().obstacle = rough.name;
      request.scene.obstacles.push_back(rough);
    }
    const Model model(request.scene, CharacteristicScales(request.scene));
    for (const char* method : {"branch", "mpec"}) {
      constexpr int kRows = 20;
      const std::unique_ptr<PathMethod> tracer =
          MakeMethod(model, OptionsOf(request, {method, "balanced", 0.0, 0.0}), {method, "balanced", 0.0, 0.0});
      PathPoint point = model.InitialPoint();
      IncrementFindings found;
      if (tracer->Start(point, &found)) std::fprintf(stderr, "%s: cannot start\n", name);
      const Clock::time_point begin = Clock::now();
      SolveRecord solve;
      int increments = 0;
      while (increments < kRows) {
        const Advance advance = tracer->Next(point);
        if (!advance.increment) break;
        point = advance.increment->point;
        solve = advance.increment->solve;
        ++increments;
      }
      std::printf("%s,%s,%d,%d,%.6g\n", name, method, solve.variables, solve.constraints,
                  std::chrono::duration<double>(Clock::now() - begin).count() / increments);
    }
  }
}

}  // namespace
}  // namespace contact_path

int main(int argc, char** argv) {
  using namespace contact_path;
  KeepMemory();
  if (argc == 2 && std::string(argv[1]) == "--model") {
    MeasureModels();
    return 0;
  }
  if (argc == 2 && std::string(argv[1]) == "--lattice") {
    std::fputs(WriteTraceRequest(LargeWall()).c_str(), stdout);
    return 0;
  }
  std::puts(
      "scene,method,accuracy,step,eps_min,cold,increments,seconds,row_error,line_error,limit_error,dissipation_error,"
      "iterations,factorisations,rejected,end");
  for (int i = 1; i < argc; ++i) {
    const std::string file = argv[i];
    const std::string name = file.substr(file.rfind('/') + 1, file.rfind(".yaml") - file.rfind('/') - 1);
    Measure(name, ReadTraceRequestFile(file));
  }
  return 0;
}
