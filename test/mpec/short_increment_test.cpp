#include "contact_path/mpec/short_increment.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "contact_path/mpec/ipopt_solver.h"
#include "contact_path/path/model.h"

namespace contact_path::short_increment_test {
namespace {

// A node on a spring, pressed on a rough floor with r_n = 1 and at the limit of its cone to the right.
class NodeAboutToSlide : public testing::Test {
 protected:
  static Scene MakeScene(double fx) {
    Scene scene;
    scene.nodes = {{"p", 0.0, 0.0, false, false}};
    scene.superelements = {{{"p"}, {1.0, 0.0, 0.0, 1.0}}};
    scene.loads = {{"p", fx, 0.0, false}, {"p", 0.5, -1.0, true}};
    scene.obstacles = {{"floor", ObstacleShape::kHalfPlane, 0.0, 0.0, 0.0, 1.0, 0.5}};
    scene.contacts = {{"p", "floor"}};
    return scene;
  }
  std::vector<std::vector<ContactState>> States(double fx) {
    const Model model(MakeScene(fx), Scaling());
    IpoptSolver ipopt(nullptr);
    IncrementSolver solver(model.structure, model.contacts, &ipopt);
    PathPoint point = model.InitialPoint();
    point.rn[0] = 1.0;
    point.rt[0] = -0.5;
    point.states[0] = ContactState::kStick;
    return StatesOfShortIncrements(point, Eigen::Vector3d(0.0, 0.0, 1.0), &solver);
  }
};

TEST_F(NodeAboutToSlide, SlidesWhereTheLoadPushesOn) {
  const std::vector<std::vector<ContactState>> states = States(1.0);
  ASSERT_FALSE(states.empty());
  for (const auto& state : states) EXPECT_EQ(state, std::vector<ContactState>{ContactState::kSlipPlus});
}

TEST_F(NodeAboutToSlide, SticksWhereTheLoadPullsBack) {
  const std::vector<std::vector<ContactState>> states = States(-1.0);
  ASSERT_FALSE(states.empty());
  EXPECT_EQ(states.front(), std::vector<ContactState>{ContactState::kStick});
}

}  // namespace
}  // namespace contact_path::short_increment_test
