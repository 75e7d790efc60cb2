// Only what the scene requires is modelled: sizes of the problems solved for an increment.
#include <gtest/gtest.h>

#include "contact_path/path/mpec_method.h"
#include "contact_path/path/trace.h"
#include "lattice.h"

namespace contact_path::model_size_test {
namespace {

constexpr int kCandidates = 4;
constexpr int kRough = 2;  // of the candidates, where some are

enum class Touch { kOutOfReach, kFrictionless, kSomeRough, kAllRough };

// A wall that lies on the floor with four of its nodes and is pressed down. 48 dofs.
TraceRequest Wall(Touch touch, Method method, int far_candidates = 0) {
  LatticeOptions lattice;
  lattice.kind = LatticeKind::kWall;
  lattice.columns = 8;
  lattice.rows = 2;
  lattice.contacts = kCandidates;
  lattice.far_candidates = far_candidates;
  lattice.friction = 0.3;
  TraceRequest request = LatticeRequest(lattice);
  request.options = TraceOptions();
  request.options.method = method;
  request.options.max_increments = 4;
  Obstacle& floor = request.scene.obstacles.front();
  floor.py = touch == Touch::kOutOfReach ? -100.0 : 0.0;
  if (touch == Touch::kFrictionless) floor.friction = 0.0;
  if (touch != Touch::kSomeRough) return request;
  Obstacle smooth = floor;
  smooth.name = "smooth";
  smooth.friction = 0.0;
  request.scene.obstacles.push_back(smooth);
  for (int i = kRough; i < kCandidates; ++i) request.scene.contacts[static_cast<std::size_t>(i)].obstacle = "smooth";
  return request;
}

Increment LastIncrement(const TraceRequest& request) {
  Increment last;
  TraceControl control;
  control.on_increment = [&last](const Increment& increment) { last = increment; };
  control.mpec = MakeMpecMethod;
  const TraceResult result = Trace(request, control);
  EXPECT_EQ(result.reason, EndReason::kMaxIncrements) << result.message;
  return last;
}

int Count(const Increment& increment, ContactState state) {
  int count = 0;
  for (const ContactRecord& contact : increment.contacts) count += contact.state == state;
  return count;
}

constexpr int kDofs = 48;

TEST(ModelSize, BranchHasReactionsOfTouchingContactsOnly) {
  for (const Touch touch : {Touch::kOutOfReach, Touch::kFrictionless, Touch::kSomeRough, Touch::kAllRough}) {
    const Increment increment = LastIncrement(Wall(touch, Method::kBranch));
    const int touching = kCandidates - Count(increment, ContactState::kOpen),
              sticking = Count(increment, ContactState::kStick);
    EXPECT_EQ(increment.solve.variables, kDofs + 1 + touching + sticking);
    EXPECT_EQ(increment.solve.constraints, kDofs + touching + sticking);
    EXPECT_EQ(touching == 0, touch == Touch::kOutOfReach);
    if (touch == Touch::kFrictionless) {
      EXPECT_EQ(touching, Count(increment, ContactState::kClosed));
    }
  }
}

TEST(ModelSize, MpecHasNothingForCandidatesOutOfReachAndNoFrictionWhereThereIsNone) {
  const Increment none = LastIncrement(Wall(Touch::kOutOfReach, Method::kMpec));
  EXPECT_EQ(none.solve.variables, kDofs + 1);
  EXPECT_EQ(none.solve.constraints, kDofs);
  EXPECT_EQ(none.solve.regularisation, 0.0);  // no complementarity: nothing is regularised
  const Increment smooth = LastIncrement(Wall(Touch::kFrictionless, Method::kMpec));
  EXPECT_EQ(smooth.solve.variables, kDofs + 1 + kCandidates);    // r_n
  EXPECT_EQ(smooth.solve.constraints, kDofs + 2 * kCandidates);  // gap and product
  const Increment some = LastIncrement(Wall(Touch::kSomeRough, Method::kMpec));
  EXPECT_EQ(some.solve.variables, smooth.solve.variables + 2 * kRough);      // r_t and lambda
  EXPECT_EQ(some.solve.constraints, smooth.solve.constraints + 5 * kRough);  // their five inequalities
  const Increment rough = LastIncrement(Wall(Touch::kAllRough, Method::kMpec));
  EXPECT_EQ(rough.solve.variables, smooth.solve.variables + 2 * kCandidates);
  EXPECT_EQ(rough.solve.constraints, smooth.solve.constraints + 5 * kCandidates);
}

TEST(ModelSize, FarCandidatesChangeNothing) {
  for (const Method method : kMethods) {
    const Increment without = LastIncrement(Wall(Touch::kAllRough, method));
    const Increment with = LastIncrement(Wall(Touch::kAllRough, method, 500));
    EXPECT_EQ(with.contacts.size(), without.contacts.size() + 500U);
    EXPECT_EQ(with.solve.variables, without.solve.variables);
    EXPECT_EQ(with.solve.constraints, without.solve.constraints);
    EXPECT_EQ(with.positions, without.positions);  // to the last bit
  }
}

TEST(ModelSize, OneFactorisationAnIncrementOnASmoothStretch) {
  TraceRequest request = Wall(Touch::kOutOfReach, Method::kBranch);
  request.options.max_increments = 30;
  int factorisations = 0, regular = 0;
  TraceControl control;
  control.on_increment = [&](const Increment& increment) {
    if (increment.kind != IncrementKind::kRegular) return;
    ++regular;
    factorisations += increment.solve.factorisations;
  };
  control.mpec = MakeMpecMethod;
  Trace(request, control);
  ASSERT_GT(regular, 20);
  EXPECT_LE(factorisations, 1.2 * regular);
}

}  // namespace
}  // namespace contact_path::model_size_test
