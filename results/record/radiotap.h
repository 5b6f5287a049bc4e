#pragma once

#include <cstdint>
#include <optional>

#include "hal/types/message.h"
#include "hal/types/time.h"
#include "sim/radio/mac/frame.h"

namespace results::record {

/// Fields of the radiotap header that do not follow from the frame itself.
struct RadiotapFields {
  hal::Time mpdu_start{};       ///< Time of the MPDU's first bit; becomes the field TSFT in us.
  std::uint16_t frequency = 0;  ///< MHz
  std::optional<double> signal_dbm{};  ///< Power of a received frame.
  std::optional<double> noise_dbm{};   ///< Noise at the receiver.
};

/// Builds a radiotap header (radiotap.org, version 0) followed by the frame with its FCS. The
/// header has TSFT, flags (FCS at the end; short preamble), rate (only if it is a multiple of 500
/// kb/s), channel, and signal and noise if they are given.
hal::Bytes with_radiotap(const sim::radio::Frame& frame, const RadiotapFields& fields);

}  // namespace results::record
