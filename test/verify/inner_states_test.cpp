// States inside of increments, on record for the integrals over them.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "contact_path/scene/read_scene.h"
#include "verify/verified.h"

namespace contact_path::inner_states_test {
namespace {

TracedPath WithInnerStates(TraceRequest request, int increments) {
  request.options.record.emplace_back("inner");
  request.options.max_increments = increments;
  return TraceIncrements(request);
}

bool HasInner(const Increment& increment) { return !increment.inner.positions.empty(); }

// Scenes whose integrals are those of loads, of friction on arcs of beams, of a solid with a surface, and of an
// obstacle that moves.
struct AccurateScene {
  const char* name;
  Accuracy accuracy;  // so that a millionth of the whole path is more than what an increment leaves open
};

class InnerStates : public ::testing::TestWithParam<AccurateScene> {
 protected:
  void SetUp() override {
    TraceRequest request = ReadExample(GetParam().name);
    request.options.accuracy = GetParam().accuracy;
    path_ = WithInnerStates(request, 150);
    for (std::size_t i = 1; i < path_.increments.size(); ++i)
      if (path_.increments[i].kind == IncrementKind::kRegular && HasInner(path_.increments[i])) regular_.push_back(i);
    ASSERT_GT(regular_.size(), 10U);
  }

  // The findings where a sum is larger by this share of its total from an increment on.
  std::string FindingsWith(double Increment::*sum, std::size_t from) const {
    std::vector<Increment> increments = path_.increments;
    double total = 0.0;
    for (std::size_t i = 1; i < increments.size(); ++i) total += std::abs(increments[i].*sum - increments[i - 1].*sum);
    for (std::size_t i = from; i < increments.size(); ++i) increments[i].*sum += 1e-6 * total;
    return Listed(VerifyPath(path_.request, increments));
  }

