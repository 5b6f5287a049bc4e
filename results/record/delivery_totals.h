#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"

namespace results::record {

/// Deliveries of the messages of one sender: how many, and how long they took, by receiver, kind of
/// message, and transmissions on the way.
class DeliveryTotals {
 public:
  struct Key {
    hal::AgentId receiver{};
    std::uint16_t transmissions = 0;
    std::uint32_t kind = 0;
    bool operator==(const Key&) const = default;
  };
  struct Total {
    Key key;
    bool changed = false;
    std::uint64_t count = 0;
    std::uint64_t bytes = 0;  ///< Of the payloads.
    std::uint64_t late = 0;   ///< So many of them without a delay.
    hal::Duration sum{};      ///< Of the delays.
    hal::Duration least = hal::Duration::max();
    hal::Duration greatest{};
  };

  /// @return whether it is the first of its key since its total was written.
  bool add(const Key& key, std::uint64_t bytes, std::optional<hal::Duration> delay);

  /// Those that changed since the last call, in the order in which their keys came.
  template <class Write>
  void write_changes(Write write) {
    for (Total& total : totals_) {
      if (total.changed) write(total);
      total.changed = false;
    }
  }

 private:
  Total& total_of(const Key& key);
  std::uint32_t* place_of(const Key& key);
  void grow();

  std::vector<Total> totals_;
  std::size_t next_ = 0;  ///< Behind the one found last: most senders reach the same, in order.
  std::vector<std::uint32_t>
      places_;  ///< Open addressing, linear probing; 0: free, else 1 + place.
};

}  // namespace results::record
