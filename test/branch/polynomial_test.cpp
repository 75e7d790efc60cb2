#include "contact_path/branch/polynomial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "support/random.h"

namespace contact_path::polynomial_test {
namespace {

constexpr double kTolerance = 1e-11;

// Coefficients of factor (t - r0) (t - r1) ...; at most five roots.
Quintic WithRoots(const std::vector<double>& roots, double factor) {
  Quintic result{};
  result[0] = factor;
  for (const double root : roots) {
    for (std::size_t i = result.size() - 1; i > 0; --i) result[i] = result[i - 1] - root * result[i];
    result[0] *= -root;
  }
  return result;
}

Quintic RandomQuintic(Random* random) {
  Quintic polynomial{};
  for (double& coefficient : polynomial) coefficient = random->Number(-1.0, 1.0);
  return polynomial;
}

Jet JetAt(const Quintic& polynomial, double t) {
  const Quintic first = Derivative(polynomial);
  return {Evaluate(polynomial, t), Evaluate(first, t), Evaluate(Derivative(first), t)};
}

TEST(HermiteQuintic, GivesBackEveryQuintic) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const double length = std::pow(10.0, random.Number(-3.0, 0.5));
    Quintic polynomial = RandomQuintic(&random);
    double power = 1.0;
    for (double& coefficient : polynomial) {  // all terms of the same size at the end
      coefficient /= power;
      power *= length;
    }
    const Quintic result = HermiteQuintic(JetAt(polynomial, 0.0), JetAt(polynomial, length), length);
    power = 1.0;
    for (std::size_t k = 0; k < result.size(); ++k) {
      EXPECT_NEAR(result[k] * power, polynomial[k] * power, 1e-12) << "coefficient " << k << ", length " << length;
      power *= length;
    }
  }
}

TEST(Roots, FindsAllRootsInAscendingOrder) {
  const std::vector<std::vector<double>> cases = {
      {},     {0.3}, {0.3, 0.7},       {0.1, 0.2, 0.95},       {0.2, 0.4, 0.6, 0.8}, {0.1, 0.3, 0.5, 0.7, 0.9},
      {-0.5}, {1.5}, {-0.5, 0.5, 1.5}, {0.999999, -0.2, -0.3}, {0.5, 0.5 + 1e-4},    {1e-6, 0.5}};
  for (const std::vector<double>& all : cases) {
    for (const double factor : {1.0, -3.0, 1e-6, 1e6}) {
      std::vector<double> inside;
      for (const double root : all)
        if (root > 0.0 && root <= 1.0) inside.push_back(root);
      std::sort(inside.begin(), inside.end());
      int count = 0;
      const std::array<double, 5> roots = Roots(WithRoots(all, factor), 1.0, &count);
      ASSERT_EQ(count, static_cast<int>(inside.size()));
      for (std::size_t i = 0; i < inside.size(); ++i) EXPECT_NEAR(roots[i], inside[i], 1e-11);
    }
  }
}

TEST(Roots, CountsARootAtTheEndAndNoneAtTheStart) {
  int count = 0;
  std::array<double, 5> roots = Roots(WithRoots({0.75}, 1.0), 0.75, &count);
  ASSERT_EQ(count, 1);
  EXPECT_EQ(roots[0], 0.75);
  roots = Roots(WithRoots({0.0, 0.5}, 1.0), 1.0, &count);
  ASSERT_EQ(count, 1);
  EXPECT_NEAR(roots[0], 0.5, 1e-14);
}

