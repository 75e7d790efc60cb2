#include "process/one_thread.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>

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

}  // namespace contact_path
