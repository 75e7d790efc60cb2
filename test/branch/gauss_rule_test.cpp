#include "contact_path/branch/gauss_rule.h"

#include <gtest/gtest.h>

#include <cmath>

namespace contact_path::gauss_rule_test {
namespace {

template <std::size_t N>
double Integral(const GaussRule<N>& rule, int power) {
  double sum = 0.0;
  for (std::size_t i = 0; i < N; ++i) sum += rule.weights[i] * std::pow(rule.points[i], power);
  return sum;
}

TEST(GaussRule, IsExactUpToItsDegreeAndNoFurther) {
  for (int power = 0; power <= 7; ++power) EXPECT_NEAR(Integral(kGauss4, power), 1.0 / (power + 1), 1e-15) << power;
  EXPECT_GT(std::abs(Integral(kGauss4, 8) - 1.0 / 9.0), 1e-6);
  for (int power = 0; power <= 9; ++power) EXPECT_NEAR(Integral(kGauss5, power), 1.0 / (power + 1), 1e-15) << power;
  EXPECT_GT(std::abs(Integral(kGauss5, 10) - 1.0 / 11.0), 1e-7);
}

}  // namespace
}  // namespace contact_path::gauss_rule_test
