// Paths of which something was changed.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "contact_path/scene/validate.h"
#include "verify/verified.h"

namespace contact_path::verify_tampering_test {
namespace {

using Change = std::function<void(std::vector<Increment>&)>;

struct Tampering {
  const char* name;
  Change change;
  const char* found;  // in one of the findings
};

// A change of one increment, by its number or as it is found, or of all from one on.
Change At(std::size_t number, void (*change)(Increment&)) {
  return [=](std::vector<Increment>& increments) { change(increments[number]); };
}

Change At(std::size_t (*find)(const std::vector<Increment>&), void (*change)(Increment&)) {
  return [=](std::vector<Increment>& increments) { change(increments[find(increments)]); };
}

Change From(std::size_t first, void (*change)(Increment&)) {
  return [=](std::vector<Increment>& increments) {
    for (std::size_t i = first; i < increments.size(); ++i) change(increments[i]);
  };
}

const Tampering kTamperings[] = {
    {"Position", At(5, [](Increment& of) { of.positions[0] += 1e-7; }), "equilibrium residual"},
    {"LoadFactor", At(5, [](Increment& of) { of.load_factor *= 1.0 + 1e-6; }), "equilibrium residual"},
    {"NormalReaction", At(5, [](Increment& of) { of.contacts[0].rn += 1e-7; }), "equilibrium residual"},
    {"Gap", At(5, [](Increment& of) { of.contacts[0].gap += 1e-9; }), "recorded gap"},
    {"Residual", At(5, [](Increment& of) { of.residuals.friction_law = 1e-3; }),
     "friction law residual is recorded as"},
    {"StrainEnergy", At(5, [](Increment& of) { of.strain_energy += 1e-8; }), "strain energy is recorded as"},
    {"Dissipation", From(0, [](Increment& of) { of.dissipation *= 1.2; }), "dissipation, over F L, is off by"},
    {"DissipationAndWork",
     From(0,
          [](Increment& of) {
            of.external_work += of.dissipation;
            of.dissipation *= 2.0;
          }),
     "dissipation, over F L, is off by"},
    {"WorkAndEnergyShifted", From(9, [](Increment& of) { of.external_work += 1e-3; }),
     "work of the loads, over F L, is off by"},
    {"StatesRemoved",
     At(5,
        [](Increment& of) {
          of.positions.clear();
          of.contacts.clear();
        }),
     "has no state"},
    {"BranchesRemoved", At(FirstCorner, [](Increment& of) { of.event.branches.clear(); }), "an event without branches"},
    {"NoBranchTaken", At(FirstCorner, [](Increment& of) { of.event.taken = 0; }), "no branch is taken"},
    {"EventInvented", At(FirstRegular, [](Increment& of) { of.kind = IncrementKind::kContactEvent; }),
     "an event without branches"},
    {"BifurcationInvented", At(FirstRegular, [](Increment& of) { of.kind = IncrementKind::kBifurcation; }),
     "a bifurcation without the direction"},
    {"SaidToBeRegularised", At(5, [](Increment& of) { of.solve.exact = false; }), "not exact"},
    {"DissipationFalls", At(FirstSlipping, [](Increment& of) { of.dissipation = -1e-3; }), "dissipation falls"},
    {"ExternalWork", [](auto& increments) { increments.back().external_work += 0.1; }, "energy balance"},
    {"Stick", At(FirstSlipping, [](Increment& of) { of.contacts[0].state = ContactState::kStick; }), "as sticking"},
    {"SlipTheOtherWay", At(FirstSlipping, [](Increment& of) { of.contacts[0].state = ContactState::kSlipMinus; }),
     "as slipping backwards"},
    {"Open", At(FirstSlipping, [](Increment& of) { of.contacts[0].state = ContactState::kOpen; }), "as open"},
    {"RowLeftOut", [](auto& increments) { increments.erase(increments.begin() + 5); }, "increments are missing"},
    {"RowsExchanged", [](auto& increments) { std::swap(increments[5], increments[6]); }, "out of order"},
    {"LimitPointHidden", At(FirstCorner, [](Increment& of) { of.kind = IncrementKind::kRegular; }),
     "turns without a limit point"},
    {"LimitPointInvented", At(FirstRegular, [](Increment& of) { of.kind = IncrementKind::kSmoothLimit; }),
     "does not turn at the limit point"},
    {"EventHidden", At(FirstCorner, [](Increment& of) { of.kind = IncrementKind::kSmoothLimit; }),
     "change without an event"},
    {"OtherBranch", At(FirstCorner, [](Increment& of) { of.event.taken = 7; }), "is none of its"},
    {"OtherStates",
     At(FirstCorner,
        [](Increment& of) {
          EventRecord& event = of.event;
          event.branches[static_cast<std::size_t>(event.taken) - 1].states[0] = ContactState::kOpen;
        }),
     "not those of the branch taken"},
    {"ArcLengthFalls", [](auto& increments) { increments[6].arc_length = increments[4].arc_length; },
     "arc length falls"},
    {"ArcLengthTooLong", From(5, [](Increment& of) { of.arc_length += 1.0; }), "arc length is off by"},
    {"ArcLengthTooShort", From(0, [](Increment& of) { of.arc_length *= 0.9; }), "less than the chord"},
    {"NotFinite", At(5, [](Increment& of) { of.load_factor = std::numeric_limits<double>::quiet_NaN(); }),
     "not finite"},
    {"OtherScene", At(5, [](Increment& of) { of.positions.pop_back(); }), "not those of the scene"},
    {"ForcesRemoved", At(5, [](Increment& of) { of.boundaries.clear(); }), "not those of the scene"},
    {"MomentOfAnObstacle", [](auto& increments) { increments.back().boundaries[0].rm += 1e-6; },
     "rm of boundary 1 is recorded as"},
    {"ForceIsNoNumber", At(5, [](Increment& of) { of.boundaries[0].rx = std::numeric_limits<double>::infinity(); }),
     "not finite"},
    {"Pull",
     [](auto& increments) {
       for (auto& increment : increments) increment.contacts[0].rn = increment.contacts[0].rt = 0.0;
       increments[5].contacts[0].rn = -1e-12;
     },
     "pulls with"},
    {"Start", [](auto& increments) { increments[0].load_factor = 0.1; }, "is no start"},
    {"KindOfStart", [](auto& increments) { increments[0].kind = IncrementKind::kRegular; }, "is of the kind regular"},
    {"Nothing", [](auto& increments) { increments.clear(); }, "no increments"},
};

class Tampered : public testing::TestWithParam<Tampering> {};

TEST_P(Tampered, IsFound) {
  std::vector<Increment> increments = Genuine().increments;
  GetParam().change(increments);
  const Verification verification = VerifyPath(Genuine().request, increments);
  EXPECT_NE(Listed(verification).find(GetParam().found), std::string::npos) << Listed(verification);
}

INSTANTIATE_TEST_SUITE_P(VerifyPath, Tampered, testing::ValuesIn(kTamperings),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(VerifyPath, ForceOfASupportIsProved) {
  const TracedPath path = Traced("rough_truss", Method::kBranch);
  std::vector<Increment> increments = path.increments;
  ASSERT_FALSE(increments[5].supports.empty());
  increments[5].supports[0].ry += 1e-6;
  const Verification verification = VerifyPath(path.request, increments);
  EXPECT_NE(Listed(verification).find("ry of support 1 is recorded as"), std::string::npos) << Listed(verification);
}

// 117 components.
TEST(VerifyPath, FindsVerdictsOfFramesAnew) {
  TracedPath path = TraceIncrements(ReadExample("lee_frame"));
  const Verification verification = VerifyPath(path.request, path.increments);
  EXPECT_TRUE(verification.findings.empty()) << Listed(verification);
  EXPECT_GT(verification.proved_verdicts, 100);
  const auto recorded = std::count_if(path.increments.begin(), path.increments.end(), [](const Increment& increment) {
    return increment.stability.stability != Verdict::kNotProved;
  });
  EXPECT_EQ(verification.proved_verdicts + verification.open_verdicts, recorded);
  for (Increment& increment : path.increments) {
    Verdict& verdict = increment.stability.stability;
    verdict = verdict == Verdict::kStable ? Verdict::kUnstable : Verdict::kStable;
  }
  const Verification tampered = VerifyPath(path.request, path.increments);
  EXPECT_NE(Listed(tampered).find("is recorded as"), std::string::npos);
}

// On the rising and on the falling part of a path without contact.
TEST(VerifyPath, FindsVerdictsThatWereChanged) {
  const TracedPath path = Traced("von_mises", Method::kBranch);
  const std::size_t rising = FirstRegular(path.increments);
  const std::size_t falling = First(path.increments, [](const Increment& increment) {
    return increment.kind == IncrementKind::kRegular && increment.stability.stability == Verdict::kUnstable;
  });
  const auto found = [&](std::size_t increment, const std::function<void(StabilityRecord*)>& change) {
    std::vector<Increment> increments = path.increments;
    change(&increments[increment].stability);
    return Listed(VerifyPath(path.request, increments));
  };
  EXPECT_EQ(found(falling, [](auto*) {}), "");
  const auto expect = [&](std::size_t increment, const char* what,
                          const std::function<void(StabilityRecord*)>& change) {
    EXPECT_NE(found(increment, change).find(what), std::string::npos) << found(increment, change);
  };
  expect(rising, "is recorded as unstable, but is stable", [](auto* of) { of->stability = Verdict::kUnstable; });
  expect(falling, "is recorded as stable, but is unstable", [](auto* of) { of->stability = Verdict::kStable; });
  expect(falling, "unstable directions are recorded as 2, but are 1", [](auto* of) { of->unstable_directions = 2; });
  expect(falling, "under the machine it is recorded as unstable",
         [](auto* of) { of->stability_controlled = Verdict::kUnstable; });
  expect(falling, "the critical stiffness is recorded as", [](auto* of) { of->critical_stiffness *= 1.001; });
  expect(falling, "does not fall along the unstable direction", [](auto* of) {
    // To the side, which the bars hold.
    of->unstable_direction.assign(of->unstable_direction.size(), 0.0);
    of->unstable_direction[2] = 1.0;
  });
}

TEST(VerifyPath, FixedNodesRest) {
  const TracedPath path = Traced("sliding_bar", Method::kBranch);
  ASSERT_TRUE(path.request.scene.nodes[0].fixed_x);
  std::vector<Increment> increments = path.increments;
  increments[5].positions[0] += 1e-6;
  const Verification verification = VerifyPath(path.request, increments);
  const std::string wanted = "increment 5: support " + path.request.scene.nodes[0].name + " is not where it has to be";
  EXPECT_NE(Listed(verification).find(wanted), std::string::npos) << Listed(verification);
}

TEST(VerifyPath, AnotherSceneIsNotProved) {
  TraceRequest request = Genuine().request;
  request.scene.obstacles[0].friction *= 1.01;
  EXPECT_FALSE(VerifyPath(request, Genuine().increments).findings.empty());
}

TEST(VerifyPath, RowsWithoutStateAreCounted) {
  std::vector<Increment> increments = Genuine().increments;
  int left = 0;
  for (Increment& increment : increments)
    if (increment.kind == IncrementKind::kRegular && increment.index % 4 != 0) {
      increment.positions.clear();
      increment.contacts.clear();
      ++left;
    }
  ASSERT_GT(left, 10);
  TraceRequest request = Genuine().request;
  EXPECT_NE(Listed(VerifyPath(request, increments)).find("has no state"), std::string::npos);
  request.options.full_state_every = 4;
  const Verification verification = VerifyPath(request, increments);
  EXPECT_TRUE(verification.findings.empty()) << Listed(verification);
  EXPECT_EQ(verification.full_increments, verification.increments - left);
}

TEST(VerifyPath, EndsWhereTheCallerWantsNoMore) {
  int asked = 0;
  const auto interrupt = [&asked] {
    if (++asked == 5) throw std::runtime_error("enough");
  };
  EXPECT_THROW(VerifyPath(Genuine().request, Genuine().increments, interrupt), std::runtime_error);
  EXPECT_EQ(asked, 5);
}

TEST(VerifyPath, FindingsHaveAnEnd) {
  std::vector<Increment> increments = Genuine().increments;
  for (Increment& increment : increments) increment.load_factor += 1.0;
  EXPECT_EQ(VerifyPath(Genuine().request, increments).findings.size(), kMostLines);
}

}  // namespace
}  // namespace contact_path::verify_tampering_test
