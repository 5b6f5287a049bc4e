#pragma once

#include <cstdint>
#include <vector>

#include "hal/types/random.h"
#include "hal/types/time.h"
#include "hal/types/verdict.h"
#include "sim/radio/mac/ppdu.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// Reception errors, as reported to the MAC, of frames to which the radio had synchronised.
enum class ReceiveError : std::uint8_t {
  kCollision,  ///< SINR below the decoder's threshold (mobility_framework only).
  kHeader,     ///< Wrong PHY header: no PHY-RXSTART (kDsss only).
  kBitError,   ///< Wrong FCS; mobility_framework: or wrong PHY header.
};

/// Parameters common to all receptions; powers in mW, ratios not in dB.
struct ReceptionRules {
  explicit ReceptionRules(const ReceiverConfig& config);

  ErrorModel error_model;
  double min_sinr;
  double noise;        ///< mW
  double sensitivity;  ///< mW
};

/// Sum and maximum of the powers of the other frames at a receiver.
struct Interference {
  double sum = 0;        ///< mW
  double strongest = 0;  ///< mW
};

/// Why a frame was lost through low SINR: noise, another frame that could have been received by
/// itself, or the sum of weaker ones.
hal::Verdict cause_of_loss(const ReceptionRules& rules, const Interference& interference);

/// Reception of one PPDU from the time when the receiver has synchronised to it until its end.
/// SINR is piecewise constant; intervals of no length do not count. Each MPDU is lost by itself,
/// unless the PHY header is wrong.
class Reception {
 public:
  /// @param power  mW
  /// @param start  of the preamble at this receiver. @param locked  time of synchronisation.
  Reception(const Ppdu& ppdu, double power, hal::Time start, hal::Time locked);

  const Ppdu& ppdu() const { return *ppdu_; }
  double power() const { return power_; }  ///< mW
  hal::Time start() const { return start_; }
  hal::Time locked() const { return locked_; }
  hal::Time header_end() const;
  hal::Time heard_until() const { return heard_until_; }  ///< Time of the last hear().

  /// Applies an interference that was constant from the last call (or from synchronisation) until
  /// now.
  void hear(const ReceptionRules& rules, const Interference& interference, hal::Time now);

  /// Decides once whether the PHY header was received, after the first hear() that reaches its end
  /// (kDsss; draws once from `errors`): a receiver drops a frame whose header is wrong.
  /// @pre heard_until() has not passed header_end() before that.
  void judge_header(const ReceptionRules& rules, hal::RandomStream& errors);
  /// Whether the header was received: PHY-RXSTART (IEEE Std 802.11-2016, 8.3.5.11).
  bool has_header() const { return header_ == Header::kRight; }
  bool has_wrong_header() const { return header_ == Header::kWrong; }

  struct Outcome {
    hal::Verdict verdict = hal::Verdict::kDelivered;
    ReceiveError error = ReceiveError::kBitError;  ///< If not delivered.
  };
  /// Decides the outcome of an MPDU at the PPDU's end, after the last hear(); call it once for
  /// each, in order. kDsss: draws once from `errors` unless the header was wrong.
  /// kMobilityFramework: draws unless the SINR alone decides.
  Outcome judge(std::size_t part, const ReceptionRules& rules, hal::RandomStream& errors) const;

  double min_sinr() const { return min_sinr_; }  ///< Ratio, not dB.

 private:
  enum class Header : std::uint8_t { kComing, kRight, kWrong };

  void count_interval(double sinr, hal::Time from, hal::Time to);
  void count_parts(double sinr, hal::Time from, hal::Time to);
  double success_at_min_sinr() const;

  const Ppdu* ppdu_;
  double power_;
  hal::Time start_;
  hal::Time locked_;
  hal::Time heard_until_;
  double width_;  ///< Of the PPDU, over that of the noise floor.
  double min_sinr_;
  /// kDsss: product over all intervals so far of the header, and of the first MPDU.
  double header_success_ = 1, success_ = 1;
  std::vector<double> others_;  ///< The same of the other MPDUs.
  Header header_ = Header::kComing;
  Interference worst_;
};

}  // namespace sim::radio
