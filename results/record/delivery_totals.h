#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"

namespace results::record {

/// Totals of the deliveries of one sender's messages: their number and delay, by receiver, kind of
/// message, and number of transmissions on the way.
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
    std::uint64_t bytes = 0;  ///< Total size of the payloads.
    std::uint64_t late = 0;   ///< Deliveries without a known delay.
    hal::Duration sum{};      ///< Sum of the delays.
    hal::Duration least = hal::Duration::max();
    hal::Duration greatest{};
  };

  /// @return whether this is the first change of its total since that was written.
  bool add(const Key& key, std::uint64_t bytes, std::optional<hal::Duration> delay);

  /// Calls write(total) for each total that changed since the last call, in order of first
  /// occurrence.
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
  /// Index after the one found last: most senders reach the same receivers in the same order.
  std::size_t next_ = 0;
  /// Open addressing, linear probing; 0: free, else 1 + index in totals_.
  std::vector<std::uint32_t> places_;
};

}  // namespace results::record
