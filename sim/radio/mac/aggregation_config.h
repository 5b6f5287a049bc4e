#pragma once

#include <cstdint>

#include "hal/types/time.h"

namespace sim::radio {

/// A-MPDU, A-MSDU and Block Ack (IEEE Std 802.11-2020, 10.11, 10.12 and 10.25).
struct AggregationConfig {
  std::uint32_t max_ampdu = 0;  ///< Longest A-MPDU, bytes; 0: none is sent.
  std::uint32_t max_amsdu = 0;  ///< Longest A-MSDU, bytes; 0: none is sent.
  /// MPDUs that may wait for their acknowledgement: the buffer size of an ADDBA, 1 .. 64, with HE
  /// 1 .. 256.
  std::uint32_t block_ack_window = 64;
  /// How long a recipient waits for a missing MPDU before it passes on those after it, > 0. Not in
  /// the standard; Linux's mac80211 has 100 ms (net/mac80211/agg-rx.c).
  hal::Duration reorder_timeout = std::chrono::milliseconds{100};
  bool operator==(const AggregationConfig&) const = default;
};

}  // namespace sim::radio
