#include "contact_path/linear/blas.h"

#include <dlfcn.h>
#include <gtest/gtest.h>

namespace contact_path::blas_test {
namespace {

// 0: no OpenBLAS.
int Threads() {
  auto* const get = reinterpret_cast<int (*)()>(::dlsym(RTLD_DEFAULT, "openblas_get_num_threads"));
  return get == nullptr ? 0 : get();
}

TEST(Blas, ComputesWithOneThreadAndThenAsBefore) {
  const int before = Threads();
  if (before == 0) GTEST_SKIP() << LoadedBlas();
  {
    const OneBlasThread one_thread;
    EXPECT_EQ(Threads(), 1);
  }
  EXPECT_EQ(Threads(), before);
}

TEST(Blas, IsWarmedUpAsOftenAsOneLikes) {
  WarmUpBlas();
  WarmUpBlas();
}

TEST(Blas, AdviceForLargeStructuresOnTheReferenceBlas) {
  EXPECT_EQ(BlasAdvice(100), "");
  EXPECT_EQ(BlasAdvice(100000).empty(), LoadedBlas() != "reference BLAS");
}

}  // namespace
}  // namespace contact_path::blas_test