// Against signs on a fine grid: every change of sign has a root in it, and there are no others.
TEST(Roots, AgreesWithTheSignsOnAGrid) {
  Random random(3);
  constexpr int kCells = 2000;
  int found = 0;
  for (int i = 0; i < 500; ++i) {
    const double length = random.Number(0.1, 3.0);
    const Quintic polynomial = RandomQuintic(&random);
    int count = 0;
    const std::array<double, 5> roots = Roots(polynomial, length, &count);
    std::vector<double> expected;
    double before = Evaluate(polynomial, 0.0);
    for (int k = 1; k <= kCells; ++k) {
      const double after = Evaluate(polynomial, length * k / kCells);
      if (before * after < 0.0) expected.push_back(length * (k - 0.5) / kCells);
      before = after;
    }
    ASSERT_EQ(count, static_cast<int>(expected.size()));
    for (std::size_t k = 0; k < expected.size(); ++k) {
      EXPECT_NEAR(roots[k], expected[k], 0.51 * length / kCells);
      EXPECT_NEAR(Evaluate(polynomial, roots[k]), 0.0, 1e-12);
    }
    found += count;
  }
  EXPECT_GT(found, 200);
}

TEST(FirstNegative, FindsWhereThePolynomialTurnsNegative) {
  EXPECT_NEAR(FirstNegative(WithRoots({0.3}, -1.0), 1.0, kTolerance).value(), 0.3, 1e-14);
  EXPECT_NEAR(FirstNegative(WithRoots({0.3, 0.6}, 1.0), 1.0, kTolerance).value(), 0.3, 1e-14);
  EXPECT_NEAR(FirstNegative(WithRoots({0.3, 0.3, 0.3}, -1.0), 1.0, kTolerance).value(), 0.3, 1e-4);
  // At the very end.
  EXPECT_EQ(FirstNegative(WithRoots({0.5}, -1.0), 0.5, kTolerance).value(), 0.5);
}

TEST(FirstNegative, NothingWhereItStaysPositive) {
  EXPECT_FALSE(FirstNegative({1.0, 0.0, 0.0, 0.0, 0.0, 0.0}, 1.0, kTolerance));
  EXPECT_FALSE(FirstNegative(WithRoots({1.5}, -1.0), 1.0, kTolerance));
  EXPECT_FALSE(FirstNegative(WithRoots({-0.5}, 1.0), 1.0, kTolerance));
  // It comes down to 1e-6 and goes up again.
  Quintic near = WithRoots({0.5, 0.5}, 1.0);
  near[0] += 1e-6;
  EXPECT_FALSE(FirstNegative(near, 1.0, kTolerance));
  near[0] -= 2e-6;
  EXPECT_NEAR(FirstNegative(near, 1.0, kTolerance).value(), 0.5 - 1e-3, 1e-12);
}

TEST(FirstNegative, AStartAtZeroCountsByWhatComesNext) {
  EXPECT_FALSE(FirstNegative({0.0, 1.0, 0.0, 0.0, 0.0, 0.0}, 1.0, kTolerance));
  EXPECT_EQ(FirstNegative({0.0, -1.0, 0.0, 0.0, 0.0, 0.0}, 1.0, kTolerance).value(), 0.0);
  EXPECT_FALSE(FirstNegative({0.0, 0.0, 1.0, 0.0, 0.0, 0.0}, 1.0, kTolerance));
  EXPECT_EQ(FirstNegative({0.0, 0.0, -1.0, 0.0, 0.0, 0.0}, 1.0, kTolerance).value(), 0.0);
  EXPECT_EQ(FirstNegative({0.0, 0.0, 0.0, -1.0, 0.0, 0.0}, 1.0, kTolerance).value(), 0.0);
  // Rises from zero and comes back.
  EXPECT_NEAR(FirstNegative({0.0, 1.0, -2.0, 0.0, 0.0, 0.0}, 1.0, kTolerance).value(), 0.5, 1e-14);
  EXPECT_NEAR(FirstNegative({0.0, 0.0, 1.0, -4.0, 0.0, 0.0}, 1.0, kTolerance).value(), 0.25, 1e-14);
}

