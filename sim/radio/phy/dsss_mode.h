#pragma once

#include "sim/radio/phy/phy_mode.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// DSSS and HR/DSSS: IEEE Std 802.11-2016, clauses 15 and 16.
///
/// Preamble and PLCP header take 144 us and 48 us, or 72 us and 24 us in the short format (16.2.2);
/// 1 Mb/s always uses the long format. The long header is sent at 1 Mb/s, the short one at 2 Mb/s.
class DsssMode final : public PhyMode {
 public:
  struct Options {
    Preamble preamble = Preamble::kLong;
    Rounding rounding = Rounding::kMicrosecond;
    ErrorModel errors = ErrorModel::kDsss;
  };
  /// @pre rate is 1, 2, 5.5 or 11 Mb/s.
  DsssMode(hal::BitsPerSecond rate, const Options& options);

  hal::Duration airtime(std::uint32_t mpdu_bits) const override;  ///< 16.3.4.
  double header_success(double sinr, double share) const override;
  double success(double sinr, double bits) const override;

 private:
  hal::BitsPerSecond header_rate_;
  Rounding rounding_;
  ErrorModel errors_;
};

/// A frame of the profiles without PHY: lasts bits over rate, to the nearest nanosecond, and is
/// always received.
class PlainMode final : public PhyMode {
 public:
  /// @param is_instant  true: frames take no time.
  PlainMode(hal::BitsPerSecond rate, bool is_instant);

  hal::Duration airtime(std::uint32_t mpdu_bits) const override;
  double header_success(double, double) const override { return 1; }
  double success(double, double) const override { return 1; }

 private:
  bool is_instant_;
};

}  // namespace sim::radio
