#include "support/traced_path.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#include "contact_path/check/residuals.h"
#include "contact_path/path/mpec_method.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/read_scene.h"
#include "contact_path/scene/scaling.h"
#include "contact_path/scene/surface.h"
#include "contact_path/verify/verify_path.h"

namespace contact_path {
namespace {

// The state agrees with what the contact does on the arc from `before` to `now`.
void ExpectSoundContact(const ContactRecord& before, const ContactRecord& now, double motion, double friction,
                        double force_tolerance, double length_tolerance, const std::string& where) {
  const bool smooth = friction == 0.0;
  switch (now.state) {
    case ContactState::kOpen:
      EXPECT_EQ(now.rn, 0.0) << where;
      EXPECT_EQ(now.rt, 0.0) << where;
      EXPECT_GE(now.gap, -length_tolerance) << where;
      break;
    case ContactState::kClosed:
      EXPECT_TRUE(smooth) << where;
      EXPECT_EQ(now.rt, 0.0) << where;
      EXPECT_NEAR(now.gap, 0.0, length_tolerance) << where;
      break;
    case ContactState::kStick:
      EXPECT_FALSE(smooth) << where;
      EXPECT_NEAR(now.gap, 0.0, length_tolerance) << where;
      // Where the arc starts with a gap, the contact is made on it, and sticks from there.
      if (before.gap <= length_tolerance) {
        EXPECT_NEAR(motion, 0.0, length_tolerance) << where;
      }
      EXPECT_LE(std::abs(now.rt), friction * now.rn + force_tolerance) << where;
      break;
    case ContactState::kSlipPlus:
    case ContactState::kSlipMinus: {
      const double sign = now.state == ContactState::kSlipPlus ? 1.0 : -1.0;
      EXPECT_FALSE(smooth) << where;
      EXPECT_NEAR(now.gap, 0.0, length_tolerance) << where;
      EXPECT_NEAR(now.rt, -sign * friction * now.rn, force_tolerance) << where;
      EXPECT_GE(sign * motion, -length_tolerance) << where;
      break;
    }
  }
}

// Where a node is as seen by an obstacle that has moved.
Eigen::Vector2d SeenBy(const Scene& scene, const Obstacle& obstacle, std::size_t node, const Increment& increment) {
  const double s = increment.load_factor;
  Eigen::Vector2d x(increment.positions[2 * node], increment.positions[2 * node + 1]);
  for (const ObstacleMotion& motion : scene.obstacle_motions) {
    if (motion.obstacle != obstacle.name) continue;
    const Eigen::Vector2d about(motion.about_x, motion.about_y);
    x = about + Eigen::Rotation2Dd(-motion.turn * s) * (x - about - s * Eigen::Vector2d(motion.dx, motion.dy));
  }
  return x;
}

// Along the tangent; of a closed surface less than half of it.
double MotionAlong(const Surface& surface, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const double motion = surface.ProjectOnNearest(to).xi - surface.ProjectOnNearest(from).xi;
  if (!surface.Closed()) return motion;
  return std::remainder(motion, surface.RangeOf(surface.NumPatches()).begin - surface.RangeOf(0).begin);
}

}  // namespace

TraceRequest ReadExample(const std::string& name) {
  return ReadTraceRequestFile(std::string(CONTACT_PATH_SCENES) + "/" + name + ".yaml");
}

TraceRequest ReadData(const std::string& name) {
  return ReadTraceRequestFile(std::string(CONTACT_PATH_TEST_DATA) + "/" + name + ".yaml");
}

TraceRequest ReadLongData(const std::string& name) {
  TraceRequest request = ReadData(name);
  request.options.max_increments = 4 * static_cast<int>(request.options.MaxIncrements(request.program.size()));
  return request;
}

TracedPath TraceIncrements(const TraceRequest& request) {
  TracedPath path;
  path.request = request;
  TraceControl control;
  control.on_increment = [&path](const Increment& increment) { path.increments.push_back(increment); };
  control.mpec = MakeMpecMethod;
  path.result = Trace(request, control);
  return path;
}

void ExpectNoFindings(const TracedPath& path) {
  for (const Finding& finding : VerifyPath(path.request, path.increments).findings)
    ADD_FAILURE() << "increment " << finding.increment << ": " << finding.what;
}

TracedPath TraceVerified(const TraceRequest& request, double largest_residual) {
  TracedPath path = TraceIncrements(request);
  ExpectNoFindings(path);
  for (const Increment& increment : path.increments)
    EXPECT_LE(increment.residuals.Largest(), largest_residual) << "increment " << increment.index;
  return path;
}

TracedPath TraceTo(const TraceRequest& request, EndReason end, const std::string& message) {
  TracedPath path = TraceVerified(request);
  ExpectEnd(path, end, message);
  return path;
}

TracedPath TraceTo(const TraceRequest& request, EndReason end, double largest_residual) {
  TracedPath path = TraceVerified(request, largest_residual);
  ExpectEnd(path, end);
  return path;
}

TracedPath TraceProved(const TraceRequest& request, double largest_residual) {
  TracedPath path = TraceTo(request, EndReason::kStopCriterion, largest_residual);
  path.request = Expand(request).request;
  return path;
}

TracedPath TraceUntil(const StopCriterion& stop, const Scene& scene) {
  TraceRequest request;
  request.scene = scene;
  request.options.stop = {stop};
  return TraceTo(request);
}

void ForEachAccuracy(TraceRequest request, EndReason end, double largest_residual,
                     const std::function<void(const TracedPath&)>& expect) {
  for (const Accuracy accuracy : kPresets) {
    SCOPED_TRACE(ToString(accuracy));
    request.options.accuracy = accuracy;
    expect(TraceTo(request, end, largest_residual));
  }
}

TracedPath ResumeAfter(std::size_t count, const TracedPath& path) {
  TracedPath resumed{path.request, {}, {}};
  TraceControl control;
  control.on_increment = [&](const Increment& increment) { resumed.increments.push_back(increment); };
  control.mpec = MakeMpecMethod;
  const auto end = path.increments.begin() + static_cast<std::ptrdiff_t>(count);
  resumed.result = ResumeTrace(path.request, {path.increments.begin(), end}, control);
  return resumed;
}

std::vector<Increment> Thinned(const TracedPath& path, int every) {
  std::vector<Increment> increments = path.increments;
  for (Increment& increment : increments)
    if (increment.kind == IncrementKind::kRegular && increment.index % every != 0) {
      increment.positions.clear();
      increment.rotations.clear();
      increment.contacts.clear();
    }
  return increments;
}

void ExpectEnd(const TracedPath& path, EndReason end, const std::string& message) {
  EXPECT_EQ(ToString(path.result.reason), ToString(end)) << path.result.message;
  EXPECT_NE(path.result.message.find(message), std::string::npos) << path.result.message;
}

TracedPath TraceScene(const Scene& scene, int increments) {
  TraceRequest request;
  request.scene = scene;
  request.options.max_increments = increments;
  return TraceIncrements(request);
}

TracedPath TraceArc(TraceRequest request, double arc_length) {
  TracedPath path;
  request.options.max_increments = 4000;
  path.request = request;
  bool done = false;
  TraceControl control;
  control.on_increment = [&](const Increment& increment) {
    path.increments.push_back(increment);
    done = increment.arc_length > arc_length;
  };
  control.cancelled = [&] { return done; };
  control.mpec = MakeMpecMethod;
  path.result = Trace(path.request, control);
  return path;
}

std::size_t NodeNumber(const Scene& scene, const std::string& node) {
  for (std::size_t i = 0; i < scene.nodes.size(); ++i)
    if (scene.nodes[i].name == node) return i;
  throw std::invalid_argument("no node " + node);
}

double PositionX(const TracedPath& path, const Increment& increment, const std::string& node) {
  return increment.positions.at(2 * NodeNumber(path.request.scene, node));
}

double PositionY(const TracedPath& path, const Increment& increment, const std::string& node) {
  return increment.positions.at(2 * NodeNumber(path.request.scene, node) + 1);
}

const ContactRecord& Contact(const TracedPath& path, const Increment& increment, const std::string& contact) {
  const std::vector<ContactCandidate>& contacts = path.request.scene.contacts;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    if (contacts[i].Name() == contact) return increment.contacts.at(i);
  throw std::invalid_argument("no contact " + contact);
}

double SumOfNormals(const Increment& increment) {
  double sum = 0.0;
  for (const ContactRecord& contact : increment.contacts) sum += contact.rn;
  return sum;
}

std::size_t LargestLoad(const TracedPath& path) {
  const auto largest =
      std::max_element(path.increments.begin(), path.increments.end(),
                       [](const Increment& a, const Increment& b) { return a.load_factor < b.load_factor; });
  return static_cast<std::size_t>(largest - path.increments.begin());
}

double LargestLoadFactor(const TracedPath& path) { return path.increments.at(LargestLoad(path)).load_factor; }

std::vector<Increment> IncrementsOfKind(const TracedPath& path, IncrementKind kind) {
  std::vector<Increment> increments;
  for (const Increment& increment : path.increments)
    if (increment.kind == kind) increments.push_back(increment);
  return increments;
}

std::vector<double> LoadsOfKind(const TracedPath& path, IncrementKind kind) {
  std::vector<double> loads;
  for (const Increment& increment : IncrementsOfKind(path, kind)) loads.push_back(increment.load_factor);
  return loads;
}

void ExpectNear(const std::vector<double>& actual, const std::vector<double>& expected, double tolerance) {
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t i = 0; i < actual.size(); ++i) EXPECT_NEAR(actual[i], expected[i], tolerance) << i;
}

