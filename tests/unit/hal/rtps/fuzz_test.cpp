#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <string>

#include "hal/rtps/validate.h"
#include "tests/unit/hal/rtps/datagrams.h"

namespace hal::rtps {
namespace {

/// Mutations to try; `ctest -L slow` tries more.
std::uint64_t rounds() {
  const char* given = std::getenv("BARAKA_FUZZ");
  return given == nullptr ? 200'000 : std::strtoull(given, nullptr, 10);
}

std::vector<Datagram> all_recorded() {
  std::vector<Datagram> all = recorded("fast_dds");
  std::ranges::copy(recorded("cyclone_dds"), std::back_inserter(all));
  return all;
}

/// Whether a part lies within the whole.
bool is_within(Octets part, Octets whole) {
  return part.empty() ||
         (part.data() >= whole.data() && part.data() + part.size() <= whole.data() + whole.size());
}

/// Looks at a copy of exactly its size on the heap, so that the address sanitizer sees a step
/// beyond the end, and at all that the walk tells of it. @return whether nothing is wrong.
bool look_at(const Datagram& datagram) {
  const auto copy = std::make_unique<std::byte[]>(datagram.size());
  std::ranges::copy(octets_of(datagram), copy.get());
  const Octets octets(copy.get(), datagram.size());
  Walk walk(octets);
  std::size_t at = Header::kSize;
  while (const Submessage* one = walk.next()) {
    EXPECT_TRUE(is_within(one->body, octets));
    EXPECT_EQ(one->at, at);
    EXPECT_FALSE(name_of(one->kind).empty() || name_of(one->reader()).empty());
    at += one->size();
  }
  EXPECT_TRUE(walk.fault() || at == octets.size());
  const auto result = validate(octets);
  EXPECT_TRUE(!walk.fault() || !result);
  EXPECT_TRUE(result || !result.error().message.empty());
  return result.has_value();
}

class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : dice_(seed) {}

  Datagram mutated(const std::vector<Datagram>& corpus) {
    Datagram datagram = corpus[below(corpus.size())];
    for (std::size_t i = 1 + below(8); i > 0; --i) change(datagram);
    if (below(5) == 0) datagram.resize(below(datagram.size() + 1));
    if (below(20) == 0) splice(datagram, corpus[below(corpus.size())]);
    return datagram;
  }

 private:
  std::size_t below(std::size_t n) { return n == 0 ? 0 : dice_() % n; }

  /// An octet, or the number of two or four, that is at the edge of something.
  void change(Datagram& datagram) {
    if (datagram.size() < 8) return;
    const std::size_t at = below(datagram.size() - 4);
    constexpr std::uint8_t kEdges[] = {0, 1, 3, 4, 0x7f, 0x80, 0xfc, 0xff};
    const std::size_t width = std::size_t{1} << below(3);
    for (std::size_t i = 0; i < width; ++i) {
      datagram[at + i] =
          below(2) == 0 ? kEdges[below(std::size(kEdges))] : static_cast<std::uint8_t>(below(256));
    }
  }
  void splice(Datagram& datagram, const Datagram& other) {
    const std::size_t from = below(other.size());
    datagram.insert(datagram.end(), other.begin() + static_cast<std::ptrdiff_t>(from), other.end());
  }

  std::mt19937_64 dice_;
};

TEST(Fuzz, NothingIsReadBeyondTheEndOfAMutatedDatagram) {
  const std::vector<Datagram> corpus = all_recorded();
  Mutator mutator(1);
  std::uint64_t good = 0;
  const std::uint64_t count = rounds();
  for (std::uint64_t i = 0; i < count && !testing::Test::HasFailure(); ++i) {
    good += look_at(mutator.mutated(corpus)) ? 1 : 0;
  }
  // Neither everything nor nothing is refused: the mutations reach behind the first check.
  EXPECT_GT(good, count / 100);
  EXPECT_LT(good, count);
}

TEST(Fuzz, EveryDatagramMayEndAnywhere) {
  for (const Datagram& one : all_recorded()) {
    for (std::size_t size = 0; size < one.size(); ++size) {
      look_at({one.begin(), one.begin() + static_cast<std::ptrdiff_t>(size)});
      ASSERT_FALSE(testing::Test::HasFailure()) << "of " << one.size() << " octets, " << size;
    }
  }
}

TEST(Fuzz, EveryOctetMayBeAnything) {
  for (const Datagram& one : all_recorded()) {
    for (std::size_t at = 0; at < std::min<std::size_t>(one.size(), 120); ++at) {
      for (const int value : {0, 1, 2, 4, 0x7f, 0x80, 0xfe, 0xff}) {
        Datagram changed = one;
        changed[at] = static_cast<std::uint8_t>(value);
        look_at(changed);
      }
    }
  }
}

}  // namespace
}  // namespace hal::rtps
