// Where the patches of a surface meet: a node on springs that slides over a bend, against its closed form.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <memory>
#include <optional>

#include "contact_path/branch/branches.h"
#include "contact_path/branch/contact_arc.h"
#include "contact_path/branch/event_functions.h"
#include "contact_path/branch/state_options.h"
#include "contact_path/contact/rigid_pair.h"
#include "contact_path/geometry/point_curves.h"
#include "contact_path/structure/structure.h"

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
    contacts_.push_back(
        std::make_unique<RigidPair>(curve_, NodeMotion{{0, 1}, Vector2d::Zero(), Vector2d::Zero()}, GetParam()));
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
    point.rn = VectorXd::Constant(1, solved[1]);
    point.rt = -GetParam() * point.rn;
    point.states = {GetParam() > 0.0 ? kSlipPlus : kClosed};
    point.patches = {patch};
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
  Step StepFrom(ContactArc* arc, const PathPoint& point, const Eigen::Vector3d& towards, double length) const {
    arc->SetStates(point.states, point);
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
};

TEST_P(NodeOnABend, TheEndOfAPatchIsLocatedExactly) {
  for (const int patch : {0, 1}) {
    ContactArc arc(structure_, contacts_);
    const double from = End(patch) - 0.03;
    const Step step = StepFrom(&arc, At(from, patch), Rate(from, patch, 1e-5), 0.2);
    const StepEvent event = FirstEvent(&arc, step);
    ASSERT_EQ(event.Kind(), EventKind::kContactEvent);
    EXPECT_EQ(event.fails->inequality, Inequality::kPatchEnd);
    const std::optional<CurvePoint> located = Locate(&arc, step, event);
    ASSERT_TRUE(located);
    EXPECT_NEAR(Xi(located->x, patch), End(patch), kExact);
    const PathPoint there = At(End(patch), patch);
    EXPECT_NEAR((located->x.head<2>() - there.u).norm(), 0.0, kExact);
    EXPECT_NEAR(located->x[2], there.s, kExact);
    EXPECT_NEAR(located->x[3], there.rn[0], kExact);
  }
}

// Place, load and reaction do not change; their rates, which the curvature has a share in, do.
TEST_P(NodeOnABend, ThePathGoesOnOnTheNextPatch) {
  for (const int patch : {0, 1}) {
    const PathPoint point = At(End(patch), patch);
    const Eigen::Vector3d before = Rate(End(patch), patch, -1e-5), after = Rate(End(patch), patch + 1, 1e-5);
    Arrival arrival;
    arrival.direction = before;
    const BranchSet set = FindBranches(structure_, contacts_, point, arrival, ActiveSetTolerance());
    ASSERT_FALSE(set.branches.empty());
    EXPECT_EQ(set.branches[0].states, point.states);
    ASSERT_EQ(set.branches[0].patches, std::vector<int>{patch + 1});
    EXPECT_LE((set.branches[0].direction - after).norm(), 1e-8);
    EXPECT_GT((after - before).norm(), 0.1);
    for (const Branch& branch : set.branches)
      if (branch.states[0] == point.states[0]) {
        EXPECT_EQ(branch.patches[0], patch + 1);
      }
  }
}

TEST_P(NodeOnABend, WhereTwoPatchesMeetSlipLeadsToTheOneAhead) {
  const bool rough = GetParam() > 0.0;
  for (const int patch : {0, 1}) {
    PathPoint point = At(End(0), patch);
    const auto options = [&] { return StateOptions(*contacts_[0], point, 0, ActiveSetTolerance()); };
    if (rough) {
      EXPECT_EQ(options(), (ContactModes{{kSlipPlus, 1}, {kStick, patch}}));
      point.rt = -point.rt;
      point.states = {kStick};
      EXPECT_EQ(options(), (ContactModes{{kStick, patch}, {kSlipMinus, 0}}));
    } else {
      EXPECT_EQ(options(), (ContactModes{{kClosed, patch}, {kClosed, 1 - patch}}));
    }
    point.rn[0] = point.rt[0] = 0.0;
    EXPECT_EQ(options().back(), (ContactMode{kOpen, patch}));
  }
  // Between the ends there is one patch.
  for (const ContactMode& mode : StateOptions(*contacts_[0], At(0.5 * (End(0) + End(1)), 1), 0, ActiveSetTolerance()))
    EXPECT_EQ(mode.patch, 1);
}

TEST_P(NodeOnABend, NothingSlidesOverTheEndOfAnOpenSurface) {
  PathPoint point = At(End(2), 2);
  for (const ContactMode& mode : StateOptions(*contacts_[0], point, 0, ActiveSetTolerance())) {
    EXPECT_NE(mode.state, kSlipPlus);
    EXPECT_EQ(mode.patch, 2);
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
  ContactArc free(held, contacts_);
  point.rn = point.rt = VectorXd::Zero(1);
  point.states = {kOpen};
  point.patches = {0};
  const Step step = StepFrom(&free, point, {1.0, 0.0, 1.0}, 0.1);
  const StepEvent event = FirstEvent(&free, step);
  ASSERT_EQ(event.Kind(), EventKind::kNearTouch);
  const std::optional<CurvePoint> located = Locate(&free, step, event);
  ASSERT_TRUE(located);
  EXPECT_GT(Xi(located->x, 0), End(0));
  EXPECT_LT(Xi(located->x, 0), End(0) + 1e-8);
  const PathPoint there = free.system().Unpack(located->x);
  EXPECT_EQ(contacts_[0]->KnownPatch(there.u, there.s, there.patches[0]), 1);
  EXPECT_EQ(FirstEvent(&free, MakeStep(*located, step.end, 3)).Kind(), EventKind::kNone);
}

INSTANTIATE_TEST_SUITE_P(RoughAndSmooth, NodeOnABend, testing::Values(0.3, 0.0));

}  // namespace
}  // namespace contact_path::patches_test
