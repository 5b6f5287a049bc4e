#pragma once

#include <cstdint>

#include "hal/types/quantity.h"
#include "hal/types/time.h"

namespace sim::radio {

/// Modulation class. Frames are answered in their own class (IEEE Std 802.11-2016, 10.7.6.5.3).
enum class ModulationClass : std::uint8_t { kNone, kDsss, kOfdm };

/// One way to send an MPDU: its rate, and the preamble and PHY header with which its frames begin.
/// Computes how long such a frame is on the air and how probable its reception is. Independent of
/// stations.
class PhyMode {
 public:
  virtual ~PhyMode() = default;

  hal::BitsPerSecond rate() const { return rate_; }  ///< Rate of the MPDU.
  virtual ModulationClass modulation_class() const { return ModulationClass::kNone; }
  /// Whether every station that supports this class supports this mode.
  virtual bool is_mandatory() const { return true; }
  /// Duration of the preamble, to which a receiver synchronises; the PHY header follows, at another
  /// rate than the MPDU.
  hal::Duration preamble() const { return preamble_; }
  hal::Duration preamble_and_header() const { return preamble_ + header_; }

  /// Part of the airtime after the last bit, during which nothing is sent.
  virtual hal::Duration signal_extension() const { return {}; }
  /// Of an MPDU of `mpdu_bits` bits: number of bits that must arrive between the header and the
  /// signal extension.
  virtual double bits_at_risk(std::uint32_t mpdu_bits) const { return mpdu_bits; }

  /// TXTIME: duration of preamble, header, MPDU of `mpdu_bits` bits (with FCS) and signal
  /// extension.
  virtual hal::Duration airtime(std::uint32_t mpdu_bits) const = 0;

  /// Probability that a share of the header, or a number of bits of the MPDU, arrives without error
  /// when the SINR is the same for all of it.
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
