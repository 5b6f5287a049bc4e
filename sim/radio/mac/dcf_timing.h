#pragma once

#include "hal/types/time.h"
#include "sim/radio/mac/frame_lengths.h"
#include "sim/radio/phy/mode_set.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// Intervals of the DCF (IEEE Std 802.11-2016, 10.3.2.3 and 10.3.2.4).
struct DcfTiming {
  DcfTiming(const DcfConfig& config, const ModeSet& modes)
      : slot(config.contention.slot),
        sifs(config.contention.sifs),
        difs(config.contention.sifs + 2 * config.contention.slot),
        eifs(sifs + modes.lowest().airtime(mpdu_bits(config.lengths, FrameType::kAck)) + difs),
        cca_time(config.cca_time),
        cts_bits(mpdu_bits(config.lengths, FrameType::kCts)) {}

  /// Timeout for a CTS or ACK in the given mode: from the end of RTS or DATA to its PHY-RXSTART
  /// (10.3.2.9).
  hal::Duration response_timeout(const PhyMode& response) const {
    return sifs + slot + response.preamble_and_header();
  }
  /// Time after an RTS within which a PHY-RXSTART must follow, or else the NAV set by the RTS may
  /// be reset; `cts` is the mode of the CTS.
  hal::Duration nav_reset(const PhyMode& cts) const {
    return 2 * sifs + cts.airtime(cts_bits) + cts.preamble_and_header() + 2 * slot;
  }

  hal::Duration slot;
  hal::Duration sifs;
  hal::Duration difs;
  hal::Duration eifs;  ///< After an erroneous frame.
  /// Frames that begin within this time before a slot boundary are not detected at the boundary.
  hal::Duration cca_time;
  std::uint32_t cts_bits;
};

}  // namespace sim::radio
