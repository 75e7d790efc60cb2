// Lack of memory in any allocation of a solver is std::bad_alloc, and not a statement about the matrix.
#include <SuiteSparse_config.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "contact_path/linear/bordered_solver.h"
#include "contact_path/linear/minimum_norm.h"
#include "support/random.h"

namespace contact_path::out_of_memory_test {
namespace {

int allocations_left = 0;

void* AllocateWhileThereIs(std::size_t size) { return allocations_left-- > 0 ? std::malloc(size) : nullptr; }
void* AllocateZeroWhileThereIs(std::size_t count, std::size_t size) {
  return allocations_left-- > 0 ? std::calloc(count, size) : nullptr;
}
void* ReallocateWhileThereIs(void* memory, std::size_t size) {
  return allocations_left-- > 0 ? std::realloc(memory, size) : nullptr;
}

// SuiteSparse gets so many allocations while this lives.
class FewAllocations {
 public:
  explicit FewAllocations(int count) : before_(SuiteSparse_config) {
    allocations_left = count;
    SuiteSparse_config.malloc_func = AllocateWhileThereIs;
    SuiteSparse_config.calloc_func = AllocateZeroWhileThereIs;
    SuiteSparse_config.realloc_func = ReallocateWhileThereIs;
  }
  ~FewAllocations() { SuiteSparse_config = before_; }
  FewAllocations(const FewAllocations&) = delete;
  FewAllocations& operator=(const FewAllocations&) = delete;

 private:
  decltype(SuiteSparse_config) before_;
};

constexpr int kEnough = 2000;

// Calls attempt() with 0, 1, ... allocations until it needs no more: the number with which it first returned.
template <typename Attempt>
int FirstThatIsEnough(Attempt attempt) {
  for (int count = 0; count < kEnough; ++count) {
    const FewAllocations few(count);
    try {
      attempt();
      return count;
    } catch (const std::bad_alloc&) {
    }
  }
  return kEnough;
}

Eigen::SparseMatrix<double> RandomSquare(int size) {
  Random random(7);
  Eigen::MatrixXd matrix(size, size);
  for (int j = 0; j < size; ++j) matrix.col(j) = random.Vector(size, -1.0, 1.0);
  return matrix.sparseView();
}

TEST(OutOfMemory, OfTheSparseQr) {
  // Large, so that SuiteSparse factorises.
  Eigen::SparseMatrix<double> matrix = RandomSquare(30).leftCols(20);
  matrix.conservativeResize(kLargeSystem, 20);
  bool factorised = false;
  const int enough = FirstThatIsEnough([&] {
    MinimumNormSolver solver;
    factorised = solver.Factorize(matrix);
    EXPECT_EQ(solver.Rank(), 20);
    EXPECT_TRUE(solver.NullVector(0).allFinite());
    EXPECT_TRUE(solver.Solve(Eigen::VectorXd::Ones(20)).allFinite());
  });
  EXPECT_TRUE(factorised);
  EXPECT_GT(enough, 5);
  EXPECT_LT(enough, kEnough);
}

TEST(OutOfMemory, OfTheSparseLu) {
  const Eigen::SparseMatrix<double> matrix = RandomSquare(20).leftCols(19);
  bool regular = false;
  const int enough = FirstThatIsEnough([&] {
    BorderedSolver solver;
    regular = solver.FactorizeRegular(matrix, Eigen::VectorXd::Ones(20), 0.0);
    EXPECT_TRUE(solver.Solve(Eigen::VectorXd::Ones(19), 1.0).allFinite());
  });
  EXPECT_TRUE(regular);
  EXPECT_GT(enough, 5);
  EXPECT_LT(enough, kEnough);
}

}  // namespace
}  // namespace contact_path::out_of_memory_test