  TracedPath path_;
  std::vector<std::size_t> regular_;
};

TEST_P(InnerStates, ProveEachIncrementThatMoves) {
  const Verification verification = VerifyPath(path_.request, path_.increments);
  EXPECT_TRUE(verification.findings.empty()) << Listed(verification);
  EXPECT_EQ(verification.open_integrals, 0);
  EXPECT_GE(verification.proved_integrals, static_cast<int>(regular_.size()));
}

TEST_P(InnerStates, ShowAMillionthOfEachSum) {
  for (std::size_t k = 0; k < regular_.size(); k += regular_.size() / 6) {
    SCOPED_TRACE(regular_[k]);
    // Before other increments longer steps were tried, and their arc length is known to less.
    if (path_.increments[regular_[k]].solve.rejected == 0) {
      EXPECT_NE(FindingsWith(&Increment::arc_length, regular_[k]).find("arc length is off by"), std::string::npos);
    }
    EXPECT_NE(FindingsWith(&Increment::external_work, regular_[k]).find("work of the loads"), std::string::npos);
    if (path_.increments.back().dissipation > 0.0) {
      EXPECT_NE(FindingsWith(&Increment::dissipation, regular_[k]).find("dissipation, over"), std::string::npos);
    }
  }
}

TEST_P(InnerStates, ThatWereChangedAreFound) {
  const std::size_t at = regular_[regular_.size() / 2];
  const auto findings_with = [&](const std::function<void(InnerState&)>& change) {
    std::vector<Increment> increments = path_.increments;
    change(increments[at].inner);
    return Listed(VerifyPath(path_.request, increments));
  };
  EXPECT_NE(findings_with([](InnerState& inner) { inner.load_factor += 1e-4; }), "");
  // The coordinate that moves most on the path.
  const std::vector<double>&first = path_.increments.front().positions, &last = path_.increments.back().positions;
  std::size_t most = 0;
  for (std::size_t i = 0; i < first.size(); ++i)
    if (std::abs(last[i] - first[i]) > std::abs(last[most] - first[most])) most = i;
  EXPECT_NE(findings_with([&](InnerState& inner) { inner.positions[most] += 1e-5; }).find("equilibrium residual"),
            std::string::npos);
  EXPECT_NE(findings_with([](InnerState& inner) { inner.contacts.back().gap += 1e-3; }).find("recorded gap"),
            std::string::npos);
  EXPECT_NE(findings_with([](InnerState& inner) { inner.positions.pop_back(); }).find("not those of the scene"),
            std::string::npos);
  // A state of the path, but not of this increment.
  EXPECT_NE(findings_with([&](InnerState& inner) {
              inner = path_.increments[at + 1].inner;
            }).find("not inside of the increment"),
            std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(VerifyPath, InnerStates,
                         ::testing::Values(AccurateScene{"sliding_bar", Accuracy::kAccurate},
                                           AccurateScene{"rough_arch", Accuracy::kBalanced},
                                           AccurateScene{"two_blocks", Accuracy::kBalanced},
                                           AccurateScene{"snap_hook", Accuracy::kBalanced}),
                         [](const auto& instance) { return std::string(instance.param.name); });

// Steps do not depend on whether inner states are recorded.
TEST(VerifyPath, InnerStatesLeaveThePathAsItIs) {
  for (const Method method : {Method::kBranch, Method::kMpec}) {
    TraceRequest request = ReadExample("fin_ray");
    request.options.method = method;
    TracedPath with = WithInnerStates(request, 80);
    with.request.options.record.clear();
    const TracedPath without = TraceIncrements(with.request);
    ASSERT_EQ(with.increments.size(), without.increments.size());
    for (std::size_t i = 0; i < with.increments.size(); ++i) {
      EXPECT_EQ(with.increments[i].positions, without.increments[i].positions);
      EXPECT_FALSE(HasInner(without.increments[i]));
    }
  }
}

TEST(VerifyPath, IncrementsByIpoptHaveNoInnerStates) {
  TraceRequest request = ReadExample("sliding_bar");
  request.options.method = Method::kMpec;
  request.options.record = {"inner"};
  request.options.max_increments = 10;
  const TracedPath path = TraceIncrements(request);
  for (const Increment& increment : path.increments) EXPECT_FALSE(HasInner(increment));
  ExpectNoFindings(path);
}

// The trapezoids are recorded themselves: a change that is balanced is found, too.
TEST(VerifyPath, WorkOfIncrementsByIpoptIsComparedWithTrapezoids) {
  TracedPath path = Traced("two_dof_friction", Method::kMpec);
  for (Increment& increment : path.increments) {
    increment.external_work += 1e-6 * increment.dissipation;
    increment.dissipation *= 1.0 + 1e-6;
  }
  EXPECT_NE(Listed(VerifyPath(path.request, path.increments)).find("dissipation, over"), std::string::npos);
}

TEST(VerifyPath, AllScenesAreProvedWithAndWithoutInnerStates) {
  int inner = 0, proved = 0;
  for (const char* const directory : {CONTACT_PATH_SCENES, CONTACT_PATH_TEST_DATA})
    for (const auto& entry : std::filesystem::directory_iterator(directory)) {
      if (entry.path().extension() != ".yaml") continue;
      SCOPED_TRACE(entry.path().filename().string());
      const TraceRequest request = ReadTraceRequestFile(entry.path().string());
      if (!request.options.LocatesEvents()) continue;
      TracedPath path = WithInnerStates(request, 50);
      if (path.increments.empty()) continue;
      for (const Increment& increment : path.increments) inner += HasInner(increment) ? 1 : 0;
      const Verification verification = VerifyPath(path.request, path.increments);
      EXPECT_TRUE(verification.findings.empty()) << Listed(verification);
      proved += verification.proved_integrals;
      for (Increment& increment : path.increments) increment.inner = InnerState();
      ExpectNoFindings(path);
    }
  EXPECT_GT(inner, 3000);
  EXPECT_GE(proved, inner);
}

}  // namespace
}  // namespace contact_path::inner_states_test
