#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hal/types/agent_id.h"

namespace sim::record {

/// How often something of a kind happened between an agent and another one. Made for millions of
/// pairs: one word each. Between two calls of write_changes() the cost of a count is constant, and
/// those that did not change cost nothing but their memory.
class PairCounts {
 public:
  static constexpr int kKindBits = 8;

  /// @param kind  below 2^kKindBits.
  void add(hal::AgentId agent, hal::AgentId other, std::uint8_t kind) {
    if (agent.value >= tables_.size()) tables_.resize(agent.value + 1u);
    ++added_;
    if (tables_[agent.value].add((std::uint32_t{other.value} << kKindBits) | kind)) ++changed_;
  }

  /// Calls write(agent, other, kind, count) for each count that grew since the last call, in that
  /// order.
  template <class Write>
  void write_changes(Write write) {
    for (std::size_t agent = 0; agent < tables_.size(); ++agent) {
      for (const Change& change : tables_[agent].take_changes()) {
        write(hal::AgentId{static_cast<std::uint16_t>(agent)},
              hal::AgentId{static_cast<std::uint16_t>(change.key >> kKindBits)},
              static_cast<std::uint8_t>(change.key), change.count);
      }
    }
    added_ = changed_ = 0;
  }

  std::uint64_t added() const { return added_; }      ///< Since the last write_changes(), and
  std::uint64_t changed() const { return changed_; }  ///< how many counts that changed.

 private:
  struct Change {
    std::uint32_t key;
    std::uint64_t count;
  };

  /// Of one agent: a hash table with open addressing and linear probing (D. E. Knuth, "The Art of
  /// Computer Programming", vol. 3, 6.4, algorithm L). A word is, from high bits to low, the key
  /// (24), whether it changed (1), and the count (39), which is at least 1; 0: free.
  class Table {
   public:
    /// @return whether this is the first change since take_changes().
    bool add(std::uint32_t key);
    std::vector<Change> take_changes();

   private:
    std::size_t place_of(std::uint32_t key) const;
    void grow();

    std::vector<std::uint64_t> words_;
    std::uint32_t used_ = 0;
    bool changed_ = false;
  };

  std::vector<Table> tables_;  ///< By address.
  std::uint64_t added_ = 0;
  std::uint64_t changed_ = 0;
};

}  // namespace sim::record
