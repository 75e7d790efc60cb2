// Where paths cease to be stable.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/beams.h"
#include "support/traced_path.h"

namespace contact_path::onset_test {
namespace {

const double kPi = std::acos(-1.0);

struct Columns {
  std::vector<double> EI;  // of each; length 1
  double EA = 1e4;
  int segments = 12;
  bool platen = false;  // their clamped tops move down at once; else each top is free, with a dead load
};

TraceRequest RequestOf(const Columns& columns) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.name = "columns";
  Stage press;
  press.name = "press";
  for (std::size_t i = 0; i < columns.EI.size(); ++i) {
    const std::string foot = "foot" + std::to_string(i), top = "top" + std::to_string(i);
    const double x = 0.5 * static_cast<double>(i);
    scene.nodes.push_back({foot, x, 0.0, true, true});
    scene.nodes.back().fixed_rotation = true;
    scene.nodes.push_back({top, x, 1.0, columns.platen, columns.platen});
    scene.nodes.back().fixed_rotation = columns.platen;
    scene.beams.push_back(
        Between("column" + std::to_string(i), foot, top, columns.EA, columns.EI[i], columns.segments));
    if (columns.platen)
      press.support_motions.push_back({top, 0.0, -1.0});
    else
      scene.loads.push_back({top, 0.0, -1.0});
  }
  const double euler = (columns.platen ? 4.0 : 0.25) * kPi * kPi;
  if (columns.platen) {
    press.target = 2.0 * euler / columns.EA;
    request.program = {press};
  } else {
    request.options.stop = {{"load_factor", ">", 2.0 * euler}};
  }
  request.options.max_increments = 3000;
  return request;
}

const Increment* FirstUnstable(const TracedPath& path) {
  const auto found = std::find_if(path.increments.begin(), path.increments.end(), [](const Increment& increment) {
    return increment.stability.stability == Verdict::kUnstable;
  });
  return found == path.increments.end() ? nullptr : &*found;
}

// The load of each column at the first unstable increment, which must be on record as more than a regular one, with all
// increments before it stable and none behind it.
double OnsetOf(const Columns& columns) {
  const TracedPath path = TraceIncrements(RequestOf(columns));
  const Increment* const onset = FirstUnstable(path);
  EXPECT_NE(onset, nullptr) << path.result.message;
  if (onset == nullptr) return 0.0;
  EXPECT_NE(onset->kind, IncrementKind::kRegular);
  for (const Increment& increment : path.increments)
    EXPECT_EQ(increment.stability.stability == Verdict::kStable, increment.index < onset->index) << increment.index;
  return columns.platen ? columns.EA * onset->load_factor : onset->load_factor;
}

// Euler's load, to what straight segments are too stiff by, and to the shortening.
TEST(Onset, OfEqualColumnsIsEulersLoad) {
  for (const bool platen : {false, true})
    for (const int segments : {4, 12, 60})
      for (const double EA : {1e3, 1e5, 1e7}) {
        SCOPED_TRACE((platen ? "platen, " : "dead load, ") + std::to_string(segments) + " segments, EA " +
                     std::to_string(EA));
        Columns columns{{1.0}, EA, segments, platen};
        const double one = OnsetOf(columns), euler = (platen ? 4.0 : 0.25) * kPi * kPi;
        const double wave = (platen ? 2.0 : 0.5) * kPi / segments;
        EXPECT_NEAR(one, euler, euler * (0.15 * wave * wave + 3.0 * euler / EA));
        for (const std::size_t copies : {2U, 3U, 4U, 8U}) {
          if (segments == 60 && copies > 3) continue;
          columns.EI.assign(copies, 1.0);
          EXPECT_NEAR(OnsetOf(columns), one, 1e-8 * one) << copies;
        }
      }
}

// The softest one of several, however near the others are, of few and of many unknowns.
TEST(Onset, OfUnequalColumnsIsThatOfTheSoftest) {
  for (const bool platen : {false, true}) {
    Columns columns{{1.0}, 1e4, 20, platen};
    const double one = OnsetOf(columns);
    for (const double more : {1e-2, 1e-4}) {
      columns.EI = {1.0, 1.0 + more, 1.0 + 2.0 * more, 1.0 + 3.0 * more};
      EXPECT_NEAR(OnsetOf(columns), one, 1e-8 * one) << more;
    }
  }
  Columns many{std::vector<double>(17, 1.0), 1e4, 60, false};
  many.EI[7] = 0.9;
  const double load = OnsetOf(many);
  EXPECT_NEAR(load, OnsetOf({{0.9}, 1e4, 60, false}), 1e-8 * load);
}

// A foot slides up a slope, drawn by a load; a part that is not touched stands beside. EI: of the leg that slides; 0: a
// bar.
TraceRequest SlidingFoot(double friction, double EI, int idle) {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.name = "slope";
  scene.nodes = {{"l", -1.0, 0.0, true, true}, {"a", 0.0, 0.38225363323705064}, {"r", 1.0, 0.0}};
  scene.bars = {{{"l", "a"}, 1.0}};
  if (EI > 0.0) {
    scene.beams.push_back(Between("leg", "a", "r", 1.0, EI, 5));
    scene.beams.back().hinged = {true, true};
  } else {
    scene.bars.push_back({{"r", "a"}, 1.0});
  }
  scene.superelements = {{{"r"}, {2.58920966170029, 0.0, 0.0, 2.58920966170029}}};
  scene.loads = {{"a", 0.0, -1.0},
                 {"r", -0.02616129496928469, -0.027015297742618898, true},
                 {"r", -3.9316963685525654, 3.8074082842737496}};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 1.0, 0.0, 0.6956611180791222, 0.7183701057205161, friction}};
  scene.contacts = {{"r", "floor"}};
  if (idle > 0) {
    scene.nodes.push_back({"g", 5.0, 0.0, true, true});
    scene.nodes.back().fixed_rotation = true;
    scene.nodes.push_back({"e", 6.0, 0.0});
    scene.beams.push_back(Between("idle", "g", "e", 1.0, 1.0, idle));
  }
  request.options.stop = {{"a.y", "<", -0.19}};
  return request;
}

