// How many random scenes a test looks at.
#ifndef CONTACT_PATH_TEST_SUPPORT_SEEDS_H_
#define CONTACT_PATH_TEST_SUPPORT_SEEDS_H_

#include <cstdlib>

namespace contact_path {

// All of them where CONTACT_PATH_LONG is set (scripts/stress long), otherwise a quarter.
inline double ShareOfSeeds() { return std::getenv("CONTACT_PATH_LONG") == nullptr ? 0.25 : 1.0; }
inline unsigned Seeds(unsigned all) { return static_cast<unsigned>(ShareOfSeeds() * all); }
// A count that is found among all of them, with some luck left.
template <typename Count>
Count AtLeast(Count among_all) {
  return static_cast<Count>(ShareOfSeeds() * static_cast<double>(among_all));
}

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SUPPORT_SEEDS_H_
