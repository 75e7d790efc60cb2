#include "contact_path/linear/bordered_solver.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <limits>

#include "support/dense.h"
#include "support/random.h"

namespace contact_path::bordered_solver_test {
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

// Each motion that is free is held by a spring that bears nothing: the shortest solution, as by QR.
TEST(BorderedSolver, HoldsKnownNullVectors) {
  MatrixXd jacobian(3, 4);          // two springs between three nodes in line, a load that they can bear
  jacobian << 1.0, -1.0, 0.0, 1.0,  //
      -1.0, 3.0, -2.0, 0.0,         //
      0.0, -2.0, 2.0, -1.0;
  const VectorXd row = Eigen::Vector4d(0.0, 0.0, 0.0, 1.0);
  const MatrixXd shift = Eigen::Vector4d(1.0, 1.0, 1.0, 0.0).normalized();
  BorderedSolver held, qr;
  VectorXd tangent;
  ASSERT_TRUE(held.FactorizeHeld(Transposed(jacobian), row, shift, nullptr, &tangent));
  ASSERT_EQ(tangent.size(), 4);
  ASSERT_TRUE(qr.Factorize(Transposed(jacobian), row));
  EXPECT_EQ(held.Nullity(), 1);
  EXPECT_EQ(qr.Nullity(), 1);
  EXPECT_EQ(held.DeterminantSign(), 0);
  const VectorXd b = jacobian * Eigen::Vector4d(0.3, -0.2, 0.7, 0.5);
  EXPECT_LE((held.Solve(b, 0.5) - qr.Solve(b, 0.5)).norm(), 1e-14);
  // A load that moves all nodes is borne by the spring alone.
  jacobian.col(3) << 1.0, 1.0, 1.0;
  ASSERT_TRUE(held.FactorizeHeld(Transposed(jacobian), row, shift, nullptr, &tangent));
  EXPECT_EQ(tangent.size(), 0);
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

// J: d_i x_i - x_{i+1} for i < n. With the null vector t of J, t_n = 1, det [J; row] = d_1 ... d_{n-1} (row . t).
struct Chain {
  Eigen::SparseMatrix<double> transposed;
  Eigen::VectorXd null_vector;
  int sign = 1;  // of d_1 ... d_{n-1}
};

Chain ChainOf(const Eigen::VectorXd& d) {
  const Eigen::Index n = d.size() + 1;
  Chain chain;
  std::vector<Eigen::Triplet<double>> entries;
  chain.null_vector = Eigen::VectorXd::Ones(n);
  for (Eigen::Index i = n - 1; i-- > 0;) {
    entries.emplace_back(i, i, d[i]);
    entries.emplace_back(i + 1, i, -1.0);
    chain.null_vector[i] = chain.null_vector[i + 1] / d[i];
    if (d[i] < 0.0) chain.sign = -chain.sign;
  }
  chain.transposed.resize(n, n - 1);
  chain.transposed.setFromTriplets(entries.begin(), entries.end());
  return chain;
}

// Large matrices are factorised without a row of many entries.
TEST(BorderedSolver, LargeWithARowOfManyEntries) {
  const Eigen::Index n = 30000;
  Eigen::VectorXd d = Eigen::VectorXd::Constant(n - 1, 1.1);
  BorderedSolver solver;
  for (const int negative : {0, 1, 2, 3}) {
    for (int i = 0; i < negative; ++i) d[7 * i + 5] = -1.2;
    const Chain chain = ChainOf(d);
    // The null vector is other than zero at the end alone; the last row is small there where the one before was not.
    for (const double at_end : {1.0, -1.0, 1e-3}) {
      Eigen::VectorXd row = Eigen::VectorXd::LinSpaced(n, 0.1, 0.5);
      row[n - 1] = at_end;
      ASSERT_TRUE(solver.Factorize(chain.transposed, row));
      EXPECT_EQ(solver.Nullity(), 0);
      EXPECT_EQ(solver.DeterminantSign(), chain.sign * (row.dot(chain.null_vector) > 0.0 ? 1 : -1)) << at_end;
      const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(n - 1, -1.0, 2.0);
      const Eigen::VectorXd x = solver.Solve(b, 0.7);
      EXPECT_LE((chain.transposed.transpose() * x - b).lpNorm<Eigen::Infinity>(), 1e-10 * x.lpNorm<Eigen::Infinity>());
      EXPECT_NEAR(row.dot(x), 0.7, 1e-9 * x.norm());
      Eigen::MatrixXd several, columns(n - 1, 2);
      columns << b, Eigen::VectorXd::Unit(n - 1, 3);
      solver.SolveAll(columns, &several);
      EXPECT_LE((chain.transposed.transpose() * several - columns).lpNorm<Eigen::Infinity>(),
                1e-10 * several.lpNorm<Eigen::Infinity>());
      EXPECT_LE((row.transpose() * several).lpNorm<Eigen::Infinity>(), 1e-9 * several.norm());
    }
  }
}

// By the factors of a matrix that differs from it in few equations, and with another row.
TEST(BorderedSolver, LargeWithFewChangedEquations) {
  const Eigen::Index n = 4000;
  Eigen::VectorXd d = Eigen::VectorXd::Constant(n - 1, 2.0);
  BorderedSolver updated;
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(n - 1, -1.0, 2.0), c = Eigen::VectorXd::LinSpaced(n, 1.0, 2.0);
  for (int changed = 0; changed < 40; changed += 3) {
    for (int i = 0; i < changed; ++i) d[n - 2 - i] = i % 2 == 0 ? -1.5 : 0.5;
    const Chain chain = ChainOf(d);
    Eigen::VectorXd row = Eigen::VectorXd::LinSpaced(n, 0.1, 0.5);
    ASSERT_TRUE(updated.FactorizeRegular(chain.transposed, row));
    for (const bool other : {false, true}) {
      if (other) {
        row = Eigen::VectorXd::Unit(n, n - 1);
        ASSERT_TRUE(updated.ReplaceRow(row));
      }
      BorderedSolver anew;
      ASSERT_TRUE(anew.FactorizeRegular(chain.transposed, row));
      EXPECT_EQ(updated.DeterminantSign(), anew.DeterminantSign()) << changed;
      const Eigen::VectorXd x = anew.Solve(b, 0.7), y = anew.SolveTransposed(c);
      EXPECT_LE((updated.Solve(b, 0.7) - x).norm(), 1e-10 * x.norm()) << changed;
      EXPECT_LE((updated.SolveTransposed(c) - y).norm(), 1e-10 * y.norm()) << changed;
    }
  }
}

TEST(BorderedSolver, LargeWithFewEntriesInTheRow) {
  const Eigen::Index n = 30000;
  const Chain chain = ChainOf(Eigen::VectorXd::Constant(n - 1, -1.1));
  BorderedSolver solver;
  ASSERT_TRUE(solver.FactorizeRegular(chain.transposed, Eigen::VectorXd::Unit(n, n - 2)));
  EXPECT_EQ(solver.DeterminantSign(), chain.sign * (chain.null_vector[n - 2] > 0.0 ? 1 : -1));
  const Eigen::VectorXd x = solver.Solve(Eigen::VectorXd::Zero(n - 1), 1.0);
  EXPECT_LE((x - chain.null_vector / chain.null_vector[n - 2]).norm(), 1e-10 * x.norm());
}

// The row is orthogonal to the null vector, or an equation says nothing.
TEST(BorderedSolver, LargeAndSingular) {
  const Eigen::Index n = 30000;
  Eigen::VectorXd d = Eigen::VectorXd::Constant(n - 1, 2.0);
  const Chain chain = ChainOf(d);
  Eigen::VectorXd row = Eigen::VectorXd::Ones(n);
  row -= row.dot(chain.null_vector) / chain.null_vector.squaredNorm() * chain.null_vector;
  BorderedSolver solver;
  EXPECT_FALSE(solver.FactorizeRegular(chain.transposed, row));
  Chain without = chain;
  without.transposed.coeffRef(0, 0) = 0.0;
  without.transposed.coeffRef(1, 0) = 0.0;
  EXPECT_FALSE(solver.FactorizeRegular(without.transposed, Eigen::VectorXd::Ones(n)));
  ASSERT_TRUE(solver.Factorize(without.transposed, Eigen::VectorXd::Ones(n)));
  EXPECT_EQ(solver.Nullity(), 1);
  EXPECT_EQ(solver.DeterminantSign(), 0);
}

// A matrix that is singular to rounding has no LU to solve with, whatever the solver has factorised before.
TEST(BorderedSolver, LargeAndNearlySingular) {
  const Eigen::Index n = 4000;
  // With 1.01 the null vector is 5e-18 of its largest entry where a border of ones is put, and there is no LU.
  const Chain regular = ChainOf(Eigen::VectorXd::Constant(n - 1, 1.001));
  BorderedSolver used;
  ASSERT_TRUE(used.FactorizeRegular(regular.transposed, Eigen::VectorXd::Ones(n)));
  EXPECT_TRUE(used.HasLu());
  EXPECT_NE(used.DeterminantSign(), 0);
  for (const double pivot : {1e-13, -1e-13}) {
    Chain chain = regular;
    chain.transposed.coeffRef(n - 2, n - 2) = pivot;
    chain.transposed.coeffRef(n - 1, n - 2) = 0.0;
    EXPECT_FALSE(used.FactorizeRegular(chain.transposed, Eigen::VectorXd::Unit(n, n - 1)));
    EXPECT_FALSE(used.HasLu());
    EXPECT_EQ(used.DeterminantSign(), 0);
  }
}

}  // namespace
}  // namespace contact_path::bordered_solver_test
