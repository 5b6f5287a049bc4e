#pragma once

#include <cstdint>

#include "hal/types/random.h"
#include "hal/types/time.h"
#include "hal/types/verdict.h"
#include "sim/radio/frame.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// How the MAC sees a frame that its radio held and lost.
enum class ReceiveError : std::uint8_t {
  kCollision,  ///< SINR below the decoder's threshold (mobility_framework only).
  kBitError,   ///< PLCP header or FCS wrong.
};

/// What all receptions of one air have in common, in mW and ratios.
struct ReceptionRules {
  explicit ReceptionRules(const ReceiverConfig& config);

  ErrorModel error_model;
  double min_sinr;
  double noise;        ///< mW
  double sensitivity;  ///< mW
};

/// Sum and maximum of the other frames at a receiver.
struct Interference {
  double sum = 0;        ///< mW
  double strongest = 0;  ///< mW
};

/// Why a frame with too low a SINR was lost: noise, another frame that could have been received by
/// itself, or the sum of weaker ones.
hal::Verdict cause_of_loss(const ReceptionRules& rules, const Interference& interference);

/// One frame that a receiver is synchronised to, from then until its end. SINR is piecewise
/// constant; intervals of no length do not count.
class Reception {
 public:
  /// @param power  mW
  /// @param start  of the frame's preamble at this receiver; `locked` is when it synchronised.
  Reception(const Frame& frame, double power, hal::Time start, hal::Time locked);

  const Frame& frame() const { return *frame_; }
  double power() const { return power_; }  ///< mW
  hal::Time start() const { return start_; }
  hal::Time heard_until() const { return heard_until_; }  ///< Of the last hear().

  /// The interference was this from the last call (or from synchronising) until now.
  void hear(const ReceptionRules& rules, const Interference& interference, hal::Time now);

  /// Whether some of preamble and PHY header is still to come in.
  bool in_header(hal::Time now) const;

  struct Outcome {
    hal::Verdict verdict = hal::Verdict::kDelivered;
    ReceiveError error = ReceiveError::kBitError;  ///< If not delivered.
  };
  /// At the end, after the last hear(). kDsss: draws once from `errors`; kMobilityFramework: unless
  /// the SINR alone decides.
  Outcome judge(const ReceptionRules& rules, hal::RandomStream& errors) const;

  double min_sinr() const { return min_sinr_; }  ///< Ratio, not dB.

 private:
  double success_of_interval(double sinr, hal::Time from, hal::Time to) const;
  double success_at_min_sinr() const;

  const Frame* frame_;
  double power_;
  hal::Time start_;
  hal::Time heard_until_;
  double min_sinr_;
  double success_ = 1;  ///< kDsss: of all intervals so far.
  Interference worst_;
};

}  // namespace sim::radio
