#pragma once

#include "hal/types/time.h"
#include "sim/radio/frame_lengths.h"
#include "sim/radio/mode_set.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// Intervals of the DCF (IEEE Std 802.11-2016, 10.3.2.3 and 10.3.2.4).
struct DcfTiming {
  DcfTiming(const ContentionConfig& mac, const LengthsConfig& lengths, const ModeSet& modes)
      : slot(mac.slot), sifs(mac.sifs), difs(mac.sifs + 2 * mac.slot) {
    const PhyMode& control = modes.control();
    const hal::Duration rx_start_delay = control.preamble_and_header();
    eifs = sifs + modes.lowest().airtime(mpdu_bits(lengths, FrameType::kAck)) + difs;
    response_timeout = sifs + slot + rx_start_delay;
    const hal::Duration cts = control.airtime(mpdu_bits(lengths, FrameType::kCts));
    nav_reset = 2 * sifs + cts + rx_start_delay + 2 * slot;
  }

  hal::Duration slot;
  hal::Duration sifs;
  hal::Duration difs;
  hal::Duration eifs{};              ///< After a frame that came in wrong.
  hal::Duration response_timeout{};  ///< From the end of RTS or DATA to the start of CTS or ACK.
  hal::Duration nav_reset{};         ///< Nothing came in this long after an RTS: its NAV is void.
};

}  // namespace sim::radio
