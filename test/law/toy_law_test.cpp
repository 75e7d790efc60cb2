// A law that nothing in the package has: no, two and three multipliers, a memory of two numbers, and curves of pieces
// without end. What it does follows in closed form.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "contact_path/branch/branches.h"
#include "contact_path/branch/event_functions.h"
#include "contact_path/branch/mode_arc.h"
#include "contact_path/law/law.h"
#include "support/derivative_checker.h"
#include "support/random.h"
#include "support/system_derivatives.h"

namespace contact_path::toy_law_test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;
using Eigen::VectorXd;

constexpr double kRatio = 0.4, kBend = 0.05, kExact = 1e-12;

// Of x, y (unknowns 0 and 1) and z (unknown 2). Ports: y; a coordinate along x, whose curvature is another one on each
// piece [k, k + 1]; z. It presses on y, holds z where it is, and lets x slide towards + where the force along x is -0.4
// of the pressure.
class ToyLaw : public Law {
 public:
  enum State { kHeld, kSlides, kAway };
  enum Id { kPresses, kEdge, kGoesOn, kBegin, kEnd, kGap };

  ToyLaw() {
    Traits traits;
    traits.num_ports = 3;
    traits.dofs = {0, 1, 2};
    traits.curved = true;
    traits.largest_ratio = kRatio;
    traits.moves[0][1] = traits.moves[1][0] = traits.moves[2][2] = true;
    const auto forces = [](Id id, const PortReals& weights, State next) {
      LimitRule rule;
      rule.id = id;
      rule.of = LimitRule::Of::kForces;
      rule.weights = weights;
      rule.next = next;
      return rule;
    };
    const auto motion = [](Id id, LimitRule::Of of, std::size_t port, double sign, State next) {
      LimitRule rule;
      rule.id = id;
      rule.of = of;
      rule.port = port;
      rule.sign = sign;
      rule.next = next;
      return rule;
    };
    const PortRule held = {PortRule::Kind::kHeld, 0.0, 0.0}, follows = {PortRule::Kind::kFollows, -kRatio, 0.0};
    std::vector<StateRule> states(3);
    states[kHeld].ports = {held, held, held};
    states[kHeld].limits = {forces(kPresses, {1.0}, kAway), forces(kEdge, {kRatio, 1.0}, kSlides)};
    states[kSlides].ports = {held, follows, held};
    states[kSlides].limits = {
        forces(kPresses, {1.0}, kAway), motion(kGoesOn, LimitRule::Of::kMotionRate, 1, 1.0, kHeld),
        motion(kBegin, LimitRule::Of::kPiece, 1, 1.0, kSlides), motion(kEnd, LimitRule::Of::kPiece, 1, -1.0, kSlides)};
    states[kSlides].symmetric = false;
    states[kAway].limits = {motion(kGap, LimitRule::Of::kMotion, 0, 1.0, kHeld)};
    states[kAway].held = kAway;
    SetLaw(traits, std::move(states));
  }

  // xi = x + a (x - k)^2 (k + 1 - x)^2, a = 0.05 or -0.05 where k is even or odd: xi = x, xi' = 1 at both ends.
  static double Xi(double x, int k, int derivative) {
    const double a = k % 2 == 0 ? kBend : -kBend, p = (x - k) * (k + 1 - x), dp = 2 * k + 1 - 2.0 * x;
    if (derivative == 0) return x + a * p * p;
    if (derivative == 1) return 1.0 + 2.0 * a * p * dp;
    if (derivative == 2) return 2.0 * a * (dp * dp - 2.0 * p);
    return -12.0 * a * dp;
  }

