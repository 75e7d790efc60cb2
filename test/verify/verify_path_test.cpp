#include "contact_path/verify/verify_path.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "support/traced_path.h"

namespace contact_path {
namespace {

TracedPath Traced(const std::string& scene, Method method) {
  TraceRequest request = ReadExample(scene);
  request.options.method = method;
  if (method == Method::kMpec) request.options.step = 0.05;
  return TraceRows(request);
}

std::string Listed(const Verification& verification) {
  std::string text;
  for (const Finding& finding : verification.findings)
    text += "row " + std::to_string(finding.row) + ": " + finding.what + '\n';
  return text;
}

TEST(VerifyPath, ProvesWhatBothMethodsTrace) {
  for (const char* scene : {"sliding_bar", "von_mises", "rough_truss", "two_dof_friction", "rigid_stop", "arch19"})
    for (const Method method : {Method::kBranch, Method::kMpec}) {
      SCOPED_TRACE(scene);
      const TracedPath path = Traced(scene, method);
      const Verification verification = VerifyPath(path.request, path.rows);
      EXPECT_TRUE(verification.findings.empty()) << Listed(verification);
      EXPECT_EQ(verification.rows, static_cast<int>(path.rows.size()));
      EXPECT_EQ(verification.full_rows, verification.rows);
      EXPECT_EQ(verification.exact_rows, verification.rows);
      EXPECT_LE(verification.exact.equilibrium, 1e-12);
      EXPECT_LE(verification.exact.Contact(), 1e-11);
      EXPECT_GT(verification.work, 0.0);
    }
}

// Where a node cannot move along an obstacle, there is no friction, whatever its coefficient.
TEST(VerifyPath, ProvesContactsThatCannotSlide) {
  TraceRequest request = ReadExample("rigid_stop");
  for (Obstacle& obstacle : request.scene.obstacles) obstacle.friction = 0.3;
  const TracedPath path = TraceRows(request);
  EXPECT_EQ(path.rows.back().contacts[0].state, ContactState::kClosed);
  const Verification verification = VerifyPath(path.request, path.rows);
  EXPECT_TRUE(verification.findings.empty()) << Listed(verification);
}

// A path with slip both ways, corners and contact events.
const TracedPath& Genuine() {
  static const TracedPath path = Traced("two_dof_friction", Method::kBranch);
  return path;
}

struct Tampering {
  const char* name;
  std::function<void(std::vector<Increment>&)> change;
  const char* found;  // in one of the findings
};

std::size_t First(const std::vector<Increment>& rows, const std::function<bool(const Increment&)>& is) {
  for (std::size_t i = 1; i + 2 < rows.size(); ++i)
    if (is(rows[i])) return i;
  ADD_FAILURE() << "no such row";
  return 1;
}

std::size_t FirstSlipping(const std::vector<Increment>& rows) {
  return First(rows, [](const Increment& row) {
    return row.kind == RowKind::kRegular && row.contacts[0].state == ContactState::kSlipPlus;
  });
}

std::size_t FirstRegular(const std::vector<Increment>& rows) {
  return First(rows, [](const Increment& row) { return row.kind == RowKind::kRegular; });
}

std::size_t FirstCorner(const std::vector<Increment>& rows) {
  return First(rows, [](const Increment& row) { return row.kind == RowKind::kCornerLimit; });
}

const Tampering kTamperings[] = {
    {"Position", [](auto& rows) { rows[5].positions[0] += 1e-7; }, "equilibrium residual"},
    {"LoadFactor", [](auto& rows) { rows[5].load_factor *= 1.0 + 1e-6; }, "equilibrium residual"},
    {"NormalReaction", [](auto& rows) { rows[5].contacts[0].rn += 1e-7; }, "equilibrium residual"},
    {"Gap", [](auto& rows) { rows[5].contacts[0].gap += 1e-9; }, "recorded gap"},
    {"Residual", [](auto& rows) { rows[5].residuals.friction_law = 1e-3; }, "friction law residual is recorded as"},
    {"StrainEnergy", [](auto& rows) { rows[5].strain_energy += 1e-8; }, "strain energy is recorded as"},
    {"Dissipation",
     [](auto& rows) {
       for (auto& row : rows) row.dissipation *= 1.2;
     },
     "dissipation is off by"},
    {"DissipationAndWork",
     [](auto& rows) {
       for (auto& row : rows) {
         row.external_work += row.dissipation;
         row.dissipation *= 2.0;
       }
     },
     "dissipation is off by"},
    {"WorkAndEnergyShifted",
     [](auto& rows) {
       for (std::size_t i = 9; i < rows.size(); ++i) rows[i].external_work += 1e-3;
     },
     "work of the loads is off by"},
    {"StatesRemoved",
     [](auto& rows) {
       rows[5].positions.clear();
       rows[5].contacts.clear();
     },
     "has no state"},
    {"WaysRemoved", [](auto& rows) { rows[FirstCorner(rows)].event.ways.clear(); }, "an event without ways on"},
    {"NoWayTaken", [](auto& rows) { rows[FirstCorner(rows)].event.taken = -1; }, "no way is taken"},
    {"EventInvented", [](auto& rows) { rows[FirstRegular(rows)].kind = RowKind::kContactEvent; },
     "an event without ways on"},
    {"BifurcationInvented", [](auto& rows) { rows[FirstRegular(rows)].kind = RowKind::kBifurcation; },
     "a bifurcation has a direction"},
    {"SaidToBeRegularised", [](auto& rows) { rows[5].solve.exact = false; }, "not exact"},
    {"DissipationFalls", [](auto& rows) { rows[FirstSlipping(rows)].dissipation = -1e-3; }, "dissipation falls"},
    {"ExternalWork", [](auto& rows) { rows.back().external_work += 0.1; }, "energy balance"},
    {"Stick", [](auto& rows) { rows[FirstSlipping(rows)].contacts[0].state = ContactState::kStick; }, "as sticking"},
    {"SlipTheOtherWay", [](auto& rows) { rows[FirstSlipping(rows)].contacts[0].state = ContactState::kSlipMinus; },
     "as slipping backwards"},
    {"Open", [](auto& rows) { rows[FirstSlipping(rows)].contacts[0].state = ContactState::kOpen; }, "as open"},
    {"RowLeftOut", [](auto& rows) { rows.erase(rows.begin() + 5); }, "rows are missing"},
    {"RowsExchanged", [](auto& rows) { std::swap(rows[5], rows[6]); }, "out of order"},
    {"LimitPointHidden", [](auto& rows) { rows[FirstCorner(rows)].kind = RowKind::kRegular; },
     "turns without a limit point"},
    {"LimitPointInvented", [](auto& rows) { rows[FirstRegular(rows)].kind = RowKind::kSmoothLimit; },
     "does not turn at the limit point"},
    {"EventHidden", [](auto& rows) { rows[FirstCorner(rows)].kind = RowKind::kSmoothLimit; },
     "change without an event"},
    {"OtherWay", [](auto& rows) { rows[FirstCorner(rows)].event.taken = 7; }, "is none of its"},
    {"OtherStates",
     [](auto& rows) {
       EventRecord& event = rows[FirstCorner(rows)].event;
       event.ways[static_cast<std::size_t>(event.taken)].states[0] = ContactState::kOpen;
     },
     "not those of the way taken"},
    {"ArcLengthFalls", [](auto& rows) { rows[6].arc_length = rows[4].arc_length; }, "arc length falls"},
    {"ArcLengthTooLong",
     [](auto& rows) {
       for (std::size_t i = 5; i < rows.size(); ++i) rows[i].arc_length += 1.0;
     },
     "more than a curve"},
    {"ArcLengthTooShort",
     [](auto& rows) {
       for (auto& row : rows) row.arc_length *= 0.9;
     },
     "less than the chord"},
    {"NotFinite", [](auto& rows) { rows[5].load_factor = std::numeric_limits<double>::quiet_NaN(); }, "not finite"},
    {"OtherScene", [](auto& rows) { rows[5].positions.pop_back(); }, "not those of the scene"},
    {"Start", [](auto& rows) { rows[0].load_factor = 0.1; }, "is no start"},
    {"KindOfStart", [](auto& rows) { rows[0].kind = RowKind::kRegular; }, "is of the kind regular"},
    {"Nothing", [](auto& rows) { rows.clear(); }, "no rows"},
};

class Tampered : public testing::TestWithParam<Tampering> {};

TEST_P(Tampered, IsFound) {
  std::vector<Increment> rows = Genuine().rows;
  GetParam().change(rows);
  const Verification verification = VerifyPath(Genuine().request, rows);
  EXPECT_NE(Listed(verification).find(GetParam().found), std::string::npos) << Listed(verification);
}

INSTANTIATE_TEST_SUITE_P(VerifyPath, Tampered, testing::ValuesIn(kTamperings),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(VerifyPath, LongIncrementsThatCutCornersAreProved) {
  TraceRequest request = ReadExample("sliding_bar");
  request.options.method = Method::kMpec;
  request.options.step = 0.2;
  const TracedPath path = TraceRows(request);
  const Verification verification = VerifyPath(path.request, path.rows);
  EXPECT_TRUE(verification.findings.empty()) << Listed(verification);
}

TEST(VerifyPath, FarFromTheOriginIsRounding) {
  for (const char* scene : {"sliding_bar", "von_mises"}) {
    TraceRequest request = ReadExample(scene);
    for (Node& node : request.scene.nodes) node.x += 1e5;
    for (Obstacle& obstacle : request.scene.obstacles) obstacle.px += 1e5;
    request.options.stop.clear();
    request.options.max_increments = 60;
    const TracedPath path = TraceRows(request);
    ASSERT_EQ(path.rows.size(), 61U);
    const Verification verification = VerifyPath(path.request, path.rows);
    EXPECT_TRUE(verification.findings.empty()) << Listed(verification);
  }
}

TEST(VerifyPath, FixedNodesRest) {
  const TracedPath path = Traced("sliding_bar", Method::kBranch);
  ASSERT_TRUE(path.request.scene.nodes[0].fixed_x);
  std::vector<Increment> rows = path.rows;
  rows[5].positions[0] += 1e-6;
  const Verification verification = VerifyPath(path.request, rows);
  const std::string wanted = "row 5: support " + path.request.scene.nodes[0].name + " is not where it has to be";
  EXPECT_NE(Listed(verification).find(wanted), std::string::npos) << Listed(verification);
}

TEST(VerifyPath, AnotherSceneIsNotProved) {
  TraceRequest request = Genuine().request;
  request.scene.obstacles[0].friction *= 1.01;
  EXPECT_FALSE(VerifyPath(request, Genuine().rows).findings.empty());
}

TEST(VerifyPath, RowsWithoutStateAreCounted) {
  std::vector<Increment> rows = Genuine().rows;
  int left = 0;
  for (Increment& row : rows)
    if (row.kind == RowKind::kRegular && row.index % 4 != 0) {
      row.positions.clear();
      row.contacts.clear();
      ++left;
    }
  ASSERT_GT(left, 10);
  TraceRequest request = Genuine().request;
  EXPECT_NE(Listed(VerifyPath(request, rows)).find("has no state"), std::string::npos);
  request.options.full_state_every = 4;
  const Verification verification = VerifyPath(request, rows);
  EXPECT_TRUE(verification.findings.empty()) << Listed(verification);
  EXPECT_EQ(verification.full_rows, verification.rows - left);
}

TEST(VerifyPath, FindingsHaveAnEnd) {
  std::vector<Increment> rows = Genuine().rows;
  for (Increment& row : rows) row.load_factor += 1.0;
  EXPECT_EQ(VerifyPath(Genuine().request, rows).findings.size(), static_cast<std::size_t>(kMostFindings));
}

}  // namespace
}  // namespace contact_path
