#pragma once

#include "hal/types/time.h"
#include "sim/radio/frame_lengths.h"
#include "sim/radio/mode_set.h"
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

  /// From the end of RTS or DATA to the PHY-RXSTART of a CTS or ACK that is sent so (10.3.2.9).
  hal::Duration response_timeout(const PhyMode& response) const {
    return sifs + slot + response.preamble_and_header();
  }
  /// No PHY-RXSTART so long after an RTS that a CTS in this mode answers: its NAV is void.
  hal::Duration nav_reset(const PhyMode& cts) const {
    return 2 * sifs + cts.airtime(cts_bits) + cts.preamble_and_header() + 2 * slot;
  }

  hal::Duration slot;
  hal::Duration sifs;
  hal::Duration difs;
  hal::Duration eifs;      ///< After a frame that came in wrong.
  hal::Duration cca_time;  ///< What begins within it before a slot boundary is not noticed there.
  std::uint32_t cts_bits;
};

}  // namespace sim::radio
