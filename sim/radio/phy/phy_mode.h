#pragma once

#include <cstdint>

#include "hal/types/quantity.h"
#include "hal/types/time.h"
#include "sim/radio/phy/mode_id.h"

namespace sim::radio {

/// One way to send an MPDU: its rate, and the preamble and PHY header with which its frames begin.
/// Computes how long such a frame is on the air and how probable its reception is. Independent of
/// stations.
class PhyMode {
 public:
  virtual ~PhyMode() = default;

  const ModeId& id() const { return id_; }
  hal::BitsPerSecond rate() const { return rate_; }  ///< Rate of the MPDU.
  ModulationClass modulation_class() const { return id_.modulation; }
  std::uint16_t width() const { return id_.width; }  ///< MHz; SINR is that within this width.
  /// Rate from which that of a control response follows: of classes with MCSs the non-HT reference
  /// rate (IEEE Std 802.11-2020, table 10-10), else rate().
  virtual hal::BitsPerSecond reference_rate() const { return rate_; }
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

  /// Most bytes of one PSDU (aPSDUMaxLength; of DSSS and OFDM what LENGTH can express).
  virtual std::uint32_t longest_psdu() const { return 4095; }
  /// Longest PPDU (aPPDUMaxTime).
  virtual hal::Duration longest_ppdu() const { return hal::Duration::max(); }

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
  PhyMode(const ModeId& id, hal::BitsPerSecond rate, hal::Duration preamble, hal::Duration header)
      : id_(id), rate_(rate), preamble_(preamble), header_(header) {}

 private:
  ModeId id_;
  hal::BitsPerSecond rate_;
  hal::Duration preamble_, header_;
};

}  // namespace sim::radio
