#pragma once

#include <cstdint>
#include <map>

#include "hal/types/agent_id.h"

namespace sim::radio {

/// Recognises a data frame that was received before and was retransmitted because its ACK was lost
/// (IEEE Std 802.11-2016, 10.3.2.11): same transmitter, same sequence number, retry bit set.
class DuplicateFilter {
 public:
  /// Whether the frame is a duplicate. Stores the sequence number for the next call.
  bool is_duplicate(hal::AgentId transmitter, std::uint16_t sequence, bool retry) {
    const auto [known, is_new] = last_.try_emplace(transmitter, sequence);
    if (is_new) return false;
    const bool same = known->second == sequence;
    known->second = sequence;
    return same && retry;
  }

 private:
  std::map<hal::AgentId, std::uint16_t> last_;
};

}  // namespace sim::radio
