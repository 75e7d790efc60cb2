#include "contact_path/law/reach_tracker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "contact_path/contact/scene_contacts.h"
#include "support/mixed_scene.h"
#include "support/random.h"

namespace contact_path::reach_tracker_test {
namespace {

std::vector<std::size_t> LookedAtAll(const ContactPairs& contacts, const Eigen::VectorXd& u, double s, double reach) {
  std::vector<std::size_t> in_reach;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    if (contacts[i]->Gap(u, s, 0) <= reach * contacts[i]->LargestReachRate()) in_reach.push_back(i);
  return in_reach;
}

// Back and forth, in steps of all lengths, with all reaches.
TEST(ReachTracker, FindsWhatALookAtAllFinds) {
  const Scene scene = MovingScene();
  const Structure structure(scene);
  const ContactPairs contacts = BuildContacts(scene, structure);
  Random random(3);
  const Laws laws = LawsOf(contacts);
  ReachTracker tracker(laws);
  const Eigen::VectorXd start = structure.Start();
  Eigen::VectorXd u = start;
  double s = 0.0;
  std::size_t found = 0;
  for (int i = 0; i < 2000; ++i) {
    const double length = std::pow(10.0, random.Number(-6.0, 0.0));
    u = start + (1.0 - 0.5 * length) * (u - start) + length * random.Vector(u.size(), -0.3, 0.3);
    s += random.Number(-0.3, 0.3) * length;
    const double reach = i % 10 == 0 ? 0.0 : std::pow(10.0, random.Number(-4.0, 0.3));
    const std::vector<std::size_t> expected = LookedAtAll(contacts, u, s, reach);
    ASSERT_EQ(tracker.InReach(u, s, reach), expected) << i;
    found += expected.size();
  }
  EXPECT_GT(found, 400u);
  EXPECT_LT(found, 11000u);
}

// A gap above u_0 that counts how often it is asked for.
class Counted : public ContactPair {
 public:
  Counted(double gap, int* looks) : gap_(gap), looks_(looks) {
    Traits traits;
    traits.dofs = {0};
    SetContact(traits, {});
  }
  void Evaluate(const Eigen::VectorXd&, double, int, const PortReals&, PortsAt*) const override {}
  double Gap(const Eigen::VectorXd& u, double, int) const override { return gap_ + u[0]; }
  NearestFoot Nearest(const Eigen::VectorXd& u, double s) const override {
    ++*looks_;
    return {0, Gap(u, s, 0), false};
  }

 private:
  double gap_;
  int* looks_;
};

TEST(ReachTracker, LooksSeldomAtWhatIsFar) {
  ContactPairs contacts;
  int near_looks = 0, far_looks = 0;
  contacts.push_back(std::make_unique<Counted>(0.055, &near_looks));
  for (int i = 0; i < 100; ++i) contacts.push_back(std::make_unique<Counted>(1.0, &far_looks));
  const Laws laws = LawsOf(contacts);
  ReachTracker tracker(laws);
  for (int i = 0; i < 90; ++i) {
    const Eigen::VectorXd u = Eigen::VectorXd::Constant(1, -0.01 * i);
    EXPECT_EQ(tracker.InReach(u, 0.0, 0.02).size(), i >= 4 ? 1u : 0u) << i;
  }
  EXPECT_GE(near_looks, 86);
  EXPECT_EQ(far_looks, 100);  // at the start
}

}  // namespace
}  // namespace contact_path::reach_tracker_test
