// Rules of load programs.
#include <gtest/gtest.h>

#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "contact_path/scene/validate.h"

namespace contact_path::program_rules_test {
namespace {

// A bar from a to b, which touches a floor; a stage that presses b and moves the floor down, and one that takes that
// back.
TraceRequest SoundProgram() {
  TraceRequest request;
  Scene& scene = request.scene;
  scene.nodes = {{"a", 0.0, 5.0, true, true}, {"b", -5.0, 0.0}};
  scene.bars = {{{"a", "b"}, 14.0}};
  scene.loads = {{"b", 0.0, -1.0, true}};
  scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 2.0, 0.3}};
  scene.contacts = {{"b", "floor"}};
  request.program.resize(2);
  request.program[0].loads = {{"b", 2.0, 0.0}};
  request.program[0].obstacle_motions = {{"floor", 0.0, -1.0}};
  request.program[1].unload = true;
  return request;
}

struct BrokenProgram {
  std::function<void(std::vector<Stage>&)> change;
  std::string line;  // empty: it breaks none
};

const std::string kNothingLeft =
    "= true: the stages before must have left a load, a motion or a change of friction that can be taken back";
const BrokenProgram kPrograms[] = {
    {[](auto&) {}, ""},
    {[](auto& p) { p[1].target = 0.5; }, ""},
    {[](auto& p) { p[1].target = 0.5, p.push_back(p[1]), p[2].target = 1.0; }, ""},
    {[](auto& p) { p.push_back(p[0]), p.push_back(p[1]); }, ""},
    {[](auto& p) { p.erase(p.begin()); }, "program[0].unload " + kNothingLeft},
    {[](auto& p) { p.push_back(p[1]); }, "program[2].unload " + kNothingLeft},
    {[](auto& p) {
       p.insert(p.begin() + 1, p[0]);
       p[1].target = -1.0;
     },
     "program[2].unload " + kNothingLeft},
    // 0.1 + 0.2 - 0.3 is not 0 in doubles.
    {[](auto& p) {
       p[0].obstacle_motions.clear();
       p = {p[0], p[0], p[0], p[1]};
       p[0].target = 0.1, p[1].target = 0.2, p[2].target = -0.3;
     },
     "program[3].unload " + kNothingLeft},
    {[](auto& p) { p[1].target = 1.5; },
     "program[1].target = 1.5: must be from 0 to 1 where the stage unloads: the part that is taken back, 0 = all"},
    {[](auto& p) { p[1].target = -0.5; },
     "program[1].target = -0.5: must be from 0 to 1 where the stage unloads: the part that is taken back, 0 = all"},
    {[](auto& p) { p[1].loads = p[0].loads; },
     "program[1].loads: must be empty where the stage unloads: it takes back what the stages before have left"},
    {[](auto& p) { p[1].obstacle_motions = p[0].obstacle_motions; },
     "program[1].obstacle_motions: must be empty where the stage unloads: it takes back what the stages before have "
     "left"},
};
TEST(ProgramRules, BrokenRulesAreReportedAlone) {
  for (const BrokenProgram& of : kPrograms) {
    TraceRequest request = SoundProgram();
    of.change(request.program);
    std::string lines;
    for (const Violation& violation : Validate(request)) lines += violation.ToLine();
    EXPECT_EQ(lines, of.line);
  }
}

// Each stage takes a part of what many loads have left: 10^10 sums would be seen here.
TEST(ProgramRules, UnloadingTakesTimeInProportionToTheRequest) {
  TraceRequest request = SoundProgram();
  constexpr int kMany = 100000;
  request.program[0].loads.clear();
  for (int i = 0; i < kMany; ++i) {
    request.scene.nodes.push_back({"n" + std::to_string(i), 1.0, 1.0 + i, false, false});
    request.scene.bars.push_back({{"a", "n" + std::to_string(i)}, 1.0});
    request.program[0].loads.push_back({"n" + std::to_string(i), 1.0, 0.0, false});
  }
  request.program[1].target = 1e-5;
  request.program.resize(kMany, request.program[1]);
  const std::clock_t start = std::clock();
  EXPECT_TRUE(Validate(request).empty());
  EXPECT_LT(std::clock() - start, 5 * CLOCKS_PER_SEC);
}

}  // namespace
}  // namespace contact_path::program_rules_test
