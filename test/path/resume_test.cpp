// A trace that was cut short and gone on with is the one without interruption.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "contact_path/path/mpec_method.h"
#include "support/traced_path.h"

namespace contact_path::resume_test {
namespace {

TracedPath Resume(const TraceRequest& request, std::vector<Increment> increments) {
  TracedPath path;
  path.request = request;
  TraceControl control;
  control.on_increment = [&](const Increment& increment) { path.increments.push_back(increment); };
  control.mpec = MakeMpecMethod;
  path.result = ResumeTrace(request, increments, control);
  return path;
}

void ExpectSamePath(const TracedPath& whole, const TracedPath& resumed, double tolerance, const std::string& where) {
  ASSERT_EQ(whole.increments.size(), resumed.increments.size()) << where;
  EXPECT_EQ(whole.result.reason, resumed.result.reason) << where;
  EXPECT_EQ(whole.result.message, resumed.result.message) << where;
  double worst = 0.0;
  for (std::size_t i = 0; i < whole.increments.size(); ++i) {
    const Increment &a = whole.increments[i], &b = resumed.increments[i];
    EXPECT_EQ(a.index, b.index) << where;
    EXPECT_EQ(a.stage, b.stage) << where;
    EXPECT_EQ(a.kind, b.kind) << where << ", increment " << i;
    EXPECT_EQ(a.event.number, b.event.number) << where << ", increment " << i;
    EXPECT_EQ(a.event.taken, b.event.taken) << where << ", increment " << i;
    // Where the structure has become a mechanism, and no branch is taken, rounding names its motions.
    if (a.event.taken > 0) {
      EXPECT_EQ(a.event.branches.size(), b.event.branches.size()) << where << ", increment " << i;
    }
    worst = std::max(worst, LargestDifference(a, b));
    worst = std::max({worst, std::abs(a.arc_length - b.arc_length), std::abs(a.dissipation - b.dissipation),
                      std::abs(a.external_work - b.external_work)});
  }
  EXPECT_LE(worst, tolerance) << where;
}

TEST(Resume, FromAnyIncrementOfAnyExampleByBranch) {
  for (const char* name : {"sliding_bar", "von_mises", "rough_truss", "two_dof_friction", "rigid_stop",
                           "stick_slip_cycle", "press_slide_lift", "gripper"}) {
    const TracedPath whole = TraceIncrements(ReadExample(name));
    const std::size_t stride = whole.increments.size() / 40 + 1;
    for (std::size_t cut = 1; cut <= whole.increments.size(); cut += stride) {
      ExpectSamePath(whole, ResumeAfter(cut, whole), 1e-9, std::string(name) + " after " + std::to_string(cut));
    }
    ExpectNoFindings(ResumeAfter(whole.increments.size(), whole));
  }
}

// From each increment of a path that rests while load and reactions change, of one that turns at smooth limit points,
// where nearly each second step is shortened, and of one that snaps back with friction.
TEST(Resume, ToRounding) {
  for (const char* name : {"stall_333", "resume", "drag_snapback"}) {
    const TracedPath whole = TraceIncrements(ReadData(name));
    for (std::size_t cut = 1; cut <= whole.increments.size(); ++cut) {
      ExpectSamePath(whole, ResumeAfter(cut, whole), 1e-11, std::string(name) + " after " + std::to_string(cut));
    }
  }
}

// Of positions and load factor from the chords of the path.
double DistanceFrom(const TracedPath& path, const Increment& increment) {
  const auto place = [](const Increment& of) {
    Eigen::VectorXd coordinates(static_cast<Eigen::Index>(of.positions.size()) + 1);
    coordinates << Eigen::Map<const Eigen::VectorXd>(of.positions.data(), coordinates.size() - 1), of.load_factor;
    return coordinates;
  };
  const Eigen::VectorXd at = place(increment);
  double nearest = (at - place(path.increments[0])).norm();
  for (std::size_t i = 1; i < path.increments.size(); ++i) {
    const Eigen::VectorXd from = place(path.increments[i - 1]), chord = place(path.increments[i]) - from;
    const double share = std::clamp(chord.dot(at - from) / std::max(chord.squaredNorm(), 1e-300), 0.0, 1.0);
    nearest = std::min(nearest, (at - from - share * chord).norm());
  }
  return nearest;
}

// The steps of Ipopt depend on where its iterations set out: from the last solution, which is not on record. The path
// itself does not.
TEST(Resume, ByMpec) {
  constexpr double kChords = 1e-3;  // between the curve and the chords of increments of this length
  for (const char* name : {"sliding_bar", "stick_slip_cycle"}) {
    TraceRequest request = ReadExample(name);
    request.options.method = Method::kMpec;
    const TracedPath whole = TraceIncrements(request);
    for (std::size_t cut = 1; cut <= whole.increments.size(); cut += whole.increments.size() / 6 + 1) {
      const TracedPath resumed = ResumeAfter(cut, whole);
      EXPECT_EQ(whole.result.reason, resumed.result.reason) << name << " after " << cut;
      double worst = 0.0;
      // The last increment is beyond the stop criterion, farther or less far.
      for (std::size_t i = 0; i + 1 < resumed.increments.size(); ++i)
        worst = std::max(worst, DistanceFrom(whole, resumed.increments[i]));
      EXPECT_LE(worst, kChords) << name << " after " << cut;
    }
  }
}

TEST(Resume, KeepsIncrementsAsTheyAre) {
  const TraceRequest request = ReadExample("sliding_bar");
  std::vector<Increment> increments = TraceIncrements(request).increments;
  increments.resize(20);
  const TracedPath resumed = Resume(request, increments);
  int kept = 0;
  for (std::size_t i = 0; i < increments.size(); ++i)
    kept += resumed.increments[i].solve.time == increments[i].solve.time ? 1 : 0;
  EXPECT_GE(kept, 15);
}

TEST(Resume, MoreIncrementsThanWereWanted) {
  TraceRequest request = ReadExample("sliding_bar");
  const TracedPath whole = TraceIncrements(request);
  request.options.max_increments = 17;
  const TracedPath part = TraceIncrements(request);
  ASSERT_EQ(part.increments.size(), 18u);
  request.options.max_increments = 0;
  ExpectSamePath(whole, Resume(request, part.increments), 1e-9, "after max_increments");
}

TEST(Resume, OfNothingIsATrace) {
  const TraceRequest request = ReadExample("sliding_bar");
  ExpectSamePath(TraceIncrements(request), Resume(request, {}), 0.0, "nothing");
}

TEST(Resume, IncrementsWithoutStateAreGoneOnFromTheLastWithIt) {
  for (const Method method : kMethods) {
    TraceRequest request = ReadExample("sliding_bar");
    request.options.method = method;
    const TracedPath whole = TraceIncrements(request);
    std::vector<Increment> increments = Thinned(whole, 4);
    increments.resize(whole.increments.size() / 2);
    TracedPath resumed = Resume(request, increments);
    ASSERT_EQ(resumed.increments.size(), whole.increments.size());
    for (std::size_t i = 0; i < increments.size(); ++i)
      if (resumed.increments[i].positions.empty()) resumed.increments[i] = whole.increments[i];  // left out, not other
    ExpectSamePath(whole, resumed, 1e-9, std::string(ToString(method)));
  }
}

TEST(Resume, IncrementsOfSomethingElseAreRefused) {
  const TraceRequest request = ReadExample("sliding_bar");
  const std::vector<Increment> increments = TraceIncrements(request).increments;
  std::vector<Increment> other = TraceIncrements(ReadExample("rough_truss")).increments;
  EXPECT_THROW(Resume(request, other), std::invalid_argument);
  other = increments;
  other.erase(other.begin() + 3);
  EXPECT_THROW(Resume(request, other), std::invalid_argument);
  other = increments;
  other[2].stage = 1;
  EXPECT_THROW(Resume(request, other), std::invalid_argument);
}

}  // namespace
}  // namespace contact_path::resume_test