TEST(FirstNegative, RoundingAtTheStartIsZero) {
  for (const double rounding : {5e-12, -5e-12}) {
    EXPECT_FALSE(FirstNegative({rounding, 1.0, 0.0, 0.0, 0.0, 0.0}, 1.0, kTolerance)) << rounding;
    EXPECT_EQ(FirstNegative({rounding, -1.0, 0.0, 0.0, 0.0, 0.0}, 1.0, kTolerance).value(), 0.0) << rounding;
    EXPECT_FALSE(FirstNegative({rounding, rounding, 1.0, 0.0, 0.0, 0.0}, 1.0, kTolerance)) << rounding;
  }
  // A dip within rounding next to the start, as of a double root, does not count; one that is deeper does.
  EXPECT_FALSE(FirstNegative({0.0, -1e-6, 1.0, 0.0, 0.0, 0.0}, 1.0, kTolerance));
  EXPECT_EQ(FirstNegative({0.0, -1e-5, 1.0, 0.0, 0.0, 0.0}, 1.0, kTolerance).value(), 0.0);
  EXPECT_NEAR(FirstNegative({0.0, -1e-6, 1.0, -2.0, 0.0, 0.0}, 1.0, kTolerance).value(), 0.5, 1e-5);
  // What is zero throughout, but for rounding, holds.
  EXPECT_FALSE(FirstNegative({}, 1.0, kTolerance));
  EXPECT_FALSE(FirstNegative({-5e-12, 3e-12, -2e-12, 1e-12, -4e-12, 2e-12}, 1.0, kTolerance));
  // Beyond the tolerance it does not.
  EXPECT_EQ(FirstNegative({-1e-10, 0.0, 0.0, 0.0, 0.0, 0.0}, 1.0, kTolerance).value(), 0.0);
}

// Against the values on a grid.
TEST(FirstNegative, AgreesWithTheSignsOnAGrid) {
  Random random(4);
  constexpr int kCells = 2000;
  int negative = 0;
  for (int i = 0; i < 500; ++i) {
    const double length = random.Number(0.1, 3.0);
    Quintic polynomial = RandomQuintic(&random);
    polynomial[0] = std::abs(polynomial[0]) + 0.01;
    double expected = std::numeric_limits<double>::infinity();
    for (int k = kCells; k >= 1; --k)
      if (Evaluate(polynomial, length * k / kCells) < 0.0) expected = length * (k - 0.5) / kCells;
    const std::optional<double> result = FirstNegative(polynomial, length, kTolerance);
    ASSERT_EQ(result.has_value(), std::isfinite(expected));
    if (!result) continue;
    EXPECT_NEAR(*result, expected, 0.51 * length / kCells);
    ++negative;
  }
  EXPECT_GT(negative, 100);
}

TEST(QuinticThrough, ReproducesQuintics) {
  Random random(6);
  for (int i = 0; i < 100; ++i) {
    const double length = random.Number(0.1, 3.0);
    const Quintic polynomial = RandomQuintic(&random);
    std::array<double, 6> values{};
    for (std::size_t k = 0; k < 6; ++k) values[k] = Evaluate(polynomial, QuinticNode(k, length));
    const Quintic through = QuinticThrough(values, length);
    for (int k = 0; k <= 20; ++k)
      EXPECT_NEAR(Evaluate(through, length * k / 20.0), Evaluate(polynomial, length * k / 20.0), 1e-11);
  }
}

TEST(Minimum, IsTheSmallestValueAndItsPlace) {
  double where = -1.0;
  EXPECT_NEAR(Minimum(WithRoots({0.25, 0.75}, 1.0), 1.0, &where), -0.0625, 1e-15);
  EXPECT_NEAR(where, 0.5, 1e-12);
  EXPECT_EQ(Minimum({2.0, 1.0, 0.0, 0.0, 0.0, 0.0}, 1.0, &where), 2.0);
  EXPECT_EQ(where, 0.0);
  EXPECT_EQ(Minimum({2.0, -1.0, 0.0, 0.0, 0.0, 0.0}, 0.5, &where), 1.5);
  EXPECT_EQ(where, 0.5);
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    const double length = random.Number(0.1, 3.0);
    const Quintic polynomial = RandomQuintic(&random);
    const double minimum = Minimum(polynomial, length, &where);
    EXPECT_EQ(minimum, Evaluate(polynomial, where));
    for (int k = 0; k <= 1000; ++k) EXPECT_GE(Evaluate(polynomial, length * k / 1000.0), minimum - 1e-12);
  }
}

}  // namespace
}  // namespace contact_path::polynomial_test
