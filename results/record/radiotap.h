#pragma once

#include <cstdint>
#include <optional>

#include "hal/types/message.h"
#include "hal/types/time.h"
#include "sim/radio/frame.h"

namespace results::record {

/// What the radiotap header of a captured frame says beside the frame itself.
struct RadiotapFields {
  hal::Time mpdu_start{};              ///< When the first bit of the MPDU was there: TSFT, in us.
  std::uint16_t frequency = 0;         ///< MHz
  std::optional<double> signal_dbm{};  ///< Of a frame received.
  std::optional<double> noise_dbm{};   ///< The receiver's.
};

/// A radiotap header (radiotap.org, version 0) and, behind it, the frame with its FCS. The header
/// has TSFT, flags (FCS at the end; short preamble), rate (if it is a multiple of 500 kb/s),
/// channel, and signal and noise where they are given.
hal::Bytes with_radiotap(const sim::radio::Frame& frame, const RadiotapFields& fields);

}  // namespace results::record
