#include "contact_path/branch/complementarity.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <vector>

#include "support/random.h"

namespace contact_path::complementarity_test {
namespace {

constexpr double kRounding = 1e-10;

Eigen::MatrixXd RandomMatrix(Random* random, Eigen::Index size) {
  Eigen::MatrixXd matrix(size, size);
  for (Eigen::Index j = 0; j < size; ++j) matrix.col(j) = random->Vector(size, -1.0, 1.0);
  return matrix;
}

// z with these basic: of w = 0 there.
Eigen::VectorXd SolutionOf(const Eigen::MatrixXd& M, const Eigen::VectorXd& q, const std::vector<bool>& basic) {
  const Eigen::Index n = q.size();
  Eigen::MatrixXd equations = Eigen::MatrixXd::Identity(n, n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    if (!basic[static_cast<std::size_t>(i)]) continue;
    equations.row(i) = M.row(i);
    right[i] = -q[i];
  }
  return equations.fullPivLu().solve(right);
}

bool Solves(const Eigen::MatrixXd& M, const Eigen::VectorXd& q, const std::vector<bool>& basic) {
  const Eigen::VectorXd z = SolutionOf(M, q, basic), w = M * z + q;
  return z.minCoeff() >= -kRounding && w.minCoeff() >= -kRounding && std::abs(z.dot(w)) <= kRounding;
}

// The number of all sets of basic variables that solve the problem.
int CountByEnumeration(const Eigen::MatrixXd& M, const Eigen::VectorXd& q) {
  int count = 0;
  for (int set = 0; set < 1 << q.size(); ++set) {
    std::vector<bool> basic;
    for (Eigen::Index i = 0; i < q.size(); ++i) basic.push_back((set >> i) % 2 == 1);
    count += Solves(M, q, basic);
  }
  return count;
}

TEST(Complementarity, PositiveDefiniteMatricesHaveOneSolution) {
  Random random(3);
  for (int round = 0; round < 200; ++round) {
    const Eigen::Index n = 1 + round % 7;
    const Eigen::MatrixXd root = RandomMatrix(&random, n), turn = RandomMatrix(&random, n);
    const Eigen::MatrixXd M = root * root.transpose() + 0.1 * Eigen::MatrixXd::Identity(n, n) + turn - turn.transpose();
    ASSERT_TRUE(HasOneSolutionForEach(M));
    const Eigen::VectorXd q = random.Vector(n, -1.0, 1.0);
    EXPECT_EQ(CountByEnumeration(M, q), 1);
    const auto basic = SolveByLemke(M, q, Eigen::VectorXd::Ones(n));
    ASSERT_TRUE(basic) << round;
    EXPECT_TRUE(Solves(M, q, *basic)) << round;
  }
}

// What comes out solves the problem, whatever the matrix; for matrices without negative entries and with a positive
// diagonal there is a solution, and it is found.
TEST(Complementarity, OtherMatrices) {
  Random random(4);
  int found = 0;
  for (int round = 0; round < 300; ++round) {
    const Eigen::Index n = 2 + round % 6;
    Eigen::MatrixXd M = RandomMatrix(&random, n);
    const bool positive = round % 2 == 0;
    if (positive) M = (M.cwiseAbs() + Eigen::MatrixXd::Identity(n, n)).eval();
    const Eigen::VectorXd q = random.Vector(n, -1.0, 1.0);
    const auto basic = SolveByLemke(M, q, Eigen::VectorXd::Ones(n));
    if (positive) {
      ASSERT_TRUE(basic) << round;
    }
    if (!basic) continue;
    ++found;
    EXPECT_TRUE(Solves(M, q, *basic)) << round;
  }
  EXPECT_GT(found, 150);
}

TEST(Complementarity, MatrixWithoutADiagonal) {
  Eigen::Matrix2d M;
  M << 0.0, -1.0, 1.0, 0.0;
  EXPECT_FALSE(HasOneSolutionForEach(M));
  EXPECT_FALSE(SolveByLemke(M, Eigen::Vector2d(-1.0, -1.0), Eigen::Vector2d(1.0, 1.0)));
  const auto basic = SolveByLemke(M, Eigen::Vector2d(1.0, -1.0), Eigen::Vector2d(1.0, 1.0));
  ASSERT_TRUE(basic);
  EXPECT_TRUE(Solves(M, Eigen::Vector2d(1.0, -1.0), *basic));
}

// All entries of q alike: each pivot is a tie.
TEST(Complementarity, TiesEnd) {
  const Eigen::Index n = 40;
  Eigen::MatrixXd M = 2.0 * Eigen::MatrixXd::Identity(n, n);
  M.diagonal(1).setConstant(-1.0);
  M.diagonal(-1).setConstant(-1.0);
  const Eigen::VectorXd q = Eigen::VectorXd::Constant(n, -1.0);
  const auto basic = SolveByLemke(M, q, Eigen::VectorXd::Ones(n));
  ASSERT_TRUE(basic);
  EXPECT_TRUE(Solves(M, q, *basic));
}

}  // namespace
}  // namespace contact_path::complementarity_test
