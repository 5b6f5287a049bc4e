#pragma once

#include "hal/types/time.h"
#include "sim/radio/airtime.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// Intervals of the DCF (IEEE Std 802.11-2016, 10.3.2.3 and 10.3.2.4).
struct DcfTiming {
  explicit DcfTiming(const RadioConfig& config)
      : slot(config.slot), sifs(config.sifs), difs(config.sifs + 2 * config.slot) {
    const Airtime airtime(config);
    const hal::Duration rx_start_delay = airtime.plcp(config.control_rate);
    eifs = sifs + airtime.of(airtime.mpdu_bits(FrameType::kAck), kLowestRate) + difs;
    response_timeout = sifs + slot + rx_start_delay;
    const hal::Duration cts = airtime.of(airtime.mpdu_bits(FrameType::kCts), config.control_rate);
    nav_reset = 2 * sifs + cts + rx_start_delay + 2 * slot;
  }

  hal::Duration slot;
  hal::Duration sifs;
  hal::Duration difs;
  hal::Duration eifs{};              ///< After a frame that came in wrong.
  hal::Duration response_timeout{};  ///< From the end of RTS or DATA to the start of CTS or ACK.
  hal::Duration nav_reset{};         ///< Nothing came in this long after an RTS: its NAV is void.

 private:
  static constexpr hal::BitsPerSecond kLowestRate{1e6};
};

}  // namespace sim::radio
