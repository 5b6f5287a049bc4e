#pragma once

#include "sim/radio/phy/phy_mode.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// ERP-OFDM in 20 MHz: IEEE Std 802.11-2016, clauses 17 and 18.
///
/// Preamble 16 us and SIGNAL 4 us; symbols of 4 us for 16 service bits, the MPDU and 6 tail bits;
/// then 6 us of signal extension (18.3.2.4), during which nothing is sent. With
/// BitsAtRisk::kPayloadTime the bits at risk fill the signal extension, too.
class OfdmMode final : public PhyMode {
 public:
  /// @pre rate is 6, 9, 12, 18, 24, 36, 48 or 54 Mb/s.
  explicit OfdmMode(hal::BitsPerSecond rate, BitsAtRisk at_risk = BitsAtRisk::kMpdu);

  ModulationClass modulation_class() const override { return ModulationClass::kOfdm; }
  bool is_mandatory() const override;  ///< 6, 12 and 24 Mb/s (18.2.2.3).
  hal::Duration signal_extension() const override;
  double bits_at_risk(std::uint32_t mpdu_bits) const override;
  hal::Duration airtime(std::uint32_t mpdu_bits) const override;  ///< 18.4.3.
  double header_success(double sinr, double share) const override;
  double success(double sinr, double bits) const override;

 private:
  BitsAtRisk at_risk_;
};

}  // namespace sim::radio
