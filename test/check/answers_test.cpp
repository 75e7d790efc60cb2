// Section forces, stresses, pressures and lengths by the equations of the check, against those of the path.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "contact_path/check/residuals.h"
#include "contact_path/path/model.h"
#include "contact_path/scene/expand.h"
#include "contact_path/scene/program.h"
#include "contact_path/scene/scene_index.h"
#include "contact_path/verify/verify_path.h"
#include "support/traced_path.h"

namespace contact_path::answers_test {
namespace {

// Numbers of one unit, from two sources.
struct Compared {
  void Add(double one, double other) {
    largest = std::max(largest, std::abs(one));
    difference = std::max(difference, std::abs(one - other));
  }
  // rounding: of the unit, that stiff parts make of positions.
  void Expect(const char* what, double rounding = 0.0) const {
    EXPECT_LE(difference, 1e-9 * largest + rounding) << what;
  }
  double largest = 0.0, difference = 0.0;
};

TEST(Answers, AreThoseOfAllExampleScenes) {
  std::size_t with_sections = 0, with_stresses = 0, with_lengths = 0;
  for (const auto& file : std::filesystem::directory_iterator(CONTACT_PATH_SCENES)) {
    if (file.path().extension() != ".yaml") continue;
    SCOPED_TRACE(file.path().stem().string());
    TraceRequest given = ReadExample(file.path().stem().string());
    given.options.record = {"sections", "stresses", "pressures"};
    given.options.max_increments = 60;
    const TracedPath path = TraceIncrements(given);
    const ExpandedRequest expanded(path.request);
    const TraceRequest& request = expanded.Get();
    const SceneIndex index(request.scene);
    Compared forces, moments, stresses, energies, lengths;
    const Scaling scaling = ProgramScales(request);
    std::vector<std::unique_ptr<ResidualCheck>> checks;  // of the stages
    for (const Increment& increment : path.increments) {
      const auto stage = static_cast<std::size_t>(std::max(increment.stage, 1) - 1);
      if (stage >= checks.size())
        checks.push_back(std::make_unique<ResidualCheck>(StageScene(request, index, stage),
                                                         StageConfiguration(request, index, stage), scaling));
      const CheckedAnswers answers = checks.at(stage)->Answers(StateOf(increment));
      ASSERT_EQ(answers.sections.size(), increment.sections.size());
      ASSERT_EQ(answers.stresses.size(), increment.stresses.size());
      ASSERT_EQ(answers.lengths.size(), increment.pressures.size());
      for (std::size_t i = 0; i < increment.sections.size(); ++i) {
        std::size_t k = 0;  // N, Q, then moments
        ForEachField<SectionForces>([&](const auto& field) {
          (k < 2 ? forces : moments).Add(increment.sections[i].*field.member, answers.sections[i][k]);
          ++k;
        });
      }
      for (std::size_t i = 0; i < increment.stresses.size(); ++i) {
        std::size_t k = 0;  // stresses, then the energy
        ForEachField<SolidStress>([&](const auto& field) {
          (k < 5 ? stresses : energies).Add(increment.stresses[i].*field.member, answers.stresses[i][k]);
          ++k;
        });
      }
      for (std::size_t i = 0; i < increment.pressures.size(); ++i)
        lengths.Add(increment.pressures[i].length, answers.lengths[i]);
    }
    const double rounding = 1e-14 * checks[0]->LargestStiffness() * scaling.length;
    forces.Expect("section forces", rounding);
    moments.Expect("moments", rounding * scaling.length);
    stresses.Expect("stresses");
    energies.Expect("energies");
    lengths.Expect("lengths");
    if (forces.largest > 0.0) ++with_sections;
    if (stresses.largest > 0.0) ++with_stresses;
    if (lengths.largest > 0.0) ++with_lengths;
    ExpectNoFindings(path);
  }
  EXPECT_GE(with_sections, 10U);
  EXPECT_GE(with_stresses, 4U);
  EXPECT_GE(with_lengths, 6U);
}

// verify finds each of them that was changed.
TEST(Answers, ThatWereChangedAreFound) {
  TraceRequest request = ReadExample("two_blocks");
  request.options.record = {"stresses", "pressures"};
  request.options.max_increments = 10;
  const TracedPath of_solids = TraceIncrements(request);
  request = ReadExample("portal_frame");
  request.options.record = {"sections"};
  request.options.max_increments = 10;
  const TracedPath of_beams = TraceIncrements(request);
  const auto expect_found = [](const TracedPath& path, auto change, const std::string& text) {
    std::vector<Increment> increments = path.increments;
    change(&increments[5]);
    const Verification verification = VerifyPath(path.request, increments);
    ASSERT_EQ(verification.findings.size(), 1U) << text;
    EXPECT_NE(verification.findings[0].what.find(text), std::string::npos) << verification.findings[0].what;
  };
  expect_found(
      of_solids, [](Increment* of) { of->stresses[2].sxy += 1e-5; }, "sxy of element 3 is recorded as");
  expect_found(
      of_solids, [](Increment* of) { of->stresses[0].mises *= 1.001; }, "mises of element 1");
  expect_found(
      of_solids, [](Increment* of) { of->pressures[1].length += 1e-6; }, "length of contact 2");
  expect_found(
      of_solids, [](Increment* of) { of->pressures[0].pressure += 1e-4; }, "pressure of contact 1");
  expect_found(
      of_solids, [](Increment* of) { of->widths[0] += 1e-6; }, "width of boundary 1");
  expect_found(
      of_beams, [](Increment* of) { of->sections[3].M += 1e-5; }, "M of section 4");
  expect_found(
      of_beams, [](Increment* of) { of->sections[1].N += 1e-5; }, "N of section 2");
}

}  // namespace
}  // namespace contact_path::answers_test
