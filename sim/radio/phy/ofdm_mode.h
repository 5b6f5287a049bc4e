#pragma once

#include <memory>

#include "sim/radio/phy/coding.h"
#include "sim/radio/phy/error_table.h"
#include "sim/radio/phy/phy_mode.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// Coding of a rate of OFDM in 20 MHz. @pre rate is 6, 9, 12, 18, 24, 36, 48 or 54 Mb/s.
Coding ofdm_coding(hal::BitsPerSecond rate);

/// OFDM in 20 MHz: IEEE Std 802.11-2016, clause 17, in 5 GHz, and ERP-OFDM, clause 18, in 2.4 GHz.
///
/// Preamble 16 us and SIGNAL 4 us; symbols of 4 us for 16 service bits, the MPDU and 6 tail bits;
/// then, of ERP-OFDM, 6 us of signal extension (18.3.2.4), during which nothing is sent. With
/// BitsAtRisk::kPayloadTime the bits at risk fill the signal extension, too.
class OfdmMode final : public PhyMode {
 public:
  struct Options {
    BitsAtRisk at_risk = BitsAtRisk::kMpdu;
    bool is_erp = true;                         ///< In 2.4 GHz.
    std::shared_ptr<const ErrorCurve> curve{};  ///< Null: ofdm_success_probability().
  };
  /// @pre rate is 6, 9, 12, 18, 24, 36, 48 or 54 Mb/s.
  OfdmMode(hal::BitsPerSecond rate, const Options& options);

  bool is_mandatory() const override;  ///< 6, 12 and 24 Mb/s (18.2.2.3).
  hal::Duration signal_extension() const override;
  double bits_at_risk(std::uint32_t mpdu_bits) const override;
  hal::Duration airtime(std::uint32_t mpdu_bits) const override;  ///< 18.4.3.
  double header_success(double sinr, double share) const override;
  double success(double sinr, double bits) const override;

 private:
  hal::Duration extension() const;

  Options options_;
  Coding coding_;
};

}  // namespace sim::radio
