#include "contact_path/linear/symmetric_factors.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "support/random.h"

namespace contact_path::symmetric_factors_test {
namespace {

// Symmetric, with a random pattern of this density; the last quarter of its diagonal is zero, as of constraints.
Eigen::SparseMatrix<double> RandomMatrix(Eigen::Index size, double density, unsigned seed) {
  Random random(seed);
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(size, size);
  for (Eigen::Index j = 0; j < size; ++j) {
    if (4 * j < 3 * size) dense(j, j) = random.Number(-1.0, 3.0);
    for (Eigen::Index i = 0; i < j; ++i)
      if (4 * i < 3 * size && random.Number(0.0, 1.0) < density)
        dense(i, j) = dense(j, i) = std::pow(10.0, random.Number(-2.0, 2.0));
    if (4 * j >= 3 * size) dense(j - 3 * size / 4, j) = dense(j, j - 3 * size / 4) = 1.0;
  }
  return dense.sparseView();
}

// Small ones by LAPACK, large ones by MUMPS.
TEST(SymmetricFactorsTest, InertiaAndSolutions) {
  SymmetricFactors factors;
  for (const Eigen::Index size : {1, 2, 5, 12, 40, 149, 151, 300}) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
      const Eigen::SparseMatrix<double> matrix = RandomMatrix(size, 4.0 / static_cast<double>(size), seed);
      const Eigen::MatrixXd dense = matrix;
      ASSERT_TRUE(factors.Factorize(matrix)) << size << " " << seed;
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(dense, Eigen::EigenvaluesOnly);
      EXPECT_EQ(factors.NegativeEigenvalues(), (solver.eigenvalues().array() < 0.0).count()) << size << " " << seed;
      Random random(seed + 100);
      Eigen::MatrixXd x(size, 2);
      for (Eigen::Index j = 0; j < 2; ++j) x.col(j) = random.Vector(size, -1.0, 1.0);
      const Eigen::MatrixXd b = dense * x, wanted = x;
      x = b;
      factors.Solve(&x);
      const double condition = solver.eigenvalues().cwiseAbs().maxCoeff() / solver.eigenvalues().cwiseAbs().minCoeff();
      EXPECT_LT((x - wanted).norm(), 1e-13 * condition * wanted.norm()) << size << " " << seed;
    }
  }
}

TEST(SymmetricFactorsTest, SingularMatrices) {
  SymmetricFactors factors;
  for (const Eigen::Index size : {3, 200}) {
    Eigen::SparseMatrix<double> matrix(size, size);
    for (Eigen::Index i = 0; i + 1 < size; ++i) {  // a chain that nothing holds
      matrix.coeffRef(i, i) += 1.0;
      matrix.coeffRef(i + 1, i + 1) += 1.0;
      matrix.coeffRef(i, i + 1) = matrix.coeffRef(i + 1, i) = -1.0;
    }
    matrix.makeCompressed();
    EXPECT_FALSE(factors.Factorize(matrix)) << size;
    matrix.coeffRef(0, 0) += 1.0;
    EXPECT_TRUE(factors.Factorize(matrix)) << size;
    EXPECT_EQ(factors.NegativeEigenvalues(), 0) << size;
  }
}

}  // namespace
}  // namespace contact_path::symmetric_factors_test