// The foot lets go before the load turns, or its leg buckles while it slides.
TEST(Onset, OfASlidingFootIsTheSameBesideIdleParts) {
  struct Foot {
    double friction, EI, load;
    IncrementKind kind;
  };
  for (const Foot& foot : {Foot{3.0, 0.0, 0.02074457017, IncrementKind::kOnset},
                           Foot{1.0, 2e-3, 0.011419149442, IncrementKind::kBifurcation},
                           Foot{2.0, 4e-3, 0.019307585923, IncrementKind::kBifurcation}})
    for (const int idle : {0, 3, 30}) {
      const TracedPath path = TraceIncrements(SlidingFoot(foot.friction, foot.EI, idle));
      const Increment* const onset = FirstUnstable(path);
      ASSERT_NE(onset, nullptr) << idle;
      EXPECT_EQ(onset->kind, foot.kind) << idle;
      EXPECT_NEAR(onset->load_factor, foot.load, 1e-9) << idle;
    }
}

// Where no contact slides, what dead loads leave stable a held displacement does, too: a node that its contacts hold
// stands under the load, whose compliance is rounding.
TEST(Onset, HeldLoadsAreNoWorseThanDeadOnes) {
  for (const char* const name :
       {"peg", "rough_truss", "sliding_bar", "von_mises", "press_slide_lift", "bistable_arch"}) {
    const TracedPath path = TraceIncrements(ReadExample(name));
    for (const Increment& increment : path.increments) {
      const bool slides = std::any_of(increment.contacts.begin(), increment.contacts.end(),
                                      [](const ContactRecord& contact) { return Slips(contact.state); });
      if (!slides && increment.stability.stability == Verdict::kStable) {
        EXPECT_EQ(increment.stability.stability_controlled, Verdict::kStable) << name << " " << increment.index;
      }
    }
  }
}

}  // namespace
}  // namespace contact_path::onset_test
