#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/check.h"

namespace hal::node::exchange {

/// One value per agent: look-up by address in constant time, iteration in the order of addresses.
///
///   AgentTable<State> states;
///   states[agent] = …;
///   for (const auto& [id, state] : states) …
template <class T>
class AgentTable {
 public:
  using Entry = std::pair<AgentId, T>;

  /// Adds an empty value if there is none; cheap if the address is above all others.
  T& operator[](AgentId agent) {
    if (T* found = find(agent)) return *found;
    if (agent.value >= index_.size()) index_.resize(agent.value + 1u, kNone);
    const auto place = std::ranges::lower_bound(entries_, agent, {}, &Entry::first);
    for (auto later = place; later != entries_.end(); ++later) ++index_[later->first.value];
    index_[agent.value] = static_cast<std::uint32_t>(place - entries_.begin());
    return entries_.insert(place, Entry{agent, T{}})->second;
  }

  /// Null if there is none. Valid until the next agent is added.
  T* find(AgentId agent) {
    return contains(agent) ? &entries_[index_[agent.value]].second : nullptr;
  }
  const T* find(AgentId agent) const {
    return contains(agent) ? &entries_[index_[agent.value]].second : nullptr;
  }

  /// @pre contains(agent).
  T& at(AgentId agent) {
    T* found = find(agent);
    BARAKA_CHECK(found != nullptr);
    return *found;
  }
  const T& at(AgentId agent) const {
    const T* found = find(agent);
    BARAKA_CHECK(found != nullptr);
    return *found;
  }

  bool contains(AgentId agent) const {
    return agent.value < index_.size() && index_[agent.value] != kNone;
  }
  std::size_t size() const { return entries_.size(); }

  auto begin() { return entries_.begin(); }
  auto end() { return entries_.end(); }
  auto begin() const { return entries_.begin(); }
  auto end() const { return entries_.end(); }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  std::vector<Entry> entries_;        ///< Sorted by address.
  std::vector<std::uint32_t> index_;  ///< Address to index in entries_.
};

}  // namespace hal::node::exchange
