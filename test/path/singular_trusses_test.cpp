// Trusses and slack bars whose fixed-mode equations become singular: limit points together, paths that cross or nearly
// do. Each is held against a closed form, or against itself for other steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "support/traced_path.h"

namespace contact_path::singular_trusses_test {
namespace {

constexpr double kResidual = 1e-9;

TraceRequest ReadWithin(const std::string& name, Accuracy accuracy, int max_increments) {
  TraceRequest request = ReadData(name);
  request.options.accuracy = accuracy;
  request.options.max_increments = max_increments;
  return request;
}

// As far as the increments of a preset go.
TracedPath TraceWithin(const std::string& name, Accuracy accuracy, int most, int most_accurate) {
  return TraceTo(ReadWithin(name, accuracy, accuracy == Accuracy::kAccurate ? most_accurate : most),
                 EndReason::kMaxIncrements, kResidual);
}

// Perfect truss: sway begins where the stiffness across vanishes. The imperfect one leaves next to it.
TEST(SingularScenes, HighTrussWithASmallImperfection) {
  const double rest = std::sqrt(10.0);
  const auto force = [&](double y) { return std::hypot(1.0, y) / rest - 1.0; };
  const auto across = [&](double y) {
    const double l = std::hypot(1.0, y);
    return 1.0 / (rest * l * l) + force(y) * y * y / (l * l * l);
  };
  double low = 2.0, high = 3.0;
  for (int i = 0; i < 100; ++i) (across(0.5 * (low + high)) < 0.0 ? low : high) = 0.5 * (low + high);
  const double critical = -2.0 * force(low) * low / std::hypot(1.0, low);
  std::vector<double> first;
  ForEachAccuracy(ReadLongData("imperfect_truss"), EndReason::kStopCriterion, kResidual, [&](const TracedPath& path) {
    const std::vector<double> limits = LoadsOfKind(path, IncrementKind::kSmoothLimit);
    ASSERT_EQ(limits.size(), 1U);
    EXPECT_NEAR(limits[0], critical, 1e-5 * critical);
    EXPECT_LT(limits[0], critical);
    if (first.empty()) first = limits;
    EXPECT_NEAR(limits[0], first[0], 1e-10);
  });
}

// The supports are off the line by 1e-9: the path turns onto the one along the line, on which s is known.
TEST(SingularScenes, CrossingPathNextToALimitPoint) {
  const double a = std::hypot(0.5, 1.0), b = std::hypot(1.5, 1.0);
  ForEachAccuracy(ReadLongData("cross_numfail"), EndReason::kMaxIncrements, kResidual, [&](const TracedPath& path) {
    int along = 0;
    for (const Increment& increment : path.increments) {
      const double x = PositionX(path, increment, "n");
      if (std::abs(PositionY(path, increment, "n")) > 1e-6) continue;
      EXPECT_NEAR(increment.load_factor, (-x / a - 1.0) + ((1.0 - x) / b - 1.0), 1e-7);
      ++along;
    }
    EXPECT_GE(along, 50);
  });
}

// Two pairs of slack bars that are straight at the start: their outer nodes move with the lines through c. With the
// distance d of c from a support, and the outer node at R from there, both bars of a pair pull with N.
TEST(SingularScenes, SlackBarsThatAreStraightAtTheStart) {
  struct Pair {
    std::string outer;
    double y, length;  // of its support, of the bar to c
  };
  const Pair pairs[] = {{"m", 0.0, 1.0}, {"n", -1.0, std::sqrt(2.0)}};
  ForEachAccuracy(ReadLongData("straight_slack_bars"), EndReason::kStopCriterion, kResidual,
                  [&](const TracedPath& path) {
                    for (const Increment& increment : path.increments) {
                      const double x = PositionX(path, increment, "c"), y = PositionY(path, increment, "c");
                      double force_x = -increment.load_factor - (x - 1.0), force_y = 0.5 * increment.load_factor - y;
                      for (const Pair& pair : pairs) {
                        const double d = std::hypot(x, y - pair.y);
                        const double R = (4.0 * pair.length + 2.0 * d) / 3.0, N = (R - d) / pair.length - 1.0;
                        EXPECT_NEAR(PositionX(path, increment, pair.outer), R * x / d, 1e-11) << increment.index;
                        EXPECT_NEAR(PositionY(path, increment, pair.outer), pair.y + R * (y - pair.y) / d, 1e-11)
                            << increment.index;
                        force_x += N * x / d;
                        force_y += N * (y - pair.y) / d;
                      }
                      EXPECT_NEAR(force_x, 0.0, 1e-12) << increment.index;
                      EXPECT_NEAR(force_y, 0.0, 1e-12) << increment.index;
                    }
                  });
}

// Next to a singular point rates are known to rounding of the points over their distance to it. A limit point is
// located as well as that admits.
TEST(SingularScenes, LimitPointWhereRatesAreInexact) {
  for (const Accuracy accuracy : kPresets) {
    const TracedPath path = TraceWithin("limit_next_to_sway", accuracy, 80, 500);
    EXPECT_NEAR(LoadsOfKind(path, IncrementKind::kSmoothLimit).at(0), 0.03442360512675670842, 1e-12);
  }
}

// Limit loads along the curves from the start, by continuation in 33 digits. Other curves pass by at the limit points.
// There rounding may show one limit point as several.
TEST(SingularScenes, ThePathStaysOnItsCurve) {
  const std::map<std::string, std::vector<double>> loads = {
      {"limit_next_to_sway", {0.0344236051268, -0.0566893640795, 0.560384068089703}},
      {"slack_pairs_become_straight", {0.018342457360188, -0.107666910769746, -0.087483359271685}}};
  for (const auto& [name, expected] : loads)
    for (const Accuracy accuracy : {Accuracy::kFast, Accuracy::kBalanced}) {
      const TracedPath path = TraceVerified(ReadWithin(name, accuracy, 500), kResidual);
      std::vector<double> limits;
      for (const double load : LoadsOfKind(path, IncrementKind::kSmoothLimit))
        if (limits.empty() || std::abs(load - limits.back()) > 1e-11) limits.push_back(load);
      ASSERT_GE(limits.size(), expected.size()) << name;
      limits.resize(expected.size());
      ExpectNear(limits, expected, 1e-11);
    }
}

// The path of slack bars turns where they become straight, for one of two pairs a little earlier.
TEST(SingularScenes, TwoSlackPairsBecomeStraightAtNearlyTheSameLoad) {
  for (const Accuracy accuracy : {Accuracy::kBalanced, Accuracy::kAccurate}) {
    const TracedPath path = TraceWithin("slack_pairs_become_straight", accuracy, 80, 300);
    const std::vector<Increment> limits = IncrementsOfKind(path, IncrementKind::kSmoothLimit);
    ASSERT_EQ(limits.size(), 1U);
    EXPECT_NEAR(limits[0].load_factor, 0.018342457360188313772, 1e-13);
    EXPECT_FALSE(limits[0].event.null_vector.empty());
    // Node n1R goes on through the line of its bars, n1L turns back.
    const Increment& last = path.increments.back();
    EXPECT_LT(last.load_factor, limits[0].load_factor - 1e-7);
    EXPECT_LT(PositionY(path, last, "n1R") - PositionY(path, last, "n0R"), -2e-4);
    EXPECT_GT(PositionY(path, last, "n1L") - PositionY(path, last, "n0L"), 2e-4);
  }
}

// Both pairs become straight within 1e-8 of each other, and the path turns there within 4e-5. The pairs carry nothing,
// so that the rest moves back as it came, while one of them has swung through.
// Where a slack pair is straight, rounding may leave no step: then the path ends and names the node that moves freely.
TEST(SingularScenes, SlackPairSwingsThroughNextToAnother) {
  TraceRequest request = ReadData("slack_pairs_nearly_together");
  for (const Accuracy accuracy : kPresets) {
    request.options.accuracy = accuracy;
    request.options.max_increments = accuracy == Accuracy::kFast ? 120 : accuracy == Accuracy::kBalanced ? 300 : 900;
    const TracedPath path = TraceVerified(request, kResidual);
    const bool lost =
        path.result.reason == EndReason::kStepTooSmall && path.result.message.find("moves freely") != std::string::npos;
    EXPECT_TRUE(lost || path.result.reason == EndReason::kMaxIncrements) << path.result.message;
    const std::vector<Increment> limits = IncrementsOfKind(path, IncrementKind::kSmoothLimit);
    ASSERT_GE(limits.size(), 2U);
    EXPECT_NEAR(limits[0].load_factor, 0.01609026214914, 1e-13);
    EXPECT_NEAR(limits[1].load_factor, 0.00989248933307, 1e-13);
    // On which side of the line from n0L to n0R; 0: on it.
    const auto side = [&](const Increment& increment, const std::string& node) {
      const double x = PositionX(path, increment, "n0L"), y = PositionY(path, increment, "n0L");
      return (PositionX(path, increment, "n0R") - x) * (PositionY(path, increment, node) - y) -
             (PositionY(path, increment, "n0R") - y) * (PositionX(path, increment, node) - x);
    };
    std::size_t swung = 0;
    for (const Increment& increment : path.increments) {
      for (std::size_t bar = 8; bar < 12; ++bar) {
        const std::vector<std::string>& ends = request.scene.bars[bar].nodes;
        const double length = std::hypot(PositionX(path, increment, ends[1]) - PositionX(path, increment, ends[0]),
                                         PositionY(path, increment, ends[1]) - PositionY(path, increment, ends[0]));
        EXPECT_NEAR(length, std::hypot(bar < 10 ? 0.5 : 1.0, 0.45), 1e-8);
      }
      if (increment.index > limits[1].index && side(increment, "n2L") > 1e-3 && side(increment, "n2R") < -1e-3) ++swung;
    }
    if (!lost) {
      EXPECT_GT(swung, 5U);
    }
  }
}

// The path comes back to the symmetric one where an imperfection of 1e-10 has broken the bifurcation: it turns by a
// right angle within 1e-6. Limit loads by continuation in 34 digits.
TEST(SingularScenes, SharpTurnAtABrokenBifurcation) {
  for (const Accuracy accuracy : {Accuracy::kBalanced, Accuracy::kAccurate}) {
    const TracedPath path = TraceVerified(ReadWithin("bend_at_broken_bifurcation", accuracy, 600), kResidual);
    std::vector<double> limits = LoadsOfKind(path, IncrementKind::kSmoothLimit);
    ASSERT_GE(limits.size(), 5U);
    limits.resize(5);
    ExpectNear(
        limits,
        {6.7067501474132e-5, -0.00146241204840578, 0.000369980616801768, -2.29863136999241e-5, 2.201606499688991e-5},
        1e-13);
    std::size_t symmetric = 0;
    for (const Increment& increment : path.increments)
      symmetric += increment.index > 100 && std::abs(increment.load_factor) < 1e-5 &&
                   std::abs(PositionY(path, increment, "n1L") - PositionY(path, increment, "n1R")) < 1e-8;
    EXPECT_GT(symmetric, 0U);
  }
}

// Where another path crosses, the reaction of a contact is known to rounding of the point only.
TEST(SingularScenes, ContactWithoutAReactionWhereSlackBarsBecomeStraight) {
  const double n3_n4 = std::hypot(0.5, 1.0), n4_n2 = 0.75;
  for (const Accuracy accuracy : kPresets) {
    const TracedPath path = TraceWithin("slack_bars_at_a_ceiling", accuracy, 80, 250);
    const std::vector<Increment> limits = IncrementsOfKind(path, IncrementKind::kSmoothLimit);
    ASSERT_FALSE(limits.empty());
    EXPECT_NEAR(limits[0].load_factor, -0.1003102451, 1e-9);
    const double x = PositionX(path, limits[0], "n2"), y = PositionY(path, limits[0], "n2");
    EXPECT_NEAR(std::hypot(2.25 - x, 0.75 - y), n3_n4 + n4_n2, 1e-8);
    for (const Increment& increment : path.increments) {
      EXPECT_NEAR(Contact(path, increment, "n3@o0").rn, 0.0, 1e-9);
      EXPECT_NEAR(PositionX(path, increment, "n3"), 2.25, 1e-9);
    }
  }
}

// Limit point and crossing path at one point: the path goes on through the limit point, the other one is on record.
TEST(SingularScenes, PathThatCrossesAtALimitPointIsOnRecord) {
  TraceRequest request = ReadLongData("cross_symmetry");
  for (const Accuracy accuracy : kPresets) {
    request.options.accuracy = accuracy;
    const TracedPath line = TraceVerified(request, kResidual);
    const Increment& limit =
        FirstThat(line, [](const Increment& of) { return of.kind == IncrementKind::kSmoothLimit; });
    ASSERT_EQ(limit.event.null_vector.size(), 6U);
    EXPECT_NEAR(PositionY(line, limit, "n"), 0.0, 1e-13);
    EXPECT_NEAR(limit.event.null_vector[5], 0.0, 1e-13);  // along the line, s rises along it
    EXPECT_GT(std::abs(limit.event.null_vector[4]), 0.1);
    EXPECT_LT(PositionY(line, line.increments[static_cast<std::size_t>(limit.index) + 5], "n"), -0.01);
  }
}

// Two trusses side by side, one stiffer by a little: the softer one snaps, the other one goes back. The curve on which
// both snap passes at the distance of the root of the difference.
TEST(SingularScenes, TwoTrussesNearlyEqual) {
  const double limit = 2.0 * std::pow(1.0 - std::pow(0.5, 1.0 / 3.0), 1.5);
  for (const double difference : {1e-8, 1e-10, 1e-12})
    for (const Accuracy accuracy : kPresets) {
      SCOPED_TRACE(difference);
      TraceRequest request = ReadWithin("two_nearly_equal", accuracy, accuracy == Accuracy::kAccurate ? 600 : 150);
      request.scene.bars[0].EA = request.scene.bars[1].EA = 1.0 + difference;
      const TracedPath path = TraceTo(request, EndReason::kMaxIncrements, kResidual);
      EXPECT_NEAR(LoadsOfKind(path, IncrementKind::kSmoothLimit).at(0), limit, 1e-12);
      double deepest = 0.0;
      for (const Increment& increment : path.increments)
        deepest = std::min(deepest, PositionY(path, increment, "n1") - PositionY(path, increment, "n0"));
      EXPECT_LT(deepest, -0.1);
    }
}

// Two halves that do not touch each other reach their limit loads together, symmetric for any step.
// Both reach their limit points at the same load, so the Jacobian has two null vectors there. The limit loads are those
// of one truss, 2 EA (1 - c^(2/3))^(3/2) with c = b / l_0.
TEST(SingularScenes, TwoEqualTrusses) {
  const double limit = 2.0 * std::pow(1.0 - std::cbrt(0.5), 1.5);
  ForEachAccuracy(ReadLongData("two_von_mises"), EndReason::kStopCriterion, kResidual, [&](const TracedPath& path) {
    ExpectNear(LoadsOfKind(path, IncrementKind::kSmoothLimit), {limit, -limit}, 1e-12);
    for (const Increment& increment : path.increments) {
      EXPECT_NEAR(PositionY(path, increment, "n1"), PositionY(path, increment, "n2"), 1e-9) << increment.index;
      EXPECT_NEAR(PositionX(path, increment, "n1"), 0.0, 1e-9) << increment.index;
    }
  });
}

TEST(SingularScenes, SymmetricHalvesAtTheirLimitPoints) {
  for (const double step : {0.0, 0.01, 0.005, 0.002}) {
    TraceRequest request = ReadData("sym_51");
    request.options.step = step;
    request.options.max_increments = 3000;
    const TracedPath path = TraceTo(request, EndReason::kStopCriterion, kResidual);
    ExpectNear(LoadsOfKind(path, IncrementKind::kSmoothLimit), {0.05167840441, 0.05162508545}, 1e-10);
    for (const Increment& increment : path.increments)
      for (const char* node : {"n0", "n1", "n2"}) {
        const std::string left = std::string(node) + "L", right = std::string(node) + "R";
        EXPECT_NEAR(PositionX(path, increment, left), -PositionX(path, increment, right), 1e-6);
        EXPECT_NEAR(PositionY(path, increment, left), PositionY(path, increment, right), 1e-6);
      }
  }
}

// A spring of negative stiffness takes away the stiffness of the truss at rest: the start is a smooth limit point. Of
// the two signs of the load one has branches, the other has none.
TEST(SingularScenes, StartAtALimitPoint) {
  const double spring = -std::sqrt(0.5);
  TraceRequest request;
  request.scene.nodes = {{"a", -1.0, 0.0, true, true}, {"n", 0.0, 1.0, false, false}, {"b", 1.0, 0.0, true, true}};
  request.scene.bars = {{{"a", "n"}, 1.0}, {{"n", "b"}, 1.0}};
  request.scene.superelements = {{{"n"}, {1.0, 0.0, 0.0, spring}}};
  request.scene.loads = {{"n", 0.0, -1.0}};
  request.options.max_increments = 20;
  int begun = 0;
  for (const double direction : {1.0, -1.0}) {
    request.options.direction = direction;
    const TracedPath path = TraceVerified(request, kResidual);
    if (path.result.reason == EndReason::kPathEnd) continue;
    EXPECT_EQ(path.result.reason, EndReason::kMaxIncrements) << path.result.message;
    ++begun;
    EXPECT_EQ(path.increments[0].event.branches.size(), 2U);
    for (const Increment& increment : path.increments) {
      const double y = PositionY(path, increment, "n"), l = std::hypot(1.0, y);
      const double force = 2.0 * (l / std::sqrt(2.0) - 1.0) * y / l + spring * (y - 1.0);
      EXPECT_NEAR(increment.load_factor, -force, 1e-12);
      EXPECT_GE(direction * increment.load_factor, -1e-15);
    }
  }
  EXPECT_EQ(begun, 1);
}

// Imperfections down to rounding: the path goes on past the bifurcation that they break, or is one with it. Where the
// curves are so near that rounding moves points from one to the other, the path may end and say so.
TEST(SingularScenes, HighTrussWithTinyImperfections) {
  for (const double imperfection : {1e-6, 1e-10, 1e-12, 1e-13, 1e-14, 1e-16, 0.0})
    for (const Accuracy accuracy : kPresets) {
      TraceRequest request = ReadWithin("imperfect_truss", accuracy, 500);
      request.scene.loads[0].fx = imperfection;
      request.options.stop = {{"n.x", ">", 0.5}, {"n.y", "<", 1.0}};
      const TracedPath path = TraceVerified(request, kResidual);
      const bool lost = path.result.reason == EndReason::kNotDetermined && imperfection > 0.0 &&
                        imperfection <= 1e-12 &&
                        path.result.message.find("the sign of the motion along the path") != std::string::npos;
      EXPECT_TRUE(lost || path.result.reason == EndReason::kStopCriterion)
          << imperfection << ": " << path.result.message;
    }
}

// Straight bars resist a load across them only by the third power of the way: the start has neither a rate of the load
// nor a curvature, and the load goes on in the wanted sense with the apex on either side.
TEST(SingularScenes, FlatTruss) {
  for (const double direction : {1.0, -1.0})
    for (const Accuracy accuracy : kPresets) {
      TraceRequest request = ReadData("flat_truss");
      request.options.accuracy = accuracy;
      request.options.direction = direction;
      const TracedPath path = TraceTo(request, EndReason::kMaxIncrements, kResidual);
      for (const Increment& increment : path.increments) {
        const double depth = -increment.positions[3], length = std::hypot(1.0, depth);
        EXPECT_NEAR(increment.load_factor, 2.0 * (length - 1.0) * depth / length, 1e-10);
      }
      EXPECT_GT(path.increments.back().load_factor * direction, 0.1);
    }
}

// A step as long as wanted leaps from the symmetric path, which the imperfection ends, over to where it would go on,
// and there is no bifurcation in between: the path turns, and sways as the crossing path of the symmetric truss does.
TEST(SingularScenes, BrokenBifurcationOfATruss) {
  const auto load_when_swayed = [](const TraceRequest& request) {
    const TracedPath path = TraceTo(request, EndReason::kStopCriterion, kResidual);
    EXPECT_EQ(IncrementsOfKind(path, IncrementKind::kBifurcation).size(), request.options.branch_choices.size());
    const Increment &before = path.increments[path.increments.size() - 2], &last = path.increments.back();
    const double x = PositionX(path, last, "n1R"), moved = x - PositionX(path, before, "n1R");
    return last.load_factor + (last.load_factor - before.load_factor) * (0.2 - x) / moved;
  };
  TraceRequest symmetric = ReadData("broken_bifurcation");
  symmetric.scene.nodes[3].x = 0.75;
  symmetric.scene.nodes[5].x = 0.5;
  symmetric.scene.loads[0].fx = 0.0;
  symmetric.options.branch_choices = {{1, 0, 3}};
  const double expected = load_when_swayed(symmetric);
  for (const Accuracy accuracy : kPresets) {
    EXPECT_NEAR(load_when_swayed(ReadWithin("broken_bifurcation", accuracy, 1000)), expected, 1e-3);
  }
}

}  // namespace
}  // namespace contact_path::singular_trusses_test
