// Scenes and paths as the tests of the tracer want them.
#ifndef CONTACT_PATH_TEST_SUPPORT_TRACED_PATH_H_
#define CONTACT_PATH_TEST_SUPPORT_TRACED_PATH_H_

#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "contact_path/path/increment.h"
#include "contact_path/path/trace.h"
#include "contact_path/scene/scene.h"

namespace contact_path {

struct TracedPath {
  TraceRequest request;
  TraceResult result;
  std::vector<Increment> increments;
};

// The request in scenes/<name>.yaml.
TraceRequest ReadExample(const std::string& name);

// All increments of the request of this text, in which <name> stands for values[name].
TracedPath TraceText(std::string text, const std::map<std::string, double>& values = {});

// All increments of a request.
TracedPath TraceIncrements(const TraceRequest& request);

// What VerifyPath finds wrong with a path fails the test.
void ExpectNoFindings(const TracedPath& path);

// All increments of a request whose path is complete and proved, with residuals up to this bound. The request of the
// path has the nodes and contacts of beams and groups by name.
TracedPath TraceProved(const TraceRequest& request, double largest_residual = std::numeric_limits<double>::infinity());

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

// Index of the increment with the largest load factor.
std::size_t LargestLoad(const TracedPath& path);

std::vector<Increment> IncrementsOfKind(const TracedPath& path, IncrementKind kind);

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
