#include "contact_path/branch/branch_order.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <numeric>
#include <vector>

#include "support/contact_points.h"

namespace contact_path::branch_order_test {
namespace {

constexpr ContactState kOpen = ContactState::kOpen, kStick = ContactState::kStick, kSlip = ContactState::kSlipPlus;

Branch Make(const std::vector<ContactState>& states, double dissipation, double load, double turn, double first = 1.0) {
  Branch branch;
  branch.modes = ModesOf(states);
  branch.dissipation_rate = dissipation;
  branch.load_rate = branch.parameter_rate = load;
  branch.sense = load > 0.0 ? 1 : -1;
  branch.turn = branch.deviation = turn;
  branch.direction = Eigen::Vector2d(first, load);
  return branch;
}

// The load rates, which name the branches.
std::vector<double> Sorted(std::vector<Branch> branches, const std::vector<ContactState>& arrival) {
  SortBranches(ModesOf(arrival), false, &branches);
  std::vector<double> names;
  for (const Branch& branch : branches) names.push_back(branch.load_rate);
  return names;
}

// All orders of up to five branches.
void ExpectOrder(const std::vector<Branch>& branches, const std::vector<ContactState>& arrival,
                 const std::vector<double>& wanted) {
  std::vector<std::size_t> order(branches.size());
  std::iota(order.begin(), order.end(), 0U);
  do {
    std::vector<Branch> given;
    for (const std::size_t i : order) given.push_back(branches[i]);
    EXPECT_EQ(Sorted(given, arrival), wanted);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(BranchOrder, DissipationThenTurn) {
  ExpectOrder({Make({kSlip}, 0.1, 1.0, 2.0), Make({kSlip}, 0.3, 2.0, 3.0), Make({kStick}, 0.1, 3.0, 1.0)}, {kSlip},
              {2.0, 3.0, 1.0});
}

TEST(BranchOrder, OfEqualDissipationOneWithoutMirror) {
  ExpectOrder({Make({kSlip}, 0.1, 0.5, 0.2, 1.0), Make({kOpen}, 0.1, 0.5, 0.2, -1.0), Make({kStick}, 0.1, 0.7, 1.0)},
              {kSlip}, {0.7, 0.5, 0.5});
}

// Rates 0, 0.6e-9 and 1.2e-9: a comparison with a tolerance of 1e-9 calls neighbours equal but not the ends, and what
// comes first would depend on the order.
TEST(BranchOrder, ChainOfNearlyEqualRates) {
  ExpectOrder({Make({kSlip}, 0.0, 1.0, 0.1), Make({kStick}, 0.6e-9, 2.0, 0.2), Make({kOpen}, 1.2e-9, 3.0, 0.3)},
              {kSlip}, {1.0, 2.0, 3.0});
  ExpectOrder({Make({kSlip}, 0.0, 1.0, 0.3), Make({kStick}, 0.6e-9, 2.0, 0.2), Make({kOpen}, 1.2e-9, 3.0, 0.1)},
              {kSlip}, {3.0, 2.0, 1.0});
}

TEST(BranchOrder, AnglesAreKnownToTheRootOfRounding) {
  ExpectOrder({Make({kStick}, 0.0, 1.0, 0.0), Make({kSlip}, 0.0, 2.0, 1.5e-8)}, {kSlip}, {2.0, 1.0});
}

// Branches of equal turn, where a table hands a node over to another one: the load goes on as wanted.
TEST(BranchOrder, OfEqualTurnTheOneThatLoads) {
  const std::vector<Branch> branches = {Make({kStick}, 0.0, -0.7, 0.1), Make({kOpen}, 0.0, 1.0, 0.1)};
  ExpectOrder(branches, {kStick}, {1.0, -0.7});
  std::vector<Branch> unloading = branches;
  for (Branch& branch : unloading) branch.parameter_rate *= -1.0;
  SortBranches(ModesOf({kOpen}), false, &unloading);
  EXPECT_EQ(unloading.front().load_rate, -0.7);
}

// A driven path goes on where it can, then rests, whatever dissipates more.
TEST(BranchOrder, ForwardBeforeDissipation) {
  std::vector<Branch> branches = {Make({kSlip}, 0.5, -1.0, 0.0), Make({kStick}, 0.3, 0.0, 0.1),
                                  Make({kStick}, 0.1, 1.0, 0.3), Make({kOpen}, 0.2, 2.0, 2.0)};
  branches[1].sense = 0;
  SortBranches(ModesOf({kSlip}), true, &branches);
  std::vector<double> names;
  for (const Branch& branch : branches) names.push_back(branch.load_rate);
  EXPECT_EQ(names, (std::vector<double>{2.0, 1.0, 0.0, -1.0}));
}

// Load rates that are equal but for rounding.
TEST(BranchOrder, TheStatesOfArrivalComeFirst) {
  ExpectOrder({Make({kStick, kOpen}, 0.0, 1e-12, 0.1), Make({kOpen, kStick}, 0.0, 2e-12, 0.1),
               Make({kOpen, kSlip}, 0.0, 3e-12, 0.1)},
              {kOpen, kStick}, {2e-12, 3e-12, 1e-12});
  ExpectOrder({Make({kStick}, 0.0, 1e-12, 0.1, 0.5), Make({kStick}, 0.0, 2e-12, 0.1, -0.5)}, {kStick}, {1e-12, 2e-12});
}

}  // namespace
}  // namespace contact_path::branch_order_test
