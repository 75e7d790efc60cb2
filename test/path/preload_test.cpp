#include "contact_path/path/preload.h"

#include <gtest/gtest.h>

#include <memory>
#include <utility>

#include "contact_path/path/mpec_method.h"

namespace contact_path::preload_test {
namespace {

// The preload ends in equations solved to rounding; measured up to 4e-16.
constexpr double kRounding = 1e-14;

// A bar of EA 1 along the x axis from the pinned node a to b at (1, 0), on a floor of friction mu.
Scene Block(double rest_length, double friction, const std::vector<Load>& constant_loads = {}) {
  Scene scene;
  scene.name = "block";
  scene.nodes = {{"a", 0.0, 0.0, true, true}, {"b", 1.0, 0.0, false, false}};
  scene.bars = {{{"a", "b"}, 1.0, rest_length, StrainMeasure::kBiot}};
  scene.loads = {{"b", 1.0, 0.0, false}};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, friction}};
  scene.contacts = {{"b", "floor"}};
  scene.loads.insert(scene.loads.end(), constant_loads.begin(), constant_loads.end());
  return scene;
}

Model ModelOf(const Scene& scene) { return {scene, CharacteristicScales(scene)}; }

MethodFactory Mpec(double step) {
  return [step](const Model& model, double target) {
    TraceOptions options;
    options.method = Method::kMpec;
    options.step = step;
    MpecOptions mpec = MpecOptions::For(options, 1.0);
    mpec.targets = {target};
    return std::make_unique<MpecMethod>(model, mpec, nullptr);
  };
}

Preload RunPreload(const Scene& scene, double step = 0.2, int max_increments = 200) {
  const Model model(scene, CharacteristicScales(scene));
  Preload preload = TracePreload(model, max_increments, Mpec(step));
  if (preload.done) {
    const Residuals residuals = model.Check(preload.point, preload.point);
    EXPECT_LE(residuals.equilibrium, kRounding);
    EXPECT_LE(residuals.Contact(), kRounding);
    EXPECT_EQ(preload.point.s, 0.0);
  }
  return preload;
}

void ExpectEnd(const Preload& preload, EndReason end, const std::string& text = "") {
  EXPECT_FALSE(preload.done);
  EXPECT_EQ(preload.end.reason, end);
  EXPECT_NE(EndText(preload.end.causes).find(text), std::string::npos) << EndText(preload.end.causes);
}

TEST(Preload, NothingToDoWithoutConstantLoadsAndStress) {
  const Scene scene = Block(0.0, 0.5);
  const Model model(scene, CharacteristicScales(scene));
  const Preload preload = TracePreload(model, 0, [](const Model&, double) -> std::unique_ptr<PathMethod> {
    ADD_FAILURE() << "no method is needed";
    return nullptr;
  });
  EXPECT_TRUE(preload.done);
  EXPECT_EQ(preload.point.u, model.InitialPoint().u);
  EXPECT_EQ(preload.point.modes, model.InitialPoint().modes);
}

TEST(Preload, ConstantLoadIsCarriedByTheContact) {
  const Preload preload = RunPreload(Block(0.0, 0.5, {{"b", 0.1, -2.0, true}}));
  ASSERT_TRUE(preload.done) << EndText(preload.end.causes);
  EXPECT_NEAR(preload.point.u[0], 1.0, kRounding);
  EXPECT_NEAR(preload.point.forces[0], 2.0, kRounding);
  EXPECT_NEAR(preload.point.forces[1], -0.1, kRounding);  // inside the cone: it sticks
  EXPECT_EQ(StateOf(preload.point, 0), ContactState::kStick);
}

TEST(Preload, ConstantLoadBeyondTheConeSlides) {
  const Preload preload = RunPreload(Block(0.0, 0.5, {{"b", 0.3, -0.4, true}}));
  ASSERT_TRUE(preload.done) << EndText(preload.end.causes);
  EXPECT_NEAR(preload.point.forces[0], 0.4, kRounding);
  EXPECT_NEAR(preload.point.forces[1], -0.2, kRounding);
  EXPECT_NEAR(preload.point.u[0], 1.1, kRounding);  // the bar takes the rest, 0.3 - 0.2
  EXPECT_EQ(StateOf(preload.point, 0), ContactState::kSlipPlus);
}

TEST(Preload, BarReleasedFromItsInitialLengthGoesToItsRestLength) {
  for (const double rest_length : {0.8, 1.25}) {
    Scene scene = Block(rest_length, 0.0);
    const Model model(scene, CharacteristicScales(scene));
    const Preload preload = RunPreload(scene);
    ASSERT_TRUE(preload.done) << EndText(preload.end.causes);
    EXPECT_NEAR(preload.point.u[0] * model.scaling.length, rest_length, kRounding);
  }
}