const Increment& LastOfStage(const TracedPath& path, int stage) {
  const auto last = std::find_if(path.increments.rbegin(), path.increments.rend(),
                                 [&](const Increment& increment) { return increment.stage == stage; });
  if (last == path.increments.rend()) throw std::runtime_error("no stage " + std::to_string(stage));
  return *last;
}

double LargestDifference(const Increment& a, const Increment& b) {
  EXPECT_EQ(a.positions.size(), b.positions.size());
  EXPECT_EQ(a.contacts.size(), b.contacts.size());
  double worst = std::abs(a.load_factor - b.load_factor);
  for (std::size_t i = 0; i < std::min(a.positions.size(), b.positions.size()); ++i)
    worst = std::max(worst, std::abs(a.positions[i] - b.positions[i]));
  for (std::size_t i = 0; i < std::min(a.contacts.size(), b.contacts.size()); ++i) {
    const ContactRecord &of_a = a.contacts[i], &of_b = b.contacts[i];
    EXPECT_EQ(of_a.state, of_b.state) << "contact " << i;
    worst = std::max({worst, std::abs(of_a.rn - of_b.rn), std::abs(of_a.rt - of_b.rt)});
  }
  return worst;
}

std::vector<const Increment*> EventsOf(const TracedPath& path) {
  std::vector<const Increment*> events;
  for (const Increment& increment : path.increments)
    if (increment.kind != IncrementKind::kRegular && increment.kind != IncrementKind::kSample)
      events.push_back(&increment);
  return events;
}

