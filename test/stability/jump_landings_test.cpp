// Where jumps land: by closed forms, and by another motion against drag.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "contact_path/path/end.h"
#include "contact_path/path/model.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/program.h"
#include "contact_path/stability/jump.h"
#include "support/beams.h"
#include "support/traced_path.h"

namespace contact_path::jump_landings_test {
namespace {

constexpr double kRigid = std::numeric_limits<double>::infinity();

TraceRequest Jumping(double stiffness, int increments) {
  TraceRequest request;
  request.options.at_limit = AtLimit::kJump;
  request.options.machine_stiffness = stiffness;
  request.options.max_increments = increments;
  return request;
}

// Clamped, of two arcs of a circle over a span of 2, pressed at the crown.
TraceRequest Arch(double rise, int segments, double stiffness) {
  TraceRequest request = Jumping(stiffness, 400);
  Scene& scene = request.scene;
  scene.name = "arch";
  scene.nodes = {{"l", -1.0, 0.0, true, true}, {"c", 0.0, rise}, {"r", 1.0, 0.0, true, true}};
  scene.nodes.front().fixed_rotation = scene.nodes.back().fixed_rotation = true;
  scene.beams = {Between("u", "l", "c", 1e4, 1.0, segments / 2), Between("v", "c", "r", 1e4, 1.0, segments / 2)};
  for (Beam& beam : scene.beams) beam.angle = -2.0 * std::atan(rise);
  scene.loads = {{"c", 0.0, -1.0}};
  request.options.stop = {{"c.y", "<", -rise}};
  return request;
}

// A half cosine of the rise 0.02 over a span of 1, guided and moved down in the middle: 16 segments of the thickness
// 0.02 / 6, whose left half is stiffer in bending.
TraceRequest CurvedBeam(double imperfection) {
  TraceRequest request = Jumping(0.0, 400);
  Scene& scene = request.scene;
  scene.name = "curved_beam";
  for (int i = 0; i <= 16; ++i) {
    Node node{"n" + std::to_string(i), i / 16.0, 0.01 * (1.0 - std::cos(M_PI * i / 8.0)), false, false};
    if (i % 8 == 0) node.fixed_x = node.fixed_y = node.fixed_rotation = true;
    scene.nodes.push_back(node);
    if (i > 0)
      scene.beams.push_back(Between("e" + std::to_string(i), "n" + std::to_string(i - 1), node.name, 1.08e6,
                                    i <= 8 ? 1.0 + imperfection : 1.0, 1));
  }
  Stage push;
  push.name = "push";
  push.support_motions = {{"n8", 0.0, -1.0}};
  push.target = 0.04;
  request.program = {push};
  return request;
}

// Where u' = -(phi(u) - s f), s = s_0 - k f . (u - u_0), comes to rest, by linearly implicit Euler steps with a dense
// matrix, from a disturbance along the softest motion with this sign.
Eigen::VectorXd RestOf(const Structure& structure, const PathPoint& from, double stiffness, double sign) {
  const Eigen::Index n = structure.NumDofs(), supports = static_cast<Eigen::Index>(structure.PrescribedDofs().size());
  const bool rigid = std::isinf(stiffness);
  const Eigen::VectorXd f = rigid || supports > 0 ? Eigen::VectorXd::Zero(n).eval() : structure.Loads().Reference();
  Eigen::MatrixXd held = Eigen::MatrixXd::Zero(n, supports + (rigid ? 1 : 0));
  for (Eigen::Index i = 0; i < supports; ++i)
    held(structure.PrescribedDofs()[static_cast<std::size_t>(i)].dof, i) = 1.0;
  if (rigid) held.col(supports) = structure.Loads().Reference();
  const Eigen::MatrixXd all = held.householderQr().householderQ() * Eigen::MatrixXd::Identity(n, n);
  const Eigen::MatrixXd free =
      held.cols() == 0 ? Eigen::MatrixXd::Identity(n, n) : Eigen::MatrixXd(all.rightCols(n - held.cols()));
  Eigen::SparseMatrix<double> tangent = structure.TangentPattern();
  const double k = rigid ? 0.0 : stiffness;
  const auto stiffness_at = [&](const Eigen::VectorXd& u) {
    structure.Tangent(u, &tangent);
    return Eigen::MatrixXd(free.transpose() * (Eigen::MatrixXd(tangent) + k * f * f.transpose()) * free);
  };
  const Eigen::VectorXd softest =
      free * Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(stiffness_at(from.u)).eigenvectors().col(0);
  Eigen::VectorXd u = from.u + sign * 1e-5 * softest / softest.lpNorm<Eigen::Infinity>(), force(n);
  double time = 1e-3, speed = kRigid;
  for (int i = 0; i < 4000; ++i) {
    structure.InternalForce(u, force);
    const Eigen::VectorXd pull = free.transpose() * ((from.s - k * structure.Loads().Reference().dot(u - from.u)) *
                                                         structure.Loads().Reference() +
                                                     structure.Loads().Constant() - force);
    Eigen::MatrixXd matrix = stiffness_at(u);
    matrix.diagonal().array() += 1.0 / time;
    const Eigen::LDLT<Eigen::MatrixXd> factors(matrix);
    const Eigen::VectorXd du = free * factors.solve(pull);
    const double length = du.lpNorm<Eigen::Infinity>(), now = du.norm() / time;
    const bool grows = length > 1e-9 && now > 1.25 * speed;
    if (!factors.isPositive() || length > 4e-3 || grows) {
      time *= 0.5;
      continue;
    }
    u += du;
    if (time > 1e9 && length < 1e-11) return u;
    speed = now;
    time *= length < 2e-3 ? 1.5 : 1.0;
  }
  return {};
}

// How many jumps of the path there are; each lands where the other motion rests, on one side or the other.
int ExpectSameLandings(const TraceRequest& request) {
  const TracedPath path = TraceIncrements(request);
  EXPECT_NE(path.result.reason, EndReason::kNoLanding) << path.result.message;
  const ExpandedRequest expanded(request);
  const Model model(StageScene(expanded.Get(), 0), StageConfiguration(expanded.Get(), 0),
                    StageScales(expanded.Get(), 0));
  int jumps = 0;
  for (std::size_t i = 0; i + 1 < path.increments.size(); ++i) {
    if (path.increments[i + 1].kind != IncrementKind::kJump) continue;
    ++jumps;
    const PathPoint from = model.FromIncrement(path.increments[i]), to = model.FromIncrement(path.increments[i + 1]);
    double nearest = kRigid;
    for (const double sign : {1.0, -1.0}) {
      const Eigen::VectorXd rest = RestOf(
          model.structure, from, request.options.machine_stiffness / model.SizeOfLoads().unit_of_stiffness, sign);
      if (rest.size() > 0) nearest = std::min(nearest, (rest - to.u).lpNorm<Eigen::Infinity>());
    }
    EXPECT_LE(nearest, 1e-6) << request.scene.name << " " << path.increments[i].load_factor;
  }
  return jumps;
}

TEST(JumpLandings, OfPerfectArches) {
  int jumps = 0;
  for (const double rise : {0.15, 0.25})
    for (const int segments : {6, 10})
      for (const double stiffness : {0.0, 20.0, 200.0, kRigid})
        jumps += ExpectSameLandings(Arch(rise, segments, stiffness));
  EXPECT_EQ(jumps, 7);
}

TEST(JumpLandings, OfCurvedBeams) {
  int jumps = 0;
  for (const double imperfection : {0.001, 0.01, 0.1}) jumps += ExpectSameLandings(CurvedBeam(imperfection));
  EXPECT_EQ(jumps, 1);
}

// At a bifurcation the machine goes on along the curve that crosses, where a damped motion rests as well.
TEST(JumpLandings, ACurveThatCrossesNeedsNone) {
  TraceRequest request = Arch(0.2, 16, 200.0);
  request.options.at = {{"load_factor", {4.2304992622}}};
  const TracedPath path = TraceIncrements(request);
  const std::vector<Increment> crossed = IncrementsOfKind(path, IncrementKind::kBifurcation);
  ASSERT_FALSE(crossed.empty());
  EXPECT_NEAR(crossed[0].load_factor, 4.2305418, 1e-6);
  const auto sample = std::find_if(path.increments.begin() + crossed[0].index, path.increments.end(),
                                   [](const auto& increment) { return increment.kind == IncrementKind::kSample; });
  ASSERT_NE(sample, path.increments.end());
  EXPECT_NEAR(std::abs(PositionX(path, *sample, "c")), 3.7538e-5, 1e-9);
}

TEST(JumpLandings, AreStableWhereAllOfEqualPartsBuckle) {
  for (int columns = 1; columns <= 8; ++columns) {
    TraceRequest request = Jumping(0.0, 1500);
    Scene& scene = request.scene;
    scene.name = "columns";
    for (int i = 0; i < columns; ++i) {
      const std::string foot = "b" + std::to_string(i), top = "t" + std::to_string(i);
      scene.nodes.push_back({foot, 1.0 * i, 0.0, true, true});
      scene.nodes.back().fixed_rotation = true;
      scene.nodes.push_back({top, 1.0 * i, 1.0});
      scene.beams.push_back(Between("c" + std::to_string(i), foot, top, 1e4, 1.0, 6));
      scene.loads.push_back({top, 0.0, -1.0});
    }
    request.options.stop = {{"load_factor", ">", 3.0}};
    const TracedPath path = TraceIncrements(request);
    EXPECT_EQ(path.result.reason, EndReason::kStopCriterion) << columns << " " << path.result.message;
    const std::vector<Increment> buckled = IncrementsOfKind(path, IncrementKind::kBifurcation);
    ASSERT_FALSE(buckled.empty()) << columns;
    for (auto increment = path.increments.begin() + buckled[0].index + 1; increment != path.increments.end();
         ++increment)
      EXPECT_EQ(increment->stability.stability, Verdict::kStable) << columns << " " << increment->index;
  }
}

// Of equal trusses on top of each other one snaps, and then the others still are at their limit point: they do, too.
TEST(JumpLandings, MoveOnFromALimitPointOfTheRest) {
  for (const int units : {1, 2, 3}) {
    Scene scene;
    scene.name = "stack";
    scene.nodes = {{"n0", 0.0, 0.0, true, true}};
    for (int i = 1; i <= units; ++i) {
      const std::string below = "n" + std::to_string(i - 1), top = "n" + std::to_string(i);
      scene.nodes.push_back({top, 0.0, 0.5 * i, true, false});
      for (const double side : {-1.0, 1.0}) {
        const std::string arm = (side < 0.0 ? "l" : "r") + std::to_string(i);
        scene.nodes.push_back({arm, side, 0.5 * (i - 1)});
        scene.bars.push_back({{arm, top}, 1.0});
        const double k = 5.0;
        scene.superelements.push_back({{below, arm}, {k, 0, -k, 0, 0, k, 0, -k, -k, 0, k, 0, 0, -k, 0, k}});
      }
    }
    TraceRequest request = Jumping(0.0, 900);
    request.scene = scene;
    request.scene.loads = {{"n" + std::to_string(units), 0.0, -1.0, false}};
    request.options.stop = {{"load_factor", ">", 0.2}};
    const TracedPath path = TraceIncrements(request);
    const std::vector<Increment> jumps = IncrementsOfKind(path, IncrementKind::kJump);
    ASSERT_FALSE(jumps.empty()) << units << " " << path.result.message;
    EXPECT_EQ(jumps.back().stability.stability, Verdict::kStable) << units;
    for (int i = 1; i <= units; ++i)
      EXPECT_LT(PositionY(path, jumps.back(), "n" + std::to_string(i)),
                i == 1 ? 0.0 : PositionY(path, jumps.back(), "n" + std::to_string(i - 1)))
          << units << " " << i;
  }
}

// A truss on its side snaps onto a rough plane and slides along it: where its apex is tells with what it presses.
TEST(JumpLandings, FrictionOfASlideBehindTheClosingOfAContact) {
  for (const double friction : {0.1, 0.3}) {
    Scene scene;
    scene.name = "truss_onto_plane";
    scene.nodes = {{"up", 0.0, 1.0, true, true}, {"apex", 1.2, 0.0}, {"down", 0.0, -1.0, true, true}};
    scene.bars = {{{"up", "apex"}, 1.0, 0.0, StrainMeasure::kGreenLagrange},
                  {{"apex", "down"}, 1.0, 0.0, StrainMeasure::kGreenLagrange}};
    scene.loads = {{"apex", -1.0, 0.0}};
    scene.obstacles = {{"plane", ObstacleShape::kHalfPlane, -0.5, 0.0, 0.6, 0.8, friction}};
    scene.contacts = {{"apex", "plane"}};
    const Model model(scene, CharacteristicScales(scene));
    const double c = std::pow(1.0 + 1.44, -1.5), y = 1.2 / std::sqrt(3.0);
    PathPoint from = model.InitialPoint();
    from.u = Eigen::Vector2d(y, 0.0) / model.scaling.length;
    from.s = 2.0 * c * 1.728 / (3.0 * std::sqrt(3.0)) / model.scaling.load_factor;
    const JumpResult jump = Jump(model.structure, model.laws, from, Eigen::Vector2d(-1.0, 0.0), {}, false, nullptr);
    ASSERT_TRUE(jump.landing);
    const Eigen::Vector2d touches = Eigen::Vector2d(-0.5, 0.0) / model.scaling.length,
                          way = jump.landing->point.u - touches;
    ASSERT_GT(way.norm() * model.scaling.length, 0.05);
    double mean = 0.0;
    constexpr int kPoints = 2000;
    for (int i = 0; i < kPoints; ++i) {
      Eigen::VectorXd force(2);
      model.structure.InternalForce(touches + (i + 0.5) / kPoints * way, force);
      mean += (force - from.s * model.structure.Loads().Reference()).dot(Eigen::Vector2d(0.6, 0.8)) / kPoints;
    }
    const double exact = friction * mean * way.norm();
    EXPECT_NEAR(jump.landing->dissipated, exact, 1e-6 * exact) << friction;
  }
}

}  // namespace
}  // namespace contact_path::jump_landings_test
