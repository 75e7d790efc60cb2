#include "process/keep_memory.h"

#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace contact_path {

void KeepMemory() {
#ifdef __GLIBC__
  constexpr int kKept = 1 << 30;  // [bytes]
  ::mallopt(M_MMAP_THRESHOLD, kKept);
  ::mallopt(M_TRIM_THRESHOLD, kKept);
#endif
}

}  // namespace contact_path
