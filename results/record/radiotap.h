#pragma once

#include <cstdint>
#include <optional>

#include "hal/types/message.h"
#include "hal/types/time.h"
#include "sim/radio/mac/frame.h"

namespace results::record {

/// Fields of the radiotap header that do not follow from the frame itself.
struct RadiotapFields {
  hal::Time mpdu_start{};       ///< Time of the PSDU's first bit; becomes the field TSFT in us.
  std::uint16_t frequency = 0;  ///< MHz
  std::optional<double> signal_dbm{};  ///< Power of a received frame.
  std::optional<double> noise_dbm{};   ///< Noise at the receiver.
  std::uint32_t ampdu = 0;  ///< Number of the A-MPDU in the file, if the frame is in one.
};

/// Builds a radiotap header (radiotap.org, version 0) followed by the frame with its FCS. The
/// header has TSFT, flags (FCS at the end; short preamble), rate (only of DSSS and OFDM, and if it
/// is a multiple of 500 kb/s), channel, signal and noise if they are given, and of HT, VHT and HE
/// the mode and the place in the A-MPDU. Coding is BCC, as in the models of these modes.
hal::Bytes with_radiotap(const sim::radio::Frame& frame, const RadiotapFields& fields);

}  // namespace results::record
