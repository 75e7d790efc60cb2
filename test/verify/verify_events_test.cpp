#include "contact_path/verify/verify_path.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "branch/example_scenes.h"
#include "contact_path/scene/program.h"
#include "contact_path/scene/validate.h"
#include "support/traced_path.h"

namespace contact_path::verify_events_test {
namespace {

// Of the increments alone: what they show is not looked at.
std::string Events(const TraceRequest& request, const std::vector<Increment>& increments) {
  std::vector<Finding> findings;
  VerifyEvents(request, increments, std::vector<double>(NumStages(request), 1.0), &findings);
  std::string text;
  for (const Finding& finding : findings) text += std::to_string(finding.increment) + ": " + finding.what + '\n';
  return text;
}

// A truss of half span 1 and rise 3, which sways to one side: a bifurcation.
TraceRequest HighTruss() {
  TraceRequest request;
  request.scene = tall_truss::MakeScene(3.0);
  request.options.max_increments = 60;
  return request;
}

TEST(VerifyEvents, ProvesWhatBothMethodsTrace) {
  for (const char* scene : {"sliding_bar", "von_mises", "rough_truss", "two_dof_friction", "rigid_stop", "arch19",
                            "stick_slip_cycle", "press_slide_lift", "gripper"})
    for (const Method method : {Method::kBranch, Method::kMpec})
      for (const Accuracy accuracy : {Accuracy::kFast, Accuracy::kBalanced, Accuracy::kAccurate}) {
        if (method == Method::kMpec && accuracy != Accuracy::kBalanced) continue;
        TraceRequest request = ReadExample(scene);
        request.options.method = method;
        request.options.accuracy = accuracy;
        EXPECT_EQ(Events(request, TraceIncrements(request).increments), "") << scene;
      }
}

TEST(VerifyEvents, ProvesChosenBranches) {
  for (const int branch : {1, 2, 3}) {
    TraceRequest request = HighTruss();
    request.options.branch_choices = {{1, 0, branch}};
    EXPECT_EQ(Events(request, TraceIncrements(request).increments), "") << branch;
  }
  TraceRequest request = ReadExample("rough_truss");
  request.options.branch_choices = {{0, 25, 2}};
  EXPECT_EQ(Events(request, TraceIncrements(request).increments), "");
}

// A path with corners, slip both ways and contact events, one with a bifurcation.
const TracedPath& Corners() {
  static const TracedPath path = TraceIncrements(ReadExample("two_dof_friction"));
  return path;
}
const TracedPath& Crossed() {
  static const TracedPath path = TraceIncrements(HighTruss());
  return path;
}

struct Tampering {
  const char* name;
  const TracedPath& (*path)();
  std::function<void(std::vector<Increment>&)> change;
  const char* found;
};

Increment& Of(std::vector<Increment>& increments, IncrementKind kind) {
  for (Increment& increment : increments)
    if (increment.kind == kind) return increment;
  ADD_FAILURE() << "no such increment";
  return increments[0];
}
Increment& Corner(std::vector<Increment>& increments) { return Of(increments, IncrementKind::kCornerLimit); }
BranchRecord& Taken(std::vector<Increment>& increments) { return Corner(increments).event.branches.at(0); }

const Tampering kTamperings[] = {
    {"Method", Corners, [](auto& increments) { increments[7].solve.method = Method::kMpec; }, "is of the method mpec"},
    {"Number", Corners, [](auto& increments) { Corner(increments).event.number = 3; }, "is event 3"},
    {"NoNumber", Corners, [](auto& increments) { Corner(increments).event.number = 0; }, "that no choice asks for"},
    {"LoadRate", Corners, [](auto& increments) { Taken(increments).load_rate *= -1.0; }, "has the load rate"},
    {"LoadRateBeyondOne", Corners, [](auto& increments) { Taken(increments).load_rate = 1.5; }, "a load rate beyond 1"},
    {"DissipationRate", Corners, [](auto& increments) { Taken(increments).dissipation_rate *= 3.0; },
     "has the dissipation rate"},
    {"DissipationRateNegative", Corners, [](auto& increments) { Taken(increments).dissipation_rate = -0.1; },
     "a negative dissipation rate"},
    {"Turn", Corners, [](auto& increments) { Taken(increments).turn = 0.1; }, "the branch taken turns by"},
    {"TurnOfStart", Corners, [](auto& increments) { increments[0].event.branches.at(0).turn += 0.1; },
     "the angle to the load"},
    {"OtherTaken", Corners,
     [](auto& increments) {
       Corner(increments).event.branches.push_back(Taken(increments));
       Corner(increments).event.taken = 2;
     },
     "branch 2 is taken, but 1 is wanted"},
    {"Order", Corners,
     [](auto& increments) {
       Corner(increments).event.branches.push_back(Taken(increments));
       Corner(increments).event.branches[1].dissipation_rate += 0.01;
     },
     "not in the order of branch_rule"},
    {"OpenContactClosed", Corners, [](auto& increments) { Corner(increments).contacts[0].gap = 1.0; },
     "closes an open contact"},
    {"DeterminantSign", Corners, [](auto& increments) { increments[5].solve.determinant_sign *= -1; },
     "but there is no bifurcation"},
    {"UnstableDirections", Crossed, [](auto& increments) { increments[5].stability.unstable_directions += 1; },
     "the number of unstable directions"},
    {"BifurcationHidden", Crossed,
     [](auto& increments) {
       Increment& crossing = Of(increments, IncrementKind::kBifurcation);
       const int index = crossing.index;
       crossing.kind = IncrementKind::kRegular;
       crossing.event = EventRecord();
       crossing.solve.determinant_sign = increments[static_cast<std::size_t>(index) - 1].solve.determinant_sign;
     },
     "but there is no bifurcation"},
};

class TamperedEvents : public testing::TestWithParam<Tampering> {};

TEST_P(TamperedEvents, AreFound) {
  const TracedPath& path = GetParam().path();
  std::vector<Increment> increments = path.increments;
  GetParam().change(increments);
  EXPECT_NE(Events(path.request, increments).find(GetParam().found), std::string::npos)
      << Events(path.request, increments);
}

INSTANTIATE_TEST_SUITE_P(VerifyEvents, TamperedEvents, testing::ValuesIn(kTamperings),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(VerifyEvents, FindingsHaveAnEnd) {
  std::vector<Increment> increments = Corners().increments;
  for (Increment& increment : increments) increment.solve.method = Method::kMpec;
  std::vector<Finding> findings;
  VerifyEvents(Corners().request, increments, std::vector<double>(NumStages(Corners().request), 1.0), &findings);
  EXPECT_EQ(findings.size(), kMostLines);
}

}  // namespace
}  // namespace contact_path::verify_events_test
