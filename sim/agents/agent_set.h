#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hal/types/agent_id.h"

namespace sim::agents {

/// Set of agents: one bit for each address up to the highest that was ever in it.
class AgentSet {
 public:
  void insert(hal::AgentId agent) {
    const std::size_t word = agent.value / kBits;
    if (word >= words_.size()) [[unlikely]]
      words_.resize(word + 1);
    words_[word] |= std::uint64_t{1} << agent.value % kBits;
  }

  void erase(hal::AgentId agent) {
    const std::size_t word = agent.value / kBits;
    if (word < words_.size()) words_[word] &= ~(std::uint64_t{1} << agent.value % kBits);
  }

  /// Empties the set. @param visit  called with each agent that was in it, in order of addresses;
  /// must not insert.
  template <class Visit>
  void take(Visit visit) {
    for (std::size_t i = 0; i < words_.size(); ++i) {
      for (std::uint64_t word = words_[i]; word != 0; word &= word - 1) {
        const auto bit = static_cast<std::size_t>(std::countr_zero(word));
        visit(hal::AgentId{static_cast<std::uint16_t>(i * kBits + bit)});
      }
      words_[i] = 0;
    }
  }

 private:
  static constexpr std::size_t kBits = 64;

  std::vector<std::uint64_t> words_;
};

}  // namespace sim::agents
