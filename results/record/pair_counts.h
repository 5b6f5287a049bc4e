#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/prefetch.h"

namespace results::record {

/// Counts events by kind for pairs of agents. Made for millions of pairs: one word each. Counting
/// takes constant time, and for write_changes() a count that has not changed costs only its memory.
///
/// The counts of one first agent are stored together: if hundreds of radios sense a frame and its
/// transmitter is the first agent, their counts are likely to be in the cache.
class PairCounts {
 public:
  static constexpr int kKindBits = 8;

  /// @param kind  below 2^kKindBits.
  void add(hal::AgentId first, hal::AgentId second, std::uint8_t kind) {
    if (first.value >= tables_.size()) tables_.resize(first.value + 1u);
    ++added_;
    largest_ = std::max(largest_, second.value);
    if (tables_[first.value].add((std::uint32_t{second.value} << kKindBits) | kind)) ++changed_;
  }

  /// Prefetches counts of this first agent, before several are added.
  void prefetch(hal::AgentId first) const {
    if (first.value < tables_.size()) tables_[first.value].prefetch();
  }

  /// Calls write(first, second, kind, count) for each count that has grown since the last call,
  /// ordered by first, second, kind.
  template <class Write>
  void write_changes(Write write) {
    for (std::size_t first = 0; first < tables_.size(); ++first) {
      changes_.clear();
      tables_[first].take_changes(all(), static_cast<std::uint16_t>(first), changes_);
      write_sorted(Change::by_first, write);
    }
    end_of_writing();
  }

  /// The same, ordered by second, first, kind.
  template <class Write>
  void write_changes_by_second(Write write) {
    // In passes over all tables, so that what is sorted needs little memory.
    const std::uint32_t passes = static_cast<std::uint32_t>(changed_ / kSorted) + 1;
    const std::uint32_t width = largest_ / passes + 1;
    for (std::uint32_t low = 0; changed_ > 0 && low <= largest_; low += width) {
      const Seconds range{low, low + width};
      changes_.clear();
      for (std::size_t first = 0; first < tables_.size(); ++first)
        tables_[first].take_changes(range, static_cast<std::uint16_t>(first), changes_);
      write_sorted(Change::by_second, write);
    }
    end_of_writing();
  }

  std::uint64_t added() const { return added_; }      ///< Events since the last write_changes().
  std::uint64_t changed() const { return changed_; }  ///< Counts that these events changed.

 private:
  static constexpr std::uint64_t kSorted = 1U << 17U;

  /// Range of addresses of second agents: low <= address < high.
  struct Seconds {
    std::uint32_t low = 0, high = 0;
  };
  Seconds all() const { return {0, largest_ + 1u}; }

  struct Change {
    std::uint16_t first = 0, second = 0;
    std::uint8_t kind = 0;
    std::uint64_t count = 0;

    static std::uint64_t by_first(const Change& c) { return order(c.first, c.second, c.kind); }
    static std::uint64_t by_second(const Change& c) { return order(c.second, c.first, c.kind); }
    static std::uint64_t order(std::uint64_t high, std::uint64_t middle, std::uint64_t low) {
      return (high << 32U) | (middle << 16U) | low;
    }
  };

  void end_of_writing() {
    std::vector<Change>().swap(changes_);
    added_ = changed_ = 0;
  }

  template <class Order, class Write>
  void write_sorted(Order order, Write& write) {
    std::ranges::sort(changes_, {}, order);
    for (const Change& c : changes_)
      write(hal::AgentId{c.first}, hal::AgentId{c.second}, c.kind, c.count);
  }

  /// Counts of one first agent: a hash table with open addressing and linear probing (D. E. Knuth,
  /// "The Art of Computer Programming", vol. 3, 6.4, algorithm L). A word consists, from high bits
  /// to low, of the key (24 bits), a flag for changed (1), and the count (39), which is at least 1;
  /// a word 0 is free.
  class Table {
   public:
    /// @return whether the count has not changed before since it was last taken.
    bool add(std::uint32_t key);
    /// Sixteen cache lines at most.
    void prefetch() const {
      hal::prefetch(words_.data(),
                    std::min(words_.size() * sizeof(std::uint64_t), 16 * hal::kCacheLine));
    }
    /// Appends the changed counts whose second agents are in the range, and marks them unchanged.
    void take_changes(Seconds range, std::uint16_t first, std::vector<Change>& changes);

   private:
    std::size_t place_of(std::uint32_t key) const;
    void grow();

    std::vector<std::uint64_t> words_;
    std::uint32_t used_ = 0;
    std::uint32_t changed_ = 0;
  };

  std::vector<Table> tables_;    ///< By address.
  std::uint16_t largest_ = 0;    ///< Address of a second agent.
  std::vector<Change> changes_;  ///< Only during a write.
  std::uint64_t added_ = 0;
  std::uint64_t changed_ = 0;
};

}  // namespace results::record
