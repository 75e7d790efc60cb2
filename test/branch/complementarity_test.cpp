// Toy problems w = M z + q, 0 <= w, 0 <= z, w . z = 0.
#include "contact_path/branch/complementarity.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <set>
#include <vector>

#include "support/random.h"

namespace contact_path::complementarity_test {
namespace {

constexpr double kRounding = 1e-10;

using Basis = std::vector<bool>;

Eigen::MatrixXd RandomMatrix(Random* random, Eigen::Index size) {
  Eigen::MatrixXd matrix(size, size);
  for (Eigen::Index j = 0; j < size; ++j) matrix.col(j) = random->Vector(size, -1.0, 1.0);
  return matrix;
}

// Symmetric part positive definite, so that it is a P-matrix.
Eigen::MatrixXd RandomPMatrix(Random* random, Eigen::Index size) {
  const Eigen::MatrixXd root = RandomMatrix(random, size), turn = RandomMatrix(random, size);
  return root * root.transpose() + 0.1 * Eigen::MatrixXd::Identity(size, size) + turn - turn.transpose();
}

bool Solves(const Eigen::MatrixXd& M, const Eigen::VectorXd& q, const Basis& second) {
  const Eigen::Index n = q.size();
  Eigen::MatrixXd equations = Eigen::MatrixXd::Identity(n, n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    if (!second[static_cast<std::size_t>(i)]) continue;
    equations.row(i) = M.row(i);
    right[i] = -q[i];
  }
  const Eigen::VectorXd z = equations.partialPivLu().solve(right), w = M * z + q;
  return z.minCoeff() >= -kRounding && w.minCoeff() >= -kRounding && std::abs(z.dot(w)) <= kRounding;
}

// By trying all of them.
std::set<Basis> AllBases(const Eigen::MatrixXd& M, const Eigen::VectorXd& q) {
  std::set<Basis> bases;
  for (int set = 0; set < 1 << q.size(); ++set) {
    Basis second;
    for (Eigen::Index i = 0; i < q.size(); ++i) second.push_back((set >> i) % 2 == 1);
    if (Solves(M, q, second)) bases.insert(second);
  }
  return bases;
}

std::set<Basis> Found(const Eigen::MatrixXd& M, const Eigen::VectorXd& q) {
  std::set<Basis> bases;
  for (const ComplementaritySolution& solution : SolveComplementarity(M, q)) bases.insert(solution);
  return bases;
}

TEST(Complementarity, OneSolutionByCertificate) {
  Random random(3);
  for (const Eigen::Index n : {1, 2, 3, 4, 5, 6, 7, 12}) {
    const Eigen::MatrixXd M = RandomPMatrix(&random, n);
    const Eigen::VectorXd q = random.Vector(n, -1.0, 1.0);
    for (const double sense : {1.0, -1.0}) {
      EXPECT_TRUE(HasOneSolutionForEach(M));
      const std::vector<ComplementaritySolution> solutions = SolveComplementarity(M, sense * q);
      ASSERT_EQ(solutions.size(), 1U);
      EXPECT_EQ(AllBases(M, sense * q), std::set<Basis>{solutions[0]});
    }
  }
}

TEST(Complementarity, TwoSolutionsAreNotTheOnlyOnes) {
  Eigen::Matrix2d M;
  M << 1.0, -2.0, -2.0, 1.0;
  const Eigen::Vector2d q(1.0, 1.0);
  EXPECT_FALSE(HasOneSolutionForEach(M));
  EXPECT_EQ(Found(M, q), (std::set<Basis>{{false, false}, {true, true}}));  // z = 0, z = (1, 1)
}

// One pair, then all of them, has w = z = 0, but for rounding.
TEST(Complementarity, PairsWhoseModesTheRatesHide) {
  Random random(5);
  for (const double rounding : {0.0, 1e-12, -1e-12}) {
    const Eigen::MatrixXd M = RandomPMatrix(&random, 4);
    const Eigen::Vector4d z(0.7, 0.0, 0.0, 0.4), w(0.0, 0.5, rounding, 0.0);
    const std::vector<ComplementaritySolution> one = SolveComplementarity(M, w - M * z);
    ASSERT_EQ(one.size(), 1U);
    EXPECT_TRUE(one[0][0] && !one[0][1] && one[0][3]);
    EXPECT_EQ(SolveComplementarity(M, Eigen::Vector4d::Zero()).size(), 1U);
  }
}

// What comes out solves the problem, whatever the matrix; for matrices without negative entries and with a positive
// diagonal there is a solution, and one is found.
TEST(Complementarity, OtherMatrices) {
  Random random(4);
  int found = 0;
  for (int round = 0; round < 300; ++round) {
    const Eigen::Index n = 2 + round % 6;
    Eigen::MatrixXd M = RandomMatrix(&random, n);
    const bool positive = round % 2 == 0;
    if (positive) M = (M.cwiseAbs() + Eigen::MatrixXd::Identity(n, n)).eval();
    const Eigen::VectorXd q = random.Vector(n, -1.0, 1.0);
    const std::set<Basis> bases = Found(M, q);
    EXPECT_TRUE(!positive || !bases.empty()) << round;
    found += !bases.empty();
    for (const Basis& second : bases) EXPECT_TRUE(Solves(M, q, second)) << round;
  }
  EXPECT_GT(found, 150);
}

// Without a diagonal; then with all entries of q alike, so that each pivot is a tie.
TEST(Complementarity, RaysAndTies) {
  Eigen::Matrix2d turn;
  turn << 0.0, -1.0, 1.0, 0.0;
  EXPECT_FALSE(HasOneSolutionForEach(turn));
  EXPECT_TRUE(Found(turn, Eigen::Vector2d(-1.0, -1.0)).empty());
  EXPECT_EQ(Found(turn, Eigen::Vector2d(1.0, -1.0)), (std::set<Basis>{{true, true}}));
  const Eigen::Index n = 40;
  Eigen::MatrixXd chain = 2.0 * Eigen::MatrixXd::Identity(n, n);
  chain.diagonal(1).setConstant(-1.0);
  chain.diagonal(-1).setConstant(-1.0);
  EXPECT_EQ(Found(chain, Eigen::VectorXd::Constant(n, -1.0)), (std::set<Basis>{Basis(n, true)}));
}

// Springs under a load f with unilateral supports of the gaps g: K x - G' z = f, w - G x = g. Without x it is w = G
// K^-1 G' z + G K^-1 f + g, which has one solution; stiffnesses over six decades, and more supports than one makes
// factors for.
TEST(Complementarity, FreeVariables) {
  Random random(6);
  for (const double stiffness : {1e-3, 1.0, 1e3})
    for (const Eigen::Index n : {2, 6, 150}) {
      const Eigen::MatrixXd root = RandomMatrix(&random, n);
      const Eigen::MatrixXd K = stiffness * (root * root.transpose() + Eigen::MatrixXd::Identity(n, n));
      const Eigen::MatrixXd G = RandomMatrix(&random, n);
      const Eigen::VectorXd f = random.Vector(n, -1.0, 1.0), g = random.Vector(n, 0.0, 0.1) / stiffness;
      Eigen::MatrixXd equations = Eigen::MatrixXd::Zero(2 * n, 3 * n);
      equations.topLeftCorner(n, n) = K;
      equations.topRightCorner(n, n) = -G.transpose();
      equations.bottomLeftCorner(n, n) = -G;
      equations.block(n, n, n, n).setIdentity();
      Eigen::VectorXd right(2 * n);
      right << f, g;
      const auto found = SolveByLemke({equations.sparseView(), right, n, Eigen::VectorXd::Constant(n, 1e-9)},
                                      Eigen::VectorXd::Ones(n));
      const Eigen::LLT<Eigen::MatrixXd> factors(K);
      const Eigen::MatrixXd M = G * factors.solve(G.transpose());
      ASSERT_TRUE(found);
      EXPECT_TRUE(Solves(stiffness * M, stiffness * (G * factors.solve(f) + g), *found)) << stiffness << ' ' << n;
      EXPECT_TRUE(std::count(found->begin(), found->end(), true) > 0 || n < 100);
    }
}

}  // namespace
}  // namespace contact_path::complementarity_test
