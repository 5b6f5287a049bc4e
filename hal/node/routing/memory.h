#pragma once

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "hal/types/time.h"

namespace hal::node::routing {

/// Remembers what a node has seen recently. Forgets an entry kSpan after it was first noted, and
/// the oldest entries earlier if there are more than kMost.
template <class Key, class Value>
class Memory {
 public:
  /// Longer than the travel time of a packet through a few nodes that search for a route.
  static constexpr Duration kSpan = std::chrono::seconds{60};
  static constexpr std::size_t kMost = 65536;

  /// The entry, and whether it is new.
  std::pair<Value&, bool> note(const Key& key, Time now) {
    forget(now);
    const auto [entry, is_new] = entries_.try_emplace(key);
    if (is_new) ages_.emplace_back(now, key);
    return {entry->second, is_new};
  }

  /// Null if it was never noted or is forgotten.
  const Value* find(const Key& key) const {
    const auto entry = entries_.find(key);
    return entry == entries_.end() ? nullptr : &entry->second;
  }

  std::size_t size() const { return entries_.size(); }

 private:
  void forget(Time now) {
    while (oldest_ < ages_.size() &&
           (ages_[oldest_].first + kSpan < now || entries_.size() >= kMost)) {
      entries_.erase(ages_[oldest_++].second);
    }
    if (2 * oldest_ < ages_.size() || oldest_ == 0) return;
    ages_.erase(ages_.begin(), ages_.begin() + static_cast<std::ptrdiff_t>(oldest_));
    oldest_ = 0;
  }

  std::map<Key, Value> entries_;
  /// By age. A vector, because an empty deque takes half a kilobyte, and each of thousands of nodes
  /// has several.
  std::vector<std::pair<Time, Key>> ages_;
  std::size_t oldest_ = 0;  ///< Index in ages_; entries before it are forgotten.
};

/// Value type for sets of keys.
struct Seen {};

}  // namespace hal::node::routing
