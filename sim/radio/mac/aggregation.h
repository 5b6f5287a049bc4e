#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "hal/types/time.h"
#include "sim/radio/mac/frame_factory.h"
#include "sim/radio/mac/mpdu_stream.h"
#include "sim/radio/mac/ppdu.h"
#include "sim/radio/mac/tx_queue.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// What a PPDU may have at most.
struct PpduLimits {
  const PhyMode& mode;
  hal::Duration airtime;
  /// A single MPDU may take longer: it opens a TXOP (10.23.2.9).
  bool single_may_exceed = true;
};

struct PsduSize {
  std::uint32_t mpdus = 0;
  std::uint32_t bits = 0;
};

/// Puts MSDUs into A-MSDUs and A-MPDUs (IEEE Std 802.11-2020, 10.11 and 10.12).
class Aggregation {
 public:
  /// @param config  outlives this object.
  explicit Aggregation(const DcfConfig& config) : config_(config) {}

  /// Chooses the first MPDUs of the stream for the next PPDU, and takes as many more MSDUs of the
  /// queue as fit. Without an agreement there is one MPDU. @return the size; no MPDU if not even
  /// the first one fits.
  /// @param more  puts the next MSDU of the stream at the end of the queue. @return whether there
  /// was one.
  PsduSize fill(MpduStream& stream, TxQueue& queue, const PpduLimits& limits, hal::Time now,
                const std::function<bool()>& more = {}) const;

  /// Whether an MSDU that waits is of this stream.
  static bool belongs(const MpduStream& stream, const Outgoing& outgoing);

  /// Bits of a PSDU of `bits` with one more MPDU: delimiter, MPDU, and padding of what precedes
  /// (9.7.1).
  static std::uint32_t with_subframe(std::uint32_t bits, std::uint32_t mpdu_bits);
  /// Bits before the MPDU in that subframe.
  static std::uint32_t subframe_begin(std::uint32_t bits);

 private:
  std::optional<PsduSize> with(const PsduSize& size, std::uint32_t mpdu_bits,
                               const PpduLimits& limits) const;
  /// Where MSDUs come from.
  struct Supply {
    TxQueue& queue;
    const std::function<bool()>& more;
    hal::Time now;
    std::size_t place = 0;  ///< In the queue, where to look from.
  };
  bool find(const MpduStream& stream, Supply& supply) const;
  std::optional<Mpdu> next_mpdu(const MpduStream& stream, Supply& supply) const;
  bool is_expired(const Outgoing& outgoing, hal::Time now) const;

  const DcfConfig& config_;
};

}  // namespace sim::radio
