#include "results/record/pair_counts.h"

#include <gtest/gtest.h>

#include <map>
#include <tuple>

#include "hal/types/random.h"

namespace results::record {
namespace {

using hal::AgentId;
using Key = std::tuple<AgentId, AgentId, int>;

/// What write_changes() hands over, and whether it does so in order.
std::map<Key, std::uint64_t> changes_of(PairCounts& counts) {
  std::map<Key, std::uint64_t> changes;
  counts.write_changes([&](AgentId agent, AgentId other, std::uint8_t kind, std::uint64_t count) {
    const Key key{agent, other, kind};
    EXPECT_TRUE(changes.empty() || changes.rbegin()->first < key);
    changes[key] = count;
  });
  return changes;
}

TEST(PairCounts, HandsOverWhatChangedInOrderAndNothingElse) {
  PairCounts counts;
  counts.add(AgentId{2}, AgentId{1}, 7);
  counts.add(AgentId{1}, AgentId{0xffff}, 255);
  counts.add(AgentId{1}, AgentId{0xffff}, 255);
  counts.add(AgentId{1}, AgentId{0}, 0);
  EXPECT_EQ(counts.added(), 4u);
  EXPECT_EQ(counts.changed(), 3u);
  const std::map<Key, std::uint64_t> first{{{AgentId{1}, AgentId{0}, 0}, 1},
                                           {{AgentId{1}, AgentId{0xffff}, 255}, 2},
                                           {{AgentId{2}, AgentId{1}, 7}, 1}};
  EXPECT_EQ(changes_of(counts), first);
  EXPECT_EQ(counts.changed(), 0u);
  EXPECT_TRUE(changes_of(counts).empty());
  counts.add(AgentId{2}, AgentId{1}, 7);
  const std::map<Key, std::uint64_t> second{{{AgentId{2}, AgentId{1}, 7}, 2}};
  EXPECT_EQ(changes_of(counts), second);
}

TEST(PairCounts, HandsOverByTheSecondAgentInSeveralPassesAsWellAsInOne) {
  PairCounts counts;
  std::map<Key, std::uint64_t> expected;  // by second, first, kind
  for (std::uint16_t first = 1; first <= 600; ++first) {
    for (std::uint16_t second = 1; second <= 400; ++second) {
      counts.add(AgentId{first}, AgentId{second}, static_cast<std::uint8_t>(first % 3));
      expected[{AgentId{second}, AgentId{first}, first % 3}] = 1;
    }
  }
  ASSERT_EQ(counts.changed(), 240'000u);  // more than are sorted at once
  std::map<Key, std::uint64_t> changes;
  counts.write_changes_by_second(
      [&](AgentId first, AgentId second, std::uint8_t kind, std::uint64_t count) {
        const Key key{second, first, kind};
        EXPECT_TRUE(changes.empty() || changes.rbegin()->first < key);
        changes[key] = count;
      });
  EXPECT_EQ(changes, expected);
  EXPECT_EQ(counts.changed(), 0u);
  EXPECT_TRUE(changes_of(counts).empty());
}

TEST(PairCounts, CountsAsAMapDoes) {
  PairCounts counts;
  std::map<Key, std::uint64_t> expected;
  hal::RandomStream random(1, "pairs");
  for (int i = 0; i < 100'000; ++i) {
    const AgentId agent{static_cast<std::uint16_t>(random.below(20))};
    const AgentId other{static_cast<std::uint16_t>(random.below(65536) & 0xf0ffU)};
    const auto kind = static_cast<std::uint8_t>(random.below(3));
    counts.add(agent, other, kind);
    ++expected[{agent, other, kind}];
  }
  EXPECT_EQ(counts.added(), 100'000u);
  EXPECT_EQ(counts.changed(), expected.size());
  EXPECT_EQ(changes_of(counts), expected);
}

}  // namespace
}  // namespace results::record
