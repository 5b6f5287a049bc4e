#pragma once

#include "sim/radio/phy/mcs_mode.h"

namespace sim::radio {

/// HE for a single user in 20, 40 or 80 MHz: IEEE Std 802.11ax-2021, clause 27. Header: L-SIG and
/// RL-SIG 4 us each (24 bits, twice), HE-SIG-A 8 us (52 bits), HE-STF 4 us, HE-LTFs (27.3.4).
/// Symbols of 12.8 us and a guard interval of 0.8, 1.6 or 3.2 us. HE-LTFs as every station has to
/// support them (27.1.1): 2x (6.4 us) with 0.8 and 1.6 us, 4x (12.8 us) with 3.2 us.
///
/// One encoder, with tail bits, in all MCSs (the error model is that of the convolutional code,
/// too; the LDPC that clause 27 wants above 20 MHz has no tail and may need one symbol more or
/// less). No packet extension after the last symbol: the nominal packet padding is 0 (27.3.13).
class HeMode final : public McsMode {
 public:
  static constexpr std::uint8_t kHighestMcs = 11;
  /// Whether there is such a mode.
  static bool exists(const ModeId& id);

  /// @pre exists(id).
  HeMode(const ModeId& id, const Options& options)
      : McsMode(id, format_of(id, options.times), options) {}
  std::uint32_t longest_psdu() const override { return 6'500'631; }  ///< 27.4.4

 private:
  static Format format_of(const ModeId& id, PpduTimes times);
};

}  // namespace sim::radio
