#include "contact_path/linear/generic_vector.h"

#include <gtest/gtest.h>

#include <cmath>

namespace contact_path::generic_vector_test {
namespace {

// Null vectors of symmetric structures, and of single unknowns.
TEST(GenericVector, IsNotOrthogonalToSymmetricOrAntisymmetricVectors) {
  for (const Eigen::Index size : {2, 3, 10, 101}) {
    const Eigen::VectorXd vector = GenericVector(size);
    ASSERT_EQ(vector.size(), size);
    Eigen::VectorXd symmetric = Eigen::VectorXd::Ones(size), odd(size);
    for (Eigen::Index i = 0; i < size; ++i) odd[i] = 2.0 * static_cast<double>(i) - static_cast<double>(size - 1);
    EXPECT_GT(std::abs(vector.dot(symmetric.normalized())) / vector.norm(), 0.1);
    EXPECT_GT(std::abs(vector.dot(odd.normalized())) / vector.norm(), 0.1);
    EXPECT_GT(vector.cwiseAbs().minCoeff() / vector.norm(), 0.1 / std::sqrt(static_cast<double>(size)));
  }
}

}  // namespace
}  // namespace contact_path::generic_vector_test
