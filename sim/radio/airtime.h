#pragma once

#include <cstddef>
#include <cstdint>

#include "hal/types/time.h"
#include "sim/radio/frame.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// How long frames are: bits of an MPDU and time on the air.
class Airtime {
 public:
  explicit Airtime(const RadioConfig& config) : config_(config) {}

  /// MPDU with FCS, bits. `payload`: bytes above LLC, for data frames.
  /// IEEE Std 802.11-2016, 9.3.1 (RTS 20 bytes, CTS and ACK 14), 9.3.2 (data 24 + FCS 4); IEEE Std
  /// 802.2-1998 and RFC 1042 (LLC/SNAP 8).
  std::uint32_t mpdu_bits(FrameType type, std::size_t payload = 0) const;

  /// Preamble and PLCP header: IEEE Std 802.11-2016, 16.2.2. Zero for disk and ideal.
  hal::Duration plcp(hal::BitsPerSecond rate) const;

  /// Preamble alone.
  hal::Duration preamble(hal::BitsPerSecond rate) const;

  /// TXTIME of IEEE Std 802.11-2016, 16.3.4, with the profile's rounding.
  hal::Duration of(std::uint32_t mpdu_bits, hal::BitsPerSecond rate) const;

 private:
  bool short_preamble(hal::BitsPerSecond rate) const;

  RadioConfig config_;
};

}  // namespace sim::radio
