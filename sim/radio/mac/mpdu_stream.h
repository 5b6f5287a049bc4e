#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"
#include "sim/radio/mac/sequence_number.h"
#include "sim/radio/mac/tx_queue.h"

namespace sim::radio {

/// A data frame under a Block Ack agreement: one MSDU, or those of an A-MSDU.
struct Mpdu {
  std::vector<Outgoing> msdus;
  std::uint16_t sequence = 0;
  std::uint32_t attempts = 0;  ///< Number of times that it has been sent.
  std::uint32_t bits = 0;      ///< With FCS.
};

/// The QoS data of one station for one receiver and TID: their sequence numbers and, once the
/// receiver has agreed, the Block Ack agreement at its originator (IEEE Std 802.11-2020, 10.25).
struct MpduStream {
  enum class Agreement : std::uint8_t { kNone, kRequested, kActive };

  hal::AgentId to{};
  std::uint8_t tid = 0;
  std::uint16_t next_sequence = 0;
  Agreement agreement = Agreement::kNone;
  std::uint32_t window = 1;    ///< kActive: buffer size of the receiver; else 1.
  hal::Time ask_from{};        ///< kNone, kRequested: no request before this time.
  hal::Time served_since{};    ///< Since when its MPDUs have been the next to be sent.
  std::deque<Mpdu> in_flight;  ///< Sent or about to be sent, not acknowledged; in order.
  bool must_ask = false;       ///< A BlockAckReq is due.
  std::uint32_t asked = 0;     ///< Number of BlockAckReqs that were not answered.

  /// Whether the receiver's window has room for one more MPDU.
  bool has_room() const {
    return in_flight.empty() || steps(in_flight.front().sequence, next_sequence) < window;
  }
  /// First sequence number that is not acknowledged or given up.
  std::uint16_t start() const {
    return in_flight.empty() ? next_sequence : in_flight.front().sequence;
  }
  std::uint16_t take_number() {
    const std::uint16_t number = next_sequence;
    next_sequence = later(number, 1);
    return number;
  }
};

}  // namespace sim::radio
