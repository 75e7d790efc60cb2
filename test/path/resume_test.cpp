// A trace that was cut short and gone on with is the one without interruption.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "contact_path/verify/verify_path.h"
#include "support/traced_path.h"

namespace contact_path {
namespace {

TracedPath Resume(const TraceRequest& request, std::vector<Increment> rows) {
  TracedPath path;
  path.request = request;
  TraceControl control;
  control.on_increment = [&](const Increment& row) { path.rows.push_back(row); };
  path.result = ResumeTrace(request, rows, control);
  return path;
}

void ExpectSamePath(const TracedPath& whole, const TracedPath& resumed, double tolerance, const std::string& where) {
  ASSERT_EQ(whole.rows.size(), resumed.rows.size()) << where;
  EXPECT_EQ(whole.result.reason, resumed.result.reason) << where;
  EXPECT_EQ(whole.result.message, resumed.result.message) << where;
  double worst = 0.0;
  for (std::size_t i = 0; i < whole.rows.size(); ++i) {
    const Increment &a = whole.rows[i], &b = resumed.rows[i];
    EXPECT_EQ(a.index, b.index) << where;
    EXPECT_EQ(a.stage, b.stage) << where;
    EXPECT_EQ(a.kind, b.kind) << where << ", row " << i;
    EXPECT_EQ(a.event.number, b.event.number) << where << ", row " << i;
    EXPECT_EQ(a.event.taken, b.event.taken) << where << ", row " << i;
    // Where the structure has come loose, and no way is taken, rounding names its motions.
    if (a.event.taken >= 0) {
      EXPECT_EQ(a.event.ways.size(), b.event.ways.size()) << where << ", row " << i;
    }
    for (std::size_t k = 0; k < a.positions.size(); ++k)
      worst = std::max(worst, std::abs(a.positions[k] - b.positions[k]));
    for (std::size_t k = 0; k < a.contacts.size(); ++k) {
      EXPECT_EQ(a.contacts[k].state, b.contacts[k].state) << where << ", row " << i;
      worst = std::max(
          {worst, std::abs(a.contacts[k].rn - b.contacts[k].rn), std::abs(a.contacts[k].rt - b.contacts[k].rt)});
    }
    worst = std::max({worst, std::abs(a.load_factor - b.load_factor), std::abs(a.arc_length - b.arc_length),
                      std::abs(a.dissipation - b.dissipation), std::abs(a.external_work - b.external_work)});
  }
  EXPECT_LE(worst, tolerance) << where;
}

TEST(Resume, FromAnyRowOfAnyExampleByBranch) {
  for (const char* name : {"sliding_bar", "von_mises", "rough_truss", "two_dof_friction", "rigid_stop",
                           "stick_slip_cycle", "press_slide_lift", "gripper"}) {
    const TraceRequest request = ReadExample(name);
    const TracedPath whole = TraceRows(request);
    const std::size_t stride = whole.rows.size() / 40 + 1;
    for (std::size_t cut = 1; cut <= whole.rows.size(); cut += stride) {
      const std::vector<Increment> rows(whole.rows.begin(), whole.rows.begin() + static_cast<std::ptrdiff_t>(cut));
      ExpectSamePath(whole, Resume(request, rows), 1e-9, std::string(name) + " after " + std::to_string(cut));
    }
    for (const Finding& finding : VerifyPath(request, Resume(request, whole.rows).rows).findings)
      ADD_FAILURE() << name << ", row " << finding.row << ": " << finding.what;
  }
}

TEST(Resume, ByMpec) {
  for (const char* name : {"sliding_bar", "stick_slip_cycle"}) {
    TraceRequest request = ReadExample(name);
    request.options.method = Method::kMpec;
    const TracedPath whole = TraceRows(request);
    for (std::size_t cut = 1; cut <= whole.rows.size(); cut += whole.rows.size() / 6 + 1) {
      const std::vector<Increment> rows(whole.rows.begin(), whole.rows.begin() + static_cast<std::ptrdiff_t>(cut));
      ExpectSamePath(whole, Resume(request, rows), 1e-9, std::string(name) + " after " + std::to_string(cut));
    }
  }
}

TEST(Resume, KeepsRowsAsTheyAre) {
  const TraceRequest request = ReadExample("sliding_bar");
  std::vector<Increment> rows = TraceRows(request).rows;
  rows.resize(20);
  const TracedPath resumed = Resume(request, rows);
  int kept = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) kept += resumed.rows[i].solve.time == rows[i].solve.time ? 1 : 0;
  EXPECT_GE(kept, 15);
}

TEST(Resume, MoreIncrementsThanWereWanted) {
  TraceRequest request = ReadExample("sliding_bar");
  const TracedPath whole = TraceRows(request);
  request.options.max_increments = 17;
  const TracedPath part = TraceRows(request);
  ASSERT_EQ(part.rows.size(), 18u);
  request.options.max_increments = 0;
  ExpectSamePath(whole, Resume(request, part.rows), 1e-9, "after max_increments");
}

TEST(Resume, OfNothingIsATrace) {
  const TraceRequest request = ReadExample("sliding_bar");
  ExpectSamePath(TraceRows(request), Resume(request, {}), 0.0, "nothing");
}

TEST(Resume, RowsWithoutStateAreGoneOnFromTheLastWithIt) {
  for (const Method method : {Method::kBranch, Method::kMpec}) {
    TraceRequest request = ReadExample("sliding_bar");
    request.options.method = method;
    const TracedPath whole = TraceRows(request);
    std::vector<Increment> rows = whole.rows;
    rows.resize(whole.rows.size() / 2);
    for (Increment& row : rows)
      if (row.kind == RowKind::kRegular && row.index % 4 != 0) {
        row.positions.clear();
        row.contacts.clear();
      }
    TracedPath resumed = Resume(request, rows);
    ASSERT_EQ(resumed.rows.size(), whole.rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (resumed.rows[i].positions.empty()) resumed.rows[i] = whole.rows[i];  // left out, not other
    ExpectSamePath(whole, resumed, 1e-9, std::string(ToString(method)));
  }
}

TEST(Resume, RowsOfSomethingElseAreRefused) {
  const TraceRequest request = ReadExample("sliding_bar");
  const std::vector<Increment> rows = TraceRows(request).rows;
  std::vector<Increment> other = TraceRows(ReadExample("rough_truss")).rows;
  EXPECT_THROW(Resume(request, other), std::invalid_argument);
  other = rows;
  other.erase(other.begin() + 3);
  EXPECT_THROW(Resume(request, other), std::invalid_argument);
  other = rows;
  other[2].stage = 1;
  EXPECT_THROW(Resume(request, other), std::invalid_argument);
}

}  // namespace
}  // namespace contact_path