  void Evaluate(const VectorXd& u, double /*s*/, int k, const PortReals& reference, PortsAt* ports) const override {
    ports->dofs = OwnDofs();
    for (std::size_t p = 0; p < 3; ++p) {
      PortAt& port = (*ports)[p];
      const Eigen::Index of = p == 0 ? 1 : p == 1 ? 0 : 2;
      port.motion = (p == 1 ? Xi(u[0], k, 0) : u[of]) - reference[p];
      port.gradient = (p == 1 ? Xi(u[0], k, 1) : 1.0) * LawVector::Unit(4, of);
      port.hessian = LawMatrix::Zero(4, 4);
    }
    (*ports)[1].hessian(0, 0) = Xi(u[0], k, 2);
  }
  void ForceHessian(const VectorXd& u, double /*s*/, int k, const PortReals& forces, const LawVector& weights,
                    LawMatrix* hessian) const override {
    *hessian = LawMatrix::Zero(4, 4);
    (*hessian)(0, 0) = forces[1] * weights[0] * Xi(u[0], k, 3);
  }
  PortReals ReferenceAt(const VectorXd& u, double /*s*/, int k) const override { return {0.0, Xi(u[0], k, 0), u[2]}; }
  double Reach(const VectorXd& u, double /*s*/) const override { return u[1]; }
  Modes ModesAt(const VectorXd& u, double /*s*/, const Mode& now, const PortReals& forces,
                const ActiveSetTolerance& tolerance) const override {
    if (u[1] > tolerance.motion) return {{kAway, now.piece}};
    int ahead = now.piece;
    if (u[0] > now.piece + 1 - tolerance.motion) ++ahead;
    Modes modes = {{kHeld, now.piece}};
    if (kRatio * forces[0] + forces[1] <= tolerance.force) modes.push_back({kSlides, ahead});
    if (forces[0] <= tolerance.force) modes.push_back({kAway, now.piece});
    if (now.state == kSlides && modes.size() > 1) std::swap(modes[0], modes[1]);
    return modes;
  }
  double BoundOf(const Mode& mode, int id) const override { return id == kBegin ? mode.piece : mode.piece + 1; }
  Mode Next(const Mode& mode, int id) const override {
    return {Law::Next(mode, id).state, mode.piece + (id == kEnd ? 1 : id == kBegin ? -1 : 0)};
  }
  bool ChangesPiece(int from, int to) const override { return from != to; }
  std::vector<Ray> Rays(const VectorXd&, double, int, const ActiveSetTolerance&) const override { return {}; }
  Mode Initial(const VectorXd& u, double /*s*/) const override {
    return {u[1] > 0.0 ? kAway : kHeld, static_cast<int>(std::floor(u[0]))};
  }
  Mode InState(const VectorXd& u, double /*s*/, int state) const override {
    return {state, static_cast<int>(std::floor(u[0]))};
  }
};

// Springs of 1 hold (x, y, z) to (0, 0, 0.3); y is pressed with 1, the load s is along x.
class ToyLawOnSprings : public testing::Test {
 protected:
  ToyLawOnSprings() : structure_(MakeScene()) { laws_.Add(&law_); }
  static Scene MakeScene() {
    Scene scene;
    scene.nodes = {{"p", 0.0, 0.0}, {"q", 0.3, 0.0, false, true}};
    scene.superelements = {{{"p"}, {1.0, 0.0, 0.0, 1.0}}, {{"q"}, {1.0, 0.0, 0.0, 1.0}}};
    scene.loads = {{"p", 1.0, 0.0}, {"p", 0.0, -1.0, true}};
    return scene;
  }
  // Sliding at x: s = x + 0.4 xi', with z held at 0.5.
  PathPoint Sliding(double x, int piece) const {
    PathPoint point;
    point.u = Vector3d(x, 0.0, 0.5);
    point.s = x + kRatio * ToyLaw::Xi(x, piece, 1);
    point.forces = Vector3d(1.0, -kRatio, 0.2);
    point.modes = {{ToyLaw::kSlides, piece}};
    return point;
  }

  const Structure structure_;
  const ToyLaw law_;
  Laws laws_;
};

TEST_F(ToyLawOnSprings, DerivativesMeetDifferencesOnEveryPiece) {
  Random random(2);
  FixedModeSystem system(structure_, laws_);
  for (const int state : {ToyLaw::kHeld, ToyLaw::kSlides, ToyLaw::kAway})
    for (const int piece : {-3, 0, 2, 1000}) {
      system.SetModes({{state, piece}}, Vector3d(0.0, piece + 0.2, 0.1));
      EXPECT_EQ(system.NumUnknowns() - 4, state == ToyLaw::kHeld ? 3 : state == ToyLaw::kSlides ? 2 : 0);
      EXPECT_EQ(system.NumUnknowns(), system.NumEquations() + 1);
      for (const bool active : {false, true}) {
        if (active) system.SetActive(system.mode_limits().All());
        VectorXd x = random.Vector(system.NumUnknowns(), 0.1, 0.9);
        x[0] += piece;
        const VectorXd dx = random.Vector(system.NumUnknowns(), -1.0, 1.0);
        SCOPED_TRACE(std::to_string(state) + " " + std::to_string(piece));
        ExpectDerivativesMeetDifferences(&system, x, dx);
      }
    }
}

// Two numbers: where x and z are held from then on.
TEST_F(ToyLawOnSprings, RemembersWhereItIsHeld) {
  PathPoint point = Sliding(2.3, 2);
  point.modes[0].state = ToyLaw::kHeld;
  EXPECT_EQ(laws_.ReferencesAt(point), Vector3d(0.0, ToyLaw::Xi(2.3, 2, 0), 0.5));
  FixedModeSystem system(structure_, laws_);
  system.SetModesFrom(point);
  VectorXd residual;
  system.Residual(system.Pack(point), &residual);
  EXPECT_LE(residual.lpNorm<Eigen::Infinity>(), 1e-15);
}

