// Random decisions, the same on every system: the standard library's distributions differ from one to another.
#ifndef CONTACT_PATH_TEST_SUPPORT_DECISIONS_H_
#define CONTACT_PATH_TEST_SUPPORT_DECISIONS_H_

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>

namespace contact_path {

// A source of bits: SplitMix64 (Steele, Lea, Flood 2014).
class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : state_(Mix(seed * 0xD1B54A32D192ED03U)) {}

  std::uint64_t operator()() {
    state_ += 0x9E3779B97F4A7C15U;
    return Mix(state_);
  }
  static std::uint64_t Mix(std::uint64_t z) {
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31U);
  }

 private:
  std::uint64_t state_;
};

class Decisions {
 public:
  // bits: 64 random ones at each call.
  explicit Decisions(std::function<std::uint64_t()> bits) : bits_(std::move(bits)) {}

  double Number(double lower, double upper) {
    return lower + (upper - lower) * std::ldexp(static_cast<double>(bits_() >> 11U), -53);
  }
  // 0..count - 1.
  std::size_t Index(std::size_t count) { return static_cast<std::size_t>(bits_() % count); }
  bool Chance(double probability) { return Number(0.0, 1.0) < probability; }
  template <typename List>
  const auto& OneOf(const List& list) {
    return list[Index(list.size())];
  }

 private:
  std::function<std::uint64_t()> bits_;
};

}  // namespace contact_path

#endif  // CONTACT_PATH_TEST_SUPPORT_DECISIONS_H_
