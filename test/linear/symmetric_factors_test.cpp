#include "contact_path/linear/symmetric_factors.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "contact_path/linear/large_system.h"
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

TEST(SymmetricFactorsTest, InertiaAndSolutions) {
  SymmetricFactors factors;
  for (const Eigen::Index size : {1, 2, 5, 12, 40, 149, 151, 300}) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
      const Eigen::SparseMatrix<double> matrix = RandomMatrix(size, 4.0 / static_cast<double>(size), seed);
      const Eigen::MatrixXd dense = matrix;
      ASSERT_TRUE(factors.Factorize(matrix, size - (3 * size + 3) / 4)) << size << " " << seed;
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

// `copies` of a matrix on the diagonal, the constraints of all of them last.
Eigen::SparseMatrix<double> Repeated(const Eigen::SparseMatrix<double>& matrix, Eigen::Index constraints,
                                     Eigen::Index copies) {
  const Eigen::Index unknowns = matrix.rows() - constraints;
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index copy = 0; copy < copies; ++copy) {
    const auto place = [&](Eigen::Index k) {
      return static_cast<int>(k < unknowns ? copy * unknowns + k
                                           : copies * unknowns + copy * constraints + k - unknowns);
    };
    for (Eigen::Index column = 0; column < matrix.cols(); ++column)
      for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, column); it; ++it)
        entries.emplace_back(place(it.row()), place(column), it.value());
  }
  Eigen::SparseMatrix<double> repeated(copies * matrix.rows(), copies * matrix.cols());
  repeated.setFromTriplets(entries.begin(), entries.end());
  return repeated;
}

TEST(SymmetricFactorsTest, LargeMatrices) {
  const Eigen::SparseMatrix<double> part = RandomMatrix(40, 0.1, 1);
  const Eigen::Index copies = 80;
  const Eigen::SparseMatrix<double> matrix = Repeated(part, 10, copies);
  ASSERT_GE(matrix.rows(), kLargeSystem);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(Eigen::MatrixXd(part), Eigen::EigenvaluesOnly);
  SymmetricFactors factors;
  ASSERT_TRUE(factors.Factorize(matrix, 10 * copies));
  EXPECT_EQ(factors.NegativeEigenvalues(), copies * (solver.eigenvalues().array() < 0.0).count());
  const Eigen::MatrixXd wanted = Random(2).Vector(matrix.rows(), -1.0, 1.0);
  Eigen::MatrixXd x = matrix * wanted;
  factors.Solve(&x);
  EXPECT_LT((x - wanted).norm(), 1e-9 * wanted.norm());
}

// A chain of springs, one of them negative, and constraints that come and go: a constraint that is out of the system
// has its place, with a one on the diagonal.
TEST(SymmetricFactorsTest, ConstraintsThatComeAndGo) {
  const Eigen::Index unknowns = kLargeSystem, places = 10;
  SymmetricFactors updated;
  for (const unsigned acting : {0U, 1U, 5U, 5U, 2U, 0x3ffU, 0x3feU}) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < unknowns; ++i) {
      entries.emplace_back(i, i, i == 1000 ? -1.0 : 2.1);
      if (i > 0) entries.emplace_back(i, i - 1, -1.0);
      if (i > 0) entries.emplace_back(i - 1, i, -1.0);
    }
    for (int k = 0; k < places; ++k) {
      const bool acts = (acting >> k & 1U) != 0;
      const int place = static_cast<int>(unknowns) + k, at = 1000 + 7 * k;
      entries.emplace_back(place, place, acts ? 0.0 : 1.0);
      entries.emplace_back(place, at, acts ? -1.0 : 0.0);
      entries.emplace_back(at, place, acts ? -1.0 : 0.0);
    }
    Eigen::SparseMatrix<double> matrix(unknowns + places, unknowns + places);
    matrix.setFromTriplets(entries.begin(), entries.end());
    SymmetricFactors anew;
    ASSERT_TRUE(updated.Factorize(matrix, places)) << acting;
    ASSERT_TRUE(anew.Factorize(matrix, places)) << acting;
    EXPECT_EQ(updated.NegativeEigenvalues(), anew.NegativeEigenvalues()) << acting;
    const Eigen::MatrixXd wanted = Random(2).Vector(matrix.rows(), -1.0, 1.0);
    Eigen::MatrixXd x = matrix * wanted;
    updated.Solve(&x);
    EXPECT_LT((x - wanted).norm(), 1e-12 * wanted.norm()) << acting;
  }
}

// Regular matrices that have no factors without pivots of size two, or with small ones only.
TEST(SymmetricFactorsTest, SmallPivots) {
  SymmetricFactors factors;
  for (const double diagonal : {0.0, 1e-20, -1e-9, 1e-9}) {
    Eigen::SparseMatrix<double> matrix(8, 8);
    for (Eigen::Index i = 0; i < 8; i += 2) {
      matrix.coeffRef(i, i) = matrix.coeffRef(i + 1, i + 1) = diagonal;
      matrix.coeffRef(i, i + 1) = matrix.coeffRef(i + 1, i) = 2.0;
    }
    matrix.makeCompressed();
    ASSERT_TRUE(factors.Factorize(matrix, 0)) << diagonal;
    EXPECT_EQ(factors.NegativeEigenvalues(), 4) << diagonal;
    Eigen::MatrixXd x = Eigen::VectorXd::LinSpaced(8, 1.0, 8.0);
    const Eigen::MatrixXd b = x;
    factors.Solve(&x);
    EXPECT_LT((matrix * x - b).norm(), 1e-14) << diagonal;
  }
}

// A node that is held both ways, whatever its stiffness.
TEST(SymmetricFactorsTest, ConstraintsOfOneNode) {
  SymmetricFactors factors;
  for (const double angle : {0.0, 0.3, 0.8, 1.5}) {
    for (const double stiffness : {-1.0, -4.0, 1e-12, 1e6}) {
      Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(4, 4);
      dense.topLeftCorner(2, 2) << stiffness, 0.1, 0.1, stiffness;
      dense.topRightCorner(2, 2) << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
      dense.bottomLeftCorner(2, 2) = dense.topRightCorner(2, 2).transpose();
      ASSERT_TRUE(factors.Factorize(dense.sparseView(), 2)) << angle << " " << stiffness;
      EXPECT_EQ(factors.NegativeEigenvalues(), 2) << angle << " " << stiffness;
      Eigen::MatrixXd x = Eigen::Vector4d(1.0, 2.0, 0.5, -0.5);  // forces, and motions of the constraints
      const Eigen::Vector4d b = x;
      factors.Solve(&x);
      EXPECT_LT((dense * x - b).norm(), 1e-12 * std::max(1.0, stiffness)) << angle << " " << stiffness;
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
    EXPECT_FALSE(factors.Factorize(matrix, 0)) << size;
    matrix.coeffRef(0, 0) += 1.0;
    EXPECT_TRUE(factors.Factorize(matrix, 0)) << size;
    EXPECT_EQ(factors.NegativeEigenvalues(), 0) << size;
  }
}

}  // namespace
}  // namespace contact_path::symmetric_factors_test
