// Paths on rigid curves against closed forms: a node dragged round a peg, a rope over a drum, a block over a
// sine-shaped floor, a drum that turns, the end of a table.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

#include "contact_path/scene/surface.h"
#include "support/curved_obstacles.h"
#include "support/parts.h"
#include "support/traced_path.h"

namespace contact_path::curved_paths_test {
namespace {

constexpr double kSound = 1e-9;  // residuals, of the characteristic force
constexpr double kExact = 1e-9;  // closed forms

Obstacle Through(ObstacleShape shape, const std::vector<double>& points, double friction) {
  Obstacle curve = CurveThrough(shape, points);
  curve.friction = friction;
  return curve;
}

TracedPath TraceSound(const TraceRequest& request) {
  TracedPath path = TraceTo(request);
  ExpectSoundIncrements(path, kSound);
  return path;
}

// ----- a node on two springs, dragged round a disc -----

constexpr double kFriction = 0.3;

TraceRequest Peg() {
  Scene scene;
  scene.nodes = {{"p", std::sin(-0.2), std::cos(-0.2), false, false}};
  scene.superelements = {{{"p"}, {1.3, 0.0, 0.0, 0.8}, {0.2, -0.3}}};
  scene.loads = {{"p", 1.0, -0.2, false}};
  scene.obstacles = {Circle("peg", 0.0, 0.0, 1.0, kFriction)};
  scene.contacts = {{"p", "peg"}};
  return RequestUntil({"p.y", "<", -0.1}, scene);
}

// Equilibrium of a node that slides towards +t at the angle a from the top: load factor and normal reaction.
struct OnThePeg {
  double s, rn;
};
OnThePeg SlidingAt(double angle) {
  const double nx = std::sin(angle), ny = std::cos(angle), fx = 1.0, fy = -0.2;
  const double cx = nx - kFriction * ny, cy = ny + kFriction * nx;  // n - mu t
  const double ex = 1.3 * (nx - 0.2), ey = 0.8 * (ny + 0.3);
  const double determinant = fx * cy - fy * cx;
  return {(ex * cy - ey * cx) / determinant, (fx * ey - fy * ex) / determinant};
}

TEST(CurvedPaths, ANodeDraggedRoundAPegHasTheClosedForm) {
  for (const Accuracy accuracy : {Accuracy::kFast, Accuracy::kAccurate}) {
    TraceRequest request = Peg();
    request.options.accuracy = accuracy;
    const TracedPath path = TraceSound(request);
    int sliding = 0;
    for (const Increment& increment : path.increments) {
      const double x = increment.positions[0], y = increment.positions[1];
      EXPECT_NEAR(std::hypot(x, y), 1.0, kExact);
      if (increment.contacts[0].state != ContactState::kSlipPlus) continue;
      ++sliding;
      const OnThePeg closed = SlidingAt(std::atan2(x, y));
      EXPECT_NEAR(increment.load_factor, closed.s, kExact);
      EXPECT_NEAR(increment.contacts[0].rn, closed.rn, kExact);
      EXPECT_NEAR(increment.contacts[0].rt, -kFriction * closed.rn, kExact);
    }
    EXPECT_GT(sliding, 10);
    EXPECT_LE(EnergyImbalance(path), 1e-6);
  }
}

// Work of friction: the integral of mu r_n over the length of the way.
TEST(CurvedPaths, DissipationOnThePegIsTheIntegralOverTheWay) {
  TraceRequest request = Peg();
  request.options.accuracy = Accuracy::kAccurate;
  const TracedPath path = TraceIncrements(request);
  const Increment& first = FirstThat(
      path, [](const Increment& increment) { return increment.contacts[0].state == ContactState::kSlipPlus; });
  ASSERT_GT(first.index, 0);
  const Increment &from = path.increments[static_cast<std::size_t>(first.index) - 1], &to = path.increments.back();
  const double begin = std::atan2(from.positions[0], from.positions[1]);
  const double end = std::atan2(to.positions[0], to.positions[1]);
  constexpr int kParts = 2000;
  double sum = 0.0;  // Simpson
  for (int i = 0; i <= kParts; ++i)
    sum += (i == 0 || i == kParts ? 1.0 : i % 2 == 0 ? 2.0 : 4.0) * SlidingAt(begin + (end - begin) * i / kParts).rn;
  EXPECT_NEAR(to.dissipation - from.dissipation, kFriction * sum * (end - begin) / kParts / 3.0, 1e-7);
}

// ----- a rope over a drum -----

// Nodes on the upper half of a disc, equally far apart; beyond them a soft bar to a support on the left and a stiff one
// to a support on the right, which pulls. All kinks are equal at the start.
TraceRequest Rope(int nodes, double wrap) {
  Scene scene;
  const double kink = wrap / nodes;
  const auto place = [&](int i) {
    const double angle = kink * (i - 0.5 * (nodes - 1));
    return std::pair(std::sin(angle), std::cos(angle));
  };
  const auto name = [](int i) { return "n" + std::to_string(i); };
  for (int i = 0; i < nodes; ++i) scene.nodes.push_back({name(i), place(i).first, place(i).second, false, false});
  const auto [x, y] = place(nodes - 1);
  const double slope = 0.5 * wrap, length = 0.5;  // of the straight ends
  scene.nodes.push_back({"pulled", x + length * std::cos(slope), y - length * std::sin(slope), true, true});
  scene.nodes.push_back({"held", -x - length * std::cos(slope), y - length * std::sin(slope), true, true});
  for (int i = 0; i + 1 < nodes; ++i) scene.bars.push_back({{name(i), name(i + 1)}, 1e4, 0.0, StrainMeasure::kBiot});
  scene.bars.push_back({{name(nodes - 1), "pulled"}, 1e4, 0.0, StrainMeasure::kBiot});
  scene.bars.push_back({{"held", name(0)}, 20.0, 0.0, StrainMeasure::kBiot});
  scene.support_motions = {{"pulled", std::cos(slope), -std::sin(slope)}};
  scene.obstacles = {Circle("drum", 0.0, 0.0, 1.0, kFriction)};
  for (int i = 0; i < nodes; ++i) scene.contacts.push_back({name(i), "drum"});
  return RequestUntil({"load_factor", ">", 2e-4}, scene);
}

// Of a node that slides clockwise on a disc around the origin: the tension in the bar behind it times this is the one
// in the bar ahead.
double Gain(const Eigen::Vector2d& behind, const Eigen::Vector2d& node, const Eigen::Vector2d& ahead) {
  const Eigen::Vector2d n = node.normalized();
  const Eigen::Vector2d reaction = n - kFriction * TangentOf(n), across(-reaction.y(), reaction.x());
  return -across.dot((behind - node).normalized()) / across.dot((ahead - node).normalized());
}

TEST(CurvedPaths, ARopeOverADrumHasTheTensionsOfItsKinks) {
  for (const int nodes : {4, 8}) {
    const TracedPath path = TraceSound(Rope(nodes, M_PI));
    const Increment& last = path.increments.back();
    for (const ContactRecord& contact : last.contacts) EXPECT_EQ(contact.state, ContactState::kSlipPlus);
    const auto place = [&](const Increment& increment, const std::string& node) {
      return Eigen::Vector2d(PositionX(path, increment, node), PositionY(path, increment, node));
    };
    std::vector<Eigen::Vector2d> rope = {place(last, "held")};
    for (int i = 0; i < nodes; ++i) rope.push_back(place(last, "n" + std::to_string(i)));
    rope.push_back(place(last, "pulled"));
    double gain = 1.0;
    for (std::size_t i = 1; i + 1 < rope.size(); ++i) gain *= Gain(rope[i - 1], rope[i], rope[i + 1]);
    const auto tension = [&](const std::string& from, const std::string& to, double stiffness) {
      const auto length = [&](const Increment& at) { return (place(at, to) - place(at, from)).norm(); };
      return stiffness * (length(last) / length(path.increments.front()) - 1.0);
    };
    const double ratio = tension("n" + std::to_string(nodes - 1), "pulled", 1e4) / tension("held", "n0", 20.0);
    EXPECT_NEAR(ratio / gain, 1.0, 1e-7);
    // The rope has moved by what the soft bar has become longer, and its end kinks are no longer quite the others.
    const double tangent = kFriction * std::tan(0.5 * M_PI / nodes);
    EXPECT_NEAR(ratio / std::pow((1.0 + tangent) / (1.0 - tangent), nodes), 1.0, 1.5e-3);
  }
}

// ----- a block on a spring, dragged over a sine-shaped floor -----

TEST(CurvedPaths, ABlockOverASineShapedFloorHasTheClosedForm) {
  constexpr double kHeight = 0.1, kWeight = 1.0, kSpring = 4.0;
  const auto floor = [](double x) { return kHeight * std::sin(x); };
  std::vector<double> points;
  for (int i = -20; i <= 180; ++i) points.insert(points.end(), {0.1 * i, floor(0.1 * i)});
  TraceRequest request;
  Scene& scene = request.scene;
  scene.nodes = {{"block", 0.0, 0.0, false, false}, {"hand", 1.0, 0.0, true, true}};
  scene.superelements = {{{"block", "hand"},
                          {kSpring, 0.0, -kSpring, 0.0, 0.0, 0.0, 0.0, 0.0,  //
                           -kSpring, 0.0, kSpring, 0.0, 0.0, 0.0, 0.0, 0.0}}};
  scene.loads = {{"block", 0.0, -kWeight, true}};
  scene.support_motions = {{"hand", 1.0, 0.0}};
  scene.obstacles = {Through(ObstacleShape::kSpline, points, kFriction)};
  scene.contacts = {{"block", "curve"}};
  request.options.stop = {{"block.x", ">", 13.0}};
  request.options.max_increments = 5000;
  const TracedPath path = TraceSound(request);
  int sliding = 0;
  for (const Increment& increment : path.increments) {
    if (increment.contacts[0].state != ContactState::kSlipPlus) continue;
    ++sliding;
    const double x = PositionX(path, increment, "block"), hand = PositionX(path, increment, "hand");
    EXPECT_NEAR(PositionY(path, increment, "block"), floor(x), 1e-6);
    const double slope = kHeight * std::cos(x);
    EXPECT_NEAR(kSpring * (hand - 1.0 - x), kWeight * (kFriction + slope) / (1.0 - kFriction * slope), 1e-4);
  }
  EXPECT_GT(sliding, 20);
}

// ----- a drum that turns -----

TEST(CurvedPaths, ATurningDrumTakesTheNodeAlongUntilItSlips) {
  TraceRequest request = Peg();
  Scene& scene = request.scene;
  scene.loads.clear();
  scene.nodes[0] = {"p", 0.0, 1.0, false, false};
  scene.superelements[0].rest_positions = {0.0, 0.2};
  scene.obstacle_motions = {{"peg", 0.0, 0.0, -0.5, 0.0, 0.0}};  // clockwise: the node goes to the right
  request.options.stop = {{"load_factor", ">", 40.0}};
  request.options.max_increments = 5000;
  const TracedPath path = TraceSound(request);
  const Increment* slips = nullptr;  // the first increment that does
  for (const Increment& increment : path.increments) {
    const double angle = std::atan2(increment.positions[0], increment.positions[1]);
    const double nx = std::sin(angle), ny = std::cos(angle), ex = 1.3 * nx, ey = 0.8 * (ny - 0.2);
    const ContactRecord& contact = increment.contacts[0];
    EXPECT_NEAR(contact.rn, ex * nx + ey * ny, kExact);
    EXPECT_NEAR(contact.rt, ex * ny - ey * nx, kExact);
    if (contact.state == ContactState::kStick) {
      EXPECT_NEAR(angle, 0.5 * increment.load_factor, kExact);
    }
    if (contact.state == ContactState::kSlipMinus) {
      if (slips == nullptr) slips = &increment;
      EXPECT_NEAR(contact.rt, kFriction * contact.rn, kExact);
    }
  }
  // Then it rests, and the drum turns on below it, for three rounds without an event.
  ASSERT_NE(slips, nullptr);
  EXPECT_EQ(IncrementsOfKind(path, IncrementKind::kContactEvent).size(), 1U);
  const Increment& last = path.increments.back();
  EXPECT_NEAR(last.dissipation - slips->dissipation,
              0.5 * kFriction * last.contacts[0].rn * (last.load_factor - slips->load_factor), kExact);
}

// After nine radians the next stage begins on the drum as it stands: the node is on other patches of it than before.
TEST(CurvedPaths, AStageBeginsOnADrumThatHasTurned) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.nodes = {{"p", 0.0, 1.0, false, false}};
  scene.superelements = {{{"p"}, {1.0, 0.0, 0.0, 1.0}, {0.0, 0.5}}};
  scene.obstacles = {Circle("drum", 0.0, 0.0, 1.0, 0.4)};
  scene.contacts = {{"p", "drum"}};
  request.program.resize(2);
  request.program[0].obstacle_motions = {{"drum", 0.0, 0.0, 9.0, 0.0, 0.0}};
  request.program[1].obstacle_motions = {{"drum", 0.2, -0.1, -0.5, 0.0, 0.0}};
  const TracedPath path = TraceTo(request);
  ExpectNoFindings(path);
  std::vector<std::vector<ContactState>> states(2);
  for (const Increment& increment : path.increments) {
    const ContactRecord& contact = increment.contacts[0];
    const Eigen::Vector2d centre = increment.stage == 1
                                       ? Eigen::Vector2d::Zero()
                                       : Eigen::Vector2d(increment.load_factor * Eigen::Vector2d(0.2, -0.1));
    const Eigen::Vector2d x(increment.positions[0], increment.positions[1]), elastic(x.x(), x.y() - 0.5);
    EXPECT_NEAR(contact.rn, elastic.dot((x - centre).normalized()), kExact);
    std::vector<ContactState>& so_far = states[static_cast<std::size_t>(increment.stage - 1)];
    if (so_far.empty() || so_far.back() != contact.state) so_far.push_back(contact.state);
  }
  using S = ContactState;
  EXPECT_EQ(states[0], (std::vector<S>{S::kStick, S::kSlipPlus}));
  EXPECT_EQ(states[1], (std::vector<S>{S::kSlipPlus, S::kStick, S::kSlipMinus}));
}

// ----- the end of an open curve -----

TEST(CurvedPaths, APressedNodeIsLostAtTheEndOfATable) {
  Scene scene;
  scene.nodes = {{"p", 0.0, 0.0, false, false}};
  scene.superelements = {{{"p"}, {1.0, 0.0, 0.0, 1.0}}};
  scene.loads = {{"p", 0.0, -1.0, true}, {"p", 1.0, 0.0, false}};
  scene.obstacles = {Through(ObstacleShape::kPolyline, {-1.0, 0.0, 0.7, 0.0}, 0.2)};
  scene.contacts = {{"p", "curve"}};
  const TracedPath path = TraceIncrements(RequestUntil({"p.x", ">", 2.0}, scene));
  ExpectEnd(path, EndReason::kPathEnd, "p@curve is lost");
  EXPECT_NEAR(path.increments.back().positions[0], 0.7, kExact);
  EXPECT_NEAR(path.increments.back().load_factor, 0.9, kExact);
}

// ----- bends -----

// Down over the edge of a step, the fillet of which is a patch of its own: no force jumps where patches meet.
TEST(CurvedPaths, NoForceJumpsWherePatchesMeet) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.nodes = {{"p", 0.0, 0.0, false, false}};
  scene.superelements = {{{"p"}, {1.3, 0.0, 0.0, 0.8}, {0.4, -0.9}}};
  scene.loads = {{"p", 1.0, -0.2, false}};
  scene.obstacles = {Through(ObstacleShape::kPolyline, {-1.0, 0.0, 1.0, 0.0, 2.0, -1.0}, 0.3)};
  scene.obstacles[0].fillet = 0.4;
  scene.contacts = {{"p", "curve"}};
  request.options.accuracy = Accuracy::kAccurate;
  request.options.stop = {{"p.x", ">", 1.6}};
  const TracedPath path = TraceSound(request);
  const auto surface = MakeSurface(scene.obstacles[0]);
  std::vector<int> met;
  for (const Increment& increment : path.increments) {
    const Eigen::Vector2d x(increment.positions[0], increment.positions[1]);
    const Projection at = surface->ProjectOnNearest(x);
    for (const int patch : {0, 1})
      if (std::abs(at.xi - surface->RangeOf(patch).end) < kExact) met.push_back(patch);
    if (increment.contacts[0].state != ContactState::kSlipPlus) continue;
    const Eigen::Vector2d t = TangentOf(at.normal), elastic(1.3 * (x.x() - 0.4), 0.8 * (x.y() + 0.9));
    const Eigen::Vector2d force = elastic - increment.load_factor * Eigen::Vector2d(1.0, -0.2);
    EXPECT_NEAR(increment.contacts[0].rn, force.dot(at.normal), kExact);
    EXPECT_NEAR(increment.contacts[0].rt, force.dot(t), kExact);
  }
  EXPECT_EQ(met, (std::vector<int>{0, 1}));
}

}  // namespace
}  // namespace contact_path::curved_paths_test
