#include "contact_path/path/csv.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdlib>
#include <iomanip>
#include <limits>
#include <locale>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace contact_path::csv_test {
namespace {

TraceRequest TwoNodes() {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.nodes = {{"b", 0.0, 0.0, false, false}, {"a", 1.0, 0.0, false, false}};
  scene.contacts = {{"b", "wall"}, {"b", "floor"}};
  return request;
}

TraceRequest Program() {
  TraceRequest request = TwoNodes();
  request.program.resize(2);
  return request;
}

Increment FullIncrement() {
  Increment increment;
  increment.index = 1234567;
  increment.load_factor = 0.5;
  increment.arc_length = 2.0;
  increment.kind = IncrementKind::kCornerLimit;
  increment.positions = {-1.0, 0.25, 3.0, -4.5};
  increment.contacts = {{0.125, 0.0, 0.0, ContactState::kOpen}, {0.0, 8.0, -2.0, ContactState::kSlipPlus}};
  increment.dissipation = 16.0;
  increment.strain_energy = 32.0;
  increment.external_work = 77.0;
  increment.residuals.equilibrium = 64.0;
  increment.residuals.tensile_reaction = 128.0;
  increment.residuals.friction_law = 256.0;
  increment.solve.time = 512.0;
  increment.stability = {Verdict::kUnstable, Verdict::kNotProved, 2, 1.5, {0.0, 1.0, 0.0, 0.0}};
  increment.jump = {0.75, true};
  return increment;
}

constexpr char kFullIncrement[] =
    "1234567,0.5,2,corner_limit,-1,0.25,3,-4.5,0.125,0,0,open,0,8,-2,slip+,16,32,64,256,512,unstable,not_proved,2,1."
    "5\n";

std::string Header(const TraceRequest& request) {
  std::ostringstream out;
  CsvWriter(request).WriteHeader(out);
  return out.str();
}

std::string Row(const Increment& increment, const TraceRequest& request = TwoNodes()) {
  std::ostringstream out;
  CsvWriter(request).WriteRow(increment, out);
  return out.str();
}

std::vector<std::string> Cells(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

TEST(CsvHeader, NamesNodesAndContactsInSceneOrder) {
  EXPECT_EQ(Header(TwoNodes()),
            "index,load_factor,arc_length,kind,x_b,y_b,x_a,y_a,gap_b@wall,rn_b@wall,rt_b@wall,state_b@wall,"
            "gap_b@floor,rn_b@floor,rt_b@floor,state_b@floor,dissipation,strain_energy,equilibrium_residual,"
            "complementarity_residual,solve_time,stability,stability_controlled,unstable_directions,"
            "critical_stiffness\n");
}

TEST(CsvHeader, HasVerdictsAndJumpsAsTheOptionsSay) {
  const std::size_t columns = Cells(kFullIncrement).size();
  TraceRequest request = TwoNodes();
  const auto line = [&](bool header) { return Cells(header ? Header(request) : Row(FullIncrement(), request)); };
  request.options.at_limit = AtLimit::kJump;
  EXPECT_EQ(line(true).size(), columns + 1);
  EXPECT_EQ(line(false).size(), columns + 1);
  request.options.landing_checks = true;
  ASSERT_EQ(line(true).size(), columns + 2);
  EXPECT_EQ(line(true)[columns], "energy_released");
  EXPECT_EQ(line(true)[columns + 1], "landing_robust\n");
  EXPECT_EQ(line(false)[columns], "0.75");
  EXPECT_EQ(line(false)[columns + 1], "1\n");
  request.options = {};
  request.options.stability = DefaultTrue::kFalse;
  EXPECT_EQ(line(true).size(), columns - 4);
  EXPECT_EQ(line(false).size(), columns - 4);
}

TEST(CsvRow, HasAllColumnsInTheOrderOfTheHeader) {
  EXPECT_EQ(Row(FullIncrement()), kFullIncrement);
  EXPECT_EQ(Cells(Header(TwoNodes())).size(), Cells(kFullIncrement).size());
}

TEST(CsvRow, HasTheStageOfAProgramBehindTheTime) {
  const std::vector<std::string> header = Cells(Header(Program()));
  Increment increment = FullIncrement();
  increment.stage = 2;
  const std::vector<std::string> row = Cells(Row(increment, Program()));
  const std::size_t stage = header.size() - 5;
  EXPECT_EQ(header[stage], "stage");
  EXPECT_EQ(row[stage], "2");
  EXPECT_EQ(header.size(), row.size());
}

TEST(CsvRow, WithoutContacts) {
  TraceRequest request = TwoNodes();
  request.scene.contacts.clear();
  Increment increment;
  increment.positions = {1.0, 2.0, 3.0, 4.0};
  EXPECT_EQ(Row(increment, request), "0,0,0,regular,1,2,3,4,0,0,0,0,0,,,-1,-1\n");
}

TEST(CsvRow, NumbersReadBackExactly) {
  using Limits = std::numeric_limits<double>;
  const std::vector<double> numbers{0.1,
                                    1.0 / 3.0,
                                    -2.191505308361854,
                                    1e-300,
                                    123456789012345678.0,
                                    Limits::max(),
                                    Limits::min(),
                                    Limits::denorm_min(),
                                    1.0 + Limits::epsilon(),
                                    -0.0};
  TraceRequest request;
  for (std::size_t i = 0; 2 * i < numbers.size(); ++i) request.scene.nodes.push_back({"n" + std::to_string(i)});
  Increment increment;
  increment.positions = numbers;
  increment.load_factor = 2.0 / 3.0;
  const std::vector<std::string> cells = Cells(Row(increment, request));
  EXPECT_EQ(std::strtod(cells[1].c_str(), nullptr), 2.0 / 3.0);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    EXPECT_EQ(std::strtod(cells[4 + i].c_str(), nullptr), numbers[i]) << cells[4 + i];
  }
  EXPECT_EQ(cells[4], "0.10000000000000001");
}

TEST(CsvRow, KindsAndStatesHaveTheirWords) {
  const std::pair<IncrementKind, const char*> kinds[] = {{IncrementKind::kStart, "start"},
                                                         {IncrementKind::kRegular, "regular"},
                                                         {IncrementKind::kSmoothLimit, "smooth_limit"},
                                                         {IncrementKind::kCornerLimit, "corner_limit"},
                                                         {IncrementKind::kContactEvent, "contact_event"},
                                                         {IncrementKind::kBifurcation, "bifurcation"},
                                                         {IncrementKind::kSample, "sample"},
                                                         {IncrementKind::kOnset, "onset"},
                                                         {IncrementKind::kJump, "jump"}};
  for (const auto& [kind, word] : kinds) {
    Increment increment = FullIncrement();
    increment.kind = kind;
    EXPECT_EQ(Cells(Row(increment))[3], word);
  }
  const std::pair<ContactState, const char*> states[] = {{ContactState::kOpen, "open"},
                                                         {ContactState::kStick, "stick"},
                                                         {ContactState::kSlipPlus, "slip+"},
                                                         {ContactState::kSlipMinus, "slip-"},
                                                         {ContactState::kClosed, "closed"}};
  for (const auto& [state, word] : states) {
    Increment increment = FullIncrement();
    increment.contacts[0].state = state;
    EXPECT_EQ(Cells(Row(increment))[11], word);
  }
}

// Decimal comma and grouped thousands, as many people's systems have them.
class CommaNumbers : public std::numpunct<char> {
 protected:
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(CsvRow, DoesNotDependOnLocaleOrFlagsOfTheStream) {
  const std::locale commas(std::locale::classic(), new CommaNumbers);
  const std::locale before = std::locale::global(commas);
  std::ostringstream out;
  out << std::fixed << std::setprecision(1) << std::showpos << std::hex;
  CsvWriter(TwoNodes()).WriteRow(FullIncrement(), out);
  std::locale::global(before);
  EXPECT_EQ(out.str(), kFullIncrement);
}

TEST(Csv, ErrorsAreLeftInTheStream) {
  std::ostream closed(nullptr);
  closed.clear();
  CsvWriter(TwoNodes()).WriteHeader(closed);
  EXPECT_FALSE(closed.good());
  closed.clear();
  CsvWriter(TwoNodes()).WriteRow(FullIncrement(), closed);
  EXPECT_FALSE(closed.good());
}

}  // namespace
}  // namespace contact_path::csv_test
