// Where the patches of a surface meet: a node on springs that slides over a bend, against its closed form.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <memory>
#include <optional>

#include "contact_path/branch/branches.h"
#include "contact_path/branch/event_functions.h"
#include "contact_path/branch/mode_arc.h"
#include "contact_path/contact/rigid_pair.h"
#include "contact_path/geometry/point_curves.h"
#include "contact_path/structure/structure.h"
#include "support/contact_points.h"
#include "support/points.h"

namespace contact_path::patches_test {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double kExact = 1e-12;
constexpr ContactState kOpen = ContactState::kOpen, kStick = ContactState::kStick, kClosed = ContactState::kClosed;
constexpr ContactState kSlipPlus = ContactState::kSlipPlus, kSlipMinus = ContactState::kSlipMinus;

// Two edges, the second falls, with a fillet of the radius 0.4 between them; springs of stiffness 1.3 (x) and 0.8 (y)
// hold the node to (0.4, -0.9); the load is s (1, -0.2).
class NodeOnABend : public testing::TestWithParam<double> {
 protected:
  NodeOnABend() : structure_(MakeScene()), curve_(MakePolyline({{-1.0, 0.0}, {1.0, 0.0}, {2.0, -1.0}}, false, 0.4)) {
    contacts_.push_back(std::make_unique<RigidPair>(curve_, MovingPlace(PointOfNode(0, 1)), GetParam()));
    laws_ = LawsOf(contacts_);
  }
  static Scene MakeScene() {
    Scene scene;
    scene.nodes = {{"p", 0.4, -0.9, false, false}};
    scene.superelements = {{{"p"}, {1.3, 0.0, 0.0, 0.8}}};
    scene.loads = {{"p", 1.0, -0.2, false}};
    return scene;
  }
  double End(int patch) const { return curve_->RangeOf(patch).end; }
  // Sliding towards +t: equilibrium K (x - X) - s f = r_n (n - mu t).
  PathPoint At(double xi, int patch) const {
    const Vector2d x = curve_->PointAt(xi), n = curve_->Project(x, patch).normal;
    const Vector2d elastic(1.3 * (x.x() - 0.4), 0.8 * (x.y() + 0.9));
    Eigen::Matrix2d columns;
    columns << Vector2d(1.0, -0.2), n - GetParam() * TangentOf(n);
    const Vector2d solved = columns.inverse() * elastic;
    PathPoint point;
    point.u = x;
    point.s = solved[0];
    point.forces = solved[1] * Vector2d(1.0, -GetParam());
    point.modes = ModesOf({GetParam() > 0.0 ? kSlipPlus : kClosed}, {patch});
    return point;
  }
  static Eigen::Vector3d Motion(const PathPoint& point) { return {point.u[0], point.u[1], point.s}; }
  // Of the motion by xi, of length 1, by differences on the side of h.
  Eigen::Vector3d Rate(double xi, int patch, double h) const {
    const Eigen::Vector3d difference =
        4.0 * Motion(At(xi + h, patch)) - 3.0 * Motion(At(xi, patch)) - Motion(At(xi + 2.0 * h, patch));
    return (h > 0.0 ? difference : -difference).normalized();
  }
  double Xi(const VectorXd& x, int patch) const { return curve_->Project(x.head<2>(), patch).xi; }
  // From xi, by this length along the tangent.
  Step StepFrom(ModeArc* arc, const PathPoint& point, const Eigen::Vector3d& towards, double length) const {
    arc->SetModes(point);
    CurvePoint start, end;
    EXPECT_TRUE(arc->Derivatives(arc->system().Pack(point), towards, &start));
    const VectorXd normal = start.first.head(3);
    const Correction correction = arc->CorrectOnPlane(start.x + length * start.first, normal);
    EXPECT_TRUE(correction.converged && arc->Derivatives(correction.x, normal, &end));
    return MakeStep(start, end, 3);
  }

