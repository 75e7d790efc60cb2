#include "contact_path/ros/memory_share.h"

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>

#include "contact_path/ros/names.h"

namespace contact_path {
namespace {

constexpr double kLeast = 128.0;  // MB: what the stacks of the threads reserve, and a small trace

// The shadow memory of these counts as data: terabytes.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kCountable = false;
#else
constexpr bool kCountable = true;
#endif

constexpr double kRaise = 64.0;  // MB at a time

template <typename Number>
double InMegabytes(Number bytes) {
  return static_cast<double>(bytes) / static_cast<double>(kMegabyte);
}

thread_local int scopes_within_limit = 0;

bool SetLimit(double megabytes) {
  struct rlimit limit {};
  if (::getrlimit(RLIMIT_DATA, &limit) != 0) return false;
  limit.rlim_cur = static_cast<rlim_t>(megabytes * static_cast<double>(kMegabyte));
  return ::setrlimit(RLIMIT_DATA, &limit) == 0;
}

// Called where operator new has found no memory.
void RefuseOrRaise() {
  struct rlimit limit {};
  const bool raises = scopes_within_limit == 0 && ::getrlimit(RLIMIT_DATA, &limit) == 0 &&
                      SetLimit(InMegabytes(limit.rlim_cur) + kRaise);
  if (!raises) throw std::bad_alloc();
}

// What the allocator keeps for later.
double FreeMegabytes() {
#if __GLIBC_PREREQ(2, 33)
  return InMegabytes(::mallinfo2().fordblks);
#else
  return InMegabytes(static_cast<unsigned>(::mallinfo().fordblks));
#endif
}

}  // namespace

double DataMegabytes() {
  if (!kCountable) return 0.0;
  // Pages: size, resident, shared, text, lib, data.
  std::ifstream pages("/proc/self/statm");
  double value = 0.0;
  for (int column = 0; column < 6; ++column) pages >> value;
  return InMegabytes(value * static_cast<double>(::sysconf(_SC_PAGESIZE)));
}

bool TakesMoreThan(double megabytes) {
  const double data = DataMegabytes();
  return data > megabytes && data - FreeMegabytes() > megabytes;
}

void ReturnFreeMemory() { ::malloc_trim(0); }

void LimitData(int megabytes) {
  if (megabytes == 0 || !kCountable) return;
  const double used = DataMegabytes();
  if (used + kLeast > kShareOfTraces * megabytes) {
    throw std::invalid_argument("~" + std::string(names::kMaxMemory) + " = " + std::to_string(megabytes) +
                                ": the node itself takes " + std::to_string(static_cast<int>(used)) +
                                ", most of it reserved by the BLAS, and needs " +
                                std::to_string(static_cast<int>(kLeast)) + " besides");
  }
  if (!SetLimit(megabytes))
    throw std::invalid_argument("~" + std::string(names::kMaxMemory) + ": " + std::generic_category().message(errno));
  std::set_new_handler(RefuseOrRaise);
}

WithinLimit::WithinLimit(int megabytes) {
  if (megabytes > 0 && kCountable) SetLimit(megabytes);
  ++scopes_within_limit;
}

WithinLimit::~WithinLimit() { --scopes_within_limit; }

}  // namespace contact_path
