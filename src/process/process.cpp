#include "process/process.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "contact_path/linear/blas.h"

namespace contact_path {

void UseOneThread(char** argv) {
  constexpr char kThreads[] = "OMP_NUM_THREADS";
  if (std::getenv(kThreads) != nullptr || ::setenv(kThreads, "1", /*overwrite=*/0) != 0) {
    WarmUpBlas();
    return;
  }
  std::error_code unknown;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", unknown);
  if (!unknown) ::execv(program.c_str(), argv);
  WarmUpBlas();
}

void KeepMemory() {
#ifdef __GLIBC__
  for (const int threshold : {M_MMAP_THRESHOLD, M_TRIM_THRESHOLD}) ::mallopt(threshold, 1 << 30);  // [bytes]
#endif
}

}  // namespace contact_path
