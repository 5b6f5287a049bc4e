#pragma once

#include <cstdint>
#include <map>
#include <utility>

#include "hal/types/agent_id.h"
#include "sim/radio/mac/frame.h"

namespace sim::radio {

/// Recognises a data frame that was received before and was retransmitted because its ACK was lost
/// (IEEE Std 802.11-2020, 10.3.2.14): same transmitter, same sequence number, retry bit set. QoS
/// data are numbered for each TID.
class DuplicateFilter {
 public:
  /// Whether the frame is a duplicate. Stores the sequence number for the next call.
  bool is_duplicate(const Frame& frame) {
    const Numbering numbering{frame.transmitter, frame.qos ? frame.priority : kNoTid};
    const auto [known, is_new] = last_.try_emplace(numbering, frame.sequence);
    if (is_new) return false;
    const bool same = known->second == frame.sequence;
    known->second = frame.sequence;
    return same && frame.retry;
  }

 private:
  static constexpr std::uint8_t kNoTid = 255;
  using Numbering = std::pair<hal::AgentId, std::uint8_t>;

  std::map<Numbering, std::uint16_t> last_;
};

}  // namespace sim::radio
