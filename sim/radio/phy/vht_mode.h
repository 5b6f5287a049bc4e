#pragma once

#include "sim/radio/phy/mcs_mode.h"

namespace sim::radio {

/// VHT in 20, 40 or 80 MHz for one user: IEEE Std 802.11-2020, clause 21. Header: L-SIG 4 us (24
/// bits), VHT-SIG-A 8 us (48 bits), VHT-STF 4 us, VHT-LTFs of 4 us each, VHT-SIG-B 4 us (26, 27 or
/// 29 bits) (21.3.2). Symbols and guard intervals as in HT (21.4.3). One encoder for each 600 Mb/s
/// of the rate with the short guard interval (21.5, tables 21-30 ff.).
class VhtMode final : public McsMode {
 public:
  static constexpr std::uint8_t kHighestMcs = 9;
  /// Whether there is such a mode: 21.5 leaves out those in which an encoder would not have a whole
  /// number of bits in a symbol (MCS 9 in 20 MHz with 1, 2 and 4 streams, MCS 6 in 80 MHz with 3).
  static bool exists(const ModeId& id);

  /// @pre exists(id).
  VhtMode(const ModeId& id, const Options& options)
      : McsMode(id, format_of(id, options.times), options) {}
  std::uint32_t longest_psdu() const override { return 1'048'575; }  ///< 21.4.4

 private:
  static int subcarriers_of(const ModeId& id);
  static int encoders_of(const ModeId& id);
  static Format format_of(const ModeId& id, PpduTimes times);
};

}  // namespace sim::radio
