#pragma once

#include <cstdint>

#include "hal/types/quantity.h"
#include "hal/types/time.h"

namespace sim::radio {

/// Frames are answered in their own class (IEEE Std 802.11-2016, 10.7.6.5.3).
enum class ModulationClass : std::uint8_t { kNone, kDsss, kOfdm };

/// One way to send an MPDU: its rate, and the preamble and PHY header that its frames begin with.
/// How long such a frame is on the air, and how likely it comes in. Says nothing of a station.
class PhyMode {
 public:
  virtual ~PhyMode() = default;

  hal::BitsPerSecond rate() const { return rate_; }  ///< Of the MPDU.
  virtual ModulationClass modulation_class() const { return ModulationClass::kNone; }
  /// Every station that has this class can receive and send this mode.
  virtual bool is_mandatory() const { return true; }
  /// What a receiver synchronises to; then the header, in another rate than the MPDU.
  hal::Duration preamble() const { return preamble_; }
  hal::Duration preamble_and_header() const { return preamble_ + header_; }

  /// Of the airtime, what passes in silence behind the last bit.
  virtual hal::Duration signal_extension() const { return {}; }
  /// Of an MPDU of so many bits, those that must come in between the header and that silence.
  virtual double bits_at_risk(std::uint32_t mpdu_bits) const { return mpdu_bits; }

  /// TXTIME: preamble, header and an MPDU of so many bits (with FCS), and the signal extension.
  virtual hal::Duration airtime(std::uint32_t mpdu_bits) const = 0;

  /// Probability that all of a share of the header, or so many bits of the MPDU, arrive when the
  /// SINR is the same for all of them.
  /// @param sinr  a ratio, not dB; >= 0, may be infinite.  @param share  0 .. 1.
  /// @param bits  >= 0; fractions count.
  virtual double header_success(double sinr, double share) const = 0;
  virtual double success(double sinr, double bits) const = 0;

 protected:
  PhyMode(hal::BitsPerSecond rate, hal::Duration preamble, hal::Duration header)
      : rate_(rate), preamble_(preamble), header_(header) {}

 private:
  hal::BitsPerSecond rate_;
  hal::Duration preamble_, header_;
};

}  // namespace sim::radio