// Tension 1/0.8 - 1 = 0.25 in the bar, a block of weight 1 with mu = 0.1: it slides back until the tension is 0.1.
TEST(Preload, ReleasedBarDragsTheBlockUntilFrictionHoldsIt) {
  const Preload preload = RunPreload(Block(0.8, 0.1, {{"b", 0.0, -1.0, true}}));
  ASSERT_TRUE(preload.done) << EndText(preload.end.causes);
  EXPECT_NEAR(preload.point.u[0], 0.8 * 1.1, kRounding);
  EXPECT_NEAR(preload.point.forces[0], 1.0, kRounding);
  EXPECT_NEAR(preload.point.forces[1], 0.1, kRounding);
  EXPECT_EQ(StateOf(preload.point, 0), ContactState::kSlipMinus);
}

TEST(Preload, DoesNotDependOnTheStep) {
  const Scene scene = Block(0.8, 0.1, {{"b", 0.02, -1.0, true}});
  const Preload coarse = RunPreload(scene, 0.2), fine = RunPreload(scene, 0.04);
  ASSERT_TRUE(coarse.done && fine.done);
  EXPECT_LE(Distance(coarse.point, fine.point), kRounding);
  EXPECT_LE((coarse.point.forces - fine.point.forces).norm(), kRounding);
}

TEST(Preload, SaysWhenThereAreTooManyIncrements) {
  const Preload preload = RunPreload(Block(0.0, 0.5, {{"b", 0.3, -0.4, true}}), 0.01, 3);
  ExpectEnd(preload, EndReason::kMaxIncrements, "constant loads");
}

// Gives what it is told to give.
class FakeMethod : public PathMethod {
 public:
  FakeMethod(bool starts, Advance advance) : starts_(starts), advance_(std::move(advance)) {}
  std::optional<End> Start(const PathPoint&, IncrementFindings*) override {
    if (starts_) return std::nullopt;
    return End{EndReason::kPathEnd, {{"because"}}};
  }
  bool Resume(const ResumePoint&) override { return false; }
  Advance Next(const PathPoint&) override { return advance_; }

 private:
  bool starts_;
  Advance advance_;
};

TEST(Preload, EndOfTheMethodIsTheEndOfThePreload) {
  const Model model = ModelOf(Block(0.0, 0.5, {{"b", 0.0, 1.0, true}}));
  for (const EndReason reason : {EndReason::kCancelled, EndReason::kPathEnd, EndReason::kStepTooSmall}) {
    const Preload preload = TracePreload(model, 100, [&](const Model&, double) {
      Advance advance;
      advance.end = {reason, {{"because"}}};
      return std::make_unique<FakeMethod>(true, advance);
    });
    ExpectEnd(preload, reason, "because");
  }
}

TEST(Preload, EndsAtALimitPoint) {
  const Model model = ModelOf(Block(0.0, 0.5, {{"b", 0.0, 1.0, true}}));
  for (const IncrementKind kind : {IncrementKind::kSmoothLimit, IncrementKind::kCornerLimit}) {
    Advance advance;
    advance.increment.emplace();
    advance.increment->point = model.InitialPoint();
    advance.increment->point.s = 0.25 * model.structure.Loads().Constant().norm();
    advance.increment->kind = kind;
    const Preload preload =
        TracePreload(model, 100, [&](const Model&, double) { return std::make_unique<FakeMethod>(true, advance); });
    ExpectEnd(preload, EndReason::kPathEnd, "a limit point at 0.25 of");
  }
}

TEST(Preload, CanBeCancelled) {
  const Model model = ModelOf(Block(0.0, 0.5, {{"b", 0.0, 1.0, true}}));
  const Preload preload = TracePreload(
      model, 100, [](const Model&, double) { return std::make_unique<FakeMethod>(true, Advance()); },
      [] { return true; });
  ExpectEnd(preload, EndReason::kCancelled);
}

TEST(Preload, MethodThatCannotSetOutIsTheEndOfThePath) {
  const Model model = ModelOf(Block(0.0, 0.5, {{"b", 0.0, 1.0, true}}));
  const Preload preload =
      TracePreload(model, 100, [](const Model&, double) { return std::make_unique<FakeMethod>(false, Advance()); });
  ExpectEnd(preload, EndReason::kPathEnd, "because");
}

TEST(Preload, TheModelOfTheMethodLoadsWithTheConstantLoadsOnly) {
  const Model model = ModelOf(Block(0.0, 0.5, {{"b", 0.0, -3.0, true}}));
  bool asked = false;
  TracePreload(model, 1, [&](const Model& of, double) {
    asked = true;
    EXPECT_EQ(of.scene.loads.size(), 1u);
    EXPECT_EQ(of.structure.Loads().Constant().norm(), 0.0);
    EXPECT_EQ(of.structure.Loads().Reference()[0], 0.0);
    EXPECT_LT(of.structure.Loads().Reference()[1], 0.0);
    return std::make_unique<FakeMethod>(true, Advance());
  });
  EXPECT_TRUE(asked);
}

}  // namespace
}  // namespace contact_path::preload_test
