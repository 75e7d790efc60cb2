// The example scenes with circles, polylines and splines, against closed forms and computations by hand.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "contact_path/scene/surface.h"
#include "support/traced_path.h"

namespace contact_path::curved_scenes_test {
namespace {

constexpr double kSame = 1e-8;  // of events, in the units of the scenes, which are near 1

Eigen::Vector2d Place(const TracedPath& path, const Increment& increment, const std::string& node) {
  return {PositionX(path, increment, node), PositionY(path, increment, node)};
}

// A zero of a function that changes its sign between both ends.
double Bisect(const std::function<double(double)>& f, double from, double to) {
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (from + to);
    (f(from) * f(middle) <= 0.0 ? to : from) = middle;
  }
  return from;
}

// The load is largest where the closed form is.
TEST(CurvedScenes, Peg) {
  constexpr double kMu = 0.3;
  const auto load = [&](double angle) {
    const Eigen::Vector2d n(std::sin(angle), std::cos(angle)), t = TangentOf(n);
    Eigen::Matrix2d columns;
    columns << Eigen::Vector2d(1.0, -0.2), n - kMu * t;
    const Eigen::Vector2d spring(1.3 * (n.x() - 0.2), 0.8 * (n.y() + 0.3));
    return columns.inverse().row(0).dot(spring);
  };
  const TracedPath path = TraceProved(ReadExample("peg"));
  const std::vector<Increment> limits = IncrementsOfKind(path, IncrementKind::kSmoothLimit);
  ASSERT_EQ(limits.size(), 1u);
  const Eigen::Vector2d place = Place(path, limits[0], "p");
  const double angle = std::atan2(place.x(), place.y());
  EXPECT_NEAR(limits[0].load_factor, load(angle), 1e-10);
  EXPECT_NEAR(limits[0].load_factor, 0.2211382215, 1e-9);
  for (const double beside : {-0.01, 0.01}) EXPECT_LT(load(angle + beside), limits[0].load_factor);
}

// Tensions over each node by the turns of its two bars; over equal kinks and in the whole they have a closed form.
TEST(CurvedScenes, Rope) {
  constexpr double kMu = 0.3;
  constexpr int kNodes = 8;
  const TracedPath path = TraceProved(ReadExample("rope"));
  std::vector<std::string> names = {"held"};
  for (int i = 1; i <= kNodes; ++i) names.push_back("n" + std::to_string(i));
  names.push_back("pulled");
  std::vector<int> slipping;  // nodes that slip back, by increment of the second stage
  for (const Increment& increment : path.increments) {
    std::vector<Eigen::Vector2d> directions;
    std::vector<double> tensions;
    for (std::size_t i = 0; i + 1 < names.size(); ++i) {
      const auto span = [&](const Increment& at) {
        return Eigen::Vector2d(Place(path, at, names[i + 1]) - Place(path, at, names[i]));
      };
      const Eigen::Vector2d bar = span(increment);
      directions.push_back(bar.normalized());
      tensions.push_back((i == 0 ? 20.0 : 1000.0) * (bar.norm() / span(path.increments[0]).norm() - 1.0));
    }
    double ratio = 1.0;
    int forth = 0, back = 0;
    for (std::size_t i = 1; i <= kNodes; ++i) {
      const ContactState state = Contact(path, increment, names[i] + "@drum").state;
      const double mu = state == ContactState::kSlipPlus ? kMu : -kMu;
      forth += state == ContactState::kSlipPlus ? 1 : 0;
      back += state == ContactState::kSlipMinus ? 1 : 0;
      const Eigen::Vector2d n = Place(path, increment, names[i]).normalized(), t = TangentOf(n);
      const Eigen::Vector2d &before = directions[i - 1], &after = directions[i];
      // Of the pressure that both bars exert.
      const double step = (before.dot(t) + mu * before.dot(n)) / (after.dot(t) + mu * after.dot(n));
      if (state != ContactState::kStick && tensions[0] > 0.0) {
        EXPECT_NEAR(tensions[i] / tensions[i - 1], step, 1e-6) << increment.index << names[i];
      }
      ratio *= step;
    }
    if (forth == kNodes || back == kNodes) {
      // The kinks at both ends are not quite the others.
      const double tangent = kMu * std::tan(0.5 * M_PI / kNodes);
      const double closed = std::pow((1.0 + tangent) / (1.0 - tangent), kNodes);
      EXPECT_NEAR(std::log(ratio) / std::log(closed), forth == kNodes ? 1.0 : -1.0, 0.04);
    }
    if (increment.stage == 2) slipping.push_back(back);
  }
  EXPECT_TRUE(std::is_sorted(slipping.begin(), slipping.end()));
  EXPECT_EQ(slipping.front(), 0);
  EXPECT_EQ(slipping.back(), kNodes);
}

TEST(CurvedScenes, Cam) {
  constexpr double kMu = 0.2, kSpring = 0.2, kHeight = 0.3;
  const TraceRequest request = ReadExample("cam");
  const TracedPath path = TraceProved(request);
  const auto surface = MakeSurface(request.scene.obstacles[0]);
  std::vector<double> sticking;  // where
  for (const Increment& increment : path.increments) {
    const Eigen::Vector2d block = Place(path, increment, "block");
    const Eigen::Vector2d normal = surface->ProjectOnNearest(block).normal;
    const double slope = -normal.x() / normal.y();
    const double pull = kSpring * (PositionX(path, increment, "hand") - block.x());
    EXPECT_NEAR(slope, kHeight * std::cos(block.x()), 2e-3);
    const ContactState state = increment.contacts[0].state;
    if (state == ContactState::kSlipPlus) {
      EXPECT_NEAR(pull, (slope + kMu) / (1.0 - kMu * slope), 1e-9);
    } else if (increment.kind == IncrementKind::kStart) {
      continue;  // the state is of what was before
    } else if (state == ContactState::kSlipMinus) {
      EXPECT_NEAR(pull, (slope - kMu) / (1.0 + kMu * slope), 1e-9);
    } else if (sticking.empty() || std::abs(sticking.back() - block.x()) > 1e-9) {
      sticking.push_back(block.x());
    }
  }
  EXPECT_EQ(sticking.size(), 2u);  // before it slips forth, and where the hand turns round
  EXPECT_EQ(IncrementsOfKind(path, IncrementKind::kSmoothLimit).size(), 6u);
}

// Beam columns: EI w'''' + F w'' = 0. The lift of the tip of a cantilever, L = 1 and EI = 1, under the force P across,
// F towards its root (F < 0: away from it) and the moment -F arm.
double Lift(double P, double F, double arm) {
  const double k = std::sqrt(std::abs(F)), moment = -F * arm;
  if (F > 0.0) return (P * (std::tan(k) / k - 1.0) + moment * (1.0 / std::cos(k) - 1.0)) / F;
  return (P * (std::tanh(k) / k - 1.0) + moment * (1.0 / std::cosh(k) - 1.0)) / F;
}

TEST(CurvedScenes, SnapHook) {
  constexpr double kMu = 0.3, kSpring = 5.0, kArm = 0.1;
  const TracedPath path = TraceProved(ReadExample("snap_hook"));
  double in = 0.0, out = 0.0;
  for (const Increment& increment : path.increments) {
    const double F = -kSpring * PositionX(path, increment, "root");
    in = std::max(in, F);
    out = std::min(out, F);
    const ContactRecord& contact = increment.contacts[0];
    const double y = PositionY(path, increment, "nose") + kArm;
    if (increment.kind == IncrementKind::kStart || y < 0.002 || std::abs(F) < 1e-4) continue;
    ASSERT_TRUE(contact.state == ContactState::kSlipPlus || contact.state == ContactState::kSlipMinus);
    const double P = std::sqrt(contact.rn * contact.rn + contact.rt * contact.rt - F * F);
    // Forces are those of the beam, to the square of its slope.
    const double ratio = F / P;
    const double by_hand = Bisect([&](double p) { return Lift(p, ratio * p, kArm) - y; }, 1e-4, 0.4);
    EXPECT_NEAR(P / by_hand, 1.0, 0.013) << increment.index;
    // Where the edges of the die are straight: with mu against the motion.
    for (const double degrees : {25.0, -60.0}) {
      const double slope = std::tan(degrees * M_PI / 180.0);
      const double mu = contact.state == ContactState::kSlipPlus ? kMu : -kMu;
      const double closed = (mu + slope) / (1.0 - mu * slope);
      const bool on_edge = degrees > 0.0 ? increment.stage == 1 && in <= 0.11110 && y < 0.0381 : y < 0.0299 && F < 0.0;
      if (on_edge) {
        EXPECT_NEAR(ratio, closed, 1e-6) << increment.index;
      }
    }
  }
  EXPECT_NEAR(in, 0.1111, 1e-4);
  EXPECT_NEAR(out, -0.2550, 1e-4);
  EXPECT_GT(IncrementsOfKind(path, IncrementKind::kCornerLimit).size(), 3u);
}

// The disc is held most by the tip, which slips off at a limit point.
TEST(CurvedScenes, FinRay) {
  const TracedPath path = TraceProved(ReadExample("fin_ray"));
  ExpectNear(LoadsOfKind(path, IncrementKind::kSmoothLimit), {1.7323}, 1e-4);
  const Obstacle& disc = path.request.scene.obstacles[0];
  double most = 0.0;
  for (const Increment& increment : path.increments) {
    if (increment.stage != 2 || increment.kind == IncrementKind::kStart) continue;
    const Eigen::Vector2d centre(disc.px, disc.py + increment.load_factor);
    double pull = 0.0;  // of the disc on the finger, along y
    for (std::size_t i = 0; i < increment.contacts.size(); ++i) {
      const ContactRecord& contact = increment.contacts[i];
      if (contact.state == ContactState::kOpen) continue;
      EXPECT_EQ(contact.state, ContactState::kSlipMinus);
      const Eigen::Vector2d n = (Place(path, increment, path.request.scene.contacts[i].node) - centre).normalized();
      pull += contact.rn * n.y() + contact.rt * TangentOf(n).y();
    }
    most = std::max(most, pull);
  }
  EXPECT_NEAR(most, 2.929, 2e-3);
}

// The lower right corner of the peg, at (0.48, -1.5) from the end of the wrist, of length 2 and EI = 1: what a force at
// the distance h below that end moves its point aside, along x and y.
constexpr double kHalfWidth = 0.48, kWrist = 2.0;
double AsideByX(double h) { return kWrist * kWrist * kWrist / 3.0 + kWrist * kWrist * h + kWrist * h * h; }
double AsideByY(double h) { return kHalfWidth * (0.5 * kWrist * kWrist + kWrist * h); }

TEST(CurvedScenes, PegInHole) {
  constexpr double kMu = 0.15, kMiss = 0.1, kHeight = 1.5, kSpacing = 0.1;
  const TracedPath path = TraceProved(ReadExample("peg_in_hole"));
  int on_the_wall = 0;
  for (const Increment& increment : path.increments) {
    std::vector<std::size_t> pressed;
    for (std::size_t i = 0; i < increment.contacts.size(); ++i)
      if (increment.contacts[i].rn > 1e-6) pressed.push_back(i);
    if (pressed.size() != 1) continue;
    const ContactCandidate& contact = path.request.scene.contacts[pressed[0]];
    if (contact.obstacle != "right_wall" || PositionY(path, increment, contact.node) > -0.2) continue;
    ++on_the_wall;
    const std::size_t slash = contact.node.find('/');
    const double h = kHeight - (slash == std::string::npos ? 0 : std::stoi(contact.node.substr(slash + 1))) * kSpacing;
    const double by_hand = kMiss / (AsideByX(h) - kMu * AsideByY(h));
    EXPECT_NEAR(increment.contacts[pressed[0]].rn / by_hand, 1.0, 0.03) << increment.index;
  }
  EXPECT_GT(on_the_wall, 20);
  const Increment& last = path.increments.back();
  EXPECT_GT(Contact(path, last, "left@left_wall").rn, 0.01);
  EXPECT_GT(Contact(path, last, "right_side/10@right_wall").rn, 0.01);
}

// The corner sticks on the fillet where friction holds a force that does not move it aside.
TEST(CurvedScenes, PegInHoleWedgesWithMoreFriction) {
  const double share = AsideByY(1.5) / AsideByX(1.5);
  const double limit = std::tan(M_PI / 6.0 - std::atan(share));
  EXPECT_NEAR(limit, 0.357, 1e-3);
  for (const double mu : {0.98 * limit, 1.02 * limit}) {
    TraceRequest request = ReadExample("peg_in_hole");
    for (Obstacle& obstacle : request.scene.obstacles) obstacle.friction = mu;
    request.options.stop[0].value = 0.08;  // just beyond the touch
    const TracedPath path = TraceProved(request);
    const ContactState state = Contact(path, path.increments.back(), "right@right_wall").state;
    EXPECT_EQ(state, mu < limit ? ContactState::kSlipMinus : ContactState::kStick) << mu;
  }
}

TEST(CurvedScenes, OtherStepsLeadToTheSameEvents) {
  for (const char* name : {"peg", "rope", "cam", "snap_hook", "fin_ray", "peg_in_hole"}) {
    SCOPED_TRACE(name);
    TraceRequest request = ReadExample(name);
    request.options.max_increments = 10000;
    const TracedPath path = TraceProved(request);
    const std::vector<const Increment*> events = EventsOf(path);
    for (const Accuracy accuracy : {Accuracy::kFast, Accuracy::kAccurate}) {
      request.options.accuracy = accuracy;
      const TracedPath other = TraceProved(request);
      ExpectSameEvents(path, other, kSame);
      const std::vector<const Increment*> others = EventsOf(other);
      ASSERT_EQ(others.size(), events.size());
      for (std::size_t i = 0; i < events.size(); ++i) EXPECT_LE(LargestDifference(*events[i], *others[i]), kSame) << i;
    }
  }
}

// Nodes on bars of their own are pressed onto the joints of a straight floor, and then pressed more or less in turn: on
// which side of its joint a node stands decides nothing.
TEST(JointsOfAFloor, BearManyNodes) {
  for (const int count : {6, 12, 13, 14}) {
    SCOPED_TRACE(count);
    TraceRequest request;
    Obstacle floor{"floor", ObstacleShape::kPolyline};
    for (int i = 0; i < count + 2; ++i) floor.points.insert(floor.points.end(), {static_cast<double>(i), 0.0});
    request.scene.obstacles = {floor};
    request.program.resize(2);
    request.program[1].target = 2.0;
    for (int i = 0; i < count; ++i) {
      const std::string foot = "foot" + std::to_string(i), top = "top" + std::to_string(i);
      request.scene.nodes.push_back({foot, i + 1.0, 0.0, true});
      request.scene.nodes.push_back({top, i + 1.0, 1.0, true, true});
      request.scene.bars.push_back({{foot, top}, 1.0 + 0.1 * i});
      request.scene.contacts.push_back({foot, "floor"});
      request.program[0].loads.push_back({foot, 0.0, -1.0});
      request.program[1].loads.push_back({foot, 0.0, i % 2 == 0 ? 0.5 : -0.5});
    }
    const TracedPath path = TraceProved(request);
    for (int i = 0; i < count; ++i)
      EXPECT_NEAR(path.increments.back().contacts[static_cast<std::size_t>(i)].rn, i % 2 == 0 ? 0.0 : 2.0, 1e-14) << i;
  }
}

}  // namespace
}  // namespace contact_path::curved_scenes_test
