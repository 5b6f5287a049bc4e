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
  kHeader,     ///< PHY header wrong: no PHY-RXSTART (kDsss only).
  kBitError,   ///< FCS wrong; mobility_framework: or the PHY header.
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
  hal::Time locked() const { return locked_; }
  hal::Time header_end() const;
  hal::Time heard_until() const { return heard_until_; }  ///< Of the last hear().

  /// The interference was this from the last call (or from synchronising) until now.
  void hear(const ReceptionRules& rules, const Interference& interference, hal::Time now);

  /// Judges the PHY header once, with the first hear() from its end on (kDsss; draws once from
  /// `errors`): a receiver does not stay with a frame whose header is wrong.
  /// @pre heard_until() has not gone past header_end() before that.
  void judge_header(const ReceptionRules& rules, hal::RandomStream& errors);
  /// The header came in: PHY-RXSTART (IEEE Std 802.11-2016, 8.3.5.11).
  bool has_header() const { return header_ == Header::kRight; }
  bool has_wrong_header() const { return header_ == Header::kWrong; }

  struct Outcome {
    hal::Verdict verdict = hal::Verdict::kDelivered;
    ReceiveError error = ReceiveError::kBitError;  ///< If not delivered.
  };
  /// At the end, after the last hear(). kDsss: draws once from `errors` unless the header was
  /// wrong; kMobilityFramework: unless the SINR alone decides.
  Outcome judge(const ReceptionRules& rules, hal::RandomStream& errors) const;

  double min_sinr() const { return min_sinr_; }  ///< Ratio, not dB.

 private:
  enum class Header : std::uint8_t { kComing, kRight, kWrong };

  double success_of_interval(double sinr, hal::Time from, hal::Time to) const;
  double success_at_min_sinr() const;

  const Frame* frame_;
  double power_;
  hal::Time start_;
  hal::Time locked_;
  hal::Time heard_until_;
  double min_sinr_;
  double success_ = 1;  ///< kDsss: of all intervals so far of the header, then of the MPDU.
  Header header_ = Header::kComing;
  Interference worst_;
};

}  // namespace sim::radio
