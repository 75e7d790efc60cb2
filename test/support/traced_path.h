// Scenes and paths as the tests of the tracer want them.
#ifndef CONTACT_PATH_TEST_SUPPORT_TRACED_PATH_H_
#define CONTACT_PATH_TEST_SUPPORT_TRACED_PATH_H_

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "contact_path/path/increment.h"
#include "contact_path/path/trace.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

constexpr Method kMethods[] = {Method::kBranch, Method::kMpec};
constexpr Accuracy kPresets[] = {Accuracy::kFast, Accuracy::kBalanced, Accuracy::kAccurate};

struct TracedPath {
  TraceRequest request;
  TraceResult result;
  std::vector<Increment> increments;
};

// The request in scenes/<name>.yaml.
TraceRequest ReadExample(const std::string& name);

// The request in test/data/<name>.yaml.
TraceRequest ReadData(const std::string& name);

// The same with four times the increments of the default.
TraceRequest ReadLongData(const std::string& name);

// All increments of a request.
TracedPath TraceIncrements(const TraceRequest& request);

// What VerifyPath finds wrong with a path fails the test.
void ExpectNoFindings(const TracedPath& path);

// All increments of a request, wherever they end, proved by VerifyPath, with residuals up to this bound.
TracedPath TraceVerified(const TraceRequest& request,
                         double largest_residual = std::numeric_limits<double>::infinity());

// The same of a path that ends for this reason, with this part of a message.
TracedPath TraceTo(const TraceRequest& request, EndReason end = EndReason::kStopCriterion,
                   const std::string& message = "");
TracedPath TraceTo(const TraceRequest& request, EndReason end, double largest_residual);

// The same to a stop criterion or the end of a program. The request of the path has the nodes and contacts of beams and
// groups by name.
TracedPath TraceProved(const TraceRequest& request, double largest_residual = std::numeric_limits<double>::infinity());

// A scene by default options, proved to this criterion.
TracedPath TraceUntil(const StopCriterion& stop, const Scene& scene);

// Each accuracy of a request: the path ends for this reason and is proved, with residuals up to this bound, and is as
// expected.
void ForEachAccuracy(TraceRequest request, EndReason end, double largest_residual,
                     const std::function<void(const TracedPath&)>& expect);

// The increments behind the first `count` ones of a path are traced anew, going on from those.
TracedPath ResumeAfter(std::size_t count, const TracedPath& path);

// The increments of a path without the states that full_state_every = `every` leaves out.
std::vector<Increment> Thinned(const TracedPath& path, int every);

// The path ends for this reason, with this part of a message.
void ExpectEnd(const TracedPath& path, EndReason end, const std::string& message = "");

// At most so many increments of a scene, by default options.
TracedPath TraceScene(const Scene& scene, int increments);

// The increments up to the first one beyond this arc length (scaled), at most 4000.
TracedPath TraceArc(TraceRequest request, double arc_length);

// By name; the node or contact must exist.
std::size_t NodeNumber(const Scene& scene, const std::string& node);
double PositionX(const TracedPath& path, const Increment& increment, const std::string& node);
double PositionY(const TracedPath& path, const Increment& increment, const std::string& node);
const ContactRecord& Contact(const TracedPath& path, const Increment& increment, const std::string& contact);

// Of the normal reactions of all contacts [force].
double SumOfNormals(const Increment& increment);

// Index of the increment with the largest load factor, and that load factor.
std::size_t LargestLoad(const TracedPath& path);
double LargestLoadFactor(const TracedPath& path);

std::vector<Increment> IncrementsOfKind(const TracedPath& path, IncrementKind kind);
std::vector<double> LoadsOfKind(const TracedPath& path, IncrementKind kind);

// As many numbers, each within the tolerance.
void ExpectNear(const std::vector<double>& actual, const std::vector<double>& expected, double tolerance);

// The first increment of a path that is so; there must be one.
template <typename Predicate>
const Increment& FirstThat(const TracedPath& path, Predicate is_so) {
  const auto found = std::find_if(path.increments.begin(), path.increments.end(), is_so);
  if (found == path.increments.end()) throw std::runtime_error("no such increment; " + path.result.message);
  return *found;
}

// The stage must have increments.
const Increment& LastOfStage(const TracedPath& path, int stage);

// Of positions, load factor and reactions; the states of the contacts are the same.
double LargestDifference(const Increment& a, const Increment& b);

// Starts of stages, limit points, events, bifurcations, onsets of instability and jumps.
std::vector<const Increment*> EventsOf(const TracedPath& path);

// Both paths end for the same reason, and their events are of the same stages and kinds at the same load factors:
// `tolerance`, relative where they are above 1.
void ExpectSameEvents(const TracedPath& path, const TracedPath& other, double tolerance);

// Distance of an increment from the polygon of a path, in (u, s), scaled; *place: arc length there.
double DistanceFromPath(const Increment& increment, const TracedPath& path, double* place);

// Largest |external work - change of energy - dissipation| over the characteristic energy.
double EnergyImbalance(const TracedPath& path);

// What every accepted path keeps, whatever the scene and the method: residuals computed anew from the increments alone,
// kinds, states, signs, counters. `tolerance` bounds the residuals.
void ExpectSoundIncrements(const TracedPath& path, double tolerance);

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SUPPORT_TRACED_PATH_H_