void ExpectSameEvents(const TracedPath& path, const TracedPath& other, double tolerance) {
  EXPECT_EQ(ToString(other.result.reason), ToString(path.result.reason)) << other.result.message;
  const std::vector<const Increment*> events = EventsOf(path), others = EventsOf(other);
  EXPECT_EQ(others.size(), events.size());
  for (std::size_t i = 0; i < std::min(events.size(), others.size()); ++i) {
    const double load = events[i]->load_factor;
    EXPECT_EQ(others[i]->stage, events[i]->stage) << i;
    EXPECT_EQ(ToString(others[i]->kind), ToString(events[i]->kind)) << i;
    EXPECT_NEAR(others[i]->load_factor, load, tolerance * std::max(1.0, std::abs(load))) << i;
  }
}

double DistanceFromPath(const Increment& increment, const TracedPath& path, double* place) {
  const Scaling scaling = CharacteristicScales(path.request.scene);
  const auto point = [&scaling](const Increment& of) {
    const auto places = static_cast<Eigen::Index>(of.positions.size());
    const auto turns = static_cast<Eigen::Index>(of.rotations.size());
    Eigen::VectorXd x(places + turns + 1);
    x << Eigen::Map<const Eigen::VectorXd>(of.positions.data(), places) / scaling.length,
        Eigen::Map<const Eigen::VectorXd>(of.rotations.data(), turns), of.load_factor / scaling.load_factor;
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

double EnergyImbalance(const TracedPath& path) {
  const Scaling scaling = CharacteristicScales(path.request.scene);
  double worst = 0.0;
  for (const Increment& increment : path.increments)
    worst =
        std::max(worst, std::abs(increment.external_work -
                                 (increment.strain_energy - path.increments[0].strain_energy) - increment.dissipation));
  return worst / (scaling.force * scaling.length);
}

void ExpectSoundIncrements(const TracedPath& path, double tolerance) {
  const ExpandedRequest expanded(path.request);
  const Scene& scene = expanded.Get().scene;
  const Scaling scaling = CharacteristicScales(scene);
  ASSERT_FALSE(path.increments.empty());
  EXPECT_EQ(path.result.increments, static_cast<int>(path.increments.size()));
  EXPECT_FALSE(path.result.message.empty());
  EXPECT_EQ(path.increments[0].kind, IncrementKind::kStart);
  EXPECT_EQ(path.increments[0].load_factor, 0.0);
  EXPECT_EQ(path.increments[0].arc_length, 0.0);
  EXPECT_EQ(path.increments[0].dissipation, 0.0);
  EXPECT_EQ(path.increments[0].external_work, 0.0);
  std::vector<std::unique_ptr<const Surface>> surfaces;
  for (const Obstacle& obstacle : scene.obstacles) surfaces.push_back(MakeSurface(obstacle));
  const ResidualCheck check(scene);
  for (std::size_t i = 0; i < path.increments.size(); ++i) {
    const Increment& increment = path.increments[i];
    const Increment& before = path.increments[i == 0 ? 0 : i - 1];
    const std::string where = scene.name + ", increment " + std::to_string(i);
    SCOPED_TRACE(where);
    ASSERT_EQ(increment.positions.size(), 2 * scene.nodes.size());
    ASSERT_EQ(increment.contacts.size(), scene.contacts.size());
    EXPECT_EQ(increment.index, static_cast<int>(i));
    EXPECT_EQ(increment.kind == IncrementKind::kStart, i == 0);

    const Residuals residuals = check.Check(StateOf(before), StateOf(increment));
    EXPECT_LE(residuals.equilibrium, tolerance);
    EXPECT_LE(residuals.Contact(), tolerance);
    EXPECT_NEAR(residuals.equilibrium, increment.residuals.equilibrium, 1e-15 + tolerance);
    EXPECT_NEAR(residuals.Contact(), increment.residuals.Contact(), 1e-15 + tolerance);
    EXPECT_NEAR(check.StrainEnergy(increment.positions, increment.rotations), increment.strain_energy,
                1e-13 * scaling.force * scaling.length);

    if (i > 0) {
      EXPECT_GT(increment.arc_length, before.arc_length);
      EXPECT_GE(increment.dissipation, before.dissipation);
      EXPECT_TRUE(increment.solve.exact);
    }
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
      if (std::any_of(scene.support_motions.begin(), scene.support_motions.end(),
                      [&](const SupportMotion& motion) { return motion.node == scene.nodes[n].name; }))
        continue;
      EXPECT_TRUE(!scene.nodes[n].fixed_x || increment.positions[2 * n] == scene.nodes[n].x);
      EXPECT_TRUE(!scene.nodes[n].fixed_y || increment.positions[2 * n + 1] == scene.nodes[n].y);
    }
    for (std::size_t c = 0; c < scene.contacts.size(); ++c) {
      const auto obstacle =
          std::find_if(scene.obstacles.begin(), scene.obstacles.end(),
                       [&](const Obstacle& candidate) { return candidate.name == scene.contacts[c].obstacle; });
      const std::size_t n = NodeNumber(scene, scene.contacts[c].node);
      const auto k = static_cast<std::size_t>(obstacle - scene.obstacles.begin());
      const double motion =
          MotionAlong(*surfaces[k], SeenBy(scene, *obstacle, n, before), SeenBy(scene, *obstacle, n, increment));
      ExpectSoundContact(before.contacts[c], increment.contacts[c], motion, obstacle->friction,
                         tolerance * scaling.force, tolerance * scaling.length,
                         where + ", " + scene.contacts[c].Name());
    }
  }
}

}  // namespace contact_path