  Structure structure_;
  std::shared_ptr<const Curve> curve_;
  ContactPairs contacts_;
  Laws laws_;
};

TEST_P(NodeOnABend, TheEndOfAPatchIsLocatedExactly) {
  for (const int patch : {0, 1}) {
    ModeArc arc(structure_, laws_);
    const double from = End(patch) - 0.03;
    const Step step = StepFrom(&arc, At(from, patch), Rate(from, patch, 1e-5), 0.2);
    const StepEvent event = FirstEvent(&arc, step);
    ASSERT_EQ(event.Kind(), EventKind::kContactEvent);
    EXPECT_EQ(event.fails->id, NumberOf(ContactLimit::kPatchEnd));
    const std::optional<CurvePoint> located = Locate(&arc, step, event);
    ASSERT_TRUE(located);
    EXPECT_NEAR(Xi(located->x, patch), End(patch), kExact);
    const PathPoint there = At(End(patch), patch);
    EXPECT_NEAR((located->x.head<2>() - there.u).norm(), 0.0, kExact);
    EXPECT_NEAR(located->x[2], there.s, kExact);
    EXPECT_NEAR(located->x[3], there.forces[0], kExact);
  }
}

// Place, load and reaction do not change; their rates, which the curvature has a share in, do.
TEST_P(NodeOnABend, ThePathGoesOnOnTheNextPatch) {
  for (const int patch : {0, 1}) {
    const PathPoint point = At(End(patch), patch);
    const Eigen::Vector3d before = Rate(End(patch), patch, -1e-5), after = Rate(End(patch), patch + 1, 1e-5);
    Arrival arrival;
    arrival.direction = before;
    const BranchSet set = FindBranches(structure_, laws_, point, arrival, ActiveSetTolerance());
    ASSERT_FALSE(set.branches.empty());
    ASSERT_EQ(set.branches[0].modes, (Modes{{point.modes[0].state, patch + 1}}));
    EXPECT_LE((set.branches[0].direction - after).norm(), 1e-8);
    EXPECT_GT((after - before).norm(), 0.1);
    for (const Branch& branch : set.branches)
      if (branch.modes[0].state == point.modes[0].state) {
        EXPECT_EQ(branch.modes[0].piece, patch + 1);
      }
  }
}

TEST_P(NodeOnABend, WhereTwoPatchesMeetSlipLeadsToTheOneAhead) {
  const bool rough = GetParam() > 0.0;
  for (const int patch : {0, 1}) {
    PathPoint point = At(End(0), patch);
    const auto options = [&] { return laws_.ModesAt(point, 0, ActiveSetTolerance()); };
    if (rough) {
      EXPECT_EQ(options(), ModesOf({kSlipPlus, kStick}, {1, patch}));
      point.forces[kTangent] *= -1.0;
      point.modes = ModesOf({kStick}, {patch});
      EXPECT_EQ(options(), ModesOf({kStick, kSlipMinus}, {patch, 0}));
    } else {
      EXPECT_EQ(options(), ModesOf({kClosed, kClosed}, {patch, 1 - patch}));
    }
    point.forces.setZero();
    EXPECT_EQ(options().back(), (Mode{NumberOf(kOpen), patch}));
  }
  // Between the ends there is one patch.
  for (const Mode& mode : laws_.ModesAt(At(0.5 * (End(0) + End(1)), 1), 0, ActiveSetTolerance()))
    EXPECT_EQ(mode.piece, 1);
}

TEST_P(NodeOnABend, NothingSlidesOverTheEndOfAnOpenSurface) {
  PathPoint point = At(End(2), 2);
  for (const Mode& mode : laws_.ModesAt(point, 0, ActiveSetTolerance())) {
    EXPECT_NE(StateOf(mode), kSlipPlus);
    EXPECT_EQ(mode.piece, 2);
  }
}

// An open contact passes by: the step ends a little beyond the end of the patch, and the next one has the next patch.
TEST_P(NodeOnABend, OpenContactsChangeTheirPatchWithoutAnEvent) {
  PathPoint point;
  point.u = Vector2d(End(0) - 1.0 - 0.02, 0.05);
  const Vector2d force(1.3 * (point.u[0] - 0.4), 0.8 * (point.u[1] + 0.9));
  // A held load keeps the node up: the arc is that of another scene.
  Scene scene = MakeScene();
  point.s = force.x();
  scene.loads.push_back({"p", 0.0, force.y() + 0.2 * point.s, true});
  const Structure held(scene);
  ModeArc free(held, laws_);
  point.forces = VectorXd::Zero(2);
  point.modes = ModesOf({kOpen});
  const Step step = StepFrom(&free, point, {1.0, 0.0, 1.0}, 0.1);
  const StepEvent event = FirstEvent(&free, step);
  ASSERT_EQ(event.Kind(), EventKind::kNearTouch);
  const std::optional<CurvePoint> located = Locate(&free, step, event);
  ASSERT_TRUE(located);
  EXPECT_GT(Xi(located->x, 0), End(0));
  EXPECT_LT(Xi(located->x, 0), End(0) + 1e-8);
  const PathPoint there = free.system().Unpack(located->x);
  EXPECT_EQ(contacts_[0]->KnownPatch(there.u, there.s, there.modes[0].piece), 1);
  EXPECT_EQ(FirstEvent(&free, MakeStep(*located, step.end, 3)).Kind(), EventKind::kNone);
}

INSTANTIATE_TEST_SUITE_P(RoughAndSmooth, NodeOnABend, testing::Values(0.3, 0.0));

}  // namespace
}  // namespace contact_path::patches_test
