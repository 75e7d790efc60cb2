#include "contact_path/branch/event_functions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "branch/example_scenes.h"
#include "branch/traced_arc.h"
#include "contact_path/branch/branches.h"
#include "contact_path/path/model.h"
#include "support/reference_cases.h"
#include "support/traced_path.h"

namespace contact_path::event_functions_test {
namespace {

std::size_t FirstIncrement(const TracedPath& path, IncrementKind kind, std::size_t from = 1) {
  while (path.increments.at(from).kind != kind) ++from;
  return from;
}

TEST(EventFunctions, NothingHappens) {
  TracedArc arc(TraceScene(ReadExample("rigid_stop").scene, 3), 1);
  const Step step = arc.Between(0.0, 0.1);
  const StepEvent event = FirstEvent(&arc.arc(), step);
  EXPECT_EQ(event.kind, EventKind::kNone);
  EXPECT_EQ(event.t, step.length);
  const std::optional<CurvePoint> located = Locate(&arc.arc(), step, event);
  ASSERT_TRUE(located);
  EXPECT_EQ(located->x, step.end.x);
}

// The scene is its own scaled scene, and u and s move by the same: the gap 0.1 is closed at sqrt(2) 0.1.
TEST(EventFunctions, AGapCloses) {
  TracedArc arc(TraceScene(ReadExample("rigid_stop").scene, 3), 1);
  for (const double length : {0.15, 1.0, 10.0}) {
    const Step step = arc.Between(0.0, length);
    const StepEvent event = FirstEvent(&arc.arc(), step);
    ASSERT_EQ(event.kind, EventKind::kContactEvent);
    EXPECT_EQ(event.constraint.contact, 0);
    EXPECT_EQ(event.constraint.inequality, Inequality::kGap);
    EXPECT_NEAR(event.t, 0.1 * std::sqrt(2.0), 1e-14);
    const std::optional<CurvePoint> located = Locate(&arc.arc(), step, event);
    ASSERT_TRUE(located);
    EXPECT_NEAR(located->x[0], 1.1, 1e-15);
    EXPECT_NEAR(arc.Load(*located), 0.1, 1e-15);
    EXPECT_FALSE(event.crossing);
  }
  // Just before, and just at the end of the step.
  EXPECT_EQ(FirstEvent(&arc.arc(), arc.Between(0.0, 0.14)).kind, EventKind::kNone);
  EXPECT_EQ(FirstEvent(&arc.arc(), arc.Between(0.0, 0.1415)).kind, EventKind::kContactEvent);
}

TEST(EventFunctions, TheConeIsReached) {
  const TracedPath path = TraceScene(ReadExample("rough_truss").scene, 60);
  TracedArc arc(path, 2);
  // t = 0 is increment 1; the corner limit point is where the slope of the bars is 1 / mu.
  const std::size_t corner = FirstIncrement(path, IncrementKind::kCornerLimit);
  const Step step = arc.Between(0.0, 0.3);
  const StepEvent event = FirstEvent(&arc.arc(), step);
  ASSERT_EQ(event.kind, EventKind::kContactEvent);
  EXPECT_EQ(event.constraint.inequality, Inequality::kConePlus);
  const std::optional<CurvePoint> located = Locate(&arc.arc(), step, event);
  ASSERT_TRUE(located);
  EXPECT_NEAR(arc.Load(*located), rough_truss::CornerLoad(), 1e-14);
  EXPECT_NEAR(arc.Load(*located), path.increments[corner].load_factor, 1e-14);
}

TEST(EventFunctions, TheReactionVanishes) {
  const TracedPath path = TraceScene(ReadExample("two_dof_friction").scene, 100);
  TracedArc arc(path, FirstIncrement(path, IncrementKind::kCornerLimit) + 1);  // slip starts
  const Step step = arc.Between(0.0, 3.0);
  const StepEvent event = FirstEvent(&arc.arc(), step);
  ASSERT_EQ(event.kind, EventKind::kContactEvent);
  EXPECT_EQ(event.constraint.inequality, Inequality::kNormalReaction);
  const std::optional<CurvePoint> located = Locate(&arc.arc(), step, event);
  ASSERT_TRUE(located);
  EXPECT_NEAR(arc.Load(*located), 2.0 / 3.0, 1e-14);
}

// The block comes to rest where the rate of slip is zero: the end of its path.
TEST(EventFunctions, SlipStops) {
  const TracedPath path = TraceScene(snap_block::MakeScene(), 300);
  const std::size_t last = path.increments.size() - 1;
  TracedArc arc(path, last - 1);
  const Step step = arc.Between(0.0, 0.03);
  const StepEvent event = FirstEvent(&arc.arc(), step);
  ASSERT_EQ(event.kind, EventKind::kContactEvent);
  EXPECT_EQ(event.constraint.inequality, Inequality::kSlip);
  const std::optional<CurvePoint> located = Locate(&arc.arc(), step, event);
  ASSERT_TRUE(located);
  EXPECT_NEAR(arc.arc().system().Rate(event.constraint, located->x, located->first), 0.0, 1e-12);
  EXPECT_NEAR(located->x[0] * arc.model().scaling.length, snap_block::kEndX, 1e-14);
}

TEST(EventFunctions, LimitPoints) {
  const TracedPath path = TraceScene(ReadExample("von_mises").scene, 100);
  const std::size_t limit = FirstIncrement(path, IncrementKind::kSmoothLimit);
  for (const std::size_t before : {1U, 3U, 8U}) {
    TracedArc arc(path, limit - before + 1);
    const Step step = arc.Between(0.0, 0.02 * static_cast<double>(before) + 0.01);
    const StepEvent event = FirstEvent(&arc.arc(), step);
    ASSERT_EQ(event.kind, EventKind::kLimitPoint);
    const std::optional<CurvePoint> located = Locate(&arc.arc(), step, event);
    ASSERT_TRUE(located);
    EXPECT_NEAR(located->first[arc.arc().NumMotion() - 1], 0.0, 1e-12);
    EXPECT_NEAR(arc.Load(*located), von_mises::BiotLimit(1.0, 1.0), 1e-14);
  }
}

TEST(EventFunctions, Bifurcations) {
  const TracedPath path = TraceScene(tall_truss::MakeScene(), 40);
  TracedArc arc(path, FirstIncrement(path, IncrementKind::kBifurcation));
  const Step step = arc.Between(0.0, 0.02);
  const StepEvent event = FirstEvent(&arc.arc(), step);
  ASSERT_EQ(event.kind, EventKind::kBifurcation);
  EXPECT_TRUE(event.crossing);
  const std::optional<CurvePoint> located = Locate(&arc.arc(), step, event);
  ASSERT_TRUE(located);
  EXPECT_EQ(located->determinant_sign, 0);
  EXPECT_NEAR(located->x[1] * arc.model().scaling.length, tall_truss::BifurcationY(), 1e-14);
}

// Of several events on a step the first is reported, whatever its kind.
TEST(EventFunctions, TheFirstOfSeveral) {
  Scene scene = ReadExample("von_mises").scene;
  const double limit_y = 0.50983;  // of the apex, at the limit point, rounded
  scene.obstacles = {{"low", ObstacleShape::kHalfPlane, 0.0, limit_y - 0.01, 0.0, 1.0, 0.0},
                     {"lower", ObstacleShape::kHalfPlane, 0.0, limit_y - 0.02, 0.0, 1.0, 0.0}};
  scene.contacts = {{"apex", "lower"}, {"apex", "low"}};
  const TracedPath path = TraceScene(scene, 100);
  TracedArc arc(path, FirstIncrement(path, IncrementKind::kSmoothLimit) - 1);
  EXPECT_EQ(FirstEvent(&arc.arc(), arc.Between(0.0, 0.1)).kind, EventKind::kLimitPoint);
  TracedArc beyond(path, FirstIncrement(path, IncrementKind::kSmoothLimit) + 1);
  const Step step = beyond.Between(0.0, 0.1);
  const StepEvent event = FirstEvent(&beyond.arc(), step);
  ASSERT_EQ(event.kind, EventKind::kContactEvent);
  EXPECT_EQ(event.constraint.contact, 1);  // "low", the higher of the two
  const std::optional<CurvePoint> located = Locate(&beyond.arc(), step, event);
  ASSERT_TRUE(located);
  EXPECT_NEAR(located->x[1] * beyond.model().scaling.length, limit_y - 0.01, 1e-15);
}

// A start at the limit is no event while it is left to the admissible side; towards the other it is one at t = 0.
TEST(EventFunctions, AStartAtTheLimit) {
  Scene scene = ReadExample("rigid_stop").scene;
  scene.obstacles[0].px = 1.0;
  TraceRequest request;
  request.scene = scene;
  request.options.max_increments = 2;
  request.options.direction = -1.0;
  TracedArc arc(TraceIncrements(request), 1);
  EXPECT_EQ(FirstEvent(&arc.arc(), arc.Between(0.0, 0.1)).kind, EventKind::kNone);
  const Step towards = arc.Between(0.1, 0.1 - 1e-12);
  const CurvePoint start = arc.At(0.0);
  CurvePoint back;
  ASSERT_TRUE(arc.arc().Derivatives(start.x, -start.first.head(2), &back));
  CurvePoint end;
  const Eigen::VectorXd x = start.x - 0.1 * start.first;
  ASSERT_TRUE(arc.arc().Derivatives(x, -start.first.head(2), &end));
  const StepEvent event = FirstEvent(&arc.arc(), MakeStep(back, end, 2));
  ASSERT_EQ(event.kind, EventKind::kContactEvent);
  EXPECT_EQ(event.t, 0.0);
  EXPECT_LE(towards.length, 0.0);
}

class Swing : public testing::Test {
 protected:
  // A step over the top of the circle, from before to beyond it. q moves on the same circle whatever the clearance.
  std::unique_ptr<TracedArc> Over(double clearance) {
    const Scene far = swing::MakeScene(1.0, 0.0);
    TracedPath path = TraceScene(far, 20);
    path.request.scene = swing::MakeScene(clearance, 0.0);
    increment_ = 0;
    while (path.increments[increment_ + 1].load_factor < swing::Load(0.0)) ++increment_;
    return std::make_unique<TracedArc>(path, increment_ + 1);
  }
  std::size_t increment_ = 0;
};

TEST_F(Swing, AnInequalityBrokenAndMendedWithinTheStepIsFound) {
  for (const double clearance : {-1e-3, -1e-6, -1e-8}) {
    const std::unique_ptr<TracedArc> arc = Over(clearance);
    const Step step = arc->Between(-0.05, 0.1);
    EXPECT_GT(step.start.x.size(), 0);
    ASSERT_GT(arc->arc().system().Value({0, Inequality::kGap}, step.end.x), 0.0);
    ASSERT_GT(arc->arc().system().Value({0, Inequality::kGap}, step.start.x), 0.0);
    const StepEvent event = FirstEvent(&arc->arc(), step);
    if (clearance > -1e-7 && event.kind == EventKind::kNearTouch) continue;  // an increment there will tell
    ASSERT_EQ(event.kind, EventKind::kContactEvent) << clearance;
    const std::optional<CurvePoint> located = Locate(&arc->arc(), step, event);
    ASSERT_TRUE(located);
    EXPECT_NEAR(arc->Load(*located), swing::Load(swing::TouchingAngle(clearance)), 1e-11);
  }
}

TEST_F(Swing, ANearMissIsLookedAtMoreClosely) {
  for (const double clearance : {1e-7, 1e-8, 1e-9}) {
    const std::unique_ptr<TracedArc> arc = Over(clearance);
    const Step step = arc->Between(-0.05, 0.1);
    const StepEvent event = FirstEvent(&arc->arc(), step);
    ASSERT_TRUE(event.kind == EventKind::kNearTouch || event.kind == EventKind::kContactEvent) << clearance;
    if (event.kind != EventKind::kNearTouch) continue;
    const std::optional<CurvePoint> located = Locate(&arc->arc(), step, event);
    ASSERT_TRUE(located);
    // On the curve, next to the top.
    EXPECT_NEAR(located->x[3] * arc->model().scaling.length, swing::kCentreY + swing::kRadius, 1e-4);
    EXPECT_LE(arc->arc().CorrectOnPlane(located->x, step.normal).first_step, 1e-13);
  }
  const std::unique_ptr<TracedArc> arc = Over(0.05);
  EXPECT_EQ(FirstEvent(&arc->arc(), arc->Between(-0.05, 0.1)).kind, EventKind::kNone);
}

}  // namespace
}  // namespace contact_path::event_functions_test
