// Random scenes by Algorithm 3.2, against their exact paths.
#include <gtest/gtest.h>
#include <Eigen/Core>

#include <algorithm>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include "contact_path/scene/scaling.h"
#include "support/curved_obstacles.h"
#include "support/random_scene.h"
#include "support/traced_path.h"

namespace contact_path::mpec_random_paths_test {
namespace {

constexpr double kArc = 0.16, kPolygon = 1e-6, kCorner = 5e-4;  // scaled
// What the chords of the path that is compared with are off by where it bends; measured 3.8e-6.
constexpr double kChords = 5e-6;

// Distance of an increment from the polygon of a path, in (u, s), scaled; *place: arc length there.
double DistanceFromPath(const Increment& increment, const TracedPath& path, double* place) {
  const Scaling scaling = CharacteristicScales(path.request.scene);
  const auto point = [&scaling](const Increment& of) {
    const auto size = static_cast<Eigen::Index>(of.positions.size());
    Eigen::VectorXd x(size + 1);
    x << Eigen::Map<const Eigen::VectorXd>(of.positions.data(), size) / scaling.length,
        of.load_factor / scaling.load_factor;
    return x;
  };
  const Eigen::VectorXd x = point(increment);
  double nearest = std::numeric_limits<double>::infinity();
  Eigen::VectorXd a = point(path.increments[0]);
  for (std::size_t i = 1; i < path.increments.size(); ++i) {
    const Eigen::VectorXd b = point(path.increments[i]), edge = b - a;
    const double share = edge.squaredNorm() > 0.0 ? std::clamp(edge.dot(x - a) / edge.squaredNorm(), 0.0, 1.0) : 0.0;
    const double distance = (a + share * edge - x).norm();
    if (distance < nearest) {
      nearest = distance;
      *place = path.increments[i].arc_length;
    }
    a = b;
  }
  return nearest;
}

// Whether some contact slides on the part that is compared.
bool Slides(const TracedPath& path) {
  return std::any_of(path.increments.begin(), path.increments.end(), [](const Increment& increment) {
    return increment.arc_length < kArc &&
           std::any_of(increment.contacts.begin(), increment.contacts.end(), [](const ContactRecord& contact) {
             return Slips(contact.state) || contact.state == ContactState::kClosed;
           });
  });
}

// Certified increments are on the path. Increments by Ipopt follow it: on it between events, next to it after one, as
// near as a corner may be cut.
struct Comparison {
  // The seeds 1 to `seeds`. make: the request of one. sliding_alone: only those whose path has a contact that slides.
  template <typename Make>
  Comparison(unsigned seeds, bool sliding_alone_in, MpecSolver solver_in, Make make)
      : sliding_alone(sliding_alone_in), solver(solver_in) {
    for (unsigned seed = 1; seed <= seeds; ++seed) Compare(make(seed), "seed " + std::to_string(seed));
    std::cout << increments << " increments; on the path in " << on_the_path
              << " scenes, not farther with shorter increments in " << nearer << " of " << scenes << "; " << ended
              << " of " << traces << " paths end early\n";
  }

  void Compare(TraceRequest request, const std::string& name) {
    request.options.step = 0.001;
    const TracedPath exact = TraceArc(request, 2.0 * kArc);
    if (exact.increments.empty() || (sliding_alone && !Slides(exact))) return;
    ++scenes;
    request.options.method = Method::kMpec;
    request.options.mpec_solver = solver;
    std::vector<double> farthest;
    for (const double step : {0.04, 0.02}) {
      request.options.step = step;
      const TracedPath path = TraceArc(request, kArc);
      ++traces;
      const bool ends_early = path.result.reason == EndReason::kStepTooSmall;
      if (ends_early && exact.increments.back().arc_length > 2.0 * kArc) {
        ++ended;
        std::cout << name << ", step " << step << ": " << path.result.message << "\n";
      }
      double worst = 0.0, place = 0.0;
      for (const Increment& increment : path.increments) {
        const double distance = DistanceFromPath(increment, exact, &place);
        worst = std::max(worst, distance);
        EXPECT_LE(distance, solver == MpecSolver::kIpopt ? kCorner : kChords) << name << " at " << place;
        ++increments;
      }
      farthest.push_back(worst);
    }
    std::cout << name << ": at most " << farthest[0] << " and, with shorter increments, " << farthest[1]
              << " from the path\n";
    if (farthest[1] <= kPolygon) ++on_the_path;
    if (farthest[1] <= 1.1 * farthest[0] + kPolygon) ++nearer;
  }

  const bool sliding_alone;
  const MpecSolver solver;
  int scenes = 0, traces = 0, ended = 0, nearer = 0, on_the_path = 0, increments = 0;
};

TEST(RandomPathsByMpec, FollowTheExactPathByIpopt) {
  const Comparison found(12, false, MpecSolver::kIpopt, [](unsigned seed) { return RandomRequest(seed); });
  EXPECT_EQ(found.scenes, 12);
  EXPECT_GE(found.on_the_path, 7);
  EXPECT_EQ(found.nearer, found.scenes);
}

TEST(RandomPathsByMpec, AreTheExactPath) {
  const Comparison found(12, false, MpecSolver::kCertified, [](unsigned seed) { return RandomRequest(seed); });
  EXPECT_EQ(found.scenes, 12);
}

TEST(RandomPathsByMpec, AreTheExactPathOnCurves) {
  const Comparison found(38, true, MpecSolver::kCertified,
                         [](unsigned seed) { return OnCurves(RandomRequest(seed), seed); });
  EXPECT_GE(found.scenes, 18);
  EXPECT_EQ(found.ended, 0);
}

}  // namespace
}  // namespace contact_path::mpec_random_paths_test
