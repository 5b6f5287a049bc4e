#pragma once

#include <boost/container/small_vector.hpp>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include "hal/types/quantity.h"
#include "hal/types/time.h"
#include "hal/types/verdict.h"
#include "sim/radio/mac/frame.h"
#include "sim/radio/phy/phy_mode.h"

namespace sim::radio {

/// PHY protocol data unit: what one transmission puts on the air. It carries one MPDU, or the
/// subframes of an A-MPDU (IEEE Std 802.11-2020, 9.7), each of which is received or lost by itself.
struct Ppdu {
  /// An MPDU and the bits of the PSDU that must arrive for it, [begin, end): in an A-MPDU those of
  /// its delimiter, too, but not its padding.
  struct Part {
    FramePtr frame;
    std::uint32_t begin = 0, end = 0;
  };

  /// The PPDU of one MPDU, in the mode of the frame.
  explicit Ppdu(FramePtr frame)
      : mode(frame->mode), airtime(frame->airtime), psdu_bits(frame->air_length) {
    const std::uint32_t bits = psdu_bits;
    parts.push_back({std::move(frame), 0, bits});
  }
  Ppdu(const PhyMode& the_mode, std::uint32_t bits)
      : mode(&the_mode), airtime(the_mode.airtime(bits)), psdu_bits(bits) {}

  const Frame& first() const { return *parts.front().frame; }
  bool is_aggregate() const { return parts.size() > 1; }

  const PhyMode* mode;    ///< Outlives the PPDU. Null if its frame was decoded from bytes.
  hal::Duration airtime;  ///< Preamble, PHY header and PSDU.
  std::uint32_t psdu_bits;
  boost::container::small_vector<Part, 1> parts;  ///< In order of sending; not empty.
};

using PpduPtr = std::shared_ptr<const Ppdu>;

inline PpduPtr ppdu_of(FramePtr frame) { return std::make_shared<const Ppdu>(std::move(frame)); }

/// A PPDU at its end at a receiver that had synchronised to it and could read at least one MPDU.
struct ReceivedPpdu {
  const Ppdu& ppdu;
  std::span<const hal::Verdict> verdicts;  ///< One for each part.
  hal::Dbm rssi;
  hal::Decibels snr;  ///< Lowest SINR over the PPDU.
};

}  // namespace sim::radio
