// Runs a fuzz target over its corpus, seeds and bytes that once broke something, and over the corpus with random
// changes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

#include "fuzz/target.h"
#include "support/decisions.h"

namespace contact_path {
namespace {

using Bytes = std::vector<std::uint8_t>;

struct Seed {
  std::string name;
  Bytes bytes;
};

std::vector<Seed> Corpus() {
  std::vector<Seed> corpus;
  for (const auto& entry : std::filesystem::directory_iterator(CONTACT_PATH_CORPUS)) {
    std::ifstream stream(entry.path(), std::ios::binary);
    corpus.push_back({entry.path().filename().string(), {std::istreambuf_iterator<char>(stream), {}}});
  }
  std::sort(corpus.begin(), corpus.end(), [](const Seed& a, const Seed& b) { return a.name < b.name; });
  return corpus;
}

// name: told before, should it crash.
void ExpectPromisesKept(const std::string& name, const Bytes& bytes) {
  std::cout << name << std::endl;
  try {
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  } catch (const std::exception& error) {
    ADD_FAILURE() << name << ": " << error.what();
  }
}

// Some bytes of `bytes`, from anywhere.
Bytes Piece(const Bytes& bytes, Decisions* random) {
  if (bytes.empty()) return {};
  const std::size_t begin = random->Index(bytes.size());
  const std::size_t size = 1 + random->Index(std::min<std::size_t>(bytes.size() - begin, 40));
  const auto first = bytes.begin() + static_cast<std::ptrdiff_t>(begin);
  return {first, first + static_cast<std::ptrdiff_t>(size)};
}

// A byte set, a piece removed, or a piece of `other` put in.
void Change(const Bytes& other, Decisions* random, Bytes* bytes) {
  const auto at = bytes->begin() + static_cast<std::ptrdiff_t>(random->Index(bytes->size() + 1));
  switch (random->Index(3)) {
    case 0:
      if (at != bytes->end()) *at = static_cast<std::uint8_t>(random->Index(256));
      break;
    case 1:
      bytes->erase(
          at, at + std::min<std::ptrdiff_t>(bytes->end() - at, 1 + static_cast<std::ptrdiff_t>(random->Index(40))));
      break;
    default: {
      const Bytes piece = Piece(other, random);
      bytes->insert(at, piece.begin(), piece.end());
    }
  }
}

TEST(Corpus, BreaksNoPromise) {
  const std::vector<Seed> corpus = Corpus();
  ASSERT_FALSE(corpus.empty());
  for (const Seed& seed : corpus) ExpectPromisesKept(seed.name, seed.bytes);
}

TEST(Corpus, WithRandomChangesBreaksNoPromise) {
  const std::vector<Seed> corpus = Corpus();
  Decisions random(SplitMix64(1));
  for (int i = 0; i < CONTACT_PATH_CHANGED; ++i) {
    Bytes bytes = random.OneOf(corpus).bytes;
    for (std::size_t left = 1 + random.Index(4); left > 0; --left) Change(random.OneOf(corpus).bytes, &random, &bytes);
    ExpectPromisesKept("change " + std::to_string(i), bytes);
  }
}

}  // namespace
}  // namespace contact_path
