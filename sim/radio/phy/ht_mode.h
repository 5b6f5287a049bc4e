#pragma once

#include "sim/radio/phy/mcs_mode.h"

namespace sim::radio {

/// HT mixed format in 20 or 40 MHz: IEEE Std 802.11-2020, clause 19. Header: L-SIG 4 us (24 bits),
/// HT-SIG 8 us (48 bits), HT-STF 4 us, HT-LTFs of 4 us each (19.3.2). Symbols of 3.2 us and a guard
/// interval of 0.8 or 0.4 us; with the short one the data field ends at a multiple of 4 us
/// (19.4.3). Two encoders above 300 Mb/s (19.3.11.4, tables 19-30 to 19-38).
class HtMode final : public McsMode {
 public:
  static constexpr std::uint8_t kHighestMcs = 7;
  /// Whether there is such a mode.
  static bool exists(const ModeId& id);

  /// @pre exists(id).
  HtMode(const ModeId& id, const Options& options)
      : McsMode(id, format_of(id, options.times), options) {}
  std::uint32_t longest_psdu() const override { return 65'535; }  ///< 19.4.4

 private:
  static Format format_of(const ModeId& id, PpduTimes times);
};

}  // namespace sim::radio
