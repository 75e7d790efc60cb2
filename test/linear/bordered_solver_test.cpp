#include "contact_path/linear/bordered_solver.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "support/dense.h"
#include "support/random.h"

namespace contact_path {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Sparse in places: about half of the entries are zero.
MatrixXd RandomMatrix(Random* random, Index rows, Index columns) {
  MatrixXd matrix = MatrixXd::Zero(rows, columns);
  for (Index j = 0; j < columns; ++j)
    for (Index i = 0; i < rows; ++i)
      if (i == j || random->Number(0.0, 1.0) < 0.5) matrix(i, j) = random->Number(-1.0, 1.0);
  return matrix;
}

Eigen::SparseMatrix<double> Transposed(const MatrixXd& jacobian) {
  Eigen::SparseMatrix<double> sparse = MatrixXd(jacobian.transpose()).sparseView();
  sparse.makeCompressed();
  return sparse;
}

MatrixXd Bordered(const MatrixXd& jacobian, const VectorXd& row) {
  MatrixXd matrix(jacobian.rows() + 1, jacobian.cols());
  matrix << jacobian, row.transpose();
  return matrix;
}

TEST(BorderedSolver, SolvesRegularSystems) {
  Random random(1);
  double worst = 0.0;
  for (int i = 0; i < 200; ++i) {
    const Index n = 2 + static_cast<Index>(random.Number(0.0, 20.0));
    const MatrixXd jacobian = RandomMatrix(&random, n - 1, n);
    const VectorXd row = random.Vector(n, -1.0, 1.0), b = random.Vector(n, -1.0, 1.0);
    const MatrixXd matrix = Bordered(jacobian, row);
    const VectorXd values = Decompose(matrix).values;
    if (values[0] > 1e4 * values[n - 1]) continue;
    BorderedSolver solver;
    ASSERT_TRUE(solver.Factorize(Transposed(jacobian), row));
    EXPECT_EQ(solver.Nullity(), 0);
    const VectorXd x = solver.Solve(b.head(n - 1), b[n - 1]);
    worst = std::max(worst, (matrix * x - b).norm() / (1.0 + x.norm()));
    EXPECT_EQ(solver.DeterminantSign(), matrix.determinant() > 0.0 ? 1 : -1);
  }
  EXPECT_LE(worst, 1e-12);
}

TEST(BorderedSolver, RowMayHaveZerosAndBeReplaced) {
  MatrixXd jacobian(1, 2);
  jacobian << 2.0, 1.0;
  BorderedSolver solver;
  ASSERT_TRUE(solver.Factorize(Transposed(jacobian), Eigen::Vector2d(0.0, 1.0)));
  EXPECT_EQ(solver.DeterminantSign(), 1);
  EXPECT_TRUE(solver.Solve(VectorXd::Constant(1, 5.0), 1.0).isApprox(Eigen::Vector2d(2.0, 1.0), 1e-15));
  ASSERT_TRUE(solver.Factorize(Transposed(jacobian), Eigen::Vector2d(1.0, 0.0)));
  EXPECT_EQ(solver.DeterminantSign(), -1);
  EXPECT_TRUE(solver.Solve(VectorXd::Constant(1, 5.0), 1.0).isApprox(Eigen::Vector2d(1.0, 3.0), 1e-15));
}

TEST(BorderedSolver, ShortestSolutionWhereSingular) {
  Random random(2);
  double worst = 0.0;
  for (int i = 0; i < 100; ++i) {
    const Index n = 4 + static_cast<Index>(random.Number(0.0, 12.0));
    // Two equations depend on others.
    MatrixXd jacobian = RandomMatrix(&random, n - 1, n);
    jacobian.row(n - 2) = 0.5 * jacobian.row(0) - 2.0 * jacobian.row(1);
    jacobian.row(n - 3) = jacobian.row(0);
    const VectorXd row = random.Vector(n, -1.0, 1.0);
    const MatrixXd matrix = Bordered(jacobian, row);
    const SingularValueDecomposition dense = Decompose(matrix);
    const Index rank = dense.Rank(1e-10);
    if (dense.values[0] > 1e4 * dense.values[rank - 1]) continue;
    const VectorXd b = matrix * random.Vector(n, -1.0, 1.0);
    BorderedSolver solver;
    ASSERT_TRUE(solver.Factorize(Transposed(jacobian), row));
    EXPECT_EQ(solver.Nullity(), n - rank);
    EXPECT_EQ(solver.DeterminantSign(), 0);
    const VectorXd x = solver.Solve(b.head(n - 1), b[n - 1]);
    worst = std::max(worst, (x - ShortestSolution(matrix, b)).norm() / (1.0 + x.norm()));
  }
  EXPECT_LE(worst, 1e-11);
}

TEST(BorderedSolver, ShortestSolutionWhereNotSquare) {
  Random random(3);
  double worst = 0.0;
  for (int i = 0; i < 100; ++i) {
    const Index unknowns = 6, missing = 1 + i % 4;
    const MatrixXd jacobian = RandomMatrix(&random, unknowns - 1 - missing, unknowns);
    const VectorXd row = random.Vector(unknowns, -1.0, 1.0);
    const MatrixXd matrix = Bordered(jacobian, row);
    const VectorXd values = Decompose(matrix).values;
    if (values[0] > 1e4 * values[matrix.rows() - 1]) continue;
    BorderedSolver solver;
    ASSERT_TRUE(solver.Factorize(Transposed(jacobian), row));
    EXPECT_EQ(solver.Nullity(), missing);
    EXPECT_EQ(solver.DeterminantSign(), 0);
    const VectorXd b = random.Vector(matrix.rows(), -1.0, 1.0);
    const VectorXd x = solver.Solve(b.head(b.size() - 1), b[b.size() - 1]);
    worst = std::max(worst, (x - ShortestSolution(matrix, b)).norm() / (1.0 + x.norm()));
  }
  EXPECT_LE(worst, 1e-11);
}

// More equations than unknowns, but consistent: a redundant contact.
TEST(BorderedSolver, LeavesOutRedundantEquations) {
  MatrixXd jacobian(3, 3);
  jacobian << 1.0, 0.0, 0.0,  //
      0.0, 1.0, 0.0,          //
      2.0, -1.0, 0.0;
  BorderedSolver solver;
  ASSERT_TRUE(solver.Factorize(Transposed(jacobian), Eigen::Vector3d(0.0, 0.0, 2.0)));
  EXPECT_EQ(solver.Nullity(), 0);
  EXPECT_EQ(solver.DeterminantSign(), 0);
  EXPECT_TRUE(solver.Solve(Eigen::Vector3d(1.0, 2.0, 0.0), 6.0).isApprox(Eigen::Vector3d(1.0, 2.0, 3.0), 1e-14));
}

TEST(BorderedSolver, SingularWhereTheDeterminantChangesItsSign) {
  // det [J(a); row] = a.
  const auto jacobian = [](double a) {
    MatrixXd matrix(2, 3);
    matrix << 1.0, 2.0, 0.0,  //
        0.5, 1.0 + a, 0.0;
    return matrix;
  };
  const VectorXd row = Eigen::Vector3d(0.0, 0.0, 1.0);
  BorderedSolver solver;
  for (const double a : {1e-3, 1e-9}) {
    ASSERT_TRUE(solver.Factorize(Transposed(jacobian(a)), row));
    EXPECT_EQ(solver.DeterminantSign(), 1);
    ASSERT_TRUE(solver.Factorize(Transposed(jacobian(-a)), row));
    EXPECT_EQ(solver.DeterminantSign(), -1);
  }
  ASSERT_TRUE(solver.Factorize(Transposed(jacobian(0.0)), row));
  EXPECT_EQ(solver.DeterminantSign(), 0);
  EXPECT_EQ(solver.Nullity(), 1);
}

TEST(BorderedSolver, RefusesWhatIsNotFinite) {
  MatrixXd jacobian(1, 2);
  BorderedSolver solver;
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    jacobian << bad, 1.0;
    EXPECT_FALSE(solver.Factorize(Transposed(jacobian), Eigen::Vector2d(0.0, 1.0)));
    jacobian << 1.0, 1.0;
    EXPECT_FALSE(solver.Factorize(Transposed(jacobian), Eigen::Vector2d(bad, 1.0)));
  }
  // It can be used again afterwards.
  EXPECT_TRUE(solver.Factorize(Transposed(jacobian), Eigen::Vector2d(0.0, 1.0)));
}

}  // namespace
}  // namespace contact_path