// At the edge it slides, or it is held and the load goes back.
TEST_F(ToyLawOnSprings, SlidesFromTheEdge) {
  PathPoint point = Sliding(0.4, 0);
  point.modes[0].state = ToyLaw::kHeld;
  Arrival arrival;
  arrival.direction = Vector4d(0.0, 0.0, 0.0, 1.0);
  const BranchSet set = FindBranches(structure_, laws_, point, arrival, ActiveSetTolerance());
  ASSERT_EQ(set.branches.size(), 1U);
  EXPECT_EQ(set.branches[0].modes, (Modes{{ToyLaw::kSlides, 0}}));
  const double slope = 1.0 + kRatio * ToyLaw::Xi(0.4, 0, 2), xi = ToyLaw::Xi(0.4, 0, 1);
  EXPECT_NEAR(set.branches[0].load_rate / set.branches[0].direction[0], slope, 1e-12);
  EXPECT_NEAR(set.branches[0].dissipation_rate / set.branches[0].direction[0], kRatio * xi, 1e-12);
}

// Over the ends of pieces, of which there is no last one: the load has a kink at each, the place is where xi is whole.
TEST_F(ToyLawOnSprings, SlidesFromPieceToPiece) {
  for (const int first : {-2, 0, 1000}) {
    PathPoint point = Sliding(first + 0.7, first);
    for (int piece = first; piece < first + 3; ++piece) {
      ModeArc arc(structure_, laws_);
      arc.SetModes(point);
      CurvePoint start, end;
      ASSERT_TRUE(arc.Derivatives(arc.system().Pack(point), Vector4d(1.0, 0.0, 0.0, 1.0), &start));
      const VectorXd normal = start.first.head(4);
      const double ahead = (piece + 1.05 - start.x[0]) / start.first[0];
      const Correction correction = arc.CorrectOnPlane(start.x + ahead * start.first, normal);
      ASSERT_TRUE(correction.converged && arc.Derivatives(correction.x, normal, &end));
      const Step step = MakeStep(start, end, 4);
      const StepEvent event = FirstEvent(&arc, step);
      ASSERT_EQ(event.Kind(), EventKind::kContactEvent) << piece;
      EXPECT_EQ(event.fails->id, ToyLaw::kEnd);
      const std::optional<CurvePoint> located = Locate(&arc, step, event);
      ASSERT_TRUE(located);
      EXPECT_NEAR(located->x[0], piece + 1, kExact * (1.0 + std::abs(first)));
      EXPECT_NEAR(located->x[3], piece + 1 + kRatio, kExact * (1.0 + std::abs(first)));
      point = arc.system().Unpack(located->x);
      Arrival arrival;
      arrival.direction = located->first.head(4);
      const BranchSet set = FindBranches(structure_, laws_, point, arrival, ActiveSetTolerance());
      ASSERT_FALSE(set.branches.empty());
      EXPECT_EQ(set.branches[0].modes, (Modes{{ToyLaw::kSlides, piece + 1}}));
      const double slope = 1.0 + kRatio * ToyLaw::Xi(piece + 1, piece + 1, 2);
      EXPECT_NEAR(set.branches[0].load_rate / set.branches[0].direction[0], slope, 1e-9);
      point.modes = set.branches[0].modes;
    }
  }
}

// The toy with its table changed.
class Misfit : public ToyLaw {
 public:
  template <typename Change>
  explicit Misfit(Change change) {
    Traits traits;
    traits.num_ports = NumPorts();
    traits.dofs = Dofs(0);
    std::vector<StateRule> states = {In(kHeld), In(kSlides), In(kAway)};
    for (StateRule& state : states) state.idle = true, state.slides = false;  // as SetLaw() is given them
    change(&traits.num_ports, &states);
    SetLaw(traits, states);
  }
};

TEST(LawTest, RefusesWhatTheEngineCannotHave) {
  using States = std::vector<StateRule>;
  EXPECT_NO_THROW(Misfit([](std::size_t*, States*) {}));
  EXPECT_THROW(Misfit([](std::size_t* ports, States*) { *ports = kMostPorts + 1; }), std::logic_error);
  EXPECT_THROW(Misfit([](std::size_t*, States* states) { states->push_back(states->back()); }), std::logic_error);
  EXPECT_THROW(
      Misfit([](std::size_t*, States* states) { states->front().limits[1].id = states->front().limits[0].id; }),
      std::logic_error);
  EXPECT_THROW(Misfit([](std::size_t*, States* states) { states->front().limits[0].next = 3; }), std::logic_error);
  EXPECT_THROW(Misfit([](std::size_t*, States* states) { states->front().held = -1; }), std::logic_error);
  EXPECT_THROW(Misfit([](std::size_t*, States* states) { states->erase(states->begin() + 2); }), std::logic_error);
}

}  // namespace
}  // namespace contact_path::toy_law_test
